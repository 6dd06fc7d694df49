"""Profiles and wall friction of the two parallel flows."""

import numpy as np
from lib import grid

FLOWS = {"couette": (lambda z: z, 0.1), "poiseuille": (lambda z: 4 * z * (1 - z), 0.4)}  # profile, plate's friction


def check(case):
    rows = []

    def measure(flow, kind, n):
        profile, friction = FLOWS[flow]
        run = case.run(case.folder / flow, solver="fv", name=f"{flow}_{kind}_{n}",
                       set=[f"fv.blocks[0].stretching.z.kind={kind}", f"fv.blocks[0].cells=[4,1,{n}]"])
        g = grid.Planar(run.fv.snapshots[-1])
        rows.append([flow, kind, n, np.abs(g.u - profile(g.z)).max(), run.fv.scalars["plate.fx"][-1] / friction - 1])
        case.metric(f"{flow}, {kind}, {n}: friction over exact - 1", rows[-1][-1], between=(-1e-3, 1e-3))
        return rows[-1][3]

    for flow in FLOWS:
        case.metric(f"{flow}, uniform: largest error of u / U", measure(flow, "uniform", 32), below=1e-3)
    case.metric("couette, geometric: largest error of u / U", measure("couette", "geometric", 32), below=1e-3)
    # cells widening fourfold towards mid-channel: second order in the widest cell, u'' h^2/8
    stretched = [measure("poiseuille", "geometric", n) for n in (16, 32, 64)]
    case.metric("poiseuille, geometric: largest error of u / U at 32", stretched[1])
    case.metric("poiseuille, geometric: order", grid.order(stretched)[-1], between=(1.8, 2.2))
    case.table("Parallel flows", ["flow", "cells", "n", "error of u", "error of friction"], rows)
