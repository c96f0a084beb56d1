#!/usr/bin/python3
"""What `lfdsim export pov` writes, rendered by POV-Ray, against lfdsim's own picture: povray.py LFDSIM [--full] [--only TEXT] [--triangles N].

The displays of tests/oracle/cases.py, lattice_cases.py, some of colour_cases.py and, below, displays with errors, each seen once a pixel. Away from edges all
pixels agree within 1/255 (an edge is where the exact picture changes within 0.02 pixels: tests/oracle/README.md). The panel shows addresses, so that a wrong panel pixel is a wrong colour. Displays whose glass disperses are exported one channel
at a time, of a panel with noise, and each is held against that channel of lfdsim's picture of the display. Skipped without the program povray.
"""
import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib

import numpy as np
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "oracle"))
import cases  # noqa: E402
import colour  # noqa: E402
import colour_cases  # noqa: E402
import errors_cases  # noqa: E402
import lattice_cases  # noqa: E402
import tracer  # noqa: E402
from display import resolve  # noqa: E402
from run import Harness, panel_images  # noqa: E402

TOLERANCE = 1 / 255 + 1e-5
QUICK = ("opaque circle, on axis", "opaque circle, 15 degrees", "opaque circle, rotated", "opaque square, 15", "clear circle, 30", "plate circle, 45", "asphere, 15", "cemented", "spaced",
         "hexagon lattice, opaque cell, 30", "hexagon lattice, clear cell, rotated", "brick lattice, glued onto a layer, plate cell",
         "slanted strips, opaque cell, on axis", "strips slanted to the left, plate cell", "three layers, clear", "glued onto two layers, clear", "pinhole, hexagon",
         "subpixels rgb_stripe, on axis", "subpixels delta, clear", "errors, wedge", "errors of all kinds, hexagons over a layer")

# Lenses apart, whose edges have heights in common: of others POV-Ray's scenes deviate, or there are none.
APART = {"pitch_mm": 8.8}
TALL = {**cases.SPHERE, "cylinder_height_mm": 2.0}
EACH = {"dx_mm": 0.21, "dy_mm": 0.21, "dz_mm": 0.2, "tilt_x_deg": 1.3, "tilt_y_deg": 1.3, "curvature": 0.035}
KINDS = {"decentres": ("dx_mm", "dy_mm"), "heights": ("dz_mm",), "tilts": ("tilt_x_deg", "tilt_y_deg"), "curvatures": ("curvature",)}
OF_ARRAY = {**errors_cases.OF_ARRAY, "bow_mm": 0.2}
WEDGE = {key: value for key, value in errors_cases.OF_ARRAY.items() if key != "bow_mm"}  # lenses all stand alike
DRAWN = {"decenter_sd_mm": 0.08, "height_sd_mm": 0.06, "tilt_sd_deg": 0.5, "curvature_sd": 0.01, "seed": 11}
made, wrong = lattice_cases.made, errors_cases.wrong


def lattice(name, **array):
    return {**lattice_cases.lattice(name, 8.8), **array}


