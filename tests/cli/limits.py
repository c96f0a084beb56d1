"""Limits of the system: a small stack, no threads, little memory. The program works within them, or says which one it met."""
import json
import os
import re
import resource
import struct
import subprocess
import zlib

from program import Checks, Program

program, checks = Program(), Checks()
kernels = [k.split()[0] for k in json.loads(program.must("doctor --json"))["kernels"]]


def limited(arguments, *limits, nobody=False, seconds=30):
    """The program under limits (what, soft and hard): its exit code, None where it had to be killed, and what it said."""

    def within():
        for what, most in limits:
            resource.setrlimit(what, (most, most))
        if nobody and os.getuid() == 0:  # root is not limited
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

    try:
        run = subprocess.run([program.path, *arguments.split()], cwd=program.folder, preexec_fn=within, timeout=seconds,
                             stdin=subprocess.DEVNULL, capture_output=True, text=True, env={**os.environ, "LFDSIM_DEVICE": "cpu"})
    except subprocess.TimeoutExpired:
        return None, "it hung"
    return run.returncode, run.stdout + run.stderr


# Every kernel and estimator, lenses in rows, as strips and each by itself, few samples and many, on a stack of 1 MiB.
plain = "--camera-mm 60,-30,390"
strips = f'{plain} --set array.lattice=strips array.count=[11,1] array.aperture=cell array.slant_deg=10 panel.subpixels=rgb_stripe'
errors = f"{plain} --set errors.decenter_sd_mm=0.02 errors.tilt_sd_deg=0.5"
turned = f"{plain} --set array.rotation_deg=7 camera.pixel_filter=box camera.pupil_diameter_mm=4"
for kernel in kernels:
    for what in [plain, f"{plain} --samples 3600 --crop 40,20,56,28", strips, errors, turned, f"{plain} --estimator point",
                 f"{plain} --target-error 0.05 --set render.samples=none"]:
        code, said = limited(f"render tiny.toml -o out.npy --panel-image panel.png --kernel {kernel} {what}", (resource.RLIMIT_STACK, 1 << 20))
        checks.that(code == 0, f"a stack of 1 MiB: {kernel} {what}: {code} {said}")

# With less the program works on a stack of its own: lines of sight, spots, pictures, models that a process of their own reads.
(program.folder / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
for command in ["analyze fov tiny.toml -o fov --size 40x24 --angles-deg -10,10,5", "analyze spot tiny.toml -o spot", "check tiny.toml",
                "render tiny.toml -o out.png --model triangle.obj"]:
    code, said = limited(command, (resource.RLIMIT_STACK, 64 << 10))
    checks.that(code == 0, f"a stack of 64 KiB: {command}: {code} {said}")

# As few threads as there may be: the calling one does the work, or the program says why it cannot. As nobody where root runs the test.
program.folder.chmod(0o777)
as_nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "test", "-x", program.path]
if os.getuid() != 0 or subprocess.run(as_nobody).returncode == 0:
    for most in [1, 2, 3, 4, 6]:
        for command in ["render tiny.toml -o out.png", "photo tiny.toml -o out.exr", "eia tiny.toml -o out.png",
                        "render tiny.toml -o out.png --panel-image panel.png"]:
            code, said = limited(command, (resource.RLIMIT_NPROC, most), nobody=True)
            checks.that(code == 0, f"{most} threads: {command}: {code} {said}")
    code, said = limited("render tiny.toml -o out.png", (resource.RLIMIT_NPROC, 1), nobody=True)
    checks.that(", 1 thread;" in said, f"no thread besides the calling one: {said}")
    code, said = limited("check tiny.toml", (resource.RLIMIT_NPROC, 1), (resource.RLIMIT_STACK, 128 << 10), nobody=True)
    checks.that(code == 1 and "ulimit -s" in said, f"a small stack, and no thread: {code} {said}")
    code, said = limited("view tiny.toml", (resource.RLIMIT_NPROC, 1), nobody=True)
    checks.that(code == 1 and "ulimit -u" in said, f"the viewer without a thread: {code} {said}")
else:
    print("SKIPPED: threads, as nobody cannot run the program where it lies")

# Memory: what is needed and what is free are told before the work begins.
needs = re.compile(r"needs [\d.]+ GB of memory; .*(ulimit -[vd]|group).* [\d.]+ (MB|GB) free")
large = '--set panel.pixels=[12000,8000] panel.pixel_pitch_mm=0.001 array.count=none --pattern white'
for what in [resource.RLIMIT_AS, resource.RLIMIT_DATA]:
    for command in ["render", "eia"]:
        code, said = limited(f"{command} tiny.toml {large} -o out.png", (what, 1 << 30))
        checks.that(code == 2 and needs.search(said), f"limit {what}, {command}: {code} {said}")
for measure, makes_a_panel in [("spot", False), ("zone", False), ("mtf", True)]:  # a measure asks for what it needs itself
    code, said = limited(f"analyze {measure} tiny.toml --size 40x24 --set panel.pixels=[12000,8000] panel.pixel_pitch_mm=0.001 array.count=none -o of_{measure}",
                         (resource.RLIMIT_AS, 1 << 30))
    checks.that(code == 2 and needs.search(said) if makes_a_panel else code == 0, f"little memory, analyze {measure}: {code} {said}")
code, said = limited("render tiny.toml -o out.png --pattern white --set array.count=[20000,20000] array.pitch_mm=0.01 errors.decenter_sd_mm=0.0001", (resource.RLIMIT_AS, 1 << 30))
checks.that(code == 2, f"errors of many lenses: {code} {said}")

# Libraries that cannot start say what there is, too.
for what in [resource.RLIMIT_AS, resource.RLIMIT_DATA]:
    for most in [100, 200]:
        code, said = limited("photo tiny.toml -o out.png", (what, most << 20))
        checks.that(code == 0 or re.search(r"(leaves|has) [\d.]+ .B free", said), f"limit {what}, {most} MiB, photo: {code} {said}")

# A texture that memory does not hold is no damaged one: 16000 x 16000 texels of one bit.
def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


(program.folder / "large.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 16000, 16000, 1, 0, 0, 0, 0)) +
                                           chunk(b"IDAT", zlib.compress(bytes(16000 * 2001), 1)) + chunk(b"IEND", b""))
(program.folder / "large.mtl").write_text("newmtl a\nmap_Kd large.png\n")
(program.folder / "large.obj").write_text("mtllib large.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
code, said = limited("photo tiny.toml --model large.obj -o out.png", (resource.RLIMIT_AS, 1 << 30))
checks.that(code == 0 and "shown grey: it takes more memory than there is" in said, f"a large texture: {code} {said}")

checks.finish()
