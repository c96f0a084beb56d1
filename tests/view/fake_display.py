"""Made-up displays, pictures and drawings that follow docs/view-protocol.md, so that the page can be tried without the program."""
import io
import json
import math

from PIL import Image, ImageChops, ImageDraw

# key, label, unit, value, low, high, form, words
KEYS = [
    ("panel.pixels", "pixels", "", [3840, 2160], 1, 8192, "pair", None),
    ("panel.pixel_pitch_mm", "pixel pitch", "mm", 0.13636, 0.034, 0.545, "number", None),
    ("panel.emission_exponent", "emission exponent", "", 0, 0, 10, "number", None),
    ("lens.type", "type", "", "surfaces", None, None, "word", ["plano_convex", "surfaces", "ideal"]),
    ("lens.stop_radius_mm", "stop radius", "mm", None, 0.5, 6, "number", None),
    ("lens.surface.0.index", "index", "", 1.4918, 1, 4, "number", None),
    ("lens.surface.1.curvature_per_mm", "curvature", "1/mm", -0.129517, -0.166, 0.166, "number", None),
    ("lens.surface.1.conic", "conic", "", -0.3635, -4, 4, "number", None),
    ("array.count", "count", "", [43, 24], 1, 100, "pair", None),
    ("array.pitch_mm", "pitch", "mm", 12.0, 12.0, 48.0, "number", None),
    ("array.gap_mm", "gap", "mm", 16.485, 3.1, 40.1, "number", None),
    ("array.aperture", "aperture", "", "circle", None, None, "word", ["circle", "cell"]),
    ("array.offset_mm", "offset", "mm", [0, 0], -24, 24, "pair", None),
    ("array.rotation_deg", "rotation", "degrees", 0, -360, 360, "number", None),
    ("diffuser.distance_mm", "distance", "mm", 329.9, 10, 1300, "number", None),
    ("diffuser.angle_deg", "angle", "degrees", [2.08, 2.08], 0, 90, "pair", None),
    ("diffuser.profile", "profile", "", "box", None, None, "word", ["box", "gaussian"]),
    ("camera.target_mm", "target", "mm", [0, 0, 0], -1000, 1000, "list", None),
    ("camera.pupil_diameter_mm", "pupil diameter", "mm", None, 1, 20, "number", None),
    ("content.depth_mm", "depth", "mm", 329.9, -600, 600, "number", None),
    ("content.viewing_distance_mm", "viewing distance", "mm", "infinite", 500, 8000, "number", None),
    ("render.samples", "samples", "", 4, 1, 100, "integer", None),
]


def parsed(text):
    if text == "none":
        return None
    try:
        return json.loads(text)
    except ValueError:
        return text


def display(overrides):
    """Values by key, and the problems."""
    values, problems = {k[0]: k[3] for k in KEYS}, []
    for override in overrides:
        key, _, text = override.partition("=")
        if key == "diffuser" and text == "none":  # the table as a whole
            values.update({k: None for k in values if k.startswith("diffuser.")})
            continue
        spec = next((k for k in KEYS if k[0] == key), None)
        value = parsed(text)
        if spec is None:
            problems.append({"key": key, "what": "there is no such key"})
        elif spec[6] == "word" and value not in spec[7]:
            problems.append({"key": key, "what": f"must be one of {', '.join(spec[7])}"})
        elif spec[6] != "word" and value is not None:
            numbers = value if isinstance(value, list) else [value]
            if not all(isinstance(x, (int, float)) and spec[4] <= x <= spec[5] for x in numbers):
                problems.append({"key": key, "what": f"must be {spec[4]} to {spec[5]}, not {text}"})
        values[key] = value
    return values, problems


def resolved(wanted, values):
    suggested = {"lens.stop_radius_mm": 4.7, "camera.pupil_diameter_mm": 4, "diffuser.distance_mm": 330, "diffuser.angle_deg": [2, 2]}
    controls = [{"key": key, "table": key.rpartition(".")[0], "label": label, "unit": unit, "value": values[key], "low": low, "high": high,
                 "step": 0.05, "form": form, "words": words or [], "doc": f"The {label}, made up.",
                 **({"suggested": suggested[key]} if values[key] is None and key in suggested else {}),
                 **({"absent": "none"} if key in ("lens.stop_radius_mm", "camera.pupil_diameter_mm") else {})}
                for key, label, unit, _, low, high, form, words in KEYS]
    gap = values["array.gap_mm"] or 1
    fov = 2 * math.degrees(math.atan(values["array.pitch_mm"] / 2 / gap))
    theory = [("fov_deg", "field of view", "degrees", fov), ("focal_length_mm", "focal length", "mm", 15.7),
              ("central_depth_mm", "central depth plane", "mm", "infinite" if gap < 15.7 else 1 / (1 / 15.7 - 1 / gap) if gap > 15.7 else None),
              ("views", "views", "", 88)]
    figures = [{"name": n, "label": label, "unit": unit, "value": value, "doc": label} for n, label, unit, value in theory]
    return {"type": "resolved", "id": wanted["id"], "name": "made-up", "controls": controls, "theory": figures, "geometry": figures[1:],
            "warnings": ["The diffuser is far from the central depth plane."] if gap > 20 else [],
            "command": "lfdsim render 'made up.toml'" + "".join(f" --set '{s}'" for s in wanted["set"]) +
                       f" --camera-mm {','.join(str(x) for x in wanted['eye_mm'])} -o view.png"}


