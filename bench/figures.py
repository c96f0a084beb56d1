#!/usr/bin/python3
"""The figures of docs/performance.md, measured now on this machine and printed as its tables.

Usage: bench/figures.py [--program build/release/lfdsim] [--runs 5] [--quick] [--check] [--write]
--quick: small pictures, one run, no big panel. --check: exit code 1 where a figure misses its loose bound (a third of the goal).
--write: puts them in place of the section "Measured" of docs/performance.md.
Each comparison alternates between both sides, so that whatever else the machine does meets both alike; medians are printed.
"""
import argparse
import glob
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MONKEY = "/usr/share/assimp/models/BLEND/Suzanne_248.blend"
TRUCK = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf"
PAPER = 829.44  # million samples of 3840 x 2160 x 100, which took the 2019 paper's GPU one second
failures, lines = [], []


def lfdsim(*words):
    """Runs the program; its JSON, with the seconds of the whole process added."""
    start = time.monotonic()
    done = subprocess.run([options.program, *map(str, words), "--json", "--progress", "none"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return dict(json.loads(done.stdout), process_seconds=time.monotonic() - start)


def render_rate(display, panel, *words):
    size = ["--size", "1920x1080"] if options.quick else []
    return lfdsim("render", display, "--panel-image", panel, "--estimator", "point", *size, *words, "-o", os.path.join(folder, "out.npy"))["msamples_per_s"]


def say(line):
    lines.append(line)
    print(line, flush=True)


def figure(name, value, goal=None, unit="", loose=None):
    say(f"| {name} | {value:.4g}{unit} | {goal or ''} |")
    if loose is not None and not loose(value):
        failures.append(f"{name}: {value:.4g}{unit}")


def panel_of(display, name, *words):
    path = os.path.join(folder, name + ".png")
    lfdsim("eia", display, "--pattern", "address", "-o", path, *words)
    return path


def against_yardstick(panel):
    """The renderer and the flat kernel in turn, on all threads and on one."""
    if not shutil.which("clang++-14"):
        say("| the flat kernel | SKIPPED: no clang++-14 to build it with | |")
        return
    yardstick = os.path.join(folder, "yardstick")
    subprocess.run(["clang++-14", "-std=c++20", "-O3", "-march=native", "-ffast-math", os.path.join(ROOT, "bench/yardstick.cpp"),
                    "-o", yardstick, "-pthread"], check=True)
    size = ["1920", "1080"] if options.quick else ["3840", "2160"]
    for threads in sorted({os.cpu_count(), 1}, reverse=True):
        ours, theirs = [], []
        for _ in range(options.runs):
            theirs.append(json.loads(subprocess.check_output([yardstick, "100", str(threads), *size]))["msamples_per_s"])
            ours.append(render_rate(DISPLAY, panel, "--threads", threads))
        us, them = statistics.median(ours), statistics.median(theirs)
        figure(f"plano-convex, opaque, Schlick, box diffuser, {threads} threads, million samples/s", us)
        figure("the flat kernel of bench/yardstick.cpp", them)
        figure("ratio", us / them, "0.9", loose=lambda x: x > 0.3)
        if threads > 1:
            figure("share of the 2019 paper's GPU (829 million samples/s)", us / PAPER, "1")


def duties(panel):
    """The cost of each option: its rate divided by that of the plain case."""
    asphere = os.path.join(ROOT, "displays/desktop-asphere.toml")
    cases = {
        "plain": [], "no Fresnel weights": ["render.fresnel=none"], "exact Fresnel weights": ["render.fresnel=exact"],
        "independent random samples": ["render.sampling=random"], "box pixel filter": ["camera.pixel_filter=box"],
        "pupil of 4 mm": ["camera.pupil_diameter_mm=4"], "gaussian diffuser": ["diffuser.profile=gaussian"],
        "filled cells": ["array.aperture=cell"], "aperture stop": ["lens.stop_radius_mm=2"],
        "array turned by 1 degree": ["array.rotation_deg=1"], "clear surround": ["array.surround=clear"],
        "plate surround": ["array.surround=plate"],
        "hexagonal array": ["array.lattice=hexagon", "array.count=[43,27]"], "strips": ["array.lattice=strips", "array.count=[43,1]"], "desktop-asphere, Schlick": ["render.fresnel=schlick"],
    }
    crop = ["--crop", "0,500,1920,580"] if options.quick else ["--crop", "0,972,3840,1188"]
    rates = {name: [] for name in cases}
    for _ in range(options.runs):
        for name, changes in cases.items():
            display = asphere if "asphere" in name else DISPLAY
            rates[name].append(render_rate(display, panel, *crop, *(["--set", *changes] if changes else [])))
    plain = statistics.median(rates["plain"])
    for name, values in rates.items():
        loose = (lambda x: x > 0.4 / 3) if "asphere" in name else None
        figure(name + ", of the plain case", statistics.median(values) / plain, "0.4" if "asphere" in name else None, loose=loose)


def content():
    display = os.path.join(ROOT, "displays/desktop-asphere.toml")
    for name, command in (("elemental images", "eia"), ("reference photograph", "photo")):
        rates = [lfdsim(command, display, "--model", MONKEY, "-o", os.path.join(folder, "content.png"))["mrays_per_s"]
                 for _ in range(options.runs)]
        figure(f"monkey, {name}, million rays/s", statistics.median(rates), "10, aim 30", loose=lambda x: x > 10 / 3)
    share = os.path.join(os.path.dirname(os.path.abspath(options.program)), "lfdsim-embree-share")
    if not os.path.exists(share):
        say("| share of Embree | SKIPPED: lfdsim-embree-share is not built; configure with LFDSIM_BENCHMARKS=ON | |")
        return
    for name, model in (("monkey", MONKEY),) if options.quick else (("monkey", MONKEY), ("truck", TRUCK)):
        made = json.loads(subprocess.check_output([share, display, model, str(options.runs)]))
        for picture in ("elemental images", "reference photograph"):
            figures = made[picture.replace(" ", "_")]
            figure(f"{name}, {picture}, 1 thread, million rays/s", figures["mrays_per_s"])
            loose = (lambda x: x > 1 / 3) if (name, picture) == ("monkey", "elemental images") else None
            figure(f"{name}, {picture}: share of Embree in the time", figures["share_of_embree"], "1", loose=loose)
        figure(f"{name}, elemental images at 31 depths, s", made["31_depths_s"])
        figure(f"{name}, elemental images at 31 depths, over 31 times those at one", made["over_31_times_one"])


def memory_and_start(panel):
    seconds = [lfdsim("render", DISPLAY, "--panel-image", panel, "--estimator", "point", "--crop", "0,0,16,16", "-o", os.path.join(folder, "out.npy"))
               ["process_seconds"] for _ in range(options.runs)]
    figure("start to the first samples written, 4K panel image, s", statistics.median(seconds), "0.5", loose=lambda x: x < 1.5)
    code = ("import resource,subprocess,sys; subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL);"
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000)")
    samples = "1" if options.quick else "100"
    out = subprocess.check_output([sys.executable, "-c", code, options.program, "render", DISPLAY, "--panel-image", panel, "--estimator", "point", "--samples",
                                   samples, "--progress", "none", "--json", "-o", os.path.join(folder, "out.png")], text=True)
    figure("memory of a 3840 x 2160 render to PNG, MB", float(out), "600", loose=lambda x: x < 600)


def flatness(panel):
    """Rate over lens count (one panel, lenses scaled with the pitch) and over panel size (constant pitches; constant size)."""
    base = None
    for n, m in ((14, 8), (138, 78), (1382, 778)):
        k = 384 / n / 8.8  # scale of the lens, its gap and its diffuser
        changes = [f"array.count=[{n},{m}]", f"array.pitch_mm={8.8 * k}", f"lens.sphere_radius_mm={9 * k}",
                   f"lens.aperture_radius_mm={4.4 * k}", f"lens.cylinder_height_mm={k}", f"array.base_z_mm={12 * k}",
                   f"diffuser.distance_mm={45.85129 * k}"]
        rate = statistics.median(render_rate(DISPLAY, panel, "--set", *changes) for _ in range(min(3, options.runs)))
        base = base or rate
        figure(f"{n * m} lenses on one panel: time per sample over that of the first", base / rate, "1.3")
    base = None
    sizes = [(1920, 1080), (3840, 2160), (15360, 8640)] + ([] if options.quick else [(30720, 17280)])
    for columns, rows in sizes:
        changes = [f"panel.pixels=[{columns},{rows}]", f"array.count=[{columns // 88},{rows // 88}]", "camera.frame_width_mm=none"]
        words = ["--set", *changes]
        big = panel_of(DISPLAY, "big", *words)
        rate = statistics.median(render_rate(DISPLAY, big, *words) for _ in range(min(3, options.runs)))
        base = base or rate
        figure(f"panel of {columns} x {rows}, constant pitch: time per sample over that of the first", base / rate, "1.3")
    changes = ["panel.pixels=[15360,8640]", "panel.pixel_pitch_mm=0.025"]
    fine = render_rate(DISPLAY, panel_of(DISPLAY, "fine", "--set", *changes), "--set", *changes)
    figure("panel of 15360 x 8640, constant size: time per sample over that of 3840 x 2160", render_rate(DISPLAY, panel) / fine)


def bench(*words):
    """The results of `lfdsim bench` by group."""
    made = lfdsim("bench", *words, "--runs", options.runs, *(["--quick"] if options.quick else []))
    return {group: rows for group, rows in made.items() if isinstance(rows, list)}


def parts_of_the_program():
    """The 2019 paper's case from start to file; lenses, kernels, threads; finished pictures."""
    groups = bench("paper", "lenses", "kernels", "threads", "pictures")
    paper = {row["name"]: row for row in groups["paper"]}
    whole = "3840 x 2160 x " + ("10" if options.quick else "100")
    figure(f"{whole}, start of the program to the PNG written, s", paper["start to picture"]["seconds"]["median"],
           None if options.quick else "1, the 2019 paper's")
    figure(f"{whole}, of this tracing, s", paper["of this, tracing"]["seconds"]["median"])
    for group in ("lenses", "kernels", "threads"):
        for row in groups[group]:
            figure(f"{row['name']}, million samples/s", row["msamples_per_s"])
    for row in groups["pictures"]:
        figure(f"{row['name']}, 3840 x 2160, s", row["seconds"]["median"])
        figure(f"{row['name']}, million pixels/s", row["mpixels_per_s"])


def estimators():
    """Time to an error, on all shipped displays. In clear and plate a reference takes long: small crops there."""
    if options.quick:
        return tell_estimators(bench("estimators"))
    files = sorted(glob.glob(os.path.join(ROOT, "displays/*.toml")))
    slow = [file for file in files if file.endswith(("-clear.toml", "-plate.toml"))]
    some = [os.path.join(ROOT, f"displays/desktop-{name}.toml") for name in ("asphere", "ideal")]
    tell_estimators(bench("estimators", "--display", *sorted(set(files) - set(slow))))
    tell_estimators(bench("estimators", "--crop", "1824,1026,2016,1134", "--display", *slow))
    tell_estimators(bench("estimators", "--model", TRUCK, "--display", *some), {"checkerboard"})


def tell_estimators(found, known=()):
    for row in found["estimators"]:
        if "not_measured" in row:
            say(f"| {row['name']} | SKIPPED: {row['not_measured']} | |")
            continue
        if row["content"] in known:
            continue
        where = f"{row['display']}, {row['content']}"
        points = {(point["estimator"], point["samples"]): point for point in row["points"]}
        figure(f"{where}: RMSE of 100 random points", points["point, random", 100]["rmse"])
        for samples in (1, 4):
            figure(f"{where}: RMSE of {samples} filtered", points["filtered", samples]["rmse"])
        for name, ratio in row["time_to_papers_error_over_papers"].items():
            if name == "point, random":
                continue
            if ratio is None:
                say(f"| {where}: {name} does not reach the RMSE of the 100 | | |")
            else:
                figure(f"{where}: time to that RMSE by \"{name}\", over that of the 100", ratio, "0.05" if name == "filtered" else "")
        finest = points["filtered", max(point["samples"] for point in row["points"] if point["estimator"] == "filtered")]
        figure(f"{where}: RMSE of {finest['samples']} filtered", finest["rmse"], "0.00195")
        figure(f"{where}: their brightness error, %", 100 * abs(finest["brightness_error"]), "0.1", loose=lambda x: x < 0.3)


def machine():
    """The conditions of the measurement."""
    found = lfdsim("bench", "pictures", "--quick")
    build = found["build"]
    return (f"{found['machine']['processor']}, {found['machine']['processors']} processors, {found['machine']['memory_gb']:.0f} GB of memory; "
            f"lfdsim {found['version']}, {build['compiler']}, {build['type']}; kernel {found['kernel']}, "
            f"`{build['kernel_flags']}`; {time.strftime('%-d %B %Y')}. Medians of {options.runs} (panel and lens counts: of "
            f"{min(3, options.runs)}).")


def write_section(text):
    """Replaces the text under the heading."""
    path = os.path.join(ROOT, "docs/performance.md")
    with open(path) as file:
        before, _, rest = file.read().partition("## Measured\n")
    after = rest[rest.index("\n## "):]
    with open(path, "w") as file:
        file.write(f"{before}## Measured\n\n{text}\n{after}")


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default=os.path.join(ROOT, "build/release/lfdsim"))
parser.add_argument("--runs", type=int, default=5)
parser.add_argument("--only", default="", help="yardstick, duties, content, memory, flatness, bench, estimators: only these, with commas")
parser.add_argument("--quick", action="store_true")
parser.add_argument("--check", action="store_true")
parser.add_argument("--write", action="store_true")
options = parser.parse_args()
if options.write and (options.only or options.quick):
    parser.error("--write needs all figures, without --quick and --only")
if options.quick:
    options.runs = 1
DISPLAY = os.path.join(ROOT, "bench/yardstick.toml")
with tempfile.TemporaryDirectory() as folder:
    say(machine() + "\n\n| figure | measured | goal |\n|---|---|---|")
    shown = panel_of(DISPLAY, "panel")
    parts = {"yardstick": lambda: against_yardstick(shown), "duties": lambda: duties(shown), "content": content,
             "memory": lambda: memory_and_start(shown), "flatness": lambda: flatness(shown),
             "bench": parts_of_the_program, "estimators": estimators}
    for name, measure in parts.items():
        if not options.only or name in options.only.split(","):
            measure()
if options.write:
    write_section("\n".join(lines))
for line in failures:
    print("outside its loose bound: " + line)
sys.exit(1 if options.check and failures else 0)
