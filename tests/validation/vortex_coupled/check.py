"""C10, C15, C21: a vortex through the particles' region, against the exact flow and against each solver alone."""

import numpy as np
from lib import coupled, vortex
from lib import vortex_runs as runs
from lib.grid import order

LEVELS = (5, 7, 10, 13)


def crossings(case, label, h):
    """Gates of C10 that need no other run."""
    for face, span in (("in", runs.ENTRY), ("out", runs.EXIT)):
        case.metric(f"{label}: lag, {face} / dx", np.hypot(*h.between(h.lag, *span)), below=0.5)
        case.metric(f"{label}: change of enstrophy / exact, {face}", h.between(h.enstrophy, *span), between=(-0.05, 0.05))
    case.metric(f"{label}: rms error of p in the vortex / (rho U^2), most", h.p_core.max(), below=0.02)
    case.metric(f"{label}: level of p less that of a closed domain / (rho U^2), most", np.abs(h.level).max(), below=0.02)
    case.metric(f"{label}: largest error of p / (rho U^2)", h.p_most.max())


def loss(h):
    """Of the vorticity at the centre, from before the region to behind it."""
    return -h.between(h.peak, *runs.WHOLE)


def difference(one, other):
    """Of two coupled runs, largest in the cells outside of the region at any moment: of u, of p, over the range then."""
    worst = np.zeros(2)
    for a, b in zip(one.moments, other.moments):
        cells = [~m.at.particle for m in (a, b)]
        du = np.abs(a.at.u[cells[0]] - b.at.u[cells[1]]).max() / np.ptp(runs.EXACT.velocity(a.at.x, a.time)[:, 1])
        p = runs.EXACT.pressure(a.at.x, a.time) / (runs.EXACT.rho * runs.U**2)
        worst = np.maximum(worst, [du, np.abs(a.dp[cells[0]] - b.dp[cells[1]]).max() / np.ptp(p)])
    return worst


def check(case):
    imposed = runs.coupled(case, "imposed")
    dt = float(np.median(imposed.run.fv.scalars["dt"][1:]))
    cells, particles = runs.cells_alone(case, "cells", dt), runs.particles_alone(case, "particles")
    forced = runs.coupled(case, "forced", settings=["scene.coupling.kind=forced"])

    fitted = runs.coupled(case, "corrected", settings=["sph.coupling.samples=corrected"])
    vortex.picture(imposed, case.out / "vorticity.png", (-runs.HALF, 0.0, runs.HALF), runs.HALF)

    worse = max(abs(loss(cells)), abs(loss(particles)))
    for label, h in (("Coupling I", imposed), ("Coupling II", forced)):
        crossings(case, label, h)
        case.metric(f"{label}: loss of the peak over that of the worse solver alone", loss(h) / worse, at_most=1.1)
        case.metric(f"{label}: most of the peak over the exact one", h.peak.max())
        case.metric(f"{label}: ledger / mass", coupled.ledger(h.run), below=1e-12)
    rows = []
    for label, h in (("cells", cells), ("particles", particles), ("Coupling I", imposed), ("Coupling II", forced),
                     ("Coupling I, samples: corrected", fitted)):
        case.table(label, vortex.HEADER, h.rows())
        rows.append([label, *(float(np.hypot(*h.between(h.lag, *s))) for s in (runs.ENTRY, runs.EXIT)), float(loss(h)),
                     *(float(h.between(h.enstrophy, *s)) for s in (runs.ENTRY, runs.EXIT)), float(h.u_error[-1]),
                     float(h.p_core.max()), float(h.level[-1]), h.run.seconds])
    case.table("From 2.5 radii before a face to 2.5 behind it", ["run", "lag in / dx", "lag out", "loss of peak", "enstrophy in",
               "enstrophy out", "error of u at the end", "p rms, vortex", "level of p", "wall s"], rows)

    du, dp = difference(imposed, forced)
    case.metric("C15: largest difference of u in cells, I and II, of its range", du, below=0.02)
    case.metric("C15: largest difference of p in cells, I and II, of its range", dp, below=0.02)

    rows, errors = [], []
    for n in LEVELS:
        h = imposed if n == runs.BASE else runs.coupled(case, f"n{n}", n)
        dt = float(np.median(h.run.fv.scalars["dt"][1:]))
        g = cells if n == runs.BASE else runs.cells_alone(case, f"cells_n{n}", dt, n)
        errors.append(float(h.u_error[-1]))
        rows.append([n, dt * runs.U * n / runs.L, errors[-1], float(h.u_error.max()), float(g.u_error[-1]), float(h.enstrophy[-1]),
                     float(h.p_core.max()), h.run.seconds])
    case.metric("C21: order of the L2 of the error of u, the last two levels", order(errors[-2:], LEVELS[-1] / LEVELS[-2])[0])
    slope = -np.polyfit(np.log(LEVELS), np.log(errors), 1)[0]
    case.metric("C21: order of the L2 of the error of u, all levels", slope, at_least=1)
    case.table("Spacings", ["spacings over the radius", "U dt/dx", "error of u at the end", "most", "cells alone at the end",
               "enstrophy at the end", "p rms, vortex", "wall s"], rows)
