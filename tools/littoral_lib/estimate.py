"""What a scene will cost: particles, cells, steps and memory as the programs foresee them, seconds from a trial."""

import csv
import re
import tempfile

from .errors import UserError
from .scene import evaluate

PROGRAM_BYTES = 40 * 2**20  # a program with its libraries, before it holds anything
CELL_BYTES = 2500           # state of three times, residuals, and the blocks of the implicit side with its levels
TRIAL_WINDOWS = 40          # the first quarter is not counted: lists, caches and steps settle in it


def default_kernel_radius(dimension, fidelity):
    """In spacings, as sph_solver/fidelity.hpp has it."""
    return 2.7 if dimension == 3 else 3.0 if fidelity == "draft" else 4.0


def foreseen(output):
    """{name: number} of what a program's --check prints: particles, dt [s], steps, memory [MiB]; cells."""
    found = {name: float(value) for name, value in
             re.findall(r"(?m)^(particles|dt|steps|memory): (?:at most |at least |about )?([-+.\de]+)", output)}
    cells = re.search(r"no problem found; (\d+) cells", output)  # of all blocks, however they are made
    if cells:
        found["cells"] = float(cells.group(1))
    return found


def windows(scene, told, configs):
    """(number, length [s]) of the windows of a coupled run, of the steps of one program; None where they follow the flow."""
    constants, end = scene.constants(), scene.value("time.end", 0.0)
    coupling = scene.data.get("coupling") or {}
    dt = told.get("sph", {}).get("dt")
    if len(scene.programs) > 1:
        given = coupling.get("dt")
        length = (evaluate(given, constants) if given not in (None, "auto")
                  else dt and dt * scene.value("coupling.substeps", 1.0))
    elif dt:
        length = dt
    else:
        given = ((configs.get("fv") or {}).get("time") or {}).get("dt")
        length = None if given in (None, "auto") else evaluate(given, constants)
    return (end / length, length) if length else None


def predict(scene, told, configs):
    """Lines for the user. told: {program: foreseen()}; configs: {program: its configuration with all defaults}."""
    lines, memory = [], PROGRAM_BYTES * len(scene.programs)
    particles, cells = told.get("sph", {}).get("particles"), told.get("fv", {}).get("cells")
    if particles:
        lines.append(f"particles: {particles:.0f} at the start")
        memory += told["sph"]["memory"] * 2**20
    if cells:
        lines.append(f"cells: {cells:.0f}")
        memory += cells * CELL_BYTES
    planned = windows(scene, told, configs)
    if planned:
        number, length = planned
        if particles:
            a_window = -(-length // (told["sph"]["dt"] * (1 + 1e-9)))
            lines.append(f"steps of the particles: about {number * a_window:.0f} of {length / a_window:.3g} s")
        if cells:
            lines.append(f"steps of the grid: about {number:.0f} of {length:.3g} s")
    elif cells:
        lines.append("steps of the grid: as the flow asks for (time.cfl)")
    lines.append(f"memory: about {memory / 2**20:.0f} MiB")
    return lines


def try_out(scene, told, configs, bin_dir=None, threads=None):
    """Runs the scene's first windows in a folder of its own; a line with the seconds that the whole will take.

    What a flow at rest costs less than a developed one is not in it.
    """
    from . import run  # which needs the launcher, as nothing else here does
    planned = windows(scene, told, configs)
    scene = type(scene)(str(scene.folder), [*scene.settings, f"scene.time.max_windows={TRIAL_WINDOWS}"],
                        scene.programs[0] if len(scene.programs) == 1 else None)
    with tempfile.TemporaryDirectory() as out:
        summary = run.run(scene, out, threads=threads, bin_dir=bin_dir, quiet=True)
        if summary["status"] != 0:
            raise UserError("the trial failed: " + " / ".join(summary["lines"][-3:]))
        seconds, times = [], []
        with open(f"{out}/{scene.programs[-1]}/scalars.csv", encoding="utf-8") as text:
            rows = csv.DictReader(line for line in text if not line.startswith("#"))
            for row in rows:
                times.append(float(row["time"]))
                seconds.append(sum(float(row[k]) for k in TRIAL_PHASES[scene.programs[-1]]))
        memory = sum(p["results"]["peak_memory"] for p in summary["programs"].values())
    first = len(times) // 4
    if len(times) < 8 or times[-1] <= times[first]:
        raise UserError(f"the trial made only {len(times)} windows: the scene is as short as a trial, run it")
    rate = (seconds[-1] - seconds[first]) / (times[-1] - times[first])
    end = scene.value("time.end")
    number = f"{planned[0]:.0f}" if planned else f"{end * (len(times) - 1 - first) / (times[-1] - times[first]):.0f}"
    return [f"seconds: about {rate * end:.0f}, at the pace of windows {first} to {len(times) - 1} of {number}",
            f"memory of the trial: {memory / 2**20:.0f} MiB"]


# columns of scalars.csv that add up to a program's wall time
TRIAL_PHASES = {"sph": ("seconds_lists", "seconds_surface", "seconds_shift", "seconds_gradients", "seconds_fluxes", "seconds_walls",
                        "seconds_terms", "seconds_update", "seconds_coupling", "seconds_output", "seconds_wait"),
                "fv": ("seconds_solve", "seconds_output", "seconds_wait")}
