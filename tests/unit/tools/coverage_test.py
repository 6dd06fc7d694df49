"""sum V W on a grid: one in the water, a half on its surface, and the same as summed by hand."""

import unittest

import numpy as np
import tools_path  # noqa: F401
from littoral_lib import coverage


def lattice(n, dimension):
    axes = np.meshgrid(*[np.arange(n) + 0.5] * dimension, indexing="ij")
    return np.stack([a.ravel() for a in axes], axis=1)


class Coverage(unittest.TestCase):
    def test_is_one_inside_and_a_half_on_the_surface(self):
        for dimension, radius, n, make in ((2, 4.0, 20, coverage.plane), (3, 2.7, 12, coverage.space)):
            x = lattice(n, dimension)
            grid = make(x, np.ones(len(x)), radius, 0.5)
            at = lambda place: grid.values[tuple(np.rint((np.array(place) - grid.origin) / grid.step).astype(int))]
            middle = [n / 2] * dimension
            self.assertAlmostEqual(at(middle), 1.0, delta=0.01)
            # the nearest grid point is up to half a step away, where the slope is about 1/R a spacing
            self.assertAlmostEqual(at([0.0] + middle[1:]), 0.5, delta=0.5 * 0.5 * 2 / radius)

    def test_agrees_with_the_sum_over_all_particles(self):
        rng = np.random.default_rng(3)
        x, volume = rng.uniform(0, 5, (40, 2)), rng.uniform(0.5, 1.5, 40)
        grid = coverage.plane(x, volume, 2.0, 0.4)
        for i, k in ((5, 5), (10, 3), (9, 12)):
            place = grid.origin + np.array([i, k]) * grid.step
            r = np.linalg.norm(x - place, axis=1)
            self.assertAlmostEqual(grid.values[i, k], (volume * coverage.kernel(r, 2.0, 2)).sum(), delta=1e-12)
        area = volume.sum()
        self.assertAlmostEqual(grid.values.sum() * 0.4**2, area, delta=0.02 * area)


if __name__ == "__main__":
    unittest.main()
