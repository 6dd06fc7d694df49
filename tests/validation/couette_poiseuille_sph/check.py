"""Channel flows between walls of dummies: velocity against the exact profile, friction on the walls."""

import numpy as np

H = U = 1.0
NU = 0.1
EXACT = {"couette": lambda z: U * z / H, "poiseuille": lambda z: 4 * U * z * (H - z) / H**2}
FRICTION = {"couette": NU * U / H, "poiseuille": 4 * NU * U / H}  # of rho = 1, on the floor a length


def check(case):
    rows = []
    for scene, exact in EXACT.items():
        for n in (20, 40):
            run = case.run(case.folder / scene, set=[f"scene.constants.n={n}"], name=f"{scene}_n{n}", solver="sph")
            last = run.sph.snapshots[-1]
            z, u = last.points[:, 2], last["velocity"][:, 0]
            error = float(np.max(np.abs(u - exact(z))))
            top = float(np.max(u)) / float(np.max(exact(z))) - 1
            friction = float(run.sph.scalars["floor.viscous_fx"][-1]) / (FRICTION[scene] * H) - 1
            rows.append([scene, n, top, error / U, friction, run.seconds])
            case.metric(f"{scene}, n={n}: error of the largest velocity", top, between=(-0.05, 0.05))
            case.metric(f"{scene}, n={n}: largest error of u", error, unit="U")
            case.metric(f"{scene}, n={n}: error of the friction on the floor", friction)
    case.table("Channel flows", ["flow", "H/dx", "error of u_max", "largest error", "error of friction", "wall s"], rows)
