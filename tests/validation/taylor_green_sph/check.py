"""Kinetic energy at t U / L = 1 against exp(-16 pi^2 / Re), and the order of the error."""

import math

EXACT = math.exp(-16 * math.pi**2 / 100)  # of E(0), at t = 1
GATES = {50: 0.12, 100: 0.08}


def energy_error(case, n, riemann):
    run = case.run(case.folder / "scene", set=[f"scene.constants.n={n}", f"sph.riemann={riemann}"],
                   name=f"{riemann}_{n}", solver="sph")
    energy = run.sph.scalars["kinetic_energy"]
    return energy[-1] / energy[0] / EXACT - 1, run


def check(case):
    rows = []
    for riemann in ("linearised", "low_dissipation"):
        errors = {}
        for n, gate in GATES.items():
            errors[n], run = energy_error(case, n, riemann)
            rows.append([riemann, n, errors[n], run.seconds])
            gated = {"between": (-gate, gate)} if riemann == "linearised" else {}
            case.metric(f"{riemann}, L/dx={n}: error of E(1)", errors[n], **gated)
        order = math.log2(abs(errors[50] / errors[100]))
        case.metric(f"{riemann}: order", order, **({"at_least": 1.0} if riemann == "linearised" else {}))
    case.table("Taylor-Green", ["riemann", "L/dx", "error of E(1)", "wall s"], rows)
