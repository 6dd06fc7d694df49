"""What littoral check predicts, from what the programs print."""

import unittest

import tools_path
from littoral_lib import estimate
from littoral_lib.scene import Scene

PARTICLES = """configs/submerged_cylinder/sph.yaml: no problem found
particles: 2688
dt: at most 0.0075 s
steps: at least 8000
memory: about 20 MiB
"""
CELLS = "fv_solver: block 'box': 320 x 88 cells, skewness up to 0\nfv_solver: fv.yaml: no problem found; 32256 cells\n"


class PredictionTest(unittest.TestCase):
    def lines(self, *settings, sph=PARTICLES, fv=CELLS):
        told = {"sph": estimate.foreseen(sph), "fv": estimate.foreseen(fv)}
        return estimate.predict(Scene("submerged_cylinder", settings), told, {})

    def test_reads_what_the_programs_print(self):
        self.assertEqual(estimate.foreseen(PARTICLES), {"particles": 2688, "dt": 0.0075, "steps": 8000, "memory": 20})
        self.assertEqual(estimate.foreseen(CELLS), {"cells": 32256})

    def test_windows_are_of_as_many_steps_as_the_scene_says(self):
        self.assertEqual(self.lines("scene.time.end=60"),
                         ["particles: 2688 at the start", "cells: 32256", "steps of the particles: about 8000 of 0.0075 s",
                          "steps of the grid: about 1600 of 0.0375 s",
                          f"memory: about {2 * 40 + 20 + 32256 * 2500 / 2**20:.0f} MiB"])

    def test_windows_of_a_given_length_are_cut_into_steps_below_the_limit(self):
        lines = self.lines("scene.time.end=60", "scene.coupling.dt=0.02")
        self.assertIn("steps of the particles: about 9000 of 0.00667 s", lines)
        self.assertIn("steps of the grid: about 3000 of 0.02 s", lines)

    def test_steps_of_a_grid_alone_are_its_own(self):
        scene = Scene("wave_tank")
        steps = {"time": {"dt": "0.002", "cfl": "auto"}}
        told = {"fv": estimate.foreseen(CELLS)}
        self.assertTrue(any(line.startswith("steps of the grid: about") for line in estimate.predict(scene, told, {"fv": steps})))
        self.assertIn("steps of the grid: as the flow asks for (time.cfl)",
                      estimate.predict(scene, told, {"fv": {"time": {"dt": "auto", "cfl": 0.5}}}))


if __name__ == "__main__":
    unittest.main()
