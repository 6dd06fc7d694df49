"""One moment of a run: particles and cells with velocity and pressure, whatever the programs call them."""

import pathlib

import numpy as np

from . import fields
from .errors import UserError

VELOCITY = ("velocity", "u")
PRESSURE = ("pressure", "p")
KIND = ("status", "kind", "state", "cell_status")
COMPUTED = 0  # of a cell's status: solved for, neither blanked nor imposed
BLANKED = 1


class Part:
    """Points of one program at one moment: position (n, 3), velocity (n, 3), pressure (n), status (n) or None."""

    def __init__(self, snapshot):
        def first(names):
            return next((snapshot[n] for n in names if n in snapshot.names), None)

        self.time = snapshot.time
        self.x = snapshot.points
        self.u = first(VELOCITY)
        self.p = first(PRESSURE)
        self.status = first(KIND)
        self.extent = None
        if self.u is not None and self.u.ndim == 1:
            self.u = None

    def pick(self, mask):
        for name in ("x", "u", "p", "status"):
            values = getattr(self, name)
            if values is not None:
                setattr(self, name, values[mask])
        return self

    @property
    def speed(self):
        return np.linalg.norm(self.u, axis=1)


class Moments:
    """The field series of a run's programs, matched in time."""

    def __init__(self, out):
        self.series = {p: fields.find_series(pathlib.Path(out) / p) for p in ("sph", "fv")}
        self.series = {p: s for p, s in self.series.items() if s}
        if not self.series:
            raise UserError(f"{out}: no field series (sph/*.xdmf, fv/*.xdmf)")

    def times(self):
        return np.array([s.time for s in next(iter(self.series.values()))])

    def at(self, time):
        """{program: Part} at the output closest to `time`."""
        parts = {}
        for program, series in self.series.items():
            snapshot = min(series, key=lambda s: abs(s.time - time))
            parts[program] = Part(snapshot)
        return parts

    def most_lively(self):
        """Time of the output with the fastest water, the first one left out where there are more."""
        series = next(iter(self.series.values()))
        later = series[1:] or series
        return max(later, key=lambda s: float(np.square(Part(s).u).sum(axis=1).mean())).time
