"""Camera paths: frames are what `render` gives, bit for bit; what is finished stays; bad paths are refused at their place."""
import json
import pathlib
import signal

import numpy as np
from PIL import Image

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
SHOWN = "render tiny.toml --panel-image panel.png --progress none"


def write(path, name="path.json"):
    (folder / name).write_text(path if isinstance(path, str) else json.dumps(path))


def pose(time_s, position_mm=(0, 0, 400), **more):
    return {"time_s": time_s, "position_mm": list(position_mm), **more}


def path(*poses, frames_per_second=4, schema=1, **more):
    return {"schema": schema, "frames_per_second": frames_per_second, "poses": list(poses), **more}


def times(name):
    return {p.name: p.stat().st_mtime_ns for p in (folder / name).iterdir()}


# Frames at 0, 1/4, 1/2, 3/4 and 1 s; the second target is the description's.
A, B, C = [-60.0, 0.0, 400.0], [50.0, 30.0, 390.0], [50.0, -10.0, 420.0]
write(path(pose(0, A, target_mm=[10, 0, 0]), pose(0.6, B), pose(1.1, C, target_mm=[0, 8, 0])))
expected = []
for k in range(5):
    t = k / 4
    (t0, p0, q0), (t1, p1, q1) = ((0, A, [10, 0, 0]), (0.6, B, [0, 0, 0])) if t < 0.6 else ((0.6, B, [0, 0, 0]), (1.1, C, [0, 8, 0]))
    share = (t - t0) / (t1 - t0)
    expected.append([[a + (b - a) * share for a, b in zip(*ends)] for ends in ((p0, p1), (q0, q1))])
for how in ["", "--estimator point --samples 5", "--crop 10,5,60,50"]:
    program.must(f"{SHOWN} {how} --path path.json -o walk --frames-as npy --replace")
    checks.that(sorted(times("walk")) == [f"000{k}.npy" for k in range(5)], f"{how}: made {sorted(times('walk'))}")
    for k, (position, target) in enumerate(expected):
        views = [",".join(map(repr, v)) for v in (position, target)]
        program.must(f"{SHOWN} {how} --camera-mm={views[0]} --target-mm={views[1]} -o one.npy")
        same = (folder / "one.npy").read_bytes() == (folder / f"walk/000{k}.npy").read_bytes()
        checks.that(same, f"{how}: frame {k} is not what render gives")
frames = [np.load(folder / f"walk/000{k}.npy") for k in range(5)]
checks.that(all((a != b).any() for a, b in zip(frames, frames[1:])), "frames differ from one to the next")

# The example of the documents; one pose is a path of one frame; EXR carries the error.
(folder / "example.json").write_text((pathlib.Path(__file__).parents[2] / "docs/path.json").read_text())
made = json.loads(program.must("render tiny.toml --pattern white --size 32x18 --path example.json -o example --json --progress none"))
checks.that((made["frames"], made["rendered"], len(times("example"))) == (16, 16, 16), f"example: {made}")
# The frame with the largest measured error tells how all were made, as `render` does of one picture.
write(path(pose(0), pose(0.5, [200, 0, 400])), "aside.json")
wide = "render tiny.toml --pattern white --size 32x18 --json --progress none --set diffuser.angle_deg=[20,20]"
made = json.loads(program.must(f"{wide} --path aside.json -o aside"))
alone = [json.loads(program.must(f"{wide} camera.position_mm={at} -o aside.png")) for at in ("[0,0,400]", "[100,0,400]", "[200,0,400]")]
worst = max(range(3), key=lambda k: alone[k]["measured_error"])
checks.that((made["frame"], made["measured_error"], made["points_share"]) == (worst, alone[worst]["measured_error"], alone[worst]["points_share"]),
            f"the worst frame of a path: {made}, {alone}")
write(path(pose(0)), "still.json")
program.must(f"{SHOWN} --path still.json -o still --frames-as exr --target-error 0.01")
checks.that(list(times("still")) == ["0000.exr"] and b"error.R" in (folder / "still/0000.exr").read_bytes(), "a still's error layer")

