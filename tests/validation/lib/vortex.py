"""Taylor's vortex in a stream: its exact flow, and what a run has made of it (vortex_coupled and its choices).

Particles and cells are judged alike: the velocities where a solver is the water's own one (particles inside the region,
computed cells outside) go through one local fit that gives the vorticity, and so do the exact velocities at the same
points. What the fit smoothes is thus no error of the run.
"""

import dataclasses

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.sparse import coo_matrix
from scipy.spatial import cKDTree


class Taylor:
    """G. I. Taylor's decaying vortex without circulation, exact for Navier-Stokes in the unbounded plane.

    Swirl s = V r / l (l/a)^4 exp((1 - r^2/a^2)/2) with a^2 = l^2 + 2 nu t, times a constant that makes s(l) = V at t = 0.
    """

    def __init__(self, constants, density=1000.0):
        self.rho, self.l, self.V = density, constants["l"], constants["V"]
        self.U, self.nu, self.start = constants["U"], constants["nu"], constants["start"]

    def centre(self, t):
        return np.array([self.start + self.U * t, 0.0])

    def radius(self, t):
        return np.sqrt(self.l**2 + 2 * self.nu * t)

    def _rate(self, x, t):
        """Angular velocity [1/s] at x, and x from the centre."""
        a, d = self.radius(t), x - self.centre(t)
        r2 = (d**2).sum(axis=1)
        return self.V / self.l * (self.l / a) ** 4 * np.exp(0.5 - 0.5 * r2 / a**2), d

    def velocity(self, x, t):
        rate, d = self._rate(x, t)
        return np.column_stack([self.U - rate * d[:, 1], rate * d[:, 0]])

    def pressure(self, x, t):
        """dp/dr = rho s^2/r: -rho a^2/2 times the angular velocity squared."""
        return -0.5 * self.rho * self.radius(t) ** 2 * self._rate(x, t)[0] ** 2

    def level(self, t, area):
        """Mean of p - exact p in a closed domain of this area, over rho U^2: the mean of p stays, that of the exact one does not."""
        lost = 1 - (self.l / self.radius(t)) ** 4
        return -0.5 * np.e * np.pi * self.V**2 * self.l**2 * lost / area / self.U**2


class Fit:
    """First-order weighted fit about each point: (w_ij) such that the derivative along an axis is sum_j w_ij u_j."""

    def __init__(self, x, radius):
        tree, n = cKDTree(x), len(x)
        pairs = tree.query_pairs(radius, output_type="ndarray")
        i = np.concatenate([pairs[:, 0], pairs[:, 1], np.arange(n)])
        j = np.concatenate([pairs[:, 1], pairs[:, 0], np.arange(n)])
        d = x[j] - x[i]
        weight = (1 - np.hypot(*d.T) / radius).clip(0) ** 2
        basis = np.column_stack([np.ones(len(d)), d])
        matrices = np.zeros((n, 3, 3))
        for a in range(3):
            for b in range(3):
                matrices[:, a, b] = np.bincount(i, weight * basis[:, a] * basis[:, b], n)
        inverse = np.linalg.inv(matrices)
        parts = np.einsum("kab,kb->ka", inverse[i], basis) * weight[:, None]
        self.along = [coo_matrix((parts[:, a], (i, j)), (n, n)).tocsr() for a in (1, 2)]

    def vorticity(self, u):
        """dw/dx - du/dz."""
        return self.along[0] @ u[:, 1] - self.along[1] @ u[:, 0]


@dataclasses.dataclass
class Points:
    """The water's points at a moment, each of the solver to which it belongs there: x, u (x and z), p, area."""

    time: float
    x: np.ndarray
    u: np.ndarray
    p: np.ndarray
    area: np.ndarray
    particle: np.ndarray


def points(moment, half, cell, centre, period):
    """Particles inside the region and the cells outside (half None: all of the one solver), the vortex in their middle."""
    found = []
    for part, own in ((moment.sph, True), (moment.fv, False)):
        if part is None:
            continue
        x = part.x[:, [0, 2]]
        mask = np.ones(len(x), bool)
        if half is not None:
            mask = (np.abs(x) < half).all(axis=1) == own
        area = np.ravel(part.snapshot["volume"]) if own else np.full(len(x), cell**2)
        found.append([x[mask], part.u[mask][:, [0, 2]], part.p[mask], area[mask], np.full(mask.sum(), own)])
    at = Points(moment.time, *(np.concatenate(columns) for columns in zip(*found)))
    at.x[:, 0] = centre[0] + (at.x[:, 0] - centre[0] + 0.5 * period) % period - 0.5 * period
    return at


