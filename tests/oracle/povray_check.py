#!/usr/bin/python3
"""Lays this folder's tracer over POV-Ray's constructive solid geometry: povray_check.py [NAME_PART]. Needs the program povray; run by hand.

Differences are listed, those away from edges by pixel. POV-Ray follows total internal reflection and meets neighbouring lenses
also in an opaque sheet, where the model absorbs and ignores them; rays for which ours says TOTAL are left out. It needs air or an overlap
between bodies, so glued lenses are left out.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

import cases
import colour
import lattice_cases
import tracer
from display import resolve
from lattice import Lattice
from path import TOTAL
from run import address_of, panel_images

SCALE = 10   # POV-Ray units per mm: it drops hits nearer than 0.001 unit
GAP = 1e-3   # mm kept between bodies that would touch, or by which they overlap
FAR = 1e3    # mm: the half length of strips
CLEAR = "pigment{rgbt 1} finish{ambient 0 diffuse 0}"


def body(d, lower, upper, x, y):
    """One glass body: between two conics c (s^2 + (1 + k) z^2) - 2 z = 0 (z from the vertex), inside a cylinder or strip and, where lenses fill them, a cell.

    For a plate only the caps that bulge out of the sheet (box) are made, down to the sheet's middle, so that no faces coincide. Its cells overlap:
    touching faces would be seen.
    """
    low, high = min(lower.z_min, lower.z_rim) - 0.01, max(upper.z_max, upper.z_rim) + 0.01
    faces = [_conic(lower, x, y), f"object{{{_conic(upper, x, y)} inverse}}"]
    grow = 0.0
    if d.array.surround == "plate":
        middle = (lower.z_rim + upper.z_rim) / 2
        caps = [(faces[0], low, middle)] * (lower.c > 0) + [(faces[1], middle, high)] * (upper.c < 0)
        grow = GAP
    else:
        caps = [(" ".join(faces), low, high)]
        grow = -GAP if d.array.surround == "clear" else 0.0
    return " ".join(f"intersection{{{_column(d, x, y, a, b, lower.semi, grow)} {shape}}}" for shape, a, b in caps)


def _column(d, x, y, low, high, semi, grow):
    """The space over a lens's aperture between two heights: a cylinder or strip and, where lenses fill it, the cell, with sides moved out by `grow`."""
    if d.strips:
        parts = [f"box{{<{x - semi},{-FAR},{low}>,<{x + semi},{FAR},{high}>}}"]
    else:
        parts = [f"cylinder{{<{x},{y},{low}>,<{x},{y},{high}>,{semi}}}"]
    for n, half in zip(d.cell.normals, d.cell.half) if d.fills_cell else ():
        angle = np.degrees(np.arctan2(n[1], n[0]))
        parts.append(f"box{{<{-half - grow},{-FAR},{low}>,<{half + grow},{FAR},{high}> rotate z*{angle} translate <{x},{y},0>}}")
    return " ".join(parts)


def _conic(s, x, y):
    """The space above a surface. Spheres and cylinders as such: POV-Ray's quadrics lose rays that start on one."""
    if s.k == 0 and s.c:
        z, out = s.z + 1 / s.c, " inverse" if s.c < 0 else ""
        if s.across[1]:
            return f"sphere{{<{x},{y},{z}>,{abs(1 / s.c)}{out}}}"
        return f"cylinder{{<{x},{-FAR},{z}>,<{x},{FAR},{z}>,{abs(1 / s.c)}{out}}}"
    return f"quadric{{<{s.c},{s.c * s.across[1]},{s.c * (1 + s.k)}>,<0,0,0>,<0,0,-2>,0 translate <{x},{y},{s.z}>}}"


def plates(d):
    """The layers: each a box down to below the panel, the lower ones inside the upper ones."""
    out, top = [], 0.0
    for number, (thickness, index) in enumerate(d.layers):
        top, reach = top + thickness, 1e4 + number
        out.append(f"box{{<{-reach},{-reach},{-1 - number}>,<{reach},{reach},{top}> {CLEAR} interior{{ior {index}}}}}")
    return out


