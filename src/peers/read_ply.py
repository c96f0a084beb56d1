def read_ply(name):
    """Vertices and normals (n, 6), triangles (m, 3)."""
    with open(os.path.join(HERE, name), "rb") as file:
        counts = []
        for line in iter(file.readline, b"end_header\n"):
            if line.startswith(b"element"):
                counts.append(int(line.split()[2]))
        vertices = np.fromfile(file, "<f4", 6 * counts[0]).reshape(-1, 6)
        return vertices, np.fromfile(file, np.dtype([("three", "u1"), ("v", "<i4", 3)]), counts[1])["v"]
