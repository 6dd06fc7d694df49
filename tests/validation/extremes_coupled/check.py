"""Far ends of what a scene may ask of the coupling: what happened, each judged finite and right, or a clear error."""

import json
import re

import numpy as np
from lib import coupled, restarts, slow, wave
from littoral_lib import signals
from scipy.spatial import cKDTree

VALIDATION = "tests/validation"
STREAM = f"{VALIDATION}/uniform_stream_coupled/plane"
PULSE = f"{VALIDATION}/acoustic_pulse_coupled/scene"
STILL = f"{VALIDATION}/still_water_surface/scene"
SURFACE_WAVE = f"{VALIDATION}/standing_wave_surface/scene"
KINDS = ("imposed", "forced")
# who and where, then what is wrong, and what to do
CLEAR = re.compile(r"(sph|fv)_solver rank \d+.*(cell \(|particle -?\d|\w+\.yaml:\d+|formula '|body '|initial\.surface).*", re.DOTALL)


class Table:
    """The rows of this case; `keep` judges a run and notes one measure of it."""

    def __init__(self, case):
        self.case, self.rows = case, []

    def run(self, name, scene, settings=(), says=None, **arguments):
        """A run that ends finite; with `says` one that is refused in these words."""
        folder = re.sub(r"\W+", "_", name)
        run = self.case.run(scene, name=folder, set=list(settings), may_fail=True, threads=1, **arguments)
        found = outcome(run, says)
        self.rows.append([name, found, "", "", run.seconds])
        self.case.holds(f"{name}: {'clear error' if says else 'finite'}", found == ("clear error" if says else "finite"))
        return run if run.status == 0 else None

    def measure(self, name, what, value, **gate):
        """A number of the run `name`, in the table and against its gate."""
        row = next(r for r in reversed(self.rows) if r[0] == name)
        if row[2]:
            self.rows.append([name, "", what, float(value), ""])
        else:
            row[2:4] = [what, float(value)]
        self.case.metric(f"{name}: {what}", value, **gate)


def outcome(run, says):
    if run.status == 124:
        return "HUNG"
    if run.status == 0:
        parts = [(part, name) for part, names in ((run.sph, ("kinetic_energy", "mass", "largest_speed")),
                                                  (run.fv, ("kinetic_energy", "mass"))) for name in names
                 if part.folder.is_dir()]
        return "finite" if all(np.isfinite(part.scalars[name]).all() for part, name in parts) else "NOT FINITE"
    return "clear error" if CLEAR.search(run.screen) and (says is None or re.search(says, run.screen)) else "UNCLEAR ERROR"


def ledger(run):
    """Defect of the particles' mass over the water that was ever in their region or on its way."""
    s = run.sph.scalars
    return np.abs(s["ledger_defect"]).max() / max(s["mass"].max(), s["mass_injected"].max(), 1e-300)


def box(lower, upper, cells):
    """A scene and its one block on another box."""
    return [f"scene.domain.lower={lower}", f"scene.domain.upper={upper}", f"fv.blocks[0].lower={lower}",
            f"fv.blocks[0].upper={upper}", f"fv.blocks[0].cells={cells}"]


def stream_error(run, velocity=(1, 0, 0.3)):
    last = coupled.Moment(run, -1)
    return max(signals.rms(last.sph.u - velocity), signals.rms(last.fv.u[last.computed] - velocity))


def substeps(t):
    end = "scene.time.end=10.65"  # three periods
    errors = {}
    for m in (10, 50):
        name = f"M = {m}, standing wave"
        run = t.run(name, "configs/standing_wave", ["scene.constants.n=25", f"scene.coupling.substeps={m}", end])
        errors[m] = wave.measure(run).elevation_error if run else np.nan
        t.measure(name, "rms error of the elevation", errors[m])
    t.measure(name, "the same over that of M = 10", errors[50] / errors[10], below=1.5)  # C16
    problems, said = t.case.check("configs/standing_wave", ["scene.coupling.substeps=50"])
    t.case.holds("M = 50: littoral check warns", not problems and any("substeps is 50" in line for line in said))


