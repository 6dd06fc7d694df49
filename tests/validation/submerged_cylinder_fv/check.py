"""Forces on a cylinder under the surface of a stream, Fr = 1, Re = 180, h/d = 1.5, beside those of the paper's Table 1."""

import numpy as np
from littoral_lib import signals

PAPER = {"C_D": (1.54, 1.49), "C_L": (-0.081, -0.078), "St": (0.20, 0.20)}  # d/dx = 33, 16.5; period 5 d/U
DYNAMIC_PRESSURE = 0.5  # rho U^2 d / 2 of the scene
START = 30.0            # [d/U] of the means


def picture(run, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    shown = [s for s in run.fv.snapshots if s.time > 0][-3:]
    figure, axes = plt.subplots(len(shown), 1, figsize=(10, 3.2 * len(shown)), squeeze=False)
    for ax, snapshot in zip(axes[:, 0], shown):
        for piece in snapshot.pieces:
            nk, nj, ni = piece.nodes
            node = piece.coordinates().reshape(nk, nj, ni, 3)[:, 0]
            vorticity = piece.field("vorticity")[:, 1].reshape(nk - 1, ni - 1)  # about y
            hidden = (piece.field("status") == 1) | (piece.field("level_set") > 0)
            ax.pcolormesh(node[:, :, 0], node[:, :, 2], np.ma.masked_where(hidden.reshape(nk - 1, ni - 1), vorticity),
                          cmap="RdBu_r", vmin=-6, vmax=6, rasterized=True)
        ax.set(xlim=(-3, 14), ylim=(-4, 1.25), aspect="equal", facecolor="0.85", title=f"vorticity d/U, tU/d = {snapshot.time:.4g}")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def check(case):
    run = case.run(case.folder / "scene", solver="fv")
    g, s = run.fv.gauges, run.fv.scalars
    t = g["time"]
    late = t > START
    drag, lift = (g[f"cylinder.dynamic_f{a}"] / DYNAMIC_PRESSURE for a in "xz")  # without buoyancy
    rises = signals.up_crossings(t[late], lift[late] - lift[late].mean())
    found = {"C_D": drag[late].mean(), "C_L": lift[late].mean(),
             "St": (len(rises) - 1) / (rises[-1] - rises[0]) if len(rises) > 1 else float("nan")}
    gates = {"C_D": (1.40, 1.58), "C_L": (-0.12, -0.04), "St": (0.18, 0.22)}
    for name, value in found.items():
        case.metric(name, value, between=gates[name])
    case.metric("volume's error, part of the water", np.abs(s["volume_error"]).max() / s["water_volume"][0], below=5e-3)
    case.metric("steps that did not reach the inner tolerance", float((s["drop"] > 1e-3).sum()))
    case.table("Submerged cylinder", ["", "here", "paper, d/dx = 33", "16.5"],
               [[name, found[name], *PAPER[name]] for name in found])
    picture(run, case.out / "vorticity.png")
