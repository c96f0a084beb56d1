"""The frames of an animated PNG as another program reads them. Usage: apng_frames.py FILE RAW; prints frames, columns, rows, the
milliseconds of a frame and how often it repeats (0: without end), and writes all RGB codes to RAW."""
import sys

from PIL import Image, ImageSequence

picture = Image.open(sys.argv[1])
with open(sys.argv[2], "wb") as raw:
    for frame in ImageSequence.Iterator(picture):
        raw.write(frame.convert("RGB").tobytes())
print(picture.n_frames, *picture.size, round(picture.info["duration"]), picture.info["loop"])
