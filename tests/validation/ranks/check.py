"""C19: what the number of threads and ranks may change is the order of sums, and nothing else."""

import numpy as np

INJECT = ["scene.constants.n=16", "scene.time.max_windows=320", "scene.time.field_interval=0"]
SET = ["scene.constants.n=25", "scene.time.max_windows=100", "scene.time.field_interval=0"]

CYLINDER = ["scene.time.max_windows=20", "scene.time.field_interval=0", "fv.dual_time.drop=1e-9", "fv.dual_time.floor=1e-13"]


def difference(one, two):
    """Largest relative difference of the joined scalars over all rows."""
    worst = 0.0
    for name in ("kinetic_energy", "mass"):
        a, b = one.scalars[name], two.scalars[name]
        if len(a) != len(b):
            return float("nan")
        worst = max(worst, float(np.abs(a / b - 1).max()))
    return worst


def check(case):
    base = case.run("configs/standing_wave", name="threads1", threads=1, set=SET)
    case.metric("windows", len(base.scalars["time"]) - 1, at_least=99)
    again = case.run("configs/standing_wave", name="again", threads=1, set=SET)
    case.metric("run again", difference(base, again), at_most=0.0)
    threads = case.run("configs/standing_wave", name="threads2", threads=2, set=SET)
    case.metric("two threads", difference(base, threads), at_most=1e-10)
    for sph in (2, 3):
        run = case.run("configs/standing_wave", name=f"ranks{sph}1", sph_ranks=sph, threads=1, set=SET)
        case.metric(f"{sph}+1 ranks", difference(base, run), at_most=1e-10)
    both = case.run("configs/standing_wave", name="ranks21threads2", sph_ranks=2, threads=2, set=SET)
    case.metric("2+1 ranks of two threads", difference(base, both), at_most=1e-10)
    one = case.run("configs/piston", name="piston11", threads=1, set=INJECT)
    case.metric("injected", one.sph.scalars["n_injected"][-1], at_least=1)
    two = case.run("configs/piston", name="piston21", sph_ranks=2, threads=1, set=INJECT)
    case.metric("2+1 ranks with injection", difference(one, two), at_most=1e-10)
    # blocks cut in other places are other paths of the inner iteration: both to its end
    tight = SET + ["fv.dual_time.drop=1e-9"]
    base = case.run("configs/standing_wave", name="tight11", threads=1, set=tight)
    for sph, fv in ((1, 2), (3, 2)):
        run = case.run("configs/standing_wave", name=f"tight{sph}{fv}", sph_ranks=sph, fv_ranks=fv, threads=1, set=tight)
        case.metric(f"{sph}+{fv} ranks, inner drop 1e-9", difference(base, run), at_most=1e-7)
    alone = [case.run("configs/cylinder", name=f"cylinder{fv}", fv_ranks=fv, threads=1, set=CYLINDER) for fv in (1, 3)]
    case.metric("cylinder alone on 3 ranks: energy", difference(*alone), at_most=1e-7)
    # a surface through the region's faces, forced and imposed cells
    wave = case.folder.parent / "standing_wave_surface" / "scene"
    for kind in ("forced", "imposed"):
        common = [f"scene.coupling.kind={kind}", "scene.constants.n=10", "scene.time.max_windows=40", "scene.time.field_interval=0",
                  "fv.dual_time.drop=1e-9"]
        base, *others = [case.run(wave, name=f"wave_{kind}{sph}{fv}", sph_ranks=sph, fv_ranks=fv, threads=1, set=common)
                         for sph, fv in ((1, 1), (2, 1), (1, 2), (2, 2))]
        for name, run in zip(("2+1", "1+2", "2+2"), others):
            case.metric(f"{kind}, surface through the faces, {name} ranks", difference(base, run), at_most=1e-9)
