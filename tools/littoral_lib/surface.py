"""littoral surface DIR: the free surface of a run's particles as triangles (3-D) or lines (2-D), in files and a picture.

The surface is where sum V W = 1/2, by marching cubes or squares (scikit-image) on a grid of half a spacing. Particles
next to a symmetry plane or a periodic side see their images, so that the surface meets the plane. What the bodies' dummies
cover leaves the water less room: there it is half of the rest, as for the elevation gauges, and the inside of a body is left out.
"""

import pathlib

import numpy as np
import yaml

from . import coverage, estimate, fields, meshes
from .errors import UserError

LEVEL = 0.5


def read_setup(folder):
    """spacing, kernel radius [m], dimension, and the domain's box of a run, from the configuration it kept."""
    file = folder / "config.yaml"
    if not file.exists():
        raise UserError(f"{file}: no such file; DIR is a folder that `littoral run` wrote, with particles in it")
    sph, scene = (part for part in yaml.safe_load_all(file.read_text(encoding="utf-8")))
    scene = scene["scene"]
    dimension = int(scene["dimension"])
    radius = sph.get("kernel_radius")
    if radius is None or isinstance(radius, str):
        radius = estimate.default_kernel_radius(dimension, sph.get("fidelity", "standard"))
    return Setup(float(sph["spacing"]), float(radius), dimension, scene["domain"])


class Setup:
    def __init__(self, spacing, radius, dimension, domain):
        self.spacing, self.radius, self.dimension = spacing, radius * spacing, dimension
        self.axes = [0, 2] if dimension == 2 else [0, 1, 2]
        self.lower = np.array([float(domain["lower"][a]) for a in self.axes])
        self.upper = np.array([float(domain["upper"][a]) for a in self.axes])
        self.sides = [domain.get("xyz"[a], ["open", "open"]) for a in self.axes]


def with_images(x, volume, setup):
    """Particles and their images across the closed sides, as far as a kernel reaches."""
    for d, sides in enumerate(setup.sides):
        length = setup.upper[d] - setup.lower[d]
        copies = [(x, volume)]
        for end, side in enumerate(sides):
            plane = (setup.lower, setup.upper)[end][d]
            near = np.abs(x[:, d] - plane) < setup.radius
            other = np.abs(x[:, d] - (setup.upper[d] if end == 0 else setup.lower[d])) < setup.radius
            if side == "symmetry":
                image = x[near].copy()
                image[:, d] = 2 * plane - image[:, d]
                copies.append((image, volume[near]))
            elif side == "periodic":
                image = x[other].copy()
                image[:, d] += -length if end == 0 else length
                copies.append((image, volume[other]))
        x = np.concatenate([c[0] for c in copies])
        volume = np.concatenate([c[1] for c in copies])
    return x, volume


def grid_of(snapshot, setup, step, dummies=None):
    """sum V W of the water and half that of the bodies within the closed sides of the domain, NaN in the bodies, and
    whether the run kept volumes. dummies: (n, 3), copies beyond closed sides among them or not."""
    x = snapshot.points[:, setup.axes]
    kept = "volume" in snapshot.names
    volume = snapshot["volume"] if kept else np.full(len(x), setup.spacing**setup.dimension)
    x, volume = with_images(x, volume, setup)
    make = coverage.plane if setup.dimension == 2 else coverage.space
    if dummies is None or len(dummies) == 0:
        return crop(make(x, volume, setup.radius, step, anchor=setup.lower), setup), kept
    walls = np.unique(np.round(near_water(dummies[:, setup.axes], x, setup) / (1e-6 * setup.spacing)), axis=0)
    walls *= 1e-6 * setup.spacing  # each place once: sheets have two dummies there, and images may be kept already
    both, none = np.concatenate([x, walls]), np.zeros(len(walls))
    water = make(both, np.concatenate([volume, none]), setup.radius, step, anchor=setup.lower)
    solid = make(both, np.concatenate([0 * volume, none + setup.spacing**setup.dimension]), setup.radius, step,
                 anchor=setup.lower)
    values = np.where(solid.values < LEVEL, water.values + LEVEL * solid.values, np.nan)
    return crop(coverage.Grid(water.origin, water.step, values), setup), kept


def near_water(dummies, x, setup):
    """Dummies that the water may reach, with their images across the closed sides."""
    dummies, _ = with_images(dummies, np.ones(len(dummies)), setup)
    near = (dummies > x.min(axis=0) - setup.radius) & (dummies < x.max(axis=0) + setup.radius)
    return dummies[near.all(axis=1)]


