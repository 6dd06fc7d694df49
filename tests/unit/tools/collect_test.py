"""OUT/scalars.csv: both programs' shares added at the times both have."""

import json
import pathlib
import tempfile
import types
import unittest

import numpy as np
import tools_path  # noqa: F401
from littoral_lib import collect, tables
from littoral_lib.errors import UserError


def share(times, mass, energy=1.0):
    n = len(times)
    return tables.Table({"time": np.array(times, float), "kinetic_energy": np.full(n, energy),
                         "potential_energy": np.zeros(n), "mass": np.full(n, float(mass))})


class Joining(unittest.TestCase):
    def test_shares_add_up_at_equal_times(self):
        joined = collect.join_scalars([share([0, 1, 2], 3), share([0, 1, 2], 4)])
        self.assertEqual(list(joined["time"]), [0, 1, 2])
        self.assertEqual(list(joined["mass"]), [7, 7, 7])

    def test_only_common_times_count(self):
        joined = collect.join_scalars([share([0, 1, 2, 3], 3), share([1, 3, 4], 4)])
        self.assertEqual(list(joined["time"]), [1, 3])

    def test_round_off_in_time_is_no_difference(self):
        joined = collect.join_scalars([share([0, 0.1, 0.3], 1), share([0, 0.1 + 1e-16, 0.1 + 0.2], 1)])
        self.assertEqual(len(joined["time"]), 3)

    def test_neighbouring_times_are_not_mixed_up(self):
        joined = collect.join_scalars([share([0, 1.0], 1), share([0, 1.01], 1)])
        self.assertEqual(list(joined["time"]), [0])

    def test_one_program_alone_is_its_own_sum(self):
        self.assertEqual(list(collect.join_scalars([share([0, 1], 5)])["mass"]), [5, 5])

    def test_a_partner_without_rows_leaves_none(self):
        self.assertEqual(len(collect.join_scalars([share([0, 1], 5), share([], 1)])["time"]), 0)


class Files(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.out = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_comments_are_skipped_and_a_cut_row_is_left_out(self):
        (self.out / "a.csv").write_text("# s, kg\ntime,mass\n0,1\n1,2\n2")
        table = tables.read_csv(self.out / "a.csv")
        self.assertEqual(list(table["mass"]), [1, 2])
        with self.assertRaisesRegex(UserError, "Did you mean 'mass'"):
            table["masse"]

    def test_summary_names_what_ran_and_what_came_out(self):
        for program, mass in (("sph", 1.25), ("fv", 2.5)):
            (self.out / program).mkdir()
            tables.write_csv(self.out / program / "scalars.csv", share([0, 1], mass).columns)
            (self.out / program / "summary.json").write_text('{"version": "9"}')
        scene = types.SimpleNamespace(programs=["sph", "fv"], name="s", data={}, folder="f", settings=[],
                                      reference=lambda: None, regions=lambda: [],
                                      value=lambda key, default: default, vector=lambda key: [0, 0, 0])
        collect.collect(self.out, scene, {"status": 0, "ranks": {"sph": 1, "fv": 1}})
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual(summary["results"]["mass_last"], 3.75)
        self.assertEqual(summary["programs"]["fv"]["version"], "9")
        first = (self.out / "scalars.csv").read_text().splitlines()
        self.assertTrue(first[0].startswith("#"))
        self.assertEqual(first[1], "time,kinetic_energy,potential_energy,mass")


if __name__ == "__main__":
    unittest.main()
