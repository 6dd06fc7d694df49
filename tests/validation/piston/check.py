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
    """Pressure mismatch at the interface, error against the exact pressure, spacing of particles."""
    face = run.summary["regions"][0]["lower"][2]
    time, mismatch, error, spacing = [], [], [], []
    for moment in coupled.moments(run)[1:]:
        mismatch.append(signals.rms(coupled.differences(moment, face)[0]) / (RHO * G))
        time.append(moment.time)
        near = np.abs(moment.sph.x[:, 2] - face) < 4 * DX
        error.append(moment.sph.p[near].mean() - exact_pressure(moment.time, moment.sph.x[near, 2]).mean())
        spacing.append(coupled.smallest_spacing(moment.sph.x, WIDTH) / DX)
    time, mismatch, error = np.array(time), np.array(mismatch), np.array(error) / (RHO * G)
    # what rings is what is left without the mean over a period of the mode, 4H/c = 0.4 s, to either side
    ringing = np.array([e - error[np.abs(time - t) < 0.45].mean() for t, e in zip(time, error)])
    return {"mismatch": signals.rms(mismatch), "growth": growth(mismatch), "level": error[-len(error) // 4:].mean(),
            "ringing": signals.rms(ringing), "its growth": growth(ringing), "spacing": min(spacing)}


def number(run):
    """In rows, the largest of every window: the number of particles less that of the incompressible column; what waits
    on the faces; and the sum of both, which is the column's own difference, since particles and faces make up the
    water to round-off."""
    face, scalars = run.summary["regions"][0]["lower"][2], run.sph.scalars
    column = (S * np.cos(OMEGA * scalars["time"]) - face + 8 * DX) / DX
    particles = scalars["n_particles"] / (WIDTH / DX) - column
    waiting = scalars["mass_on_faces"] / (RHO * DX * WIDTH)
    return [np.abs(part).max() for part in (particles, waiting, particles + waiting)]


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
                rows.append([rule, substeps, "failed"] + [""] * 9 + [run.seconds])
                continue
            m = measure(run)
            ledger = coupled.ledger(run)
            particles, waiting, column = number(run)
            rows.append([rule, substeps, *m.values(), particles, waiting, column, ledger, run.seconds])
            name = f"{rule}, M={substeps}"
            case.metric(f"{name}: ledger / mass", ledger, below=1e-12)
            case.metric(f"{name}: pressure mismatch / (rho g H)", m["mismatch"], below=1e-3)
            case.metric(f"{name}: growth of the mismatch", m["growth"], below=1.5)
            case.metric(f"{name}: ringing of the column / (rho g H)", m["ringing"], below=1e-3)
            case.metric(f"{name}: growth of the ringing", m["its growth"], below=1.5)
            case.metric(f"{name}: smallest spacing / dx", m["spacing"], above=0.6)
            case.metric(f"{name}: number of particles less the water, in rows", waiting, at_most=1.0)
            case.metric(f"{name}: the water less the incompressible column, in rows", column, at_most=0.1)
            if rule == RULES[0]:  # the paper's rule uses up the whole row by itself: README.md
                case.metric(f"{name}: number of particles less the column, in rows", particles, at_most=1.0)
    case.table("Piston", ["removal", "M", "p mismatch", "growth", "p level", "ringing", "growth", "spacing", "rows",
                          "on the faces", "column", "ledger", "wall s"], rows)
