"""Forces on a cylinder under the surface of a stream, Fr = 1, Re = 180, h/d = 1.5, beside those of the paper's Table 1."""

import numpy as np
from lib import submerged_cylinder


def check(case):
    run = case.run(case.folder / "scene", solver="fv")
    submerged_cylinder.forces(case, run)
    s = run.fv.scalars
    case.metric("volume's error, part of the water", np.abs(s["volume_error"]).max() / s["water_volume"][0], below=5e-3)
    submerged_cylinder.picture(run, case.out / "vorticity.png")
