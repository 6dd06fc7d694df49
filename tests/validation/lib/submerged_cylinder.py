"""The stream over a submerged cylinder, with and without particles: forces beside the paper's Table 1, and a picture."""

import numpy as np
from littoral_lib import signals

PAPER = {"C_D": (1.54, 1.49), "C_L": (-0.081, -0.078), "St": (0.20, 0.20)}  # d/dx = 33, 16.5; period 5 d/U
GATES = {"C_D": (1.40, 1.58), "C_L": (-0.12, -0.04), "St": (0.18, 0.22)}
DYNAMIC_PRESSURE = 0.5  # rho U^2 d / 2 of the scene
START = 30.0            # [d/U] of the means
REGION = (-1, 5, -1)    # x and lowest z of the particles' nominal box [d]


def forces(case, run):
    """Metrics and table of C_D, C_L (without buoyancy) and St, means from START on."""
    g = run.fv.gauges
    t = g["time"]
    late = t > START
    drag, lift = (g[f"cylinder.dynamic_f{a}"] / DYNAMIC_PRESSURE for a in "xz")
    rises = signals.up_crossings(t[late], lift[late] - lift[late].mean())
    found = {"C_D": drag[late].mean(), "C_L": lift[late].mean(),
             "St": (len(rises) - 1) / (rises[-1] - rises[0]) if len(rises) > 1 else float("nan")}
    for name, value in found.items():
        case.metric(name, value, between=GATES[name])
    s = run.fv.scalars
    case.metric("steps that did not reach the inner tolerance", float((s["drop"] > 1e-3).sum()))
    case.table("Submerged cylinder", ["", "here", "paper, d/dx = 33", "16.5"],
               [[name, found[name], *PAPER[name]] for name in found])


def draw(ax, snapshot, values, hide, colours, limits):
    """A field of cells: values(piece, shape) where hide(piece) is false."""
    for piece in snapshot.pieces:
        nk, nj, ni = piece.nodes
        node = piece.coordinates().reshape(nk, nj, ni, 3)[:, 0]
        shape = (nk - 1, ni - 1)
        hidden = (piece.field("status") == 1) | (piece.field("level_set") > 0) | hide(piece)
        ax.pcolormesh(node[:, :, 0], node[:, :, 2], np.ma.masked_where(hidden.reshape(shape), values(piece).reshape(shape)),
                      cmap=colours, vmin=limits[0], vmax=limits[1], rasterized=True)


def picture(run, path, count=3, particles=None):
    """Vorticity of the cells at the last moments; with particles (snapshots of them) u of both instead, theirs in front."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    shown = [s for s in run.fv.snapshots if s.time > 0][-count:]
    figure, axes = plt.subplots(len(shown), 2 if particles else 1, figsize=(20 if particles else 10, 3.2 * len(shown)), squeeze=False)
    for row, snapshot in zip(axes, shown):
        draw(row[0], snapshot, lambda piece: piece.field("vorticity")[:, 1], lambda piece: False, "RdBu_r", (-6, 6))  # about y
        row[0].set(title=f"vorticity d/U, tU/d = {snapshot.time:.4g}")
        if particles:
            draw(row[1], snapshot, lambda piece: piece.field("velocity")[:, 0], lambda piece: False, "viridis", (-0.5, 1.8))
            own = min(particles, key=lambda s, t=snapshot.time: abs(s.time - t))
            x = own.points
            row[1].scatter(x[:, 0], x[:, 2], c=own["velocity"][:, 0], s=3, cmap="viridis", vmin=-0.5, vmax=1.8, linewidths=0)
            low, high, floor = REGION
            row[1].plot([low, low, high, high], [1.25, floor, floor, 1.25], "r--", lw=0.8)
            row[1].set(title=f"u / U of cells and particles, tU/d = {snapshot.time:.4g}")
        for ax in row:
            ax.set(xlim=(-3, 14) if not particles else (-3, 9), ylim=(-4, 1.25), aspect="equal", facecolor="0.85")
    figure.savefig(path, dpi=110, bbox_inches="tight")
