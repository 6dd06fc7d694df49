"""Cylinder at Re = 100 in one O-grid: drag, lift, shedding; inner cycles also with first cells of 1e-5 and 2e-6 d; no mark
of dt, beta and pseudo-time on the drag."""

import numpy as np
from littoral_lib import signals


def steady_drag(case, name, *settings):
    """C_D at Re = 40, t U/d = 60, on a coarse ring."""
    run = case.run(case.folder / "scene", name=name, solver="fv",
                   set=["scene.constants.Re=40", "scene.time.end=60*d/U", "fv.rings[0].around=64", "fv.rings[0].outward=48",
                        "fv.rings[0].spacing.first_cell=1e-2*d", "fv.output.fields=false", *settings])
    return float(2 * run.fv.scalars["cylinder.fx"][-1])


def check(case):
    run = case.run(case.folder / "scene", name="re100", solver="fv")
    s = run.fv.scalars
    t = s["time"]
    drag = 2 * s["cylinder.fx"]
    found = signals.shedding(t, drag, 2 * s["cylinder.fz"], 90)
    case.metric("C_D", found["drag"], between=(0.97 * 1.33, 1.03 * 1.35))
    case.metric("C_L amplitude", found["amplitude"], between=(0.97 * 0.32, 1.03 * 0.34))
    case.metric("Strouhal number", found["frequency"], between=(0.97 * 0.164, 1.03 * 0.166))
    case.metric("C_D, fourth difference over its mean", abs(np.diff(drag[t > 90], 4)).max() / found["drag"], below=1e-4)
    case.metric("cycles a step to three orders", s["cycles"][t > 20].mean(), at_most=6)
    case.metric("microseconds a cell and step", run.fv.summary["results"]["microseconds_per_cell_and_step"])

    thin = []
    for first, reynolds, aspect in (("1e-5", 1800, 2450), ("2e-6", 18000, 12300)):
        fine = case.run(case.folder / "scene", name=f"thin_{first}", solver="fv",
                        set=[f"scene.constants.Re={reynolds}", f"fv.rings[0].spacing.first_cell={first}*d",
                             "fv.time.dt=0.0125*d/U", "scene.time.end=6*d/U"])
        s = fine.fv.scalars
        case.metric(f"cycles a step, aspect {aspect}, Re = {reynolds}", s["cycles"][s["time"] > 1].mean(), at_most=9)
        thin.append((f"Re {reynolds}, {first} d", fine))

    base = ["fv.time.dt=0.05*d/U"]
    drags = {"dt": steady_drag(case, "dt", *base), "dt / 4": steady_drag(case, "dt_quarter", "fv.time.dt=0.0125*d/U"),
             "dt x 4": steady_drag(case, "dt_x4", "fv.time.dt=0.2*d/U"),
             "beta / 2": steady_drag(case, "beta_half", *base, "fv.dual_time.pseudo_sound_speed=0.70710678*U"),
             "beta x 2": steady_drag(case, "beta_double", *base, "fv.dual_time.pseudo_sound_speed=1.41421356*U")}
    for name, drag in drags.items():
        if name != "dt":
            case.metric(f"Re 40: C_D with {name} over C_D", drag / drags["dt"], between=(0.998, 1.002))
    rows = [[name, int(len(c) - 1), round(float(c.mean()), 2), int(c.max()),
             round(r.fv.summary["results"]["microseconds_per_cell_and_step"], 2)]
            for name, r in [("Re 100, 3e-3 d", run)] + thin
            for c in (r.fv.scalars["cycles"][1:],)]
    case.table("Inner iteration", ["case", "steps", "cycles a step", "most", "us a cell and step"], rows)
    case.table("Steady drag, Re = 40, ring 64 x 48", ["choice", "C_D"], [[k, v] for k, v in drags.items()])
