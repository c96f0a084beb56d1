"""Descriptions, pictures and option values that must be refused: what is done, and what the message has to say."""
import re

from program import TINY, Checks, Program

program, checks = Program(), Checks()
folder = program.folder

# Files that are not descriptions.
(folder / "empty.toml").write_text("")
(folder / "binary.toml").write_bytes(bytes(range(256)) * 20)
(folder / "truncated.toml").write_text(TINY[:-7] + "[[[")
(folder / "huge.toml").write_text("# " + "x" * (2 << 20) + "\n" + TINY)
(folder / "deep.toml").write_text(TINY + "a = " + "[" * 100000)
(folder / "folder.toml").mkdir()
for name, words in [("missing", "there is no such file"), ("empty", "empty.toml: is empty"), ("binary", "binary.toml"), ("truncated", "truncated.toml:"),
                    ("huge", "1048576"), ("deep", "deep.toml"), ("folder", "folder")]:
    checks.refused(program, f"{name} description", f"check {name}.toml", words)

# Values that are not possible: the key as an override, and in the file at its line.
VALUES = [  # key, value, words of the message
    ("panel.pixels", "[88.5, 48]", "panel.pixels"),
    ("panel.pixels", "[0, 48]", "panel.pixels"),
    ("panel.pixels", "[65536, 65536]", "2^31"),
    ("panel.pixels", "[9223372036854775807, 9223372036854775807]", "panel.pixels"),
    ("panel.pixels", "[9223372036854775808, 1]", "not representable in 64 bits"),
    ("panel.pixel_pitch_mm", "0", "panel.pixel_pitch_mm"),
    ("panel.pixel_pitch_mm", "-0.5", "panel.pixel_pitch_mm"),
    ("panel.pixel_pitch_mm", "nan", "panel.pixel_pitch_mm"),
    ("panel.pixel_pitch_mm", "inf", "panel.pixel_pitch_mm"),
    ("panel.pixel_pitch_mm", '"half"', "string"),
    ("panel.encoding", '"srbg"', "srgb"),
    ("lens.type", '"planoconvex"', "plano_convex"),
    ("lens.sphere_radius_mm", "1.5", "lens.sphere_radius_mm"),  # R < r
    ("lens.aperture_radius_mm", "2.1", "pitch"),  # lens larger than its cell
    ("lens.cylinder_height_mm", "9", "lens.cylinder_height_mm"),  # the ball would cut the flat face
    ("lens.cylinder_height_mm", "-1", "lens.cylinder_height_mm"),
    ("lens.index", "0.5", "lens.index"),
    ("lens.index", "true", "lens.index"),
    ("array.count", "[100000, 100000]", "2^31"),
    ("array.count", "[11]", "2 integers"),
    ("array.pitch_mm", "0", "array.pitch_mm"),
    ("array.gap_mm", "0.1", "array.gap_mm"),  # the lens would stand behind the panel
    ("array.surround", '"glass"', "opaque"),
    ("diffuser.distance_mm", "0", "diffuser.distance_mm"),
    ("diffuser.distance_mm", "-1", "diffuser.distance_mm"),  # inside the lenses
    ("diffuser.angle_deg", "[180, 3]", "diffuser.angle_deg"),
    ("camera.position_mm", "[0, 0, 0]", "camera.position_mm"),
    ("camera.position_mm", "[0, 0, -100]", "behind the panel"),
    ("camera.position_mm", "[0, 0, inf]", "camera.position_mm"),
    ("camera.up", "[0, 0, 1]", "camera.up"),  # along the line of sight
    ("camera.up", "[0, 0, 0]", "camera.up"),
    ("camera.target_mm", "[0, 0, 400]", "camera.target_mm"),
    ("camera.frame_width_mm", "0", "camera.frame_width_mm"),
    ("camera.resolution", "[65536, 65536]", "2^31"),
    ("content.height_mm", "-3", "content.height_mm"),
    ("content.viewing_distance_mm", "nan", "content.viewing_distance_mm"),
    ("render.samples", "0", "render.samples"),
    ("render.samples", "16777217", "render.samples"),
    ("render.seed", "-1", "render.seed"),
    ("render.sampling", '"halton"', "sobol"),
]
for key, value, words in VALUES:
    checks.refused(program, f"--set {key}={value}", ["check", "tiny.toml", "--set", f"{key}={value}"], words, key)
    table, name = key.split(".")
    without = re.sub(rf"^{name} =.*\n", "", TINY, flags=re.M)  # the name is unique among the tables
    line = f"\n{name} = {value}\n"
    text = without.replace(f"[{table}]\n", f"[{table}]{line}")
    (folder / "bad.toml").write_text(text)
    checks.refused(program, f"{key} = {value}", "check bad.toml", words, f"bad.toml:{text[:text.index(line)].count(chr(10)) + 2}:")

