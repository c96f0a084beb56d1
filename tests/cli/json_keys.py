"""Every key that --json prints stands in the documents."""
import json
import pathlib
import re

from program import Checks, Program

program, checks = Program(), Checks()
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
documented = set(re.findall(r"\w+", "\n".join(page.read_text() for page in DOCS.glob("*.md"))))
# All that has keys of its own: subpixels, dispersing glass, errors of lenses
COLOURED = """--set panel.subpixels="rgb_stripe" lens.index=none lens.glass=PMMA errors.decenter_sd_mm=0.001"""
FIT = "--set content.inverse.eyes_mm=[[-10,0,400],[10,0,400]] content.inverse.rays=4 content.inverse.iterations=1"
MEASURES = "components,fov,dof,zone,crosstalk,mtf,uniformity,moire,spot"


def undocumented(found, path=""):
    """Paths of keys of which no document has the name. As docs/json.md says, errors and theory belong to their figure, and figures per degree to those
    per mm; keys of `notes` are paths of figures."""
    if isinstance(found, dict):
        for key, inner in found.items():
            of_figure = re.sub("_per_deg$", "_per_mm", key.removesuffix("_error").removeprefix("theory_"))
            if not {key, of_figure} & documented:
                yield f"{path}.{key}"
            if key != "notes":
                yield from undocumented(inner, f"{path}.{key}")
    elif isinstance(found, list):
        for inner in found:
            yield from undocumented(inner, path)


for name, arguments in [
    ("check", f"check tiny.toml --json {COLOURED}"),
    ("render", f"render tiny.toml --model pyramid.obj --pickup inverse --target-error 0.1 -o view.png --progress none --json {FIT} {COLOURED}"),
    ("eia", f"eia tiny.toml --model pyramid.obj --pickup inverse -o eia.png --progress none --json {FIT}"),
    ("photo", "photo tiny.toml --model pyramid.obj -o photo.png --progress none --json"),
    ("views", "views tiny.toml --model pyramid.obj -o tiny_qs2x1a1.8.png --progress none --json"),
    ("analyze", f"analyze {MEASURES} tiny.toml --model pyramid.obj --size 32x18 --angles-deg=-20,20,20 --depths-mm=0,20,10 --progress none -o out --json {COLOURED}"),
]:
    missing = sorted(set(undocumented(json.loads(program.must(arguments)), name)))
    checks.that(not missing, f"not in docs/: {missing}")
checks.finish()
