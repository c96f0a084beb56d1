"""While work goes on: Ctrl-C ends it, other threads of Python run, progress is told."""

import contextlib
import io
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest
from unittest import mock

import lfdsim
from tiny import TINY, TinyTest

LONG = {"size": (3840, 2160), "samples": 1000, "estimator": "point", "device": "cpu"}  # minutes
# Of photograph and view, each a picture of its own: a fit has to search.
NOISE = """
NOISE = [numpy.random.default_rng(k).random((2160, 3840, 3), numpy.float32) for k in (1, 2)]
ALL = [(0, 0), (3840, 0), (3840, 2160), (0, 2160)]
"""


class Interrupts(TinyTest):
    def test_ctrl_c_ends_the_work(self) -> None:
        for work in (
            "lfdsim.render(d, **LONG)",
            "lfdsim.photograph(d.with_({'camera.pixel_filter': 'box'}), size=(8000, 8000), samples=1000)",
            "lfdsim.analyze(d, 'dof', size=(3840, 2160), samples=1000, estimator='point')",
            "lfdsim.compare_photograph(*NOISE, ALL, ALL, fit_corners=True, fit_blur=True)",
        ):
            with self.subTest(work):
                begin = f"import lfdsim, numpy\nLONG = {LONG!r}\nd = lfdsim.Display.parse({TINY!r})\n"
                begin += NOISE if "NOISE" in work else ""
                begin += "print('begins', flush=True)\n"
                script = f"{begin}{work}\nprint('ended')\n"
                child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.assertEqual(child.stdout.readline(), "begins\n")
                time.sleep(0.7)
                self.assertIsNone(child.poll(), "the work is to be long")
                child.send_signal(signal.SIGINT)
                start = time.monotonic()
                out, err = child.communicate(timeout=60)
                self.assertIn("KeyboardInterrupt", err)
                self.assertEqual(out, "")
                self.assertLess(time.monotonic() - start, 30)  # the work takes minutes

    def test_ctrl_c_while_a_model_is_read(self) -> None:
        """Its reader, here one that never ends, is in the terminal's group and gets the signal, too."""
        reader = pathlib.Path("reader.sh")
        reader.write_text("#!/bin/sh\nexec sleep 50\n")
        reader.chmod(0o755)
        script = f"import lfdsim\nlfdsim.photograph(lfdsim.Display.parse({TINY!r}), model='pyramid.obj')"
        for to_group in (False, True):
            child = subprocess.Popen(
                [sys.executable, "-c", script],
                stderr=subprocess.PIPE,
                text=True,
                env={**os.environ, "LFDSIM_MODEL_READER": str(reader.absolute())},
                start_new_session=True,
            )
            time.sleep(1.5)
            self.assertIsNone(child.poll(), "reading is to be long")
            os.killpg(child.pid, signal.SIGINT) if to_group else child.send_signal(signal.SIGINT)
            start = time.monotonic()
            self.assertIn("KeyboardInterrupt", child.communicate(timeout=60)[1])
            self.assertLess(time.monotonic() - start, 30)  # the work takes minutes

    def test_after_it_all_works_again(self) -> None:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            lfdsim.render(self.display, **LONG)
        self.assertEqual(lfdsim.render(self.display).shape, (54, 96, 3))

    def test_an_exception_of_progress_ends_the_work(self) -> None:
        def full(*_: object) -> None:
            raise ZeroDivisionError("enough")

        start = time.monotonic()
        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            lfdsim.render(self.display, progress=full, **LONG)
        self.assertLess(time.monotonic() - start, 30)  # the work takes minutes


class Threads(TinyTest):
    def test_python_runs_while_it_renders(self) -> None:
        """Another thread counts; with Python's lock held it would stand still."""
        counted, stop = [0], threading.Event()

        def count() -> None:
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        try:
            before, start = counted[0], time.monotonic()
            lfdsim.render(self.display, size=(1280, 720), samples=100, estimator="point", threads=1, device="cpu")
            seconds = time.monotonic() - start
            self.assertGreater(counted[0] - before, 100 * seconds)
        finally:
            stop.set()
            counter.join()

    def test_calls_from_several_threads(self) -> None:
        expected = lfdsim.render(self.display).tobytes()
        made: list[bytes] = []
        threads = [threading.Thread(target=lambda: made.append(lfdsim.render(self.display).tobytes())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(made, [expected] * 4)


class Progress(TinyTest):
    def render(self, progress: object) -> None:
        lfdsim.render(self.display, size=(1280, 720), samples=100, estimator="point", threads=1, device="cpu", progress=progress)

    def test_a_function_is_told(self) -> None:
        seen: list[tuple[str, int, int]] = []
        self.render(lambda *report: seen.append(report))
        shares = [done / units for stage, done, units in seen if stage == "rendering"]
        self.assertGreater(len(shares), 2)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0 <= share <= 1 for share in shares))

    def test_a_bar_on_a_terminal_only(self) -> None:
        class Terminal(io.StringIO):
            def isatty(self) -> bool:
                return True

        for stream, progress, shows in [
            (Terminal(), None, True),
            (io.StringIO(), None, False),
            (Terminal(), False, False),
            (io.StringIO(), True, True),
        ]:
            with contextlib.redirect_stderr(stream):
                self.render(progress)
            self.assertEqual("rendering" in stream.getvalue(), shows)
            self.assertTrue(not shows or stream.getvalue().endswith("\r\x1b[K"))

    def test_a_bar_in_a_notebook(self) -> None:
        shown: list[str] = []
        handle = mock.Mock()
        handle.update = lambda html: shown.append(html)
        ipython, display = mock.MagicMock(), mock.MagicMock()
        display.HTML = str
        display.display = lambda html, display_id: shown.append(html) or handle
        with mock.patch.dict(sys.modules, {"IPython": ipython, "IPython.display": display}):
            self.render(None)
        self.assertIn("<progress", shown[0])
        self.assertEqual(shown[-1], "")


if __name__ == "__main__":
    unittest.main()
