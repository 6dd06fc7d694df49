"""littoral run: one scene, one job, one folder of results."""

import pathlib
import re
import shlex
import shutil
import sys

from . import collect, launch, programs
from .console import Console
from .errors import UserError
from .scene import Scene

TAIL = 15  # lines of each log shown after a failure


def checkpoints(folder):
    """{window: path} of a program's checkpoints."""
    found = {}
    for path in pathlib.Path(folder).glob("checkpoint_*.h5"):
        match = re.fullmatch(r"checkpoint_0*(\d+)\.h5", path.name)
        if match:
            found[int(match.group(1))] = path
    return found


def restart_files(scene, origin, window):
    """Checkpoint of each program at one common window: a number, or 'latest' that all programs have."""
    found = {p: checkpoints(pathlib.Path(origin) / p) for p in scene.programs}
    common = set.intersection(*(set(f) for f in found.values()))
    if not common:
        raise UserError(f"{origin}: no window of which {' and '.join(scene.programs)} both have a checkpoint "
                        "(checkpoint_<window>.h5); set scene.time.checkpoint_interval to write some")
    if window == "latest":
        chosen = max(common)
    elif str(window).isdigit() and int(window) in common:
        chosen = int(window)
    else:
        raise UserError(f"--restart {window}: no common checkpoint of that window in {origin}. "
                        f"There are: {', '.join(map(str, sorted(common)))}")
    return {p: found[p][chosen] for p in scene.programs}


def clear(out):
    """Removes what an earlier run left in `out`, so that its files are not taken for this one's.

    OUT/command marks a folder that a run wrote; results in any other folder are somebody else's.
    """
    if (out / "command").is_file():
        for folder in ("sph", "fv", "plots"):
            shutil.rmtree(out / folder, ignore_errors=True)
        for name in ("summary.json", "scalars.csv", "console.log", "command"):
            (out / name).unlink(missing_ok=True)
        return
    for program in ("sph", "fv"):
        if (out / program).is_dir() and any((out / program).iterdir()):
            raise UserError(f"{out}/{program} holds files, but no run of littoral wrote them ({out}/command is missing): "
                            "take another --out, or remove them")


def run(scene, out, sph_ranks=1, fv_ranks=1, threads=None, restart=None, restart_from=None, extra=None,
        bin_dir=None, quiet=False, timeout=None):
    """Runs a scene; returns its summary (status 0: success). All results lie under `out`."""
    out = pathlib.Path(out).resolve()
    ranks = {"sph": sph_ranks, "fv": fv_ranks}
    if min(ranks.values()) < 1:
        raise UserError("each program needs at least one rank")
    schedule = ((scene.data.get("coupling") or {}).get("schedule"))
    used = [ranks[p] for p in scene.programs]
    threads = threads or programs.default_threads(used, schedule == "concurrent")
    files = restart_files(scene, restart_from or out, restart) if restart is not None else None
    line = launch.mpi_line(scene, out, ranks, files, extra, bin_dir)
    goes_on = files is not None and all(out in path.resolve().parents for path in files.values())
    if not goes_on:
        clear(out)
    for program in scene.programs:
        (out / program).mkdir(parents=True, exist_ok=True)
        (out / program / "summary.json").unlink(missing_ok=True)  # nothing of an earlier run may pass for this one's
    for name in ("summary.json", "scalars.csv"):
        (out / name).unlink(missing_ok=True)
    (out / "command").write_text(shlex.join(line) + "\n", encoding="utf-8")
    console = Console(scene.programs, out / "console.log", quiet)
    try:
        result = launch.execute(line, programs.environment(threads, sum(used)), console.line, timeout)
    finally:
        console.close()
    job = {"status": result.status, "ranks": {p: ranks[p] for p in scene.programs}, "threads": threads,
           "wall_seconds": round(result.seconds, 3), "command": shlex.join(line),
           "restart": None if files is None else {p: str(f) for p, f in files.items()},
           "killed": launch.killed(result.lines, [(p, ranks[p]) for p in scene.programs])}
    try:
        summary = collect.collect(out, scene, job)
    except (OSError, UserError) as problem:  # a full disk, a bad value: the job's own verdict must not be lost
        print(f"littoral: cannot collect the results: {problem}", file=sys.stderr)
        summary = {"programs": {p: None for p in scene.programs}, **job, "status": job["status"] or 1}
    summary["lines"], summary["interrupted"] = result.lines, result.interrupted
    return summary


def log_tail(out, program, lines=TAIL):
    """Last lines of a program's log file; None where it wrote none."""
    logs = sorted(p for p in (pathlib.Path(out) / program).glob("*log*") if p.is_file())
    if not logs:
        return None
    return logs[0].read_text(encoding="utf-8", errors="replace").splitlines()[-lines:]


def report_failure(out, summary, stream=sys.stderr):
    """Why a job ended: the end of each program's log, then the job's own last words."""
    status = summary["status"]
    reason = "ran past its time limit" if status == 124 else f"exit status {status}"
    if summary["interrupted"]:
        reason = f"interrupted by {summary['interrupted'].name}"
    print(f"littoral: the job failed ({reason}) after "
          f"{summary['wall_seconds']:.1f} s. Everything it printed: {out}/console.log", file=stream)
    for program in summary["programs"]:
        tail = log_tail(out, program)
        print(f"--- last lines of {program}'s log" + ("" if tail else ": it wrote none"), file=stream)
        for text in tail or []:
            print(f"    {text}", file=stream)
    print("--- last lines on the screen", file=stream)
    for text in launch.own_words(summary["lines"])[-TAIL:]:
        print(f"    {text}", file=stream)
    for text in summary["killed"]:  # who was killed has no last words
        print(f"littoral: {text}", file=stream)


def command(args):
    scene = Scene(args.scene, args.set, args.solver)
    out = pathlib.Path(args.out) if args.out else pathlib.Path("out") / scene.name
    print(f"littoral: {scene.name} with {' and '.join(f'{p}_solver' for p in scene.programs)} -> {out}",
          file=sys.stderr)
    summary = run(scene, out, args.sph_ranks, args.fv_ranks, args.threads, args.restart, args.restart_from,
                  None, args.bin, args.quiet, args.timeout)
    if summary["status"] != 0:
        report_failure(out, summary)
        return summary["status"] if 0 < summary["status"] < 256 else 1
    print(f"littoral: done in {summary['wall_seconds']:.1f} s; results in {out} (summary.json, scalars.csv, "
          + ", ".join(f"{p}/" for p in scene.programs) + ")", file=sys.stderr)
    return 0
