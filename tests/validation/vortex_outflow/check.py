"""What is left of the flow's disturbance after a vortex has left, against the same vortex on a grid twice as long."""

import numpy as np
from lib import grid

SWIRL = 0.3  # largest velocity of the vortex over U
OUTLET = "fv.blocks[0].faces.x_upper"
CONDITIONS = {
    "convective": [],
    "outflow": [f"{OUTLET}.condition=outflow"],
    "far_field": [f"{OUTLET}.condition=far_field"],
    "far_field with sponge": [f"{OUTLET}.condition=far_field",
                              "fv.sponges=[{axis: x, from: 7, to: 10, rate: 2, u: U}]"],
}


def check(case):
    def run(name, *settings):
        done = case.run(case.folder / "scene", set=list(settings), name=name.replace(" ", "_"), solver="fv")
        return [(s.time, grid.Planar(s)) for s in done.fv.snapshots], done

    reference, _ = run("long", "scene.constants.length=20")
    inside = reference[0][1].x[0] < 10.0
    rows = []
    for name, settings in CONDITIONS.items():
        moments, done = run(name, *settings)
        worst_while = worst_after = 0.0
        for (t, g), (_, r) in zip(moments, reference):
            # the last three radii before the outlet are where a sponge may change the flow
            away = g.x[0] < 7.0
            error = np.hypot(g.u - r.u[:, inside], g.w - r.w[:, inside])[:, away].max() / SWIRL
            if t >= 9.0:  # the centre left at t = 5, the last of the core at t = 8
                worst_after = max(worst_after, error)
            else:
                worst_while = max(worst_while, error)
        rows.append([name, worst_while, worst_after, done.fv.summary["results"]["inner_cycles_per_step"]])
        if name == "convective":
            case.metric("convective: error after the vortex has left, of its swirl", worst_after, below=0.01)
            case.metric("convective: error while it leaves, three radii upstream", worst_while, below=0.03)
    case.table("Velocity error three radii upstream of the outlet, of the vortex's largest velocity",
               ["condition", "while it leaves", "after", "cycles a step"], rows)
    others = min(row[2] for row in rows if row[0] == "outflow")
    case.metric("convective over outflow, after", rows[0][2] / others, below=1.0)
