"""The validation cases: tests/validation/<name>/case.yaml."""

import pathlib
import re

from .errors import UserError, nearest, unknown
from .scene import ROOT, load_yaml

FOLDER = ROOT / "tests" / "validation"
TIERS = ("U", "F", "N", "L")
GROUPS = ("sph", "fv", "fv_surface", "coupled")
KEYS = {"title", "ids", "group", "tier", "ctest", "check", "timeout"}


class CaseFile:
    """One case as its case.yaml declares it."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.name = self.folder.name
        path = self.folder / "case.yaml"
        data = load_yaml(path)
        for key in data:
            if key not in KEYS:
                guess = nearest(key, KEYS)
                raise UserError(f"{path}: unknown key '{key}'." + (f" Did you mean '{guess}'?" if guess else ""))
        self.title = data.get("title", self.name)
        self.ids = [str(i) for i in data.get("ids", [])]
        self.group = data.get("group")
        self.tier = data.get("tier")
        self.ctest = data.get("ctest")
        self.check = data.get("check")
        self.timeout = data.get("timeout")  # [s] of each run of the case
        if self.group not in GROUPS:
            raise UserError(f"{path}: group must be one of {', '.join(GROUPS)}, not {self.group}")
        if self.tier not in TIERS:
            raise UserError(f"{path}: tier must be one of {', '.join(TIERS)}, not {self.tier}")
        if bool(self.ctest) == bool(self.check):
            raise UserError(f"{path}: exactly one of 'ctest' (a regular expression) and 'check' (a Python file)")
        if self.check and not (self.folder / self.check).is_file():
            raise UserError(f"{path}: {self.check} is not in the folder")


def load_all(folder=FOLDER):
    return [CaseFile(path.parent) for path in sorted(folder.glob("*/case.yaml"))]


def _order(case):
    """By group, then by the number of the first id, then by name."""
    number = re.search(r"\d+", case.ids[0]) if case.ids else None
    return (GROUPS.index(case.group), int(number.group()) if number else 1000, case.name)


def select(cases, names=(), tiers=None, groups=None):
    """The cases meant by names or ids (C12), tiers and groups; an unknown name is an error with the nearest."""
    chosen = sorted(cases, key=_order)
    if names:
        known = {c.name for c in cases} | {i for c in cases for i in c.ids}
        for name in names:
            if name not in known:
                raise unknown("case", name, known)
        chosen = [c for c in chosen if c.name in names or set(c.ids) & set(names)]
    if tiers:
        chosen = [c for c in chosen if c.tier in tiers]
    if groups:
        chosen = [c for c in chosen if c.group in groups]
    return chosen
