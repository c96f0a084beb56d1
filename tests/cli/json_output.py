"""--json prints one JSON document and nothing else; progress goes to standard error, as lines when nobody watches."""
import array
import json
import math

from program import Checks, Program

program, checks = Program(), Checks()


def result(arguments):
    return json.loads(program.must(arguments), parse_constant=lambda name: checks.that(False, f"{arguments}: {name} is not JSON"))


check = result("check tiny.toml --json")
theory = check["theory"]
# 2 atan(p / 2g); f = R/(n - 1); 1/L = 1/f - 1/g; P_I = a L/g; DOF = 2 L P_I/D
focal = 2.6 / 0.4918
depth = 1 / (1 / focal - 1 / 5)
image = 0.5 * abs(depth) / 5
for name, wanted in [("fov_deg", 2 * math.degrees(math.atan(4 / 10))), ("focal_length_mm", focal), ("central_depth_mm", depth),
                     ("pixel_image_mm", image)]:
    checks.that(math.isclose(theory[name], wanted, rel_tol=1e-12), f"theory.{name} is {theory[name]}, wanted {wanted}")
checks.that(theory["depth_of_field_mm"] is None and "reach the lenses" in check["notes"]["theory.depth_of_field_mm"], "a published range that reaches the lenses")
fine = result("check tiny.toml --json --set panel.pixel_pitch_mm=0.1")["theory"]
checks.that(math.isclose(fine["depth_of_field_mm"], 2 * abs(depth) * image / 5 / 3.8, rel_tol=1e-12), f"depth of field {fine['depth_of_field_mm']}")
checks.that(check["display"]["panel"]["pixels"] == [88, 48] and check["display"]["render"]["fresnel"] == "exact", "check: display")
checks.that(check["geometry"]["panel_width_mm"] == 44, "check: geometry")
collimated = result(["check", "tiny.toml", "--json", "--set", f"array.gap_mm={focal!r}"])["theory"]
central = collimated["central_depth_mm"]
checks.that(central == "infinite" or abs(central) > 1e6, f"g = f: L is {central}, not infinite")

# What would disappoint is told beside: behind a weak diffuser round lenses show dark bands.
checks.that(any("dark bands" in w for w in result("check tiny.toml --json --set diffuser.angle_deg=[0.1,0.1]")["warnings"]), "no warning")

for arguments, units in [("eia tiny.toml --model pyramid.obj -o eia.png", 88 * 48), ("photo tiny.toml --model pyramid.obj -o photo.png", 96 * 54),
                         ("render tiny.toml --model pyramid.obj --estimator point --samples 16 -o view.png", 96 * 54 * 16)]:
    made = result(arguments + " --json --progress none")
    checks.that(made.get("rays", made.get("samples")) == units, f"{arguments}: {made}, wanted {units}")
    checks.that((program.folder / made["output"]).exists() and made["seconds"] >= 0, f"{arguments}: {made}")
checks.that(made["kernel"] in ["scalar", "baseline", "avx2", "avx512"] and made["threads"] >= 1, f"render: {made}")

same, other = result("compare panel.png panel.png --json"), result("compare view.png photo.png --json")
checks.that(same["ssim"] == 1 and same["psnr_db"] is None and same["rmse"] == 0 and same["max_difference"] == 0, f"compare, equal: {same}")
checks.that(-1 <= other["ssim"] < 1 and other["psnr_db"] > 0 and other["rmse"] > 0 and other["max_difference"] > 0, f"compare: {other}")
checks.that(result("sheet view.png photo.png -o sheet.png --json")["pictures"] == 2, "sheet")
checks.that(result("doctor --json")["version"], "doctor")

render = "render tiny.toml --panel-image panel.png -o view.npy --json --progress"
for style in ["auto", "lines", "json", "none", "bar"]:
    code, out, err = program.run(f"{render} {style}")
    json.loads(out)
    checks.that(code == 0, f"--progress {style}: exit code {code}")
    if style == "none":
        checks.that(err == "", f"--progress none: {err!r}")
    if style == "json":
        last = [json.loads(line) for line in err.splitlines()][-1]
        checks.that(last["stage"] == "rendering" and last["done"] == last["units"], f"--progress json: {err!r}")
    if style in ["auto", "lines"]:
        checks.that(err.startswith("lfdsim: rendering: 100 %"), f"--progress {style}: {err!r}")
    if style == "bar":
        checks.that("[=====" in err and err.endswith("\n"), f"--progress bar: {err!r}")

