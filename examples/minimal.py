"""What a viewer sees of a display: minimal.py DISPLAY.toml VIEW.png"""
import pathlib
import sys

import lfdsim

# The description: panel, lenses, array, diffuser, camera. All its faults are reported together, with line and column.
display = lfdsim.Display.load(sys.argv[1])
for warning in lfdsim.check(display)["warnings"]:
    print("worth knowing:", warning)

# What the camera of the description sees of the scene that the display shows (float32, height x width x 3, linear light) ...
view = lfdsim.render(display)
# ... and the same scene without the display.
truth = lfdsim.photograph(display)
print("similarity to the scene (SSIM):", lfdsim.compare(view, truth)["ssim"])
pathlib.Path(sys.argv[2]).write_bytes(lfdsim.png(view))