ERRORS = {
    "errors, wedge, opaque circle, rotated and offset, oblique": wrong(made(cases.SPHERE, view=cases.OBLIQUE, array=cases.TILTED), WEDGE),
    "errors, wedge, plate circle over a layer, 15 degrees": wrong(made(cases.SPHERE, "plate", view=(15,), panel=lattice_cases.layers(lattice_cases.GLASS)), WEDGE),
    **{f"errors, {kind}, opaque circle, 15 degrees": wrong(made(TALL, view=(15,), array=APART, render=cases.EXACT), each={key: EACH[key] for key in keys})
       for kind, keys in KINDS.items()},
    "errors, bow, opaque circle, 30 degrees": wrong(made(TALL, view=(30,), array=APART), {"bow_mm": 0.3}),
    "errors of all kinds, opaque circle, rotated and offset, oblique": wrong(made(TALL, view=cases.OBLIQUE, array={**APART, **cases.TILTED}, render=cases.EXACT), OF_ARRAY, EACH),
    "errors of all kinds, hexagons over a layer, 15 degrees": wrong(made(TALL, view=(15,), array=lattice("hexagon"), panel=lattice_cases.layers(lattice_cases.GLASS)), OF_ARRAY, EACH),
    "errors of all kinds, slanted strips, 30 degrees": wrong(made(TALL, view=(30,), array=lattice("strips", slant_deg=9.46)), OF_ARRAY, EACH),
    "errors of caps, plate circle, bow, 15 degrees": wrong(made(cases.SPHERE, "plate", view=(15,)), {"bow_mm": 0.3}, errors_cases.CAPS),
    "errors of caps, biconvex plate, hexagons, rotated and offset, oblique": wrong(made(cases.CONICS, "plate", view=cases.OBLIQUE, array={**lattice_cases.HEXAGON, **cases.TILTED}), OF_ARRAY,
        errors_cases.CAPS),
    "errors of decentres, pinholes, hexagons over a layer, oblique": wrong(made(lattice_cases.PINHOLE, view=cases.OBLIQUE, array=lattice_cases.HEXAGON,
        panel=lattice_cases.layers(lattice_cases.GLASS)), each=errors_cases.LATERAL),
    "errors of caps, plate circle, stop, 15 degrees": wrong(made({**cases.SPHERE, "stop_radius_mm": 2.0}, "plate", view=(15,)), each={**errors_cases.LATERAL, "curvature": 0.03}),
    "errors of caps, plate cell, panel facing, 30 degrees": errors_cases.MORE["errors of caps, plate cell, panel facing, 30 degrees"],
    "errors drawn and by table, slanted strips, plate": errors_cases.SHORT["errors drawn and by table, slanted strips, plate"],
    "errors of caps, a glued plate, hexagon cell, oblique": wrong(made(cases.ROUNDER, "plate", "cell", cases.OBLIQUE, {**lattice_cases.HEXAGON, **lattice_cases.on_top(lattice_cases.THICK)},
        panel=lattice_cases.layers(lattice_cases.THICK)), errors_cases.LEVEL, errors_cases.FLAT),
    "errors of lenses glued onto layers, apart, 20 degrees": wrong(made(lattice_cases.SPHERE_TALL, view=(20,), array={**APART, **lattice_cases.on_top(lattice_cases.THICK)},
        panel=lattice_cases.layers(lattice_cases.THICK), render=cases.EXACT), errors_cases.LEVEL, errors_cases.FLAT),
    "errors of all kinds, cemented doublets, oblique": wrong(made(cases.CEMENTED, view=cases.OBLIQUE, array=APART, render=cases.EXACT), OF_ARRAY, EACH),
    "errors of all kinds, hollow conics, strips, 30 degrees": wrong(made(cases.MENISCUS, view=(30,), array=lattice("strips", slant_deg=-23.0)), OF_ARRAY, EACH),
    "errors of all kinds, aspheres, bricks, stop, 15 degrees": wrong(made({**cases.ASPHERE, "stop_radius_mm": 2.1}, view=(15,), array=lattice("brick")), WEDGE,
        {**errors_cases.LATERAL, "tilt_x_deg": 1.3, "tilt_y_deg": 1.3, "curvature": 0.03}),
    "errors of all kinds, hexagons of 4 x 3, past the border": wrong(made(TALL, view=(30, 20), array=lattice("hexagon", count=[4, 3]), **lattice_cases.PAST_BORDER), WEDGE, EACH),
    "errors drawn, opaque circle, oblique": wrong(made(TALL, view=cases.OBLIQUE, array=APART), DRAWN),
    "errors drawn and by table, bricks, 15 degrees": wrong(made(TALL, view=(15,), array=lattice("brick")), DRAWN, {"dx_mm": 0.05, "tilt_y_deg": 0.5}, share=0.5),
}
# Lenses that reach into each other: as POV-Ray's scenes say, a few rays there have another way.
OVERLAPPING = {
    "errors of lenses glued onto layers, opaque circle, 20 degrees": errors_cases.SHORT["errors of lenses glued onto layers, opaque circle, 20 degrees"],
    "errors of all kinds, slanted strips, opaque cell, 30 degrees": errors_cases.SHORT["errors of all kinds, slanted strips, opaque cell, 30 degrees"],
    "errors of lenses glued onto the bare panel, opaque cell": errors_cases.MORE["errors of lenses glued onto the bare panel, opaque cell"],
    "errors of decentres and curvatures, opaque square, 30 degrees": wrong(made(cases.ROUNDER, "opaque", "cell", (30,)), each=errors_cases.FLAT),
    "errors of all kinds, hexagons, opaque cell, oblique": wrong(made({**cases.ROUNDER, "cylinder_height_mm": 2.0}, "opaque", "cell", cases.OBLIQUE, lattice_cases.HEXAGON), OF_ARRAY, EACH),
}
OF_OVERLAPPING = 0.01  # of all pixels, off the edges
CHANNELS = {"glass of Sellmeier, opaque, oblique": "r", "glass by name, asphere, gap, subpixels delta, hexagons": "b"}  # where time is short


