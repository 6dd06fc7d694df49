"""A stream that swings to and fro through a box open on all sides: every face lets water in, then out.

The formula is incompressible, the particles are not: the water they should let in or out to follow the pressure is of
second order in the Mach number, and so must be their error of u; that of p is rho c times it, of first order.
"""

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.spatial import cKDTree

DX, RHO, U, MIDDLE = 0.05, 1000.0, 1.0, 0.6
W = U / (12 * DX)


def errors(run):
    """Greatest rms errors of u / U and p / (rho U^2), smallest spacing / dx, over all moments but the first."""
    u_rms, p_rms, spacing = 0.0, 0.0, np.inf
    for s in run.sph.snapshots[1:]:
        x = s.points
        u = np.sin(W * s.time) * np.array([U, 0, 0.6 * U])
        p = -RHO * W * U * np.cos(W * s.time) * ((x[:, 0] - MIDDLE) + 0.6 * (x[:, 2] - MIDDLE))
        u_rms = max(u_rms, signals.rms(np.linalg.norm(s["velocity"] - u, axis=1)) / U)
        p_rms = max(p_rms, signals.rms(np.ravel(s["pressure"]) - p) / (RHO * U**2))
        spacing = min(spacing, cKDTree(x).query(x, k=2)[0][:, 1].min() / DX)
    return u_rms, p_rms, spacing


def check(case):
    rows, found = [], {}
    for c, periods in ((10, 6), (20, 2)):
        run = case.run(case.folder, name=f"c{c}", solver="sph",
                       set=[f"scene.fluid.sound_speed={c}", f"scene.time.end={periods * 2 * np.pi / W}"])
        u, p, spacing = found[c] = errors(run)
        n, last = run.sph.scalars["n_particles"], run.sph.scalars
        change = np.abs(n / n[0] - 1).max()
        faces = [last[f"n_{what}_{face}"][-1] for what in ("injected", "removed")
                 for face in ("x_lower", "x_upper", "z_lower", "z_upper")]
        rows.append([c, u, p, spacing, change, *faces, run.seconds])
        case.metric(f"c = {c}: ledger / mass", coupled.ledger(run), below=1e-12)
        case.metric(f"c = {c}: smallest spacing / dx", spacing, above=0.6)
        case.metric(f"c = {c}: largest change of the number of particles", change, below=0.05)
        case.metric(f"c = {c}: fewest particles in or out of a face", min(faces), above=100)
        case.metric(f"c = {c}: rms error of u / U", u)
        case.metric(f"c = {c}: rms error of p / (rho U^2)", p)
    case.metric("error of u at c = 10 over that at c = 20", found[10][0] / found[20][0], above=3)
    case.metric("error of p at c = 10 over that at c = 20", found[10][1] / found[20][1], above=1.8)
    case.table("Swinging stream", ["c", "u rms", "p rms", "spacing", "dN/N", "in x-", "in x+", "in z-", "in z+", "out x-",
                                   "out x+", "out z-", "out z+", "wall s"], rows)
