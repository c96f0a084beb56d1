"""Time at equal error: how long each program takes for the noise that 100 random samples have.

The error of a picture is its RMSE in linear light against many points by lfdsim through the true surfaces. For pictures through triangles it has two parts:
noise, which samples lower, and what triangles do wrong, which they do not and which two pictures with other random numbers have in common.
"""
import statistics

import numpy as np

import pictures
import programs
from programs import NAMES, failed_row, going_on, say
from scenes import Exported, Scene, described, monkey_panel

DISPLAY, MESH = "desktop-asphere", 3386  # triangles a lens, as the 2019 paper had them
PEERS = {"with diffuser": [("cycles", "smooth"), ("cycles", "flat"), ("mitsuba", "smooth")],
         "without": [("cycles", "smooth"), ("mitsuba", "smooth"), ("pov", "true surfaces")]}


def scene_of(program, folder, case, size, panel, pixel_filter="box"):
    """Without a diffuser samples are spread over the pixel: otherwise all would be the same ray."""
    spread = {} if case == "with diffuser" else {"camera": {"pixel_filter": pixel_filter}}
    over = {"panel": {"encoding": "srgb"}, "render": {"fresnel": "exact"}, **spread}
    description = described(DISPLAY, size, diffuser=case == "with diffuser", **over)
    return Scene(program, folder / f"speed-{case.replace(' ', '-')}-{pixel_filter}", description, panel)


def noise(run, bias):
    return max(run["rmse"] ** 2 - bias**2, 1e-18) ** 0.5


def samples_for(runs, bias, goal):
    """Samples until the noise is that small, interpolated and extrapolated linearly in logarithmic axes; and the law N^-q of the noise."""
    n, e = np.log([run["samples"] for run in runs]), np.log([noise(run, bias) for run in runs])
    slopes = np.minimum(np.diff(e) / np.diff(n), -0.1)
    k = min(int(np.sum(e[1:-1] > np.log(goal))), len(slopes) - 1)
    return float(np.exp(n[k + 1] + (np.log(goal) - e[k + 1]) / slopes[k])), float((e[0] - e[-1]) / (n[-1] - n[0]))


def line(runs, key):
    """(start, per sample) of seconds = start + N * per sample, from the fewest and the most samples."""
    first, last = runs[0], runs[-1]
    slope = (last[key] - first[key]) / (last["samples"] - first["samples"])
    if slope <= 0:  # lost in the machine's other work
        slope = last[key] / last["samples"]
    return max(0.0, first[key] - slope * first["samples"]), slope


def ours(scene, reference, way, options, samples, rounds):
    """lfdsim with so many samples. Start: the same command for one pixel of the picture."""
    command = [*options, "--samples", samples]
    picture, _ = scene.lfdsim(*command)
    whole = [scene.lfdsim(*command)[1] for _ in range(rounds)]
    start = [scene.lfdsim(*command, "--crop", "0,0,1,1")[1] for _ in range(rounds)]
    middle = lambda rows, key: statistics.median(row[key] for row in rows)
    row = {"program": f"lfdsim, {way}", "samples": samples, "rmse": pictures.rmse(picture, reference), "start_wall_s": middle(start, "wall"),
           "start_processor_s": middle(start, "processor"), "render_wall_s": middle(whole, "seconds"),
           "render_processor_s": max(middle(whole, "processor") - middle(start, "processor"), 1e-3)}
    say(f"{row['program']}, {samples} samples: RMSE {row['rmse']:.5f}, rendering {row['render_wall_s']:.3f} s wall, {row['render_processor_s']:.3f} s processor")
    return row


def lfdsims(scene, reference, rounds):
    """Each estimator with the fewest samples whose error is below that of 100 random ones."""
    random = ours(scene, reference, "random points", ["--estimator", "point", "--set", 'render.sampling="random"'], 100, rounds)
    goal, rows = random["rmse"], [random]
    for way, options, counts in (("point", ["--estimator", "point"], (8, 16, 24, 32, 48, 64, 100)), ("filtered", ["--estimator", "filtered"], (1, 2, 3, 4, 8, 16, 32, 64))):
        for samples in counts:
            if pictures.rmse(scene.lfdsim(*options, "--samples", samples)[0], reference) <= goal:
                break
        rows.append(ours(scene, reference, way, options, samples, rounds))
    return rows


def bias_of(scene, exported, options, picture, samples, reference):
    """The part of a picture's error that is not noise: two pictures with different random numbers have it in common."""
    other = Exported(scene, exported.peer, *options, "--set", "render.seed=77").render(samples=samples)[0]
    return float(np.sqrt(max(0.0, np.mean((picture - reference) * (other - reference)))))