def ratio_of_spacings(t):
    lower, upper = "[-100*dx, 0, -100*dx]", "[100*dx, 0, 100*dx]"
    settings = ["scene.constants.half=30*dx", *box(lower, upper, "[20, 1, 20]"), "scene.time.end=2"]
    for kind in KINDS:
        name = f"cells ten times as wide as spacings, stream, {kind}"
        run = t.run(name, STREAM, [*settings, f"scene.coupling.kind={kind}", "scene.coupling.substeps=5"])
        if run:
            t.measure(name, "rms error of u / U", stream_error(run), below=1e-3)  # C6
            t.measure(name, "ledger", ledger(run), below=1e-12)
    name = "cells ten times as wide, ten to a wave, imposed"
    settings = ["scene.constants.H=2", "scene.constants.n=80", "scene.constants.L=2.5", "scene.constants.amplitude=0.05",
                "scene.time.end=2", "fv.blocks[0].upper=[L,0,z_face+30*dx]", "fv.blocks[0].cells=[10,1,7]",
                "scene.coupling.substeps=5"]
    run = t.run(name, "configs/standing_wave", settings)
    if run:
        t.measure(name, "rms error of the elevation", wave.measure(run).elevation_error, below=0.15)  # as `schedules`


def thin_region(t):
    for kind in KINDS:
        for half, what in ((6, "a kernel wider than its layers"), (4, "as wide as its layers")):
            name = f"region {what}, stream, {kind}"
            run = t.run(name, STREAM, [f"scene.constants.half={half}*dx", f"scene.coupling.kind={kind}", "scene.time.end=4"])
            if run:
                t.measure(name, "rms error of u / U", stream_error(run), below=1e-3)
                last = coupled.Moment(run, -1)
                closest = cKDTree(last.sph.x).query(last.sph.x, k=2)[0][:, 1].min() / 0.05
                t.measure(name, "smallest spacing / dx", closest, above=0.6)
    t.run("region half as wide as its layers", STREAM, ["scene.constants.half=2*dx"], says="thinner than its layers")


def dry_and_flooded(t):
    """A tide that takes all water out of the region, or begins there; a dam that breaks into a dry region."""
    tide, dx, s, mean, omega = t.case.folder / "tide", 0.05, 0.6, -0.2, np.pi / 8
    for begins, phase in (("high water", 0.0), ("low water, no particle at the start", np.pi)):
        name = f"tide, begins at {begins}, forced"
        run = t.run(name, tide, [f"scene.constants.phase={phase!r}"])
        if not run:
            continue
        n, g = run.sph.scalars["n_particles"], run.fv.gauges
        exact = mean + s * np.cos(omega * g["time"] + phase)
        t.measure(name, "level less the exact one / dx", np.abs(g["level.elevation"] - exact).max() / dx, below=0.5)  # C8
        t.measure(name, "fewest particles", n.min(), at_most=0)
        t.measure(name, "particles at the end less those at the start, rows", (n[-1] - n[0]) / 20, between=(-1, 1))
        errors = [np.abs(m.sph.u[:, 2] + s * omega * np.sin(omega * m.time + phase)).max() / (s * omega)
                  for m in coupled.moments(run) if len(m.sph.x)]
        t.measure(name, "particles' speed less the exact one, of the largest", max(errors), below=0.01)
        t.measure(name, "ledger", ledger(run), below=1e-12)
    t.run("tide, imposed: the grid has no surface", tide, ["scene.coupling.kind=imposed", "fv.gauges=[]"],
          says="Coupling I needs water in all fringe cells: move")
    t.run("no particle at the start, imposed: none can come", "configs/standing_wave", ["scene.initial.surface=z+0.99*H"],
          says="the scene has no particle at the start: initial.surface")

    dam = t.case.folder / "dam"
    name = "dam, grid alone"
    run = t.run(name, dam, ["scene.coupling.kind=none", "fv.time.dt=0.0133"], solver="fv")
    alone = np.abs(run.fv.scalars["mass"] / run.fv.scalars["mass"][0] - 1).max() if run else np.nan
    t.measure(name, "change of the water", alone)
    high = ["scene.constants.left=0", "scene.constants.right=20*dx", "scene.constants.below=12*dx", "scene.time.end=4"]
    for kind in KINDS:
        for what, settings in (("into a region without particles", []), ("out of the region", high)):
            name = f"dam, {what}, {kind}"
            run = t.run(name, dam, [*settings, f"scene.coupling.kind={kind}"])
            if not run:
                continue
            m = run.scalars["mass"]
            t.measure(name, "change of the water", np.abs(m / m[0] - 1).max(), at_most=alone)
            t.measure(name, "highest speed / sqrt(2 g h)", run.sph.scalars["largest_speed"].max() / np.sqrt(3), below=1.5)
            t.measure(name, "ledger", ledger(run), below=1e-12)


