#!/usr/bin/env python3
"""What studies cost: the figures of docs/studies.md. Usage, with a Python that has lfdsim and its [study]:

bench/studies.py [--rows 1000000] [--pairs 3]

Other work on the machine lengthens seconds on the clock, processor seconds less. Nothing but a temporary folder is written.
"""

import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import lfdsim
from lfdsim.study import api, chunk, collected, planned

DISPLAY = """schema = 1
[panel]
pixels = [960, 540]
pixel_pitch_mm = 0.13636
[lens]
type = "plano_convex"
sphere_radius_mm = 7.721
aperture_radius_mm = 6.0
cylinder_height_mm = 4.0
index = 1.4918
[array]
pitch_mm = 12.0
gap_mm = 16.485
[diffuser]
distance_mm = 60.0
angle_deg = [0.9, 0.9]
[camera]
position_mm = [0.0, 0.0, 1000.0]
resolution = [960, 540]
"""
STUDY = """schema = 1
display = "display.toml"
design = "sobol"
rows = ROWS
[[factor]]
key = "array.gap_mm"
normal = { mean = 16.485, sd = 0.05 }
[[factor]]
key = "lens.sphere_radius_mm"
normal = { mean = 7.721, sd = 0.02 }
[[factor]]
key = "array.rotation_deg"
uniform = { from = -0.2, to = 0.2 }
[[factor]]
key = "camera.position_mm.0"
uniform = { from = -50, to = 50 }
"""
CHECK = '[[measure]]\nname = "check"\n'
PICTURE = '[[picture]]\nname = "front"\nsamples = SAMPLES\n'


def usage(who: int) -> float:
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def measured(work, who: int = resource.RUSAGE_SELF) -> tuple[float, float, object]:
    """Seconds on the clock, of the processor, and what the work gave."""
    clock, processor = time.perf_counter(), usage(who)
    result = work()
    return time.perf_counter() - clock, usage(who) - processor, result


def command(*words: object) -> tuple[float, float]:
    def work():
        subprocess.run([sys.executable, "-m", "lfdsim.study", *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    return measured(work, resource.RUSAGE_CHILDREN)[:2]


def tell(what: str, clock: float, processor: float, unit: str = "s", by: float = 1.0) -> None:
    print(f"{what}: {clock * by:.3g} {unit}, of the processor {processor * by:.3g}", flush=True)


def thousand(folder: pathlib.Path) -> None:
    file, out = folder / "thousand.toml", folder / "thousand"
    file.write_text(STUDY.replace("ROWS", "1000") + CHECK)
    base = lfdsim.Display.parse(DISPLAY)
    alone = measured(lambda: [lfdsim.check(base.with_({"array.gap_mm": 16 + k / 1000})) for k in range(1000)])[:2]
    whole = command(file, "-o", out, "--no-report")
    tell("1000 rows of check in chunks of 8, a row", *whole, "ms")
    tell("of these the checks by themselves", *alone, "ms")
    tell("continuing them, finished", *command(file, "-o", out, "--no-report"))


def two_workers(folder: pathlib.Path, pairs: int) -> None:
    display = lfdsim.Display.parse(DISPLAY)
    lfdsim.render(display, threads=1, progress=False)  # the first one takes longer
    samples = 64
    while measured(lambda: lfdsim.render(display, samples=samples, threads=1, progress=False))[1] < 5:
        samples *= 2
    file, rows = folder / "heavy.toml", 24  # so many that starting hardly counts
    file.write_text("rows_per_chunk = 1\n" + STUDY.replace("ROWS", str(rows)) + PICTURE.replace("SAMPLES", str(samples)))
    for pair in range(pairs):
        (one, one_processor), (two, two_processor) = (
            command(file, "-o", folder / f"{workers}-{pair}", "--no-report", "--workers", workers) for workers in (1, 2)
        )
        print(
            f"two workers against one, rows of {one_processor / rows:.2g} s: {one / two:.2f} times the rows by the clock, "
            f"{2 * one_processor / two_processor:.2f} by processor time, were both always at work",
            flush=True,
        )


def many(folder: pathlib.Path, rows: int) -> None:
    """All but the measuring: each chunk gets the figures of one row, a little changed."""
    file = folder / "many.toml"
    file.write_text(STUDY.replace("ROWS", str(rows)) + CHECK)
    clock, processor, plan = measured(lambda: api.plan(file, folder / "many"))
    tell(f"choosing {rows} rows, {(plan.folder / 'plan.parquet').stat().st_size / 1e6:.0f} MB", clock, processor)
    made = chunk._compute(plan, 0, chunk.overrides_of(plan, 0), 1)
    print(f"figures a row: {len(made['figures'])}")

    def write():
        for number in range(plan.chunks):
            records = [
                made | {"row": row, "figures": {name: value * (1 + row / rows) for name, value in made["figures"].items()}}
                for row in plan.rows_of(number)
            ]
            chunk._write(plan, number, records)

    tell(f"writing {plan.chunks} chunks of {plan.rows_per_chunk}, a row", *measured(write)[:2], "ms", 1000 / rows)
    size = sum(p.stat().st_size for p in (plan.folder / "rows").iterdir())
    print(f"bytes a row in chunks: {size / rows:.0f}")
    tell("a worker's look at a chunk", *measured(lambda: planned.load(plan.folder).values_of(plan.chunks // 2))[:2], "ms", 1000)
    for what in ("collect", "report"):
        tell(what, *command(what, plan.folder))
        print(f"largest process so far: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e6:.2f} GB", flush=True)
    print(f"{collected.NAME}: {(plan.folder / collected.NAME).stat().st_size / 1e9:.2f} GB")
    tell("reading it again", *measured(lambda: collected.table_of(plan))[:2])


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--rows", type=int, default=1_000_000)
    words.add_argument("--pairs", type=int, default=3)
    asked = words.parse_args()
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        (folder / "display.toml").write_text(DISPLAY)
        thousand(folder)
        two_workers(folder, asked.pairs)
        many(folder, asked.rows)


if __name__ == "__main__":
    main()
