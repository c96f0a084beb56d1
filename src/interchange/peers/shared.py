def read_ply(name):
    """Vertices and normals (n, 6), triangles (m, 3)."""
    with open(os.path.join(HERE, name), "rb") as file:
        counts = []
        for line in iter(file.readline, b"end_header\n"):
            if line.startswith(b"element"):
                counts.append(int(line.split()[2]))
        vertices = np.fromfile(file, "<f4", 6 * counts[0]).reshape(-1, 6)
        return vertices, np.fromfile(file, np.dtype([("three", "u1"), ("v", "<i4", 3)]), counts[1])["v"]


def lens_axes(array):
    """(n, 2) axes of all lenses in the array's frame, from its middle, row after row."""
    x, y = ((np.arange(n) + 0.5 - n / 2) * p for n, p in zip(array["count"], array["pitch_mm"]))
    axes = np.stack(np.meshgrid(x, y), axis=-1)
    if array["staggered"]:  # odd rows to the right
        axes[:, :, 0] += (np.arange(len(y))[:, None] % 2 - 0.5) * array["pitch_mm"][0] / 2
    return axes.reshape(-1, 2)


def array_place(array):
    """(4, 4), from the array's frame, z from its lowest point, to the display's."""
    place = np.eye(4)
    place[:3, :3] = array["turn"]
    place[:3, 3] = array["shift_mm"] + place[:3, 2] * array["base_z_mm"]
    return place


def level_place(array):
    """The same of what lies on the panel, whatever way the array leans."""
    place = np.eye(4)
    place[2, 3] = array["base_z_mm"]
    return place
