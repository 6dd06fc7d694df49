"""C7: particles enter and leave through the interface; ledger, number, spacing and pressure over 20 periods of 4H/c."""

import numpy as np
from lib import coupled
from littoral_lib import signals

S, OMEGA, RHO, G, DX, WIDTH = 0.12, np.pi / 2, 1000.0, 1.0, 0.04, 0.8
RULES = ("crossing", "nearest")


def exact_pressure(t, z):
    eta = S * np.sin(OMEGA * t)
    return RHO * (G - S * OMEGA**2 * np.sin(OMEGA * t)) * (eta - z)


def measure(run):
    """Pressure errors of both sides, counted particles, smallest spacing, over the outputs after the start."""
    sides, spacing, numbers, level = [], [], [], []
    for moment in coupled.moments(run)[1:]:
        near = np.abs(moment.sph.x[:, 2] + 0.48) < 4 * DX
        p_sph = moment.sph.p[near] - exact_pressure(moment.time, moment.sph.x[near, 2])
        rows = moment.computed & (moment.fv.x[:, 2] > -0.48 - 4 * DX)
        p_fv = moment.fv.p[rows] - exact_pressure(moment.time, moment.fv.x[rows, 2])
        sides.append(p_sph.mean() - p_fv.mean())
        spacing.append(coupled.smallest_spacing(moment.sph.x, WIDTH) / DX)
        expected = WIDTH * (S * np.sin(OMEGA * moment.time) + 0.48 + 8 * DX) / DX**2
        numbers.append((len(moment.sph.x) - expected) / (WIDTH / DX))
        level.append(p_sph)
    sides = np.array(sides) / (RHO * G)
    return {"mismatch": signals.rms(sides - sides.mean()), "growth": signals.growth(sides - sides.mean()),
            "spacing": min(spacing), "rows": max(abs(n) for n in numbers)}


def check(case):
    rows = []
    for rule in RULES:
        for substeps in (1, 5, 10):
            run = case.run("configs/piston", name=f"{rule}_m{substeps}", may_fail=True,
                           set=[f"scene.coupling.substeps={substeps}", f"sph.coupling.removal={rule}"])
            if run.status != 0:
                case.holds(f"{rule}, M={substeps}: runs to its end", False)
                rows.append([rule, substeps, "failed", "", "", "", "", run.seconds])
                continue
            m = measure(run)
            ledger = coupled.ledger(run)
            rows.append([rule, substeps, m["mismatch"], m["growth"], m["spacing"], m["rows"], ledger, run.seconds])
            case.metric(f"{rule}, M={substeps}: ledger / mass", ledger, below=1e-12)
            if rule != RULES[0]:
                continue  # the paper's rule is measured beside the default, which is the one that must hold
            case.metric(f"M={substeps}: pressure mismatch / (rho g H)", m["mismatch"], below=1e-3)
            case.metric(f"M={substeps}: growth of the mismatch", m["growth"], below=1.5)
            case.metric(f"M={substeps}: smallest spacing / dx", m["spacing"], above=0.6)
            case.metric(f"M={substeps}: number of particles, in rows", m["rows"], at_most=1.0)
    case.table("Piston", ["removal", "M", "p mismatch", "growth", "spacing", "rows", "ledger", "wall s"], rows)
