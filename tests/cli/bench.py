"""lfdsim bench: what it prints, what a signal leaves behind, and that its errors against time are errors."""
import json
import os
import pathlib
import signal
import time

from program import Checks, Program

program, checks = Program(), Checks()
temporary = program.folder / "temporary"
temporary.mkdir()
AROUND = dict(os.environ, TMPDIR=str(temporary))
TINY = "--display tiny.toml --model pyramid.obj --crop 8,4,88,50"


def result(arguments):
    return json.loads(program.must(f"{arguments} --json --progress none", env=AROUND))


# Groups that were asked for and no others; what a reader has to know; medians with their spread.
made = result(f"bench estimators pictures --quick --runs 3 --threads 2 --kernel baseline {TINY}")
checks.that([key for key in made if isinstance(made[key], list)] == ["pictures", "estimators"], f"groups: {list(made)}")
checks.that((made["kernel"], made["threads"], made["runs"], made["complete"]) == ("baseline", 2, 3, True), f"settings: {made}")
checks.that(made["machine"]["processors"] >= 1 and made["machine"]["processor"] and made["version"], f"machine: {made['machine']}")
checks.that(made["build"]["compiler"] and "-ffp-contract=off" in made["build"]["flags"], f"build: {made['build']}")
checks.that("-fno-math-errno" in made["build"]["kernel_flags"] and "avx" not in made["build"]["kernel_flags"], f"build: {made['build']}")
for row in made["pictures"]:
    seconds = row["seconds"]
    checks.that(seconds["runs"] == 3 and 0 < seconds["least"] <= seconds["median"] <= seconds["most"], f"pictures: {row}")
    checks.that(seconds["processor_median"] > 0, f"pictures: {row}")
    checks.that(abs(row["mpixels_per_s"] * seconds["median"] - 8.2944) < 1e-6, f"pictures, rate: {row}")
checks.that([row["name"] for row in made["pictures"]][-1] == "SSIM, PSNR, RMSE", "pictures: SSIM is missing")

# The root mean square error of n independent samples falls as 1/sqrt(n): from 1 to 1024 samples by 32. On these 80 x 46 pixels,
# neighbours alike, the ratio stays within a factor of 1.5; errors measured against a reference of too few samples, or against the
# same seed, would not fall so.
checks.that([row["content"] for row in made["estimators"]] == ["checkerboard", "pyramid.obj"], "estimators: contents")
for row in made["estimators"]:
    name = row["content"]
    rmse = {(p["estimator"], p["samples"]): p["rmse"] for p in row["points"]}
    checks.that(row["display"] == "tiny" and row["angle_deg"] == 0 and row["crop"] == [8, 4, 88, 50] and row["reference"]["samples"] == 2 * 16384, f"{name}: {row}")
    fall = rmse["point, random", 1] / rmse["point, random", 1024]
    checks.that(32 / 1.5 < fall < 32 * 1.5, f"{name}: the error of random samples falls by {fall:.1f} from 1 to 1024 samples, not by 32")
    checks.that(rmse["point, sobol", 1024] < rmse["point, random", 1024], f"{name}: low-discrepancy samples are no better: {rmse}")
    checks.that(0 < row["reference"]["rmse"] < rmse["point, sobol", 1024] / 2, f"{name}: the reference's own error is too great or none: {row['reference']}")
    ratios = row["time_to_papers_error_over_papers"]
    checks.that(ratios["point, random"] == 1 and 0 < ratios["point, sobol"], f"{name}: {ratios}")

table = program.must("bench kernels --quick --progress none", env=AROUND)
checks.that("Kernels" in table and "scalar" in table and "Pictures" not in table, f"table of kernels:\n{table}")

paper = {row["name"]: row for row in result("bench paper --quick")["paper"]}
checks.that(paper["the 2019 paper"]["seconds"] == 1, f"paper: {paper}")
checks.that(0 < paper["of this, tracing"]["seconds"]["median"] < paper["start to picture"]["seconds"]["median"], f"paper: {paper}")
checks.that(not list(temporary.iterdir()), f"left: {list(temporary.iterdir())}")

# Three bands are as through glass of constant indices; white is white with stripes.
colour = result("bench colour --quick")["colour"]
checks.that([(row["name"].split(",")[0], row["estimator"]) for row in colour] == [(name, way) for name in ("asphere", "strips") for way in ("points", "filtered")], f"colour: {colour}")
for row in colour:
    checks.that(row["ratio"] > 0 and abs(row["error"]["value"]) < (1e-3 if "bands" in row["name"] else 0.01), f"colour: {row}")

# Lenses by themselves that stand where they should give the same picture, but for rays at edges.
errors = result("bench errors --quick")["errors"]
checks.that(len(errors) == 14 and all(row["ratio"] > 0 and row["greatest_difference_of_none"] < 0.05 for row in errors), f"errors: {errors}")

# Where there is a GPU it gives the CPU's likenesses, else it is told what is missing.
gpu = json.loads(program.must("doctor --json"))["gpu"]
made = {row["name"]: row for row in result("bench gpu sweep --quick")["sweep"]}
checks.that(0 < made["CPU"]["seconds"]["median"] < made["CPU"]["sweep_seconds"], f"sweep: {made}")
checks.that("not_measured" in made["GPU"] if gpu["used"].startswith("no") else made["GPU"]["ssim_differs"] == 0, f"sweep on a GPU: {made}")

for name, arguments, *words in [
    ("unknown group", "bench rendring", "rendering, lenses", "GROUP"),
    ("no runs", "bench --runs 0", "--runs"),
    ("kernel and threads", "bench --kernel k --threads 0", "unknown kernel", "--threads"),
    ("missing description", "bench estimators --display none.toml", "none.toml"),
    ("camera behind the panel", "bench estimators --display tiny.toml --angle-deg 100", "--angle-deg", "tiny"),
    ("crop outside", "bench estimators --display tiny.toml --crop 0,0,97,54", "96 x 54"),
]:
    checks.refused(program, name, arguments, *words)


def running():
    """Processes that have the temporary folder in their command line."""
    lines = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            lines.append(path.read_bytes())
        except OSError:
            pass  # it has ended
    return [line for line in lines if str(temporary).encode() in line]


def gone():
    """Nothing is left a moment after the end: the folder is removed by a process that outlives the program."""
    until = time.monotonic() + 20
    while (list(temporary.iterdir()) or running()) and time.monotonic() < until:
        time.sleep(0.02)
    return not list(temporary.iterdir()) and not running()


# Each signal while a second lfdsim renders into the temporary folder.
for name, signals, code in [("one signal", [signal.SIGTERM], 130), ("two signals", [signal.SIGINT] * 2, 130),
                            ("a signal that cannot be caught", [signal.SIGKILL], -signal.SIGKILL)]:
    process = program.start("bench pictures paper --quick --runs 1000 --progress json --json", env=AROUND)
    for line in process.stderr:
        if json.loads(line)["done"] > 1:
            break
    checks.that(list(temporary.iterdir()), f"{name}: there is no temporary folder")
    for number in signals:
        process.send_signal(number)
    out, _ = process.communicate(timeout=120)
    checks.that(process.returncode == code, f"{name}: exit code {process.returncode}, wanted {code}")
    if name == "one signal":
        kept = json.loads(out)
        checks.that(kept["complete"] is False and "pictures" not in kept, f"{name}: {kept}")
        checks.that(kept["paper"][1]["seconds"]["runs"] >= 1, f"{name}: what was complete is not kept: {kept}")
    checks.that(gone(), f"{name}: left {list(temporary.rglob('*'))} {running()}")
checks.finish()
