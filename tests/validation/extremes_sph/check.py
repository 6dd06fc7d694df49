"""Far ends of what a scene may ask of the particles: what happened, each judged finite and right, or a clear error.

The short ones (one particle, one row, units, far splashes, creeping water) are ctests: tests/extremes/sph.
"""

import json
import math
import re

import numpy as np
from lib import water
from littoral_lib import exact, signals

DROP = "tests/validation/oscillating_drop/scene"
PATCH = "tests/validation/rotating_square_patch/scene"
TAYLOR_GREEN = "tests/validation/taylor_green_sph/scene"
CLEAR = re.compile(r"particle -?\d+ .*(cfl|sound speed|spacing)", re.DOTALL)


def outcome(run):
    """finite | clear error | anything else, of a run that may have failed."""
    if run.status == 0:
        values = [run.sph.scalars[c] for c in ("kinetic_energy", "potential_energy", "mass", "largest_speed")]
        return "finite" if all(np.isfinite(v).all() for v in values) else "NOT FINITE"
    return "clear error" if CLEAR.search(run.screen) else "UNCLEAR ERROR"


def drop_error(run, strain=1.0):
    bodies = [water.Body(s) for s in run.sph.snapshots]
    time = np.array([b.time for b in bodies])
    a = np.array([b.semi_axis(0) for b in bodies])
    return signals.rms(a - exact.OscillatingDrop(1, strain, strain, time[-1]).axes(time)[0])


