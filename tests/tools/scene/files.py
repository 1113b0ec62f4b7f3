"""Files of many places, and scenes read back without code of the project."""
import json
import math
import struct

from gltf.builder import *
from gltf.checks import *
from schema import complaint


def grid(columns):
    """A bumpy sheet of 2 * columns^2 triangles, from 0 0 0 to `columns` along x and z, in whole eighths."""
    points = [(float(x), round(8 * math.sin(x * 0.7) * math.cos(z * 0.4)) / 8, float(z))
              for x in range(columns + 1) for z in range(columns + 1)]
    faces = []
    for x in range(columns):
        for z in range(columns):
            a = x * (columns + 1) + z
            faces += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    return points, faces


def placed_by(matrices, name, points, faces):
    """A file that places one mesh by these matrices."""
    gltf = Gltf()
    mesh = gltf.mesh(primitive(gltf, points, faces), name=name)
    for matrix in matrices:
        gltf.node(mesh=mesh, matrix=columns(matrix))
    return gltf


def sheets(matrices, side=12):
    return placed_by(matrices, "sheet", *grid(side))


def solids(*matrices):
    return placed_by(matrices, "solid", POINTS, FACES)


class Scene:
    """The parts of a scene file, by docs/format.md."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        self.magic, = struct.unpack_from("<4s", data, 0)
        meshes, instances, nodes = struct.unpack_from("<3I", data, 24)
        self.max_error, = struct.unpack_from("<f", data, 64)
        sizes = struct.unpack_from("<%dI" % meshes, data, 128)
        at = 128 + 4 * meshes
        self.meshes = []
        for size in sizes:
            at += -at % 64
            self.meshes.append(data[at:at + size])
            at += size
        at += -at % 64 + 64 * nodes
        self.instances = []
        for i in range(instances):
            numbers = struct.unpack_from("<8f4I", data, at + 48 * i)
            self.instances.append({"rotation": numbers[0:4], "translation": numbers[4:7], "scale": numbers[7],
                                   "mesh": numbers[8], "user": numbers[10], "source": numbers[11]})
        if at + 48 * instances != len(data):
            fail("%s has %d bytes, not %d" % (path, len(data), at + 48 * instances))

    def triangles(self):
        """The triangles of all instances in the world."""
        of_mesh = []
        for number, mesh in enumerate(self.meshes):
            with open("mesh.espl", "wb") as file:
                file.write(mesh)
            of_mesh.append(corners_of("mesh.espl"))
        return [tuple(placed(instance, corner) for corner in triangle)
                for instance in self.instances for triangle in of_mesh[instance["mesh"]]]


def placed(instance, point):
    x, y, z, w = instance["rotation"]
    n = x * x + y * y + z * z + w * w
    rows = (((w * w + x * x - y * y - z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), (w * w - x * x + y * y - z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), (w * w - x * x - y * y + z * z)))
    return tuple(instance["scale"] * sum(row[k] * point[k] for k in range(3)) / n + moved_by
                 for row, moved_by in zip(rows, instance["translation"]))


def documented(verb, output):
    """The JSON document, which the schema of the verb describes."""
    wrong = complaint(verb, output)
    if wrong:
        fail("the JSON is not what %s.json describes: %s" % (verb, wrong))
    return json.loads(output) if output else {}


def baked(gltf, mode, *options, name="case.glb", code=0, output="case.esps"):
    """Bakes a file as a scene. Returns the report."""
    if not isinstance(gltf, str):
        gltf.write(name)
        gltf = name
    done = run("bake", gltf, "-o", output, "--instances", mode, "--json", *options, code=code)
    return documented("bake", done.stdout)


def bakes_to(gltf, mode, expected, instances, meshes, *options):
    """The file bakes to a scene of these triangles, with so many instances and meshes, which passes every check."""
    report = baked(gltf, mode, *options)
    if not report or "error" in report:
        return report
    scene = Scene("case.esps")
    found = (len(scene.instances), len(scene.meshes))
    if found != (instances, meshes):
        fail("%d instances of %d meshes, not %d of %d" % (*found, instances, meshes))
    size = max(abs(x) for triangle in expected for corner in triangle for x in corner) if expected else 1.0
    compare(expected, scene.triangles(), report["total_error"] + 1e-6 * size)
    run("verify", "case.esps", "--deep", "--source", "case.glb", *options)
    return report


def close(what, actual, wanted, tolerance):
    if actual is None or abs(actual - wanted) > tolerance:
        fail("%s is %s, not %s" % (what, actual, wanted))


def is_equal(what, actual, wanted):
    if actual != wanted:
        fail("%s is %r, not %r" % (what, actual, wanted))
