#!/usr/bin/python3
"""same_grid.py ROWS A B TOLERANCE: two runs of fv_solver end with the same fields, in the same blocks, and the last ROWS
rows of their series agree; relative to the largest value of a field or column, wall times and counts of cycles apart.
TOLERANCE 0: to the bit."""

import csv
import pathlib
import re
import sys

import h5py
import numpy as np


def last_fields(folder):
    path = sorted(pathlib.Path(folder, "fv").glob("fields_*.h5"))[-1]
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    status = {name: values for name, values in found.items() if name.endswith("/status")}
    for name, values in found.items():  # what blanked cells hold is nobody's
        wet = status[name.rsplit("/", 1)[0] + "/status"] != 1
        if values.shape[:3] == wet.shape:
            values[~wet] = 0
    return found


def rows(folder, name, count, exact):
    with open(pathlib.Path(folder, "fv", name), encoding="utf-8") as file:
        table = list(csv.reader(line for line in file if not line.startswith("#")))
    kept = [k for k, column in enumerate(table[0])
            if not column.startswith("seconds_") and (exact or column not in ("cycles", "drop"))]
    return [table[0][k] for k in kept], np.array([[float(row[k]) for k in kept] for row in table[1:]])[-count:]


def scales(names, values):
    """Largest value of each column; of a vector, or a force with its moment, that of all components, of which one may be
    round-off alone."""
    largest = np.nanmax(np.abs(values), axis=0)
    vector = [re.sub(r"([fm]?[xyz]|[uvw])$", "", name) for name in names]
    return np.array([max(largest[k] for k, other in enumerate(vector) if other == mine) for mine in vector])


def worst(one, two, scale):
    """Largest difference over the scale; what has no value (an elevation far from the surface) has none in both."""
    if one.shape != two.shape or not np.array_equal(np.isnan(one), np.isnan(two)):
        return np.inf
    return float(np.nanmax(np.abs(one - two) / np.where(scale > 0, scale, 1), initial=0.0))


def main():
    count, one, two, tolerance = int(sys.argv[1]), sys.argv[2], sys.argv[3], float(sys.argv[4])
    a, b = last_fields(one), last_fields(two)
    failed = a.keys() != b.keys() or len(a) < 3
    for name in a:
        difference = worst(a[name], b[name], np.nanmax(np.abs(a[name]), initial=0.0))
        print(f"{name}: {difference:.3g}")
        failed |= not difference <= tolerance
    for name in ("scalars.csv", "gauges.csv"):
        if not pathlib.Path(one, "fv", name).exists():
            continue
        (names, first), (_, second) = (rows(run, name, count, tolerance == 0.0) for run in (one, two))
        difference = worst(first, second, scales(names, first))
        print(f"{name}: {difference:.3g} over {len(first)} rows")
        failed |= not difference <= tolerance or len(first) != count
    sys.exit(1 if failed else 0)


main()
