"""compare --corners: photographs made here, by other means, from finer views; what was done to them has to be found."""
import json
import math
import os

import numpy as np
from PIL import Image, ImageOps

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
WIDTH, HEIGHT, FINE = 480, 270, 3


def code(light):
    light = np.clip(light, 0, 1)
    return 255 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def homography(source, target):
    """3 x 3, by the eight linear equations of four pairs of points."""
    rows, right = [], []
    for (x, y), (u, v) in zip(source, target):
        rows += [[x, y, 1, 0, 0, 0, -x * u, -y * u], [0, 0, 0, x, y, 1, -x * v, -y * v]]
        right += [u, v]
    return np.append(np.linalg.solve(rows, right), 1).reshape(3, 3)


def blurred(image, sigma):
    """A Gaussian by the Fourier transform; the picture is mirrored at its borders."""
    if sigma == 0:
        return image
    mirrored = np.concatenate([image, image[::-1]], 0)
    mirrored = np.concatenate([mirrored, mirrored[:, ::-1]], 1)
    fy, fx = np.fft.fftfreq(mirrored.shape[0])[:, None, None], np.fft.rfftfreq(mirrored.shape[1])[None, :, None]
    spectrum = np.fft.rfft2(mirrored, axes=(0, 1)) * np.exp(-2 * (math.pi * sigma) ** 2 * (fx**2 + fy**2))
    return np.fft.irfft2(spectrum, mirrored.shape[:2], axes=(0, 1))[:image.shape[0], :image.shape[1]]


def photographed(fine, in_view, in_photo, size, sigma=0.0, gains=(1, 1, 1), noise=0.0):
    """Linear light of a photograph of size (columns, rows): the fine view blurred by sigma pixels of the coarse
    one, in perspective, 2 x 2 bilinear samples a pixel; around the frame of the view it is grey."""
    fine = blurred(fine, sigma * FINE)
    to_view = homography(in_photo, in_view)
    total = np.zeros((size[1], size[0], 3))
    for j in range(2):
        for i in range(2):
            x, y = np.meshgrid(np.arange(size[0]) + (i + 0.5) / 2, np.arange(size[1]) + (j + 0.5) / 2)
            u, v, w = np.tensordot(to_view, np.stack([x, y, np.ones_like(x)]), 1)
            u, v = u / w * FINE - 0.5, v / w * FINE - 0.5
            inside = (u >= 0) & (v >= 0) & (u <= fine.shape[1] - 1) & (v <= fine.shape[0] - 1)
            a, b = np.clip(u, 0, fine.shape[1] - 1.001), np.clip(v, 0, fine.shape[0] - 1.001)
            c, r = a.astype(int), b.astype(int)
            a, b = (a - c)[..., None], (b - r)[..., None]
            top = fine[r, c] * (1 - a) + fine[r, c + 1] * a
            bottom = fine[r + 1, c] * (1 - a) + fine[r + 1, c + 1] * a
            total += np.where(inside[..., None], top * (1 - b) + bottom * b, 0.1) / 4
    return total * gains + np.random.default_rng(1).normal(0, noise, total.shape)


def save(light, name, **options):
    Image.fromarray(np.round(code(light)).astype(np.uint8)).save(folder / name, **options)


def text(corners):
    return [f"{x!r},{y!r}" for x, y in corners]


def compare(photo, corners, *more, view="view.png"):
    arguments = ["compare", view, photo, "--corners", *text(corners), "--json", *more]
    return json.loads(program.must(arguments))


RENDER = ["render", "tiny.toml", "--panel-image", "colours.png", "--set", "diffuser.angle_deg=[1.5,1]", "--progress", "none"]


def views(name, *settings):
    """The view NAME.npy, whose pixels are means of 3 x 3 finer ones, as if with a box filter; and the finer one."""
    program.must([*RENDER, "--size", f"{WIDTH * FINE}x{HEIGHT * FINE}", "--estimator", "point", "--samples", "64", "-o", "fine.npy", *settings])
    fine = np.load(folder / "fine.npy").astype(float)
    np.save(folder / f"{name}.npy", fine.reshape(HEIGHT, FINE, WIDTH, FINE, 3).mean((1, 3)).astype(np.float32))
    return fine


