"""What a scene will cost, from its files alone: particles, cells, memory, steps."""

import math

from .scene import evaluate

PARTICLE_BYTES = 1500  # arrays of state, stages and gradients, and some 50 to 90 neighbours in the lists
CELL_BYTES = 2500      # state of three times, residuals, and the blocks of the implicit side with its levels


def find(tree, names):
    """First value under one of the names, anywhere in nested maps and lists; None if there is none."""
    if isinstance(tree, dict):
        for name in names:
            if name in tree:
                return tree[name]
    children = tree.values() if isinstance(tree, dict) else tree if isinstance(tree, list) else []
    for child in children:
        found = find(child, names)
        if found is not None:
            return found
    return None


def axes(scene):
    return (0, 2) if int(scene.data.get("dimension", 2)) == 2 else (0, 1, 2)


def region_volume(scene):
    """Volume of the SPH boxes with their layers, cut at the domain: an upper bound, dry parts included."""
    constants = scene.constants()
    coupling = scene.data.get("coupling") or {}
    layers = sum(evaluate(coupling.get(k, 0), constants) for k in ("blending_width", "driven_width"))
    lower, upper = ([evaluate(v, constants) for v in scene.data["domain"][k]] for k in ("lower", "upper"))
    total = 0.0
    for region in scene.data.get("regions") or [{"lower": lower, "upper": upper}]:
        volume = 1.0
        for axis in axes(scene):
            a = max(evaluate(region["lower"][axis], constants) - layers, lower[axis])
            b = min(evaluate(region["upper"][axis], constants) + layers, upper[axis])
            volume *= max(0.0, b - a)
        total += volume
    return total


def default_kernel_radius(dimension, fidelity):
    """In spacings, as sph_solver/fidelity.hpp has it."""
    return 2.7 if dimension == 3 else 3.0 if fidelity == "draft" else 4.0


def default_cfl(integrator):
    """As sph_solver/physics/integrator.hpp has it."""
    return 0.27 if integrator == "midpoint" else 0.375


def predict(scene, configs):
    """Lines for the user; upper bounds, since the dry part of a region is not known before the run."""
    lines = []
    constants = scene.constants()
    memory = 0.0
    dx = find(configs.get("sph", {}), ("spacing", "particle_spacing", "dx"))
    if dx is not None:
        dx = evaluate(dx, constants)
        particles = region_volume(scene) / dx ** len(axes(scene))
        memory += particles * PARTICLE_BYTES
        lines.append(f"particles: at most {particles:.0f} (spacing {dx:g} m)")
        spacings = find(configs["sph"], ("kernel_radius",))
        radius = (default_kernel_radius(len(axes(scene)), find(configs["sph"], ("fidelity",)))
                  if spacings in (None, "auto") else float(spacings))
        given_cfl = find(configs["sph"], ("cfl",))
        cfl = (default_cfl(find(configs["sph"], ("integrator",))) if given_cfl in (None, "auto")
               else evaluate(given_cfl, constants))
        c = scene.value("fluid.sound_speed", 0.0)
        end = scene.value("time.end", 0.0)
        if c and math.isfinite(c) and end:
            dt = cfl * radius * dx / c
            window = scene.value("coupling.substeps", 1.0) * dt if len(scene.programs) > 1 else dt
            given = (scene.data.get("coupling") or {}).get("dt")
            if given not in (None, "auto"):
                window = evaluate(given, constants)
                dt = window / math.ceil(window / dt)
            lines.append(f"steps: about {end / dt:.0f} of {dt:.3g} s to t = {end:g} s"
                         + (f", in {end / window:.0f} windows" if len(scene.programs) > 1 else ""))
    cells = configs.get(("fv", "cells"), 0)
    if cells:
        memory += cells * CELL_BYTES
        lines.append(f"cells: {cells}")
    if memory:
        lines.append(f"memory: about {memory / 2**20 + 100:.0f} MiB")
    return lines
