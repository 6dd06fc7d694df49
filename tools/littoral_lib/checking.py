"""littoral check: both programs judge their files; then both sides are compared as the handshake will."""

import math
import re
import subprocess
import sys
import tempfile

import yaml

from . import estimate, programs
from .errors import UserError
from .scene import Scene
from .settings import route


def ask(program, scene, flag, bin_dir=None, timeout=60):
    """Output of one program run alone with --check or --print-config: (status, stdout, stderr)."""
    with tempfile.TemporaryDirectory() as out:
        line = [programs.find(f"{program}_solver", bin_dir), "--config", str(scene.folder / f"{program}.yaml"),
                "--out", out, flag]
        for setting in route(scene.settings, scene.programs)[program]:
            line += ["--set", setting]
        try:
            done = subprocess.run(line, capture_output=True, text=True, timeout=timeout, check=False,
                                  env=programs.environment(1))
        except subprocess.TimeoutExpired:
            return 124, "", f"{program}_solver {flag} did not end within {timeout} s"
    return done.returncode, done.stdout, done.stderr


def flatten(tree, prefix=""):
    """{dotted key: leaf} of nested maps and lists."""
    if isinstance(tree, dict):
        items = ((f"{prefix}.{k}" if prefix else str(k), v) for k, v in tree.items())
    elif isinstance(tree, list):
        items = ((f"{prefix}[{i}]", v) for i, v in enumerate(tree))
    else:
        return {prefix: tree}
    flat = {}
    for key, value in items:
        flat.update(flatten(value, key))
    return flat


def differences(mine, theirs, tolerance=1e-12):
    """[(key, mine, theirs)] of two flat maps; numbers agree within a relative tolerance, as in the handshake."""
    found = []
    for key in list(mine) + [k for k in theirs if k not in mine]:
        a, b = mine.get(key, "(absent)"), theirs.get(key, "(absent)")
        numbers = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in (a, b))
        if numbers and (a == b or math.isclose(a, b, rel_tol=tolerance)):
            continue
        if a != b:
            found.append((key, a, b))
    return found


def split_config(text):
    """(program's own keys, scene's keys) of --print-config, which shows both one after the other."""
    own, scene = {}, {}
    for part in re.split(r"(?m)^(?:---|# (?:scene|sph|fv))\s*$", text):
        tree = yaml.safe_load(part)
        if not isinstance(tree, dict):
            continue
        if isinstance(tree.get("scene"), dict):
            scene = tree["scene"]
        elif "fluid" in tree:
            scene = tree
        else:
            own = tree
    return own, scene


def check(scene, bin_dir=None, trial=False, threads=None):
    """All problems of a scene as sentences, and the warnings and predictions as lines; trial: with a run's first windows."""
    problems, warnings, configs, told = [], [], {}, {}
    for program in scene.programs:
        status, output, errors = ask(program, scene, "--check", bin_dir)
        if status != 0:
            said = [text for text in (errors or output).splitlines() if text.strip()]
            problems += [f"{program}: {text}" for text in said] or [f"{program}: --check ended with status {status}"]
            continue
        for text in re.findall(r"(?m)^\w+: (warning: .*)$", output):  # of the scene both programs say the same
            if text not in warnings:
                warnings.append(text)
        told[program] = estimate.foreseen(output)
        status, output, errors = ask(program, scene, "--print-config", bin_dir)
        try:
            configs[program], configs[program, "scene"] = split_config(output)
        except yaml.YAMLError as problem:
            problems.append(f"{program}: --print-config is no YAML: {problem}")
    if ("sph", "scene") in configs and ("fv", "scene") in configs:
        mine, theirs = flatten(configs["sph", "scene"]), flatten(configs["fv", "scene"])
        problems += [f"the handshake would fail: {key}: sph has {a}, fv has {b}"
                     for key, a, b in differences(mine, theirs)]
    predictions = []
    if not problems:
        try:
            predictions = estimate.predict(scene, told, configs)
            if trial:
                predictions += estimate.try_out(scene, told, configs, bin_dir, threads)
        except (UserError, KeyError, TypeError, ValueError) as reason:
            predictions = [f"no prediction: {reason}"]
    return problems, warnings + predictions


def command(args):
    scene = Scene(args.scene, args.set, args.solver)
    problems, predictions = check(scene, args.bin, args.trial, args.threads)
    for text in problems:
        print(text, file=sys.stderr)
    for text in predictions:
        print(text)
    if problems:
        print(f"littoral check: {scene.name}: {len(problems)} line(s) of problems", file=sys.stderr)
        return 1
    print(f"littoral check: {scene.name}: no problem found")
    return 0
