#!/usr/bin/python3
"""bench/peers/run where one renderer crashes: the others go on, and the tables say so: failing.py LFDSIM.

Two programs stand in for renderers. povray draws the scene's display by lfdsim itself; blender ends by a signal, as a renderer does that does not know the
processor.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM, RUN = os.path.abspath(sys.argv[1]), pathlib.Path(__file__).resolve().parent.parent.parent / "bench/peers/run"

POVRAY = f"""#!/usr/bin/python3
import subprocess, sys
import numpy as np
given = {{word[:2]: word[2:] for word in sys.argv[1:]}}
if "--version" in sys.argv:
    sys.exit("POV-Ray 0.0.stand-in")
subprocess.run([{PROGRAM!r}, "render", "display.toml", "--panel-image", "panel.png", "--size", given["+W"] + "x" + given["+H"], "--estimator", "point",
                "--progress", "none", "-o", "view.npy"], check=True, stdout=subprocess.DEVNULL)
light = np.rint(65535 * np.clip(np.load("view.npy"), 0, 1)).astype(">u2")
with open(given["+O"], "wb") as file:
    file.write(b"P6 %d %d 65535\\n" % (light.shape[1], light.shape[0]) + light.tobytes())
"""
BLENDER = """#!/bin/sh
[ "$1" = --version ] && echo "Blender 0.0 stand-in" && exit
kill -SEGV $$
"""


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        for program, text in (("povray", POVRAY), ("blender", BLENDER)):
            (folder / "bin" / program).write_text(text)
            (folder / "bin" / program).chmod(0o755)
        # A Mitsuba that may be there is none of this test: no LLVM, no picture.
        environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "DRJIT_LIBLLVM_PATH": "/none"}
        done = subprocess.run([RUN, "--smallest", "--no-install", "--program", PROGRAM, "--out", folder / "out"], env=environment, capture_output=True, text=True)
        assert done.returncode == 1, f"exit code {done.returncode}: {done.stdout}{done.stderr}"
        results, tables = json.loads((folder / "out/results.json").read_text()), (folder / "out/tables.md").read_text()
    assert results["failed"] == {"cycles": "ended by SIGSEGV"}, results["failed"]
    assert [fault for fault in results["faults"] if "Cycles" in fault] == results["faults"], results["faults"]
    assert tables.count("| Cycles | failed: ended by SIGSEGV |") == 2 + 1, tables  # of meshes; with a diffuser and without
    assert all(row["agree"] == 1 for row in results["agreement"]["rows"]) and len(results["agreement"]["rows"]) == 3, results["agreement"]
    assert [row["program"] for row in results["speed"]["cases"]["without"]["peers"]] == ["POV-Ray"], results["speed"]["cases"]["without"]["peers"]
    assert "| lfdsim, filtered |" in tables and "| POV-Ray, true surfaces |" in tables, tables
    print("one renderer crashed, the others went on")


main()
