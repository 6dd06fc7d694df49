"""Extrema of the velocity on the centre lines against converged values."""

from lib import grid

# Re: (cells, end in L/U, {quantity: (value, place or None)}); sources in README.md
FLOWS = {
    100: ((32, 64, 128), 40, {"u_min": (-0.2139, 0.458), "w_max": (0.1794, 0.237), "w_min": (-0.2536, 0.8105)}),
    400: ((64, 128), 60, {"u_min": (-0.32873, None), "w_max": (0.30383, None), "w_min": (-0.45406, None)}),
    1000: ((64, 128), 150, {"u_min": (-0.38857, None), "w_max": (0.37694, None), "w_min": (-0.52708, None)}),
}
FINEST = 128


def measure(run):
    g = grid.Planar(run.fv.snapshots[-1])
    u = grid.middle(g.u, 1), grid.middle(g.z, 1)
    w = grid.middle(g.w, 0), grid.middle(g.x, 0)
    return {"u_min": grid.extremum(u[1], u[0], -1), "w_max": grid.extremum(w[1], w[0], 1),
            "w_min": grid.extremum(w[1], w[0], -1)}


def check(case):
    rows = []
    for reynolds, (cells, end, reference) in FLOWS.items():
        for n in cells:
            run = case.run(case.folder / "scene", name=f"Re{reynolds}_n{n}", solver="fv",
                           set=[f"fv.blocks[0].cells=[{n},1,{n}]", f"scene.constants.Re={reynolds}", f"scene.time.end={end}"])
            found = measure(run)
            energy = run.fv.scalars["kinetic_energy"]
            change = energy[-1] / energy[-1 - len(energy) // 10] - 1
            rows.append([reynolds, n] + [f"{found[q][0]:.5f} at {found[q][1]:.4f}" for q in reference]
                        + [change, round(run.seconds, 1)])
            if n != FINEST:
                continue
            case.metric(f"Re {reynolds}: energy's change over the last tenth", change, between=(-1e-4, 1e-4))
            for q, (value, place) in reference.items():
                case.metric(f"Re {reynolds}: {q} over reference - 1", found[q][0] / value - 1, between=(-0.01, 0.01))
                if place is not None:
                    case.metric(f"Re {reynolds}: place of {q} - reference", found[q][1] - place,
                                between=(-0.01, 0.01), unit="L")
    case.table("Extrema", ["Re", "cells"] + list(FLOWS[100][2]) + ["change", "s"], rows)
