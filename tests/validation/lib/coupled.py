"""Measures of coupled runs: both sides at one moment, differences where they meet, the ledger."""

import numpy as np
from littoral_lib import signals
from littoral_lib.moment import COMPUTED, Moments
from littoral_lib.errors import UserError


class Moment:
    """Particles and cells at one output of a run: .sph and .fv with x, u, p; .computed marks the cells solved for."""

    def __init__(self, run, index=-1, moments=None):
        moments = moments or Moments(run.out)
        self.time = moments.times()[index]
        parts = moments.at(self.time)
        self.sph, self.fv = parts.get("sph"), parts.get("fv")
        self.computed = None
        if self.fv is not None:
            n = len(self.fv.x)
            self.computed = np.ones(n, bool) if self.fv.status is None else self.fv.status == COMPUTED


def moments(run):
    shared = Moments(run.out)
    return [Moment(run, i, shared) for i in range(len(shared.times()))]


def interpolate(x, values, targets, radius):
    """First-order fit of scattered values about each target (planar: x and z), NaN where too few are near."""
    result = np.full(len(targets), np.nan)
    for i, target in enumerate(targets):
        d = x[:, [0, 2]] - target[[0, 2]]
        near = np.hypot(d[:, 0], d[:, 1]) < radius
        if near.sum() < 6:
            continue
        weight = np.sqrt(1 - np.hypot(*d[near].T) / radius)
        matrix = np.column_stack([np.ones(near.sum()), d[near]]) * weight[:, None]
        result[i] = np.linalg.lstsq(matrix, values[near] * weight, rcond=None)[0][0]
    return result


def differences(moment, face, below=2.0):
    """p and velocity of the particles less those of the cells, in the rows within `below` cells under z = face.

    There the particles are nearly free (the outer part of their blending layer follows the grid) and the cells are
    solved for, so that both describe the same water by their own means.
    """
    dz = np.diff(np.unique(np.round(moment.fv.x[:, 2], 9))).min()
    rows = moment.computed & (moment.fv.x[:, 2] > face - below * dz) & (moment.fv.x[:, 2] < face)
    # whole neighbourhoods only: no particles are output beyond a periodic end
    rows &= np.abs(moment.fv.x[:, 0] - moment.fv.x[:, 0].mean()) < 0.5 * (np.ptp(moment.fv.x[:, 0]) - 6 * dz)
    targets = moment.fv.x[rows]
    near = np.abs(moment.sph.x[:, 2] - face) < (below + 4) * dz
    x = moment.sph.x[near]
    dp = interpolate(x, moment.sph.p[near], targets, 3 * dz) - moment.fv.p[rows]
    du = [interpolate(x, moment.sph.u[near, axis], targets, 3 * dz) - moment.fv.u[rows, axis] for axis in (0, 2)]
    if not np.isfinite(dp).all():
        raise UserError(f"t = {moment.time:g} s: cells at the interface without particles around them")
    return dp, np.concatenate(du)


def jumps(run, below=2.0, scale_p=None, scale_u=None, moments_used=8):
    """Rms of the differences at the lower face over the last outputs, over rho g a and a omega (or the scales given)."""
    wave = run.summary.get("reference") or {}
    scale_p = scale_p or wave["density"] * wave["gravity"] * wave["amplitude"]
    scale_u = scale_u or wave["amplitude"] * np.sqrt(wave["gravity"] * wave["wavenumber"])
    face = run.summary["regions"][0]["lower"][2]
    both = [differences(moment, face, below) for moment in moments(run)[-moments_used:]]
    dp, du = (np.concatenate(parts) for parts in zip(*both))
    return {"p": signals.rms(dp) / scale_p, "u": signals.rms(du) / scale_u, "p_mean": float(dp.mean()) / scale_p}


def ledger(run):
    """Largest |defect| of the particles' mass budget over the mass, from the particles' scalars.csv."""
    scalars = run.sph.scalars
    name = next((n for n in scalars.names if "defect" in n), None) or next(
        (n for n in scalars.names if "ledger" in n), None)
    if name is None:
        raise UserError(f"{run.sph.folder}/scalars.csv has no column of the ledger's defect")
    return float(np.abs(scalars[name]).max() / scalars["mass"].max())


def smallest_spacing(x, period=None):
    """Smallest distance of two points, periodic along x."""
    from scipy.spatial import cKDTree
    points = x[:, [0, 2]].copy()
    if period:
        points[:, 0] %= period
        copies = points[points[:, 0] < 0.1 * period] + [period, 0]
        points = np.vstack([points, copies])
    return float(cKDTree(points).query(points, k=2)[0][:, 1].min())
