"""A uniform stream crosses a box that is open on all sides, 20 times its length: nothing may change.

The partner is a formula, so that the particles' side of the coupling is judged alone: layers, injection, removal,
ledger. Both removal rules in the plane, the default in space; and two boxes, apart and joined to an L.
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


def two_boxes(case):
    """A stream through two boxes, one downstream of the other: each keeps its water, each face its flux."""
    n, rise, layer = 16, 6, 8  # spacings; layers of a nominal box
    wide = n + 2 * layer
    rows = []
    for name, gap in (("apart", 20), ("joined", 0)):
        run = case.run(case.folder / "boxes", name=name, set=[f"scene.constants.gap={gap}*dx"], solver="sph")
        s, snapshots = run.sph.scalars, run.sph.snapshots
        u_rms = max(signals.rms(np.linalg.norm(f["velocity"] - PLANE, axis=1)) / U for f in snapshots[1:])
        p_rms = max(signals.rms(np.ravel(f["pressure"]) / (RHO * U**2)) for f in snapshots[1:])
        spacing = min(coupled.smallest_spacing(f.points) for f in snapshots[1:]) / DX
        boxes = [((0, n), (0, n)), ((n + gap, 2 * n + gap), (rise, n + rise))]
        filled = [np.mean([np.sum((f.points[:, 0] > x[0] * DX) & (f.points[:, 0] < x[1] * DX) &
                                  (f.points[:, 2] > z[0] * DX) & (f.points[:, 2] < z[1] * DX)) for f in snapshots[10:]]) / n**2 - 1
                  for x, z in boxes]
        # rows that face the stream, of both boxes or of the outline of the L
        tall, long = (2 * wide, 2 * wide) if name == "apart" else (wide + rise, 2 * n + 2 * layer)
        half = len(s["time"]) // 2
        passed = (s["time"][-1] - s["time"][half]) * U / DX
        counts = {key: s[f"n_{key}"][-1] - s[f"n_{key}"][half] for key in (f"{what}_{axis}_{side}" for what in
                  ("injected", "removed") for axis in "xz" for side in ("lower", "upper"))}
        flux = {"x": tall * passed, "z": 0.6 * long * passed}
        through = [(counts[f"{what}_{axis}_{side}"] - counts[f"{other}_{axis}_{side}"]) / flux[axis] - 1 for axis in "xz"
                   for what, other, side in (("injected", "removed", "lower"), ("removed", "injected", "upper"))]
        ledger = coupled.ledger(run)
        rows.append([name, u_rms, p_rms, spacing, *filled, *through, ledger, run.seconds])
        case.metric(f"two boxes {name}: rms error of u / U", u_rms, below=1e-3)
        case.metric(f"two boxes {name}: rms error of p / (rho U^2)", p_rms, below=5e-3)
        case.metric(f"two boxes {name}: ledger / mass", ledger, below=1e-12)
        case.metric(f"two boxes {name}: smallest spacing / dx", spacing, above=0.6)
        for box, value in zip(("first", "second"), filled):
            case.metric(f"two boxes {name}: particles in the {box} nominal box / start - 1", value, between=(-0.03, 0.03))
        for face, value in zip(("x lower", "x upper", "z lower", "z upper"), through):
            case.metric(f"two boxes {name}: net particles through {face} / flux - 1", value, between=(-0.02, 0.02))
    case.table("Two boxes", ["boxes", "u rms", "p rms", "spacing", "dN/N first", "second", "x lower", "x upper", "z lower",
                             "z upper", "ledger", "wall s"], rows)


def check(case):
    two_boxes(case)
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
