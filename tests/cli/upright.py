"""Pictures of cameras that were turned, by their Exif data: every command takes them upright, as viewers show them."""
import json
import math

import numpy as np
from PIL import Image, ImageOps

from program import Checks, Program

program, checks = Program(), Checks()
folder = program.folder
WIDTH, HEIGHT = 88, 48  # the tiny panel; multiples of 8, so that a JPEG's blocks are turned as a whole
x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
picture = Image.fromarray(np.stack([2 * x + 40, 4 * y + 20, x + y], 2).astype(np.uint8))
picture.save(folder / "upright.png")
BACK = [Image.FLIP_LEFT_RIGHT, Image.ROTATE_180, Image.FLIP_TOP_BOTTOM, Image.TRANSPOSE, Image.ROTATE_90, Image.TRANSVERSE,
        Image.ROTATE_270]
scene = (folder / "tiny.toml").read_text().replace("depth_mm = 20.0\nheight_mm = 18.0\n", "")
scene += '[[content.object]]\nimage = "NAME"\nheight_mm = 18.0\nposition_mm = [0.0, 0.0, 5.0]\n'


def shown(name):
    """The panel, the scene and a comparison with this picture."""
    (folder / "scene.toml").write_text(scene.replace("NAME", name))
    program.must(f"render tiny.toml --panel-image {name} --samples 4 --seed 1 -o panel.npy")
    program.must("photo scene.toml -o scene.npy")
    difference = json.loads(program.must(f"compare upright.png {name} --json"))["rmse"]
    return np.load(folder / "panel.npy"), np.load(folder / "scene.npy"), np.array(difference)


there = shown("upright.png")
checks.that(all(part.max() > 0.2 for part in there[:2]), "the upright picture is dark")
for orientation in range(1, 9):
    exif = Image.Exif()
    exif.endian = "<" if orientation % 2 else ">"
    exif[0x0112] = orientation
    stored = picture.transpose(BACK[orientation - 2]) if orientation > 1 else picture
    for name, options in [("turned.png", {}), ("turned.jpg", {"quality": 98, "subsampling": 0})]:
        stored.save(folder / name, exif=exif, **options)
        assert ImageOps.exif_transpose(Image.open(folder / name)).size == (WIDTH, HEIGHT)
        most = 0.03 if name.endswith("jpg") else 0
        for what, same, now in zip(["panel", "scene", "comparison"], there, shown(name)):
            difference = np.abs(now - same).max() if now.shape == same.shape else math.inf
            checks.that(difference <= most, f"{name}, orientation {orientation}, {what}: {difference}")

# Damaged Exif data count as none: Pillow's own data, cut off anywhere, and random bytes of them changed.
exif = Image.Exif()
exif[0x0112] = 6
whole = exif.tobytes()
generator = np.random.default_rng(1)
for length in range(0, len(whole), 5):
    data = bytearray(whole)
    data[generator.integers(6, len(data))] ^= 255
    picture.save(folder / "damaged.jpg", exif=bytes(data[:length]))
    program.must("compare damaged.jpg damaged.jpg")
checks.finish()
