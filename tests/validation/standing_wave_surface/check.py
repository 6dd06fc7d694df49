"""C13, standing: the particles' box about an antinode in the middle of a tank; amplitudes a half period against each solver alone.

Amplitudes are half the way from one peak to the next, so that a level that drifts does not count.
"""

import numpy as np
from lib import coupled

DX, OMEGA = 1 / 20, np.sqrt(np.pi / 1.6 * np.tanh(np.pi / 1.6))  # of scene.yaml
HALF = np.pi / OMEGA


def swings(time, level):
    """Half the way between successive extremes, and when they were; the first half period is no whole one."""
    turns = np.nonzero((level[1:-1] - level[:-2]) * (level[2:] - level[1:-1]) <= 0)[0] + 1
    found = []
    for i in turns[(turns > 2) & (turns < len(time) - 3)]:
        c = np.polyfit(time[i - 2:i + 3] - time[i], level[i - 2:i + 3], 2)
        at = time[i] - c[1] / (2 * c[0])
        if not found or at - found[-1][0] > 0.5 * HALF:
            found.append((at, np.polyval(c, at - time[i])))
    at, value = np.array(found).T
    return np.diff(at), np.abs(np.diff(value)) / 2


def kept(gauges, name):
    _, a = swings(gauges["time"], gauges[name])
    return (a[-1] / a[0]) ** (1 / (len(a) - 1))


def check(case):
    scene = case.folder / "scene"
    grid = case.run(scene, solver="fv", name="grid", set=["scene.coupling.kind=none", "fv.time.dt=0.0375"])
    sph = case.run(scene, solver="sph", name="particles", set=["scene.coupling.kind=none"])
    of_grid, of_sph = kept(grid.fv.gauges, "end.elevation"), kept(sph.sph.gauges, "middle.elevation")
    rows = [["grid alone", of_grid], ["particles alone", of_sph]]
    for kind in ("forced", "imposed"):
        both = case.run(scene, name=kind, set=[f"scene.coupling.kind={kind}"])
        g = both.fv.gauges
        share = kept(g, "end.elevation")
        rows.append([kind, share])
        if kind == "imposed":  # told, not judged: README
            continue
        case.metric("amplitude kept a half period over the grid alone - 1", share / of_grid - 1, between=(-0.003, 0.003))
        case.metric("the same over what either solver keeps, by the water each computes - 1",
                    share / (of_grid ** 0.625 * of_sph ** 0.375) - 1, between=(-0.003, 0.003))
        time, _ = swings(g["time"], g["end.elevation"])
        alone, _ = swings(grid.fv.gauges["time"], grid.fv.gauges["end.elevation"])
        case.metric("period over the grid's alone - 1", time.mean() / alone.mean() - 1, between=(-0.01, 0.01))
        levels = both.sph.gauges
        at = np.interp(g["time"], levels["time"], levels["layer.elevation"])
        case.metric("rms mismatch of the two surfaces in the blending layer / dx",
                    np.sqrt(np.mean((at - g["layer.elevation"]) ** 2)) / DX, below=0.1)
        case.metric("ledger / mass", coupled.ledger(both), below=1e-12)
    case.table("Amplitude kept a half period", ["", "kept"], rows)
