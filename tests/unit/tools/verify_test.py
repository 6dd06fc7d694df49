"""Validation cases: gates, selection, and that every case of the tree is well formed."""

import pathlib
import tempfile
import unittest

import tools_path  # noqa: F401
from lib.case import Case
from littoral_lib import cases, verify
from littoral_lib.errors import UserError


class Gates(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.case = Case("c", self.temporary.name, self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def verdicts(self):
        return [m.passed for m in self.case.metrics]

    def test_each_gate_holds_on_its_side_only(self):
        for value in (0.9, 1.1):
            self.case.metric("b", value, below=1)
            self.case.metric("a", value, above=1)
            self.case.metric("i", value, between=(1, 2))
        self.assertEqual(self.verdicts(), [True, False, False, False, True, True])

    def test_the_bound_itself_passes_only_where_named_at(self):
        self.case.metric("b", 1, below=1)
        self.case.metric("m", 1, at_most=1)
        self.case.metric("l", 1, at_least=1)
        self.assertEqual(self.verdicts(), [False, True, True])

    def test_nan_misses_every_gate(self):
        nan = float("nan")
        self.case.metric("b", nan, below=1)
        self.case.metric("a", nan, above=1)
        self.case.metric("i", nan, between=(0, 1))
        self.assertEqual(self.verdicts(), [False] * 3)

    def test_without_a_gate_a_number_is_only_recorded(self):
        self.case.metric("n", 5)
        self.assertEqual(self.verdicts(), [True])

    def test_tables_are_kept_as_text(self):
        self.case.table("A table", ["x", "y"], [[1, 2.0]])
        self.assertIn("| 1 | 2 |", (pathlib.Path(self.temporary.name) / "a_table.md").read_text())


class CaseFolders(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def add(self, name, text, check=None):
        (self.folder / name).mkdir()
        (self.folder / name / "case.yaml").write_text(text)
        if check is not None:
            (self.folder / name / "check.py").write_text(check)

    def test_names_ids_tiers_and_groups_select(self):
        self.add("one", "{ids: [C1], group: coupled, tier: U, ctest: a}")
        self.add("two", "{ids: [C2], group: sph, tier: F, ctest: b}")
        found = cases.load_all(self.folder)
        self.assertEqual([c.name for c in cases.select(found, ["C1"])], ["one"])
        self.assertEqual([c.name for c in cases.select(found, tiers=["F"])], ["two"])
        self.assertEqual([c.name for c in cases.select(found, groups=["coupled"])], ["one"])
        with self.assertRaisesRegex(UserError, "Did you mean 'two'"):
            cases.select(found, ["twoo"])

    def test_ill_formed_cases_are_refused(self):
        for index, text in enumerate(("{group: x, tier: U, ctest: a}", "{group: sph, tier: Z, ctest: a}",
                                      "{group: sph, tier: U}", "{group: sph, tier: U, check: no.py}",
                                      "{group: sph, tier: U, ctest: a, grup: b}")):
            self.add(f"bad{index}", text)
            with self.assertRaises(UserError, msg=text):
                cases.CaseFile(self.folder / f"bad{index}")

    def test_a_case_that_raises_or_reports_nothing_is_missed(self):
        for name, check in (("raises", "def check(case): 1/0"), ("silent", "def check(case): pass")):
            self.add(name, "{group: sph, tier: U, check: check.py}", check)
            verdict, _ = verify.run_case(cases.CaseFile(self.folder / name), self.folder / "out")
            self.assertFalse(verdict["passed"])
            self.assertTrue(verdict["error"])

    def test_a_verdict_is_kept_as_json(self):
        self.add("good", "{group: sph, tier: U, check: check.py}",
                 "def check(case): case.metric('m', 1, below=2, unit='s')")
        verdict, _ = verify.run_case(cases.CaseFile(self.folder / "good"), self.folder / "out")
        self.assertTrue(verdict["passed"])
        self.assertTrue((self.folder / "out" / "good" / "verdict.json").is_file())

    def test_kept_verdicts_make_a_table(self):
        self.add("good", "{ids: [C9], group: sph, tier: U, check: check.py}",
                 "def check(case):\n    case.metric('far', 1, below=9)\n    case.metric('near', 1, below=1.5, unit='s')")
        case_file = cases.CaseFile(self.folder / "good")
        self.assertIn("not run", verify.kept_results([case_file], self.folder / "out"))
        verify.run_case(case_file, self.folder / "out")
        table = verify.kept_results([case_file], self.folder / "out").splitlines()
        self.assertIn("| C9 | good | near | 1 s | < 1.5 | pass |", table[2])
        self.assertIn("far", table[3])

    def test_every_case_of_the_tree_loads(self):
        for case in cases.load_all():
            self.assertTrue(case.title)


if __name__ == "__main__":
    unittest.main()