# --resume makes what is missing or was made of something else.
GO_ON = f"{SHOWN} --path path.json -o again --resume"
program.must(f"{SHOWN} --path path.json -o again")
first = times("again")
checks.refused(program, "the same command again", f"{SHOWN} --path path.json -o again", "again: contains 5 of 5 pictures", "--resume", "--replace")
(folder / "again/0002.png").unlink()
(folder / "again/0003.png").write_text("no picture")
program.must(GO_ON)
then = times("again")
checks.that({k for k in then if then[k] != first.get(k)} == {"0002.png", "0003.png"}, "resume: made other frames than those missing")
write(path(pose(0, A, target_mm=[10, 0, 0]), pose(0.6, B), pose(1.1, A, target_mm=[0, 8, 0])))
checks.refused(program, "another path", GO_ON, "again: contains 2 pictures", "0003.png", "--replace")
program.must(GO_ON + " --replace")
last = times("again")
checks.that({k for k in last if last[k] != then[k]} == {"0003.png", "0004.png"}, "resume: a pose changed, and with it two frames")
program.must("eia tiny.toml --pattern white -o panel.png")
checks.refused(program, "another panel image", GO_ON, "again: contains 5 pictures")
program.must(GO_ON + " --replace")
checks.that(all(last[k] != changed for k, changed in times("again").items()), "resume: kept frames of another panel image")
done = times("again")
checks.that("5 of them made before" in program.must(GO_ON) and times("again") == done, "resume: nothing was left to do")

