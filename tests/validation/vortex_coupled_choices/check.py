"""C16, C17 on C10: what M and the ratio of the cells' width to the particles' spacing cost the vortex."""

import numpy as np
from lib import vortex_runs as runs

SUBSTEPS = (1, 2, 5, 10)
SPACINGS_OF_SUBSTEPS = 7  # over the core's radius
RATIOS = (1, 1.5, 2, 3, 4)
SPACINGS_OF_RATIOS = 12  # each ratio gives whole cells, at 4 three over the radius
HEADER = ["error of u at the end", "most", "over the first", "lag / dx", "enstrophy at the end", "p rms, vortex", "wall s"]


def row(h, first):
    return [float(h.u_error[-1]), float(h.u_error.max()), float(h.u_error[-1] / first.u_error[-1]),
            float(np.hypot(*h.lag[-1])), float(h.enstrophy[-1]), float(h.p_core.max()), h.run.seconds]


def window(h):
    return float(np.median(h.run.fv.scalars["dt"][1:]))


def check(case):
    rows, first = [], None
    for substeps in SUBSTEPS:
        h = runs.coupled(case, f"m{substeps}", SPACINGS_OF_SUBSTEPS, settings=[f"scene.coupling.substeps={substeps}"])
        first = first or h
        alone = runs.cells_alone(case, f"cells_m{substeps}", window(h), SPACINGS_OF_SUBSTEPS)
        rows.append([substeps, *row(h, first), float(alone.u_error[-1]), float(np.hypot(*alone.lag[-1]))])
        if substeps > 1:
            case.metric(f"C16: M={substeps}: error of u over that of M=1", rows[-1][3], below=1.5)
            case.metric(f"C16: M={substeps}: the same of the cells alone", rows[-1][-2] / rows[0][-2])
    case.table("Substeps", ["M", *HEADER, "cells alone", "their lag / dx"], rows)

    rows, first = [], None
    for ratio in RATIOS:
        h = runs.coupled(case, f"ratio{ratio:g}", SPACINGS_OF_RATIOS, ratio)
        first = first or h
        alone = runs.cells_alone(case, f"cells{ratio:g}", window(h), SPACINGS_OF_RATIOS / ratio)
        rows.append([float(ratio), *row(h, first), float(alone.u_error[-1])])
        if 1 < ratio <= 2:
            case.metric(f"C17: cells {ratio:g} spacings wide: error of u over that of equal ones", rows[-1][3], below=2)
        case.metric(f"C17: cells {ratio:g} spacings wide: error of u over that of these cells alone",
                    rows[-1][1] / rows[-1][-1])
    case.table("Width of the cells", ["cells' width / dx", *HEADER, "cells alone"], rows)
