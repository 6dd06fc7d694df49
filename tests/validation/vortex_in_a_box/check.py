"""Area and shape of a disc that a vortex draws out to a filament and back."""

import numpy as np

from lib import grid

AREA = np.pi * 0.15**2


def check(case):
    rows = []
    for turn, n, correction in ((2, 64, "none"), (2, 128, "none"), (8, 128, "none"), (2, 64, "local"), (8, 64, "local")):
        run = case.run(case.folder / "scene", name=f"turn{turn}_n{n}_{correction}", solver="fv",
                       set=[f"scene.constants.n={n}", f"scene.constants.turn={turn}",
                            f"fv.level_set.volume_correction={correction}"])
        volume = run.fv.scalars["water_volume"]
        snapshot = run.fv.snapshots[-1]
        g = grid.Planar(snapshot)
        phi = snapshot.pieces[0].field("level_set").reshape(g.x.shape)
        exact = np.hypot(g.x - 0.5, g.z - 0.75) - 0.15
        moved = np.count_nonzero((phi < 0) != (exact < 0)) / n**2 / (2 * np.pi * 0.15) * n
        rows.append([turn, n, correction, float(volume.min() / AREA - 1), float(volume[-1] / AREA - 1), moved, run.seconds])
        case.metric(f"turn {turn} s, {n} cells, correction {correction}: area over the exact - 1", volume[-1] / AREA - 1)
        case.metric(f"turn {turn} s, {n} cells, correction {correction}: area between the shapes over the perimeter", moved, unit="cells")
    case.holds("finite", np.all(np.isfinite([row[4] for row in rows])))
    case.table("Vortex in a box", ["turn [s]", "cells", "correction", "least area", "area at the end", "L1, cells", "s"], rows)
