"""Periods, peaks and growth of signals whose answers are known."""

import unittest

import numpy as np
import tools_path  # noqa: F401
from littoral_lib import signals


class Signals(unittest.TestCase):
    time = np.linspace(0, 20, 2001)

    def test_period_of_a_damped_wave(self):
        signal = np.exp(-0.1 * self.time) * np.sin(2 * np.pi * self.time / 3.5)
        self.assertAlmostEqual(signals.mean_period(self.time, signal), 3.5, delta=1e-4)

    def test_no_period_without_crossings(self):
        self.assertTrue(np.isnan(signals.mean_period(self.time, 1 + self.time)))

    def test_energy_kept_from_the_peaks_of_a_decaying_square(self):
        kinetic = np.exp(-0.14 * self.time) * np.cos(2 * np.pi * self.time / 3.55) ** 2
        kept = signals.kept_per(*signals.peaks(self.time, kinetic, 0.7), 3.55)
        self.assertAlmostEqual(kept, np.exp(-0.14 * 3.55), delta=1e-5)

    def test_peaks_at_the_ends_are_not_counted(self):
        times, _ = signals.peaks(self.time, np.cos(2 * np.pi * self.time / 5), 1.0)
        np.testing.assert_allclose(times, [5, 10, 15], atol=1e-6)

    def test_moving_mean_keeps_lines_and_removes_its_own_period(self):
        line = 3 + 2 * self.time
        inner = slice(300, -300)
        np.testing.assert_allclose(signals.moving_mean(self.time, line, 2.0)[inner], line[inner], rtol=1e-12)
        wave = np.sin(2 * np.pi * self.time / 2.0)
        # 200 rows a period: the trapezoidal sums are exact to the square of the step
        np.testing.assert_allclose(signals.moving_mean(self.time, wave, 2.0)[inner], 0, atol=1e-3)

    def test_growth_compares_last_with_first(self):
        noise = np.sin(40 * self.time)
        self.assertAlmostEqual(signals.growth(noise), 1.0, delta=0.02)
        self.assertGreater(signals.growth(noise * np.exp(0.2 * self.time)), 10)


if __name__ == "__main__":
    unittest.main()
