"""The digits of positions: readers keep numbers as files have them, in float64."""
import base64
import json
import os
import re
import struct

from .ply import ply_header
from .three_mf import mesh, model, moved, package, thing

# With 17 digits, as in maps and in the frame of the Earth, and with fewer than float32 has.
CORNERS = [(500123.45670000001, 5400321.1229999997, 612.30000000000007), (500133.45670000004, 5400321.1229999997, 612.30000000000007),
           (500123.45670000001, 5400331.1230000006, -0.1), (4156789.0123456791, 671234.56789012349, 4774321.0987654321)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
SINGLE = [(0.1, 0.25, -3.3), (10.1, 0.7, 0), (0.3, 9.9, 0), (5.5, 4.4, 3.3)]  # of which a file has the nearest float32
MOVED = (4156789.0123456791, 671234.56789012349, -4774321.0987654321)


def float32(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def words(corner):
    return " ".join(map(repr, corner))


def gltf(root=None, **node):
    corners = b"".join(struct.pack("<3f", *corner) for corner in SINGLE)
    data = corners + b"".join(struct.pack("<3I", *face) for face in FACES)
    views = [{"buffer": 0, "byteLength": len(corners)}, {"buffer": 0, "byteOffset": len(corners), "byteLength": len(data) - len(corners)}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(SINGLE), "type": "VEC3"},
                 {"bufferView": 1, "componentType": 5125, "count": 3 * len(FACES), "type": "SCALAR"}]
    return json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, **node}],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "bufferViews": views, "accessors": accessors,
                       "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}], **(root or {})})


def digits(claims):
    def keeps(claim, name, content, expected, *options):
        """The reordered source has exactly these positions."""
        claims.write(name, content)
        path = os.path.join(claims.folder, "reordered.ply")
        code, _, stderr = claims.run(name, "--reorder", path, "--bits", "24", *options)
        claims.check(claim, code == 0, stderr)
        if code == 0:
            with open(path, "rb") as file:
                header, data = file.read().split(b"end_header\n", 1)
            letter, size = ("d", 8) if b"property double x" in header else ("f", 4)
            count = int(re.search(rb"element vertex (\d+)", header)[1])  # formats without indices repeat corners
            found = {struct.unpack_from(f"<3{letter}", data, 3 * size * i) for i in range(count)}
            claims.check(claim, found == set(expected), f"{sorted(found)}, not {sorted(expected)}")

    vertices = [f"v {words(corner)}\n" for corner in CORNERS]
    obj = "".join(vertices) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES)
    keeps("OBJ: numbers keep their digits", "digits.obj", obj, CORNERS)
    keeps("OBJ: numbers keep their digits with --scale", "digits.obj", obj, [tuple(4 * x for x in corner) for corner in CORNERS], "--scale", "4")
    keeps("OBJ: numbers keep their digits with --unit", "digits.obj", obj, [tuple(0.001 * x for x in corner) for corner in CORNERS], "--unit", "mm")
    keeps("OBJ: numbers keep their digits with --up", "digits.obj", obj, [(x, z, -y) for x, y, z in CORNERS], "--up", "z")
    off = "OFF\n4 4 0\n" + "".join(words(corner) + "\n" for corner in CORNERS) + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
    keeps("OFF: numbers keep their digits", "digits.off", off, CORNERS)
    corners = ["outer loop\n" + "".join(f"vertex {words(CORNERS[i])}\n" for i in face) + "endloop\n" for face in FACES]
    keeps("STL: numbers of a text keep their digits", "digits.stl",
          "solid\n" + "".join(f"facet normal 0 0 0\n{loop}endfacet\n" for loop in corners) + "endsolid\n", CORNERS)
    keeps("RAW: numbers keep their digits", "digits.raw", "".join(" ".join(words(CORNERS[i]) for i in face) + "\n" for face in FACES), CORNERS)

    def three_mf(mesh, transform=""):
        return package(model(thing(1, mesh), f'<item objectid="1" {transform}/>'))

    keeps("3MF: numbers keep their digits", "digits.3mf", three_mf(mesh([map(repr, corner) for corner in CORNERS], FACES)), CORNERS)
    keeps("3MF: transforms are in float64", "digits.3mf", three_mf(mesh(SINGLE, FACES), moved(*MOVED)),
          [tuple(a + b for a, b in zip(corner, MOVED)) for corner in SINGLE])

    face = ["element face 4", "property list uchar int vertex_index"]
    for form, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        lists = b"".join(struct.pack(order + "B3i", 3, *each) for each in FACES)
        for kind, letter, expected in (("double", "d", CORNERS), ("float", "f", [tuple(map(float32, corner)) for corner in CORNERS]),
                                       ("int", "i", [tuple(map(int, corner)) for corner in CORNERS])):
            data = b"".join(struct.pack(order + "3" + letter, *map(int if letter == "i" else float, corner)) for corner in CORNERS)
            header = ply_header(form, "element vertex 4", *(f"property {kind} {axis}" for axis in "xyz"), *face)
            keeps(f"PLY: {form} numbers of type {kind} keep their digits", "digits.ply", header.encode() + data + lists, expected)
    text = ply_header("ascii", "element vertex 4", *(f"property double {axis}" for axis in "xyz"), *face)
    keeps("PLY: numbers of a text keep their digits", "digits.ply",
          text + "".join(words(corner) + "\n" for corner in CORNERS) + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES), CORNERS)

    singles = [tuple(map(float32, corner)) for corner in SINGLE]
    placed = [tuple(a + b for a, b in zip(corner, MOVED)) for corner in singles]
    keeps("glTF: the translation of a node is in float64", "digits.gltf", gltf(translation=MOVED), placed)
    keeps("glTF: the matrix of a node is in float64", "digits.gltf", gltf(matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *MOVED, 1]), placed)
    centre = {"extensionsUsed": ["CESIUM_RTC"], "extensions": {"CESIUM_RTC": {"center": MOVED}}}
    keeps("glTF: the centre of CESIUM_RTC is in float64", "digits.gltf", gltf(centre), placed)
    keeps("glTF: the centre of CESIUM_RTC is in the unit of the file", "digits.gltf", gltf(centre), [tuple(0.5 * x for x in corner) for corner in placed], "--scale", "0.5")
    keeps("glTF: positions of float32 stay", "digits.gltf", gltf(), singles)
