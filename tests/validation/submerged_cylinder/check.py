"""The paper's first scene: a cylinder under a stream whose breaker is of particles, beside the paper's Table 1."""

import numpy as np
from lib import coupled, submerged_cylinder


def check(case):
    run = case.run("configs/submerged_cylinder")
    submerged_cylinder.forces(case, run)
    s, p = run.fv.scalars, run.sph.scalars
    case.metric("volume's error of the cells, part of the water", np.abs(s["volume_error"]).max() / s["water_volume"][0], below=5e-3)
    case.metric("ledger of the particles / mass", coupled.ledger(run), below=1e-12)
    case.metric("smallest, largest number of particles over the first: largest change",
                np.abs(p["n_particles"] / p["n_particles"][0] - 1).max())
    submerged_cylinder.picture(run, case.out / "flow.png", particles=run.sph.snapshots)