# What the panel shows: colours that change from place to place.
rng = np.random.default_rng(2)
colours = np.kron(rng.uniform(40, 230, (12, 22, 3)), np.ones((4, 4, 1)))
Image.fromarray(colours.astype(np.uint8)).save(folder / "colours.png")
fine = views("view")
program.must([*RENDER, "--size", f"{WIDTH}x{HEIGHT}", "-o", "view.png"])

# The lens array is 44 x 24 mm, its vertex plane 5 + T - T/n in front of the panel; the camera stands 400 mm from the panel, in
# whose plane its frame is 46 mm wide.
thickness = 1 + 2.6 - math.sqrt(2.6**2 - 1.9**2)
scale = 400 / (400 - 5 - thickness + thickness / 1.4918) * WIDTH / 46
IN_VIEW = [(WIDTH / 2 + x * 22 * scale, HEIGHT / 2 + y * 12 * scale) for x, y in [(-1, -1), (1, -1), (1, 1), (-1, 1)]]
SIZE, IN_PHOTO = (1300, 900), [(131.5, 92.25), (1180.75, 140.5), (1150.25, 770.75), (160.0, 720.5)]
GAINS, BLUR, JPEG = (0.8, 0.95, 0.65), 1.5, {"quality": 95, "subsampling": 0}


def near(value, wanted, tolerance, what):
    checks.that(abs(value / wanted - 1) <= tolerance, f"{what}: {value}, wanted {wanted} within {tolerance}")


# Where the program says that the screen is, and that a view is its own photograph.
same = compare("view.png", IN_VIEW)
checks.that(np.allclose(same["view_corners"], IN_VIEW, atol=1e-9) and same["ssim"] == 1, f"a view as its own photograph: {same}")

# Each distortion alone and all together. The view as lfdsim renders it has one ray a pixel, not the mean over a pixel.
plain = photographed(fine, IN_VIEW, IN_PHOTO, SIZE)
all_at_once = photographed(fine, IN_VIEW, IN_PHOTO, SIZE, BLUR, GAINS, 0.005)
soft = photographed(fine, IN_VIEW, IN_PHOTO, SIZE, BLUR)
for name, light, gains, blur in [("perspective", plain, (1, 1, 1), None), ("gains", plain * GAINS, GAINS, None),
                                 ("blur", soft, (1, 1, 1), BLUR), ("all", all_at_once, GAINS, BLUR)]:
    file = "photo.jpg" if name == "all" else "photo.png"
    save(light, file, **JPEG)
    for view, tolerance in [("view.npy", 0.03), ("view.png", 0.05)]:
        found = compare(file, IN_PHOTO, "--view-corners", *text(IN_VIEW), *(["--fit-blur"] if blur else []), view=view)
        what = f"{name}, {view}: {found}"
        for c in range(3):
            near(found["gains"][c], gains[c], 0.003, f"gain {c}, {what}")
        if blur:
            near(found["blur_px"], blur, tolerance, f"blur, {what}")
        checks.that(found["ssim"] > 0.98 and found["unsaturated_share"] == 1, what)
all_right = compare("photo.jpg", IN_PHOTO, "--fit-blur")

# Corners that were clicked beside the true ones.
for trial in range(3):
    clicked = np.array(IN_PHOTO) + rng.uniform(-3.4, 3.4, (4, 2))
    before, after = (compare("photo.jpg", clicked.tolist(), "--fit-blur", *more) for more in [[], ["--fit-corners"]])
    checks.that(np.allclose(after["corners"], IN_PHOTO, atol=0.2), f"corners {after['corners']} from {clicked}")
    checks.that(before["ssim"] < after["ssim"] and after["ssim"] > all_right["ssim"] - 0.001, f"{before}, {after}")
    near(after["blur_px"], BLUR, 0.05, "blur, corners fitted")
far = np.array(IN_PHOTO) + 12
moves = np.array(compare("photo.jpg", far.tolist(), "--fit-corners")["corners"]) - far
checks.that(1 < np.hypot(*moves.T).max() < 5.001, f"corners far off were moved by {moves}")

# A simulator that is wrong is seen to be: another gap, another diffuser, another place of the camera.
for setting in ["array.gap_mm=5.3", "diffuser.angle_deg=[2.5,2]", "camera.position_mm=[8,0,400]"]:
    views("wrong", "--set", setting)
    wrong = compare("photo.jpg", IN_PHOTO, "--view-corners", *text(IN_VIEW), "--fit-blur", view="wrong.npy")
    worse = wrong["ssim"] < all_right["ssim"] - 0.05 and wrong["rmse"] > 2 * all_right["rmse"]
    checks.that(worse, f"{setting}: {wrong}")

