"""Inner drop, flux, precision and step: error and cost on Taylor-Green, the cavity and a cylinder in a ring, Re = 100."""

import math

from lib import grid
from littoral_lib import signals

KEPT = math.exp(-4 * (1 / 100) * (2 * math.pi) ** 2)  # of the energy at t = 1, Re = 100
CAVITY = {"u_min": -0.2139, "w_max": 0.1794, "w_min": -0.2536}
CHOICES = [(f"drop 1e-{k}", [f"fv.dual_time.drop=1e-{k}"]) for k in (1, 2, 3, 4)]
CHOICES += [("flux central4", ["fv.flux=central4"]),
            ("limiter van_albada", ["fv.limiter=van_albada"]),
            ("precision double", ["fv.dual_time.precision=double"])]
CHOICES += [(f"fidelity {name}", [f"fv.fidelity={name}"]) for name in ("draft", "standard", "reference")]
STEPS = [("dt x 4", 4.0), ("dt x 2", 2.0), ("dt / 2", 0.5)]
FINE = 1.319, 0.322, 0.1631  # C_D, amplitude of C_L, St on the ring of twice the cells, dt/2: cylinder_ring/README.md


def coefficients(run):
    """C_D, amplitude of C_L, St."""
    s = run.fv.scalars
    found = signals.shedding(s["time"], 2 * s["cylinder.fx"], 2 * s["cylinder.fz"], 50)
    return found["drag"], found["amplitude"], found["frequency"]


def cylinder(case, name, settings, dt):
    run = case.run(case.folder.parent / "cylinder_ring" / "scene", solver="fv",
                   name=f"cylinder_{name}".replace(" ", "_").replace("/", "over"),
                   set=["scene.time.end=80", "fv.output.fields=false", f"fv.time.dt={dt}*d/U", "fv.rings[0].around=64",
                        "fv.rings[0].outward=48", "fv.rings[0].spacing.first_cell=6e-3*d"] + settings)
    return coefficients(run), run


def cost(run):
    results = run.fv.summary["results"]
    return [results["inner_cycles_per_step"], results["microseconds_per_cell_and_step"]]


def check(case):
    vortices, cavity = case.folder.parent / "taylor_green_fv" / "scene", case.folder.parent / "cavity" / "scene"
    rows, cycles = [], {}

    def taylor_green(name, settings, dt):
        run = case.run(vortices, solver="fv", name=f"vortices_{name}".replace(" ", "_").replace("/", "over"),
                       set=["scene.fluid.sound_speed=.inf", "fv.blocks[0].cells=[64,1,64]", f"fv.time.dt={dt}"] + settings)
        energy = run.fv.scalars["kinetic_energy"]
        rows.append(["Taylor-Green", name, energy[-1] / energy[0] / KEPT - 1] + cost(run))
        cycles[name] = rows[-1][3]
        return rows[-1][2]

    errors = {name: taylor_green(name, settings, 0.01) for name, settings in CHOICES}
    for name, factor in STEPS:
        taylor_green(name, [], 0.01 * factor)
    for name, settings in CHOICES:
        run = case.run(cavity, solver="fv", name=f"cavity_{name}".replace(" ", "_"),
                       set=["fv.blocks[0].cells=[64,1,64]"] + settings)
        g = grid.Planar(run.fv.snapshots[-1])
        w = grid.middle(g.w, 0), grid.middle(g.x, 0)
        u = grid.middle(g.u, 1), grid.middle(g.z, 1)
        found = {"u_min": grid.extremum(u[1], u[0], -1)[0], "w_max": grid.extremum(w[1], w[0], 1)[0],
                 "w_min": grid.extremum(w[1], w[0], -1)[0]}
        rows.append(["cavity", name, max((abs(found[q] / CAVITY[q] - 1) for q in CAVITY))] + cost(run))
    shed = []
    for name, settings, dt in [(n, s, 0.06) for n, s in CHOICES] + [(n, [], 0.06 * f) for n, f in STEPS]:
        found, run = cylinder(case, name, settings, dt)
        shed.append([name, *found, *(f / fine - 1 for f, fine in zip(found, FINE))] + cost(run))
    case.table("Cylinder, Re = 100, ring 64 x 48, dt .06 d/U",
               ["choice", "C_D", "C_L amplitude", "St", "error of C_D", "of C_L", "of St", "cycles a step", "us a cell and step"],
               shed)
    case.table("Error and cost", ["flow", "choice", "error", "cycles a step", "us a cell and step"], rows)
    case.metric("standard: error of the energy kept", errors["fidelity standard"], between=(-0.005, 0.005))
    case.metric("reference: error of the energy kept", errors["fidelity reference"], between=(-0.005, 0.005))
    case.metric("precision double over single: cycles", cycles["precision double"] / cycles["drop 1e-3"],
                between=(0.9, 1.1))
