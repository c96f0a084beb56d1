"""lfdsim study and lfdsim tolerance, as the program in a build and as the command of an installed package."""

import fcntl
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

from common import DISPLAY, LHS, StudyTest, call

from lfdsim.study import api, files
from lfdsim.study.problems import StudyError
from lfdsim.study.tolerances import tolerance

PROGRAM = pathlib.Path(os.environ["LFDSIM_PROGRAM"])
ARRAY = pathlib.Path(__file__).resolve().parents[2] / "examples" / "study" / "array.sh"
INSTALLED = (sys.executable, "-c", "from lfdsim.program import main; main()")


class Program(StudyTest):
    def setUp(self):
        super().setUp()
        self.file, self.out = self.lhs(6), self.folder / "out"

    def run_it(self, *words: object, program=(PROGRAM,), **environment) -> subprocess.CompletedProcess:
        without = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | environment
        return subprocess.run([*map(str, program), *map(str, words)], capture_output=True, text=True, env=without, cwd=self.folder)

    def test_gives_the_same_table(self):
        self.assertEqual(call("run", self.file, "-o", self.folder / "module").returncode, 0)
        expected = (self.folder / "module" / "study.parquet").read_bytes()
        here = {"PYTHONPATH": os.environ["PYTHONPATH"]}
        for name, program, environment in (("built", (PROGRAM,), {}), ("installed", INSTALLED, here)):
            done = self.run_it("study", "study.toml", "-o", name, program=program, **environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"{name}/report.html", done.stdout)
            self.assertEqual(expected, (self.folder / name / "study.parquet").read_bytes())

    def test_tolerance(self):
        path = self.folder / "display.toml"
        path.write_text(path.read_text() + "[errors]\ngap_mm = 0.02\n")
        done = self.run_it("tolerance", "display.toml", "-o", "out", "--draws", 3, "--alone", 0, "--measure", "check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.out / "tolerance.html").exists())

    def array(self, tasks: list[int], *words: object) -> list[subprocess.CompletedProcess]:
        """What Slurm runs for `sbatch --array=TASKS array.sh FOLDER WORDS`, by this Python in place of the system's."""
        script = ARRAY.read_text()
        self.assertIn("exec python3 ", script)
        (self.folder / "array.sh").write_text(script.replace("exec python3 ", f"exec {sys.executable} "))
        names = ("COUNT", "MIN", "MAX", "ID")
        return [
            subprocess.run(
                ["bash", self.folder / "array.sh", self.out, *map(str, words)],
                env=os.environ | {f"SLURM_ARRAY_TASK_{n}": str(v) for n, v in zip(names, (len(tasks), min(tasks), max(tasks), task))},
                capture_output=True,
                text=True,
            )
            for task in tasks
        ]

    def chunks(self) -> list[str]:
        return sorted(p.name for p in (self.out / "rows").glob("*.parquet"))

    def test_parts_of_an_array_job(self):
        """The study has two chunks."""
        api.plan(self.file, self.out)
        for tasks in ([1], [1, 2], [0, 2]):
            for done in self.array(tasks):
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, f"no whole array; give --array=0-{len(tasks) - 1} .* N after the folder: sbatch --array=. array.sh .*/out N")
        self.assertEqual(self.chunks(), [])
        (done,) = self.array([1], 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.chunks(), ["chunk-000001.parquet"])
        for done in self.array([0, 1]):
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.chunks(), ["chunk-000000.parquet", "chunk-000001.parquet"])

    def test_help(self):
        everything = self.run_it("--help").stdout
        for command, word in (("study", "plan"), ("tolerance", "--draws")):
            self.assertIn(f"\n  {command} ", everything)
            text = self.run_it(command, "--help")
            self.assertEqual(text.returncode, 0)
            self.assertIn(word, text.stdout)
            self.assertEqual(text.stdout, self.run_it("help", command).stdout)

    def test_exit_codes_of_bad_usage(self):
        no_folder, unknown = ["study", "study.toml"], ["study", "run", "--nonsense"]
        for words in (["study"], ["study", "none.toml", "-o", "out"], no_folder, unknown, ["tolerance"]):
            done = self.run_it(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_more_at_once_than_any_machine_takes(self):
        for option in ("--workers", "--threads"):
            for number in ("0", "1025", "9" * 5000, "-1", "two", "1.5"):
                for command in ("study", "tolerance"):
                    done = self.run_it(command, "study.toml", "-o", "out", f"{option}={number}")
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(f"{option}: is {number}; give a whole number from 1 to 1024", done.stderr)

    def test_what_is_printed_is_not_obeyed(self):
        name = "\x1b[31mred\x9b\u202e\u200b\rforged"
        for words in ([name, "-o", "out"], ["run", "a.toml", "-o", "out", f"--{name}"]):
            done = call(*words, cwd=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("\\u001b[31mred\\u009b\\u202e\\u200b", done.stderr)
            for character in name:
                self.assertTrue(character.isprintable() or character not in done.stderr + done.stdout, (words, done.stderr))

    def test_files_that_nobody_named(self):
        study, folder = self.lhs(3), self.folder / "out"
        folder.mkdir()
        display = self.write(DISPLAY + "[errors]\ngap_mm = 0.05\n", "errors.toml")
        for names, plan in (
            (("report.html", "study.toml", "study.parquet", "plan.parquet"), lambda: api.plan(study, folder)),
            (("draws.csv", "tolerance.toml", "tolerance.html"), lambda: tolerance(display, folder, draws=3, measures=("check",))),
        ):
            for name in names:
                (folder / name).write_text("mine")
                with self.assertRaisesRegex(StudyError, f"{name}: exists and is no file of this study"):
                    plan()
                self.assertEqual((folder / name).read_text(), "mine")
                for made in folder.iterdir():
                    made.unlink()
        with self.assertRaises(StudyError):
            api.plan(self.write(LHS.replace("ROWS", "-1"), "bad.toml"), self.folder / "fresh")
        self.assertFalse((self.folder / "fresh").exists())

    def test_one_plan_at_a_time(self):
        held = os.open(self.folder, os.O_RDONLY)
        fcntl.flock(held, fcntl.LOCK_EX)
        with self.assertRaisesRegex(StudyError, "another run is writing"), files.held(self.folder, seconds=0.2):
            pass
        os.close(held)
        with files.held(self.folder), files.held(self.folder):
            pass

    def test_ctrl_c(self):
        self.lhs(3000)
        process = subprocess.Popen(
            [PROGRAM, "study", self.file, "-o", self.out],
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # background jobs of a shell's script ignore it
        )
        while not list(self.out.glob("rows/*.parquet")):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)
        errors = process.communicate()[1]
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("the same command continues", errors)

    def test_files_where_the_user_stands_are_no_modules(self):
        for name in ("random", "pandas", "lfdsim"):
            (self.folder / f"{name}.py").write_text("raise RuntimeError('a file of the user')")
        done = self.run_it("study", "study.toml", "-o", "out")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_package_that_is_missing(self):
        (self.folder / "pyarrow.py").write_text("raise ModuleNotFoundError(\"No module named 'pyarrow'\", name='pyarrow')")
        done = self.run_it("study", "study.toml", "-o", "out", PYTHONPATH=str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^lfdsim: error: studies need the Python package pyarrow, .* -m pip install 'lfdsim\[study\]'\n$")

    def test_no_python_package(self):
        if self.run_it("-c", "import lfdsim", program=(sys.executable,)).returncode == 0:
            self.skipTest("this Python has an lfdsim of its own")
        alone = self.folder / "lfdsim"
        shutil.copy(PROGRAM, alone)
        done = self.run_it("study", "study.toml", "-o", "out", program=(alone,))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^lfdsim: error: studies are run by lfdsim's Python package, .* no lfdsim; .*pip install .*\n$")


if __name__ == "__main__":
    unittest.main()
