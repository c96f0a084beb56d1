"""The cases of bits.py: what lfdsim is run with. A case's name says what it shows; `bits.py --only NAME --commands` prints its command line.

Pictures are small and of a few lenses, so that each takes some ten milliseconds. All panels show the same noise.
"""
import copy
import dataclasses
import pathlib
import random
import shlex

ROOT = pathlib.Path(__file__).resolve().parents[2]
READY = sorted(file.stem for file in (ROOT / "displays").glob("*.toml"))
MEASURES = ("components", "directions", "fov", "dof", "zone", "crosstalk", "mtf", "uniformity", "moire", "spot")
EMBREE = ("fov", "dof", "components", "directions")  # measures that show a model, whose rays Embree traces


@dataclasses.dataclass
class Case:
    kind: str                   # the file that keeps it: pictures, data, or of text/ help, check, messages
    name: str
    words: list                 # the command line; DISPLAY stands for the description, FOLDER for where results go
    display: object = None      # a ready display's name, or a description as a dictionary
    panel: tuple = ()           # the size of the noise that the panel shows
    quick: bool = True          # part of --quick
    embree: bool = False        # its last bits depend on the processor, which Embree picks its code by


def written(value):
    """A value in TOML, all tables inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {written(v)}" for key, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(written, value)) + "]"
    return str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else repr(value)


def toml(description):
    return "".join(f"{key} = {written(value)}\n" for key, value in description.items())


def changed(description, changes):
    """The description with other values: {"array.pitch_mm": 8}; None removes a key or table."""
    new = copy.deepcopy(description)
    for path, value in changes.items():
        *tables, key = path.split(".")
        table = new
        for name in tables:
            table = table.setdefault(name, {})
        if value is None:
            table.pop(key, None)
        else:
            table[key] = copy.deepcopy(value)
    return new


# A part of each ready display, a few lenses wide: (panel pixels, more settings, frame width, an oblique camera). Seen straight it is seen
# from near, too: only where lenses are many pixels wide do blocks of pixels share rays.
DESKTOP = ((616, 352), ["array.count=[7,4]"], 90, "380,160,1950")
PARTS = {"barrier": ((256, 160), [], 26, "100,50,330"), "tablet-lenticular": ((256, 160), [], 23, "80,40,440"),
         "hexagon": ((240, 136), [], 23, "130,60,690")}
NEAR = 5  # times narrower
UNDIFFUSED = ("desktop-asphere-bare",)  # one ray for each pixel, whatever the estimator

# 9 x 6 lenses in front of 144 x 96 pixels, seen from 0.5 m through a diffuser: what each feature is shown on.
LENSES = {
    "plano": {"type": "plano_convex", "sphere_radius_mm": 2.6, "aperture_radius_mm": 1.9, "cylinder_height_mm": 1.0, "index": 1.4918},
    "plano-to-panel": {"type": "plano_convex", "sphere_radius_mm": 3.1, "aperture_radius_mm": 1.8, "cylinder_height_mm": 0.5, "index": 1.52,
                       "facing": "panel"},
    "surfaces": {"type": "surfaces", "surface": [
        {"curvature_per_mm": 0.02, "semi_aperture_mm": 1.9, "distance_mm": 1.3, "index": 1.4918},
        {"curvature_per_mm": -0.36, "conic": -0.6, "even_asphere": [1e-3, 2e-5], "semi_aperture_mm": 1.9}]},
    "doublet": {"type": "surfaces", "surface": [
        {"semi_aperture_mm": 1.9, "distance_mm": 0.5, "glass": "PC"},
        {"curvature_per_mm": 0.2, "semi_aperture_mm": 1.9, "distance_mm": 1.6, "glass": "PMMA"},
        {"curvature_per_mm": -0.38, "conic": -0.4, "semi_aperture_mm": 1.9}]},
    "ideal": {"type": "ideal", "aperture_radius_mm": 1.9, "focal_length_mm": 5.2},
    "pinhole": {"type": "pinhole", "aperture_radius_mm": 0.4},
}
BASE = {
    "schema": 1, "name": "base",
    "panel": {"pixels": [144, 96], "pixel_pitch_mm": 0.25},
    "lens": LENSES["plano"],
    "array": {"count": [9, 6], "pitch_mm": 4.0, "gap_mm": 5.4},
    "diffuser": {"distance_mm": 60.0, "angle_deg": [3.8, 3.2]},
    "camera": {"position_mm": [0.0, 0.0, 500.0], "frame_width_mm": 40.0},
}
LATTICES = {
    "square": {}, "rectangle": {"array.lattice": "rectangle", "array.pitch_mm": [4.0, 4.6]},
    "hexagon": {"array.lattice": "hexagon", "array.pitch_mm": 4.0}, "brick": {"array.lattice": "brick", "array.pitch_mm": [4.0, 4.4]},
    "strips": {"array.lattice": "strips", "array.count": [9, 1]},
}
GAUSSIAN = {"diffuser.profile": "gaussian"}
CLEAR = {"array.surround": "clear"}
PLATE = {"array.surround": "plate"}
CELL = {"array.aperture": "cell", "lens.sphere_radius_mm": 3.4, "lens.aperture_radius_mm": None}
PUPIL = {"camera.pupil_diameter_mm": 5.0, "camera.focus_distance_mm": 460.0}
DISPERSION = {"lens.index": None, "lens.glass": {"nd": 1.4918, "vd": 57.4}}
BANDS = {**DISPERSION, "panel.primary_widths_nm": [40.0, 50.0, 30.0], "render.wavelength_samples": 3}
ERRORS = {
    "shift": {"errors.shift_mm": [0.13, -0.21]}, "gap": {"errors.gap_mm": 0.2}, "rotation": {"errors.rotation_deg": 0.8},
    "pitch": {"errors.pitch_ppm": 3000.0}, "wedge": {"errors.wedge_deg": [0.4, -0.7]}, "bow": {"errors.bow_mm": 0.3},
    "decenter": {"errors.decenter_sd_mm": 0.06}, "height": {"errors.height_sd_mm": 0.1}, "tilt": {"errors.tilt_sd_deg": 0.6},
    "curvature": {"errors.curvature_sd": 0.02},
    "all": {"errors": {"shift_mm": [0.1, 0.05], "gap_mm": 0.1, "rotation_deg": -0.4, "pitch_ppm": -1500.0, "wedge_deg": [0.2, 0.3], "bow_mm": -0.2,
                       "decenter_sd_mm": 0.05, "height_sd_mm": 0.05, "tilt_sd_deg": 0.3, "curvature_sd": 0.01, "seed": 7}},
}
FEATURES = {
    "gaussian": GAUSSIAN, "gaussian-wide": {**GAUSSIAN, "diffuser.angle_deg": [12.0, 9.0]},
    "weak-diffuser": {"diffuser.distance_mm": 1.0, "diffuser.angle_deg": [0.8, 0.6]},
    "wide-diffuser": {"diffuser.angle_deg": [24.0, 18.0]}, "narrow-diffuser": {"diffuser.angle_deg": [1.2, 1.0]},
    "one-axis-diffuser": {"diffuser.angle_deg": [3.8, 0.0]},
    **{"subpixels-" + kind.replace("_", "-"): {"panel.subpixels": kind}
       for kind in ("rgb_stripe", "bgr_stripe", "rgb_rows", "pentile_rgbg", "delta")},
    "subpixels-masked": {"panel.subpixels": "rgb_stripe", "panel.aperture_ratio": 0.5},
    "subpixels-gaussian": {"panel.subpixels": "rgb_stripe", "panel.aperture_ratio": 0.6, **GAUSSIAN},
    "subpixels-custom": {"panel.subpixels": "custom", "panel.subpixel_cell": [2, 1], "panel.subpixel": [
        {"channel": "r", "pixel": [0, 0], "rect": [0.1, 0.1, 0.5, 0.9]}, {"channel": "g", "pixel": [0, 0], "rect": [0.6, 0.0, 1.0, 0.7]},
        {"channel": "b", "pixel": [1, 0], "rect": [1.2, 0.2, 1.9, 0.8]}]},
    "masked": {"panel.aperture_ratio": 0.4}, "emission": {"panel.emission_exponent": 3.5}, "encoding-linear": {"panel.encoding": "linear"},
    "layers": {"panel.layer": [{"thickness_mm": 1.1, "index": 1.52}, {"thickness_mm": 0.4, "index": 1.4}]},
    "layer-glued": {"panel.layer": [{"thickness_mm": 1.5, "glass": "N-BK7"}], "array.gap_mm": None, "array.base_z_mm": 1.5, **DISPERSION},
    "dispersion": DISPERSION, "bands": BANDS, "bands-gaussian": {**BANDS, **GAUSSIAN}, "dispersion-pupil": {**DISPERSION, **PUPIL},
    "pupil": PUPIL, "pixel-box": {"camera.pixel_filter": "box"}, "pupil-box": {**PUPIL, "camera.pixel_filter": "box"},
    "pupil-bare": {**PUPIL, "diffuser": None}, "box-bare": {"camera.pixel_filter": "box", "diffuser": None},
    "fov-up": {"camera.frame_width_mm": None, "camera.fov_deg": 4.5, "camera.up": [0.3, 1.0, 0.1]},
    "turned": {"array.rotation_deg": 11.0, "array.offset_mm": [0.7, -0.4]},
    "clear": CLEAR, "plate": PLATE, "cell": CELL, "cell-plate": {**CELL, **PLATE}, "clear-pupil": {**CLEAR, **PUPIL},
    "stop": {"lens.stop_radius_mm": 1.1}, "schlick": {"render.fresnel": "schlick"}, "no-fresnel": {"render.fresnel": "none"},
    "random": {"render.sampling": "random", "render.seed": 5}, "seed": {"render.seed": 5},
    "slant": {**LATTICES["strips"], **CELL, **PLATE, "array.slant_deg": 18.4349},
    "slant-subpixels": {**LATTICES["strips"], **CELL, **PLATE, "array.slant_deg": 18.4349, "panel.subpixels": "rgb_stripe",
                        "panel.aperture_ratio": 0.65},
    "slant-pupil-bare": {**LATTICES["strips"], **CELL, **PLATE, "array.slant_deg": -9.46, **PUPIL, "camera.pixel_filter": "box", "diffuser": None},
    **{f"errors-{name}": changes for name, changes in ERRORS.items()},
    "errors-strips": {**LATTICES["strips"], **ERRORS["all"]}, "errors-hexagon": {**LATTICES["hexagon"], **ERRORS["all"]},
    "errors-plate": {**PLATE, **ERRORS["all"], "errors.tilt_sd_deg": None}, "errors-gaussian": {**GAUSSIAN, **ERRORS["all"]},
    "errors-subpixels-pupil": {"panel.subpixels": "delta", **PUPIL, **ERRORS["all"]}, "errors-dispersion": {**DISPERSION, **ERRORS["all"]},
}
SAMPLED = [("filtered", None), ("filtered", 1), ("filtered", 4), ("filtered", 36), ("lens_by_lens", None), ("lens_by_lens", 4), ("lens_by_lens", 36),
           ("point", 1), ("point", 4), ("point", 36)]

# Few angles and depths, so that measures take seconds.
FEWER = {"fov": ["--angles-deg", "-20,20,10"], "dof": ["--depths-mm", "-40,40,40"], "mtf": ["--depths-mm", "0,20,20"]}
ANALYZED = {
    "base": ({}, MEASURES),
    "ideal": ({"lens": LENSES["ideal"], **GAUSSIAN}, MEASURES),
    "slant-subpixels": (FEATURES["slant-subpixels"], ("fov", "crosstalk", "mtf", "uniformity", "moire", "spot")),
    "colour": ({**BANDS, **LATTICES["hexagon"], "panel.subpixels": "delta", "panel.aperture_ratio": 0.6}, ("zone", "crosstalk", "spot")),
    "errors": ({**LATTICES["rectangle"], **ERRORS["all"]}, ("zone", "crosstalk", "mtf", "uniformity", "spot")),
    "pinhole": ({"lens": LENSES["pinhole"], "diffuser": None}, ("crosstalk", "uniformity")),
}
DRAWN = range(1, 81)
QUICK = ("components", "dof", "moire", "spot")  # with BASE
# The samples of --quick.
QUICK_STRAIGHT, QUICK_OBLIQUE = [("filtered", 4)], [("filtered", None), ("lens_by_lens", 36), ("point", 4)]


def render(name, display, panel, *words, size="48x27", **options):
    common = ["--panel-image", "PANEL", "--size", size, "--threads", "1", "--progress", "none", "-o", "FOLDER/picture.npy"]
    return Case("pictures", name, ["render", "DISPLAY", *common, *words], display, panel, **options)


def estimator(kind, samples):
    return ["--estimator", kind] + ([] if samples is None else ["--samples", str(samples)])


def label(kind, samples):
    return kind if samples is None else f"{kind}-{samples}"


def drawn(number):
    """A display drawn at random, with settings at the ends of their ranges, and how it is sampled."""
    draw = random.Random(number)
    wide, far = 10 ** draw.uniform(-0.3, 1.8), 10 ** draw.uniform(2, 3.2)
    camera = [far * draw.uniform(-1, 1) * 1.5, far * draw.uniform(-1, 1) * 0.5, far]
    display = changed(BASE, {
        "lens": draw.choice(list(LENSES.values())), "diffuser.angle_deg": [wide, wide * draw.uniform(0.3, 1)],
        "diffuser.distance_mm": 10 ** draw.uniform(0, 1.8), "camera.position_mm": camera, "camera.frame_width_mm": 10 ** draw.uniform(0.3, 1.8)})
    for more in (draw.choice(list(LATTICES.values())), draw.choice([{}, GAUSSIAN]), draw.choice([{}, {"camera.pixel_filter": "box"}]),
                 draw.choice([{}, {"camera.pupil_diameter_mm": 4.0}]), draw.choice([{}, {"panel.subpixels": "rgb_stripe"}])):
        display = changed(display, more)
    return display, draw.choice(["filtered", "filtered", "lens_by_lens"]), draw.choice([1, 4, 16, 64])


def pictures_of_ready():
    for display in READY:
        panel, settings, width, oblique = PARTS.get(display, DESKTOP)
        part = ["--set", f"panel.pixels=[{panel[0]},{panel[1]}]", *settings]
        for view, camera in [("straight", ["--frame-width-mm", str(width / NEAR)]),
                             ("oblique", ["--frame-width-mm", str(width), "--camera-mm", oblique])]:
            for sampled in SAMPLED if display not in UNDIFFUSED else SAMPLED[:1] + SAMPLED[-1:]:
                yield render(f"{display}/{view}/{label(*sampled)}", display, panel, *part, *camera, *estimator(*sampled),
                             quick=sampled in (QUICK_STRAIGHT if view == "straight" else QUICK_OBLIQUE))


def pictures_of_features():
    panel = tuple(BASE["panel"]["pixels"])
    for name, changes in FEATURES.items():
        yield render(f"{name}/near/filtered-16", changed(BASE, changes), panel, "--frame-width-mm", "7", *estimator("filtered", 16))
        for sampled in [("filtered", None), ("lens_by_lens", 16), ("point", 9)]:
            if changes.get("diffuser", 0) is None and sampled[0] == "lens_by_lens":
                sampled = ("filtered", 4)
            yield render(f"{name}/{label(*sampled)}", changed(BASE, changes), panel, "--camera-mm", "35,-20,490", *estimator(*sampled),
                         quick=sampled[0] == "point")
    for lattice, changes in LATTICES.items():
        for lens, description in LENSES.items():
            display = changed(changed(BASE, changes), {"lens": description})
            for sampled in [("filtered", 4), ("lens_by_lens", 4), ("point", 4)]:
                yield render(f"{lattice}/{lens}/{label(*sampled)}", display, panel, *estimator(*sampled), quick=sampled[0] != "lens_by_lens")
        for surround, more in [("clear", CLEAR), ("plate", PLATE), ("cell", CELL)]:
            yield render(f"{lattice}/{surround}/point-4", changed(changed(BASE, changes), more), panel, "--camera-mm", "60,30,480",
                         *estimator("point", 4))
    # Larger frames: blocks of 16 x 16 pixels, several regions and tiles; target errors; crops; light by other ways.
    yield render("blocks/filtered-4", BASE, panel, *estimator("filtered", 4), size="160x90")
    yield render("blocks/filtered-100", BASE, panel, *estimator("filtered", 100), size="128x72")
    yield render("blocks/lens_by_lens-4", BASE, panel, *estimator("lens_by_lens", 4), size="160x90")
    yield render("blocks/ideal/filtered", changed(BASE, {"lens": LENSES["ideal"]}), panel, size="288x40")
    yield render("regions/filtered", BASE, panel, size="520x30")
    for name in ("wide-diffuser", "gaussian-wide", "pupil", "plate"):
        yield render(f"close/{name}/filtered-16", changed(BASE, FEATURES[name]), panel, "--camera-mm", "14,9,100", "--frame-width-mm", "5",
                     *estimator("filtered", 16))
    for number in DRAWN:
        display, kind, samples = drawn(number)
        yield render(f"drawn/{number}/{label(kind, samples)}", display, panel, *estimator(kind, samples), quick=number % 2 == 0)
    yield render("crop/filtered", BASE, panel, "--crop", "31,17,60,41", size="96x54")
    yield render("target-error/filtered", BASE, panel, "--target-error", "0.02", *estimator("filtered", None))
    yield render("target-error/point", BASE, panel, "--target-error", "0.05", *estimator("point", None))
    yield render("exposure/auto", changed(BASE, FEATURES["subpixels-masked"]), panel, "--exposure", "auto")
    yield render("triangles/flat", BASE, panel, "--lens-mesh", "200", "--samples", "4", embree=True)
    yield render("triangles/smooth", BASE, panel, "--lens-mesh", "1000", "--lens-normals", "smooth", "--samples", "4", embree=True)


def pictures():
    yield from pictures_of_ready()
    yield from pictures_of_features()


def data():
    """What commands write for other programs and for the report: JSON, CSV, SVG, HTML, scenes, panels."""
    quiet = ["--threads", "1", "--progress", "none"]
    for display in READY:
        yield Case("data", f"check/{display}", ["check", "DISPLAY", "--json"], display)
    for display in ("barrier", "hexagon", "tablet-lenticular", "desktop-doublet"):
        panel, settings, width, _ = PARTS.get(display, DESKTOP)
        part = ["--set", f"panel.pixels=[{panel[0]},{panel[1]}]", *settings, "--frame-width-mm", str(width)]
        for pattern in ("checkerboard", "view", "edge", "address"):
            yield Case("data", f"eia/{display}/{pattern}", ["eia", "DISPLAY", *part[:-2], "--pattern", pattern, *quiet, "--json",
                                                            "-o", "FOLDER/panel.npy"], display, quick=pattern == "edge")
        for pickup in ("nodal", "traced", "integrated") if display != "barrier" else ("nodal",):
            yield Case("data", f"eia/{display}/{pickup}", ["eia", "DISPLAY", *part[:-2], "--model", "built-in:spheres", "--pickup", pickup, *quiet,
                                                           "--json", "-o", "FOLDER/panel.npy"], display, quick=False, embree=True)
        for peer in ("pov", "cycles", "mitsuba") if display in ("hexagon", "desktop-doublet") else ("pov",):
            bare = ["--set", "diffuser=none", "camera.pupil_diameter_mm=none", "camera.pixel_filter=center"]
            triangles = [] if peer == "pov" else ["--triangles", "300"]
            yield Case("data", f"export/{display}/{peer}", ["export", peer, "DISPLAY", *part, *bare, "--panel-image", "PANEL", "--channel", "g",
                                                            *triangles, *quiet, "--json", "-o", "FOLDER/scene"], display, panel, quick=False)
    for name, (changes, measures) in ANALYZED.items():
        for measure in measures:
            yield Case("data", f"analyze/{name}/{measure}", ["analyze", measure, "DISPLAY", "--size", "32x18", "--samples", "1",
                                                             *FEWER.get(measure, []), *quiet, "--json", "-o", "FOLDER/report"],
                       changed(BASE, changes), quick=name == "base" and measure in QUICK, embree=measure in EMBREE)


COMMANDS = ["", "new", "import", "check", "eia", "views", "photo", "render", "compare", "analyze", "sheet", "view", "export", "bench", "glass",
            "errors", "doctor"]  # study and tolerance are of the Python package
REFUSED = [
    "chek", "check", "check nothing.toml", "check base.toml --set array.pich_mm=8", "check base.toml --set array.pitch_mm=-8",
    "check base.toml --set lens.type=cube",
    "check base.toml --set lens.aperture_radius_mm=3 array.gap_mm=none", "check base.toml --set diffuser.distance_mm=-1 panel.pixels=[0,5]",
    "check base.toml --set errors.decenter_sd_mm=3", "check base.toml --set array.lattice=strips array.surround=plate",
    "render base.toml", "render base.toml --pattern stars -o picture.npy", "render base.toml --pattern white --size 10 -o picture.npy",
    "render base.toml --pattern white --model cube.obj -o picture.npy", "render base.toml --model nothing.obj -o picture.npy",
    "render base.toml --pattern white --crop 5,5,2,9 -o picture.npy", "render base.toml --panel-image nothing.png -o picture.npy",
    "render base.toml --pattern white -o picture.gif", "analyze colours base.toml -o report", "analyze fov base.toml --angles-deg 5,1,1 -o report",
    "analyze spot base.toml --set lens.type=pinhole -o report", "export blender base.toml -o scene", "export pov base.toml --pattern white -o scene",
    "eia base.toml --views nothing -o panel.npy", "glass unobtainium", "compare nothing.png base.toml", "errors base.toml",
    # How each command reads its options: values that are wrong, missing or empty, and options that go with others only.
    "new", "new --panel-inch x --pixels 10 --distance-mm 5mm --fov-deg 1,5 --pitch-mm y --lens round --depth-mm z --views 1 -o new.toml",
    "new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 --lattice round --slant-deg 3 -o new.txt",
    "new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 --slant-deg 3 --sheet-mm 1 --eye-distance-mm 65 -o base.toml",
    "new --panel-inch 8 --pixels 2560x1600 --distance-mm 500 --lattice strips --views a --slant-deg b --sheet-mm c --eye-distance-mm d --depth-mm 3 -o base.txt",
    "import", "import nothing.zmx -o base.toml --scale 0 --index 2", "import base.toml -o new.toml",
    "import displays/lens.zmx -o new.txt --scale x", "check ''", "check base.toml base.toml", "check base.toml --al",
    "check base.toml --camera-mm 1 2 3", "check base.toml --samples 0 --size 0x5 --sampling any --depth-mm x --camera-mm 1,2",
    "check base.toml --pickup best --estimator quick --seed -1 --tilt-deg 20,5 --size 5x5 --size 6x6",
    "eia base.toml -o panel.npy --bits 12 --threads 0 --progress much --pattern stars --cell-pixels 0 --view 1,1 --edge-deg x --edge-depth-mm 1,2",
    "eia base.toml -o panel.png --pattern white --bits 8 --cell-pixels 2 --edge-deg 1 --view 0,0 --focus-width-mm 1 --flip-views --replace",
    "eia base.toml -o map.gif --views nowhere --model nothing.obj --mapping map.txt", "eia base.toml -o map.npy --pattern white --mapping map.npy",
    "eia base.toml -o base.toml --pattern white", "eia base.toml --views displays --model cube.obj --depth-mm 3 -o panel.npy",
    "eia base.toml --views displays --cone middle --baseline-mm 1,2,3 --view-cone-deg 200 --focus-width-mm 0 -o panel.npy",
    "eia base.toml --views displays --baseline-mm -1 --camera-distance-mm 0 --focus-depth-mm x -o panel.npy",
    "eia base.toml --views displays --baseline-mm 1 --view-cone-deg 20 -o panel.npy",
    "views base.toml -o views --of light --views-as gif --grid 0x5", "views base.toml -o views --grid 5000x5000 --view-size 5",
    "views base.toml -o views --grid 2x2 --view-size 2000000x2", "views base.toml -o quilt.png", "views base.toml -o quilt_qs2x2a1.5.jpg",
    "views base.toml -o quilt_qs2x2a1.5.png --grid 3x3 --depth --resume --bits 7", "views base.toml -o views --resume --views-as npy --bits 8",
    "views base.toml -o views --pattern white --seed 3 --device cpu", "views base.toml -o views --of display --depth --pattern white",
    "photo base.toml -o photo.png --samples 4", "photo base.toml -o photo.png --crop 1,2,3 --threads x --bits 9", "photo base.toml",
    "render base.toml -o view.npy --panel-image nothing.png --device tpu --target-error 0 --exposure -1 --lens-mesh 5 --lens-normals rough",
    "render base.toml -o view.npy --pattern white --exposure bright --target-error x --sampling sobol --estimator filtered",
    "render base.toml -o view.npy --pattern white --target-error 0.1 --samples 4 --lens-mesh 500 --lens-normals smooth",
    "render base.toml -o view.npy --pattern white --lens-normals smooth --resume --frames-as png",
    "render base.toml -o frames --pattern white --path nothing.json --camera-mm 0,0,500 --exposure 2 --frames-as gif",
    "render base.toml -o base.toml --pattern white --path nothing.json --frames-as npy --resume --bits 16",
    "render base.toml --pattern white --threads 4 5 -o view.npy", "render base.toml --pattern white --bogus -o view.npy", "render --output",
    "compare base.toml", "compare base.txt nothing.png --encoding gamma --crop 1,2", "compare base.toml base.toml --crop 1,2 --fit-blur --overlay x.png",
    "compare base.toml base.toml --corners 1,2 3,4 --view-corners 1 2 3 4 --overlay a.gif --difference b.gif --encoding gamma",
    "compare base.toml base.toml --corners 0,0 9,0 9,9 0,9 --view-corners 1,a 2,b 3,c 4,d --overlay x.png --difference x.png --crop 1",
    "analyze", "analyze base.toml", "analyze base.toml fov -o report", "analyze fov base.toml --depths-mm 5 --viewing-distance-mm 0 --angles-deg a",
    "analyze fov base.toml --eye-distance-mm 5000 --compare array.gap_mm=3 -o report", "analyze fov nothing.toml --wavelength-nm x --device tpu -o report",
    "analyze fov base.toml base.toml --compare pickup --threads 0 -o report", "analyze fov,stars base.toml --progress x -o report",
    "sheet", "sheet base.toml --columns 0 --width-px 5 --label a --label b -o sheet.gif", "sheet '' nothing.png -o sheet.gif", "sheet nothing.png -o sheet.png",
    "view base.toml --port 0 --token short --visitors 65 --threads 0 --pattern stars --device tpu",
    "view base.toml --panel-image nothing.png --model nothing.obj --folder nowhere", "view base.toml --folder nowhere",
    "export pov", "export base.toml pov -o scene", "export pov base.toml --pattern white --normals flat -o ''",
    "export cycles base.toml --triangles x --channel q --normals rough --pattern white -o base.toml",
    "export pov base.toml --pattern white --panel-image nothing.png --threads x -o scene",
    "bench stars --runs 0 --angle-deg x --threads 0 --progress x --model nothing.obj", "bench estimators --display nothing.toml --crop 1,2",
    "bench estimators --display base.toml --crop 1,2", "glass --plot plot.svg", "glass PMMA --plot plot.png", "glass --catalogue nothing.agf",
    "glass PMMA SF6", "errors base.toml -o ''", "errors base.toml -o lenses.txt", "errors base.toml -o base.toml", "doctor --all", "bogus --help",
    "help", "help glass",
]
TOLD = ["check base.toml --all", "glass PMMA", "errors base.toml -o lenses.csv", "errors base.toml --json -o errors.csv",
        "new --panel-inch 8 --pixels 2560x1600 --fov-deg 30 --distance-mm 500 -o tablet.toml",
        "new --panel-inch 10 --pixels 2560x1600 --lattice strips --views 8 --distance-mm 450 -o lenticular.toml",
        "eia base.toml --pattern white --mapping mapping.npy --json -o white.exr", "export pov base.toml --pattern white --set diffuser=none -o scene"]


def texts():
    """What people read: help, the findings of `check`, and what is said of wrong input."""
    for command in COMMANDS:
        yield Case("help", f"help/{command or 'lfdsim'}", [*command.split(), "--help"])
    for display in ("barrier", "desktop-clear", "desktop-doublet", "hexagon", "tablet-lenticular"):
        yield Case("check", f"said/{display}", ["check", "DISPLAY"], display)
    for number, line in enumerate(REFUSED + TOLD, 1):
        yield Case("messages", f"said/{number}", shlex.split(line))


def all_cases():
    yield from pictures()
    yield from data()
    yield from texts()
