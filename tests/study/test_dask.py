"""Studies on a Dask cluster: what is killed in the middle changes nothing of the table."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

from common import StudyTest, call, skip_all

try:
    import distributed
except ImportError:
    skip_all("distributed is not installed; pip install distributed")

from lfdsim import study
from lfdsim.study import StudyError

ROWS = 48


class OnDask(StudyTest):
    def setUp(self):
        super().setUp()
        self.file, self.out = self.lhs(ROWS), self.folder / "out"
        study.run(self.file, self.folder / "here", workers=1, progress=False)
        self.expected = (self.folder / "here" / "study.parquet").read_bytes()

    def cluster(self, **more) -> "distributed.LocalCluster":
        cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs="CRITICAL", **more)
        self.addCleanup(cluster.close)
        return cluster

    def chunks(self) -> int:
        return len(list((self.out / "rows").glob("*.parquet")))

    def test_a_killed_worker(self):
        client = distributed.Client(self.cluster())
        self.addCleanup(client.close)
        killed = []

        def kill():
            while self.chunks() < 2:
                time.sleep(0.005)
            killed.append(list(pids.values())[0])
            os.kill(killed[0], signal.SIGKILL)

        pids = client.run(os.getpid)
        killer = threading.Thread(target=kill)
        killer.start()
        table = study.run(self.file, self.out, dask=client, progress=False)
        killer.join()
        self.assertEqual(len(table), ROWS)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        self.assertNotIn(killed[0], client.run(os.getpid).values())

    def test_a_killed_scheduler(self):
        """Scheduler and workers are processes of their own; both are started again, and so is the run."""
        address_file = self.folder / "scheduler.json"

        def start(*words) -> subprocess.Popen:
            process = subprocess.Popen(
                [sys.executable, "-m", "dask", *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
            self.addCleanup(process.wait)
            self.addCleanup(process.kill)
            return process

        def cluster() -> tuple[subprocess.Popen, str]:
            address_file.unlink(missing_ok=True)
            scheduler = start("scheduler", "--host", "127.0.0.1", "--port", 0, "--no-dashboard", "--scheduler-file", address_file)
            while not address_file.exists() or not address_file.read_text().strip().endswith("}"):
                time.sleep(0.05)
            start("worker", "--scheduler-file", address_file, "--nthreads", 1, "--no-nanny", "--no-dashboard", "--death-timeout", 5)
            return scheduler, json.loads(address_file.read_text())["address"]

        scheduler, address = cluster()
        words = [sys.executable, "-m", "lfdsim.study", "run", str(self.file), "-o", str(self.out), "--no-report", "--dask", address]
        run = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while self.chunks() < 2 and run.poll() is None:
            time.sleep(0.005)
        self.assertIsNone(run.poll())
        scheduler.kill()
        time.sleep(0.2)
        run.kill()
        run.communicate()
        before = {p.name: p.stat().st_ino for p in (self.out / "rows").glob("*.parquet")}
        done = call("run", self.file, "-o", self.out, "--no-report", "--dask", cluster()[1])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        self.assertEqual(before, {n: (self.out / "rows" / n).stat().st_ino for n in before})

    def test_a_cluster_that_is_not_there(self):
        with self.assertRaisesRegex(StudyError, "tcp://127.0.0.1:9.*no scheduler answers there.*dask scheduler"):
            study.run(self.file, self.out, dask="tcp://127.0.0.1:9", progress=False)
        with self.assertRaisesRegex(StudyError, "no scheduler answers there"):
            study.run(self.file, self.out, dask="nonsense", progress=False)

    def test_workers_that_do_not_see_the_folder_say_so(self):
        from lfdsim.study import cluster

        result = cluster._attempt(str(self.folder / "elsewhere"), "x", 0, 1)
        self.assertTrue(result["fatal"])
        self.assertIn("a worker does not see the study", result["problem"])


if __name__ == "__main__":
    unittest.main()
