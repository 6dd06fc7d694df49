"""C7: particles enter and leave through the interface; ledger, number, spacing and pressure over 20 periods of 4H/c."""

import numpy as np
from lib import coupled
from littoral_lib import signals

S, OMEGA, RHO, G, DX, WIDTH = 0.12, np.pi / 2, 1000.0, 1.0, 0.04, 0.8
RULES = ("crossing", "nearest")


def exact_pressure(t, z):
    eta = S * np.cos(OMEGA * t)
    return RHO * (G - S * OMEGA**2 * np.cos(OMEGA * t)) * (eta - z)


def measure(run):
    """Pressure mismatch at the interface, error against the exact pressure, number and spacing of particles."""
    face = run.summary["regions"][0]["lower"][2]
    time, mismatch, error, spacing, rows = [], [], [], [], []
    for moment in coupled.moments(run)[1:]:
        mismatch.append(signals.rms(coupled.differences(moment, face)[0]) / (RHO * G))
        time.append(moment.time)
        near = np.abs(moment.sph.x[:, 2] - face) < 4 * DX
        error.append(moment.sph.p[near].mean() - exact_pressure(moment.time, moment.sph.x[near, 2]).mean())
        spacing.append(coupled.smallest_spacing(moment.sph.x, WIDTH) / DX)
        expected = WIDTH * (S * np.cos(OMEGA * moment.time) - face + 8 * DX) / DX**2
        rows.append((len(moment.sph.x) - expected) / (WIDTH / DX))
    time, mismatch, error = np.array(time), np.array(mismatch), np.array(error) / (RHO * G)
    # what rings is what is left without the mean over a period of the mode, 4H/c = 0.4 s, to either side
    ringing = np.array([e - error[np.abs(time - t) < 0.45].mean() for t, e in zip(time, error)])
    return {"mismatch": signals.rms(mismatch), "growth": growth(mismatch), "level": error[-len(error) // 4:].mean(),
            "ringing": signals.rms(ringing), "its growth": growth(ringing), "spacing": min(spacing),
            "rows": max(np.abs(rows))}


def growth(signal):
    """Rms of the last quarter over that of the second: the run starts exact, on a lattice that leaves in the first."""
    n = len(signal) // 4
    return signals.rms(signal[-n:]) / signals.rms(signal[n:2 * n])


def check(case):
    rows = []
    for rule in RULES:
        for substeps in (1, 5, 10):
            run = case.run("configs/piston", name=f"{rule}_m{substeps}", may_fail=True,
                           set=[f"scene.coupling.substeps={substeps}", f"sph.coupling.removal={rule}"])
            if run.status != 0:
                case.holds(f"{rule}, M={substeps}: runs to its end", False)
                rows.append([rule, substeps, "failed"] + [""] * 7 + [run.seconds])
                continue
            m = measure(run)
            ledger = coupled.ledger(run)
            rows.append([rule, substeps, *m.values(), ledger, run.seconds])
            case.metric(f"{rule}, M={substeps}: ledger / mass", ledger, below=1e-12)
            if rule != RULES[0]:
                continue  # the paper's rule is measured beside the default, which is the one that must hold
            case.metric(f"M={substeps}: pressure mismatch / (rho g H)", m["mismatch"], below=1e-3)
            case.metric(f"M={substeps}: growth of the mismatch", m["growth"], below=1.5)
            case.metric(f"M={substeps}: ringing of the column / (rho g H)", m["ringing"], below=1e-3)
            case.metric(f"M={substeps}: growth of the ringing", m["its growth"], below=1.5)
            case.metric(f"M={substeps}: smallest spacing / dx", m["spacing"], above=0.6)
            case.metric(f"M={substeps}: number of particles, in rows", m["rows"], at_most=1.0)
    case.table("Piston", ["removal", "M", "p mismatch", "growth", "p level", "ringing", "growth", "spacing", "rows", "ledger",
                          "wall s"], rows)