def refusal(d, meshed):
    """A word of the message with which the export refuses a display, None where it must not."""
    if d["lens"]["type"] == "ideal":
        return "an ideal lens"
    if d["panel"].get("emission_exponent"):
        return "Lambertian"
    if meshed and d["lens"]["type"] == "pinhole":
        return "a pinhole"
    if meshed and {"table", "bow_mm", "decenter_sd_mm"} & set(d.get("errors", {})):
        return "those of one lens"
    filled, surround = d["array"].get("aperture") == "cell", d["array"].get("surround")
    return {"clear": "no defined order", "plate": "as triangles"}.get(surround) if filled and meshed else None


def whole(description):
    """Without a black matrix, whose borders finer pixels would round, and of one wavelength a channel."""
    return cases.merge(description, {"panel": {"aperture_ratio": 1.0, "encoding": "linear"}, "render": {"wavelength_samples": 1}})


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=600)
    return done.returncode, done.stdout + done.stderr


def pictures(program, description, image, folder, options):
    """POV-Ray's picture and lfdsim's, (rows, columns, 3); or the message of an export that was refused."""
    cases.write(folder, description).rename(folder / "given.toml")
    Image.fromarray(image).save(folder / "given.png", compress_level=1)
    code, said = run([program, "export", "pov", "given.toml", "--panel-image", "given.png", *options, "-o", "scene", "--json"], folder)
    if code:
        return said
    scene = folder / "scene"
    width, height = description["camera"]["resolution"]
    command = f"povray +Iscene.pov +Oview.png +W{width} +H{height} -D -A +FN16 File_Gamma=1.0"
    assert f'"command": "{command}"' in said, said
    code, said = run(shlex.split(command.replace("+FN16", "+FN8")), scene)  # 8 bits hold all addresses
    if code:
        return "povray: " + said[-1500:]
    code, said = run([program, "render", "display.toml", "--panel-image", "panel.png", "-o", "lfdsim.npy"], scene)
    assert code == 0, said
    return np.asarray(Image.open(scene / "view.png").convert("RGB")) / 255, np.load(scene / "lfdsim.npy").astype(float)


