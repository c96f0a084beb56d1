"""Two models to show: a relief of coloured tiles (Wavefront OBJ) and a pyramid with colours at its corners (glTF)."""
import base64
import json
import math

import numpy as np

TILES = 9  # across


def write(folder):
    """relief.obj with its materials, and pyramid.gltf."""
    (folder / "relief.mtl").write_text("".join(f"newmtl m{k}\nKd {k % 2:.1f} {k // 2 % 2:.1f} {0.2 + 0.8 * (k // 4):.1f}\n" for k in range(8)))
    (folder / "relief.obj").write_text(relief())
    (folder / "pyramid.gltf").write_text(json.dumps(pyramid()))


def relief():
    """Square tiles at different heights, without sides."""
    lines = ["mtllib relief.mtl"]
    for k in range(TILES * TILES):
        x, y, z = k % TILES, k // TILES, 2 * math.sin(1.7 * k)
        lines += [f"v {x + dx} {y + dy} {z:.4f}" for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines += [f"usemtl m{(3 * k + k // TILES) % 8}", f"f {4 * k + 1} {4 * k + 2} {4 * k + 3} {4 * k + 4}"]
    return "\n".join(lines) + "\n"


def pyramid():
    """Its top looks at the viewer."""
    places = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0.2, 0.1, 1]], np.float32)
    colours = np.array([[1, 0.1, 0.1], [0.1, 1, 0.1], [0.1, 0.1, 1], [1, 1, 0.1], [1, 1, 1]], np.float32)
    faces = np.array([0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4], np.uint16)
    data = places.tobytes() + colours.tobytes() + faces.tobytes()
    views = [{"buffer": 0, "byteOffset": at, "byteLength": length} for at, length in ((0, 60), (60, 60), (120, 24))]
    kinds = [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3", "min": places.min(axis=0).tolist(), "max": places.max(axis=0).tolist()},
             {"bufferView": 1, "componentType": 5126, "count": 5, "type": "VEC3"}, {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"}]
    mesh = {"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}, "indices": 2}]}
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [mesh], "accessors": kinds,
            "bufferViews": views, "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
