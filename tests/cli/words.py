"""What a person reads: nothing of a file or of the command line is obeyed by a terminal, no message is endless, small files take little time
and memory, and what is refused is refused for the reason that there is."""
import json
import os
import re
import resource
import struct
import subprocess
import sys

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
HOSTILE = "\x1b[31mRED\x07\x9b31m\u202e\u2066\u200b\ufeff\u061c\U000e0041"  # colour, bell, C1, directions, no width, tag
UNSEEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\U000e0000-\U000e0fff]")


def harmless(name, *texts):
    for text in texts:
        found = UNSEEN.search(text)
        checks.that(not found, f"{name}: {text[max(0, found.start() - 40) : found.end()]!r}" if found else name)


def escaped(text):
    return "".join(f"\\u{ord(c):04X}" if ord(c) < 0x10000 else f"\\U{ord(c):08X}" for c in text)


tiny = (folder / "tiny.toml").read_text()
(folder / "hostile.toml").write_text(re.sub(r'(?m)^name *= *".*"$', "", tiny).replace("schema = 1", f'schema = 1\nname = "{escaped(HOSTILE)}"'))
for command in ("check hostile.toml", "check hostile.toml --json", "check hostile.toml --set array.pitch_mm=nan",
                "analyze moire hostile.toml -o results --progress none", "analyze moire hostile.toml -o results --progress none --json"):
    code, out, err = program.run(command)
    harmless(command, out, err)
checks.that(json.dumps(HOSTILE) in json.dumps(json.loads(program.must("check hostile.toml --json"))), "JSON is another document")
harmless("report.html", (folder / "results/report.html").read_text())
for path in (folder / "results").glob("*.json"):
    harmless(path.name, path.read_text())
code, out, _ = program.run(["check", "tiny.toml", "--set", "name=mine\nforged"])
checks.that(code == 0 and "mine\\u000aforged" in out, f"a name of two lines: {code} {out[:200]!r}")
for name in (HOSTILE + ".toml", HOSTILE + "\nlfdsim: error: forged.toml"):
    for command in (["check", name], ["check", "tiny.toml", "--set", f"name={name}", "--set", f"array.gap_mm={name}"],
                    ["check", "tiny.toml", "--" + name], ["eia", "tiny.toml", "--model", name, "-o", "a.png"],
                    ["compare", name, name], ["eia", "tiny.toml", "--pattern", "white", "-o", name + ".png", "--progress", "none"]):
        code, out, err = program.run(command)
        harmless(f"{command}", out, err)
        checks.that(all(line.startswith("lfdsim: ") for line in err.splitlines()), f"{command}: {err!r}")
# Bytes that are not UTF-8.
done = subprocess.run([program.path, "check", b"\xff\xc3\x28\xed\xa0\x80.toml"], cwd=folder, capture_output=True)
checks.that(done.returncode == 2 and rb"\xff\xc3(\xed\xa0\x80.toml" in done.stderr, f"{done}")
program.must(["analyze", "moire", "tiny.toml", "--set", f"name={HOSTILE}'", "-o", "quoted", "--progress", "none"])
harmless("the command in a report", (folder / "quoted/report.html").read_text())

# Long quotes.
long = "A" * 20000
(folder / "long.ase").write_text(f"*3DSMAX_ASCIIEXPORT\t200\n*GEOMOBJECT {{\n*MESH {{\n*MESH_NUMVERTEX 1\n*MESH_VERTEX_LIST {{\n*MESH_VERTEX x{long}\n")
(folder / "long.json").write_text('{"schema": 1, "' + long + '": 1}')
(folder / "long.toml").write_text(tiny.replace("gap_mm", long))
for command in ("eia tiny.toml --model long.ase -o a.png", f"check tiny.toml --set array.gap_mm={long}", f"check tiny.toml --{long}", f"check {long}",
                "check long.toml", f"render tiny.toml --pattern {long} -o a.png", f"render tiny.toml --panel-image panel.png --path long.json -o w",
                f"analyze {long} tiny.toml -o w", f"eia tiny.toml --model {long}.obj -o a.png", f"glass {long}", f"analyze fov tiny.toml --angles-deg {long} -o w"):
    code, out, err = program.run(command)
    longest = max(map(len, err.splitlines()), default=0)
    checks.that(code == 2 and 0 < longest < 1000, f"{command[:60]}: exit code {code}, a line of {longest} bytes")

# Pictures that claim more than they have; none makes a library take memory for it.
def attribute(name, kind, content, size=None):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(content) if size is None else size) + content


def exr(*attributes, version=2):
    return struct.pack("<ii", 20000630, version) + b"".join(attributes) + b"\0"


def window(columns, rows):
    return struct.pack("<4i", 0, 0, columns - 1, rows - 1)


def header(columns, rows, compression=3, more=b"", version=2, channels=(b"R", b"G", b"B")):
    of = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in channels) + b"\0"
    return exr(attribute(b"channels", b"chlist", of), attribute(b"compression", b"compression", bytes([compression])),
               attribute(b"dataWindow", b"box2i", window(columns, rows)), attribute(b"displayWindow", b"box2i", window(columns, rows)),
               attribute(b"lineOrder", b"lineOrder", b"\0"), attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
               attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)), attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)),
               more, version=version)


