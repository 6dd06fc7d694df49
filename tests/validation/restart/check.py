"""C20 on the piston (particles enter and leave): a run, and its second half again from the checkpoint in its middle."""

import shutil

import h5py
import numpy as np
from littoral_lib.run import checkpoints

DT = 0.01  # [s] of a window: about two to three particle steps
N = 60     # windows in each half


def different_datasets(one, two):
    """Names of datasets of two HDF5 files that differ in any bit."""
    found = []
    with h5py.File(one, "r") as a, h5py.File(two, "r") as b:
        names = set()
        a.visititems(lambda name, item: names.add(name) if isinstance(item, h5py.Dataset) else None)
        b.visititems(lambda name, item: names.add(name) if isinstance(item, h5py.Dataset) else None)
        for name in sorted(names):
            if name not in a or name not in b or a[name].shape != b[name].shape or \
                    a[name][()].tobytes() != b[name][()].tobytes():
                found.append(name)
    return found


def check(case):
    common = [f"scene.coupling.dt={DT}", f"scene.time.checkpoint_interval={N * DT}", "scene.time.field_interval=0"]
    whole = case.run("configs/piston", name="whole", threads=1, set=common + [f"scene.time.end={2 * N * DT}"])
    windows = sorted(set(checkpoints(whole.sph.folder)) & set(checkpoints(whole.fv.folder)))
    case.metric("windows with checkpoints of both", len(windows), at_least=2)
    second = case.out / "second"
    shutil.rmtree(second, ignore_errors=True)
    second.mkdir()
    again = case.run("configs/piston", name="second", keep=True, threads=1, restart=windows[0], restart_from=whole,
                     set=common + [f"scene.time.end={2 * N * DT}"])
    for side in ("sph", "fv"):
        a, b = getattr(whole, side), getattr(again, side)
        last_a, last_b = checkpoints(a.folder)[windows[-1]], checkpoints(b.folder).get(windows[-1])
        case.holds(f"{side}: writes the last checkpoint again", last_b is not None)
        if last_b is not None:
            case.metric(f"{side}: datasets of the last checkpoint that differ",
                        len([n for n in different_datasets(last_a, last_b) if "wall" not in n]), at_most=0)
        one, two = a.scalars, b.scalars
        later = one["time"] > two["time"][0] - 1e-12
        names = [n for n in ("kinetic_energy", "potential_energy", "mass") if n in one]
        rows = min(later.sum(), len(two))
        same = all(np.array_equal(one[n][later][-rows:], two[n][-rows:]) for n in names)
        case.holds(f"{side}: scalars of the second half are equal", same and rows >= N - 1)
