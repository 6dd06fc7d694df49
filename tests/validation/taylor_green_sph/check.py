"""Kinetic energy at t U / L = 1, Re = 100, and 5, Re = 1000, against exp(-16 pi^2 t / Re), and the order of the error."""

import math

GATES = {50: 0.12, 100: 0.08}


def energy_error(case, n, riemann, Re=100, end=1):
    run = case.run(case.folder / "scene", name=f"{riemann}_{n}_{Re}", solver="sph",
                   set=[f"scene.constants.n={n}", f"scene.constants.Re={Re}", f"scene.time.end={end}",
                        f"sph.riemann={riemann}"])
    energy = run.sph.scalars["kinetic_energy"]
    return energy[-1] / energy[0] / math.exp(-16 * math.pi**2 * end / Re) - 1, run


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
    thousand(case)
    case.table("Taylor-Green", ["riemann", "L/dx", "error of E(1)", "wall s"], rows)


def thousand(case):
    """Re = 1000, E(5), by the same gates: a tenth of the viscosity for five times as long."""
    for riemann in ("linearised", "low_dissipation"):
        errors = {n: energy_error(case, n, riemann, 1000, 5)[0] for n in GATES}
        for n, gate in GATES.items():
            case.metric(f"{riemann}, Re=1000, L/dx={n}: error of E(5)", errors[n], between=(-gate, gate))
        case.metric(f"{riemann}, Re=1000: order", math.log2(abs(errors[50] / errors[100])),
                    **({"at_least": 1.0} if riemann == "linearised" else {}))
