"""A block under still water, as a box and from an STL file: the same water, the same force."""

import numpy as np


def check(case):
    runs = {name: case.run(case.folder / name, name=name, solver="sph") for name in ("given", "read")}
    last = {}
    for name, run in runs.items():
        snapshot = run.sph.snapshots[-1]
        last[name] = snapshot["pressure"][np.argsort(snapshot["id"])]
    case.holds("as many particles around either", len(last["given"]) == len(last["read"]))
    if len(last["given"]) != len(last["read"]):
        return
    scale = 1000 * 0.8
    # the file's numbers are floats: places differ by 1e-8 of the block
    case.metric("difference of the pressures over rho g H", float(np.max(np.abs(last["given"] - last["read"]))) / scale, below=1e-5)
    force = {name: float(run.sph.scalars["block.fz"][-1]) for name, run in runs.items()}
    weight = 1000 * 0.4 * 0.3 * 0.5
    case.metric("difference of the lifts over the buoyancy", abs(force["given"] - force["read"]) / weight, below=1e-5)
    late = runs["read"].sph.scalars["time"] > 0.5
    case.metric("mean lift over the buoyancy", float(np.mean(runs["read"].sph.scalars["block.fz"][late])) / weight, between=(0.9, 1.1))
