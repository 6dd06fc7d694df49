"""Still water beside thin plates: no leak, the pressure of each side, the force, motion that is left."""

import numpy as np

G = H = 1.0
LOW = 0.5
RHO = 1000.0
C = 10.0


def exact(depth):
    """Pressure in still water of constant sound speed, rho g depth (1 + g depth / 2 c^2 + ..)."""
    return RHO * C**2 * np.expm1(G * depth / C**2)


def pressure_error(run, level):
    errors = [np.mean((s["pressure"] - exact(level(s.points) - s.points[:, 2])) ** 2) for s in run.sph.snapshots[-8:]]
    return float(np.sqrt(np.mean(errors))) / (RHO * G * H)


def check(case):
    rows = []
    for n in (20, 40):
        run = case.run(case.folder / "levels", set=[f"scene.constants.n={n}"], name=f"levels_n{n}", solver="sph")
        first, last = run.sph.snapshots[0], run.sph.snapshots[-1]
        left = set(first["id"][first.points[:, 0] < H].astype(int))
        crossed = sum((int(i) in left) != (x < H) for i, x in zip(last["id"], last.points[:, 0]))
        error = pressure_error(run, lambda x: np.where(x[:, 0] < H, H, LOW))
        scalars = run.sph.scalars
        late = scalars["time"] > 0.5 * scalars["time"][-1]
        thrust = float(np.mean(scalars["plate.fx"][late])) / (0.5 * RHO * G * (H**2 - LOW**2))
        energy = float(np.max(scalars["kinetic_energy"])) / (scalars["mass"][-1] * G * H)
        rows.append(["levels", n, crossed, error, thrust, energy, run.seconds])
        case.metric(f"levels, n={n}: particles that went through the plate", crossed, between=(0, 0))
        case.metric(f"levels, n={n}: L2(p)", error, below=0.015)
        case.metric(f"levels, n={n}: force on the plate over the exact one", thrust, between=(0.97, 1.03) if n == 20 else (0.98, 1.02))
        case.metric(f"levels, n={n}: E_k over m g H", energy, below=1e-4)

        run = case.run(case.folder / "immersed", set=[f"scene.constants.n={n}"], name=f"immersed_n{n}", solver="sph")
        error = pressure_error(run, lambda x: H)
        scalars = run.sph.scalars
        late = scalars["time"] > 0.5 * scalars["time"][-1]
        force = float(np.hypot(np.mean(scalars["plate.fx"][late]), np.mean(scalars["plate.fz"][late]))) / (RHO * G * H**2)
        energy = float(np.max(scalars["kinetic_energy"])) / (scalars["mass"][-1] * G * H)
        rows.append(["immersed", n, 0, error, force, energy, run.seconds])
        case.metric(f"immersed, n={n}: L2(p)", error, below=0.015)
        case.metric(f"immersed, n={n}: force on the plate over rho g H^2", force, below=0.01)
        case.metric(f"immersed, n={n}: E_k over m g H", energy, below=1e-4)
    case.table("Plates", ["scene", "H/dx", "crossed", "L2(p)", "force", "E_k", "wall s"], rows)
