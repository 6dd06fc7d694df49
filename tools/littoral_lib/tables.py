"""CSV files of the programs: a header, rows of numbers, lines beginning with # for units."""

import csv

import numpy as np

from .errors import UserError, unknown


class Table:
    """Columns of numbers by name: table["time"], table.names, len(table)."""

    def __init__(self, columns, path="(table)"):
        self.columns = columns
        self.path = str(path)

    @property
    def names(self):
        return list(self.columns)

    def __len__(self):
        return len(next(iter(self.columns.values()))) if self.columns else 0

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        if name not in self.columns:
            raise unknown(f"column of {self.path}:", name, self.columns)
        return self.columns[name]


def read_csv(path):
    """Table of a CSV file; a half-written last row (a run that was cut) is left out."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#") and line.strip()))
    except FileNotFoundError:
        raise UserError(f"{path}: no such file") from None
    if not rows:
        raise UserError(f"{path}: no header")
    header = [name.strip() for name in rows[0]]
    body = [row for row in rows[1:] if len(row) == len(header)]
    try:
        data = np.array([[float(v) for v in row] for row in body]).reshape(len(body), len(header))
    except ValueError as problem:
        raise UserError(f"{path}: {problem}") from None
    return Table({name: data[:, i] for i, name in enumerate(header)}, path)


def write_csv(path, columns, units=None):
    with open(path, "w", encoding="utf-8") as file:
        if units:
            file.write(f"# {units}\n")
        file.write(",".join(columns) + "\n")
        for row in zip(*columns.values()):
            file.write(",".join(repr(float(v)) for v in row) + "\n")
