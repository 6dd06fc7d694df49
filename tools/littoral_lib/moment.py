"""One moment of a run: particles and cells with velocity and pressure, whatever the programs call them."""

import copy
import pathlib

import numpy as np

from . import fields
from .errors import UserError

VELOCITY = ("velocity", "u")
PRESSURE = ("pressure", "p")
KIND = ("status", "kind", "state", "cell_status")
LEVEL_SET = "level_set"  # < 0 in water
COMPUTED = 0  # of a cell's status: solved for, neither blanked nor imposed
BLANKED = 1


class Part:
    """Points of one program at one moment: position (n, 3), velocity (n, 3), pressure (n), status (n) or None."""

    def __init__(self, snapshot):
        def first(names):
            return next((snapshot[n] for n in names if n in snapshot.names), None)

        self.snapshot = snapshot
        self.time = snapshot.time
        self.x = snapshot.points
        self.u = first(VELOCITY)
        self.p = first(PRESSURE)
        self.status = first(KIND)
        self.phi = first((LEVEL_SET,))
        if self.u is not None and self.u.ndim == 1:
            self.u = None

    def pick(self, mask):
        picked = copy.copy(self)
        for name in ("x", "u", "p", "status", "phi"):
            values = getattr(self, name)
            if values is not None:
                setattr(picked, name, values[mask])
        return picked

    @property
    def speed(self):
        return np.linalg.norm(self.u, axis=1)

    def water(self):
        """Without the cells that a free surface leaves in the air, whose values mean nothing."""
        return self if self.phi is None else self.pick(self.phi < 0)

    def sheets(self):
        """The blocks' middle sheets along y: (x, z of the nodes, speed of the cells, blanked ones and air masked)."""
        for piece, sheet in self._middles():
            name = next(n for n in VELOCITY if n in piece.fields)
            speed = _without_blanked(piece, sheet, np.linalg.norm(sheet(piece.field(name)), axis=-1))
            if LEVEL_SET in piece.fields:
                speed = np.ma.masked_where(sheet(piece.field(LEVEL_SET)) > 0, speed)
            nk, nj, ni = piece.nodes
            nodes = piece.coordinates().reshape(nk, nj, ni, 3)[:, (nj - 1) // 2]
            yield nodes[..., 0], nodes[..., 2], speed

    def surfaces(self):
        """Of each block that has a level set: (x, z of the cells, phi) on its middle sheet; blanked cells masked."""
        for piece, sheet in self._middles():
            if LEVEL_SET not in piece.fields:
                continue
            centres = sheet(piece.centres())
            yield centres[..., 0], centres[..., 2], _without_blanked(piece, sheet, sheet(piece.field(LEVEL_SET)))

    def _middles(self):
        """(block, its cells' values -> those of its middle sheet along y) for every structured block."""
        for piece in self.snapshot.pieces:
            if not piece.structured:
                continue
            nk, nj, ni = piece.nodes
            shape = (nk - 1, max(nj - 1, 1), ni - 1)
            j = min((nj - 1) // 2, shape[1] - 1)
            yield piece, lambda values, shape=shape, j=j: values.reshape(*shape, *values.shape[1:])[:, j]


def _without_blanked(piece, sheet, values):
    masked = np.ma.array(values)
    for status in (piece.field(n) for n in KIND if n in piece.fields):
        masked = np.ma.masked_where(sheet(status) == BLANKED, masked)
    return masked


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
        """{program: Part} at the output closest to `time`, of all programs at the same moment."""
        times = [[snapshot.time for snapshot in series] for series in self.series.values()]
        common = [t for t in times[0] if all(min(abs(t - o) for o in other) < 1e-9 * (1 + t) for other in times[1:])]
        chosen = min(common or times[0], key=lambda t: abs(t - time))
        return {program: Part(min(series, key=lambda s: abs(s.time - chosen)))
                for program, series in self.series.items()}

    def most_lively(self):
        """Time of the output with the fastest water, the first one left out where there are more."""
        series = next(iter(self.series.values()))
        later = series[1:] or series
        return max(later, key=lambda s: _mean_square(Part(s).water().u)).time


def _mean_square(u):
    return float(np.square(u).sum(axis=1).mean()) if len(u) else 0.0