def crop(grid, setup):
    """Leaves out what lies beyond a closed side."""
    cut = []
    for d, sides in enumerate(setup.sides):
        place = grid.origin[d] + np.arange(grid.values.shape[d]) * grid.step
        tolerance = 1e-6 * grid.step
        first = np.searchsorted(place, setup.lower[d] - tolerance) if sides[0] != "open" else 0
        last = np.searchsorted(place, setup.upper[d] + tolerance) if sides[1] != "open" else len(place)
        cut.append(slice(int(first), int(last)))
    origin = grid.origin + np.array([c.start for c in cut]) * grid.step
    return coverage.Grid(origin, grid.step, grid.values[tuple(cut)])


def library():
    try:
        from skimage import measure
    except ImportError:
        raise UserError("littoral surface wants scikit-image: apt-get install python3-skimage (tools/setup does)") from None
    return measure


def triangles(grid):
    """Vertices (n, 3) [m] and triangles (m, 3), their normals out of the water."""
    measure = library()
    if not np.nanmin(grid.values) < LEVEL < np.nanmax(grid.values):
        raise UserError("the water has no free surface at that time")
    outside = np.isfinite(grid.values)
    x, faces, _, _ = measure.marching_cubes(np.where(outside, grid.values, 0.0), LEVEL, gradient_direction="ascent")
    if not outside.all():
        x, faces = without_bodies(x, faces, outside)
    return grid.origin + grid.step * x, faces


def without_bodies(x, faces, outside):
    """The triangles whose corners lie between points outside of the bodies; x in steps of the grid."""
    below = np.floor(x + 1e-6).astype(int)
    above = np.minimum(np.ceil(x - 1e-6).astype(int), np.array(outside.shape) - 1)
    good = outside[tuple(below.T)] & outside[tuple(above.T)]
    faces = faces[good[faces].all(axis=1)]
    kept, renumbered = np.unique(faces, return_inverse=True)
    return x[kept], renumbered.reshape(faces.shape)


def lines(grid):
    """Polylines [(n, 2)] [m] in the plane (x, z)."""
    measure = library()
    return [grid.origin + line * grid.step for line in measure.find_contours(grid.values, LEVEL)]


def moments(folder, time, every):
    snapshots = fields.find_series(folder)
    if not snapshots:
        raise UserError(f"{folder}: no particles.xdmf; the run wrote no fields")
    if every:
        return snapshots
    return [snapshots[-1] if time is None else min(snapshots, key=lambda s: abs(s.time - time))]


def dummies_at(folder, time):
    """Places of the bodies' dummies at the moment nearest to that, (n, 3); None without bodies."""
    if not (folder / "bodies.xdmf").exists():
        return None
    return min(fields.open_series(folder / "bodies.xdmf"), key=lambda s: abs(s.time - time)).points


def command(args):
    folder = pathlib.Path(args.dir)
    folder = folder / "sph" if (folder / "sph").is_dir() else folder
    setup = read_setup(folder)
    out = pathlib.Path(args.out) if args.out else folder.parent / "surface"
    out.mkdir(parents=True, exist_ok=True)
    step = args.step * setup.spacing
    for number, snapshot in enumerate(moments(folder, args.time, args.all)):
        name = f"surface_{number:04d}" if args.all else "surface"
        grid, kept = grid_of(snapshot, setup, step, dummies_at(folder, snapshot.time))
        if not kept and number == 0:
            print("volumes are not among output.fields: spacing^D is taken for each particle")
        if setup.dimension == 2:
            found = lines(grid)
            written = meshes.write_lines(out / name, found)
            print(f"t = {snapshot.time:g} s: {len(found)} lines, {sum(map(len, found))} points")
        else:
            x, faces = triangles(grid)
            written = meshes.write_triangles(out / name, x, faces)
            print(f"t = {snapshot.time:g} s: {len(faces)} triangles, {len(x)} vertices, "
                  f"{meshes.area(x, faces):.6g} m^2")
        if not args.no_picture:
            written.append(out / f"{name}.png")
            if setup.dimension == 2:
                meshes.draw_lines(written[-1], found, snapshot.time)
            else:
                meshes.draw_triangles(written[-1], x, faces, snapshot.time)
        for path in written:
            print(path)
    return 0
