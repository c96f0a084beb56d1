"""Usage errors name what was probably meant; help and version are at hand; results alone go to standard output."""
from program import Checks, Program

program, checks = Program(), Checks()
COMMANDS = ["new", "import", "check", "eia", "photo", "render", "compare", "analyze", "sheet", "export", "bench", "glass", "errors", "doctor"]

for name, arguments, words in [
    ("no command", "", "a command is missing"),
    ("unknown command", "rendr tiny.toml", "did you mean render?"),
    ("unknown option", "check tiny.toml --jsn", "did you mean --json?"),
    ("option without its unit", "render tiny.toml --camera 0,0,400 -o out.png", "did you mean --camera-mm?"),
    ("unknown option before the command", "--jsn check tiny.toml", "--jsn"),
    ("option far from any", "check tiny.toml --qqqqqqqq", "--qqqqqqqq: unknown option"),
    ("dashes alone", "--", "a command is missing"),
    ("dashes for a description", "check --", "DISPLAY.toml is required"),
    ("dashes and no output", "render -- tiny.toml", "--output is required"),
    ("dashes with a value", "check --=", "--: unknown option"),
    ("option without a name", "check -=x tiny.toml", "-: unknown option"),
    ("option after dashes", "render tiny.toml --pattern white -o out.png -- --size", "--size: is in the wrong place"),
    ("option before the command", "--size 9x9 render tiny.toml --pattern white -o out.png", "--size: is in the wrong place"),
    ("no description", "check", "DISPLAY.toml is required"),
    ("empty description", ["check", ""], "DISPLAY.toml: is empty"),
    ("empty output", ["eia", "tiny.toml", "--pattern", "white", "-o", ""], "--output: is empty"),
    ("empty key", ["check", "tiny.toml", "--set", ""], "--set: is empty; give KEY=VALUE"),
    ("empty after an equals sign", ["glass", "PMMA", "--plot=", "other"], "--plot: is empty; give OUT.svg"),
    ("empty option", ["glass", "PMMA", "--plot", ""], "--plot: is empty; give OUT.svg"),
    ("empty number", ["eia", "tiny.toml", "--pattern", "white", "-o", "out.png", "--threads", ""], "--threads: is empty; give N"),
    ("bench of a missing model", "bench --model none.obj", "--model: none.obj does not exist"),
    ("option without value", "render tiny.toml -o out.png --samples", "--samples needs a value"),
    ("option given twice", "render tiny.toml -o out.png --seed 1 --seed 2", "--seed is given more than once"),
    ("one file too many", "check tiny.toml panel.png", "panel.png"),
    ("unknown command with options", "rendr tiny.toml -o out.png", "rendr: unknown command; did you mean render?"),
    ("a display for a command", "tiny.toml -o out.png", "lfdsim check tiny.toml"),
    ("measure behind the display", "analyze tiny.toml fov -o out", "fov: is a measure; measures come before the display: lfdsim analyze fov tiny.toml"),
    ("measures behind the display", "analyze tiny.toml fov,mtf", "lfdsim analyze fov,mtf tiny.toml"),
    ("peer behind the display", "export tiny.toml pov -o scene", "lfdsim export pov tiny.toml"),
    ("spaces for commas", "render tiny.toml --camera-mm 40 0 599 -o out.png", "--camera-mm 40,0,599"),
    ("too few with spaces", "render tiny.toml --camera-mm 40 0 -o out.png", "without spaces: --camera-mm X,Y,Z"),
    ("spaces and commas, before the display", "render --target-mm 40, 0, -5 tiny.toml -o out.png", "--target-mm 40,0,-5"),
    ("spaces in steps", "analyze fov tiny.toml --angles-deg -30 30 1 -o out", "--angles-deg -30,30,1"),
    ("spaces in a crop", "compare panel.png panel.png --crop 0 0 5 5", "--crop 0,0,5,5"),
    ("a space for =", "check tiny.toml --set array.pitch_mm 8", "--set array.pitch_mm: a key and its value are one word: --set array.pitch_mm=VALUE"),
    ("a space for =, before the display", "check --set array.pitch_mm 8 tiny.toml", "--set array.pitch_mm=VALUE"),
    ("spaces for an x", "render tiny.toml --size 96 x 54 -o out.png", "--size 96x54"),
    ("a comma for an x in a grid", "views tiny.toml --grid 3,3 -o views", "give columns x rows, such as 9x9"),
    ("one number for three", "analyze fov tiny.toml --angles-deg 5 -o out", "give FROM,TO,STEP: 3 finite numbers with commas between, such as -30,30,1"),
    ("a negative count", "render tiny.toml --samples -1 -o out.png", "give a whole number from 1 to 16777216"),
    ("a negative seed", "render tiny.toml --seed -1 -o out.png", "give a whole number, 0 or more"),
    ("a decimal comma", "eia tiny.toml --depth-mm 20,5 -o out.png", "give 20.5"),
    ("a unit", "eia tiny.toml --depth-mm 20mm -o out.png", "give the number without a unit: 20"),
    ("control characters", ["check", "\x1b[31mred\n.toml"], "\\u001b[31mred\\u000a.toml"),
]:
    checks.refused(program, name, arguments, words)

