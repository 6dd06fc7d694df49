#!/usr/bin/python3
"""same_particles.py ROWS A B [TOLERANCE]: two runs of sph_solver end with the same particles, by their ids, and the last
ROWS rows of their series agree; relative to the largest value of a column, wall times apart. The ledger's defect, which
is round-off and nothing else, is compared in runs that must be equal to the bit only."""

import csv
import pathlib
import sys

import h5py
import numpy as np


def last_fields(folder):
    path = sorted(pathlib.Path(folder, "sph").glob("particles_*.h5"))[-1]
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    ids = next(values for name, values in found.items() if name.endswith("id"))
    order = np.argsort(ids)
    return {name: values[order] for name, values in found.items() if name != "vertices" and len(values) == len(ids)}


def rows(folder, name, count, with_defect):
    """Names of the columns that are physics, and the last rows."""
    with open(pathlib.Path(folder, "sph", name)) as file:
        table = list(csv.reader(line for line in file if not line.startswith("#")))
    kept = [k for k, column in enumerate(table[0]) if not column.startswith("seconds_")
            and (with_defect or column != "ledger_defect")]
    return [table[0][k] for k in kept], np.array([[float(row[k]) for k in kept] for row in table[1:]])[-count:]


def scales(names, values):
    """Largest value of each column; of a body's loads that of the vector, of which a component may be round-off alone."""
    largest = np.nanmax(np.abs(values), axis=0)
    vector = [name[:-1] if "." in name and name[-1] in "xyz" else name for name in names]
    return np.array([max(largest[k] for k, other in enumerate(vector) if other == mine) for mine in vector])


def worst(one, two, scale):
    """Largest difference over the scale; what is dry must be dry in both."""
    if one.shape != two.shape or not np.array_equal(np.isnan(one), np.isnan(two)):
        return np.inf
    return float(np.nanmax(np.abs(one - two) / np.where(scale > 0, scale, 1), initial=0.0))


def main():
    count, one, two = int(sys.argv[1]), sys.argv[2], sys.argv[3]
    tolerance = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
    a, b = last_fields(one), last_fields(two)
    failed = a.keys() != b.keys() or len(a) < 3
    for name in a:
        difference = worst(a[name], b[name], np.nanmax(np.abs(a[name]), axis=0))
        print(f"{name}: {difference:.3g}")
        failed |= not difference <= tolerance
    for name in ("scalars.csv", "gauges.csv"):
        (names, first), (_, second) = (rows(run, name, count, tolerance == 0.0) for run in (one, two))
        difference = worst(first, second, scales(names, first))
        print(f"{name}: {difference:.3g} over {len(first)} rows")
        failed |= not difference <= tolerance or len(first) != count
    sys.exit(1 if failed else 0)


main()