class Measure:
    """Of one moment: errors against the exact flow and what is left of the vortex. Lengths in dx, p over rho U^2."""

    def __init__(self, at, exact, dx, radius=None):
        self.time, self.at, self.position = at.time, at, exact.centre(at.time)
        a, u_exact = exact.radius(at.time), exact.velocity(at.x, at.time)
        error = np.linalg.norm(at.u - u_exact, axis=1)
        # L2, over that of the speed V on the core's disc: the same whatever the domain's size
        self.u_error = np.sqrt((error**2 * at.area).sum() / (np.pi * exact.l**2)) / exact.V
        dp = at.p - exact.pressure(at.x, at.time)
        self.level = np.average(dp, weights=at.area) / (exact.rho * exact.U**2) - exact.level(at.time, at.area.sum())
        # a periodic flow has its pressure but for a constant
        self.dp = (dp - np.average(dp, weights=at.area)) / (exact.rho * exact.U**2)
        self.p_rms = signals.rms(self.dp)
        self.p_most = np.abs(self.dp).max()
        near = np.linalg.norm(at.x - self.position, axis=1) < 2.5 * a
        self.p_core = signals.rms(self.dp[near])
        fit = Fit(at.x, radius or 3 * dx)
        self.w, self.w_exact = fit.vorticity(at.u), fit.vorticity(u_exact)
        self.enstrophy = (self.w**2 * at.area)[near].sum() / (self.w_exact**2 * at.area)[near].sum()
        self.lag = (self.core(self.w) - self.core(self.w_exact)) / dx  # (x, z)
        self.peak = self.top(self.w, a) / self.top(self.w_exact, a)

    def core(self, w):
        """Centroid of the vorticity above half of its most."""
        weight = (w - 0.5 * w.max()).clip(0) * self.at.area
        return (weight[:, None] * self.at.x).sum(axis=0) / weight.sum()

    def top(self, w, a):
        """Vorticity at the centre, over a third of the core: the mean of what may be uneven from particle to particle."""
        d = np.linalg.norm(self.at.x - self.core(w), axis=1)
        weight = (1 - d / (a / 3)).clip(0) * self.at.area
        return (weight * w).sum() / weight.sum()


class History:
    """All moments of a run (t > 0), columns by name, and what changed while the centre went from one place to another."""

    def __init__(self, run, exact, dx, half=None, cell=None, period=18.0, fit=None):
        self.run, self.moments = run, []
        for moment in coupled.moments(run):
            if moment.time > 0:
                at = points(moment, half, cell or dx, exact.centre(moment.time), period)
                self.moments.append(Measure(at, exact, dx, fit))
        for name in ("time", "u_error", "level", "p_rms", "p_core", "p_most", "enstrophy", "peak"):
            setattr(self, name, np.array([getattr(m, name) for m in self.moments]))
        self.x = np.array([m.position[0] for m in self.moments])
        self.lag = np.array([m.lag for m in self.moments])

    def between(self, values, start, end):
        """Change of a column from the centre at x = start to x = end."""
        first, last = (int(np.argmin(np.abs(self.x - x))) for x in (start, end))
        return values[last] - values[first]

    def rows(self):
        return [[float(v) for v in (m.time, m.position[0], *m.lag, m.peak, m.enstrophy, m.u_error, m.p_rms, m.p_core, m.p_most,
                                    m.level)] for m in self.moments]


HEADER = ["t", "x", "lag x / dx", "lag z / dx", "peak", "enstrophy", "error of u", "p rms / (rho U^2)", "p rms, vortex",
          "p most", "level"]


def picture(history, path, places, half):
    """Vorticity where the centre is closest to `places` (x), and along the stream through the centre against the exact one."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, len(places), figsize=(6 * len(places), 9))
    for (above, below), place in zip(axes.T, places):
        m = history.moments[int(np.argmin(np.abs(history.x - place)))]
        x, z = m.at.x.T
        size = (72 * 0.75 * 6 / 7 * np.sqrt(m.at.area)) ** 2
        above.scatter(x, z, c=m.w, s=size, marker="s", cmap="RdBu_r", vmin=-3, vmax=3, linewidths=0, rasterized=True)
        above.plot([-half, half, half, -half, -half], [-half, -half, half, half, -half], "k--", lw=0.6)
        above.set(title=f"vorticity, t = {m.time:.3g}", aspect="equal", xlim=m.position[0] + np.array([-3.5, 3.5]), ylim=(-3.5, 3.5))
        row = np.abs(z) < np.sqrt(m.at.area)
        for own, name, mark in ((True, "particles", "r."), (False, "cells", "b.")):
            mine = row & (m.at.particle == own)
            below.plot(x[mine], m.w[mine], mark, ms=4, label=name)
        order = np.argsort(x[row])
        below.plot(x[row][order], m.w_exact[row][order], "k-", lw=0.6, label="exact, at the same places")
        below.axvline(-half, ls="--", c="k", lw=0.6)
        below.axvline(half, ls="--", c="k", lw=0.6)
        below.set(xlim=m.position[0] + np.array([-3.5, 3.5]), xlabel="x", title="within a spacing of z = 0")
        below.legend(fontsize=8)
    figure.savefig(path, dpi=90, bbox_inches="tight")
