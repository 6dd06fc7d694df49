"""The wave of C12 by particles alone: period, energy kept a period, mass."""

import math

from littoral_lib.compare import StandingWaveRun


def check(case):
    rows = []
    for n in (25, 50):
        run = case.run(case.folder / "scene", set=[f"scene.constants.n={n}"], name=f"n{n}", solver="sph")
        history = StandingWaveRun(run.out)
        wave = history.wave
        period_error = history.period() / wave.period - 1
        kept = history.energy_kept()
        kept_low = math.exp(-4 * wave.nu * wave.k**2 * wave.period0)
        mass_error = float(abs(history.mass / history.mass[0] - 1).max())
        rows.append([n, period_error, kept, mass_error, history.level(), run.seconds])
        case.metric(f"n={n}: period error", period_error, between=(-0.015, 0.015))
        # between the irrotational decay and the normal mode, 8% either way
        case.metric(f"n={n}: energy kept a period", kept, between=(0.92 * kept_low, 1.08 * wave.mode_energy_kept))
        case.metric(f"n={n}: mass error", mass_error, at_most=1e-12)  # particles keep their mass
    case.table("Standing wave by particles", ["H/dx", "period error", "energy kept", "mass error", "mean level", "wall s"],
               rows)
