"""Drag, lift and shedding frequency of a cylinder on overlapping grids, and a picture of the wake."""

import numpy as np
from littoral_lib import signals

DYNAMIC_PRESSURE = 0.5  # rho U^2 d / 2 of the scene

# Re: (end, start of the mean, {quantity: (lowest, highest)}); sources in README.md
FLOWS = {
    100: (120, 80, {"C_D": (1.29, 1.39), "C_L amplitude": (0.31, 0.35), "St": (0.159, 0.171)}),
    180: (100, 60, {"C_D": (1.30, 1.40), "St": (0.185, 0.200)}),
}


def coefficients(run, start):
    gauge = run.fv.gauges
    time = gauge["time"]
    drag, lift = gauge["cylinder.fx"] / DYNAMIC_PRESSURE, gauge["cylinder.fz"] / DYNAMIC_PRESSURE
    found = signals.shedding(time, drag, lift, start)
    return {"C_D": found["drag"], "C_L amplitude": found["amplitude"], "C_L mean": found["lift"],
            "St": found["frequency"],
            # what flips from step to step is not the flow's: the fourth difference sees nothing else
            "2 dt noise": np.abs(np.diff(drag[time > start], 4)).max() / 16}


def picture(run, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 1, figsize=(9, 8))
    for ax, (left, right, height) in zip(axes, ((-3, 17, 4), (-1.6, 2.4, 1.3))):
        for piece in run.fv.snapshots[-1].pieces:
            nk, nj, ni = piece.nodes
            node = piece.coordinates().reshape(nk, nj, ni, 3)[:, 0]
            vorticity = piece.field("vorticity")[:, 1].reshape(nk - 1, ni - 1)  # about y
            status = piece.field("status").reshape(nk - 1, ni - 1)
            ax.pcolormesh(node[:, :, 0], node[:, :, 2], np.ma.masked_where(status == 1, vorticity), cmap="RdBu_r",
                          vmin=-4, vmax=4, rasterized=True)
        ax.set(xlim=(left, right), ylim=(-height, height), aspect="equal", xlabel="x/d", ylabel="z/d")
    axes[0].set_title("vorticity d/U")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def check(case):
    rows = []
    for reynolds, (end, start, gates) in FLOWS.items():
        run = case.run("configs/cylinder", name=f"Re{reynolds}", solver="fv",
                       set=[f"scene.constants.Re={reynolds}", f"scene.time.end={end}", "fv.output.vorticity=true"])
        found = coefficients(run, start)
        for name, (low, high) in gates.items():
            case.metric(f"Re {reynolds}: {name}", found[name], between=(low, high))
        case.metric(f"Re {reynolds}: C_L mean", found["C_L mean"], between=(-0.01, 0.01))
        case.metric(f"Re {reynolds}: drag that flips from step to step, of C_D", found["2 dt noise"] / found["C_D"],
                    below=1e-3)
        cycles = run.fv.scalars["cycles"]
        case.metric(f"Re {reynolds}: cycles a step to three orders", float(cycles.mean()), at_most=8)
        rows.append([reynolds, found["C_D"], found["C_L amplitude"], found["St"], float(cycles.mean()),
                     int(cycles.max()), round(run.seconds, 1)])
        picture(run, case.out / f"Re{reynolds}.png")
    case.table("Cylinder", ["Re", "C_D", "C_L amplitude", "St", "cycles", "most", "s"], rows)
