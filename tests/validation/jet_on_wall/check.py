"""A strip of water hits a wall: its force and the pressure along the wall against the exact free jet."""

import numpy as np
from littoral_lib import exact

PLACES = ("0.25", "0.5", "1", "1.5", "2", "2.5")  # over the thickness b
FROM = 8.0                                        # b/U: the wedge in front has passed twice


def errors(gauges, kind, late):
    return np.array([np.mean(gauges[f"{kind}_{z}.p"][late]) / 1000 - exact.jet_on_wall(float(z)) for z in PLACES])


def check(case):
    rows = []
    for n in (5, 10, 20):
        run = case.run(case.folder / "scene", set=[f"scene.constants.n={n}"], name=f"n{n}", solver="sph")
        late, rows_late = run.sph.gauges["time"] > FROM, run.sph.scalars["time"] > FROM
        force = float(np.mean(run.sph.scalars["wall.fx"][rows_late])) / 1000
        pushed, held = (errors(run.sph.gauges, kind, late) for kind in ("force", "pressure"))
        rms = [float(np.sqrt(np.mean(e**2))) for e in (pushed, held)]
        rows.append([n, force, *rms, *np.round(pushed, 3)])
        case.metric(f"b/dx={n}: force over rho U^2 b", force, between=(0.9, 1.05))
        if n > 5:
            case.metric(f"b/dx={n}: rms error of the wall's pressure by force, over rho U^2", rms[0], below=0.05)
        else:
            case.metric(f"b/dx={n}: rms error of the wall's pressure by force, over rho U^2", rms[0])
        case.metric(f"b/dx={n}: the same of the particles' pressure", rms[1])
    case.table("Jet on a wall: errors over rho U^2", ["b/dx", "force", "rms by force", "rms by particles", *PLACES], rows)
