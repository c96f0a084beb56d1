"""A display for all programs: exported, rendered by the peer and by lfdsim."""
import json
import math
import pathlib
import shlex
import sys
import tomllib

import numpy as np
from PIL import Image

import pictures
import programs
from programs import ROOT

sys.path.insert(0, str(ROOT / "tests/oracle"))
import cases  # noqa: E402
import tracer  # noqa: E402
from display import resolve  # noqa: E402
from run import panel_images  # noqa: E402

MONKEY = "/usr/share/assimp/models/BLEND/Suzanne_248.blend"

READ = "import sys, numpy, mitsuba as m; m.set_variant('scalar_rgb'); numpy.save(sys.argv[2], numpy.array(m.Bitmap(sys.argv[1]))[:, :, :3])"


def described(name, size, degrees=0.0, diffuser=False, **over):
    """A display of displays/, seen from an angle; over: further keys."""
    a = math.radians(degrees)
    description = tomllib.loads((ROOT / f"displays/{name}.toml").read_text())
    for surface in description["lens"].get("surface", []):
        surface.setdefault("curvature_per_mm", 0.0)
    if not diffuser:
        description.pop("diffuser")
    camera = {"position_mm": [2000 * math.sin(a), 0.0, 2000 * math.cos(a)], "resolution": list(size)}
    return cases.merge(description, cases.merge({"camera": camera, "panel": {"encoding": "linear"}}, over))


class Scene:
    """The folder of a display and its panel image; lfdsim's pictures of it."""

    def __init__(self, program, folder, description, panel):
        self.program, self.folder = program, folder
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "given.toml").write_text(cases.to_toml(description))
        if isinstance(panel, np.ndarray):
            Image.fromarray(panel).save(folder / "given.png", compress_level=1)
        else:
            (folder / "given.png").write_bytes(panel.read_bytes())
        self.panel = "given.png"

    def lfdsim(self, *options, display="given.toml", panel="given.png"):
        """lfdsim's picture; its facts with the seconds of the process."""
        ran = programs.run([self.program, "render", display, "--panel-image", panel, *options, "-o", "lfdsim.npy", "--json", "--progress", "none"], self.folder)
        return pictures.read(self.folder / "lfdsim.npy"), {**json.loads(ran.text), "wall": ran.wall, "processor": ran.processor}


class Exported:
    """A scene for a peer."""

    def __init__(self, scene, peer, *options):
        self.peer, self.size = peer, tomllib.loads((scene.folder / "given.toml").read_text())["camera"]["resolution"]
        self.folder = scene.folder / ("-".join([peer, *options]).replace("--", ""))
        command = [scene.program, "export", peer, "given.toml", "--panel-image", "given.png", *options, "-o", self.folder, "--json", "--progress", "none"]
        self.ran = programs.run(command, scene.folder)
        self.told = json.loads(self.ran.text)

    def render(self, samples=1, times=1):
        """The peer's picture, each side `times` as many pixels; and how long it took. Raises PeerFailed."""
        width, height = (times * n for n in self.size)
        if self.peer == "pov":
            command, picture = ["povray", "+Iscene.pov", "+Oview.ppm", f"+W{width}", f"+H{height}", "-D", "-A", "+FP16", "File_Gamma=1.0"], "view.ppm"
        else:
            command, picture = shlex.split(self.told["command"]), self.told["picture"]
            if self.peer == "mitsuba":
                command[0] = programs.mitsuba_python()
            command += ["--samples", samples, "--size", f"{width}x{height}"]
        path = self.folder / picture
        path.unlink(missing_ok=True)
        ran = programs.run_peer(command, self.folder, path)
        if self.peer == "mitsuba":  # its files are compressed by wavelets: it reads them itself
            array = path.with_suffix(".npy")
            programs.run_peer([programs.mitsuba_python(), "-c", READ, path, array], self.folder, array)
            path = array
        return pictures.read(path), ran


def address(picture):
    """The panel pixel (2, rows, columns) that each pixel shows: column, row."""
    code = np.rint(255 * picture).astype(int)
    return np.stack([code[:, :, 0] * 16 + code[:, :, 2] // 16, code[:, :, 1] * 16 + code[:, :, 2] % 16])


class Truth:
    """The path of each pixel's ray by the double-precision tracer of tests/oracle, which shares no code with lfdsim."""

    def __init__(self, description):
        columns, rows = description["camera"]["resolution"]
        display = resolve(description)
        hits = tracer.trace(display, *tracer.camera_rays(display, *tracer.centers(display)))
        for name in ("status", "column", "row", "x", "y", "way"):
            setattr(self, name, getattr(hits, name).reshape(rows, columns))
        self.away = self._away()

    def _away(self):
        """Away from lens edges: the rays of a pixel and its eight neighbours meet the same lenses in the same order, and end alike."""
        key = self.way * np.uint64(8) + self.status.astype(np.uint64)
        wide = np.pad(key, 1)
        rows, columns = key.shape
        same = np.ones(key.shape, bool)
        for dy in range(3):
            for dx in range(3):
                same &= wide[dy:dy + rows, dx:dx + columns] == key
        same[[0, -1]] = same[:, [0, -1]] = False
        return same

    def near_border(self, pixels=1e-3):
        """Rays that meet the panel this close to a border of its pixels."""
        return (np.abs(self.x - np.rint(self.x)) < pixels) | (np.abs(self.y - np.rint(self.y)) < pixels)


def address_panel(description):
    return panel_images(*description["panel"]["pixels"])["address"]


def monkey_panel(program, folder):
    """Elemental images of a monkey's head, or of spheres where it is not installed."""
    path = pathlib.Path(folder) / "eia.png"
    model = MONKEY if pathlib.Path(MONKEY).exists() else "built-in:spheres"
    programs.run([program, "eia", ROOT / "displays/desktop-asphere.toml", "--model", model, "--tilt-deg", "-35", "-o", path, "--progress", "none"], folder)
    return path
