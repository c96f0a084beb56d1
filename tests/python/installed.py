"""What an installed wheel has to do, and that it is alone: run by wheel.sh."""

import pathlib
import re
import subprocess
import sys

import lfdsim

# What the standard for such wheels (PEP 599 and later) takes from the system, and Python's own.
SYSTEM = r"(lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|util|z|expat|ffi|crypt|nsl|resolv|python3[.\d]*)|ld-linux-x86-64)\.so"

MODEL = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0.3 0.2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"

package = pathlib.Path(lfdsim.__file__).parent
assert sys.prefix in str(package), package
pathlib.Path("pyramid.obj").write_text(MODEL)
display = lfdsim.Display.parse("""schema = 1
panel = { pixels = [88, 48], pixel_pitch_mm = 0.5 }
lens = { type = "ideal", aperture_radius_mm = 1.9, focal_length_mm = 4.5 }
array = { count = [11, 6], pitch_mm = 4.0, gap_mm = 5.0 }
camera = { position_mm = [0.0, 0.0, 400.0], frame_width_mm = 46.0, resolution = [96, 54] }
content = { depth_mm = 20.0, height_mm = 18.0 }
""")
view = lfdsim.render(display, model="pyramid.obj")
truth = lfdsim.photograph(display, model="pyramid.obj")
assert lfdsim.compare(view, truth)["ssim"] > 0.5
assert "pandas" not in sys.modules and lfdsim.analyze(display, "spot").tables

loaded = {line.split(maxsplit=5)[-1].strip() for line in open("/proc/self/maps") if ".so" in line}
programs = [package / "bin" / "lfdsim", package / "bin" / "lfdsim-model-reader"]
for program in programs:
    loaded.update(re.findall(r"=> (.+) \(0x", subprocess.run(["/usr/bin/ldd", program], check=True, capture_output=True, text=True).stdout))
strangers = {file for file in loaded if sys.prefix not in file and sys.base_prefix + "/lib/python" not in file
             and not re.match(SYSTEM, pathlib.Path(file).name)}  # fmt: skip
assert not strangers, strangers
print(f"{len(loaded)} libraries, all of the wheel or of every Linux")