def check_channel(program, description, channel):
    """The same of one channel's scene, against the picture of the display itself, whose colours part."""
    image = panel_images(*description["panel"]["pixels"])["noise"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        got = pictures(program, description, image, folder, ["--channel", channel])
        if isinstance(got, str):
            return False, got.strip()
        scene = tomllib.loads((folder / "scene/display.toml").read_text())
        dimmed = [float(word) for word in re.findall(r"light is ([0-9.]+) times", (folder / "scene/README.txt").read_text())] or [1.0]
        code, said = run([program, "render", "given.toml", "--panel-image", "given.png", "--estimator", "point", "--set", f"render.fresnel={scene['render']['fresnel']}",
                          "-o", "all.npy"], folder)
        assert code == 0, said
        ours = np.load(folder / "all.npy").astype(float) * dimmed[0]
    k = "rgb".index(channel)
    povs, alone = (picture.reshape(-1, 3) for picture in got)
    ours = ours.reshape(-1, 3)
    others = [c for c in range(3) if c != k]
    if povs[:, others].any() or alone[:, others].any():
        return False, "another channel shines, too"
    differs = np.flatnonzero(np.abs(povs[:, k] - ours[:, k]) > TOLERANCE)
    odd = differs
    if len(odd):
        display = resolve(description)
        x, y = tracer.centers(display)
        odd = odd[~colour.near_edge(display, image / 255, x[odd], y[odd], spokes=48, rings=5)[:, k]]
    lit = (ours[:, k] > 0).mean()
    return not len(odd) and lit > 0.01, f"{100 * lit:.0f} % lit, {len(differs)} of {len(ours)} pixels differ, {len(odd)} off the edges"


def check(program, name, description, options):
    """(good, what was found) of one display; good is None where it is refused as it should be."""
    refused = refusal(description, bool(options))
    # Light takes the same ways whatever Fresnel's weights; where POV-Ray has none the picture is made without.
    description = cases.merge(description, {"panel": {"encoding": "linear"}})
    image = panel_images(*description["panel"]["pixels"])["address"]
    with tempfile.TemporaryDirectory() as folder:
        got = pictures(program, description, image, pathlib.Path(folder), options)
        told = Harness(program, pathlib.Path(folder), "").told(description)  # of drawn errors the tracer needs the numbers
    if isinstance(got, str):
        return (None if refused and refused in got else False), got.strip()
    if refused:
        return False, f"was not refused with {refused!r}"
    if options:
        return check_meshed(name, *got)
    povs, ours = (picture.reshape(-1, 3) for picture in got)
    wrong = np.abs(povs - ours) > TOLERANCE
    differs = np.flatnonzero(wrong.any(axis=1))
    odd = differs
    if len(odd):
        display = resolve(told)
        x, y = tracer.centers(display)
        odd = odd[(wrong[odd] & ~colour.near_edge(display, image / 255, x[odd], y[odd], spokes=48, rings=5)).any(axis=1)]
    places = [(int(k) % description["camera"]["resolution"][0], int(k) // description["camera"]["resolution"][0]) for k in odd[:5]]
    lit = (ours.max(axis=1) > 0).mean()
    most = OF_OVERLAPPING * len(ours) if name in OVERLAPPING else 0
    return len(odd) <= most and lit > 0.01, f"{100 * lit:.0f} % lit, {len(differs)} of {len(ours)} pixels differ, {len(odd)} off the edges {places if len(odd) else ''}"


def address(picture):
    """The panel pixel (2, rows, columns) that each pixel shows."""
    code = np.rint(255 * picture).astype(int)
    return np.stack([code[:, :, 0] * 16 + code[:, :, 2] // 16, code[:, :, 1] * 16 + code[:, :, 2] % 16])


def check_meshed(name, povs, ours):
    """Many triangles with smooth normals: nearly all rays meet the right panel pixel or the next one."""
    lit, of_ours = povs.max(axis=2) > 0, ours.max(axis=2) > 0
    near = (np.abs(address(povs) - address(ours)).max(axis=0) <= 1)[lit & of_ours].mean()
    grazing = "75 degrees" in name
    found = f"{100 * near:.2f} % within one panel pixel, {100 * (lit != of_ours).mean():.2f} % lit in one picture alone"
    return near >= (0.9 if grazing else 0.985) and (lit != of_ours).mean() < 0.005, found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--full", action="store_true", help="all displays, not a few")
    parser.add_argument("--only", default="", help="displays whose name holds this text")
    parser.add_argument("--triangles", help="meshed lenses with smooth normals: judged less strictly")
    options = parser.parse_args()
    if not shutil.which("povray"):
        print("SKIPPED: the program povray is not installed (Debian: povray)")
        sys.exit(77)
    program, wrong, done = os.path.abspath(options.program), 0, 0
    # Where subpixels are shrunk, or of odd sizes, finer pixels round their borders.
    coloured = {name: case for name, case in colour_cases.SHORT.items() if name.startswith("subpixels") and ", q " not in name}
    glassy = {name: case for name, case in {**colour_cases.SHORT, **colour_cases.MORE}.items() if name.startswith("glass") and "odd cell" not in name and not refusal(case, False)}
    for name, description in {**cases.SHARP, **lattice_cases.SHORT, **lattice_cases.MORE, **coloured, **ERRORS, **OVERLAPPING}.items():
        if options.only not in name or not (options.full or options.only or any(name.startswith(part) for part in QUICK)):
            continue
        columns, rows = description["array"].get("count", [0, 0])
        if columns * rows > (1_000_000 if options.full else 10_000):  # one display of a million lenses is enough: POV-Ray needs gigabytes for them
            continue
        over = {"render": {"fresnel": "none"}} if options.triangles else {}  # colours tell addresses
        description = cases.merge(description, {"camera": {"resolution": [192, 108] if options.full else [96, 54]}, **over})
        good, found = check(program, name, description, ["--triangles", options.triangles, "--normals", "smooth"] if options.triangles else [])
        wrong, done = wrong + (good is False), done + 1
        print({True: "pass   ", None: "refused", False: "FAIL   "}[good], name + ":", found, flush=True)
    for name, description in {} if options.triangles else glassy.items():
        channels = "rgb" if options.full or options.only else CHANNELS.get(name, "")
        for channel in channels if options.only in name else "":
            size = [192, 108] if options.full else [96, 54]
            good, found = check_channel(program, cases.merge(whole(description), {"camera": {"resolution": size}}), channel)
            wrong, done = wrong + (not good), done + 1
            print({True: "pass   ", False: "FAIL   "}[good], f"{name}, channel {channel}:", found, flush=True)
    print(f"{done} displays, {wrong} failed")
    sys.exit(1 if wrong or not done else 0)


if __name__ == "__main__":
    main()
