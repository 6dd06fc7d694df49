"""--set: each setting reaches exactly the programs it is meant for."""

import unittest

import tools_path  # noqa: F401
from littoral_lib.errors import UserError
from littoral_lib.settings import route, scene_overrides


class Routing(unittest.TestCase):
    def test_scene_keys_go_to_all_programs_unchanged(self):
        dealt = route(["scene.time.end=2"], ["sph", "fv"])
        self.assertEqual(dealt, {"sph": ["scene.time.end=2"], "fv": ["scene.time.end=2"]})

    def test_program_keys_go_to_one_without_prefix(self):
        dealt = route(["sph.time.cfl=0.5", "fv.dual_time.cycles=9"], ["sph", "fv"])
        self.assertEqual(dealt, {"sph": ["time.cfl=0.5"], "fv": ["dual_time.cycles=9"]})

    def test_values_may_contain_equals_signs_and_dots(self):
        self.assertEqual(route(["sph.initial.u=x==0.5"], ["sph"]), {"sph": ["initial.u=x==0.5"]})

    def test_settings_of_a_program_that_does_not_run_are_left_out(self):
        self.assertEqual(route(["fv.x.y=1"], ["sph"]), {"sph": []})

    def test_misspelt_prefix_names_the_nearest(self):
        with self.assertRaisesRegex(UserError, "Did you mean 'sph'"):
            route(["spx.time.cfl=1"], ["sph", "fv"])

    def test_what_is_no_assignment_is_refused(self):
        for text in ("scene.time.end", "end=1", "=1", "sph.=2"):
            with self.assertRaises(UserError, msg=text):
                route([text], ["sph", "fv"])

    def test_scene_overrides_are_the_scene_part(self):
        self.assertEqual(scene_overrides(["sph.a=1", "scene.fluid.density=2"]), [("fluid.density", "2")])


if __name__ == "__main__":
    unittest.main()
