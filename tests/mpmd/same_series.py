"""What same_particles.py and same_grid.py share: series of two runs side by side, and how far apart they are."""

import csv
import pathlib

import h5py
import numpy as np


def datasets(path):
    """{name: values} of all datasets of a file."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def rows(folder, name, count, left_out):
    """Names of the columns that are physics, and their last `count` rows."""
    with open(pathlib.Path(folder, name), encoding="utf-8") as file:
        table = list(csv.reader(line for line in file if not line.startswith("#")))
    kept = [k for k, column in enumerate(table[0]) if not column.startswith("seconds_") and column not in left_out]
    return [table[0][k] for k in kept], np.array([[float(row[k]) for k in kept] for row in table[1:]])[-count:]


def scales(names, values, vector_of):
    """Largest value of each column; of a vector that of all components, of which one may be round-off alone."""
    largest = np.nanmax(np.abs(values), axis=0)
    vector = [vector_of(name) for name in names]
    return np.array([max(largest[k] for k, other in enumerate(vector) if other == mine) for mine in vector])


def worst(one, two, scale):
    """Largest difference over the scale; what has no value (dry, far from the surface) has none in both."""
    if one.shape != two.shape or not np.array_equal(np.isnan(one), np.isnan(two)):
        return np.inf
    return float(np.nanmax(np.abs(one - two) / np.where(scale > 0, scale, 1), initial=0.0))


def same(fields, scale, series, vector_of, left_out, count, tolerance, of_fields=None):
    """Whether both runs agree, told on the screen.

    fields     {name: values} of each run's end; scale: of one field's values
    series     folder of each run's CSV files; vector_of: the vector whose component a column is, or its own name
    left_out   columns that are not compared
    tolerance  of the series, and of the fields unless of_fields is given
    """
    a, b = fields
    agree = a.keys() == b.keys() and len(a) >= 3
    for name in (name for name in a if name in b):
        difference = worst(a[name], b[name], scale(a[name]))
        print(f"{name}: {difference:.3g}")
        agree &= difference <= (tolerance if of_fields is None else of_fields)
    for name in ("scalars.csv", "gauges.csv"):
        if name == "gauges.csv" and not any(pathlib.Path(folder, name).exists() for folder in series):
            continue  # a scene without gauges
        (names, first), (_, second) = (rows(folder, name, count, left_out) for folder in series)
        difference = worst(first, second, scales(names, first, vector_of))
        print(f"{name}: {difference:.3g} over {len(first)} rows")
        agree &= difference <= tolerance and len(first) == count
    return agree