# Light that a PNG or the panel cuts off is told: once, and only where it is much.
BRIGHT, WHITE = "--model pyramid.obj --set content.light.strength=9", "--pattern white --set panel.subpixels='rgb_stripe'"
for arguments, name, remedy in [
    (f"render tiny.toml {WHITE}", "view.png", "lost; --exposure 0.44"),
    (f"render tiny.toml {WHITE} --exposure 0.9", "view.png", "times smaller, or an .exr or .npy keeps their light"),
    (f"render tiny.toml {WHITE} --path path.json", "frames", "lost; an .exr or .npy keeps their light"),
    (f"views tiny.toml --of display {WHITE} --grid 2x1 --view-size 96x52", "grid", "lost; an .exr or .npy keeps their light"),
    (f"views tiny.toml {BRIGHT}", "bright_qs2x1a1.8.png", "lost; an .exr or .npy keeps their light"),
    (f"eia tiny.toml {BRIGHT}", "eia.png", "lost; an .exr or .npy keeps their light"),
    (f"photo tiny.toml {BRIGHT}", "photo.png", "lost; an .exr or .npy keeps their light"),
    ("sheet bright.npy", "sheet.png", "lost; an .exr or .npy keeps their light"),
    (f"render tiny.toml {BRIGHT}", "view.npy", "the panel shows no more; --set content.light.strength can darken it"),
]:
    if name == "frames":
        (program.folder / "path.json").write_text(json.dumps({"schema": 1, "frames_per_second": 1, "poses": [
            {"time_s": 0, "position_mm": [0, 0, 400]}, {"time_s": 1, "position_mm": [9, 0, 400]}]}))
    if name == "sheet.png":
        program.must(f"photo tiny.toml {BRIGHT} -o bright.npy")
    code, out, err = program.run(f"{arguments} -o {name} --json" + ("" if name == "sheet.png" else " --progress none"))
    checks.that(code == 0 and err.count("warning") == 1 and "are cut off to white" in err and remedy in err, f"{arguments}: {code} {err!r}")
    told = json.loads(out)
    told = told.get("elemental_images", told).get("cut_off", {})
    checks.that(0.01 < told.get("pixels_share", 0) < 1 and 0.01 < told["light_share"] < 1 and 1.1 < told["greatest"] < 9, f"{arguments}: {told}")
for arguments in [f"render tiny.toml {WHITE} -o view.exr", f"photo tiny.toml {BRIGHT} -o photo.npy", "render tiny.toml --pattern white -o view.png",
                  "eia tiny.toml --model pyramid.obj -o eia.png", "render tiny.toml --model pyramid.obj -o view.png"]:
    code, out, err = program.run(f"{arguments} --json --progress none")
    checks.that(code == 0 and err == "" and "cut_off" not in out, f"{arguments}: {code} {err!r} {out}")

# A picture's error is measured while it is made: it is that against many points.
def light_of(path):
    data = (program.folder / path).read_bytes()
    return array.array("f", data[10 + int.from_bytes(data[8:10], "little"):])


for changes in ("diffuser.angle_deg=[20,20]", "diffuser.angle_deg=[2,2]", "panel.subpixels='rgb_stripe' panel.aperture_ratio=0.5"):
    shown = f"render tiny.toml --panel-image panel.png --size 64x36 --json --progress none --set {changes}"
    told, seen = result(f"{shown} -o default.npy"), light_of("default.npy")
    result(f"{shown} render.estimator='point' render.samples=16384 render.seed=9 -o true.npy")
    true = light_of("true.npy")
    error = math.sqrt(sum((a - b) ** 2 for a, b in zip(seen, true)) / len(true))
    checks.that(told["estimator"] == "filtered" and 0 <= told["points_share"] <= 1, f"{changes}: {told}")
    checks.that(error / 1.3 < told["measured_error"] < 3 * error + 0.03, f"{changes}: measured {told['measured_error']}, true {error}")
    again = result(f"{shown} -o again.npy --threads 2")
    checks.that(again["measured_error"] == told["measured_error"] and light_of("again.npy") == seen, f"{changes}: depends on threads")
    checks.that("; error 0." in program.must(shown.replace("--json ", "") + " -o words.npy"), "the error is not told")
checks.finish()
