"""Cylinder at Re = 100 in one O-grid: drag, lift, shedding; inner cycles also with a first cell of 1e-5 d."""

import numpy as np


def shedding(t, lift):
    """Frequency by the upward zero crossings of the lift."""
    up = np.flatnonzero((lift[:-1] < 0) & (lift[1:] >= 0))
    at = t[up] - lift[up] * (t[up + 1] - t[up]) / (lift[up + 1] - lift[up])
    return (len(at) - 1) / (at[-1] - at[0])


def check(case):
    run = case.run(case.folder / "scene", name="re100", solver="fv")
    s = run.fv.scalars
    t = s["time"]
    late = t > 90
    drag, lift = 2 * s["cylinder.fx"][late], 2 * s["cylinder.fz"][late]
    case.metric("C_D", drag.mean(), between=(0.97 * 1.33, 1.03 * 1.35))
    case.metric("C_L amplitude", (lift.max() - lift.min()) / 2, between=(0.97 * 0.32, 1.03 * 0.34))
    case.metric("Strouhal number", shedding(t[late], lift), between=(0.97 * 0.164, 1.03 * 0.166))
    case.metric("C_D, fourth difference over its mean", abs(np.diff(drag, 4)).max() / drag.mean(), below=1e-4)
    case.metric("cycles a step to three orders", s["cycles"][t > 20].mean(), at_most=6)
    case.metric("microseconds a cell and step", run.fv.summary["results"]["microseconds_per_cell_and_step"])

    fine = case.run(case.folder / "scene", name="thin", solver="fv",
                    set=["scene.constants.Re=1800", "fv.rings[0].spacing.first_cell=1e-5*d", "fv.time.dt=0.0125*d/U",
                         "scene.time.end=6*d/U"])
    s = fine.fv.scalars
    case.metric("cycles a step, first cell 1e-5 d, Re = 1800", s["cycles"][s["time"] > 1].mean(), at_most=9)
    rows = [[name, int(len(c) - 1), round(float(c.mean()), 2), int(c.max()),
             round(r.fv.summary["results"]["microseconds_per_cell_and_step"], 2)]
            for name, r in (("Re 100, 3e-3 d", run), ("Re 1800, 1e-5 d", fine))
            for c in (r.fv.scalars["cycles"][1:],)]
    case.table("Inner iteration", ["case", "steps", "cycles a step", "most", "us a cell and step"], rows)
