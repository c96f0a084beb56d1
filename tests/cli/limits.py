"""Limits of the system: a small stack, no threads, little memory. The program works within them, or says which one it met."""
import json
import os
import re
import resource
import subprocess

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
    return run.returncode, run.stderr


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

# As few threads as there may be: the calling one does the work, or the program says why it cannot. As nobody where root runs the test.
program.folder.chmod(0o777)
as_nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "test", "-x", program.path]
if os.getuid() != 0 or subprocess.run(as_nobody).returncode == 0:
    for most in [1, 2, 3, 4, 6]:
        for command in ["render tiny.toml -o out.png", "photo tiny.toml -o out.exr", "eia tiny.toml -o out.png",
                        "render tiny.toml -o out.png --panel-image panel.png"]:
            code, said = limited(command, (resource.RLIMIT_NPROC, most), nobody=True)
            checks.that(code == 0, f"{most} threads: {command}: {code} {said}")
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
code, said = limited("render tiny.toml -o out.png --pattern white --set array.count=[20000,20000] array.pitch_mm=0.01 errors.decenter_sd_mm=0.0001", (resource.RLIMIT_AS, 1 << 30))
checks.that(code == 2, f"errors of many lenses: {code} {said}")

# Libraries that cannot start say what there is, too.
for what in [resource.RLIMIT_AS, resource.RLIMIT_DATA]:
    for most in [100, 200]:
        code, said = limited("photo tiny.toml -o out.png", (what, most << 20))
        checks.that(code == 0 or re.search(r"(leaves|has) [\d.]+ .B free", said), f"limit {what}, {most} MiB, photo: {code} {said}")

checks.finish()
