#!/usr/bin/python3
"""same_grid.py ROWS A B TOLERANCE: two runs of fv_solver end with the same fields, in the same blocks, and the last ROWS
rows of their series agree; relative to the largest value of a field or column, wall times and counts of cycles apart.
TOLERANCE 0: to the bit."""

import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from same_series import datasets, same  # noqa: E402  (the path above comes first)


def last_fields(folder):
    found = datasets(sorted(pathlib.Path(folder, "fv").glob("fields_*.h5"))[-1])
    status = {name: values for name, values in found.items() if name.endswith("/status")}
    for name, values in found.items():  # what blanked cells hold is nobody's
        wet = status[name.rsplit("/", 1)[0] + "/status"] != 1
        if values.shape[:3] == wet.shape:
            values[~wet] = 0
    return found


def vector_of(name):
    """Of a velocity, or of a force and its moment; the error of a volume is judged against the volume."""
    if name == "volume_error":
        return "water_volume"
    return re.sub(r"([fm]?[xyz]|[uvw])$", "", name)


def main():
    count, runs, tolerance = int(sys.argv[1]), sys.argv[2:4], float(sys.argv[4])
    agree = same([last_fields(run) for run in runs], lambda values: np.nanmax(np.abs(values), initial=0.0),
                 [pathlib.Path(run, "fv") for run in runs], vector_of,
                 () if tolerance == 0.0 else ("cycles", "drop"), count, tolerance)
    sys.exit(0 if agree else 1)


main()
