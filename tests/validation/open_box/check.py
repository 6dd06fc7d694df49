"""A uniform stream crosses a box that is open on all sides, 20 times its length: nothing may change.

The partner is a formula, so that the particles' side of the coupling is judged alone: layers, injection, removal,
ledger. Both removal rules in the plane, the default in space.
"""

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.spatial import cKDTree

DX, RHO, U = 0.05, 1000.0, 1.0
PLANE, SPACE = (1, 0, 0.6), (1, 0.3, 0.5)
# scene, removal, velocity, pressure / (rho U^2) above the reference
CASES = (("plane", "crossing", PLANE, 0), ("plane", "crossing", PLANE, 0.5), ("plane", "nearest", PLANE, 0),
         ("space", "crossing", SPACE, 0.5))


def check(case):
    rows = []
    for scene, rule, velocity, level in CASES:
        name = f"{scene}_{rule}_{level}"
        run = case.run(case.folder / scene, name=name, solver="sph",
                       set=[f"sph.coupling.removal={rule}", f"scene.initial.p={level * RHO * U**2}"])
        velocity, u_rms, p_rms, spacing = np.array(velocity), 0.0, 0.0, np.inf
        for snapshot in run.sph.snapshots[1:]:
            points = snapshot.points if scene == "space" else snapshot.points[:, [0, 2]]
            u_rms = max(u_rms, signals.rms(np.linalg.norm(snapshot["velocity"] - velocity, axis=1)) / U)
            p_rms = max(p_rms, signals.rms(np.ravel(snapshot["pressure"]) / (RHO * U**2) - level))
            spacing = min(spacing, cKDTree(points).query(points, k=2)[0][:, 1].min() / DX)
        s = run.sph.scalars
        half = len(s["time"]) // 2  # the lattice of the start has left
        density = s["n_particles"][half:].mean() / s["n_particles"][0] - 1
        injected = s["n_injected"][-1]
        ledger = coupled.ledger(run)
        rows.append([scene, rule, level, u_rms, p_rms, spacing, density, injected, ledger, run.seconds])
        case.metric(f"{name}: rms error of u / U", u_rms, below=1e-3)
        case.metric(f"{name}: rms error of p / (rho U^2)", p_rms, below=5e-3)
        case.metric(f"{name}: ledger / mass", ledger, below=1e-12)
        case.metric(f"{name}: particles injected", injected, above=5 * s["n_particles"][0])
        if rule == "crossing":
            case.metric(f"{name}: smallest spacing / dx", spacing, above=0.6)
            case.metric(f"{name}: number of particles, mean / start - 1", density, between=(-0.03, 0.03))
    case.table("Open box", ["scene", "removal", "p0", "u rms", "p rms", "spacing", "dN/N", "injected", "ledger", "wall s"],
               rows)