# What a model's file names, and a table of lenses, count as much.
TABLE = "i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature\n0,0,{},0,0,0,0,0\n"
(folder / "red.mtl").write_text("newmtl m\nKd 0.8 0.1 0.1\n")
(folder / "named.obj").write_text("mtllib red.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
(folder / "lenses.csv").write_text(TABLE.format(0.01))
NAMED = "render tiny.toml --model named.obj --set errors.table=lenses.csv --path path.json -o named --progress none --resume"
program.must(NAMED)
done = times("named")
checks.that("5 of them made before" in program.must(NAMED) and times("named") == done, "resume: made frames of a model again")
for file, text in (("red.mtl", "newmtl m\nKd 0.1 0.1 0.8\n"), ("lenses.csv", TABLE.format(0.03))):
    (folder / file).write_text(text)
    checks.refused(program, f"another {file}", NAMED, "named: contains 5 pictures", "from other files")
    program.must(NAMED + " --replace")

# Frames of a longer path, or those of another display, do not stay beside; pictures that are no frames are never removed.
write(path(pose(0, A)), "short.json")
checks.refused(program, "a shorter path", f"{SHOWN} --path short.json -o again", "again: contains 5 pictures")
checks.refused(program, "another display", f"{SHOWN} --path path.json -o again --set array.gap_mm=5.1", "again: contains 5 pictures")
program.must(f"{SHOWN} --path short.json -o again --replace")
checks.that(list(times("again")) == ["0000.png"], f"replaced: {times('again')}")
Image.new("RGB", (8, 6)).save(folder / "again/0007.png")
checks.refused(program, "somebody's picture", f"{SHOWN} --path short.json -o again --replace", "0007.png: is a picture not made by lfdsim")

# Ctrl-C keeps finished frames, whole; the same command goes on.
write(path(pose(0, A), pose(25, B)), "long.json")
LONG = "render tiny.toml --pattern white --kernel scalar --size 320x180 --samples 64 --path long.json -o long --progress json"
process = program.start(LONG)
for line in process.stderr:
    if json.loads(line)["done"] > 3 * 320 * 180:
        break
process.send_signal(signal.SIGINT)
out, err = process.communicate(timeout=60)
kept = times("long")
checks.that(process.returncode == 130 and not out and f"{len(kept)} of 101 frames" in err, f"interrupted: {process.returncode} {err!r}")
checks.that(3 <= len(kept) < 101 and sorted(kept)[-1] == f"{len(kept) - 1:04}.png", f"interrupted: kept {sorted(kept)}")
checks.that(not any(b"incomplete" in (folder / "long" / name).read_bytes() for name in kept), "interrupted: a frame is incomplete")

BAD = [  # what, path, words of the message
    ("empty", "", "bad.json: is not a camera path in JSON"),
    ("cut off", '{"schema": 1,', "line 1"),
    ("binary", "\x00\x01", "is not a camera path in JSON"),
    ("beyond doubles", json.dumps(path(pose(0))).replace("400", "1e999"), "number overflow"),
    ("not finite", path(pose(0, [0, 0, float("nan")])), "is not a camera path in JSON"),
    ("too large", " " * (1 << 20) + json.dumps(path(pose(0))), "allowed are 1048576; is this a camera path?"),
    ("deep", "[" * 500000, "is not a camera path in JSON"),
    ("a list", [], "give an object with schema, frames_per_second, poses"),
    ("nothing", {}, "bad.json: the file: poses is missing"),
    ("another schema", path(pose(0), schema=2), "bad.json: schema: only 1"),
    ("unknown key", path(pose(0), pose_s=[]), 'unknown key "pose_s"; did you mean poses?'),
    ("no frames in a second", path(pose(0), frames_per_second=0), "bad.json: frames_per_second: is 0"),
    ("too many frames in a second", path(pose(0), frames_per_second=1001), "up to 1000"),
    ("text for a number", path(pose(0), frames_per_second="30"), "frames_per_second: is a text; give a number"),
    ("a key twice", json.dumps(path(pose(0))).replace('"poses"', '"frames_per_second": 8, "poses"'), "bad.json: frames_per_second: is given twice"),
    ("a pose's key twice", json.dumps(path(pose(0))).replace('"time_s"', '"time_s": 0, "time_s"'), "bad.json: poses[0].time_s: is given twice"),
    ("no poses", path(), "bad.json: poses: give a list"),
    ("poses of something else", path(7), "bad.json: poses[0]: is a number"),
    ("no position", path({"time_s": 0}), "bad.json: poses[0]: position_mm is missing"),
    ("two coordinates", path(pose(0), pose(1, [0, 400])), "bad.json: poses[1].position_mm: give three numbers"),
    ("text for a coordinate", path(pose(0, [0, "0", 400])), "bad.json: poses[0].position_mm[1]: is a text"),
    ("unknown key of a pose", path(pose(0, taget_mm=[0, 0, 0])), "poses[0]: unknown key \"taget_mm\"; did you mean target_mm?"),
    ("late start", path(pose(1)), "bad.json: poses[0].time_s: is 1; the first pose is at 0"),
    ("time stands", path(pose(0), pose(1), pose(1)), "bad.json: poses[2].time_s: is 1, not later"),
    ("time runs back", path(pose(0), pose(-1)), "bad.json: poses[1].time_s: is -1"),
    ("too many frames", path(pose(0), pose(25000)), "more than the 100000 frames"),
    ("endless", path(pose(0), pose(1e308)), "more than the 100000 frames"),
    ("behind the panel", path(pose(0), pose(1, [0, 0, -5])), "bad.json: poses[1]: camera.position_mm"),
    ("at its target", path(pose(0, target_mm=[0, 0, 400])), "bad.json: poses[0]: camera.target_mm"),
    ("along its up", path(pose(0), pose(1, [0, 400, 80], target_mm=[0, 600, 80])), "bad.json: poses[1]: camera.up"),
    ("through its target", path(pose(0, [-50, 0, 400], target_mm=[0, 0, 400]), pose(1, [50, 0, 400], target_mm=[0, 0, 400])),
     "bad.json: frame 2 at 0.5 s: camera.target_mm"),
]
for name, bad, words in BAD:
    write(bad, "bad.json")
    checks.refused(program, name, f"{SHOWN} --path bad.json -o none", words)
CASES = [  # name, arguments, words of the message
    ("no such path", f"{SHOWN} --path none.json -o none", "none.json: there is no such file"),
    ("path without name", [*SHOWN.split(), "--path", "", "-o", "none"], "--path: is empty"),
    ("folder without name", [*SHOWN.split(), "--path", "path.json", "-o", ""], "--output: is empty"),
    ("folder that is a file", f"{SHOWN} --path path.json -o panel.png", "panel.png: is not a folder"),
    ("folder that cannot be made", f"{SHOWN} --path path.json -o /proc/none", "/proc/none"),
    ("two cameras", f"{SHOWN} --path path.json --camera-mm 0,0,400 -o none", "give one of them"),
    ("frames without a path", f"{SHOWN} --frames-as exr -o none.png", "--frames-as: is only for frames of a --path"),
    ("resume without a path", f"{SHOWN} --resume -o none.png", "--resume: is only for frames of a --path"),
    ("frames of another kind", f"{SHOWN} --path path.json --frames-as gif -o none", "png, exr"),
    ("bits of an EXR", f"{SHOWN} --path path.json --frames-as exr --bits 16 -o none", "--bits: is only for .png"),
    ("resume of npy", f"{SHOWN} --path path.json --frames-as npy --resume -o none", "--resume: a .npy does not record"),
]
for name, arguments, words in CASES:
    checks.refused(program, name, arguments, words)
checks.finish()