def pattern():
    image = Image.new("RGB", (960, 540), "#20242c")
    draw = ImageDraw.Draw(image)
    for k in range(24):
        x, y, r = 40 * k + 20, 270 + 190 * math.sin(k), 18 + 3 * (k % 5)
        draw.ellipse((x - r, y - r, x + r, y + r), fill=(80 + 7 * k, 220 - 6 * k, 90 + (53 * k) % 160), outline="white")
    for x in range(0, 960, 48):
        draw.line((x, 0, x, 540), fill="#39404d")
    return image


PATTERN = pattern()


def picture(wanted, values, size, eye=0.0, truth=False):
    """The pattern, moved against the eye and stretched with the gap; a photograph's does not know the gap."""
    x, y, z = wanted["eye_mm"]
    distance = max(math.hypot(x, y, z), 1)
    zoom = 960 / size[0] * distance / 2000 * (1 if truth else 16.485 / (values["array.gap_mm"] or 1))
    dx, dy = 480 * ((x + eye) / distance), -480 * y / distance
    return PATTERN.transform(size, Image.AFFINE, (zoom, 0, 480 + dx - zoom * size[0] / 2, 0, zoom, 270 + dy - zoom * size[1] / 2), Image.BILINEAR)


def lanes(wanted, values, scale):
    """Name and picture, scaled down by a whole number."""
    size = tuple(max(1, n // scale) for n in wanted["size"])
    half = wanted["eye_distance_mm"] / 2
    eyes = {"one": [("one", 0)]}.get(wanted["layout"], [("left", -half), ("right", half)])
    all_lanes = [(lane, picture(wanted, values, size, eye)) for lane, eye in eyes]
    truth = picture(wanted, values, size, truth=True) if wanted["beside"] != "none" else None
    if wanted["beside"] == "photograph":
        all_lanes.append(("photograph", truth))
    if wanted["beside"] == "difference":
        all_lanes.append(("difference", ImageChops.difference(picture(wanted, values, size), truth)))
    return all_lanes


def encoded(image, quality):
    file = io.BytesIO()
    if quality == "final":
        image.save(file, "PNG", compress_level=1)
    else:
        image.save(file, "JPEG", quality=80)
    return ("png" if quality == "final" else "jpeg"), file.getvalue()


def drawing(title, wanted):
    z = wanted["eye_mm"][2]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="960" height="320" viewBox="0 0 960 320" role="img" aria-label="{title}" '
            'font-family="system-ui" font-size="13" fill="none" style="color:#1c1c1c;background:#fff" onload="window.attacked = 1">'
            '<script>window.attacked = 2</script><path d="M72 60V260M120 60V260M888 160H72" stroke="currentColor"/>'
            f'<text x="80" y="30" fill="currentColor">{title}, eye at {z:.0f} mm</text></svg>')


def answer(wanted, values, ask):
    what, name = ask["what"], ask.get("name", "")
    reply = {"type": "answer", "id": ask["id"], "what": what, "problems": []}
    if what == "probe":
        x, y = ask["at"]
        high, eye = 150 - 300 * y, wanted["eye_mm"]
        reply.update(lens=[int(43 * x), int(24 * y)], panel_pixel=[int(3840 * x), int(2160 * y)], panel_mm=[0, 0],
                     says=f"Lens {int(43 * x)}, {int(24 * y)} shows panel pixel {int(3840 * x)}, {int(2160 * y)}.",
                     fan=[[[eye[1], eye[2]], [high, 350], [high + k, 20], [high + 2 * k, 0]] for k in (-8, 0, 8)])
    elif what == "side":
        reply.update(svg=drawing(name, wanted), frame={"y_low": -200, "y_high": 200, "z_low": 0, "z_high": max(wanted["eye_mm"][2], 1),
                                                       "box": [72, 60, 816, 200]})
    elif what == "plot":
        reply.update(svg=drawing(name, wanted))
    elif what == "files":
        reply.update(displays=["a.toml", "below/b.toml"], models=["monkey.blend"], pictures=["eia.png"])
    elif what == "toml":
        reply.update(text="schema = 1\n# made up\n" + "\n".join(wanted["set"]) + "\n")
    elif what == "save":
        if not name.endswith(".toml"):
            reply["problems"] = [{"key": "name", "what": "must end in .toml"}]
        reply.update(name=name)
    return reply