def peer(scene, reference, name, normals, counts, goal):
    options = [] if name == "pov" else ["--triangles", str(MESH), "--normals", normals]
    exported = Exported(scene, name, *options)
    runs = []
    for count in counts:
        if name == "pov":  # no samples spread over a pixel: a picture of finer pixels, averaged
            times = round(count ** 0.5)
            picture, ran = exported.render(times=times)
            rows, columns = reference.shape[:2]
            picture = picture.reshape(rows, times, columns, times, 3).mean(axis=(1, 3))
            count = times * times
        else:
            picture, ran = exported.render(samples=count)
        runs.append({"samples": count, "rmse": pictures.rmse(picture, reference), "wall": ran.wall, "processor": ran.processor,
                     "psnr": pictures.psnr(picture, reference)})
        say(f"{NAMES[name]}, {normals}, {count} samples: RMSE {runs[-1]['rmse']:.5f}, {ran.wall:.1f} s wall, {ran.processor:.1f} s processor")
    bias = 0.0 if name == "pov" else bias_of(scene, exported, options, picture, counts[-1], reference)
    noise_samples, law = samples_for(runs, bias, goal)
    samples = samples_for(runs, bias, (goal**2 - bias**2) ** 0.5)[0] if bias < goal else None
    result = {"program": NAMES[name], "normals": normals, "runs": runs, "bias": bias, "noise_samples": noise_samples, "samples": samples,
              "export_s": exported.ran.wall, "law": law}
    for key in ("wall", "processor"):
        start, slope = line(runs, key)
        result[f"start_{key}_s"], result[f"per_sample_{key}_s"] = start, slope
        result[f"noise_{key}_s"] = slope * noise_samples
        result[f"render_{key}_s"] = None if samples is None else slope * samples
    return result


def measure(program, folder, size, peers, counts, rounds, references):
    found = {"display": DISPLAY, "size": list(size), "triangles": MESH, "versions": {p: programs.version(p) for p in peers}, "cases": {}}
    panel = monkey_panel(program, folder)
    for case, rows in PEERS.items():
        rows = [row for row in rows if row[0] in peers]
        if not rows:
            continue
        scene = scene_of(program, folder, case, size, panel)
        many = ("--estimator", "point", "--samples", references)
        halves = [scene.lfdsim(*many, "--seed", seed)[0] for seed in (101, 102)]
        reference = (halves[0] + halves[1]) / 2
        mine = lfdsims(scene, reference, rounds)
        goal = mine[0]["rmse"]
        say(f"{case}: 100 random samples have an RMSE of {goal:.5f}; the reference's own error is about {pictures.rmse(*halves) / 2:.6f}")
        centers = scene_of(program, folder, case, size, panel, "center")
        theirs = []
        for name, normals in rows:
            if name not in programs.failed:
                with going_on(name):
                    theirs.append(peer(centers if name == "pov" else scene, reference, name, normals, counts, goal))
        filtered = next(row for row in mine if row["program"].endswith("filtered"))
        for row in theirs:
            row["samples_as_filtered"] = samples_for(row["runs"], row["bias"], filtered["rmse"])[0]
            for key in ("wall", "processor"):
                row[f"over_filtered_{key}"] = row[f"noise_{key}_s"] / filtered[f"render_{key}_s"]
                row[f"over_point_{key}"] = row[f"noise_{key}_s"] / mine[1][f"render_{key}_s"]
                row[f"over_filtered_at_its_error_{key}"] = row[f"over_filtered_{key}"] * row["samples_as_filtered"] / row["noise_samples"]
            say(f"{case}, {row['program']}, {row['normals']}: noise as of 100 random samples after {row['noise_processor_s']:.1f} processor s; filtered is "
                f"{row['over_filtered_processor']:.0f} times as fast ({row['over_filtered_at_its_error_processor']:.0f} times at its own error), point "
                f"{row['over_point_processor']:.0f} times")
        found["cases"][case] = {"goal": goal, "reference_error": pictures.rmse(*halves) / 2, "reference_samples": 2 * references, "lfdsim": mine, "peers": theirs}
    return found


def seconds(value):
    return "never" if value is None else f"{value:.3g}"


