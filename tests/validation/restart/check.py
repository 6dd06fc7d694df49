"""C20 on the piston (particles enter and leave): a run, and its second half again from the checkpoint in its middle."""

import numpy as np
from lib import restarts

DT = 0.01  # [s] of a window: about two to three particle steps
N = 60     # windows in each half


def compare(case, name, scene, settings, interval, n, ranks=(1, 1)):
    """A run of 2 n windows and its second half again; interval [s] between checkpoints, of which one falls on the middle."""
    common = [*settings, f"scene.time.checkpoint_interval={interval}", "scene.time.field_interval=0"]
    ranks = {"sph_ranks": ranks[0], "fv_ranks": ranks[1], "threads": 1}
    whole = case.run(scene, name=f"{name}_whole", set=common, **ranks)
    windows = restarts.common_windows(whole)
    case.metric(f"{name}: windows with checkpoints of both", len(windows), at_least=2)
    again = restarts.go_on(case, scene, f"{name}_second", windows[-2], whole, set=common, **ranks)
    differing = restarts.differences(whole, again, windows[-1])
    for side in ("sph", "fv"):
        a, b = getattr(whole, side), getattr(again, side)
        case.holds(f"{name}, {side}: writes the last checkpoint again", differing[side] is not None)
        if differing[side] is not None:
            case.metric(f"{name}, {side}: datasets of the last checkpoint that differ", len(differing[side]), at_most=0)
        one, two = a.scalars, b.scalars
        later = one["time"] > two["time"][0] - 1e-12
        columns = [c for c in ("kinetic_energy", "potential_energy", "mass") if c in one]
        rows = min(later.sum(), len(two))
        same = all(np.array_equal(one[c][later][-rows:], two[c][-rows:]) for c in columns)
        case.holds(f"{name}, {side}: scalars of the second half are equal", same and rows >= n - 1)


def check(case):
    compare(case, "piston", "configs/piston", [f"scene.coupling.dt={DT}", f"scene.time.end={2 * N * DT}"], N * DT, N)
    # a surface through the region's faces, forced and imposed cells, each solver on two ranks
    for kind in ("forced", "imposed"):
        compare(case, f"wave_{kind}", case.folder.parent / "standing_wave_surface" / "scene",
                [f"scene.coupling.kind={kind}", "scene.constants.n=10", "scene.time.end=2"], 1, 13, ranks=(2, 2))
