"""lfdsim check: what is wrong stands first, then the physics, and keys last, all of them with --all alone."""
from program import Checks, Program

program, checks = Program(), Checks()

NEAR_EYE = """schema = 1
[panel]
pixels = [1920, 1080]
pixel_pitch_mm = 0.005765
[lens]
type = "ideal"
focal_length_mm = 3.3
[array]
count = [10, 5]
pitch_mm = 1.0
gap_mm = 3.3
aperture = "cell"
[camera]
position_mm = [0.0, 0.0, 38.3]
[content]
depth_mm = -1500.0
height_mm = 200.0
viewing_distance_mm = 38.3
"""


def places(text, *words):
    found = [text.find(word) for word in words]
    checks.that(-1 not in found and found == sorted(found), f"{words} are at {found} in\n{text}")


bad = program.must("check tiny.toml --set diffuser.angle_deg=[0.1,0.1]")
places(bad, "tiny.toml is valid, but worth knowing:", "dark bands", "Positions and sizes", "fov_deg", "Keys that differ from their defaults", "[diffuser]")
checks.that("emission_exponent" not in bad, "a default is printed without --all")
checks.that(len(bad.split("fov_deg")[0].splitlines()) < 40, "too much before the physics")
everything = program.must("check tiny.toml --all")
places(everything, "Paraxial theory", "Keys\n", "emission_exponent")

# An eye 35 mm before the lenses sees what of the screen is 10 mm wide; a lens's own cone is wider and says where eyes may be.
(program.folder / "near-eye.toml").write_text(NEAR_EYE)
near = program.must("check near-eye.toml")
places(near, "screen_field_deg             16.26", "x 8.17", "fov_deg                      17.23", "fov_elemental_deg            18.82")
checks.that("new --fov-deg" in near, "the two fields of view are not told apart")
checks.finish()
