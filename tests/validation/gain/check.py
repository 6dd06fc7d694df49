"""The viscous standing wave and the submerged cylinder by particles alone, by the grid alone, by both: error, CPU seconds, memory."""

import numpy as np
from lib import submerged_cylinder
from littoral_lib import exact, signals

KEPT, PERIOD = 0.606, 3.568  # of the linear normal mode at Re = 250: energy a (inviscid) period; [s]
WAVE = {"particles": ("tests/validation/standing_wave_sph/scene", "sph", (25, 50)),
        "grid": ("tests/validation/viscous_wave_fv/scene", "fv", (10, 25, 50)),
        "both": ("configs/standing_wave", None, (25, 50))}
CYLINDER = {"grid": ("tests/validation/submerged_cylinder_fv/scene", "fv", (8, 16)), "both": ("configs/submerged_cylinder", None, (16,))}
MEBIBYTE = 2.0**20


def cost(run):
    """[CPU seconds, MiB] of all programs of a run."""
    results = [p.summary["results"] for p in (run.sph, run.fv) if p.summary]
    return [sum(r["cpu_seconds"] for r in results), sum(r["peak_memory"] for r in results) / MEBIBYTE]


def wave(case):
    rows = []
    inviscid = exact.StandingWave(0.05, np.pi, 1.0, 1.0, 0.0, 1.0).period0
    for who, (scene, solver, sizes) in WAVE.items():
        for n in sizes:
            run = case.run(scene, solver=solver, name=f"wave_{who}_{n}", threads=1, set=[f"scene.constants.n={n}"])
            s = run.scalars
            times, peaks = signals.peaks(s["time"], s["kinetic_energy"], 0.2 * inviscid)
            kept = signals.kept_per(times, peaks, inviscid)
            whole = (len(times) - 1) // 2 * 2
            period = 2 * (times[whole] - times[0]) / whole
            rows.append([who, n, 100 * (period / PERIOD - 1), 100 * (kept / KEPT - 1), *cost(run)])
            case.metric(f"wave, {who}, H/dx = {n}: energy kept over the normal mode's - 1", kept / KEPT - 1)
    case.table("Viscous standing wave", ["", "H/dx", "period %", "energy kept %", "CPU s", "MiB"], rows)


def particles_alone(summary, count):
    """CPU seconds of so many particles over the steps of a coupled run, at the cost of its own less the coupling's."""
    results, phases = summary["results"], summary["phases"]
    worked = summary["wall_time"] - phases["wait"]
    a_step = results["cpu_seconds"] * (1 - phases["coupling"] / worked) / (results["particle_steps_per_second"] * worked)
    return a_step * count * results["steps"]


def cylinder(case):
    rows = []
    for who, (scene, solver, sizes) in CYLINDER.items():
        for n in sizes:
            run = case.run(scene, solver=solver, name=f"cylinder_{who}_{n}", threads=1, set=[f"scene.constants.n={n}"])
            g, s = run.fv.gauges, run.fv.scalars
            drag = (g["cylinder.dynamic_fx"] / submerged_cylinder.DYNAMIC_PRESSURE)[g["time"] > submerged_cylinder.START].mean()
            volume = np.abs(s["volume_error"]).max() / s["water_volume"][0]
            rows.append([who, n, drag, volume, float(s["thin_water_cells"].max()), *cost(run)])
            case.metric(f"cylinder, {who}, d/dx = {n}: C_D", drag)
            if who == "both":
                rows.append(["particles, estimated", n, float("nan"), 0.0, 0.0, particles_alone(run.sph.summary, 80 * 6 * n**2), float("nan")])
    case.table("Submerged cylinder to tU/d = 60", ["", "d/dx", "C_D", "volume", "threads and drops, most", "CPU s", "MiB"], rows)


def check(case):
    cylinder(case)
    wave(case)