def surface_on_faces(t):
    dx = 0.05
    for face, where in (("lower=[L/2-half,0,0]", "lower"), ("upper=[L/2+half,0,0]", "upper")):
        for kind in KINDS:
            name = f"still surface in the region's {where} face and its corners, {kind}"
            run = t.run(name, STILL, [f"scene.regions[0].{face}", f"scene.coupling.kind={kind}"])
            if not run:
                continue
            g, late = run.fv.gauges, -5
            level = max(np.abs(g[n]).max() for n in g.names if n != "time")
            t.measure(name, "level / dx", level / dx, below=0.5)
            t.measure(name, "speed at the end / sqrt(gH)", run.sph.scalars["largest_speed"][late:].max(), below=0.01)  # C8
            t.measure(name, "ledger", ledger(run), below=1e-12)
    settings = ["scene.constants.periods=1", "scene.constants.amplitude=1.5*dx"]
    name = "wave, grid alone"
    alone = t.run(name, SURFACE_WAVE, [*settings, "scene.coupling.kind=none", "fv.time.dt=0.0375"], solver="fv")
    for kind in KINDS:
        name = f"wave through the region's corners, {kind}"
        run = t.run(name, SURFACE_WAVE, [*settings, "scene.regions[0].lower=[L/2-half,0,0]", f"scene.coupling.kind={kind}"])
        if run and alone:
            g, a = run.fv.gauges, alone.fv.gauges
            apart = max(np.abs(np.interp(a["time"], g["time"], g[n]) - a[n]).max() for n in ("end.elevation", "layer.elevation"))
            t.measure(name, "level less the grid's alone / dx", apart / dx, below=0.5)
            t.measure(name, "ledger", ledger(run), below=1e-12)


def circulation(part):
    """Of the upper vortex, around all that lies beyond the region's layers at the end (x > 24 dx, z > 0)."""
    dx, sides = 0.05, ((24, 60, 0, 0), (60, 60, 0, 38), (60, 24, 38, 38), (24, 24, 38, 0))
    around = 0.0
    for x0, x1, z0, z1 in sides:
        n = abs(x1 - x0) + abs(z1 - z0)
        f = (np.arange(n) + 0.5) / n
        points = dx * np.column_stack([x0 + f * (x1 - x0), 0 * f, z0 + f * (z1 - z0)])
        axis = 0 if z0 == z1 else 2
        around += np.sign(x1 - x0 + z1 - z0) * coupled.interpolate(part.x, part.u[:, axis], points, 3 * dx).sum() * dx
    return around


def place(run):
    """x [dx] of the upper vortex beyond the layers at the end, by its vorticity."""
    dx, s = 0.05, run.fv.snapshots[-1]
    vorticity = s["vorticity"] if s["vorticity"].ndim == 1 else s["vorticity"][:, 1]
    w = np.where((s.points[:, 2] > 0) & (s.points[:, 0] > 24 * dx), vorticity, 0.0)
    return (w * s.points[:, 0]).sum() / w.sum() / dx


def vortices_leave(t):
    pair = t.case.folder / "pair"
    name = "vortex pair, grid alone"
    alone = t.run(name, pair, ["scene.coupling.kind=none", "fv.time.dt=0.0140625"], solver="fv")
    name = "vortex pair, particles alone"
    particles = t.run(name, pair, ["scene.coupling.kind=none"], solver="sph")
    if not alone or not particles:
        return
    whole, at = circulation(coupled.Moment(alone, -1).fv), place(alone)
    kept = circulation(coupled.Moment(particles, -1).sph) / whole
    t.measure(name, "circulation over the grid's alone", kept)
    for kind in KINDS:
        name = f"vortex pair leaves, {kind}"
        run = t.run(name, pair, [f"scene.coupling.kind={kind}"])
        if not run:
            continue
        last = coupled.Moment(run, -1)
        t.measure(name, "circulation over the grid's alone", circulation(last.fv) / whole, above=1 - 1.1 * (1 - kept))  # C10
        t.measure(name, "behind the grid's alone / dx", at - place(run))
        t.measure(name, "speed left in the region / V", np.linalg.norm(last.sph.u[np.abs(last.sph.x[:, 0]) < 0.4], axis=1).max(),
                  below=0.5)
        t.measure(name, "ledger", ledger(run), below=1e-12)