# The same slips in a file.
tiny = (program.folder / "tiny.toml").read_text()
for line, said in (("gap_mm = 3,2", "slip.toml:15:11: gap_mm: the decimal sign is a point; write 3.2"),
                   ("gap_mm = 3.2 mm", "gap_mm: numbers carry no unit, array.gap_mm is in mm; write 3.2"),
                   ("gap_mm = .5  # half", "gap_mm: numbers have digits on both sides of a point and no leading zeros; write 0.5"),
                   ("gap_mm = 3.2 in", "array.gap_mm is in mm; write the number in it"), ("count = 11, 6", "count: a list is written in brackets, with commas: [11, 6]")):
    key = line.split(" =")[0]
    (program.folder / "slip.toml").write_text("\n".join(line if old.startswith(f"{key} =") else old for old in tiny.split("\n")))
    checks.refused(program, line, "check slip.toml", said)

help_text = program.must("--help")
for command in COMMANDS:
    checks.that(command in help_text, f"--help does not name {command}")
    text = program.must(f"{command} --help")
    checks.that(f"  lfdsim {command} " in text or text.rstrip().endswith(f"lfdsim {command}"), f"{command} --help has no example:\n{text}")
    checks.that(program.must(f"help {command}") == text, f"help {command} differs from {command} --help")
checks.that(program.must("--version").startswith("lfdsim "), "--version")

# Overrides one by one or in a row; numbers with exponents, and negative ones.
row = program.must("check tiny.toml --json --set lens.index=1.5 array.count=[10,5] --camera-mm -1e1,.5,4e2")
one = program.must("check tiny.toml --json --set lens.index=1.5 --set array.count=[10,5] --camera-mm=-10,0.5,400")
checks.that(row == one, "--set a=1 b=2 differs from --set a=1 --set b=2")
checks.that("1.5" in row and "-10" in row, "overrides are not in force")

# An option takes the place of what says the same in another way.
wide = program.must("check tiny.toml --json --set camera.frame_width_mm=none camera.fov_deg=30 --frame-width-mm 50")
checks.that('"frame_width_mm": 50' in wide and '"fov_deg": null' in wide, "--frame-width-mm does not replace camera.fov_deg")

table = program.must("check tiny.toml --all --set diffuser.angle_deg=[1,1]")
for words in ["pixel_pitch_mm         0.5 mm", "surround               opaque", "default", "field of view", "gap_mm", "dark bands"]:
    checks.that(words in table, f"check does not print {words!r}:\n{table}")

for model, there in [("none.obj", False), ("built-in:spheres", True)]:
    told = "no such model file" in program.must(f"check tiny.toml --set content.model={model}")
    checks.that(told != there, f"check, model {model}")

gpu = program.must("doctor")
checks.that("toolkit" in gpu and "driver" in gpu and "used" in gpu, f"doctor says nothing of GPUs:\n{gpu}")

text = program.must("doctor", env={"LFDSIM_KERNEL": "abacus"})
checks.that("forced by LFDSIM_KERNEL" in text and "unknown kernel 'abacus'" in text, f"doctor, unknown kernel:\n{text}")

# --device holds for every picture that a command renders, whatever the environment says.
(program.folder / "walk.json").write_text('{"schema": 1, "frames_per_second": 1, "poses": [{"time_s": 0, "position_mm": [0, 0, 400]}]}')
for command in ["render tiny.toml --pattern white --exposure auto -o exposed.png", "render tiny.toml --pattern white --path walk.json -o walk",
                "views tiny.toml --of display --grid 1x1 --pattern white -o grid", "analyze dof,mtf,components,fov tiny.toml --depths-mm 0,2,1 "
                "--angles-deg -1,1,1 -o measured"]:
    code, _, err = program.run(f"{command} --progress none", env={"LFDSIM_DEVICE": "abacus"})
    checks.that(code == 2 and "LFDSIM_DEVICE: unknown device 'abacus'" in err, f"{command}, unknown device: exit code {code}, said {err!r}")
    code, _, err = program.run(f"{command} --progress none --device cpu", env={"LFDSIM_DEVICE": "abacus"})
    checks.that(code == 0, f"{command}, --device cpu: exit code {code}, said {err!r}")

before = program.files()
for name in ["check tiny.toml", "doctor", "--help", "compare panel.png panel.png"]:
    with open("/dev/full", "w") as full:
        code, _, err = program.run(name, stdout=full)
    checks.that(code == 1 and "standard output" in err, f"lfdsim {name} > /dev/full: exit code {code}, said {err!r}")
checks.that(program.files() == before, "files were left")
checks.finish()
