"""lfdsim glass: indices of a glass, the list of all, makers' catalogues, plots; and what check says of a display whose glass disperses."""
import json
import math
import xml.dom.minidom

from program import Checks, Program

program, checks = Program(), Checks()
result = lambda arguments: json.loads(program.must(arguments))

# n^2 = 1 + sum B l^2/(l^2 - C), with the maker's coefficients
B, C = [1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653]
def bk7(nm):
    l2 = (nm / 1000) ** 2
    return math.sqrt(1 + sum(b * l2 / (l2 - c) for b, c in zip(B, C)))

found = result("glass n-bk7 --json")
checks.that(found["name"] == "N-BK7" and abs(found["nd"] - 1.5168) < 6e-6 and abs(found["vd"] - 64.17) < 6e-3, f"N-BK7: {found}")
checks.that(found["range_nm"] == [300, 2500] and "Schott" in found["source"], f"N-BK7: {found}")
for at in [*found["lines"].values(), *found["panel"].values()]:
    checks.that(math.isclose(at["index"], bk7(at["wavelength_nm"]), rel_tol=1e-12), f"N-BK7: {at}")
checks.that({"F", "d", "C", "e", "g"} <= set(found["lines"]) and found["panel"]["blue"]["wavelength_nm"] == 464.2, f"N-BK7: {found}")
checks.that(result("glass PMMA --json")["lines"]["i"]["index"] is None, "PMMA has an index outside its range")
text = program.must("glass PMMA")
older = program.must("glass sk16")
checks.that("N-SK16, its successor of the same glass code" in older, f"glass sk16 does not name its successor: {older}")
for words in ["PMMA", "Beadie", "420 to 1620 nm", "V_d 59.37", "1.492527", "464.2000 nm"]:
    checks.that(words in text, f"glass PMMA does not print {words!r}:\n{text}")

every = result("glass --json")
checks.that(len(every) > 200 and {"PMMA", "PC", "COP", "COC", "PS", "PDMS", "BK7", "WATER"} <= {g["name"] for g in every}, "glass --json")
listed = program.must("glass")
checks.that(len(listed.splitlines()) == len(every) + 1, f"glass lists {len(listed.splitlines())} lines for {len(every)} glasses")

program.must("glass N-SF11 --plot n.svg")
plot = (program.folder / "n.svg").read_text()
xml.dom.minidom.parseString(plot)
checks.that("Refractive index of N-SF11" in plot and "wavelength, nm" in plot, "the plot has no title or axis")

maker = program.folder / "maker.agf"
maker.write_text("NM MINE 5 0 1.5 60\nCD 1.48 0.01 0 0 0 0\nLD 0.4 0.7\nNM SPENT 1 0 1.5 60\nCD 0 0 0 0 0 0\nLD 0.4 0.7\n")
code, out, err = program.run("glass --catalogue maker.agf")
checks.that(code == 0 and "MINE" in out and "N-BK7" not in out, f"glass --catalogue: {out}")
checks.that("maker.agf:1: MINE: n_d is" in err and "maker.agf:4: SPENT is left out" in err, f"glass --catalogue said {err}")
checks.that(result("glass mine --catalogue maker.agf --json")["source"] == "maker.agf", "glass of a catalogue")
checks.that(result("glass N-BK7 --catalogue maker.agf --json") == found, "a glass that ships, beside a catalogue")

(program.folder / "rubbish.agf").write_bytes(bytes(range(1, 256)) * 4000)
for name, arguments, words in [
    ("unknown glass", "glass N-BK8", "did you mean N-BK7"),
    ("plot of all", "glass --plot x.svg", "--plot: is of one glass; give its name"),
    ("plot of another kind", "glass PC --plot x.png", "a plot's name ends in .svg"),
    ("plot over the catalogue", "glass mine --catalogue m.svg --plot m.svg", "m.svg"),
    ("no catalogue", "glass --catalogue none.agf", "none.agf: there is no such file"),
    ("rubbish", "glass --catalogue rubbish.agf", "rubbish.agf: has no line NM"),
    ("unknown glass in a display", "check tiny.toml --set lens.index=none lens.glass=PNMA", "did you mean PMMA"),
    ("both", "check tiny.toml --set lens.glass=PMMA", "both lens.index and lens.glass given; leave one out"),
    ("neither", "check tiny.toml --set lens.index=none", "give lens.index, or lens.glass"),
    ("out of range", "check tiny.toml --set lens.index=none lens.glass=PMMA panel.wavelengths_nm=[611,549,405]",
     '"PMMA" is valid from 420 to 1620 nm, but is used at 405 nm'),
    ("samples without widths", "check tiny.toml --set render.wavelength_samples=3", "panel.primary_widths_nm is missing"),
]:
    (program.folder / "m.svg").write_text(maker.read_text())
    checks.refused(program, name, arguments, words)

# f = R/(n - 1), at its own wavelength; g is green's, and moves with T/n in other light; 1/L = 1/f - 1/g
R, r, h, gap = 2.6, 1.9, 1.0, 5.0
T = h + R - math.sqrt(R * R - r * r)
words = ["check", "tiny.toml", "--set", "lens.index=none", "lens.glass=BK7"]
theory = result([*words, "--json"])["theory"]
for channel, nm in [("r", 611.4), ("g", 549.1), ("b", 464.2)]:
    said, n = theory["colour"][channel], bk7(nm)
    f, g = R / (n - 1), gap + T / n - T / bk7(549.1)
    wanted = {"wavelength_nm": nm, "focal_length_mm": f, "gap_mm": g, "central_depth_mm": 1 / (1 / f - 1 / g)}
    for key, value in wanted.items():
        checks.that(math.isclose(said[key], value, rel_tol=1e-9), f"theory.colour.{channel}.{key} is {said[key]}, wanted {value}")
    checks.that(math.isclose(said["index"]["lens"], n, rel_tol=1e-12), f"theory.colour.{channel}.index is {said['index']}")
for key in ["focal_length_mm", "gap_mm", "central_depth_mm"]:
    checks.that(theory[key] == theory["colour"]["g"][key], f"theory.{key} is not green's")
table = program.must(words)
checks.that("Theory by colour" in table and "blue" in table and "BK7" in table, f"check prints no colours:\n{table}")
checks.that("colour" not in result("check tiny.toml --json")["theory"] and "by colour" not in program.must("check tiny.toml"),
            "check prints colours without dispersion")
code, out, err = program.run(["check", "tiny.toml", "--set", "lens.index=none", "lens.glass=mine", 'glass_catalogues=["maker.agf"]'])
checks.that(code == 0 and "maker.agf:1: MINE: n_d is" in out, f"check says nothing of a doubtful glass: {out}{err}")
checks.finish()
