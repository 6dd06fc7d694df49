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
        radius = find(configs["sph"], ("kernel_radius",))
        c = scene.value("fluid.sound_speed", 0.0)
        end = scene.value("time.end", 0.0)
        if c and math.isfinite(c) and end:
            width = evaluate(radius, constants) if radius not in (None, "auto") else 4 * dx
            width = width * dx if width >= 1.5 else width  # given in spacings or in metres
            lines.append(f"steps: about {end * c / (0.5 * width):.0f} of SPH (0.5 R / c each) to t = {end:g} s")
    cells = 0
    for block in find(configs.get("fv", {}), ("blocks",)) or []:
        counts = block.get("cells") if isinstance(block, dict) else None
        if counts:
            cells += math.prod(int(evaluate(n, constants)) for n in counts)
    if cells:
        memory += cells * CELL_BYTES
        lines.append(f"cells: {cells}")
    if memory:
        lines.append(f"memory: about {memory / 2**20 + 100:.0f} MiB")
    return lines
