"""Studies through Slurm, of one node on this machine: as an array job of which a task is killed, and on workers that dask-jobqueue submits.

Needs Debian's packages slurm-wlm and munge, and root; skipped elsewhere.
"""

import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time
import unittest

from common import StudyTest, call, skip_all

from lfdsim import study

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "study"
PROGRAMS = ("/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd")
ROWS = 300

CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldPort={port}
SlurmdPort={next_port}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 Sockets=1 CoresPerSocket=2 ThreadsPerCore=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def tell(*words: object) -> str:
    return subprocess.run([*map(str, words)], check=True, capture_output=True, text=True).stdout


def wait(until, seconds: float = 90) -> None:
    end = time.monotonic() + seconds
    while not until():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.02)


if not all(map(os.path.exists, PROGRAMS)) or not shutil.which("sbatch"):
    skip_all("Slurm is not installed; apt-get install slurm-wlm munge")
if os.geteuid() != 0:
    skip_all("only root can start Slurm's services")


class OnSlurm(StudyTest):
    def setUp(self):
        super().setUp()
        self.file, self.out = self.lhs(ROWS), self.folder / "out"
        study.run(self.file, self.folder / "here", workers=1, progress=False)
        self.expected = (self.folder / "here" / "study.parquet").read_bytes()
        os.chmod(self.folder, 0o755)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(folder=self.folder, host=socket.gethostname().partition(".")[0], port=port, next_port=port + 1)
        )
        os.environ |= {"SLURM_CONF": str(self.folder / "slurm.conf"), "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
        self.addCleanup(self.stop)
        self.start()
        wait(lambda: "idle" in tell("sinfo", "-h"))

    def start(self):
        key = self.folder / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        tell(
            PROGRAMS[0],
            "--force",
            f"--key-file={key}",
            f"--socket={self.folder}/munge.sock",
            f"--pid-file={self.folder}/munged.pid",
            f"--log-file={self.folder}/munged.log",
            f"--seed-file={self.folder}/munged.seed",
        )
        for program in PROGRAMS[1:]:
            tell(program)

    def stop(self):
        for name in ("slurmd", "slurmctld", "munged"):
            path = self.folder / f"{name}.pid"
            if path.exists():
                pid = int(path.read_text())
                os.kill(pid, 15)
                wait(lambda: not os.path.exists(f"/proc/{pid}"))

    def submit(self, tasks: str, *words: str) -> str:
        """The example's script, with this Python in place of the system's."""
        script = (EXAMPLES / "array.sh").read_text()
        self.assertIn("exec python3 ", script)
        path = self.folder / "array.sh"
        path.write_text(script.replace("exec python3 ", f"exec {sys.executable} "))
        return tell("sbatch", "--parsable", f"--array={tasks}", f"--output={self.folder}/%A_%a.log", path, self.out, *words).strip()

    def ended(self) -> bool:
        return not tell("squeue", "-h")

    def test_array_jobs_of_which_one_is_killed(self):
        self.assertEqual(call("plan", self.file, "-o", self.out).returncode, 0)
        job = self.submit("0-3")
        wait(lambda: len(list((self.out / "rows").glob("*.parquet"))) >= 1)
        running = tell("squeue", "-h", "-r", "-t", "running", "-o", "%i").split()
        self.assertTrue(running)
        tell("scancel", "--full", "--signal=KILL", running[0])
        wait(self.ended)
        early = call("collect", self.out)
        self.assertIn("is not finished", early.stderr, f"{job}: the killed task had nothing left to do")
        before = {p.name: p.stat().st_ino for p in (self.out / "rows").glob("*.parquet")}
        self.submit(running[0].rpartition("_")[2], "4")  # that task alone
        wait(self.ended)
        done = call("collect", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())
        self.assertEqual(before, {n: (self.out / "rows" / n).stat().st_ino for n in before})

    def test_workers_that_dask_jobqueue_submits(self):
        try:
            import dask_jobqueue
            import distributed
        except ImportError:
            self.skipTest("dask-jobqueue is not installed")
        with dask_jobqueue.SLURMCluster(
            cores=1,
            processes=1,
            memory="2GB",
            interface="lo",
            python=sys.executable,
            walltime="00:10:00",
            job_directives_skip=["--mem"],
            log_directory=str(self.folder),
            local_directory=str(self.folder),
            scheduler_options={"dashboard_address": None},
        ) as cluster:
            cluster.scale(jobs=2)
            with distributed.Client(cluster) as client:
                study.run(self.file, self.out, dask=client, progress=False)
        self.assertEqual(self.expected, (self.out / "study.parquet").read_bytes())


if __name__ == "__main__":
    unittest.main()
