"""However a study is run and whatever stops it: the same table in the end, bit for bit, and nothing that was finished is computed again."""

import os
import resource
import signal
import subprocess
import time
import unittest

import lfdsim
from common import LHS, StudyTest, alive, call, children, command, start

from lfdsim import study
from lfdsim.study import StudyError, collected, planned

ROWS = 48


class Runs(StudyTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        case = StudyTest()
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        study.run(case.lhs(ROWS), case.folder / "out", workers=1, progress=False)
        cls.expected = (case.folder / "out" / "study.parquet").read_bytes()

    def setUp(self):
        super().setUp()
        self.file, self.out = self.lhs(ROWS), self.folder / "out"

    def finished(self) -> dict:
        return {p.name: p.stat().st_ino for p in (self.out / "rows").glob("*.parquet")} if self.out.exists() else {}

    def wait_for(self, count: int, process: subprocess.Popen) -> None:
        """Until some chunks are there, while it is running."""
        end = time.monotonic() + 300  # on a machine that does much else
        while len(self.finished()) < count:
            self.assertIsNone(process.poll(), "it ended too early")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.002)

    def check_finishes_with_what_is_there(self):
        before = self.finished()
        done = call("run", self.file, "-o", self.out, "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        self.assertEqual(before, {n: i for n, i in self.finished().items() if n in before})
        left = [p.name for p in (self.out / "rows").iterdir() if p.suffix != ".parquet"]
        self.assertEqual(left, [])

    def test_two_workers(self):
        study.run(self.file, self.out, workers=2, progress=False)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())

    def test_parts_in_any_order(self):
        self.assertEqual(call("plan", self.file, "-o", self.out).returncode, 0)
        early = call("collect", self.out)
        self.assertEqual(early.returncode, 2)
        self.assertIn("is not finished: 16 chunks of 16 missing", early.stderr)
        for part in (2, 0, 1):
            done = call("run", self.out, "--chunk", part, "--of", 3)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(call("collect", self.out).returncode, 0)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        self.assertIn("give a whole number from 0 to 2", call("run", self.out, "--chunk", 3, "--of", 3).stderr)

    def test_a_killed_run_continues(self):
        process = start("run", self.file, "-o", self.out, "--no-report", "--workers", 2)
        self.wait_for(3, process)
        workers = children(process.pid)
        self.assertTrue(workers)
        process.kill()
        process.communicate()
        end = time.monotonic() + 10
        while any(map(alive, workers)) and time.monotonic() < end:  # they end with their standard input
            time.sleep(0.01)
        self.assertFalse(any(map(alive, workers)))
        self.assertFalse((self.out / "study.parquet").exists())
        self.check_finishes_with_what_is_there()

    def test_a_killed_worker_is_replaced(self):
        process = start("run", self.file, "-o", self.out, "--no-report", "--workers", 2)
        self.wait_for(2, process)
        os.kill(children(process.pid)[0], signal.SIGKILL)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())

    def test_ctrl_c_stops_at_once_and_continues(self):
        process = subprocess.Popen(
            command("run", self.file, "-o", self.out, "--no-report"),
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # background jobs of a shell's script ignore it
        )
        self.wait_for(2, process)
        workers = children(process.pid)
        asked = time.monotonic()
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of its processes
        errors = process.communicate()[1]
        self.assertEqual(process.returncode, 130, errors)
        self.assertNotIn("Traceback", errors)
        self.assertLess(time.monotonic() - asked, 2)
        self.assertFalse(any(map(alive, workers)))
        self.check_finishes_with_what_is_there()

    def test_a_full_disk_is_told_and_loses_nothing(self):
        """Here files may only have so many bytes: the plan has fewer, a chunk's file more, and the journal reaches it row by row."""

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        self.assertEqual(call("plan", self.file, "-o", self.out).returncode, 0)
        for size in (100, 3000, 7000):
            done = call("run", self.out, "--chunk", 0, "--of", 1, preexec_fn=limit)
            self.assertEqual(done.returncode, 1)
            self.assertIn("make room", done.stderr)
            self.assertNotIn("Traceback", done.stderr)
        self.check_finishes_with_what_is_there()

    def test_impossible_rows_have_their_reason_and_the_others_go_on(self):
        path = self.write(LHS.replace("ROWS", "8").replace("uniform = { from = 15.6, to = 15.8 }", "values = [15.7, -1.0]"), "half.toml")
        table = study.run(path, self.out, workers=1, progress=False)
        impossible = table["lens.focal_length_mm"] < 0
        self.assertEqual(int(impossible.sum()), 4)
        self.assertTrue(table["error"][impossible].str.contains("lens.focal_length_mm").all())
        self.assertTrue(table["error"][~impossible].isna().all())
        self.assertTrue(table["check.theory.central_depth_mm"][~impossible].notna().all())

    def test_a_row_that_fails_for_another_reason_is_not_done(self):
        from lfdsim.study import chunk

        plan = study.plan(self.file, self.out)
        original = lfdsim.check
        self.addCleanup(setattr, lfdsim, "check", original)

        def lacks_memory(display, **_):
            raise lfdsim.InputError([("panel.pixels", "a picture needs 17 MB of memory; the control group has 0 kB free")])

        lfdsim.check = lacks_memory
        self.assertIn("needs 17 MB of memory", chunk.attempt(plan, 0, 1)["problem"])
        self.assertFalse(plan.chunk_path(0).exists())

        def fails(display, **_):
            raise MemoryError("no memory")

        lfdsim.check = fails
        self.assertIn("no memory", chunk.attempt(plan, 0, 1)["problem"])
        with self.assertRaisesRegex(study.StudyFailed, "chunk 0: MemoryError: no memory.*run the same command again"):
            study.run_part(self.out, 0, 1)
        lfdsim.check = original
        self.check_finishes_with_what_is_there()

    def test_a_device_that_is_not_there_makes_no_row_impossible(self):
        text = LHS.replace("ROWS", "3").replace('name = "check"', 'name = "spot"\nsettings = { device = "cuda:999" }')
        text = text.replace('figures = ["theory.central_depth_mm", "theory.fov_exact_deg"]', "")
        done = call("run", self.write(text, "gpu.toml"), "-o", self.folder / "gpu", "--workers", 1)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("device: cuda:999", done.stderr)
        self.assertFalse(list((self.folder / "gpu" / "rows").glob("*.parquet")))

    def test_figures_are_those_of_check(self):
        table = study.run(self.file, self.out, workers=1, progress=False)
        base = lfdsim.Display.load(self.folder / "display.toml")
        for row in (0, 17, ROWS - 1):
            keys = ("array.gap_mm", "lens.focal_length_mm")
            found = lfdsim.check(base.with_({k: float(table[k][row]) for k in keys}))["theory"]
            self.assertEqual(found["central_depth_mm"], table["check.theory.central_depth_mm"][row])

    def test_bad_command_lines(self):
        for words, said in (
            (["run", self.file], "-o: is missing"),
            (["run", self.out, "--chunk", "1"], "belong together"),
            (["run", self.file, "-o", self.out, "--dask", "x", "--workers", "2"], "Give one of them"),
            (["run", self.out, "--chunk", "0", "--of", "1", "-o", "x"], "no meaning"),
            (["collect", self.out], "holds no study"),
            (["run", self.folder / "none.toml", "-o", self.out], "cannot be read"),
        ):
            done = call(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_wrong_arguments_are_named(self):
        for kind, words, work in (
            (TypeError, "file is a int; give a path", lambda: study.run(5, self.out)),
            (TypeError, "folder is a NoneType; give a path", lambda: study.plan(self.file, None)),
            (TypeError, "folder is a int; give a path", lambda: study.collect(5)),
            (StudyError, "folder: is empty; give a path", lambda: study.report("")),
            (StudyError, r"part \(--chunk\): is 4; give a whole number from 0 to 3", lambda: study.run_part(self.out, 4, 4)),
            (StudyError, r"part \(--chunk\): is 0.5", lambda: study.run_part(self.out, 0.5, 4)),
            (StudyError, r"parts \(--of\): is '4'; give a whole number from 1", lambda: study.run_part(self.out, 1, "4")),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                work()

    def test_progress_is_no_word(self):
        for work in (study.run, study.tolerance):
            for wrong in ("no", 0, print):
                with self.assertRaisesRegex(StudyError, "progress: is .*; give True, False or None"):
                    work(self.file, self.out, progress=wrong)
        self.assertFalse(self.out.exists())

    def test_more_at_once_than_any_machine_takes(self):
        display = self.folder / "display.toml"
        for wrong in ({"workers": 0}, {"workers": 1025}, {"workers": 2.0}, {"threads": 0}, {"threads": 10**30}):
            for work in (lambda: study.run(self.file, self.out, **wrong), lambda: study.tolerance(display, self.out, **wrong)):
                with self.assertRaisesRegex(StudyError, r"(workers|threads): is [\d.]+; give a whole number from 1 to 1024"):
                    work()
        self.assertFalse(self.out.exists())

    def test_the_table_in_memory_is_the_file(self):
        study.run(self.file, self.out, workers=1, progress=False)
        (self.out / "study.parquet").unlink()
        collected.table_of(planned.load(self.out))
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        with self.assertRaises(StudyError):
            study.run(self.file, self.folder / "display.toml", workers=1)


if __name__ == "__main__":
    unittest.main()