FILES = {
    "string.exr": exr(attribute(b"x", b"string", b"abc", 0x7FFFFFF0)),
    "opaque.exr": exr(attribute(b"x", b"mine", b"abc", 0x7FFFFFF0)),
    "negative.exr": exr(attribute(b"x", b"string", b"abc", -5)),
    "second.exr": exr(attribute(b"x", b"string", b"abc"), version=0x1002) + attribute(b"y", b"string", b"", 0x7FFFFFF0),
    "manifest.exr": exr(attribute(b"x", b"idmanifest", struct.pack("<i", 0x7FFFFFF0) + b"abcd")),
    "preview.exr": exr(attribute(b"preview", b"preview", struct.pack("<II", 30000, 30000))),
    "tall.exr": header(1, 2**31 - 2),
    "wide.exr": header(2**31 - 2, 1, 9),
    "rows.exr": header(16, 2**24) + bytes(2000),
    "columns.exr": header(2**22, 16, 9) + bytes(30000),
    "tiles.exr": header(30000, 3000, 3, attribute(b"tiles", b"tiledesc", struct.pack("<IIB", 1, 1, 0)), 0x202) + bytes(600000),
    "size.jpg": bytes.fromhex("ffd8ffc2001108fffffffF03011100021100031100ffd9"),
    "size.png": b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBBI", 13, b"IHDR", 2**31 - 1, 2**31 - 1, 16, 2, 0, 0, 0, 0),
    "size.pfm": b"PF\n999999999 999999999\n-1.0\n",
    "size.npy": b"\x93NUMPY\x01\0" + struct.pack("<H", 80) + b"{'descr': '<f4', 'fortran_order': False, 'shape': (99999999, 9, 3), }".ljust(79) + b"\n",
}
for name, content in FILES.items():
    (folder / name).write_bytes(content)
    for command in (f"compare panel.png {name}", f"eia tiny.toml --model {name} -o a.png" if name == "size.png" else f"render tiny.toml --panel-image {name} -o a.png"):
        process = subprocess.Popen([program.path, *command.split()], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        err = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        checks.that(code == 2 and "memory" not in err and used.ru_maxrss < 150_000, f"{command}: exit code {code}, {used.ru_maxrss} KB, {err}")

# Where memory is short a picture is bad input, too.
def little():
    resource.setrlimit(resource.RLIMIT_AS, (900 << 20,) * 2)


if b"__asan_init" not in open(program.path, "rb").read():
    (folder / "large.pfm").write_bytes(b"Pf\n9000 9000\n-1.0\n")
    os.truncate(folder / "large.pfm", len(b"Pf\n9000 9000\n-1.0\n") + 4 * 81_000_000)
    code, _, err = program.run("compare large.pfm large.pfm", preexec_fn=little)
    checks.that(code == 2 and "large.pfm: is too large" in err and "memory" in err, f"little memory: {code} {err}")

# A small file that keeps a loader busy.
(folder / "slow.ply").write_text("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\npr")
code, _, err = program.run("eia tiny.toml --model slow.ply -o a.png")
checks.that(code == 2 and "60 s" not in err and "slow.ply: cannot be read as a model" in err, f"slow.ply: {code} {err}")

# The time that reading may take depends on the size of what is read. The reader waits with more in its hands than a pipe holds.
def seconds_for(path):
    reader = subprocess.Popen([os.path.join(os.path.dirname(program.path), "lfdsim-model-reader"), "picture", path, str(1 << 32), "60", ""],
                              cwd=folder, stdout=subprocess.PIPE)
    reader.stdout.read(1)
    with open(f"/proc/{reader.pid}/limits") as limits:
        soft = next(line.split()[3] for line in limits if line.startswith("Max cpu time"))
    reader.kill()
    reader.communicate()
    return int(soft)


program.must("eia tiny.toml --pattern checkerboard -o small.png --set panel.pixels=[240,135] --set panel.pixel_pitch_mm=0.2 --progress none")
(folder / "heavy.png").write_bytes((folder / "small.png").read_bytes() + bytes(1_000_000))
small, heavy = seconds_for("small.png"), seconds_for("heavy.png")
checks.that(small <= 30 < 60 and small + 10 <= heavy <= 60, f"reading may take {small} s of a small file, {heavy} s of one of a megabyte")

# A picture whose decoder has no words for what is wrong, and a file that may not be read.
(folder / "flag.png").write_bytes(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBBI", 13, b"IHDR", 96, 60, 8, 2, 0, 0, 0, 0) + b"\xff\xff\xff\xffIDATx")
(folder / "flag.toml").write_text(tiny + '\n[[content.object]]\nimage = "flag.png"\nheight_mm = 3.0\n')
code, _, err = program.run("eia flag.toml -o a.png")
checks.that(code == 2 and "basic_string" not in err and "std::" not in err and "flag.png" in err, f"flag.png: {code} {err}")

denied = folder / "denied"
denied.mkdir()
for name in ("tiny.toml", "pyramid.obj", "panel.png", "lens.zmx", "walk.json"):
    (denied / name).write_bytes((folder / name).read_bytes() if (folder / name).exists() else b"x")


def nobody():
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)


folder.chmod(0o777)
for closed in (denied, *denied.iterdir()):
    mode = closed.stat().st_mode
    closed.chmod(0)
    names = [p for p in ("tiny.toml", "pyramid.obj", "panel.png", "lens.zmx", "walk.json") if closed in (denied, denied / p)]
    for name in names:
        path = f"denied/{name}"
        command = {"tiny.toml": f"check {path}", "pyramid.obj": f"eia tiny.toml --model {path} -o a2.png", "panel.png": f"compare {path} panel.png",
                   "lens.zmx": f"import {path} -o b.toml", "walk.json": f"render tiny.toml --panel-image panel.png --path {path} -o w2"}[name]
        code, _, err = program.run(command, preexec_fn=nobody)
        checks.that(code == 2 and re.search("[Pp]ermission", err) and "no such" not in err, f"{command}: {code} {err}")
    closed.chmod(mode)
checks.finish()
