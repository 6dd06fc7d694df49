"""Scene folders: which programs run, constants, settings; and that the shipped scenes are whole."""

import math
import pathlib
import tempfile
import unittest

import tools_path
from littoral_lib.errors import UserError
from littoral_lib.scene import Scene, assign, evaluate

TEXT = """
constants: {H: 2, k: pi/H, w: "sqrt(9*k^2)"}
time: {end: 3*H}
regions: [{lower: [0, 0, -H/2], upper: [1, 0, 1]}]
"""


class SceneFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "scene.yaml").write_text(TEXT)
        (self.folder / "sph.yaml").write_text("")

    def tearDown(self):
        self.temporary.cleanup()

    def test_constants_are_formulas_of_those_before(self):
        constants = Scene(self.folder).constants()
        self.assertAlmostEqual(constants["w"], 3 * math.pi / 2)

    def test_settings_change_what_follows_from_them(self):
        scene = Scene(self.folder, ["scene.constants.H=4"])
        self.assertEqual(scene.value("time.end"), 12)
        self.assertEqual(scene.regions()[0]["lower"], [0, 0, -2])

    def test_one_file_means_one_program(self):
        self.assertEqual(Scene(self.folder).programs, ["sph"])
        (self.folder / "fv.yaml").write_text("")
        self.assertEqual(Scene(self.folder).programs, ["sph", "fv"])
        self.assertEqual(Scene(self.folder, solver="fv").programs, ["fv"])

    def test_missing_pieces_are_named(self):
        with self.assertRaisesRegex(UserError, "fv.yaml"):
            Scene(self.folder, solver="fv")
        (self.folder / "sph.yaml").unlink()
        with self.assertRaisesRegex(UserError, "neither sph.yaml nor fv.yaml"):
            Scene(self.folder)
        with self.assertRaisesRegex(UserError, "Did you mean 'standing_wave'"):
            Scene("standing_waves")

    def test_list_items_can_be_set(self):
        tree = {"blocks": [{"cells": [1, 2]}]}
        assign(tree, "blocks[0].cells[1]", "7")
        self.assertEqual(tree["blocks"][0]["cells"], [1, 7])


class Formulas(unittest.TestCase):
    def test_power_is_a_caret_as_in_muparser(self):
        self.assertEqual(evaluate("2^3 + a", {"a": 1}), 9)

    def test_what_is_no_formula_is_refused(self):
        for text in ("__import__('os')", "q+1", "1+", "a; b"):
            with self.assertRaises(UserError, msg=text):
                evaluate(text, {})


class ShippedScenes(unittest.TestCase):
    def test_each_has_programs_constants_and_a_readme(self):
        for path in sorted((tools_path.ROOT / "configs").glob("*/scene.yaml")):
            with self.subTest(scene=path.parent.name):
                scene = Scene(path.parent)
                scene.constants(), scene.regions(), scene.reference()
                self.assertTrue((path.parent / "README.md").is_file())


if __name__ == "__main__":
    unittest.main()