# One processor or all: the same bits.
alone = program.must(["compare", "view.png", "photo.jpg", "--corners", *text(IN_PHOTO), "--fit-corners", "--fit-blur", "--json"],
                     preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
checks.that(json.loads(alone) == compare("photo.jpg", IN_PHOTO, "--fit-corners", "--fit-blur"), f"on one processor: {alone}")

# Something before the screen, an overexposed photograph, part of the screen, linear light.
covered = plain * GAINS
covered[200:420, 250:500] = 0.9
save(covered, "covered.png")
for c, found in enumerate(compare("covered.png", IN_PHOTO)["gains"]):
    near(found, GAINS[c], 0.01, f"gain {c}, a tenth covered")
save(plain * 2.5, "over.png")
over = compare("over.png", IN_PHOTO)
for gain in over["gains"]:
    near(gain, 2.5, 0.01, "gain, overexposed")
checks.that(0.3 < over["unsaturated_share"] < 0.95 and over["ssim"] > 0.98, f"overexposed: {over}")
part = compare("covered.png", IN_PHOTO, "--crop", "240,20,440,250")
checks.that(part["pixels"] == 200 * 230 and part["ssim"] > 0.98, f"a part: {part}")
save(plain * GAINS, "photo.png")
half = compare("photo.png", [(x - SIZE[0] // 2, y) for x, y in IN_PHOTO])
checks.that(0.3 < half["pixels"] / same["pixels"] < 0.7, f"half of the screen lies beside the photograph: {half}")
np.save(folder / "bright.npy", (plain * 7).astype(np.float32))
bright = compare("bright.npy", IN_PHOTO)
near(bright["gains"][0], 7, 0.01, "gain, floats beyond 1")
checks.that(bright["ssim"] > 0.98 and bright["unsaturated_share"] == 1, f"floats beyond 1: {bright}")
Image.fromarray(np.round(255 * np.clip(plain, 0, 1)).astype(np.uint8)).save(folder / "linear.png")
linear = compare("linear.png", IN_PHOTO, "--encoding", "linear")
near(linear["gains"][0], 1, 0.01, "gain, code values in linear light")

# A phone turned: corners are those of the picture as viewers show it.
upright = Image.fromarray(np.round(code(plain * GAINS)).astype(np.uint8))
FLIPS = [Image.FLIP_LEFT_RIGHT, Image.ROTATE_180, Image.FLIP_TOP_BOTTOM, Image.TRANSPOSE, Image.ROTATE_90, Image.TRANSVERSE,
         Image.ROTATE_270]
for orientation in range(1, 9):
    exif = Image.Exif()
    exif.endian = "<" if orientation % 2 else ">"
    exif[0x0112] = orientation
    stored = upright.transpose(FLIPS[orientation - 2]) if orientation > 1 else upright
    stored.save(folder / "turned.jpg", **JPEG, exif=exif)
    assert ImageOps.exif_transpose(Image.open(folder / "turned.jpg")).size == SIZE
    shown = np.asarray(ImageOps.exif_transpose(Image.open(folder / "turned.jpg"))).astype(int)
    assert np.abs(shown - np.asarray(upright)).mean() < 3
    turned = compare("turned.jpg", IN_PHOTO, "--fit-corners")
    met = np.allclose(turned["corners"], IN_PHOTO, atol=0.2)
    checks.that(turned["ssim"] > 0.98 and met, f"orientation {orientation}: {turned}")

# The pictures.
start = ["compare", "view.png", "photo.jpg", "--corners"]
program.must([*start, *text(IN_PHOTO), "-o", "overlay.png", "--difference", "difference.png"])
overlay, difference = (np.asarray(Image.open(folder / name)).astype(float) for name in ["overlay.png", "difference.png"])
wide, high = round(IN_VIEW[1][0] - IN_VIEW[0][0]), round(IN_VIEW[2][1] - IN_VIEW[1][1])
checks.that(overlay.shape[1] == 2 * wide + 36 and difference.shape[1] == wide + 24, f"{overlay.shape}, {difference.shape}")
panels = [overlay[y:y + high, x:x + wide] for y in (28, 28 + high + 28) for x in (12, 24 + wide)]
checks.that(all(0.5 < panel.mean() / panels[0].mean() < 1.5 for panel in panels[1:]), "a picture of the overlay is empty")
checks.that(0.8 < np.corrcoef(panels[0].ravel(), panels[1].ravel())[0, 1], "simulation and photograph differ in the overlay")
checks.that(difference[12:12 + high, 12:12 + wide].mean() > 230, "the difference of equal pictures is not white")

# What has to be refused.
Image.fromarray(np.zeros((900, 1300, 3), np.uint8)).save(folder / "black.png")
Image.fromarray(np.full((900, 1300, 3), 255, np.uint8)).save(folder / "white.png")
no_blue = np.asarray(upright).copy()
no_blue[..., 2] = 0
Image.fromarray(no_blue).save(folder / "no_blue.png")
program.must([*RENDER, "--size", f"{WIDTH}x{HEIGHT}", "--crop", "0,0,480,200", "-o", "part.png"])
np.save(folder / "dark.npy", np.zeros((HEIGHT, WIDTH, 3), np.float32))
four = text(IN_PHOTO)
with_corners = ["--corners", *four]
for name, arguments, words in [
    ("three corners", [*start, *four[:3]], "--corners: has 3 corners; give four"),
    ("a corner that is none", [*start, *four[:3], "here"], '"here" is not possible'),
    ("a corner of three numbers", [*start, *four[:3], "1,2,3"], '"1,2,3" is not possible'),
    ("a corner that is not finite", [*start, *four[:3], "nan,2"], '"nan,2" is not possible'),
    ("corners counter-clockwise", [*start, *four[::-1]], "counter-clockwise, as in a mirror; give top left"),
    ("corners crosswise", [*start, four[0], four[2], four[1], four[3]], "convex quadrilateral"),
    ("a corner inside", [*start, *four[:2], "400,300", four[3]], "see bottom right (400,300)"),
    ("three corners in line", [*start, *four[:2], "655.875,430.25", four[3]], "see bottom right"),
    ("two equal corners", [*start, four[0], four[0], *four[2:]], "0 pixels apart; 16 or more"),
    ("corners far outside", [*start, *[f"{x * 9},{y * 9}" for x, y in IN_PHOTO]], "outside of photo.jpg, which is 1300 x 900"),
    ("a view of another maker", ["compare", "view.npy", "photo.jpg", *with_corners], "does not say which display it shows"),
    ("a part of a view", ["compare", "part.png", "photo.jpg", *with_corners], "a part of the camera's 480 x 270"),
    ("bad corners of the view", [*start, *four, "--view-corners", "1,1"], "--view-corners: has 1 corner; give four"),
    ("view corners far outside", [*start, *four, "--view-corners", "0,0", "1e9,0", "1e9,1e9", "0,1e9"], "outside of view.png"),
    ("a black photograph", ["compare", "view.png", "black.png", *with_corners], "photograph's red channel is black between"),
    ("a photograph without blue", ["compare", "view.png", "no_blue.png", *with_corners], "the photograph's blue channel is black"),
    ("a white photograph", ["compare", "view.png", "white.png", *with_corners], "the photograph is saturated on 100.0 %"),
    ("a black view", ["compare", "dark.npy", "photo.jpg", *with_corners, "--view-corners", *text(IN_VIEW)], "view is black"),
    ("no overlap", [*start, *four, "--view-corners", "500,9", "900,9", "900,200", "500,200"], "shows no part of the screen"),
    ("too small a part", [*start, *four, "--crop", "100,100,109,200"], "no square of 11 x 11"),
    ("a part outside", [*start, *four, "--crop", "100,100,1090,200"], "--crop"),
    ("no photograph", ["compare", "view.png", "none.jpg", *with_corners], "none.jpg"),
    ("an overlay without corners", ["compare", "view.png", "view.png", "-o", "overlay.png"], "--overlay: is for a photograph"),
    ("a fit without corners", ["compare", "view.png", "view.png", "--fit-corners"], "--fit-corners: is for a photograph"),
    ("a blur without corners", ["compare", "view.png", "view.png", "--fit-blur"], "--fit-blur: is for a photograph"),
    ("an overlay nowhere", [*start, *four, "-o", "none/overlay.png"], "none"),
    ("an overlay without a name", [*start, *four, "-o", ""], "--overlay: is empty"),
    ("a difference of another kind", [*start, *four, "--difference", "difference.tiff"], ".png, .exr and .npy"),
]:
    checks.refused(program, name, arguments, words)
checks.finish()
