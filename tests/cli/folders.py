"""No run writes into the folder of another, and no file is lost that nobody named: folders are locked, what an interrupted run made is gone
on with, other files are refused before any work unless --replace is given, and what killed runs were writing is cleaned up."""
import fcntl
import os
import shutil
import signal
import subprocess
import time

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
QUIET = "--progress none"
VIEWS = f"views tiny.toml --model pyramid.obj --grid 4x4 --view-size 48x32 {QUIET}"
EIA = f"eia tiny.toml --model pyramid.obj -o e.png {QUIET}"


def mine(name):
    path = folder / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("mine\n")
    return path


# Every writer of a folder: while somebody holds it, exit 2.
(folder / "way.json").write_text('{"schema": 1, "frames_per_second": 1, "poses": [{"time_s": 0, "position_mm": [0, 0, 400]}]}')
WRITERS = {
    "views": VIEWS + " -o held",
    "export": f"export pov tiny.toml --pattern white --set diffuser=none -o held {QUIET}",
    "analyze": f"analyze moire tiny.toml -o held {QUIET}",
    "path": f"render tiny.toml --panel-image panel.png --path way.json --size 16x12 -o held {QUIET}",
}
(folder / "held").mkdir()
held = os.open(folder / "held", os.O_RDONLY)
fcntl.flock(held, fcntl.LOCK_EX)
for name, command in WRITERS.items():
    checks.refused(program, f"{name} in a folder that is held", command, "held: another run is writing")
os.close(held)

# Files beside the one that was named.
for name in ("lens.json", "lens.svg"):
    other = mine(name)
    checks.refused(program, f"a foreign {name}", EIA + " --mapping lens.npy", f"{name}: exists", "--replace")
    checks.that(not (folder / "e.png").exists(), "work was done before the refusal")
    other.unlink()
for name in ("lens.json", "lens.svg"):
    mine(name)
program.must(EIA + " --mapping lens.npy --replace")
checks.that("mine" not in (folder / "lens.json").read_text() + (folder / "lens.svg").read_text(), "--replace did not write over them")
program.must(EIA + " --mapping lens.npy")  # its own of before: nothing is lost
program.must(["eia", "tiny.toml", "-o", "named.png", "--mapping", b"z\xff.npy"])  # a name that is not UTF-8
checks.refused(program, "the .json of another mapping", EIA + " --mapping lens.exr", "lens.json: exists")
checks.refused(program, "--replace without --mapping", EIA + " --replace", "--replace: applies to the files beside that of --mapping")

QUILT = f"views tiny.toml --model pyramid.obj --view-cone-deg 10 --view-size 32x20 -o q_qs5x1a1.6.png {QUIET}"
beside = mine("q_qs5x1a1.6.toml")
checks.refused(program, "a foreign .toml beside a quilt", QUILT, "q_qs5x1a1.6.toml: exists", "--replace")
program.must(QUILT + " --replace")
checks.that("camera_x_mm" in beside.read_text(), "--replace left the .toml")
program.must(QUILT)  # the same .toml again
checks.refused(program, "--resume of a quilt", QUILT + " --resume", "--resume: is for views in a folder")

MOIRE = f"analyze moire tiny.toml -o results {QUIET}"
for name in ("report.html", "moire.json", "moire_spectrum.csv"):
    other = mine(f"results/{name}")
    checks.refused(program, f"a foreign {name}", MOIRE, f"results/{name}: is not a result", "--replace")
    checks.that(other.read_text() == "mine\n", f"{name} was changed")
    shutil.rmtree(folder / "results")
mine("results/report.html"), mine("results/notes.csv")
program.must(MOIRE + " --replace")
checks.that("mine" not in (folder / "results/report.html").read_text() and (folder / "results/notes.csv").read_text() == "mine\n", "--replace")
program.must(MOIRE)
(folder / "two.toml").write_text((folder / "tiny.toml").read_text())
mine("both/report.html")
checks.refused(program, "a foreign report of several", f"analyze moire tiny.toml two.toml -o both {QUIET}", "both/report.html: is not a result")

EXPORT = f"export pov tiny.toml --pattern white --set diffuser=none -o scene {QUIET}"
mine("scene/README.txt")
checks.refused(program, "a foreign README.txt", EXPORT, "scene/README.txt: exists", "--replace")
program.must(EXPORT + " --replace")
program.must(EXPORT)
checks.refused(program, "another display's scene", EXPORT + " --set array.gap_mm=6", "display.toml: is of another display", "--replace")
program.must(EXPORT + " --set array.gap_mm=6 --replace")

(folder / "walk").mkdir()
mine("walk/0000.png")
checks.refused(program, "a foreign frame", WRITERS["path"].replace("held", "walk"), "walk: contains 1 picture", "0000.png", "--replace")

# Views that were interrupted. Their order is that of their numbers.
LONG = VIEWS.replace("48x32", "192x128") + " --samples 64 --threads 1"
process = program.start(LONG + " -o stopped")
deadline = time.monotonic() + 30
while not (folder / "stopped/view_0000.png").exists() and time.monotonic() < deadline:
    time.sleep(0.005)
process.send_signal(signal.SIGINT)
_, said = process.communicate(timeout=30)
before = program.files()
made = [name for name in before if str(name).startswith("stopped/")]
checks.that(process.returncode == 130 and 0 < len(made) < 16 and "--resume" in said, f"interrupted: {process.returncode}, {len(made)} views, {said}")
checks.refused(program, "interrupted views again", LONG + " -o stopped", "of 16 pictures that the same command makes", "--resume", "--replace")
checks.refused(program, "other views there", LONG + " -o stopped --yaw-deg 60 --resume", "made by another command", "--replace")
program.must(LONG + " -o stopped --resume")
after = program.files()
checks.that(all(after[name] == before[name] for name in made), "--resume made views again that were there")
checks.that(len(list((folder / "stopped").iterdir())) == 17, "--resume did not make the rest")
program.must(LONG + " -o whole")
for name in ("view_0000.png", "view_0015.png"):
    same = program.run(f"compare stopped/{name} whole/{name} --json")
    checks.that(same[0] == 0 and '"rmse": 0.0' in same[1], f"{name} differs after --resume: {same}")
checks.refused(program, "finished views again", LONG + " -o stopped", "contains 16 of 16 pictures")
program.must(VIEWS + " -o stopped --replace")
checks.that(len(list((folder / "stopped").iterdir())) == 17, "--replace left other files")
checks.refused(program, "views as .npy cannot be gone on with", VIEWS + " -o stopped --views-as npy --resume", "--resume: a .npy does not record")
mine("words/notes.txt")
checks.refused(program, "a folder with other files", VIEWS + " -o words", "words: contains other files")

# What was being written when a process was killed: gone when that process is, and it alone.
gone = subprocess.Popen(["true"])
gone.wait()
for place, command in (("e.png", EIA), ("stopped/view_0007.png", VIEWS + " -o stopped --replace"), ("results/moire.json", MOIRE)):
    dead, alive = folder / f"{place}.partial-{gone.pid}", folder / f"{place}.partial-{os.getpid()}"
    dead.write_text(""), alive.write_text("")
    program.must(command)
    checks.that(not dead.exists() and alive.exists(), f"{place}: dead {dead.exists()}, alive {alive.exists()}")
    alive.unlink()
    dead.write_text("")
    with open(dead) as other:  # as a process of another machine would hold it
        fcntl.flock(other, fcntl.LOCK_EX)
        program.must(command)
        checks.that(dead.exists(), f"{place}: a file that is held was removed")
    dead.unlink()
checks.finish()
