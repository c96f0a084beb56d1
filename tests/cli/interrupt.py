"""Ctrl-C, SIGTERM, SIGHUP: the first ends the work and keeps what is complete, marked; a second ends the program at once."""
import json
import signal
import subprocess
import time

import numpy as np

from program import Checks, Program

program, checks = Program(), Checks()
program.must("eia tiny.toml --pattern white -o white.png")
# The slowest kernel: a tile takes a moment, the picture minutes.
LONG = "render tiny.toml --panel-image white.png --kernel scalar --size 1280x720 --estimator point --progress json"


def begun(process):
    """Waits until part of the picture is done."""
    for line in process.stderr:
        if json.loads(line)["done"] > 0:
            return


def hangup(action):
    """For a child, as nohup (SIG_IGN) or a terminal (SIG_DFL) would start it."""
    return {"preexec_fn": lambda: signal.signal(signal.SIGHUP, action)}


for kind, number in [("npy", signal.SIGINT), ("png", signal.SIGHUP), ("exr", signal.SIGTERM)]:
    process = program.start(f"{LONG} --samples 300 -o out.{kind}", **hangup(signal.SIG_DFL))
    begun(process)
    process.send_signal(number)
    out, err = process.communicate(timeout=120)
    checks.that(process.returncode == 130, f"{kind}: exit code {process.returncode}, wanted 130: {err}")
    checks.that(out == "", f"{kind}: printed {out!r}")
    marked = "cannot say that it is incomplete" if kind == "npy" else "marked incomplete"  # a .npy holds numbers alone
    checks.that(marked in err and f"out.{kind}" in err, f"{kind}: said {err!r}")
    checks.that((program.folder / f"out.{kind}").exists(), f"{kind}: no picture was kept")
    if kind == "npy":
        picture = np.load(program.folder / "out.npy")
        checks.that(picture.shape == (720, 1280, 3), f"the kept picture is {picture.shape}")
        checks.that((picture > 0).any() and (picture == 0).all(axis=2).any(), "the kept picture is not partly done")
    else:
        checks.that(b"incomplete" in (program.folder / f"out.{kind}").read_bytes(), f"{kind}: the picture is not marked")

# A picture that was there is kept as it was.
whole = (program.folder / "white.png").read_bytes()
(program.folder / "seen.png").write_bytes(whole)
process = program.start(f"{LONG} --samples 300 -o seen.png")
begun(process)
process.send_signal(signal.SIGINT)
out, err = process.communicate(timeout=120)
checks.that(process.returncode == 130 and "seen.incomplete.png contains the completed part" in err, f"over a picture: {process.returncode} {err}")
checks.that((program.folder / "seen.png").read_bytes() == whole, "an interrupted run replaced a picture")
checks.that(b"incomplete" in (program.folder / "seen.incomplete.png").read_bytes(), "over a picture: what was made is not kept")

# Used as a panel image, the kept picture says so; a complete one does not.
shown = ["render", "tiny.toml", "--set", "panel.pixels=[1280, 720]", "--samples", "1", "-o", "view.png", "--json", "--progress", "none"]
program.must(["eia", "tiny.toml", "--set", "panel.pixels=[1280, 720]", "--pattern", "white", "-o", "whole.png"])
for name, incomplete in [("out.png", True), ("out.exr", True), ("whole.png", False)]:
    code, out, err = program.run([*shown, "--panel-image", name])
    checks.that(code == 0 and json.loads(out)["panel_image"] == {"incomplete": incomplete}, f"{name} as panel image: {out} {err}")
    checks.that((f"{name}: is marked incomplete" in err) == incomplete, f"{name} as panel image: said {err!r}")

process = program.start(f"{LONG} --samples 4 -o nohup.png", **hangup(signal.SIG_IGN))
begun(process)
process.send_signal(signal.SIGHUP)
process.communicate(timeout=120)
checks.that(process.returncode == 0, f"SIGHUP under nohup: exit code {process.returncode}, wanted 0")

# The most samples: a single pixel takes many seconds.
for k, command in enumerate(["render tiny.toml --panel-image white.png --estimator point", "photo tiny.toml --set camera.pupil_diameter_mm=4"]):
    process = program.start(f"{command} --size 640x360 --samples 16777216 -o most{k}.png --progress none")
    time.sleep(1)
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    try:
        out, err = process.communicate(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
    checks.that(process.returncode == 130 and f"most{k}.png" in err and "marked incomplete" in err,
                f"{command}: exit code {process.returncode} after {time.monotonic() - sent:.1f} s: {err}")

# A command that keeps nothing says that it was interrupted, too.
program.must("eia tiny.toml --pattern white --set panel.pixels=[4000,2000] -o wide.png")
process = program.start("sheet" + 40 * " wide.png" + " -o sheet.png")
time.sleep(0.5)
process.send_signal(signal.SIGINT)
out, err = process.communicate(timeout=60)
checks.that(process.returncode == 130 and "interrupted" in err, f"sheet: exit code {process.returncode}, said {err!r}")

before = program.files()
process = program.start(f"{LONG} --samples 10000000 -o never.png")
time.sleep(1)
sent = time.monotonic()
process.send_signal(signal.SIGINT)
process.send_signal(signal.SIGTERM)
process.communicate(timeout=60)
checks.that(process.returncode == 130, f"two signals: exit code {process.returncode}, wanted 130")
checks.that(time.monotonic() - sent < 10, f"two signals: it ended after {time.monotonic() - sent:.1f} s")
checks.that(program.files() == before, f"two signals: left {set(program.files()) - set(before)}")
checks.finish()
