"""What ranks and threads may change is the order of sums over all particles, and nothing else."""

import numpy as np

DAM = "tests/validation/ranks_sph/dam"
BLOCKS = "tests/benchmarks/sph_scaling"
SPACE = ["scene.constants.blocks=2", "scene.constants.n=10", "scene.time.max_windows=100",
         "sph.output.fields=[velocity,pressure,surface,shift,id]"]


def difference(one, two):
    """Largest difference of the last fields, by the particles' ids, and of the scalars; relative to the largest value."""
    a, b = one.sph.snapshots[-1], two.sph.snapshots[-1]
    first, second = np.argsort(a["id"]), np.argsort(b["id"])
    if not np.array_equal(a["id"][first], b["id"][second]):
        return float("inf")
    pairs = [(a.points[first], b.points[second])]
    pairs += [(a[name][first], b[name][second]) for name in a.names if name != "id"]
    series, other = one.sph.scalars, two.sph.scalars
    pairs += [(series[name], other[name]) for name in series.names
              if not name.startswith("seconds_") and name != "ledger_defect"]
    return max(float(np.abs(x - y).max() / max(np.abs(x).max(), 1e-300)) if x.shape == y.shape else float("inf")
               for x, y in pairs if np.abs(x).max() > 0 or np.abs(y).max() > 0)


def check(case):
    plane = case.run(DAM, name="dam1", threads=1)
    space = case.run(BLOCKS, name="blocks1", threads=1, set=SPACE)
    case.metric("the dam's front has reached the wall at 1.8 m", plane.sph.snapshots[-1].points[:, 0].max(), at_least=1.75,
                unit="m")
    for ranks in (2, 3, 4):
        case.metric(f"dam on {ranks} ranks",
                    difference(plane, case.run(DAM, name=f"dam{ranks}", sph_ranks=ranks, threads=1)), at_most=1e-10)
        case.metric(f"blocks on {ranks} ranks",
                    difference(space, case.run(BLOCKS, name=f"blocks{ranks}", sph_ranks=ranks, threads=1, set=SPACE)),
                    at_most=1e-10)
    both = case.run(DAM, name="dam2x2", sph_ranks=2, threads=2)
    case.metric("dam on 2 ranks of 2 threads", difference(plane, both), at_most=1e-10)
    case.metric("bisections of the dam on 2 ranks", both.sph.summary["results"]["bisections"], at_least=2)
