"""C8, the particles' half: still water whose surface crosses the layers of a region open to both sides.

The grid side is the hydrostatic formula, so that what moves is the particles' doing alone.
"""

import numpy as np
from lib import coupled

N, LEVEL = 25, 0.0
DX = 1.0 / N


def heights(points):
    """Top of the water in columns of one spacing, from the highest particle's centre [dx above the level]."""
    column = np.floor(points[:, 0] / DX + 1e-6).astype(int)
    return np.array([points[column == c, 2].max() + DX / 2 - LEVEL for c in np.unique(column)]) / DX


def check(case):
    run = case.run(case.folder, solver="sph")
    snapshots = run.sph.snapshots
    last = snapshots[-1]
    x, p = last.points, np.ravel(last["pressure"])
    speed = max(np.linalg.norm(s["velocity"], axis=1).max() for s in snapshots)
    case.metric("largest speed of particles / sqrt(gH)", speed, below=1e-2)
    top = heights(x)
    case.metric("largest step of the surface / dx", np.abs(np.diff(top)).max(), below=0.5)
    case.metric("largest error of the level / dx", np.abs(top).max(), below=0.5)
    # first-order fit at points of the interior, from half a spacing under the surface on down
    grid = [[a, 0, b] for a in np.arange(DX / 2, 24 * DX, DX) for b in np.arange(-DX / 2, -1, -DX)]
    target = np.array(grid)
    dp = coupled.interpolate(x, p, target, 3 * DX) + 1000 * target[:, 2]
    case.metric("pressure error, corrected / (rho g dx)", np.abs(dp).max() / (1000 * DX), below=0.3)
    case.metric("pressure error of particles / (rho g dx)", np.abs(p + 1000 * x[:, 2]).max() / (1000 * DX))
    n = run.sph.scalars["n_particles"]
    case.metric("largest change of the number of particles", np.abs(n / n[0] - 1).max(), below=1e-3)
    case.metric("ledger / mass", coupled.ledger(run), below=1e-12)
