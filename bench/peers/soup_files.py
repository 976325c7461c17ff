"""Reading and writing of what the Python peers and the runner exchange; numpy only."""
import numpy


def read_ply(path):
    """Binary PLY as tetsoup and this module write it: float x y z, then triangles as one count byte and three int32."""
    with open(path, "rb") as file:
        header = b""
        while not header.endswith(b"end_header\n"):
            header += file.readline()
        counts = [int(line.split()[2]) for line in header.decode().splitlines() if line.startswith("element")]
        vertices = numpy.fromfile(file, "<f4", counts[0] * 3).reshape(-1, 3)
        faces = numpy.fromfile(file, numpy.dtype([("count", "u1"), ("corners", "<i4", 3)]), counts[1])
    if (faces["count"] != 3).any():
        raise SystemExit(f"{path}: not what tetsoup writes")
    return vertices, faces["corners"].copy()


def write_ply(path, vertices, triangles):
    faces = numpy.empty(len(triangles), numpy.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"], faces["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(triangles)}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        file.write(vertices.astype("<f4").tobytes() + faces.tobytes())


def write_raw(path, vertices, triangles):
    """What the C++ peers read: two counts, vertices, triangles."""
    with open(path, "wb") as file:
        file.write(numpy.array([len(vertices), len(triangles)], "<u4").tobytes())
        file.write(vertices.astype("<f4").tobytes() + triangles.astype("<u4").tobytes())


def read_raw(path):
    data = open(path, "rb").read()
    vertex_count, triangle_count = numpy.frombuffer(data, "<u4", 2)
    vertices = numpy.frombuffer(data, "<f4", vertex_count * 3, 8).reshape(-1, 3)
    return vertices, numpy.frombuffer(data, "<u4", triangle_count * 3, 8 + vertex_count * 12).reshape(-1, 3)


def read_surface(path):
    """PLY as above, or OFF as CGAL writes it."""
    if str(path).endswith(".ply"):
        return read_ply(path)
    with open(path, encoding="ascii") as file:
        words = [line for line in file if line.strip() and not line.startswith(("#", "OFF"))]
    vertex_count, face_count = (int(word) for word in words[0].split()[:2])
    vertices = numpy.loadtxt(words[1:1 + vertex_count], usecols=(0, 1, 2))
    faces = numpy.loadtxt(words[1 + vertex_count:1 + vertex_count + face_count], usecols=(1, 2, 3), dtype=numpy.int64)
    return vertices, faces


def write_medit(path, vertices, tets):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(vertices)}\n")
        numpy.savetxt(file, vertices, "%.9g %.9g %.9g 0")
        file.write(f"Tetrahedra\n{len(tets)}\n")
        numpy.savetxt(file, numpy.asarray(tets) + 1, "%d %d %d %d 0")
        file.write("End\n")


def read_medit(path):
    words = open(path, encoding="ascii").read().split()

    def block(name, columns):
        if name not in words:
            return numpy.zeros((0, columns))
        at = words.index(name) + 1
        count = int(words[at])
        return numpy.array(words[at + 1:at + 1 + count * columns], dtype=float).reshape(count, columns)

    return block("Vertices", 4)[:, :3], block("Tetrahedra", 5)[:, :4].astype(numpy.int64) - 1
