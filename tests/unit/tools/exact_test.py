"""Standing waves: dispersion relation, initial-value problem, and that both satisfy the physics they came from."""

import math
import unittest

import numpy as np
import tools_path  # noqa: F401
from littoral_lib.exact import OscillatingDrop, StandingWave, havelock_drag, normal_mode, square_patch_pressure


def wave(reynolds, **more):
    return StandingWave(0.05, math.pi, 1.0, 1.0, 1.0 / reynolds, **more)


class NormalMode(unittest.TestCase):
    def test_decays_slower_than_deep_water_theory(self):
        # factors on the exponent 4 nu k^2 of the energy, from an independent solution of the dispersion relation
        for reynolds, factor in ((250, 0.894), (1000, 0.947)):
            rate = normal_mode(math.pi, 1.0, 1.0, 1.0 / reynolds).real
            self.assertAlmostEqual(rate / (-2 * math.pi**2 / reynolds), factor, delta=0.0006)

    def test_energy_kept_in_an_inviscid_period(self):
        self.assertAlmostEqual(wave(250).mode_energy_kept, 0.606, delta=0.0005)

    def test_tends_to_the_inviscid_wave(self):
        s = normal_mode(math.pi, 1.0, 1.0, 1e-8)
        self.assertAlmostEqual(s.imag, math.sqrt(math.pi * math.tanh(math.pi)), delta=1e-4)


class InitialValueProblem(unittest.TestCase):
    def test_starts_flat_with_the_given_velocity(self):
        w = wave(250)
        z = np.array([0.0, -0.3, -1.0])
        u_start, w_start = w.velocity([1e-6], z)
        k, speed = math.pi, 0.05 * w.omega0
        np.testing.assert_allclose(w_start[0], speed * np.sinh(k * (z + 1)) / math.sinh(k), atol=1e-6 * speed)
        # at the surface itself the layer is there at once: u is compared below it
        np.testing.assert_allclose(u_start[0][1:], speed * np.cosh(k * (z[1:] + 1)) / math.sinh(k), rtol=1e-5)
        self.assertAlmostEqual(w.elevation(0.0)[0], 0.0, delta=1e-9)

    def test_surface_moves_with_the_water(self):
        w = wave(250)
        t = np.linspace(0.2, 6, 400)
        step = t[1] - t[0]
        rate = (w.elevation(t + 0.5 * step) - w.elevation(t - 0.5 * step)) / step
        # central difference: error step^2/24 of the third derivative, 1e-5 of the speed here
        np.testing.assert_allclose(rate, w.velocity(t, [0.0])[1][:, 0], atol=5e-5 * w.w0)

    def test_no_shear_on_the_surface(self):
        w = wave(250)
        h = 1e-5
        u, v = w.velocity([2.0], [0.0, -h])
        shear = (u[0, 0] - u[0, 1]) / h + math.pi * v[0, 0]  # u ~ -sin(kx): u_z + w_x ~ -(U_z + k W) sin(kx)
        self.assertAlmostEqual(shear / (math.pi * w.w0), 0.0, delta=1e-3)

    def test_energy_falls_from_the_start_as_the_mode_does(self):
        w = wave(250, density=1000.0)
        energy = w.energy(np.array([0, 1, 2, 3]) * w.period0, 2.0)
        self.assertAlmostEqual(energy[0], 0.25 * 1000 * 2 * 0.05**2, delta=1e-6)
        for kept in energy[1:] / energy[:-1]:
            self.assertAlmostEqual(kept, 0.6065, delta=0.001)

    def test_late_times_are_the_normal_mode(self):
        w = wave(250)
        t = 4 * w.period0 + np.linspace(0, w.period, 50)
        # by then the remainder is the slow diffusion of the first vorticity, small against the wave
        ratio = w.elevation(t + w.period) / w.elevation(t)
        usable = np.abs(w.elevation(t)) > 0.005
        np.testing.assert_allclose(ratio[usable], math.exp(w.mode.real * w.period), rtol=2e-3)

    def test_weak_viscosity_equals_the_inviscid_formula(self):
        t = np.linspace(0.1, 4, 20)
        np.testing.assert_allclose(wave(1e9).elevation(t), StandingWave(0.05, math.pi, 1, 1).elevation(t), atol=1e-6)

    def test_a_raised_surface_at_rest_begins_to_fall(self):
        w = StandingWave(0.0, math.pi, 1.0, 1.0, 0.004, elevation=0.05)
        self.assertAlmostEqual(w.elevation(1e-4)[0], 0.05, delta=1e-6)
        self.assertLess(w.elevation(0.5 * w.period)[0], -0.03)


class Drop(unittest.TestCase):
    def test_period_and_longest_axis(self):
        # both from an independent integration, for strain = force
        for scale in (1.0, 2.5):
            drop = OscillatingDrop(0.1, scale, scale, 14 / scale)
            self.assertAlmostEqual(drop.period * scale, 4.82734, delta=1e-5)
            self.assertAlmostEqual(drop.longest_axis / 0.1, 1.93185, delta=1e-5)

    def test_area_stays_and_the_motion_repeats(self):
        drop = OscillatingDrop(1.0, 1.0, 1.0, 14.5)
        a, b = drop.axes(np.linspace(0, 14, 50))
        np.testing.assert_allclose(a * b, 1.0, rtol=1e-8)
        np.testing.assert_allclose(drop.axes(2 * drop.period + 0.3), drop.axes(0.3), rtol=1e-7)


class SquarePatch(unittest.TestCase):
    def test_pressure_at_the_centre(self):
        self.assertAlmostEqual(float(square_patch_pressure(0, 0, 2.0, 3.0, 10.0)), -0.14734 * 10 * 9 * 4, delta=2e-3)

    def test_satisfies_the_poisson_equation_and_the_sides(self):
        h, x, z = 1e-3, 0.13, -0.21
        p = lambda dx, dz: float(square_patch_pressure(x + dx, z + dz, 1.0, 1.0))
        laplacian = (p(h, 0) + p(-h, 0) + p(0, h) + p(0, -h) - 4 * p(0, 0)) / h**2
        self.assertAlmostEqual(laplacian, 2.0, delta=1e-5)
        side = np.linspace(-0.5, 0.5, 11)
        np.testing.assert_allclose(square_patch_pressure(0.5, side, 1.0, 1.0), 0.0, atol=1e-12)
        # the series on z = +-1/2 converges as 1/n^2 at the corners
        np.testing.assert_allclose(square_patch_pressure(side, 0.5, 1.0, 1.0), 0.0, atol=2e-5)


class HavelockDrag(unittest.TestCase):
    def test_of_the_papers_cylinder(self):
        # Fr = U/sqrt(g d) = 1, top of the cylinder 1.5 d below the surface: C_D = .090
        self.assertAlmostEqual(havelock_drag(0.5, 2.0, 1.0, 1.0) / 0.5, 0.0904, delta=5e-5)

    def test_in_other_units(self):
        d, g, rho = 0.1, 9.81, 1000.0
        speed = math.sqrt(g * d)
        drag = havelock_drag(0.5 * d, 2.0 * d, speed, g, rho)
        self.assertAlmostEqual(drag / (0.5 * rho * speed**2 * d), 0.0904, delta=5e-5)


if __name__ == "__main__":
    unittest.main()
