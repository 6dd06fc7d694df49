"""Energy kept, period and mass of C12's wave by the grid alone."""

from lib import level_set

INVISCID, VISCOUS = 3.5515, 3.568  # [s] periods: linear inviscid, linear at Re = 250


def check(case):
    run = case.run(case.folder / "scene", solver="fv", name="wave")
    s = run.fv.scalars
    # E over the level at rest: rho g H^2 L/2 = 1000
    energy = s["kinetic_energy"] + s["potential_energy"] + 1000.0
    at = [abs(s["time"] - k * INVISCID).argmin() for k in range(6)]
    kept = (energy[at[5]] / energy[at[0]]) ** 0.2
    wave = level_set.swing(s)
    case.metric("energy kept in an inviscid period", kept, between=(0.571 * 0.92, 0.606 * 1.08))
    case.metric("energy kept over the normal mode's .606 - 1", kept / 0.606 - 1)
    case.metric("period over the exact one - 1", wave.period / VISCOUS - 1, between=(-0.015, 0.015))
    case.metric("mass, largest change", wave.volume, below=1e-3)
