"""The whole of `analyze`: the report, --json, Ctrl-C, --resume, what a measure refuses."""
import html.parser
import json
import signal
import time
import xml.etree.ElementTree as ElementTree

from program import Checks, Program

program, checks = Program(), Checks()
QUICK = "tiny.toml --model pyramid.obj --angles-deg -30,30,10 --depths-mm 10,40,10 --progress none"


def analyze(arguments, **options):
    return program.run(f"analyze {arguments}", **options)


def times(folder):
    return {p.name: p.stat().st_mtime_ns for p in (program.folder / folder).iterdir()}


class Page(html.parser.HTMLParser):
    """Whether the tags of a page are closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.wrong = [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag not in ["meta", "img"]:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


# A whole run: each measure's files, JSON alone on standard output, a report of closed tags and valid drawings.
code, out, err = analyze(f"fov,dof {QUICK} -o whole --json")
checks.that(code == 0, f"analyze: exit code {code}: {err}")
found = json.loads(out)
written = json.loads((program.folder / "whole/fov.json").read_text())
checks.that(list(found) == ["fov", "dof"] and found["fov"] == written, f"--json: {out[:200]}")
for measure in found.values():
    for name in measure["report"]["files"]:
        checks.that((program.folder / "whole" / name).is_file(), f"{name} is missing")
for drawing in (program.folder / "whole").glob("*.svg"):
    checks.that(ElementTree.parse(drawing).getroot().tag.endswith("svg"), f"{drawing.name} is no SVG")
report = (program.folder / "whole/report.html").read_text()
page = Page(report)
checks.that(not page.open and not page.wrong, f"report: tags not closed in order: {page.open} {page.wrong}")
checks.that("This report is incomplete" not in report, "a complete report says that it is not")
for words in ["<h1>tiny</h1>", "Theory and measurement", "Field of view", "Depth of field", "analyze fov,dof tiny", "pitch_mm"]:
    checks.that(words in report, f"report: no {words!r}")

# --resume leaves what is finished, whatever the order of settings, and measures again what was made with others.
before = times("whole")
other_order = "dof,fov tiny.toml --progress none --depths-mm 1e1,40,10 --angles-deg=-30,30,10.0 --model pyramid.obj"
code, out, err = analyze(f"{other_order} -o whole --resume --json")
after = times("whole")
checks.that(code == 0 and list(json.loads(out)) == ["dof", "fov"], f"--resume: exit code {code}: {err}")
checks.that(all(after[name] == before[name] for name in before if name != "report.html"), "--resume measured again")
code, out, err = analyze(f"spot {QUICK} -o whole")
checks.that(code == 0 and {"fov.json", "dof.json", "spot.json"} <= set(times("whole")), f"another measure of the same settings: {err}")

# What the model's file names, and a table of lenses, count as much.
TABLE = "i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature\n0,0,{},0,0,0,0,0\n"
(program.folder / "red.mtl").write_text("newmtl m\nKd 0.8 0.1 0.1\n")
(program.folder / "named.obj").write_text("mtllib red.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
(program.folder / "lenses.csv").write_text(TABLE.format(0.01))
NAMED = "fov tiny.toml --progress none --angles-deg=-30,30,10 --model named.obj --set errors.table=lenses.csv -o named"
for file, text in (("red.mtl", "newmtl m\nKd 0.1 0.1 0.8\n"), ("lenses.csv", TABLE.format(0.03))):
    code, out, err = analyze(NAMED + " --replace")
    before = times("named")["fov.json"]
    code, out, err = analyze(NAMED + " --resume")
    checks.that(code == 0 and times("named")["fov.json"] == before, f"--resume measured again: {err}")
    (program.folder / file).write_text(text)
    checks.refused(program, f"another {file}", f"analyze {NAMED} --resume", "named: contains results of other settings: fov (files")

# Results of other settings never lie beside: they are refused, or replaced.
CHANGED = f"fov {QUICK} -o whole --set array.gap_mm=5.1"
for resume in ["", " --resume"]:
    checks.refused(program, "other settings", "analyze " + CHANGED + resume, "whole: contains results of other settings: fov (display)", "dof (display)", "--replace")
(program.folder / "whole/notes.txt").write_text("mine")
code, out, err = analyze(CHANGED + " --replace --resume")
left = {name for name in times("whole") if name.endswith(".json") or name in ["notes.txt", "report.html"]}
checks.that(code == 0 and left == {"fov.json", "notes.txt", "report.html"}, f"--replace: exit code {code}, left {left} {err}")
checks.that('id="dof"' not in (program.folder / "whole/report.html").read_text(), "the report shows a measure of other settings")

# Progress over the whole run.
code, out, err = analyze(f"fov,dof {QUICK} -o progress".replace("none", "json"))
lines = [json.loads(line) for line in err.splitlines()]
last = lines[-1]
checks.that({line["stage"] for line in lines} == {"analyzing"} and last["done"] == last["units"], f"progress: {err[-300:]}")

# Ctrl-C: what is finished stays, the report says what is missing, and --resume goes on.
LONG = "fov,dof tiny.toml --model pyramid.obj --angles-deg -30,30,30 --depths-mm 10,1000,0.1 --size 640x360 --progress json -o cut"
process = program.start(f"analyze {LONG} --json")
for line in process.stderr:
    if "second" not in locals():
        second = program.run(f"analyze fov {QUICK} -o cut")
        checks.that(second[0] == 2 and "cut: another run is writing" in second[2], f"two runs in one folder: {second}")
    if (program.folder / "cut/fov.json").exists():
        break
time.sleep(0.3)
process.send_signal(signal.SIGINT)
sent = time.monotonic()
out, err = process.communicate(timeout=60)
took = time.monotonic() - sent
checks.that(process.returncode == 130, f"interrupted: exit code {process.returncode}: {err}")
checks.that(out == "" and "--resume continues" in err and "1 of 2" in err, f"interrupted: printed {out[:100]!r}, said {err[-300:]!r}")
checks.that(took < 10, f"interrupted: it ended after {took:.1f} s")  # about one, when nothing else runs
checks.that(not (program.folder / "cut/dof.json").exists(), "interrupted: half a measure was kept")
checks.that(not list((program.folder / "cut").glob("*partial*")), "interrupted: a partial file was left")
report = (program.folder / "cut/report.html").read_text()
for words in ["This report is incomplete.", "Missing: Depth of field (dof)", 'id="fov"']:
    checks.that(words in report, f"interrupted: report has no {words!r}")
before = times("cut")
process = program.start(f"analyze {LONG} --resume")
next(iter(process.stderr))
process.send_signal(signal.SIGTERM)
process.communicate(timeout=60)
checks.that(process.returncode == 130, f"interrupted again: exit code {process.returncode}")
checks.that(times("cut")["fov.json"] == before["fov.json"], "--resume after Ctrl-C measures fov again")

# Before anything is finished, too, there is a report, and it says so.
process = program.start(f"analyze {LONG.replace('-o cut', '-o early')}")
next(iter(process.stderr))
process.send_signal(signal.SIGINT)
process.communicate(timeout=60)
report = (program.folder / "early/report.html").read_text()
checks.that("Missing: Field of view (fov), Depth of field (dof)" in report, "interrupted at once: report")

# A measure that cannot be made leaves the others whole: the run ends as one with bad input.
code, out, err = analyze(f"fov,dof {QUICK.replace('-30,30,10', '5,30,5')} -o partly --json")
checks.that(code == 2 and out == "" and "--angles-deg" in err, f"one measure refused: exit code {code}, {err}")
report = (program.folder / "partly/report.html").read_text()
for words in ["Field of view (fov) could not be measured: --angles-deg", 'id="dof"']:
    checks.that(words in report, f"one measure refused: report has no {words!r}")

# Two displays side by side: a folder of each with its report, and one report with what differs.
(program.folder / "other.toml").write_text((program.folder / "tiny.toml").read_text().replace("gap_mm = 5.0", "gap_mm = 5.2"))
TWO = "dof tiny.toml other.toml --model pyramid.obj --depths-mm 10,40,10 --progress none -o two"
code, out, err = analyze(f"{TWO} --json")
checks.that(code == 0, f"two displays: exit code {code}: {err}")
both = json.loads(out)
checks.that(both["displays"] == ["tiny", "tiny-2"] and [row["key"] for row in both["settings"]] == ["array.gap_mm"], f"two displays: {out[:300]}")
for name in both["displays"]:
    written = json.loads((program.folder / f"two/{name}/dof.json").read_text())
    checks.that(both["results"][name]["dof"] == written, f"two displays: {name}'s results are not those of its folder")
    checks.that("Depth of field" in (program.folder / f"two/{name}/report.html").read_text(), f"two displays: {name} has no report")
checks.that(any(row["difference"][0] for row in both["findings"]), "two displays: nothing differs")
page = Page((program.folder / "two/report.html").read_text())
checks.that(not page.open and not page.wrong, f"two displays: tags not closed in order: {page.open} {page.wrong}")
before = times("two/tiny-2")
code, out, err = analyze(f"{TWO} --resume")
checks.that(code == 0 and "tiny-2" in out and "array" not in err, f"two displays again: {code} {out} {err}")
checks.that(times("two/tiny-2")["dof.json"] == before["dof.json"], "two displays: --resume measured again")

# Ctrl-C in the second display: the first is whole, the page says what is missing, and --resume goes on.
LONG_TWO = LONG.replace("fov,dof tiny.toml", "dof tiny.toml other.toml").replace("10,1000,0.1", "10,40,0.5").replace("-o cut", "-o cut_two")
process = program.start(f"analyze {LONG_TWO}")
for line in process.stderr:
    if (program.folder / "cut_two/tiny/report.html").exists():
        break
process.send_signal(signal.SIGINT)
process.communicate(timeout=60)
checks.that(process.returncode == 130, f"two displays interrupted: exit code {process.returncode}")
checks.that((program.folder / "cut_two/tiny/dof.json").exists() and not (program.folder / "cut_two/tiny-2/dof.json").exists(), "two displays interrupted: what is kept")
checks.that("The run was interrupted" in (program.folder / "cut_two/report.html").read_text(), "two displays interrupted: report")
checks.refused(program, "two displays in a folder of one", f"analyze {TWO.replace('-o two', '-o two/tiny')}", "holds the results of one display")

# Without MEASURE all are taken: told by what is refused of each.
code, out, err = analyze(f"tiny.toml --depths-mm 40,10,1 --model pyramid.obj -o none")
checks.that(code == 2 and "MEASURE" not in err and "--depths-mm" in err, f"no measure: {err}")
checks.refused(program, "a display that is not there", "analyze fov tiny.toml none.toml -o bad", "none.toml", "no such file")
checks.refused(program, "no display", "analyze fov -o bad", "DISPLAY.toml")

# Bad input writes nothing.
(program.folder / "file").write_text("")
(program.folder / "points.obj").write_text("v 0 0 0\nv 1 1 1\n")
for name, arguments, *words in [
    ("unknown measure", f"fog {QUICK} -o bad", "MEASURE", "fov"),
    ("no measure between commas", f"fov,,dof {QUICK} -o bad", "MEASURE"),
    ("angles beyond 80 degrees", f"fov {QUICK.replace('-30,30,10', '-81,81,1')} -o bad", "--angles-deg", "80"),
    ("angles that fall", f"fov {QUICK.replace('-30,30,10', '30,-30,1')} -o bad", "--angles-deg"),
    ("angles on one side", f"fov {QUICK.replace('-30,30,10', '5,30,5')} -o bad", "--angles-deg"),
    ("depth inside the lenses", f"dof {QUICK.replace('10,40,10', '-1,40,0.5')} -o bad", "--depths-mm", "inside the lenses"),
    ("described depth inside the lenses", f"fov {QUICK} --depth-mm -0.5 -o bad", "content.depth_mm", "inside the lenses"),
    ("two depths", f"dof {QUICK.replace('10,40,10', '10,40,30')} -o bad", "--depths-mm"),
    ("a step of nothing", f"dof {QUICK.replace('10,40,10', '10,40,0')} -o bad", "--depths-mm"),
    ("a model without surfaces", f"fov {QUICK.replace('pyramid', 'points')} -o bad", "points.obj"),
    ("a file for a folder", f"fov {QUICK} -o file", "file"),
    ("an empty output", ["fov", "tiny.toml", "-o", ""], "--output"),
    ("an eye distance of nothing", f"fov {QUICK} -o bad --eye-distance-mm 0", "--eye-distance-mm"),
    ("a viewing distance of words", f"fov {QUICK} -o bad --viewing-distance-mm far", "--viewing-distance-mm"),
]:
    arguments = arguments.split() if isinstance(arguments, str) else arguments
    checks.refused(program, name, ["analyze", *arguments], *words)
checks.finish()