def shock(t):
    """A piston of .1 c: p = P rho c^2 with P/sqrt(1+P) = .1, front at c sqrt(1+P), of an equation of state linear in rho."""
    a = 0.1
    P = 0.5 * (a**2 + a * np.sqrt(a**2 + 4))
    settings = [f"scene.constants.A={a}", "scene.initial.u=A*c*(x<start)", "scene.initial.p=1000*c^2*A*(x<start)",
                "scene.domain.x=[open,open]", "fv.blocks[0].faces={x_lower: {condition: inflow, u: A*c}, x_upper: {condition: slip}}",
                *box("[-120*dx,0,0]", "[120*dx,0,12*dx]", "[240,1,12]"), "scene.time.end=180*dx/c",
                "scene.time.field_interval=180*dx/c", "scene.reference_velocity=0.1"]
    for kind in KINDS:
        name = f"shock, .1 rho c^2, {kind}"
        run = t.run(name, PULSE, [*settings, f"scene.coupling.kind={kind}"])
        if not run:
            continue
        last = coupled.Moment(run, -1)
        p, x = last.fv.p / 1000, last.fv.x[:, 0]
        free = np.abs(last.sph.x[:, 0]) < 0.2
        t.measure(name, "particles' pressure behind it over the exact one - 1", (last.sph.p[free] / 1000 / P).mean() - 1,
                  between=(-0.02, 0.02))
        front = x[last.computed & (p > 0.5 * P)].max()
        t.measure(name, "front less the exact place / dx", (front - (-1 + np.sqrt(1 + P) * last.time)) / 0.01, between=(-5, 5))
        before = last.computed & (x < -0.4) & (x > -1)
        t.measure(name, "what came back / P", np.abs(p[before] / P - 1).max(), below=0.05)  # C9


