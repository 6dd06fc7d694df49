"""Error and cost of one choice at a time on Taylor-Green vortices, the drop and a dam break: one table.

Costs are processor seconds of one thread: other work on the machine lengthens these less than the wall time.
"""

import math
import resource

import numpy as np
from lib import water
from littoral_lib import exact, signals

CHOICES = {
    "as it is (unlimited, linearised, R = 4 dx)": [],
    "kernel_radius 3": ["sph.kernel_radius=3"],
    "kernel_radius 5": ["sph.kernel_radius=5"],
    "first_order": ["sph.reconstruction=first_order"],
    "minmod": ["sph.reconstruction=minmod"],
    "van_leer": ["sph.reconstruction=van_leer"],
    "low_dissipation": ["sph.riemann=low_dissipation"],
    "low_dissipation, kernel_radius 3": ["sph.riemann=low_dissipation", "sph.kernel_radius=3"],
    "no shifting": ["sph.shifting.enabled=false"],
    "tension: switched": ["sph.tension=switched"],
    "precision: mixed": ["sph.precision=mixed"],
    "integrator: midpoint": ["sph.time.integrator=midpoint"],
}
CHOICES |= {f"fidelity: {preset}": [f"sph.fidelity={preset}"] for preset in ("draft", "standard", "reference")}


def timed(case, scene, **settings):
    """A run, and the processor time it took [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = case.run(scene, solver="sph", threads=1, may_fail=True, **settings)
    return run, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def taylor_green(case, name, settings, n, distribution):
    """Relative error of the kinetic energy at t = L/U, and seconds."""
    # the scene's own radius is not the default
    radius = 3 if "sph.fidelity=draft" in settings else 4
    plain = [] if any("kernel_radius" in s for s in settings) else [f"sph.kernel_radius={radius}"]
    run, seconds = timed(case, "tests/validation/taylor_green_sph/scene", name=f"tg_{distribution}_{name}",
                         set=[f"scene.constants.n={n}", f"sph.initial_distribution={distribution}"] + plain + settings)
    if run.status != 0:
        return math.nan, seconds
    energy = run.sph.scalars["kinetic_energy"]
    return energy[-1] / energy[0] / math.exp(-16 * math.pi**2 / 100) - 1, seconds


def drop(case, name, settings, n):
    """Rms error of a(t) over R in one period, and seconds."""
    run, seconds = timed(case, "tests/validation/oscillating_drop/scene", name=f"drop_{name}",
                         set=[f"scene.constants.n={n}", "scene.time.end=4.9"] + settings)
    if run.status != 0:
        return math.nan, seconds
    bodies = [water.Body(s) for s in run.sph.snapshots]
    a = np.array([b.semi_axis(0) for b in bodies])
    return signals.rms(a - exact.OscillatingDrop(1, 1, 1, 5).axes([b.time for b in bodies])[0]), seconds


def dam_break(case, name, settings, n):
    """Speed of the front over sqrt(gH) for 1.5 < t* < 2.5, share of the released energy that is lost, and seconds."""
    run, seconds = timed(case, case.folder / "dam_break", name=f"dam_{name}",
                         set=[f"scene.constants.n={n}"] + settings)
    if run.status != 0:
        return math.nan, math.nan, seconds
    snapshots = run.sph.snapshots
    time = np.array([s.time for s in snapshots])
    front = np.array([s.points[:, 0].max() for s in snapshots])
    late = time > 1.45
    speed = np.polyfit(time[late], front[late], 1)[0]
    scalars = run.sph.scalars
    released = scalars["potential_energy"][0] - scalars["potential_energy"][-1]
    return speed, 1 - scalars["kinetic_energy"][-1] / released, seconds


def key_of(name):
    return "".join(c if c.isalnum() else "_" for c in name)


def check(case):
    rows = []
    for name, settings in CHOICES.items():
        key = key_of(name)
        relaxed, seconds = taylor_green(case, key, settings, 50, "relaxed")
        lattice, _ = taylor_green(case, key, settings, 50, "lattice")
        shape, drop_seconds = drop(case, key, settings, 20)
        speed, lost, dam_seconds = dam_break(case, key, settings, 25)
        rows.append([name, lattice, relaxed, shape, speed, lost, seconds, drop_seconds, dam_seconds])
        case.metric(f"{name}: Taylor-Green, error of E(1)", relaxed)
    case.table("Choices", ["choice", "TG from a lattice", "TG relaxed", "drop, rms a / R", "front / sqrt(gH)",
                           "energy lost", "TG s", "drop s", "dam s"], rows)