def scene(d, panel):
    i, j = (k.ravel() for k in np.meshgrid(np.arange(d.array.count[0]), np.arange(d.array.count[1])))
    axes = Lattice(d).axis(i, j)[:, :2]
    surfaces, surround = d.surfaces, d.array.surround
    parts = []
    for lower, upper in zip(surfaces, surfaces[1:]):
        if lower.n_above == 1:
            continue
        bodies = [body(d, lower, upper, x, y) for x, y in axes]
        if surround == "plate":
            bodies.append(f"box{{<-1e4,-1e4,{lower.z_rim}>,<1e4,1e4,{upper.z_rim}>}}")
        parts.append(f"{'merge' if surround == 'plate' else 'union'}{{{' '.join(bodies)} {CLEAR} interior{{ior {lower.n_above}}}}}")
    if surround == "opaque":
        floor, ceiling = min(s.z_rim for s in surfaces), max(s.z_rim for s in surfaces)
        holes = [f"intersection{{{_column(d, x, y, floor - 1, ceiling + 1, surfaces[-1].semi - GAP, -GAP)}}}" for x, y in axes]
        parts.append(f"difference{{box{{<-1e4,-1e4,{floor}>,<1e4,1e4,{ceiling}>}} union{{{' '.join(holes)}}} pigment{{rgb 0}} finish{{ambient 0 diffuse 0}}}}")
    m, (ox, oy) = Lattice(d).turn, d.array.offset_mm
    turn = f"matrix<{m[0, 0]},{m[1, 0]},0,{m[0, 1]},{m[1, 1]},0,0,0,1,{ox},{oy},0>"
    (columns, rows), pitch, camera = d.panel.pixels, d.panel.pixel_pitch_mm, d.camera
    w, h = columns * pitch, rows * pitch
    corners = tracer.camera_rays(d, np.array([camera.resolution[0] / 2, camera.resolution[0], camera.resolution[0] / 2]), np.array([camera.resolution[1] / 2] * 2 + [0]))[1]
    ahead = corners[0]
    right, up = (2 * (c / (c @ ahead) - ahead) for c in corners[1:])
    vector = lambda v: "<" + ",".join(f"{x:.15g}" for x in v) + ">"
    return f"""#version 3.7; global_settings{{assumed_gamma 1.0 max_trace_level {17 + len(d.layers)} adc_bailout 0}} background{{rgb 0}}
camera{{location {vector(np.array(camera.position_mm) * SCALE)} direction {vector(ahead)} right {vector(right)} up {vector(up)}}}
union{{
plane{{z,0 pigment{{image_map{{png "{panel}" gamma 1.0 map_type 0 once}} scale <{w},{h},1> translate <{-w / 2},{-h / 2},0>}} finish{{ambient 0 diffuse 0 emission 1}}}}
union{{{' '.join(parts)} {turn}}}
{' '.join(plates(d))}
scale {SCALE}}}
"""


def picture(d, image):
    """POV-Ray's picture as uint8 codes (rows, columns, 3)."""
    width, height = d.camera.resolution
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        Image.fromarray(image).save(folder / "panel.png", compress_level=1)
        (folder / "scene.pov").write_text(scene(d, folder / "panel.png"))
        done = subprocess.run(["povray", f"+I{folder}/scene.pov", f"+O{folder}/out.png", f"+W{width}", f"+H{height}", "-D", "-A", "File_Gamma=1.0", "+FN8", "-GA"],
                              capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr[-2000:])
        return np.asarray(Image.open(folder / "out.png").convert("RGB"))


def compare(name, description):
    d = resolve(address_of(description))
    if d.ideal or d.stop_radius or any(any(s.even) for s in d.surfaces) or len({s.semi for s in d.surfaces}) > 1 or d.array.count[0] > 100:
        return
    if d.glued or any(s.n_below != 1 and s.n_above != 1 for s in d.surfaces):
        return  # glued on, or cemented
    image = panel_images(*d.panel.pixels)["address"]
    x, y = tracer.centers(d)
    hits = tracer.trace(d, *tracer.camera_rays(d, x, y))
    ours = np.rint(255 * colour.shade(d, [(np.ones(3), hits)], image / 255.0)).astype(int)
    differs = (picture(d, image).reshape(-1, 3) != ours).any(axis=1) & (hits.status != TOTAL)
    odd = np.flatnonzero(differs)
    if len(odd):
        odd = odd[~colour.near_edge(d, image / 255.0, x[odd], y[odd], spokes=16, rings=3).any(axis=1)]
    print(f"{name}: {differs.sum()} of {len(x)} differ, {len(odd)} off the edges", [(int(x[k]), int(y[k]), int(hits.status[k]), int(hits.met[k])) for k in odd[:6]], flush=True)


if __name__ == "__main__":
    for title, text in {**cases.SHARP, **lattice_cases.SHORT, **lattice_cases.MORE}.items():
        if all(part in title for part in sys.argv[1:]):
            compare(title, text)
