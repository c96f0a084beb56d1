#!/usr/bin/python3
"""Fails when the AVX2 kernel takes over 10 % more instructions for a sample than baselines.txt says.

Times on a shared machine say little; the number of instructions says the same on all. callgrind counts those of two renders of the
same picture that differ only in their samples a pixel; the difference, over the difference in samples, is what one more sample
takes: rays, surfaces, sampling and the light of the panel's pixel. Start, files and what is done once a pixel cancel. valgrind 3.19
knows no AVX-512, so the AVX2 kernel stands for all: it is the same source. What this cannot see: waiting, for divisions or memory.

Usage: guard.py PROGRAM [--renew] [--only CASE] [--set KEY=VALUE ...]
--renew measures and writes the baseline of the compiler that built PROGRAM. --set changes every case, to see the guard fail.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BASELINES = HERE / "baselines.txt"
ALLOWED = 1.10
# A panel of fewer, larger pixels: its light is read sooner, and rays take the same ways. The whole frame, borders included.
CASES = {name: ["render", ROOT / file, "--set", "panel.pixels=[384, 216]", f"panel.pixel_pitch_mm={pitch}"]
         for name, file, pitch in [("plain", "bench/yardstick.toml", 1), ("asphere", "displays/desktop-asphere.toml", 1.3636),
                                   ("ideal", "displays/desktop-ideal.toml", 1.3636), ("plate", "displays/desktop-plate.toml", 1.3636),
                                   ("clear", "displays/desktop-clear.toml", 1.3636)]}
SIZE, FEW, MANY = "96x54", 16, 48  # samples a pixel: few enough for seconds, multiples of what kernels do at once


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


def render(case, samples, folder):
    """(instructions, samples) of one render."""
    counts = folder / f"{case}-{samples}.callgrind"
    made = run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", options.program, *CASES[case],
                *options.set, "--pattern", "address", "--size", SIZE, "--estimator", "point", "--samples", samples, "--kernel", "avx2", "--threads", 1,
                "--progress", "none", "--json", "-o", folder / f"{case}-{samples}.npy"])
    return int(re.search(r"^summary: (\d+)", counts.read_text(), re.M)[1]), json.loads(made)["samples"]


def measure(names):
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor() as pool:
        jobs = {case: [pool.submit(render, case, samples, pathlib.Path(name)) for samples in (FEW, MANY)] for case in names}
        (few, many) = ({case: jobs[case][i].result() for case in names} for i in (0, 1))
    return {case: (many[case][0] - few[case][0]) / (many[case][1] - few[case][1]) for case in names}


def read_baselines():
    """{compiler: {case: instructions a sample}}"""
    all_of_them = {}
    for line in BASELINES.read_text().splitlines():
        if line and not line.startswith("#"):
            compiler, case, count = re.fullmatch(r"(\S+ \S+) +(\S+) +([0-9.]+)", line).groups()
            all_of_them.setdefault(compiler, {})[case] = float(count)
    return all_of_them


def write_baselines(baselines):
    head = [line for line in BASELINES.read_text().splitlines() if line.startswith("#")]
    lines = [f"{compiler:<16} {case:<10} {count:.2f}" for compiler in sorted(baselines) for case, count in baselines[compiler].items()]
    BASELINES.write_text("\n".join(head + lines) + "\n")


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("program")
parser.add_argument("--renew", action="store_true")
parser.add_argument("--only", choices=CASES)
parser.add_argument("--set", nargs="+", default=[])
options = parser.parse_args()
if options.renew and (options.only or options.set):
    parser.error("--renew takes all cases as they are")
names = [options.only] if options.only else list(CASES)
if not shutil.which("valgrind"):
    skip("valgrind is not installed")
found = json.loads(run([options.program, "doctor", "--json"]))
if not any(kernel.startswith("avx2 ") for kernel in found["kernels"]):
    skip("this processor has no AVX2")
compiler = found["build"].split(",")[0]
baselines = read_baselines()
renewal = f"tests/instructions/guard.py {options.program} --renew"
if compiler not in baselines and not options.renew:
    skip(f"no baseline for {compiler} in {BASELINES.relative_to(ROOT)}; to make one: {renewal}")

measured = measure(names)
if options.renew:
    baselines[compiler] = measured
    write_baselines(baselines)
failed = False
for case, count in measured.items():
    wanted = baselines[compiler].get(case)
    if wanted is None:
        print(f"{case}: {count:.2f} instructions a sample, and no baseline for {compiler}; to make one: {renewal}")
        failed = True
        continue
    change = f"{case}: {count:.2f} instructions a sample, {count / wanted:.3f} of the baseline's {wanted:.2f} ({compiler})"
    if count > wanted * ALLOWED:
        print(f"{change}: more than 10 % over; where that is meant, renew the baseline: {renewal}")
        failed = True
    elif count < wanted / ALLOWED:
        print(f"{change}; to guard what was gained, renew the baseline: {renewal}")
    else:
        print(change)
sys.exit(1 if failed else 0)