def text(found, load, failed):
    lines = [f"{found['display']} ({found['size'][0]} x {found['size'][1]} pixels, 43 x 24 lenses, 3840 x 2160 panel pixels, exact Fresnel weights), "
             f"{'; '.join(found['versions'].values())}; lenses of about {found['triangles']} triangles, except for POV-Ray. {load}", ""]
    for case, made in found["cases"].items():
        spread = "samples scattered by the box diffuser" if case == "with diffuser" else "no diffuser, samples spread over the pixel"
        lines += [f"**{case[0].upper()}{case[1:]}{' diffuser' if case == 'without' else ''}**: {spread}; to the RMSE of 100 random samples, {made['goal']:.5f}.", "",
                  "| program | samples needed | rendering, s (processor s) | start, s (processor s) | RMSE that samples do not lower | noise falls as | RMSE reached | time over filtered's (processor) | the same at filtered's RMSE | over point's |",
                  "|---|---|---|---|---|---|---|---|---|---|"]
        filtered = made["lfdsim"][2]
        for row in made["lfdsim"]:
            over = f"{row['render_wall_s'] / filtered['render_wall_s']:.2g} ({row['render_processor_s'] / filtered['render_processor_s']:.2g})"
            lines.append(f"| {row['program']} | {row['samples']} | {row['render_wall_s']:.3f} ({row['render_processor_s']:.3f}) | {row['start_wall_s']:.2f} "
                         f"({row['start_processor_s']:.2f}) | 0 | | {row['rmse']:.5f} | {over} | | |")
        for row in made["peers"]:
            lines.append(f"| {row['program']}, {row['normals']} | {row['noise_samples']:.0f} | {row['noise_wall_s']:.3g} ({row['noise_processor_s']:.3g}) | "
                         f"{row['start_wall_s']:.2f} ({row['start_processor_s']:.2f}) | {row['bias']:.5f} | N^-{row['law']:.2f} | "
                         f"{made['goal']:.5f} | {row['over_filtered_wall']:.0f} ({row['over_filtered_processor']:.0f}) | "
                         f"{row['over_filtered_at_its_error_wall']:.0f} ({row['over_filtered_at_its_error_processor']:.0f}) | {row['over_point_wall']:.0f} ({row['over_point_processor']:.0f}) |")
        lines += [failed_row(name, why, 10) for name, why in failed.items() if name in found["versions"]]
        cycles = next((row for row in made["peers"] if row["program"] == NAMES["cycles"] and case == "with diffuser"), None)
        if cycles:
            at_goal, at_own = cycles["over_filtered_processor"], cycles["over_filtered_at_its_error_processor"]
            lines += ["", "Expected: 1000 times the speed of Cycles with the diffuser, in processor seconds. At the RMSE of 100 random samples the factor is "
                      f"{at_goal:.0f}: {'confirmed' if at_goal >= 1000 else 'refuted'}. At the RMSE of filtered with its fewest samples, {filtered['rmse']:.5f}, "
                      f"it is {at_own:.0f}: {'confirmed' if at_own >= 1000 else 'refuted'}. "
                      "Filtered's time grows more slowly than the number of pixels, so smaller pictures (`--quick`) gain less."]
        never = [f"{row['program']}, {row['normals']}" for row in made["peers"] if row["samples"] is None]
        if never:
            lines += ["", f"With the errors of the triangles included, no number of samples brings {' and '.join(never)} to that RMSE."]
        lines.append("")
    measured = [row for made in found["cases"].values() for row in made["peers"]]
    if not measured:
        return lines
    counts = ", ".join(str(run["samples"]) for run in measured[-1]["runs"])
    lines += [f"All errors are RMSE in linear light against {made['reference_samples']} points by lfdsim through the true surfaces (their own error is about "
              f"{made['reference_error']:.6f}). A peer's pictures of {counts} samples a pixel have two errors: a systematic one, from its triangles and "
              "other differences (*RMSE that samples do not lower*: two pictures with different random numbers have it in common), and noise. Samples and times "
              "are those for the noise alone, so that no peer is charged for its meshes. "
              "*RMSE reached*: filtered with its fewest samples already has less noise than required, so the next column gives the peer's time to that lower RMSE, "
              "extrapolating how its noise falls. *Start*: the time of the command without samples: launch, scene, tree, panel image; export is not included. lfdsim's "
              "rendering time is the one it reports (wall), and that of the command minus that of the same command for one pixel (processor).",
              "Cycles has no box diffuser; its stand-in refracts at a normal derived from a hash of the position (`lfdsim export cycles`), which is exact in the mean. "
              "POV-Ray has no diffuser at all; its samples over a pixel are a regular grid, and its aspheres are isosurfaces, found step by step."]
    return lines
