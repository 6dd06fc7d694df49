"""Which particles are on the surface of water at rest, before and after 1000 steps: none may be wrong.

A particle whose place next to it along an axis is in the air is on the surface; one whose 3^D - 1 places around it are
all in the water is not; between the two (only a place across a corner is in the air: rounded shapes) either is right.
"""

import itertools

import numpy as np

TANK = ["scene.constants.g=1", "scene.domain.x=[symmetry, symmetry]", "scene.domain.z=[symmetry, open]"]
# name: (settings, initial.surface or None for that of the scene, is water at the places (n, D), kernel radius)
PLANE = {
    "tank": (TANK + ["scene.domain.upper=[32, 0, 32]"], "z - 20", lambda x: x[:, 1] < 20),
    "corners": ([], "max(abs(x-16), abs(z-16)) - 10", lambda x: np.abs(x - 16).max(axis=1) < 10),
    "disc": ([], "(x-16)^2 + (z-16)^2 - 12.3^2", lambda x: ((x - 16) ** 2).sum(axis=1) < 12.3**2),
    "sheet of one row": ([], "abs(z-16.5) - 0.6", lambda x: np.abs(x[:, 1] - 16.5) < 0.6),
    "sheet of two rows": ([], "abs(z-16) - 0.6", lambda x: np.abs(x[:, 1] - 16) < 0.6),
}
SPACE = {
    "tank": (TANK + ["scene.domain.y=[symmetry, symmetry]"], "z - 8", lambda x: x[:, 2] < 8),
    "corners": ([], "max(abs(x-7), max(abs(y-7), abs(z-7))) - 4", lambda x: np.abs(x - 7).max(axis=1) < 4),
    "sphere": ([], "(x-7)^2 + (y-7)^2 + (z-7)^2 - 6.4^2", lambda x: ((x - 7) ** 2).sum(axis=1) < 6.4**2),
    "sheet of one row": ([], "abs(z-7.5) - 0.6", lambda x: np.abs(x[:, 2] - 7.5) < 0.6),
    "sheet of two rows": ([], "abs(z-7) - 0.6", lambda x: np.abs(x[:, 2] - 7) < 0.6),
}


def verdicts(places, inside, lower, upper, tank):
    """(surely surface, surely not) of lattice places; beyond the sides of a tank there is water."""
    def water(x):
        if tank:
            x = x.copy()
            for d in range(x.shape[1]):  # the mirror image; the top stays open
                x[:, d] = np.maximum(x[:, d], 2 * lower - x[:, d])
                if d + 1 < x.shape[1]:
                    x[:, d] = np.minimum(x[:, d], 2 * upper - x[:, d])
        else:
            beyond = ((x < lower) | (x > upper)).any(axis=1)
            return inside(x) & ~beyond
        return inside(x)

    dimension = places.shape[1]
    along, around = np.ones(len(places), bool), np.ones(len(places), bool)
    for step in itertools.product((-1, 0, 1), repeat=dimension):
        wet = water(places + np.array(step))
        around &= wet
        if np.abs(step).sum() == 1:
            along &= wet
    return ~along, around


def by_id(snapshot, values):
    return values[np.argsort(snapshot["id"])]


def check(case):
    rows = []
    for scene, upper, shapes, radii in (("plane", 32.0, PLANE, (3, 4)), ("space", 14.0, SPACE, (2.7, 3))):
        for (shape, (settings, surface, inside)), radius in itertools.product(shapes.items(), radii):
            name = f"{scene}, {shape}, R = {radius} dx"
            run = case.run(case.folder / scene, set=settings + [f"scene.initial.surface={surface}",
                           f"sph.kernel_radius={radius}"], name=name.replace(",", "").replace(" ", "_"), solver="sph")
            first, last = run.sph.snapshots[0], run.sph.snapshots[-1]
            axes = [0, 2] if scene == "plane" else [0, 1, 2]
            places = by_id(first, first.points)[:, axes]
            must, must_not = verdicts(places, inside, 0.0, upper, shape == "tank")
            wrong = []
            for snapshot in (first, last):
                flagged = by_id(snapshot, snapshot["surface"]) == 2
                wrong.append(int((must & ~flagged).sum() + (must_not & flagged).sum()))
            moved = np.linalg.norm(by_id(last, last.points)[:, axes] - places, axis=1).max()
            rows.append([name, len(places), int(must.sum()), *wrong, moved, run.seconds])
            case.metric(f"{name}: wrong at the start", wrong[0], at_most=0)
            case.metric(f"{name}: wrong after 1000 steps", wrong[1], at_most=0)
    case.table("Surface detection", ["shape", "particles", "on the surface", "wrong at start", "wrong after 1000 steps",
                                     "moved / dx", "wall s"], rows)
