"""A scene folder: scene.yaml, sph.yaml and/or fv.yaml, and what the tools need to know of it.

The programs read and judge the files; here they are only looked into, for the number of programs, for the
constants a reference solution is given in, and for predictions.
"""

import math
import pathlib
import re

import yaml

from .errors import UserError, unknown
from .settings import PROGRAMS, scene_overrides

ROOT = pathlib.Path(__file__).resolve().parents[2]

_FUNCTIONS = {name: getattr(math, name) for name in
              ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "sqrt", "exp", "log2",
               "log10")}
_FUNCTIONS.update(ln=math.log, log=math.log, abs=abs, min=min, max=max, rint=round, _pi=math.pi, pi=math.pi,
                  _e=math.e)


def evaluate(text, constants):
    """Number of a formula in the scene's constants, as muParser would find it."""
    if isinstance(text, (int, float)):
        return float(text)
    expression = re.sub(r"\^", "**", str(text))
    if not re.fullmatch(r"[\w\s.,+\-*/()<>=]*", expression):
        raise UserError(f"'{text}' is not a formula")
    try:
        return float(eval(expression, {"__builtins__": {}}, {**_FUNCTIONS, **constants}))
    except (NameError, SyntaxError, TypeError, ValueError, ZeroDivisionError) as problem:
        raise UserError(f"formula '{text}': {problem}") from None


def load_yaml(path):
    try:
        with open(path, encoding="utf-8") as file:
            return yaml.safe_load(file) or {}
    except FileNotFoundError:
        raise UserError(f"{path}: no such file") from None
    except yaml.YAMLError as problem:
        raise UserError(f"{path}: {problem}") from None


def assign(tree, dotted, text):
    """Sets tree['a']['b'] for dotted 'a.b' (list items as a[0]), as the programs' --set does."""
    keys = [int(k) if k.isdigit() else k for k in re.findall(r"[^.\[\]]+", dotted)]
    for key, following in zip(keys, keys[1:]):
        if isinstance(tree, dict):
            tree = tree.setdefault(key, [] if isinstance(following, int) else {})
        else:
            tree = tree[key]
    tree[keys[-1]] = yaml.safe_load(text)


def find_folder(name):
    """The scene's folder: a path, or the name of a folder of configs/."""
    for folder in (pathlib.Path(name), ROOT / "configs" / name):
        if (folder / "scene.yaml").is_file():
            return folder.resolve()
    folder = pathlib.Path(name)
    if folder.is_dir():
        raise UserError(f"{folder}: no scene.yaml in this folder")
    raise unknown("scene", name, [p.parent.name for p in (ROOT / "configs").glob("*/scene.yaml")])


class Scene:
    """A scene folder with the settings of one run applied to its scene.yaml."""

    def __init__(self, name, settings=(), solver=None):
        self.folder = find_folder(name)
        self.name = self.folder.name
        present = [p for p in PROGRAMS if (self.folder / f"{p}.yaml").is_file()]
        if not present:
            raise UserError(f"{self.folder}: neither sph.yaml nor fv.yaml; at least one program must be configured")
        if solver and solver not in present:
            raise UserError(f"{self.folder}: no {solver}.yaml, so --solver {solver} has nothing to run")
        self.programs = [solver] if solver else present
        self.settings = list(settings)
        self.data = load_yaml(self.folder / "scene.yaml")
        for key, text in scene_overrides(self.settings):
            try:
                assign(self.data, key, text)
            except (KeyError, IndexError, TypeError):
                raise UserError(f"--set scene.{key}: scene.yaml has no such place") from None

    def constants(self):
        values, given = {}, self.data.get("constants") or {}
        if not isinstance(given, dict):
            raise UserError(f"constants: expected names with values, found '{given}'")
        for name, text in given.items():
            try:
                values[name] = evaluate(text, values)
            except UserError as problem:
                raise UserError(f"constants.{name}: {problem}") from None
        return values

    def value(self, dotted, default=None):
        """Number at a dotted key of scene.yaml, formulas evaluated; `default` where it is absent."""
        node = self.data
        for key in dotted.split("."):
            if not isinstance(node, dict) or key not in node:
                return default
            node = node[key]
        return evaluate(node, self.constants())

    def vector(self, key):
        """Three numbers at a top-level key; zeros where it is absent."""
        found = self.data.get(key) or (0, 0, 0)
        if not isinstance(found, (list, tuple)) or len(found) != 3:
            raise UserError(f"{key}: expected a list of three numbers, found '{found}'")
        constants = self.constants()
        return [evaluate(v, constants) for v in found]

    def regions(self):
        """The SPH region's boxes as numbers."""
        constants, given = self.constants(), self.data.get("regions") or []
        try:
            return [{corner: [evaluate(v, constants) for v in region[corner]] for corner in ("lower", "upper")}
                    for region in given]
        except (KeyError, TypeError):
            raise UserError(f"regions: expected boxes with lower and upper, found '{given}'") from None

    def reference(self):
        """reference.yaml beside the scene, with its formulas evaluated; None if the scene has none."""
        path = self.folder / "reference.yaml"
        if not path.is_file():
            return None
        constants = self.constants()
        return {key: text if key == "solution" else evaluate(text, constants)
                for key, text in load_yaml(path).items()}
