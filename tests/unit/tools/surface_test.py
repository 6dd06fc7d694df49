"""The free surface as triangles and lines: where it lies, which way it looks, what is in the files."""

import base64
import pathlib
import re
import tempfile
import unittest

import numpy as np
import tools_path  # noqa: F401
from littoral_lib import meshes, surface

OPEN = ["open", "open"]


def lattice(n, keep=lambda x: np.ones(len(x), bool)):
    x = np.stack([a.ravel() for a in np.meshgrid(*[np.arange(k) + 0.5 for k in n], indexing="ij")], axis=1)
    return x[keep(x)]


class Water:
    """A snapshot of particles at rest, V = 1."""

    names = ["volume"]

    def __init__(self, x):
        self.points = x if x.shape[1] == 3 else np.stack([x[:, 0], 0 * x[:, 0], x[:, 1]], axis=1)

    def __getitem__(self, name):
        return np.ones(len(self.points))


def setup(dimension, upper, **sides):
    domain = {"lower": [0, 0, 0], "upper": upper, "x": OPEN, "y": OPEN, "z": OPEN} | sides
    return surface.Setup(1.0, 4.0 if dimension == 2 else 2.7, dimension, domain)


class Triangles(unittest.TestCase):
    def test_of_a_ball(self):
        radius, centre = 6.0, np.full(3, 8.0)
        ball = lattice((16, 16, 16), lambda x: np.linalg.norm(x - centre, axis=1) < radius)
        grid, _ = surface.grid_of(Water(ball), setup(3, [16, 16, 16]), 0.5)
        x, faces = surface.triangles(grid)
        r = np.linalg.norm(x - centre, axis=1)
        # a ball cut out of a lattice is uneven by up to half a spacing; on the mean it is round
        self.assertLess(np.abs(r - radius).max(), 0.6)
        self.assertAlmostEqual(r.mean(), radius, delta=0.15)
        middle = meshes.corners(x, faces).mean(axis=1) - centre
        self.assertGreater((meshes.normals(x, faces) * middle).sum(axis=1).min(), 0.0, "normals out of the water")

    def test_of_a_tank_meets_the_walls(self):
        walls = ["symmetry", "symmetry"]
        tank = setup(3, [8, 6, 20], x=walls, y=["periodic", "periodic"], z=["symmetry", "open"])
        grid, _ = surface.grid_of(Water(lattice((8, 6, 7))), tank, 0.5)
        x, faces = surface.triangles(grid)
        np.testing.assert_allclose(x[:, 2], 7.0, atol=0.05)
        self.assertAlmostEqual(meshes.area(x, faces), 48.0, delta=0.1)
        self.assertAlmostEqual(x[:, 0].min(), 0.0, delta=1e-6)
        self.assertAlmostEqual(x[:, 1].max(), 6.0, delta=1e-6)

    def test_files(self):
        x, faces = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]), np.array([[0, 1, 2], [0, 1, 3]])
        with tempfile.TemporaryDirectory() as folder:
            vtp, ply, stl = meshes.write_triangles(pathlib.Path(folder) / "two", x, faces)
            self.assertEqual(stl.stat().st_size, 84 + 50 * 2)
            self.assertIn(b"element face 2", ply.read_bytes())
            arrays = [base64.b64decode(t) for t in
                      re.findall(r"<DataArray[^>]*>.{12}([^<]*)</DataArray>", vtp.read_text())]
            np.testing.assert_array_equal(np.frombuffer(arrays[0], "<f4").reshape(-1, 3), x)
            np.testing.assert_array_equal(np.frombuffer(arrays[1], "<i8"), faces.ravel())
            np.testing.assert_array_equal(np.frombuffer(arrays[2], "<i8"), [3, 6])


class Lines(unittest.TestCase):
    def test_of_a_disc_with_a_hole(self):
        centre = np.full(2, 15.0)
        radii = lambda x: np.linalg.norm(x - centre, axis=1)
        ring = lattice((30, 30), lambda x: (radii(x) < 13) & (radii(x) > 6))
        grid, _ = surface.grid_of(Water(ring), setup(2, [30, 0, 30]), 0.5)
        found = sorted((radii(line).mean() for line in surface.lines(grid)))
        np.testing.assert_allclose(found, [6, 13], atol=0.25)

    def test_of_water_between_walls_ends_at_them(self):
        """Water 6 deep in a trough of 10, walls of four rows about it; nothing of the walls is a surface."""
        every = lattice((18, 20))
        trough = (every[:, 0] > 4) & (every[:, 0] < 14) & (every[:, 1] > 4)
        walls = every[~trough]
        dummies = np.stack([walls[:, 0], 0 * walls[:, 0], walls[:, 1]], axis=1)
        grid, _ = surface.grid_of(Water(every[trough & (every[:, 1] < 10)]), setup(2, [18, 0, 20]), 0.5, dummies)
        found = surface.lines(grid)
        self.assertEqual(len(found), 1)
        np.testing.assert_allclose(found[0][:, 1], 10.0, atol=0.4)
        self.assertAlmostEqual(found[0][:, 0].min(), 4.0, delta=0.6)
        self.assertAlmostEqual(found[0][:, 0].max(), 14.0, delta=0.6)

    def test_of_water_between_walls_in_space(self):
        every = lattice((14, 14, 16))
        trough = (np.abs(every[:, :2] - 7) < 4).all(axis=1) & (every[:, 2] > 3)
        grid, _ = surface.grid_of(Water(every[trough & (every[:, 2] < 8)]), setup(3, [14, 14, 16]), 0.5, every[~trough])
        x, faces = surface.triangles(grid)
        np.testing.assert_allclose(x[:, 2], 8.0, atol=0.5)
        self.assertTrue(49 < meshes.area(x, faces) < 66, "8 x 8, up to a step of the grid from the walls")


if __name__ == "__main__":
    unittest.main()
