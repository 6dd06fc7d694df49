"""Still water between walls: pressure, level, motion that is left, force on the tank."""

import math

import numpy as np

RESOLUTIONS = {"tank": (20, 40), "wedge": (20, 40)}
G = H = 1.0
RHO = 1000.0
C = 10.0


def linear(depth):
    return RHO * G * depth


def of_the_fluid(depth):
    """At rest with p = c^2 (rho - rho0); above rho g depth by g H / 2 c^2 = .5% of itself on the floor."""
    return RHO * C**2 * np.expm1(G * depth / C**2)


def pressure_error(run, exact):
    """L2 of p - p exact over rho g H, mean over the last snapshots: sound still runs between the walls."""
    errors = [np.mean((s["pressure"] - exact(H - s.points[:, 2])) ** 2) for s in run.sph.snapshots[-8:]]
    return float(np.sqrt(np.mean(errors))) / (RHO * G * H)


def check(case):
    rows = []
    for scene, resolutions in RESOLUTIONS.items():
        errors = {}
        for n in resolutions:
            run = case.run(case.folder / scene, set=[f"scene.constants.n={n}"], name=f"{scene}_n{n}", solver="sph")
            scalars, gauges = run.sph.scalars, run.sph.gauges
            errors[n] = pressure_error(run, of_the_fluid)
            incompressible = pressure_error(run, linear)
            late = scalars["time"] > 0.5 * scalars["time"][-1]
            weight = scalars["mass"][-1] * G
            energy = float(np.max(scalars["kinetic_energy"])) / (weight * H)
            drift = float(np.max(np.abs(gauges["middle.elevation"] - H))) * n
            force = float(np.mean(scalars["tank.fz"][late]))
            if scene == "wedge":
                force += float(np.mean(scalars["wedge.fz"][late]))
            flagged = int((run.sph.snapshots[-1]["surface"] == 2).sum())
            rows.append([scene, n, errors[n], incompressible, energy, drift, -force / weight, flagged, run.seconds])
            case.metric(f"{scene}, n={n}: E_k over m g H", energy, below=1e-4)
            case.metric(f"{scene}, n={n}: level's drift", drift, below=0.5, unit="dx")
            case.metric(f"{scene}, n={n}: force on the bodies over the weight", -force / weight, between=(0.99, 1.01))
            case.metric(f"{scene}, n={n}: particles marked as surface beyond the top row", flagged - 2 * n, between=(0, 0))
        fine, coarse = max(errors), min(errors)
        order = math.log(errors[coarse] / errors[fine]) / math.log(fine / coarse)
        case.metric(f"{scene}: L2(p) at H/dx = {fine}", errors[fine], below=0.015)
        case.metric(f"{scene}: L2 of p - rho g (H - z) at H/dx = {fine}", incompressible, below=0.015)
        case.metric(f"{scene}: order of L2(p)", order, at_least=1.0)
    case.table("Still water", ["scene", "H/dx", "L2(p)", "to rho g (H-z)", "E_k", "drift, dx", "force/weight", "surface", "wall s"], rows)
