"""C8: still water in a closed tank, the particles' box upright in its middle, forced cells under it."""

import numpy as np
from lib import coupled

N, PERIOD = 20, 3.55  # spacings over the depth; of the longest standing wave in a box of this size [sqrt(H/g)]
DX = 1.0 / N


def check(case):
    run = case.run(case.folder / "scene")
    particles = run.sph.snapshots
    case.metric("largest speed of particles / sqrt(gH)", run.sph.scalars["largest_speed"].max(), below=1e-2)
    case.metric("the same at the end", np.linalg.norm(particles[-1]["velocity"], axis=1).max())
    last = particles[-1]
    x, p = last.points, np.ravel(last["pressure"])
    inside = np.ravel(last["zone"]) == 0
    grid = np.array([[a, 0, b] for a in np.arange(x[inside, 0].min(), x[inside, 0].max(), DX)
                     for b in np.arange(-DX / 2, -1, -DX)])
    still = 1e5 * np.expm1(-grid[:, 2] / 100)
    case.metric("pressure error, corrected / (rho g dx)",
                np.abs(coupled.interpolate(x, p, grid, 3 * DX) - still).max() / (1000 * DX), below=0.3)
    g = run.fv.gauges
    level = {name: g[name] / DX for name in g.names if name != "time"}
    late = g["time"] > 0.25 * g["time"][-1]
    slope = {name: np.polyfit(g["time"][late], e[late], 1)[0] * PERIOD for name, e in level.items()}
    case.metric("slope of the level a period / dx", max(np.abs(list(slope.values()))), below=0.01)
    case.metric("largest step of the surface, face against outside / dx",
                np.abs(level["face.elevation"] - level["left.elevation"]).max(), below=0.5)
    sph = run.sph.scalars
    case.metric("net mass through the open faces / mass", np.abs(sph["mass_flux"]).max() / sph["mass"][0], below=1e-3)
    n = sph["n_particles"]
    case.metric("largest change of the number of particles", np.abs(n / n[0] - 1).max(), below=1e-3)
    case.metric("ledger / mass", coupled.ledger(run), below=1e-12)
