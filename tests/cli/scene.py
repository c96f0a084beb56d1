"""Scenes of objects: shown by every command, replaced by --model, named by what is wrong with them."""
import json
import pathlib

import numpy as np

from program import TINY, Checks, Program

program, checks = Program(), Checks()
(program.folder / "things").mkdir()
(program.folder / "things/pyramid.obj").write_text((program.folder / "pyramid.obj").read_text())
program.must("photo tiny.toml -o things/picture.png")
scene = TINY.replace("depth_mm = 20.0\nheight_mm = 18.0\n", "") + """
[content.light]
direction = [0.0, 1.0, 1.0]
[[content.object]]
image = "picture.png"
width_mm = 30.0
position_mm = [0.0, 0.0, -20.0]
[[content.object]]
model = "pyramid.obj"
height_mm = 12.0
position_mm = [4.0, 0.0, 10.0]
colour = [1.0, 0.5, 0.0]
"""
(program.folder / "things/scene.toml").write_text(scene)


def shown(command):
    program.must(f"{command} -o shown.npy")
    return np.load(program.folder / "shown.npy")


there = shown("photo things/scene.toml")
checks.that(there.max() > 0.2 and (there[..., 0] > 1.5 * there[..., 2] + 0.05).any(), "the orange pyramid is not seen")
without = shown("photo things/scene.toml --set content.object.1.position_mm=[100,0,10]")
checks.that((there != without).any(), "an override moves no object")
# The whole scene moves together, and stands as described where no depth is given.
checks.that((shown("photo things/scene.toml --depth-mm -5") == there).all(), "the middle of -20 and 10 is not -5")
checks.that((shown("photo things/scene.toml --depth-mm 30") != there).any(), "--depth-mm moves nothing")
checks.that((shown("photo things/scene.toml --yaw-deg 30 --height-mm 9") != there).any(), "--yaw-deg and --height-mm do nothing")
eia = shown("eia things/scene.toml")
checks.that(eia.max() > 0.2, "elemental images are dark")
checks.that((shown("eia things/scene.toml --threads 1") == eia).all(), "threads change elemental images")
# A saved picture has its description with it, which shows the same where it is read.
program.must("photo things/scene.toml -o pictured.png")
described = program.must("check things/scene.toml")
checks.that("[[content.object]]" in described or "content.object.0" in described, "check does not list the objects")
# --model takes the objects' place.
plain = TINY.replace("depth_mm = 20.0\nheight_mm = 18.0\n", "")
(program.folder / "plain.toml").write_text(plain + "[content.light]\ndirection = [0.0, 1.0, 1.0]\n")
same = shown("photo things/scene.toml --model pyramid.obj") == shown("photo plain.toml --model pyramid.obj")
checks.that(same.all(), "--model does not replace the objects")
# A measure shows the scene; a file that changes makes a result another's.
QUICK = "--size 48x27 --depths-mm 10,40,10"
program.must(f"analyze dof things/scene.toml {QUICK} -o measured")
checks.that(json.loads((program.folder / "measured/dof.json").read_text()), "dof.json is empty")
program.must(f"analyze dof things/scene.toml {QUICK} --resume -o measured")
picture = program.folder / "things/picture.png"
picture.write_bytes((program.folder / "panel.png").read_bytes())
checks.refused(program, "results of another picture", f"analyze dof things/scene.toml {QUICK} --resume -o measured", "measured")
# What is wrong is named, and nothing is written.
for name, change, words in [
        ("missing image", ('"picture.png"', '"none.png"'), ["none.png", "no such picture file"]),
        ("image that is none", ('"picture.png"', '"scene.toml"'), ["scene.toml", "cannot be read as a picture"]),
        ("missing model", ('"pyramid.obj"', '"none.obj"'), ["none.obj", "no such model file"]),
        ("two sizes", ("width_mm = 30.0", "width_mm = 30.0\nheight_mm = 3.0"), ["content.object.0.width_mm", "only size"]),
        ("no size", ("width_mm = 30.0", ""), ["content.object.0.height_mm", "is missing"]),
        ("a model, too", ("[content.light]", "model = \"a.obj\"\n[content.light]"), ["content.model", "make the model an object"]),
        ("too many", ("[content.light]", "[content.light]\n" + "[[content.object]]\nmodel = \"a.obj\"\nheight_mm = 1\n" * 80), ["64"]),
        ("misspelt key", ("colour", "color"), ["color", "did you mean colour"])]:
    text = scene.replace("[render]\nsamples = 16\n", "").replace(*change)
    (program.folder / "things/bad.toml").write_text(text)
    for word in words:
        checks.refused(program, name, "photo things/bad.toml -o out.png", word)
checks.that(not (program.folder / "out.png").exists(), "a picture of a bad scene")
checks.refused(program, "output over an image", "photo things/scene.toml -o things/picture.png", "picture.png")
# The example that ships.
example = pathlib.Path(__file__).resolve().parents[2] / "examples/scene.toml"
said = program.must(f"check {example}")
checks.that("cannot be shown" not in said, said)
checks.finish()
