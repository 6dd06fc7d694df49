"""The mpirun line, restart files, and whole jobs with a stand-in for mpirun's programs."""

import os
import pathlib
import signal
import stat
import subprocess
import sys
import tempfile
import time
import types
import unittest

import tools_path  # noqa: F401
from littoral_lib import launch, programs, run
from littoral_lib.errors import UserError


def runs(pid):
    """Whether a process still runs: one that ended may wait for a while until its parent takes note."""
    for _ in range(100):
        try:
            if pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return False
        except OSError:
            return False
        time.sleep(0.05)
    return True


class Jobs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        for program in ("sph", "fv"):
            path = self.folder / f"{program}_solver"
            path.write_text("#!/bin/sh\nexit 0\n")
            path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def tearDown(self):
        self.temporary.cleanup()

    def scene(self, programs, settings=()):
        return types.SimpleNamespace(programs=programs, settings=list(settings), folder=self.folder)

    def line(self, *args, **kwargs):
        return launch.mpi_line(*args, bin_dir=self.folder, **kwargs)

    def test_two_programs_make_one_mpmd_line(self):
        line = self.line(self.scene(["sph", "fv"], ["fv.a=1"]), "out", {"sph": 2, "fv": 3})
        middle = line.index(":")
        sph, fv = line[:middle], line[middle:]
        self.assertIn(str(self.folder / "sph_solver"), sph)
        self.assertEqual(sph[sph.index("-n") + 1], "2")
        self.assertEqual(fv[fv.index("-n") + 1], "3")
        self.assertEqual(fv[fv.index("--set") + 1], "a=1")
        self.assertNotIn("--set", sph)

    def test_one_program_is_a_plain_line(self):
        self.assertNotIn(":", self.line(self.scene(["fv"]), "out", {"sph": 1, "fv": 1}))

    def test_a_missing_program_says_how_to_build(self):
        (self.folder / "fv_solver").unlink()
        with self.assertRaisesRegex(UserError, "cmake --build"):
            self.line(self.scene(["fv"]), "out", {"sph": 1, "fv": 1})

    def test_restart_takes_a_window_both_have(self):
        for program, windows in (("sph", (10, 20, 30)), ("fv", (10, 20))):
            (self.folder / program).mkdir()
            for window in windows:
                (self.folder / program / f"checkpoint_{window:08d}.h5").touch()
        scene = self.scene(["sph", "fv"])
        self.assertIn("20", run.restart_files(scene, self.folder, "latest")["sph"].name)
        self.assertIn("10", run.restart_files(scene, self.folder, "10")["fv"].name)
        with self.assertRaisesRegex(UserError, "10, 20"):
            run.restart_files(scene, self.folder, "30")

    def test_a_job_that_outlives_its_time_is_ended_with_its_children(self):
        begin = time.monotonic()
        result = launch.execute(["sh", "-c", "sleep 60 & wait"], dict(os.environ), timeout=0.3)
        self.assertEqual(result.status, 124)
        self.assertLess(time.monotonic() - begin, 10)

    def test_a_signal_ends_the_job_with_its_children(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            child = self.folder / "child"
            script = f"import pathlib, sys\nsys.path.insert(0, {str(pathlib.Path(launch.__file__).parents[1])!r})\n" \
                     "from littoral_lib import errors, launch\nimport os\nerrors.end_on_signals()\n" \
                     f"print(launch.execute(['sh', '-c', 'sleep 60 & echo $! > {child}; wait'], dict(os.environ)).status)\n"
            child.unlink(missing_ok=True)
            job = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
            while not (child.exists() and child.read_text().strip()):
                time.sleep(0.02)
            job.send_signal(number)
            self.assertEqual(job.communicate(timeout=30)[0].strip(), str(128 + number))
            self.assertFalse(runs(int(child.read_text())))

    def test_output_and_status_come_back(self):
        seen = []
        result = launch.execute([sys.executable, "-c", "print('sph: one'); raise SystemExit(3)"], dict(os.environ),
                                seen.append)
        self.assertEqual((result.status, seen), (3, ["sph: one"]))

    def test_a_killed_program_is_named(self):
        box = ["mpirun noticed that process rank 2 with PID 0 on node a exited on", "signal 9 (Killed)."]
        self.assertEqual(len(launch.killed(box, [("sph", 2), ("fv", 3)])), 1)
        self.assertRegex(launch.killed(box, [("sph", 2), ("fv", 3)])[0], r"^fv_solver \(its rank 0\).*signal 9 \(Killed\)")
        self.assertRegex(launch.killed(box, [("sph", 3)])[0], r"^sph_solver \(its rank 2\)")
        self.assertEqual(launch.killed(["fv: error: no"], [("sph", 1), ("fv", 1)]), [])

    def test_results_of_an_earlier_run_are_not_taken_for_this_ones(self):
        out = self.folder / "out"
        (out / "sph").mkdir(parents=True)
        (out / "sph" / "gauges.csv").touch()
        with self.assertRaisesRegex(UserError, "another --out"):
            run.clear(out)
        self.assertTrue((out / "sph" / "gauges.csv").exists())
        (out / "command").touch()
        (out / "note.txt").touch()
        run.clear(out)
        self.assertEqual([p.name for p in out.iterdir()], ["note.txt"])
        run.clear(self.folder / "new")

    def test_own_words_leave_out_the_boxes_of_mpirun(self):
        box = ["-" * 40, "mpirun detected that a process exited", "-" * 40]
        self.assertEqual(launch.own_words(["fv: error: no", *box, ""]), ["fv: error: no"])

    def test_own_words_leave_out_what_open_mpi_says_of_itself(self):
        noise = ["[node-7:1234] 1 more process has sent help message help-mpi-api.txt / mpi-abort",
                 "[node-7:1234] Set MCA parameter \"orte_base_help_aggregate\" to 0 to see all help / error messages",
                 "[node-7:01234] PMIX ERROR: UNREACHABLE in file server/pmix_server.c at line 2795"]
        self.assertEqual(launch.own_words(["sph_solver rank 0: no", *noise]), ["sph_solver rank 0: no"])
        self.assertEqual(launch.own_words(["[0.1, 0.2] is no box"]), ["[0.1, 0.2] is no box"])

    def test_an_installation_finds_its_own_programs(self):
        prefix = self.folder / "prefix"
        self.assertEqual(programs.own_folders(prefix / "share" / "littoral"), [prefix / "bin"])


if __name__ == "__main__":
    unittest.main()
