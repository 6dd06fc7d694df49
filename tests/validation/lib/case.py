"""What a check.py gets: runs scenes, reads their results, reports metrics against gates."""

import math
import pathlib
import shutil
import subprocess

from littoral_lib import checking, fields, launch, programs, run, tables
from littoral_lib.errors import UserError
from littoral_lib.scene import ROOT, Scene


class Metric:
    """A measured number with its gate. `use` is the share of the gate that is used up (above 1: missed)."""

    def __init__(self, name, value, gate, passed, use, unit):
        self.name, self.value, self.gate = name, value, gate
        self.passed, self.use, self.unit = passed, use, unit

    def line(self):
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.name} = {self.value:.4g}{unit}  {'gate ' + self.gate if self.gate else '(no gate)'}"

    def as_dict(self):
        value = self.value if math.isfinite(self.value) else str(self.value)
        return {"name": self.name, "value": value, "unit": self.unit, "gate": self.gate,
                "use": self.use if math.isfinite(self.use) else 1e9,
                "verdict": "pass" if self.passed else "miss"}


class Part:
    """One program's folder of a run."""

    def __init__(self, folder):
        self.folder = folder

    @property
    def scalars(self):
        return tables.read_csv(self.folder / "scalars.csv")

    @property
    def gauges(self):
        return tables.read_csv(self.folder / "gauges.csv")

    @property
    def snapshots(self):
        """Moments of the field series, oldest first: s.time, s.points, s["velocity"]."""
        return fields.find_series(self.folder)

    @property
    def log(self):
        logs = sorted(p for p in self.folder.glob("*log*") if p.is_file())
        return logs[0].read_text(encoding="utf-8", errors="replace") if logs else ""

    @property
    def summary(self):
        from littoral_lib.collect import read_json
        return read_json(self.folder / "summary.json") or {}


class Run:
    """A finished run: run.sph, run.fv (Part), run.scalars (joined), run.summary, run.status, run.screen."""

    def __init__(self, out, summary):
        self.out = pathlib.Path(out)
        self.summary = summary
        self.status = summary["status"]
        self.seconds = summary["wall_seconds"]
        self.sph = Part(self.out / "sph")
        self.fv = Part(self.out / "fv")

    @property
    def scalars(self):
        return tables.read_csv(self.out / "scalars.csv")

    @property
    def screen(self):
        return (self.out / "console.log").read_text(encoding="utf-8", errors="replace")


class Case:
    """Handed to check(case). Paths of scenes are taken from the project's root (or absolute)."""

    def __init__(self, name, folder, out, bin_dir=None, timeout=None, verbose=False):
        self.name, self.folder, self.out, self.bin_dir = name, pathlib.Path(folder), pathlib.Path(out), bin_dir
        self.timeout, self.verbose = timeout, verbose
        self.metrics, self.tables = [], []

    def run(self, scene, set=(), name="run", sph_ranks=1, fv_ranks=1, threads=None, solver=None, restart=None,
            restart_from=None, extra=None, may_fail=False, keep=False, timeout=None):
        """Runs a scene into OUT/<case>/<name>. A job that fails is an error unless may_fail.

        set          ["scene.time.end=1", "sph.key=value"], as on the command line
        solver       "sph" or "fv": that program alone
        restart      window number or "latest", taken from restart_from (a Run) or from this folder (keep=True)
        extra        {"sph": ["--record", path]}: further arguments of a program
        """
        out = self.out / name
        if out.exists() and not keep:
            shutil.rmtree(out)
        origin = restart_from.out if isinstance(restart_from, Run) else restart_from
        place = ROOT / scene
        summary = run.run(Scene(place if place.is_dir() else scene, set, solver), out, sph_ranks, fv_ranks, threads, restart, origin, extra,
                          self.bin_dir, quiet=not self.verbose, timeout=timeout or self.timeout)
        if summary["interrupted"]:
            raise summary["interrupted"]  # not this run alone: the user wants to go
        finished = Run(out, summary)
        if finished.status != 0 and not may_fail:
            last = launch.own_words(summary["lines"])[-6:]
            raise UserError(f"run '{name}' ended with status {finished.status} after {finished.seconds:.0f} s "
                            f"({out}/console.log):\n" + "\n".join(last))
        return finished

    def check(self, scene, set=()):
        """What `littoral check` finds: (problems, predictions)."""
        place = ROOT / scene
        return checking.check(Scene(place if place.is_dir() else scene, set), self.bin_dir)

    def program(self, name, *arguments, timeout=60):
        """Runs a program by itself: (status, text of stdout and stderr). Status 124: it did not end in time."""
        folder = self.out / "program"
        folder.mkdir(parents=True, exist_ok=True)
        try:
            done = subprocess.run([programs.find(name, self.bin_dir), *map(str, arguments)], capture_output=True,
                                  text=True, timeout=timeout, check=False, env=programs.environment(1), cwd=folder)
        except subprocess.TimeoutExpired:
            return 124, f"{name} did not end within {timeout} s"
        return done.returncode, done.stdout + done.stderr

    def metric(self, name, value, below=None, above=None, between=None, at_most=None, at_least=None, unit=""):
        """Reports a number. Without a gate it is only recorded. NaN misses every gate.

        below, above: strict; at_most, at_least: with equality; between: (low, high), with equality.
        """
        value = float(value)
        gate, passed, use = "", True, 0.0
        if between is not None:
            low, high = between
            gate, passed = f"{low:g} .. {high:g}", low <= value <= high
            use = abs(value - 0.5 * (low + high)) / (0.5 * (high - low)) if high > low else float(not passed)
        elif below is not None or at_most is not None:
            bound = below if below is not None else at_most
            gate = f"{'<' if below is not None else '<='} {bound:g}"
            passed = value < bound if below is not None else value <= bound
            use = abs(value) / abs(bound) if bound else float(not passed)
        elif above is not None or at_least is not None:
            bound = above if above is not None else at_least
            gate = f"{'>' if above is not None else '>='} {bound:g}"
            passed = value > bound if above is not None else value >= bound
            use = bound / value if passed and value else float(not passed) * 2
        if passed:
            use = min(use, 1.0)
        else:
            use = max(use, 1.0 + 1e-9) if math.isfinite(use) else math.inf
        self.metrics.append(Metric(name, value, gate, bool(passed), use, unit))
        return value

    def holds(self, name, condition):
        """A claim that is true (1) or not (0)."""
        value = self.metric(name, 1.0 if condition else 0.0, at_least=1.0)
        if condition:
            self.metrics[-1].use = 0.0  # a claim that holds is never the tightest metric of a case
        return value

    def table(self, title, header, rows):
        """A table of the case: kept in verdict.json, written as OUT/<case>/<title>.md, shown by --verbose."""
        cells = [[f"{v:.4g}" if isinstance(v, float) else str(v) for v in row] for row in [header, *rows]]
        widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
        lines = ["| " + " | ".join(v.ljust(w) for v, w in zip(row, widths)) + " |" for row in cells]
        lines.insert(1, "|" + "|".join("-" * (w + 2) for w in widths) + "|")
        text = "\n".join(lines)
        self.tables.append({"title": title, "header": list(header), "rows": [list(map(str, r)) for r in rows],
                            "text": text})
        file = "".join(c if c.isalnum() else "_" for c in title.lower())
        (self.out / f"{file}.md").write_text(f"{title}\n\n{text}\n", encoding="utf-8")
