"""littoral check with the programs themselves (LITTORAL_BIN): good scenes pass, of bad ones every problem is named."""

import pathlib
import shutil
import tempfile
import unittest

import tools_path  # noqa: F401
from littoral_lib import checking
from littoral_lib.scene import ROOT, Scene


def problems(scene, *settings):
    return checking.check(Scene(str(scene), settings))[0]


class GoodScenes(unittest.TestCase):
    def test_they_pass_and_are_predicted(self):
        for name in ("still_water", "dam_break"):  # of two programs, of one
            with self.subTest(scene=name):
                found, predictions = checking.check(Scene(name))
                self.assertEqual(found, [])
                self.assertTrue(any(line.startswith(("particles:", "cells:")) for line in predictions), predictions)

    def test_a_trial_tells_seconds(self):
        scene = Scene("still_water", ("scene.constants.n=20",))
        found, predictions = checking.check(scene, trial=True, threads=1)
        self.assertEqual(found, [])
        self.assertRegex(predictions[-2], r"^seconds: about \d+, at the pace of windows \d+ to \d+ of \d+$")


class StrangeScenes(unittest.TestCase):
    def test_warnings_of_both_programs_are_shown_once(self):
        found, lines = checking.check(Scene("still_water", ("scene.gravity=[0, 0, 9.81]",)))
        self.assertEqual(found, [])
        self.assertEqual([line for line in lines if line.startswith("warning: gravity points up")], lines[:1])


class BadScenes(unittest.TestCase):
    def test_mistakes_of_both_files_are_shown_together(self):
        text = "\n".join(problems("still_water", "scene.fluid.densty=1000", "sph.spacng=0.04", "fv.dual_time.drp=0.1"))
        for line in (r"unknown key 'fluid\.densty'\. Did you mean 'fluid\.density'\?",
                     r"unknown key 'spacng'\. Did you mean 'spacing'\?",
                     r"unknown key 'dual_time\.drp'\. Did you mean 'dual_time\.drop'\?"):
            self.assertRegex(text, line)

    def test_values_out_of_range_are_named(self):
        self.assertRegex("\n".join(problems("still_water", "sph.spacing=-0.04")), r"spacing.*-0\.04")
        self.assertRegex("\n".join(problems("still_water", "scene.regions[0].lower=[0, 0, -3]")), "region")

    def test_water_that_nobody_computes_is_named(self):
        self.assertRegex("\n".join(problems("still_water", "fv.blocks[0].lower=[0, 0, -0.9]")),
                         r"the domain begins at z = -1 m, the grid at -0\.9 m")

    def test_programs_that_read_different_scenes_are_told_what_differs(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "still_water"
            shutil.copytree(ROOT / "configs" / "still_water", scene)
            text = (scene / "scene.yaml").read_text()
            other = text.replace("gravity: [0, 0, -g]", "gravity: [0, 0, -2*g]")
            self.assertNotEqual(other, text)
            (scene / "other.yaml").write_text(other)
            (scene / "fv.yaml").write_text((scene / "fv.yaml").read_text().replace("scene.yaml", "other.yaml"))
            self.assertRegex("\n".join(problems(scene)), r"the handshake would fail: gravity.*: sph has .*, fv has ")


if __name__ == "__main__":
    unittest.main()
