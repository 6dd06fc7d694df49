"""A cylinder and a sphere start to move: impulse, work and energy of the water against its added mass."""

import numpy as np

U, T, A, B = 0.2, 0.5, 1.0, 2.5  # of the scenes


def added_mass(dimension):
    """Of a body of radius A amid a shell of radius B, potential flow (Lamb 1932, articles 93 and 102 on)."""
    whole = np.pi * A**2 if dimension == 2 else 4 / 3 * np.pi * A**3
    a, b = A**dimension, B**dimension
    return 1000 * whole * ((b + a) / (b - a) if dimension == 2 else 0.5 * (b + 2 * a) / (b - a))


def balance(scalars, velocity):
    """Impulse given to the water [N s], work done on it and its kinetic energy [J], at the end."""
    t = scalars["time"]
    force = -(scalars["body.fx"][1:])  # mean over the steps that end at t
    dt, u = np.diff(t), 0.5 * (velocity(t[1:]) + velocity(t[:-1]))
    return float(np.sum(force * dt)), float(np.sum(force * u * dt)), float(scalars["kinetic_energy"][-1])


def check(case):
    rows = []
    for dimension, scene, ns in ((2, "cylinder", (5, 10, 20)), (3, "sphere", (4, 8))):
        mass = added_mass(dimension)
        for n in ns:
            run = case.run(case.folder / scene, set=[f"scene.constants.n={n}"], name=f"{scene}{n}", solver="sph")
            J, W, E = balance(run.sph.scalars, lambda t: U * (1 - np.cos(np.pi * np.minimum(t / T, 1))) / 2)
            ratios = J / (mass * U), W / (0.5 * mass * U**2), E / (0.5 * mass * U**2)
            rows.append([scene, n, *np.round(ratios, 3)])
            gates = ({"between": (0.9, 1.1)},) * 2 if n == 20 else ({"between": (0.9, 1.45)}, {"between": (0.9, 1.2)}) if n == 8 else ({}, {})
            case.metric(f"{scene}, a/dx={n}: impulse over added mass U", ratios[0], **gates[0])
            case.metric(f"{scene}, a/dx={n}: energy over added mass U^2/2", ratios[2], **gates[1])
            case.metric(f"{scene}, a/dx={n}: energy over work", E / W, below=1.02)
    case.table("Started in a round tank", ["body", "a/dx", "impulse", "work", "energy"], rows)
    rows = []
    for n in (5, 10, 20):
        run = case.run(case.folder / "channel", set=[f"scene.constants.n={n}"], name=f"channel{n}", solver="sph")
        J, W, E = balance(run.sph.scalars, lambda t: np.minimum(t / 0.2, 1))
        rows.append([n, *np.round((W, E, E / W), 3)])
        case.metric(f"channel, a/dx={n}: energy over work", E / W, between=(0.0, 1.0))
    case.metric("channel, a/dx=20: energy over work", E / W, above=0.8)
    case.table("Pushed along a channel [J]", ["a/dx", "work", "energy", "of it"], rows)
