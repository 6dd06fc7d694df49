#!/usr/bin/python3
"""same_particles.py ROWS A B [TOLERANCE [OF_PARTICLES]]: two runs of sph_solver end with the same particles, by their ids, and the last
ROWS rows of their series agree; relative to the largest value of a column, wall times apart. The ledger's defect, which
is round-off and nothing else, is compared in runs that must be equal to the bit only.
OF_PARTICLES: a tolerance of their own; 0: each particle is the same to the bit."""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from same_series import datasets, same  # noqa: E402  (the path above comes first)


def last_fields(folder):
    found = datasets(sorted(pathlib.Path(folder, "sph").glob("particles_*.h5"))[-1])
    ids = next(values for name, values in found.items() if name.endswith("id"))
    order = np.argsort(ids)
    return {name: values[order] for name, values in found.items() if name != "vertices" and len(values) == len(ids)}


def load_of(name):
    """Of a body's loads the vector."""
    return name[:-1] if "." in name and name[-1] in "xyz" else name


def main():
    count, runs = int(sys.argv[1]), sys.argv[2:4]
    tolerance = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
    agree = same([last_fields(run) for run in runs], lambda values: np.nanmax(np.abs(values), axis=0),
                 [pathlib.Path(run, "sph") for run in runs], load_of,
                 () if tolerance == 0.0 else ("ledger_defect",), count, tolerance,
                 float(sys.argv[5]) if len(sys.argv) > 5 else None)
    sys.exit(0 if agree else 1)


main()
