"""Pictures of linear light as arrays (rows, columns, 3): reads those of lfdsim, POV-Ray and Blender, writes PNG for viewing."""
import struct
import zlib

import numpy as np
from PIL import Image


def read_ppm(path):
    """Binary PPM, of 8 or 16 bits a colour."""
    data = path.read_bytes()
    words, at = [], 0
    while len(words) < 4:
        line_end = data.index(b"\n", at)
        words += data[at:line_end].split(b"#")[0].split()
        at = line_end + 1
    columns, rows, most = map(int, words[1:])
    return np.frombuffer(data, ">u2" if most > 255 else "u1", rows * columns * 3, at).reshape(rows, columns, 3) / most


def read_exr(path):
    """OpenEXR of one part in scan lines, not compressed or by ZIP, with channels R, G and B."""
    data = path.read_bytes()
    head, at = {}, 8
    while data[at]:
        name_end = data.index(b"\0", at)
        kind_end = data.index(b"\0", name_end + 1)
        size, = struct.unpack_from("<i", data, kind_end + 1)
        head[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", head["dataWindow"])
    columns, rows, compression = x1 - x0 + 1, y1 - y0 + 1, head["compression"][0]
    if compression not in (0, 2, 3):
        raise RuntimeError(f"{path}: has a compression that cannot be read here")
    block, channels, rest = {0: 1, 2: 1, 3: 16}[compression], [], head["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        channels.append((name.decode(), {1: "<f2", 2: "<f4"}[rest[0]]))
        rest = rest[16:]
    picture = np.zeros((rows, columns, 3))
    line = np.dtype([(name, kind, columns) for name, kind in channels])
    for place in struct.unpack_from(f"<{-(-rows // block)}Q", data, at + 1):
        y, size = struct.unpack_from("<ii", data, place)
        high = min(block, y1 + 1 - y)
        raw = data[place + 8:place + 8 + size]
        if size < high * line.itemsize:
            steps = np.frombuffer(zlib.decompress(raw), np.uint8).astype(np.int64)
            steps[1:] -= 128
            both = np.cumsum(steps).astype(np.uint8)
            raw = np.empty_like(both)
            half = (len(both) + 1) // 2
            raw[0::2], raw[1::2] = both[:half], both[half:]
            raw = raw.tobytes()
        lines = np.frombuffer(raw, line, high)
        for k, name in enumerate("RGB"):
            picture[y - y0:y - y0 + high, :, k] = lines[name]
    return picture


def read(path):
    return {".npy": lambda p: np.load(p).astype(float), ".ppm": read_ppm, ".exr": read_exr}[path.suffix](path)


def write_png(path, light):
    light = np.clip(light, 0, 1)
    code = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    Image.fromarray(np.rint(255 * code).astype(np.uint8)).save(path)


def rmse(a, b):
    return float(np.sqrt(np.mean((a - b) ** 2)))


def psnr(a, b):
    return float(-20 * np.log10(max(rmse(a, b), 1e-9)))
