"""The program with GPUs that are the stand-in's (stand_in.h): every state of driver and GPU in words, the CPU's bits, and calls of CUDA's
runtime that fail: --device auto then goes on by the CPU and says why, a GPU that is named gives an error.

Usage: stand_in.py LFDSIM_ON_STAND_IN
"""
import json
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import Checks, Program  # noqa: E402

os.environ.pop("LFDSIM_STAND_IN", None)
os.environ["LFDSIM_DEVICE"] = "cpu"
program, checks = Program(), Checks()
SHOWN = "render tiny.toml --panel-image panel.png --estimator point --progress none"  # what a GPU renders
MOVING = f"{SHOWN} --path path.json --frames-as npy --replace"
(program.folder / "path.json").write_text(json.dumps({"schema": 1, "frames_per_second": 4, "poses": [
    {"time_s": 0, "position_mm": [-30, 0, 400]}, {"time_s": 0.5, "position_mm": [40, 10, 400]}]}))


def there(stand_in):
    return {**os.environ, "LFDSIM_STAND_IN": stand_in}


def on(stand_in, arguments):
    return program.run(arguments, env=there(stand_in))


def content(name):
    """Of a file, or of all frames in a folder."""
    path = program.folder / name
    return {p.name: p.read_bytes() for p in path.glob("*.npy")} if path.is_dir() else path.read_bytes()


# States: what doctor says, what a named GPU gives, and auto, which takes the CPU.
program.must(f"{SHOWN} -o cpu.npy")
for stand_in, said in {
        "driver=0.0": "no NVIDIA driver was found",
        "driver=11.4": "the NVIDIA driver is too old: it supports CUDA 11.4",
        "gpus=0": "there is a driver, but no GPU that it shows",
        "capability=6.1": "compute capability 6.1; this lfdsim holds code for 7.5 and newer",
        "fail=cudaGetDeviceCount:1": "the NVIDIA driver answers: unspecified launch failure",
        "fail=cudaGetDeviceProperties:1": "it does not report its properties",
        "fail=cudaSetDevice:1": "it answers: unspecified launch failure"}.items():
    code, out, err = on(stand_in, "doctor --json")
    checks.that(code == 0 and said in json.loads(out)["gpu"]["used"], f"{stand_in}: doctor says {out} {err}")
    checks.refused(program, stand_in, f"{SHOWN} --device cuda -o no.npy", said, env=there(stand_in))
    code, out, err = on(stand_in, f"{SHOWN} --device auto --json -o auto.npy")
    checks.that(code == 0 and json.loads(out)["device"] == "cpu" and not err, f"{stand_in}: auto gives {out} {err}")

# Two GPUs: each gives the CPU's bits and says its name; the third is an error.
for device, name in {"auto": "cuda:0, stand-in 0", "cuda": "cuda:0, stand-in 0", "cuda:1": "cuda:1, stand-in 1"}.items():
    code, out, err = on("gpus=2", f"{SHOWN} --device {device} --json -o gpu.npy")
    result = json.loads(out)
    checks.that(code == 0 and result["device"].startswith(name) and result["gpu_seconds"] > 0 and not err, f"{device}: {out} {err}")
    checks.that(content("gpu.npy") == content("cpu.npy"), f"{device}: other bits than the CPU's")
checks.refused(program, "third GPU", f"{SHOWN} --device cuda:2 -o no.npy", "the last one is cuda:1", env=there("gpus=2"))

# What does not fit is told with both sizes.
sizes = r"cuda:0, stand-in 0: panel and picture need (\d+) MB, but only (\d+) MB are free"
code, out, err = on("memory_mb=50", f"{SHOWN} --size 3840x2160 --device cuda -o no.npy")
found = re.search(sizes + "; use --device cpu, another GPU, a smaller camera.resolution or --crop", err)
checks.that(code == 2 and found and int(found[2]) <= 50 < int(found[1]), f"too small: {code} {err}")
code, out, err = on("memory_mb=50", f"{SHOWN} --size 3840x2160 --device auto --json -o auto.npy")
checks.that(code == 0 and json.loads(out)["device"] == "cpu" and re.search(f"warning: {sizes}; the CPU continued", err), f"too small: {out} {err}")

# A field of view's photographs are compared where views are rendered; the GPU fails in the midst of it, or not.
FOV = "analyze fov tiny.toml --model pyramid.obj --progress none --set camera.resolution=[48,27] render.estimator='point'"


def measured(name):
    return [line for line in (program.folder / name / "fov.json").read_text().splitlines() if '"seconds"' not in line]


program.must(f"{FOV} -o fov_cpu")
for stand_in, warned in {"gpus=1": False, "fail=cudaLaunchKernel:200": True}.items():
    code, out, err = on(stand_in, f"{FOV} --device auto -o fov_gpu")
    checks.that(code == 0 and measured("fov_gpu") == measured("fov_cpu") and ("the CPU continued" in err) == warned, f"{stand_in}: fov {err}")

# Calls fail, of each function the first one, a later one, and so on until there are no more.
program.must(f"{MOVING} -o frames_cpu")
assert len(content("frames_cpu")) == 3
for function in ("cudaMallocAsync cudaMemcpyAsync cudaLaunchKernel cudaStreamSynchronize cudaStreamCreateWithFlags cudaEventCreate "
                 "cudaEventRecord cudaEventSynchronize cudaEventElapsedTime cudaMemGetInfo cudaMemPoolGetAttribute").split():
    call = 1
    while True:
        code, out, err = on(f"fail={function}:{call}", f"{MOVING} --device auto -o frames")
        checks.that(code == 0 and content("frames") == content("frames_cpu"), f"{function} fails at call {call}: {code} {out} {err}")
        if not err:
            break
        reason = "the GPU failed while"
        checks.that(re.fullmatch(f"lfdsim: warning: cuda:0, stand-in 0: {reason} .*; the CPU continued\n", err), f"{function}, {call}: {err}")
        code, out, err = on(f"fail={function}:{call}", f"{SHOWN} --device cuda -o one.npy")
        checks.that(code == 0 and not err or code == 1 and reason in err, f"{function}, {call}: {code} {err}")
        call = call * 2 + 1
    checks.that(call > 1, f"{function} is never called, or its failing is not noticed")
checks.finish()
