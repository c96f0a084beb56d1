"""A panel of 16K under 100 000 lenses: elemental images made, written and rendered at 8K, by file and at one go, within 6 GB each.

Prints seconds and peak memory of each run. Usage: wall.py LFDSIM [MODEL]
"""
import json
import os
import pathlib
import shutil
import sys
import time

import numpy as np

from program import Checks, Program, skip

MOST_BYTES = 6e9
if os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") < 8e9:
    skip("this machine has less than 8 GB of memory")

program, checks = Program(), Checks()
if shutil.disk_usage(program.folder).free < 2e9:
    skip("there are less than 2 GB of room for temporary files")
shutil.copy(pathlib.Path(__file__).parent / "wall.toml", program.folder)
model = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else "pyramid.obj"


def measured(arguments, *stages):
    """Runs the program, which must show the stages; the bytes it read."""
    begun = time.monotonic()
    process = program.start(f"{arguments} --progress json")
    shown = {json.loads(line)["stage"] for line in process.stderr if line.startswith("{")}
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    read = int(pathlib.Path(f"/proc/{process.pid}/io").read_text().split()[1])
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    print(f"{time.monotonic() - begun:6.1f} s, {usage.ru_utime + usage.ru_stime:6.1f} s of processors, "
          f"{usage.ru_maxrss * 1024 / 1e9:5.2f} GB: {arguments}", flush=True)
    checks.that(process.returncode == 0, f"{arguments}: exit code {process.returncode}")
    checks.that(usage.ru_maxrss * 1024 <= MOST_BYTES, f"{arguments}: took {usage.ru_maxrss * 1024 / 1e9:.2f} GB")
    checks.that(shown == set(stages), f"{arguments}: showed {shown}, wanted {stages}")
    return read


measured(f"eia wall.toml --model {model} -o eia.png", "elemental images", "writing")
read = measured("render wall.toml --panel-image eia.png --samples 4 -o file.npy", "reading", "rendering", "writing")
size = (program.folder / "eia.png").stat().st_size
checks.that(size <= read < 1.5 * size + 1e6, f"{read} bytes read, the panel image has {size}: it is to be read once")
measured(f"render wall.toml --model {model} --samples 4 -o model.npy", "elemental images", "rendering", "writing")
by_file, at_once = (np.load(program.folder / f"{name}.npy", mmap_mode="r") for name in ["file", "model"])
checks.that(by_file.shape == (4320, 7680, 3) and np.array_equal(by_file, at_once), "by file and at one go are two pictures")
checks.that(by_file[1500:2800, 3000:4600].mean() > 0.01, "the model cannot be seen")
checks.finish()
