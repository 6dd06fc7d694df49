"""What littoral check predicts, from configurations as the programs print them."""

import pathlib
import unittest

import tools_path
from littoral_lib import estimate
from littoral_lib.scene import Scene

WAVE = pathlib.Path(__file__).resolve().parents[3] / "configs" / "standing_wave"


class PredictionTest(unittest.TestCase):
    def steps(self, **sph):
        scene = Scene(WAVE, ["scene.constants.n=25"])
        line = next(line for line in estimate.predict(scene, {"sph": {"spacing": 0.04, **sph}})
                    if line.startswith("steps"))
        return int(line.split()[2])

    def test_keys_left_to_the_program_are_its_defaults(self):
        given = self.steps(kernel_radius=4, time={"cfl": 0.375, "integrator": "rk4"})
        self.assertEqual(self.steps(), given)
        self.assertEqual(self.steps(kernel_radius="auto", fidelity="standard", time={"cfl": "auto"}), given)

    def test_a_cheaper_integrator_takes_more_steps(self):
        self.assertGreater(self.steps(time={"cfl": "auto", "integrator": "midpoint"}), 1.3 * self.steps())

    def test_a_smaller_kernel_takes_more_steps(self):
        self.assertGreater(self.steps(fidelity="draft", kernel_radius="auto"), 1.3 * self.steps())


if __name__ == "__main__":
    unittest.main()
