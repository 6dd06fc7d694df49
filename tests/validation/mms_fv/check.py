"""Order of accuracy on skewed, stretched, curved grids against a manufactured solution."""

import importlib.util
import math
import pathlib

import numpy as np
from lib import grid

_spec = importlib.util.spec_from_file_location("mms_flow", pathlib.Path(__file__).with_name("flow.py"))
flow = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(flow)

NU = 0.02
MACH2 = 0.04  # 1/c^2 with U = 1: c = 5


def value(field, points, time):
    names = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2], "t": time, "sin": np.sin, "cos": np.cos}
    return eval(str(field), {"__builtins__": {}}, names)  # the formula that the program reads, too


def error(run, p, u, level_is_free):
    """L2 errors of the velocity and of p. With c infinite only one face, weakly, holds the level of p: without its mean."""
    last = run.fv.snapshots[-1]
    x, t = last.points, last.time
    found = last["velocity"]
    square = sum((found[:, "xyz".index(a)] - value(f, x, t)) ** 2 for a, f in u.items())
    difference = last["pressure"] - value(p, x, t)
    return math.sqrt(square.mean()), math.sqrt(((difference - level_is_free * difference.mean()) ** 2).mean())


def outer_faces(scene, axes):
    """(block, face) of all faces on the outside of the box."""
    if scene != "joined":
        return [(0, f"{a}_{side}") for a in axes for side in ("lower", "upper")]
    return [(b, face) for b in range(4)
            for face in (("x_upper" if b % 2 else "x_lower"), ("z_upper" if b // 2 else "z_lower"))]


def solve(case, scene, n, unsteady, inverse_c2, dt, end, name, *more):
    """One run; returns it with the exact p and u."""
    dimension = 3 if scene == "spatial" else 2
    p, u, sources = flow.settings(dimension, unsteady, inverse_c2, NU)
    keys = [f"scene.time.end={end}", f"fv.time.dt={dt}",
            "scene.fluid.sound_speed=" + (".inf" if inverse_c2 == 0 else repr(inverse_c2 ** -0.5)),
            f"scene.initial.p={p}"]
    count = n // 2 if scene == "joined" else n
    for b in range(4 if scene == "joined" else 1):
        keys.append(f"fv.blocks[{b}].cells=[{count},{count if dimension == 3 else 1},{count}]")
    for b, face in outer_faces(scene, u):
        # velocity given on the faces; p on one only: given on all, it is one condition too many, and the order of p drops
        if face == "x_upper":
            keys += [f"fv.blocks[{b}].faces.{face}.condition=state", f"fv.blocks[{b}].faces.{face}.p={p}"]
        else:
            keys.append(f"fv.blocks[{b}].faces.{face}.condition=inflow")
        keys += [f"fv.blocks[{b}].faces.{face}.{flow.VELOCITY[a]}={field}" for a, field in u.items()]
    keys += [f"scene.initial.{flow.VELOCITY[a]}={field}" for a, field in u.items()]
    keys += [f"fv.{key}={formula}" for key, formula in sources.items()]
    return case.run(case.folder / scene, set=keys + list(more), name=name, solver="fv"), p, u


def check(case):
    rows = []
    for scene, levels in (("planar", (16, 32, 64)), ("joined", (16, 32, 64)), ("spatial", (8, 16, 32))):
        for kind, unsteady, inverse_c2 in (("steady", False, 0.0), ("unsteady", True, 0.0),
                                           ("unsteady, c = 5", True, MACH2)):
            if scene == "joined" and inverse_c2:
                continue
            errors = []
            for n in levels:
                # steady: long steps until nothing moves; unsteady: dt in proportion to h
                dt, end = (2.0, 20.0) if not unsteady else (0.4 / n, 0.4)
                errors.append(error(*solve(case, scene, n, unsteady, inverse_c2, dt, end,
                                           f"{scene}_{kind[:8]}_{inverse_c2}_{n}"), inverse_c2 == 0))
            for q, quantity in enumerate(("u", "p")):
                orders = grid.order([e[q] for e in errors])
                rows.append([scene, kind, quantity] + [e[q] for e in errors] + orders)
                case.metric(f"{scene}, {kind}: order of {quantity}", orders[-1], at_least=1.8)
    case.table("Errors on three levels (planar and joined 16-64, spatial 8-32)",
               ["grid", "flow", "of", "coarse", "middle", "fine", "order", "order"], rows)

    # time alone: differences between successive halvings of dt on one grid. kappa = 0, since kappa h/dt ties the
    # dissipation of p to dt; what that makes of the ratio is recorded
    for kappa, gate in ((0, {"between": (3.5, 4.3)}), (0.5, {})):
        finals = [solve(case, "planar", 16, True, MACH2, 0.8 / steps, 0.8, f"bdf2_{steps}_{kappa}",
                        f"fv.dual_time.kappa={kappa}", "fv.dual_time.drop=1e-7")[0].fv.snapshots[-1]["velocity"]
                  for steps in (20, 40, 80)]
        ratio = np.abs(finals[0] - finals[1]).max() / np.abs(finals[1] - finals[2]).max()
        case.metric(f"BDF2: ratio of differences, kappa = {kappa}", ratio, **gate)
