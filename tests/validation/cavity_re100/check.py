"""Extrema of the velocity on the centre lines against converged values, at three resolutions."""

from lib import grid

# (quantity, value, place): spectral and Richardson-extrapolated values; Ghia's tables are up to 3.5% low
REFERENCE = {"u_min": (-0.2139, 0.458), "w_max": (0.1794, 0.237), "w_min": (-0.2536, 0.8105)}


def measure(run):
    g = grid.Planar(run.fv.snapshots[-1])
    u = grid.middle(g.u, 1), grid.middle(g.z, 1)
    w = grid.middle(g.w, 0), grid.middle(g.x, 0)
    return {"u_min": grid.extremum(u[1], u[0], -1), "w_max": grid.extremum(w[1], w[0], 1),
            "w_min": grid.extremum(w[1], w[0], -1)}


def check(case):
    rows = []
    for n in (32, 64, 128):
        run = case.run(case.folder / "scene", set=[f"fv.blocks[0].cells=[{n},1,{n}]"], name=f"n{n}", solver="fv")
        found = measure(run)
        rows.append([n] + [f"{found[q][0]:.5f} at {found[q][1]:.4f}" for q in REFERENCE] + [round(run.seconds, 1)])
        if n == 128:
            for q, (value, place) in REFERENCE.items():
                case.metric(f"{q} over reference - 1", found[q][0] / value - 1, between=(-0.01, 0.01))
                case.metric(f"place of {q} - reference", found[q][1] - place, between=(-0.01, 0.01), unit="L")
    case.table("Extrema", ["cells"] + list(REFERENCE) + ["s"], rows)
