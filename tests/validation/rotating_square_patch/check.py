"""Pressure at the centre early, and shape, area and angular momentum of the spinning square until w t = 1."""

import numpy as np
from lib import water
from littoral_lib import exact

SIDE, RATE, DENSITY = 1.0, 1.0, 1000.0  # of scene.yaml
EARLY = 0.2 / RATE  # [s]: more than a crossing by sound; the exact pressure changes by 1% until then


def check(case):
    rows = []
    exact_centre = float(exact.square_patch_pressure(0.0, 0.0, SIDE, RATE, DENSITY))
    for n in (50, 100):
        run = case.run(case.folder / "scene", set=[f"scene.constants.n={n}"], name=f"n{n}", solver="sph")
        gauges = run.sph.gauges
        early = gauges["time"] <= EARLY
        pressure = np.abs(gauges["centre.p"][early] / exact_centre - 1).max()
        snapshots = run.sph.snapshots
        bodies = [water.Body(s) for s in snapshots]
        area = max(abs(b.area() / bodies[0].area() - 1) for b in bodies)
        angular = max(abs(b.angular_momentum / bodies[0].angular_momentum - 1) for b in bodies)
        hole_count = sum(len(water.holes(s, SIDE / n, 4 * SIDE / n)) for s in snapshots)
        rows.append([n, pressure, area, angular, hole_count, run.seconds])
        case.metric(f"L/dx={n}: pressure at the centre", pressure, below=0.03, unit="of exact, w t <= 0.2")
        case.metric(f"L/dx={n}: area", area, below=0.01)
        case.metric(f"L/dx={n}: angular momentum", angular, below=0.005)
        case.metric(f"L/dx={n}: holes", hole_count, at_most=0)
    # under tension for long, with nothing else that keeps particles apart: neither shifting nor the dissipation of (12)
    for tension in ("plain", "switched"):
        run = case.run(case.folder / "scene", set=["scene.time.end=3", "sph.riemann=low_dissipation",
                       "sph.shifting.enabled=false", f"sph.tension={tension}"], name=tension, solver="sph")
        most = max(len(water.holes(s, SIDE / 50, 4 * SIDE / 50)) for s in run.sph.snapshots)
        case.metric(f"w t <= 3, bare, tension {tension}: most holes", most, **({"at_most": 0} if tension == "switched" else {}))
    case.table("Rotating square patch", ["L/dx", "p(centre)", "area", "angular momentum", "holes", "wall s"], rows)
