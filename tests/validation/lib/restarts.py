"""Restarts: checkpoints of two runs, compared to the bit."""

import shutil

import h5py
from littoral_lib.run import checkpoints


def different_datasets(one, two):
    """Names of datasets of two HDF5 files that differ in any bit; wall times are left out."""
    found = []
    with h5py.File(one, "r") as a, h5py.File(two, "r") as b:
        names = set()
        a.visititems(lambda name, item: names.add(name) if isinstance(item, h5py.Dataset) else None)
        b.visititems(lambda name, item: names.add(name) if isinstance(item, h5py.Dataset) else None)
        for name in sorted(names):
            if name not in a or name not in b or a[name].shape != b[name].shape or \
                    a[name][()].tobytes() != b[name][()].tobytes():
                found.append(name)
    return [name for name in found if "wall" not in name]


def common_windows(run):
    """Windows of which both programs have a checkpoint, in order."""
    return sorted(set(checkpoints(run.sph.folder)) & set(checkpoints(run.fv.folder)))


def go_on(case, scene, name, window, whole, **arguments):
    """The same scene again from `whole`'s checkpoint of a window, in a folder of its own."""
    folder = case.out / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return case.run(scene, name=name, keep=True, restart=window, restart_from=whole, **arguments)


def differences(one, two, window):
    """{program: datasets that differ in its checkpoint of a window}, None where a run has none."""
    found = {}
    for side in ("sph", "fv"):
        a, b = (checkpoints(getattr(run, side).folder).get(window) for run in (one, two))
        found[side] = None if a is None or b is None else different_datasets(a, b)
    return found