def check(case):
    rows = []

    def row(name, run, measure="", value=math.nan, **gate):
        found = outcome(run)
        rows.append([name, found, measure, value, run.seconds])
        case.holds(f"{name}: finite, or a clear error", found in ("finite", "clear error"))
        if gate and run.status == 0:
            case.metric(f"{name}: {measure}", value, **gate)
        return found

    def run_of(scene, name, settings):
        return case.run(scene, set=settings, name=name, solver="sph", may_fail=True)

    # CFL at and past its limit, on one period of the drop: the limit of the key is 1
    for cfl in (0.375, 0.6, 0.8, 1.0):
        run = run_of(DROP, f"cfl{cfl}", ["scene.constants.n=20", "scene.time.end=4.9", f"sph.time.cfl={cfl}"])
        right = {"below": 0.05} if cfl == 0.375 else {}
        row(f"drop, cfl {cfl}", run, "rms of a / R", drop_error(run) if run.status == 0 else math.nan, **right)

    # c over the highest speed from 5 to 500, on half a period of the drop (the first is below what the method asks)
    for mach in (5, 10, 50, 500):
        for riemann in ("linearised", "low_dissipation"):
            n = 10 if mach == 500 else 20
            run = run_of(DROP, f"c{mach}_{riemann}", [f"scene.constants.n={n}", f"scene.constants.c={2 * mach}",
                         f"scene.time.end={0.5 if mach == 500 else 2.4}", f"sph.riemann={riemann}"])
            row(f"drop, c/U = {mach}, {riemann}", run, "rms of a / R", drop_error(run) if run.status == 0 else math.nan,
                **({"below": 0.05} if riemann == "low_dissipation" and mach > 5 else {}))

    # from no viscosity to creeping: one tenth of the energy left of Taylor-Green vortices
    for reynolds in (1e9, 100, 1, 0.01):
        end = min(1.0, math.log(10) * reynolds / (16 * math.pi**2))
        run = run_of(TAYLOR_GREEN, f"re{reynolds:g}", ["scene.constants.n=24", f"scene.constants.Re={reynolds}",
                     f"scene.time.end={end}", "sph.kernel_radius=4"])
        energy = run.sph.scalars["kinetic_energy"] if run.status == 0 else [1, math.nan]
        kept = energy[-1] / energy[0] / math.exp(-16 * math.pi**2 * end / reynolds)
        row(f"vortices, Re = {reynolds:g}", run, "E over exact", kept, **({"between": (0.85, 1.15)} if reynolds < 10 else {}))

    # a drop of a millimetre and a basin of kilometres: the same flow. Powers of two, because on a lattice round-off decides
    # ties of the surface detection (a neighbour at 45 degrees): other factors change a(t) by 1e-6
    reference = None
    for name, radius, strain, density in (("metre", 1.0, 1.0, 1000.0), ("millimetre, heavy", 2.0**-10, 32.0, 16000.0),
                                          ("eight kilometres, light", 2.0**13, 2.0**-5, 1000.0 / 1024)):
        run = run_of(DROP, f"units_{name.split(',')[0].replace(' ', '_')}", ["scene.constants.n=20",
                     f"scene.constants.R={radius}", f"scene.constants.A0={strain}", f"scene.fluid.density={density}",
                     f"scene.initial.p={density}*A0^2*(R^2-x^2-z^2)", f"scene.time.end={2.4 / strain}"])
        a = np.array([water.Body(s).semi_axis(0) for s in run.sph.snapshots]) / radius
        reference = a if reference is None else reference
        row(f"drop, units of a {name}", run, "a(t) differs by", float(np.abs(a - reference).max()), below=1e-12)

    # two jets: water hammer first, then about the stagnation pressure rho U^2/2
    for reconstruction in ("unlimited", "minmod"):
        run = run_of(case.folder / "jets", f"jets_{reconstruction}", [f"sph.reconstruction={reconstruction}"])
        gauge, bodies = run.sph.gauges, [water.Body(s) for s in run.sph.snapshots]
        energy = run.sph.scalars["kinetic_energy"]
        row(f"jets, {reconstruction}", run, "kinetic energy over its start", energy.max() / energy[0], at_most=1.001)
        late = (gauge["time"] > 0.5) & np.isfinite(gauge["middle.p"])  # rings with the sound of the impact
        case.metric(f"jets, {reconstruction}: mean p in the middle", gauge["middle.p"][late].mean() / 500, unit="rho U^2/2")
        hammer = np.nanmax(gauge["middle.p"]) / (1000 * 20)  # a limited state cannot overshoot a plane impact's rho c U
        case.metric(f"jets, {reconstruction}: highest pressure", hammer, unit="rho c U",
                    **({"at_most": 1.05} if reconstruction == "minmod" else {}))
        momentum = max(np.hypot(*b.momentum) for b in bodies) / bodies[0].mass.sum()
        case.metric(f"jets, {reconstruction}: momentum", momentum, below=1e-10, unit="M U")

    # voids that open or close, for long
    run = run_of(PATCH, "patch_long", ["scene.time.end=6"])
    holes = [len(water.holes(s, 0.02, 0.08)) for s in run.sph.snapshots] if run.status == 0 else []
    row("square patch until w t = 6", run, "most holes at a time", max(holes, default=math.nan))
    run = run_of(DROP, "drop_20", ["scene.constants.n=16", "scene.time.end=96.6", "scene.time.field_interval=0.1"])
    bodies = [water.Body(s) for s in run.sph.snapshots] if run.status == 0 else []
    swing = np.array([b.semi_axis(0) - b.semi_axis(2) for b in bodies])
    time = np.array([b.time for b in bodies])
    period = exact.OscillatingDrop(1, 1, 1, 10).period
    row("drop, 20 periods", run, "period over exact", signals.mean_period(time, swing) / period if len(time) else math.nan,
        between=(0.96, 1.04))
    if len(time):
        last = time > time[-1] - period
        case.metric("drop, 20 periods: swing left", np.abs(swing[last]).max() / np.abs(swing).max())
        case.metric("drop, 20 periods: angular momentum", max(abs(b.angular_momentum) for b in bodies) / bodies[0].mass.sum(),
                    unit="M A0 R^2")

    # a tank a million times longer than deep: too short for its kernel along z, and one that is deep enough
    run = run_of("tests/validation/surface_detection/plane", "thin", ["scene.domain.upper=[1000000, 0, 1]",
                 "scene.initial.surface=z-1", "sph.spacing=0.25", "scene.time.max_windows=2",
                 "scene.domain.x=[symmetry, symmetry]", "scene.domain.z=[symmetry, symmetry]"])
    said = "closed at both ends" in run.screen or "less than the reach" in run.screen
    rows.append(["aspect 1e6, closed, thinner than the kernel", "clear error" if said else outcome(run), "", math.nan,
                 run.seconds])
    case.holds("aspect 1e6, closed, thinner than the kernel: a clear error", run.status != 0 and said)
    run = run_of("tests/validation/surface_detection/plane", "film", ["scene.domain.upper=[100000, 0, 0.5]",
                 "scene.initial.surface=z-0.1", "sph.spacing=0.1", "scene.time.max_windows=3",
                 "scene.domain.x=[symmetry, symmetry]", "scene.domain.z=[symmetry, open]", "sph.output.fields=[surface]"])
    flagged = run.sph.snapshots[-1]["surface"] == 2 if run.status == 0 else np.zeros(1)
    row("film of one row, a million spacings long", run, "share flagged as surface", flagged.mean())

    case.table("Extremes", ["what", "outcome", "measure", "value", "wall s"], rows)
    (case.out / "extremes.json").write_text(json.dumps(rows, default=str), encoding="utf-8")