def column(t):
    """The gravest mode of a closed column, started in motion, M = 10: 6.7 windows a period, 100 periods."""
    settings = ["scene.constants.n=25", "scene.constants.L=10*dx", "scene.coupling.substeps=10", "scene.fluid.viscosity=0",
                "scene.initial.w=1e-3*sin(pi/2*(z+H)/H)", "scene.time.end=40", "scene.time.field_interval=20",
                "fv.gauges=[{name: bottom, kind: point, at: [L/2,0,-0.98*H]}]"]
    for schedule in ("serial", "predicted", "iterated", "concurrent"):
        name = f"acoustic mode of a column, M = 10, {schedule}"
        run = t.run(name, "configs/still_water", [*settings, f"scene.coupling.schedule={schedule}"])
        if run:
            time, p = run.fv.gauges["time"], run.fv.gauges["bottom.p"] / 1000
            rings = p - signals.moving_mean(time, p, 0.4)
            t.measure(name, "rms of the first fifth / (rho g H)", signals.rms(rings[:len(rings) // 5]))
            t.measure(name, "growth, last over first fifth", signals.growth(rings), below=1.5)  # C7
            t.measure(name, "the same over the second fifth", signals.growth(rings[len(rings) // 5:], 4), below=1.5)


def reversing(t):
    for kind in KINDS:
        name = f"stream that reverses twice, {kind}"
        run = t.run(name, STREAM, [
            f"scene.coupling.kind={kind}", "scene.constants.T=2.4", "scene.initial.u=U*sin(2*pi*t/T)",
            "scene.initial.w=0.3*U*sin(2*pi*t/T)", "scene.body_force.x=U*2*pi/T*cos(2*pi*t/T)",
            "scene.body_force.z=0.3*U*2*pi/T*cos(2*pi*t/T)", "scene.time.end=2.4", "scene.time.field_interval=0.3",
            "scene.coupling.substeps=5"])
        if not run:
            continue
        u, spacing = 0.0, np.inf
        for m in coupled.moments(run)[1:]:
            exact = np.sin(2 * np.pi * m.time / 2.4) * np.array([1, 0, 0.3])
            u = max(u, signals.rms(m.sph.u - exact), signals.rms(m.fv.u[m.computed] - exact))
            spacing = min(spacing, cKDTree(m.sph.x).query(m.sph.x, k=2)[0][:, 1].min() / 0.05)
        t.measure(name, "rms error of u / U", u, below=0.01)
        t.measure(name, "smallest spacing / dx", spacing, above=0.5)
        t.measure(name, "ledger", ledger(run), below=1e-12)


def no_numbers(t):
    nan = "0*sqrt(0.05-t)"
    for what, setting, says in (
            ("the grid", f"fv.sponges=[{{axis: x, from: 1, to: 1.4, rate: 1, u: {nan}}}]", r"sponges\[0\]\.u: the formula .*nan at \("),
            ("the particles", f"scene.bodies=[{{name: rod, shape: cylinder, radius: 0.15, motion: {{x: {nan}}}}}]",
             "sph_solver rank 0.*body 'rod': its motion.x has no finite value"),
            ("both", f"scene.body_force.x={nan}", r"body_force\.x: the formula .*nan at \(")):
        name = f"a formula of {what} becomes NaN"
        t.run(name, STREAM, [setting, "scene.time.end=1"], says=says, timeout=60)
        t.measure(name, "seconds until both have ended", t.rows[-1][4], below=20)  # as bad_input


def long_rest(t):
    name = "still water, 10 000 windows"
    run = t.run(name, "configs/still_water", [
        "scene.constants.n=25", "scene.constants.L=10*dx", "scene.time.end=1000", "scene.time.max_windows=10000",
        "scene.time.field_interval=0", "fv.output.scalars_every=10"], timeout=900)
    if run:
        s, g = run.sph.scalars, run.sph.gauges
        late = g["time"] > 0.25 * g["time"][-1]
        slope = np.polyfit(g["time"][late], g["middle.elevation"][late], 1)[0] * 3.55 / 0.04
        t.measure(name, "windows", len(s) - 1, at_least=10000)
        t.measure(name, "largest speed / sqrt(gH)", s["largest_speed"].max(), below=5e-3)  # C12q
        t.measure(name, "slope of the level a period of 3.55 sqrt(H/g) / dx", slope, between=(-0.01, 0.01))
        t.measure(name, "change of the water", np.abs(run.scalars["mass"] / run.scalars["mass"][0] - 1).max(), below=1e-3)
        t.measure(name, "ledger", ledger(run), below=1e-12)


def same_rows(one, two):
    """Columns of the scalars of both programs that differ, wall times left out."""
    return [f"{side}.{c}" for side in ("sph", "fv") for c in getattr(one, side).scalars.names if not c.startswith("seconds")
            and not np.array_equal(getattr(one, side).scalars[c], getattr(two, side).scalars[c], equal_nan=True)]


def slow_partner(t):
    settings = ["scene.constants.n=25", "scene.time.end=0.6", "scene.coupling.substeps=2"]
    plain = t.run("a short wave, undisturbed", "configs/standing_wave", settings)
    for program in ("sph", "fv"):
        name = f"{program}_solver ten times slower"
        with slow.Slowed(program, t.case.out / re.sub(r"\W+", "_", name), for_seconds=20) as held:
            run = t.run(name, "configs/standing_wave", settings)
        t.measure(name, "seconds stopped of its wall time", held.stopped, above=1)
        if run and plain:
            t.measure(name, "columns of scalars that differ", len(same_rows(plain, run)), at_most=0)


def restarts_of_a_breaker(t):
    """The dam's wave runs up the far wall, falls back, breaks, and goes out through the region's face from t = 5.5 on."""
    dam = t.case.folder / "dam"
    settings = ["scene.time.end=7", "scene.time.checkpoint_interval=0.5", "scene.time.field_interval=0"]
    for kind in KINDS:
        name = f"breaker, {kind}"
        whole = t.run(name, dam, [*settings, f"scene.coupling.kind={kind}"])
        if not whole:
            continue
        windows = restarts.common_windows(whole)
        t.measure(name, "checkpoints", len(windows), at_least=13)
        for moment in (1, 3, 9, 10, 11, 12):  # dry, flooding, falling back, breaking, through the face
            again = restarts.go_on(t.case, dam, f"breaker_{kind}_{moment}", windows[moment - 1], whole, threads=1,
                                   set=[*settings, f"scene.coupling.kind={kind}"])
            differing = restarts.differences(whole, again, windows[-1])
            count = sum(1000 if d is None else len(d) for d in differing.values())
            t.measure(name, f"restarted at t = {0.5 * moment:g}: datasets of the last checkpoint that differ", count, at_most=0)


GROUPS = (substeps, ratio_of_spacings, thin_region, dry_and_flooded, surface_on_faces, vortices_leave, shock, column, reversing,
          no_numbers, long_rest, slow_partner, restarts_of_a_breaker)


def check(case):
    t = Table(case)
    for group in GROUPS:
        group(t)
    case.table("Extremes", ["what", "outcome", "measure", "value", "wall s"], t.rows)
    (case.out / "extremes.json").write_text(json.dumps(t.rows, default=str), encoding="utf-8")
