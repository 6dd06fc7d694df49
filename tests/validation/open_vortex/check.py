"""Vortices that turn faster than the stream carries them enter and leave a box of particles open on all sides.

At each face the water flows in here and out there, and turns with every vortex that passes. What is judged is the faces,
with the Riemann solver that vortices under water want (`fidelity: reference`); what the default's damping takes besides,
inside the box, is recorded.
"""

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.spatial import cKDTree

U, V, K, DX, RHO = 0.5, 1.0, 2 * np.pi, 0.02, 1000.0
NU = V / 200


def vorticity(x, u, points):
    """By a first-order fit of the velocities within 3 dx of each point."""
    tree, found = cKDTree(x), np.empty(len(points))
    for i, point in enumerate(points):
        near = tree.query_ball_point(point, 3 * DX)
        matrix = np.column_stack([np.ones(len(near)), x[near] - point])
        fit = np.linalg.lstsq(matrix, u[near], rcond=None)[0]
        found[i] = fit[2, 0] - fit[1, 1]
    return found


def measure(run):
    rows = []
    for s in run.sph.snapshots[1:]:
        x, u, p, t = s.points[:, [0, 2]], s["velocity"][:, [0, 2]], np.ravel(s["pressure"]), s.time
        inside = np.ravel(s["zone"]) == 0
        decay, a, b = np.exp(-2 * NU * K**2 * t), K * (x[:, 0] - U * t), K * x[:, 1]
        exact = np.column_stack([U - V * decay * np.cos(a) * np.sin(b), V * decay * np.sin(a) * np.cos(b)])
        p_exact = -0.25 * RHO * (V * decay) ** 2 * (np.cos(2 * a) + np.cos(2 * b))
        error = np.linalg.norm(u - exact, axis=1)
        points = x[inside][::7]
        # the exact velocities through the same fit, which flattens a vortex of 25 dx
        enstrophy = (vorticity(x, u, points) ** 2).sum() / (vorticity(x, exact, points) ** 2).sum()
        rows.append([t, signals.rms(error[inside]) / V, signals.rms((p - p_exact)[inside]) / (RHO * V**2), enstrophy,
                     cKDTree(x).query(x, k=2)[0][:, 1].min() / DX])
    return np.array(rows)


def of_late(rows):
    """Without the lattice of the start, which collapses at stagnation points: it has left."""
    return rows[rows[:, 0] > 2.0]


def check(case):
    header = ["t", "u rms / V", "p rms / (rho V^2)", "enstrophy / exact", "spacing / dx"]
    damped = measure(case.run(case.folder, set=["sph.fidelity=standard"], name="standard", solver="sph"))
    case.table("Vortices, fidelity: standard", header, damped.tolist())
    case.metric("fidelity: standard: rms error of u / V", damped[:, 1].max(), below=0.05)
    case.metric("fidelity: standard: enstrophy / exact, lattice gone", of_late(damped)[:, 3].min())
    run = case.run(case.folder, solver="sph")
    rows = measure(run)
    late = of_late(rows)
    case.table("Vortices, fidelity: reference", header, rows.tolist())
    case.metric("rms error of u / V", rows[:, 1].max(), below=0.05)
    case.metric("rms error of u / V, lattice gone", late[:, 1].max(), below=0.05)
    case.metric("rms error of p / (rho V^2), lattice gone", late[:, 2].max(), below=0.05)
    case.metric("rms error of p / (rho V^2)", rows[:, 2].max())
    case.metric("enstrophy / exact, lattice gone", late[:, 3].min(), above=0.9)
    case.metric("enstrophy / exact, lattice gone, most", late[:, 3].max(), below=1.1)
    case.metric("smallest spacing / dx, lattice gone", late[:, 4].min())
    n, last = run.sph.scalars["n_particles"], run.sph.scalars
    case.metric("largest change of the number of particles", np.abs(n / n[0] - 1).max(), below=0.01)
    case.metric("ledger / mass", coupled.ledger(run), below=1e-12)
    for face in ("x_lower", "x_upper", "z_lower", "z_upper"):
        case.metric(f"fewest in or out of {face}", min(last[f"n_injected_{face}"][-1], last[f"n_removed_{face}"][-1]),
                    above=0)  # each face works both ways