CASES = [  # name, arguments, words of the message
    ("unknown key", "check tiny.toml --set array.pich_mm=4", "did you mean pitch_mm?"),
    ("unknown key in an override", ["check", "tiny.toml", "--set", "diffuser={distance_mm=9,angle_deg=[1,1],profil='box'}"],
     "--set diffuser={distance_mm=9,angle_deg=[1,1],profil='box'}: diffuser.profil: is unknown; did you mean profile?"),
    ("unknown table", "check tiny.toml --set aray.pitch_mm=4", "aray"),
    ("override without value", "check tiny.toml --set array.pitch_mm", "array.pitch_mm"),
    ("override without key", "check tiny.toml --set =4", "=4"),
    ("override, empty value", "check tiny.toml --set array.pitch_mm=", "array.pitch_mm"),
    ("override, junk behind", ["check", "tiny.toml", "--set", "array.pitch_mm=4\nlens.index=1.5"], "array.pitch_mm"),
    ("diffuser behind the camera", "check tiny.toml --set diffuser.distance_mm=500", "whose diffuser stands"),
    ("gap and base", "check tiny.toml --set array.base_z_mm=3", "gap_mm"),
    # camera options, under their own names
    ("camera behind the panel", "render tiny.toml --panel-image panel.png --camera-mm 0,0,-5 -o out.png", "--camera-mm 0,0,-5"),
    ("camera on the panel", "render tiny.toml --panel-image panel.png --camera-mm 0,0,0 -o out.png", "--camera-mm"),
    ("camera in the lenses", "render tiny.toml --panel-image panel.png --camera-mm 0,0,5 -o out.png", "--camera-mm"),
    ("camera with two numbers", "render tiny.toml --panel-image panel.png --camera-mm 0,5 -o out.png", "3 finite numbers"),
    ("camera with NaN", "render tiny.toml --panel-image panel.png --camera-mm 0,nan,400 -o out.png", "3 finite numbers"),
    ("camera with infinity", "render tiny.toml --panel-image panel.png --camera-mm 0,0,1e999 -o out.png", "3 finite numbers"),
    ("camera with junk", "render tiny.toml --panel-image panel.png --camera-mm 0,0,400mm -o out.png", "3 finite numbers"),
    ("target at the camera", "render tiny.toml --panel-image panel.png --target-mm 0,0,400 -o out.png", "--target-mm"),
    ("frame without width", "render tiny.toml --panel-image panel.png --frame-width-mm 0 -o out.png", "--frame-width-mm"),
    ("size zero", "render tiny.toml --panel-image panel.png --size 0x54 -o out.png", "--size"),
    ("size overflows", "render tiny.toml --panel-image panel.png --size 4294967296x4294967296 -o out.png", "--size"),
    ("size beyond memory", ["render", "tiny.toml", "--panel-image", "panel.png", "--size", "46340x46340", "--set",
                            "panel.pixels=[20000, 40000]", "-o", "out.png"], "camera.resolution: "),
    ("panel beyond memory", ["render", "tiny.toml", "--pattern", "white", "--set", "panel.pixels=[46340, 46340]", "-o", "out.png"],
     "panel.pixels: "),
    ("size with junk", "render tiny.toml --panel-image panel.png --size 96x54x3 -o out.png", "columns x rows"),
    ("crop outside", "render tiny.toml --panel-image panel.png --crop 0,0,97,54 -o out.png", "96 x 54"),
    ("crop empty", "render tiny.toml --panel-image panel.png --crop 5,5,5,9 -o out.png", "--crop"),
    ("crop overflows", "render tiny.toml --panel-image panel.png --crop 0,0,4294967297,54 -o out.png", "--crop"),
    ("samples zero", "render tiny.toml --panel-image panel.png --samples 0 -o out.png", "--samples"),
    ("samples negative", "render tiny.toml --panel-image panel.png --samples -4 -o out.png", "--samples"),
    ("samples a fraction", "render tiny.toml --panel-image panel.png --samples 1.5 -o out.png", "whole number"),
    ("samples beyond 64 bits", "render tiny.toml --panel-image panel.png --samples 99999999999999999999 -o out.png", "--samples"),
    ("seed beyond 63 bits", "render tiny.toml --panel-image panel.png --seed 9223372036854775808 -o out.png", "--seed"),
    ("unknown sampling", "render tiny.toml --panel-image panel.png --sampling halton -o out.png", "sobol, random"),
    ("threads zero", "render tiny.toml --panel-image panel.png --threads 0 -o out.png", "--threads"),
    ("threads without end", "render tiny.toml --panel-image panel.png --threads 1000000 -o out.png", "--threads"),
    ("unknown kernel", "render tiny.toml --panel-image panel.png --kernel sse -o out.png", "baseline"),
    ("lens mesh of nothing", "render tiny.toml --panel-image panel.png --lens-mesh 0 -o out.png", "8 to 4000000"),
    ("lens mesh without end", "render tiny.toml --panel-image panel.png --lens-mesh 4000001 -o out.png", "8 to 4000000"),
    ("lens mesh with junk", "render tiny.toml --panel-image panel.png --lens-mesh 860x -o out.png", "--lens-mesh"),
    ("unknown normals", "render tiny.toml --panel-image panel.png --lens-mesh 860 --lens-normals bumpy -o out.png", "flat, smooth"),
    ("normals of no mesh", "render tiny.toml --panel-image panel.png --lens-normals flat -o out.png", "--lens-mesh"),
    ("lens mesh to an error", "render tiny.toml --panel-image panel.png --lens-mesh 860 --target-error 0.01 -o out.png", "--target-error"),
    ("unknown device", "render tiny.toml --panel-image panel.png --device gpu -o out.png", "auto, cpu, cuda"),
    ("half a device", "analyze fov tiny.toml --device cuda: -o out", "auto, cpu, cuda"),
    ("compare a display with an impossible one", "analyze fov tiny.toml --compare array.gap_mm=3,x -o out", "--compare array.gap_mm=\"x\""),
    ("an array out of sight", "analyze fov tiny.toml --set array.offset_mm=[2000,0] -o out", "no pixel of the camera sees the lens array"),
    ("a GPU that is not there", "view tiny.toml --device cuda:999", "--device"),
    ("lens mesh on a GPU", "render tiny.toml --panel-image panel.png --lens-mesh 860 --device cuda -o out.png", "--device"),
    ("lens mesh on a kernel", "render tiny.toml --panel-image panel.png --lens-mesh 860 --kernel scalar -o out.png", "--kernel"),
    ("lens mesh, filtered", "render tiny.toml --panel-image panel.png --lens-mesh 860 --estimator filtered -o out.png",
     "--estimator filtered"),
    ("lens mesh in a plate", ["render", "tiny.toml", "--panel-image", "panel.png", "--lens-mesh", "860", "--set",
                              'array.surround="plate"', "-o", "out.png"], "array.surround"),
    ("lens mesh of an ideal lens", ["render", "tiny.toml", "--panel-image", "panel.png", "--lens-mesh", "860", "--set",
                                    "lens.sphere_radius_mm=none", "lens.cylinder_height_mm=none", "lens.index=none",
                                    'lens.type="ideal"', "lens.focal_length_mm=5", "-o", "out.png"], "lens.type"),
    ("unknown progress", "render tiny.toml --panel-image panel.png --progress dots -o out.png", "--progress"),
    ("bits", "render tiny.toml --panel-image panel.png --bits 12 -o out.png", "8, 16"),
    ("bits of an EXR", "render tiny.toml --panel-image panel.png --bits 16 -o out.exr", "--bits"),
    # what the panel shows
    ("two things to show", "render tiny.toml --panel-image panel.png --pattern white -o out.png", "one of them"),
    ("missing panel image", "render tiny.toml --panel-image none.png -o out.png", "none.png"),
    ("empty panel image", "render tiny.toml --panel-image empty.png -o out.png", "empty.png: is empty"),
    ("text as panel image", "render tiny.toml --panel-image text.png -o out.png", "text.png"),
    ("truncated panel image", "render tiny.toml --panel-image truncated.png -o out.png", "truncated.png"),
    ("folder as panel image", "render tiny.toml --panel-image folder.png -o out.png", "folder.png"),
    ("panel image that nobody can read", "render tiny.toml --panel-image panel.tiff -o out.png", "panel.tiff"),
    ("panel image of another size", "render tiny.toml --panel-image small.png -o out.png", "is 8 x 6 pixels, the panel has 88 x 48"),
    ("panel image without name", ["render", "tiny.toml", "--panel-image", "", "-o", "out.png"], "--panel-image: is empty"),
    ("model without name", ["render", "tiny.toml", "--model", "", "-o", "out.png"], "--model: "),
    ("pattern without name", ["render", "tiny.toml", "--pattern", "", "-o", "out.png"], "--pattern: "),
    ("unknown pattern", "eia tiny.toml --pattern chess -o out.png", "checkerboard"),
    ("option of another pattern", "eia tiny.toml --pattern white --edge-deg 3 -o out.png", "--edge-deg"),
    ("view outside", "eia tiny.toml --pattern view --view 0.6,0 -o out.png", "--view"),
    ("cell of no pixels", "eia tiny.toml --pattern checkerboard --cell-pixels 0 -o out.png", "--cell-pixels"),
    # options without effect beside others
    ("a depth of an image", "render tiny.toml --panel-image panel.png --depth-mm 9 -o out.png", "--depth-mm, --panel-image"),
    ("a turn of an image", "export pov tiny.toml --panel-image panel.png --yaw-deg 9 -o out", "--yaw-deg, --panel-image"),
    ("a height of a pattern", "eia tiny.toml --pattern white --height-mm 9 -o out.png", "--height-mm, --pattern"),
    ("a model and a pattern", "eia tiny.toml --pattern white --model pyramid.obj -o out.png", "give one of them"),
    ("samples and an error", "render tiny.toml --panel-image panel.png --samples 9 --target-error 0.1 -o out.png", "--samples, --target-error"),
    ("points' sampling of footprints", "render tiny.toml --panel-image panel.png --sampling random -o out.png", "--estimator point"),
    ("a kernel on a GPU", "render tiny.toml --panel-image panel.png --kernel scalar --device cuda -o out.png", "--kernel"),
    ("an edge of no pattern", "render tiny.toml --edge-deg 3 -o out.png", "is only for --pattern edge"),
    ("replace without a path", "render tiny.toml --replace -o out.png", "only for frames of a --path"),
    # where the picture goes
    ("no output", "render tiny.toml --panel-image panel.png", "--output"),
    ("output folder missing", "render tiny.toml --panel-image panel.png -o none/out.png", "the folder none does not exist"),
    # found before the work, or the render would take hours and the test time out
    ("output that cannot be made", "render tiny.toml --panel-image panel.png --samples 16777216 -o /proc/out.png", "/proc"),
    ("output in a file", "render tiny.toml --panel-image panel.png -o tiny.toml/out.png", "tiny.toml is not a folder"),
    ("a folder in a file", "export cycles tiny.toml --pattern white -o tiny.toml/scene", "cannot be made: ", "tiny.toml is not a folder"),
    ("results in a file", "analyze spot tiny.toml -o tiny.toml/results", "cannot be made: ", "tiny.toml is not a folder"),
    ("two outputs of one name", "eia tiny.toml --pickup traced -o out.npy --mapping ./out.npy", "--output, --mapping: name the same file"),
    ("a table without a name", ["errors", "tiny.toml", "-o", ""], "--output: is empty"),
    ("output with too long a name", f"render tiny.toml --panel-image panel.png --samples 16777216 -o {'x' * 300}.png", "name too long"),
    ("output is a folder", "render tiny.toml --panel-image panel.png -o folder.png", "is a folder"),
    ("output of unknown kind", "render tiny.toml --panel-image panel.png -o out.tiff", ".png, .exr and .npy"),
    ("output without name", "render tiny.toml --panel-image panel.png -o .png", ".png, .exr and .npy"),
    # other commands
    ("compare a missing picture", "compare panel.png none.png", "none.png"),
    ("compare nothing", ["compare", "", "panel.png"], "A: is empty"),
    ("compare with nothing", ["compare", "panel.png", ""], "B: is empty"),
    ("compare pictures of two sizes", "compare panel.png small.png", "88 x 48"),
    ("compare with another encoding", "compare panel.png panel.png --encoding gamma", "srgb, linear"),
    ("sheet of a missing picture", "sheet panel.png none.png -o out.png", "none.png"),
    ("sheet of nothing", ["sheet", "panel.png", "", "-o", "out.png"], "IMAGE: is empty"),
    ("sheet with too few labels", "sheet panel.png small.png --label one -o out.png", "one label for each"),
    ("sheet without columns", "sheet panel.png --columns 0 -o out.png", "--columns"),
]
(folder / "empty.png").write_bytes(b"")
(folder / "text.png").write_text("not a picture\n" * 50)
(folder / "truncated.png").write_bytes((folder / "panel.png").read_bytes()[:-40])
(folder / "panel.tiff").write_bytes((folder / "panel.png").read_bytes())
(folder / "folder.png").mkdir()
program.must(["eia", "tiny.toml", "--pattern", "white", "--set", "panel.pixels=[8, 6]", "-o", "small.png"])
for name, arguments, *words in CASES:
    checks.refused(program, name, arguments, *words)

# All faults are told at once: description, options and output together.
several = "render tiny.toml --panel-image panel.png --set lens.index=9 array.pitch_mm=-1 --samples x --threads 0 --kernel k -o none/out.png"
checks.refused(program, "several faults", several, "lens.index", "array.pitch_mm", "--samples", "--threads", "--kernel", "the folder none")
checks.refused(program, "kernel of the environment", "render tiny.toml --panel-image panel.png -o out.png", "LFDSIM_KERNEL",
               env={"LFDSIM_KERNEL": "sse"})
checks.finish()
