"""Spurious velocity and pressure step of water at rest (prototype: 1e-4 sqrt(gH) and 3e-5 rho g H on a lattice)."""

import numpy as np
from lib import coupled


def check(case):
    run = case.run("configs/still_water", set=["scene.constants.n=25", "scene.time.end=4"])
    last = coupled.Moment(run, -1)
    case.metric("largest speed of particles / sqrt(gH)", np.linalg.norm(last.sph.u, axis=1).max(), below=5e-3)
    case.metric("largest speed of cells / sqrt(gH)", np.linalg.norm(last.fv.u[last.computed], axis=1).max(), below=5e-3)
    jump = coupled.jumps(run, below=2.0, scale_p=1000.0, scale_u=1.0)
    case.metric("pressure step / (rho g H)", jump["p"], below=1e-3)
    case.metric("mean pressure step / (rho g H)", jump["p_mean"], between=(-1e-3, 1e-3))
    mass = run.scalars["mass"]
    case.metric("mass change", mass[-1] / mass[0] - 1, between=(-1e-4, 1e-4))
