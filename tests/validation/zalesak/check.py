"""Area and shape of a slotted disc after one turn."""

import numpy as np

from lib import grid

AREA = 582.207      # of the disc less the slot
PERIMETER = 2 * np.pi * 15 + 2 * 25  # the slot's end is as wide as its mouth


def phi_of(snapshot):
    g = grid.Planar(snapshot)
    return g, snapshot.pieces[0].field("level_set").reshape(g.x.shape)


def check(case):
    rows = []
    for n in (100, 200):
        run = case.run(case.folder / "scene", name=f"n{n}", solver="fv", set=[f"scene.constants.n={n}"])
        volume = run.fv.scalars["water_volume"]
        g, start = phi_of(run.fv.snapshots[0])
        _, end = phi_of(run.fv.snapshots[-1])
        h = 100 / n
        moved = np.count_nonzero((start < 0) != (end < 0)) * h * h / PERIMETER
        rows.append([n, float(volume[0]), float(volume[-1]), float(volume[-1] / AREA - 1), moved / h, run.seconds])
        case.metric(f"{n} cells: area after a turn over {AREA} - 1", volume[-1] / AREA - 1, between=(-0.02, 0.02))
        case.metric(f"{n} cells: area between the shapes over the perimeter", moved / h, unit="cells")
    case.table("Slotted disc", ["cells", "area at start", "after a turn", "error", "L1, cells", "s"], rows)
