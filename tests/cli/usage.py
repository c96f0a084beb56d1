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
    ("empty description", ["check", ""], "DISPLAY.toml: the name is empty"),
    ("empty output", ["eia", "tiny.toml", "--pattern", "white", "-o", ""], "--output: the name is empty"),
    ("bench of a missing model", "bench --model none.obj", "--model: none.obj does not exist"),
    ("option without value", "render tiny.toml -o out.png --samples", "--samples needs a value"),
    ("option given twice", "render tiny.toml -o out.png --seed 1 --seed 2", "--seed is given more than once"),
    ("one file too many", "check tiny.toml panel.png", "panel.png"),
    ("control characters", ["check", "\x1b[31mred\n.toml"], "?[31mred?.toml"),
]:
    checks.refused(program, name, arguments, words)

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

table = program.must("check tiny.toml --set diffuser.angle_deg=[1,1]")
for words in ["pixel_pitch_mm         0.5 mm", "surround               opaque", "default", "field of view", "gap_mm", "dark bands"]:
    checks.that(words in table, f"check does not print {words!r}:\n{table}")

for model, there in [("none.obj", False), ("built-in:spheres", True)]:
    told = "no such model file" in program.must(f"check tiny.toml --set content.model={model}")
    checks.that(told != there, f"check, model {model}")

gpu = program.must("doctor")
checks.that("toolkit" in gpu and "driver" in gpu and "used" in gpu, f"doctor says nothing of GPUs:\n{gpu}")

text = program.must("doctor", env={"LFDSIM_KERNEL": "abacus"})
checks.that("forced by LFDSIM_KERNEL" in text and "unknown kernel 'abacus'" in text, f"doctor, unknown kernel:\n{text}")

before = program.files()
for name in ["check tiny.toml", "doctor", "--help", "compare panel.png panel.png"]:
    with open("/dev/full", "w") as full:
        code, _, err = program.run(name, stdout=full)
    checks.that(code == 1 and "standard output" in err, f"lfdsim {name} > /dev/full: exit code {code}, said {err!r}")
checks.that(program.files() == before, "files were left")
checks.finish()
