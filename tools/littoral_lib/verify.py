"""littoral verify: runs validation cases; metric, gate and verdict of each on the screen and as JSON."""

import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import time
import traceback

from . import cases, programs
from .errors import UserError
from .scene import ROOT

sys.path.insert(0, str(cases.FOLDER))


def run_ctest(case_file, case):
    """A case whose oracle is a set of unit tests: all of them must pass, and there must be some."""
    build = pathlib.Path(programs.find("sph_solver", case.bin_dir)).parents[1] \
        if case.bin_dir else next((ROOT / "build" / b for b in programs.BUILDS
                                   if (ROOT / "build" / b / "CTestTestfile.cmake").is_file()), None)
    if build is None:
        raise UserError("no build with tests; run cmake --preset release && cmake --build build/release")
    line = ["ctest", "--test-dir", str(build), "-R", case_file.ctest, "--no-tests=error", "--output-on-failure"]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    (case.out / "ctest.log").write_text(done.stdout + done.stderr, encoding="utf-8")
    if "_NOT_BUILT" in done.stdout or "Could not find executable" in done.stdout:
        raise UserError(f"its unit tests are not built; run cmake --build {build}")
    found = re.search(r"tests passed, (\d+) tests failed out of (\d+)", done.stdout)
    failed, total = (int(found.group(1)), int(found.group(2))) if found else (0, 0)
    if total == 0:
        raise UserError(f"no unit test matches {case_file.ctest} in {build} (built with LITTORAL_TESTS=OFF?)")
    case.metric(f"unit tests failed, of {total}", failed, at_most=0)
    if done.returncode != 0 and not failed and total:
        case.metric("ctest exit status", done.returncode, at_most=0)


def run_check(case_file, case):
    path = case_file.folder / case_file.check
    spec = importlib.util.spec_from_file_location(f"check_{case_file.name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.check(case)


def run_case(case_file, out, bin_dir=None, verbose=False):
    """Runs one case; its verdict as a dictionary, also written to OUT/NAME/verdict.json."""
    from lib.case import Case
    out = pathlib.Path(out) / case_file.name
    out.mkdir(parents=True, exist_ok=True)
    case = Case(case_file.name, case_file.folder, out.resolve(), bin_dir, case_file.timeout, verbose)
    begin = time.monotonic()
    error = None
    try:
        (run_ctest if case_file.ctest else run_check)(case_file, case)
        if not case.metrics:
            error = "the case reported no metric"
    except (UserError, OSError) as problem:
        error = str(problem)
    except Exception as problem:  # a case with a mistake must not hide the others' verdicts
        (out / "traceback.log").write_text(traceback.format_exc(), encoding="utf-8")
        error = f"{type(problem).__name__}: {problem} (see {out / 'traceback.log'})"
    verdict = {"name": case_file.name, "ids": case_file.ids, "title": case_file.title, "group": case_file.group,
               "tier": case_file.tier, "seconds": round(time.monotonic() - begin, 1),
               "date": time.strftime("%Y-%m-%d"), "error": error,
               "metrics": [m.as_dict() for m in case.metrics], "tables": case.tables,
               "passed": error is None and all(m.passed for m in case.metrics)}
    (out / "verdict.json").write_text(json.dumps(verdict, indent=2) + "\n", encoding="utf-8")
    return verdict, case


def tell(verdict, case, verbose):
    """A line for the case (its tightest metric), and one for each metric missed (or for all of them)."""
    label = f"{','.join(verdict['ids']) or '-':<8} {verdict['name']:<28}"
    word = "pass" if verdict["passed"] else "MISS"
    gated = [m for m in case.metrics if m.gate]
    if verdict["error"]:
        print(f"ERROR {label} {verdict['error'].splitlines()[0]}")
        for text in verdict["error"].splitlines()[1:]:
            print(f"        {text}")
    else:
        tightest = max(gated or case.metrics, key=lambda m: m.use)
        more = f"  (+{len(case.metrics) - 1} more)" if len(case.metrics) > 1 else ""
        print(f"{word:<5} {label} {tightest.line()}{more}  {verdict['seconds']:.0f} s")
    for metric in case.metrics:
        if verbose or not metric.passed:
            print(f"        {'pass' if metric.passed else 'MISS'}  {metric.line()}")
    for table in case.tables if verbose else []:
        print(f"        {table['title']}\n" + "\n".join("        " + t for t in table["text"].splitlines()))
    sys.stdout.flush()


def kept_results(chosen, out):
    """Markdown table of the verdicts kept under `out`, one row a case with its tightest gates."""
    lines = ["| id | case | metric | measured | gate | verdict | date |", "|---|---|---|---|---|---|---|"]
    for case_file in chosen:
        path = pathlib.Path(out) / case_file.name / "verdict.json"
        if not path.is_file():
            lines.append(f"| {', '.join(case_file.ids)} | {case_file.name} | | | | not run | |")
            continue
        verdict = json.loads(path.read_text(encoding="utf-8"))
        gated = [m for m in verdict["metrics"] if m["gate"]]
        shown = sorted(gated, key=lambda m: (m["verdict"] == "pass", -m.get("use", 0.0)))[:3]
        if verdict["error"]:
            lines.append(f"| {', '.join(verdict['ids'])} | {verdict['name']} | {verdict['error'].splitlines()[0]} | | "
                         f"| error | {verdict['date']} |")
        for i, metric in enumerate(shown):
            value = metric["value"] if isinstance(metric["value"], str) else f"{metric['value']:.4g} {metric['unit']}"
            first = f"| {', '.join(verdict['ids'])} | {verdict['name']}" if i == 0 else "| | "
            lines.append(f"{first} | {metric['name']} | {value.strip()} | {metric['gate']} | {metric['verdict']} | "
                         f"{verdict['date'] if i == 0 else ''} |")
    return "\n".join(lines)


def command(args):
    chosen = cases.select(cases.load_all(), args.names, args.tier, args.group)
    if args.list:
        for case in chosen:
            print(f"{','.join(case.ids) or '-':<8} {case.name:<28} {case.tier}  {case.group:<11} {case.title}")
        return 0
    if not chosen:
        raise UserError("no case in this selection; littoral verify --list shows them all")
    if args.table:
        print(kept_results(chosen, args.out or ROOT / "out" / "verify"))
        return 0
    verdicts = []
    for case_file in chosen:
        verdict, case = run_case(case_file, args.out or ROOT / "out" / "verify", args.bin, args.verbose)
        tell(verdict, case, args.verbose)
        verdicts.append(verdict)
    passed = sum(v["passed"] for v in verdicts)
    print(f"{len(verdicts)} case(s): {passed} passed, {len(verdicts) - passed} missed")
    return 0 if passed == len(verdicts) else 1
