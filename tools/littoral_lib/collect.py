"""After a job: both programs' results in one place (OUT/scalars.csv, OUT/summary.json)."""

import json
import pathlib

import numpy as np

from . import tables

JOINED = ("kinetic_energy", "potential_energy", "mass")
UNITS = "s, J, J, kg (in 2-D: per metre of width)"


def join_scalars(parts):
    """Sum of the programs' shares at the times all of them have.

    `parts`: one Table a program; each counts its own part only (particles inside the region's nominal faces,
    cells outside), so the sum counts everything once. Times agree when they differ by less than a thousandth
    of the shortest step between two rows: both programs print the same window's end.
    """
    first = parts[0]["time"]
    picks = [np.arange(len(first))]
    for part in parts[1:]:
        other = part["time"]
        steps = np.concatenate([np.diff(first), np.diff(other)])
        steps = steps[steps > 0]
        tolerance = 1e-3 * steps.min() if len(steps) else 1e-12
        nearest = np.searchsorted(other, first - tolerance) if len(other) else np.zeros(len(first), int)
        picks.append(np.where((nearest < len(other)) &
                              (np.abs(np.append(other, np.inf)[np.minimum(nearest, len(other))] - first)
                               <= tolerance), nearest, -1))
    common = np.all([pick >= 0 for pick in picks], axis=0)
    joined = {"time": first[common]}
    for name in JOINED:
        if all(name in part for part in parts):
            joined[name] = sum(part[name][pick[common]] for part, pick in zip(parts, picks))
    return joined


def read_json(path):
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (FileNotFoundError, json.JSONDecodeError):
        return None


def collect(out, scene, job):
    """Writes OUT/scalars.csv and OUT/summary.json; `job` is what the launcher knows (ranks, status, seconds)."""
    out = pathlib.Path(out)
    parts = {}
    for program in scene.programs:
        path = out / program / "scalars.csv"
        if path.is_file():
            parts[program] = tables.read_csv(path)
    results = {}
    if len(parts) == len(scene.programs):
        joined = join_scalars(list(parts.values()))
        tables.write_csv(out / "scalars.csv", joined, UNITS)
        if len(joined["time"]):
            results = {f"{name}_{when}": float(column[index]) for name, column in joined.items()
                       for when, index in (("first", 0), ("last", -1))}
            results["rows"] = len(joined["time"])
    summary = {"scene": scene.name, "title": scene.data.get("title", scene.name), "folder": str(scene.folder),
               "settings": scene.settings, **job, "results": results,
               "programs": {p: read_json(out / p / "summary.json") for p in scene.programs}}
    summary["regions"] = scene.regions()
    summary["density"] = scene.value("fluid.density", 1000.0)
    summary["sound_speed"] = scene.value("fluid.sound_speed", 0.0)
    summary["gravity"] = scene.vector("gravity")
    reference = scene.reference()
    if reference:
        summary["reference"] = reference
    (out / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
    return summary
