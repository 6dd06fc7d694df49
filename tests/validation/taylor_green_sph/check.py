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
    """Re = 1000, E(5): the solver's own dissipation is of the size of the viscosity, see the README."""
    for riemann, gate in (("linearised", 0.65), ("low_dissipation", 0.35)):
        coarse, fine = (energy_error(case, n, riemann, 1000, 5)[0] for n in (50, 100))
        case.metric(f"{riemann}, Re=1000, L/dx=50: error of E(5)", coarse)
        case.metric(f"{riemann}, Re=1000, L/dx=100: error of E(5)", fine, between=(-gate, 0.05))
        case.metric(f"{riemann}, Re=1000: order", math.log2(coarse / fine), at_least=0.4)
