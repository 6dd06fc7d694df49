"""Decay of the energy against the exact one; independence of the sound speed and of sqrt(beta)."""

import math

import numpy as np
from lib import grid

KEPT = math.exp(-4 * (1 / 100) * (2 * math.pi) ** 2)  # E(1)/E(0), L = U = 1, Re = 100


def kept(run):
    energy = run.fv.scalars["kinetic_energy"]
    return energy[-1] / energy[0]


def velocity_error(run):
    g = grid.Planar(run.fv.snapshots[-1])
    k, decay = 2 * math.pi, math.exp(-2 * (1 / 100) * (2 * math.pi) ** 2)
    u = np.sin(k * g.x) * np.cos(k * g.z) * decay
    w = -np.cos(k * g.x) * np.sin(k * g.z) * decay
    return math.sqrt(((g.u - u) ** 2 + (g.w - w) ** 2).mean())


def check(case):
    def run(name, *settings):
        return case.run(case.folder / "scene", set=list(settings), name=name, solver="fv")

    incompressible = ("scene.fluid.sound_speed=.inf", "fv.dual_time.drop=1e-5")
    rows, errors = [], []
    for n in (16, 32, 64):
        r = run(f"n{n}", *incompressible, f"fv.blocks[0].cells=[{n},1,{n}]", f"fv.time.dt={0.64 / n}", "fv.output.fields=true")
        errors.append(velocity_error(r))
        rows.append([n, errors[-1], kept(r) / KEPT - 1, r.seconds])
        if n == 64:
            base = kept(r)
            case.metric("64: energy kept over exact - 1", base / KEPT - 1, between=(-0.005, 0.005))
    orders = grid.order(errors)
    case.metric("order of u", orders[-1], at_least=1.8)
    case.table("Refinement in space and time", ["cells", "L2 error of u", "energy kept - 1", "s"], rows)

    rows = []
    for mach in (0.1, 0.05, 0.02):
        r = run(f"mach{mach}", f"scene.constants.mach={mach}", "fv.dual_time.drop=1e-5")
        rows.append([mach, kept(r) / KEPT - 1])
        case.metric(f"Mach {mach}: energy kept over that at Mach 0 - 1", kept(r) / base - 1, between=(-0.01, 0.01))
    case.table("Sound speed", ["Mach", "energy kept - 1"], rows)

    rows = []
    for c0 in (0.5, 2.0):
        r = run(f"c0_{c0}", *incompressible, f"fv.dual_time.pseudo_sound_speed={c0 ** 0.5}")
        rows.append([c0, kept(r) / base - 1])
        case.metric(f"beta x {c0}: energy kept over that at beta - 1", kept(r) / base - 1, between=(-1e-3, 1e-3))
    case.table("Pseudo sound speed", ["beta over U^2", "change of energy kept"], rows)
