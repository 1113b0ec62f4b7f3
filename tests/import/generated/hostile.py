"""Files of some megabytes that are made to cost time: reading one takes time in proportion to its size, n log n at most."""
import base64
import json
import math
import struct

from .claims import SQUARE
from .ply import ply_header
from .three_mf import mesh, model, moved, package, parts, thing

LIMIT = ["--import-seconds", "5"]  # of the processor; without care each takes minutes, or all memory
TRIANGLE = mesh([(0, 0, 0), (2, 0, 0), (2, 2, 0)], [(0, 1, 2)])
VERTICES = ["element vertex 3", *(f"property float {axis}" for axis in "xyz")]
FACES = ["element face 1", "property list uchar int vertex_index"]
CORNERS = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}


def object_of_two(count):
    """2^count triangles."""
    return package(model(thing(1, TRIANGLE) + "".join(thing(i, parts(i - 1, i - 1)) for i in range(2, count + 2)), f'<item objectid="{count + 1}"/>'))


def chain(count):
    """Each object moves the one before; the last one is built often."""
    return package(model(thing(1, TRIANGLE) + "".join(thing(i, parts((i - 1, moved(0, 0, 0)))) for i in range(2, count + 2)),
                         f'<item objectid="{count + 1}"/>' * (count // 10)))


def long_name(count):
    return package(model(thing(1, TRIANGLE) + thing(2, mesh([], [])) + thing(3, parts(1, *[2] * count), f'name="{"x" * 30 * count}"'), '<item objectid="3"/>'))


def material_groups(count):
    groups = "".join(f'<basematerials id="{i}"><base/></basematerials>' for i in range(10, count + 10))
    triangles = f'<triangle v1="0" v2="1" v3="2" pid="{count + 9}" p1="0"/>' * (2 * count)
    return package(model(groups + thing(1, TRIANGLE.replace("<triangles>", "<triangles>" + triangles))))


def properties(count):
    rows = [f"{place}{' 0' * count}\n" for place in ("0 0 0", "2 0 0", "2 2 0")]
    return ply_header("ascii", *VERTICES, *(f"property float p{i}" for i in range(count)), *FACES) + "".join(rows) + "3 0 1 2\n"


def elements(count):
    return ply_header("ascii", *VERTICES, *FACES, *(f"element e{i} 0" for i in range(count))) + "0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n"


def outline(corners):
    return "".join("v {!r} {!r} 0\n".format(*corner) for corner in corners) + f"f {' '.join(map(str, range(1, len(corners) + 1)))}\n"


def star(count):
    return outline([(r * math.cos(a), r * math.sin(a)) for a, r in ((2 * math.pi * i / count, 1 if i % 2 else 0.99) for i in range(count))])


def spiral(count):
    there = [(math.cos(i / 40) * (1 + i / 1000), math.sin(i / 40) * (1 + i / 1000)) for i in range(count // 2)]
    return outline(there + [(0.999 * x, 0.999 * y) for x, y in reversed(there)])


def comb(count):
    return outline([(count, -1), (count, 9)] + [(count - 1 - i, 9 if i % 2 else 0) for i in range(count - 3)] + [(0, -1)])


def beams(count):
    """Thin triangles, all of which pass all corners."""
    rays = [corner for i in range(count // 2) for corner in ((count, count + 1e-6 * i), (i, i + 1e-6 * i))]
    return outline(rays + [(2 * count, -1)])


def groups(count):
    return SQUARE + f"o {'x' * 20 * count}\n" + "".join(f"g {i}\nf 1 2 3\n" for i in range(count))


def libraries(count):
    return SQUARE + "".join(f"mtllib {'./' * (i % 200)}{'.//' * (i // 200)}library.mtl\n" for i in range(count)) + "f 1 2 3\n"


def gltf(nodes, primitives=({"attributes": {"POSITION": 0}},), accessors=(CORNERS,), parts=(struct.pack("<9f", 0, 0, 0, 2, 0, 0, 2, 2, 0),), **more):
    """A mesh of some primitives, whose accessors have the parts of one buffer as their views."""
    views = [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(part)} for i, part in enumerate(parts)]
    data = b"".join(parts)
    return json.dumps({"asset": {"version": "2.0"}, "nodes": nodes, "meshes": [{"primitives": primitives}], "accessors": accessors, "bufferViews": views,
                       "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}], **more})


def joints(count):
    """Each node has a skin of as many joints as there are nodes."""
    return gltf([{"mesh": 0, "skin": 0}] * count, skins=[{"joints": [0] * count}])


def morphs(count):
    """Each node places a mesh of as many morph targets as there are nodes."""
    primitive = {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}] * count}
    return gltf([{"mesh": 0}] * count, meshes=[{"primitives": [primitive], "weights": [0.5] * count}])


def replaced(vertices, places, values, corners, count):
    """So many triangles of vertices that are at 0 but for those at some places, which have values."""
    positions = {"componentType": 5126, "count": vertices, "type": "VEC3", "sparse": {
        "count": len(places), "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 1}}}
    return gltf([{"mesh": 0}], [{"attributes": {"POSITION": 0}, "indices": 1}] * count,
                [positions, {"bufferView": 2, "componentType": 5125, "count": 3, "type": "SCALAR"}],
                [struct.pack(f"<{len(places)}I", *places), values, struct.pack("<3I", *corners)])


def sparse(count):
    """Each primitive reads an accessor of which half a million elements are replaced."""
    every = 500000
    return replaced(every, range(every), struct.pack("<9f", 0, 0, 0, 2, 0, 0, 2, 2, 0) + bytes(12 * every - 36), (0, 1, 2), count)


def apart(count):
    """Each primitive is a triangle of the first and the last of a million vertices."""
    last = 1000000
    return replaced(last + 1, (1, last), struct.pack("<6f", 2, 0, 0, 2, 2, 0), (0, 1, last), count)


def wide(count):
    return gltf([{"mesh": 0, "children": list(range(1, count))}] + [{}] * (count - 1))


def deep(count):
    return gltf([{"children": [i + 1]} for i in range(count - 1)] + [{"mesh": 0}])


def points(count):
    """Each node places as many primitives without triangles as there are nodes."""
    return gltf([{"mesh": 0}] * count, [{"attributes": {"POSITION": 0}}] + [{"attributes": {}, "mode": 0}] * count)


# What is in it, its maker with a count, and how many triangles it has, or the words that refuse it.
KINDS = [
    ("3MF: objects of the one before twice", "twice.3mf", object_of_two, 25, ["build", "1048576 copies", "--instances auto"]),
    ("3MF: a chain of objects at many places", "chain.3mf", chain, 100000, 10000),
    ("3MF: components of an object with a long name", "long.3mf", long_name, 50000, 1),
    ("3MF: groups of materials", "materials.3mf", material_groups, 100000, 200001),
    ("PLY: properties", "properties.ply", properties, 200000, 1),
    ("PLY: elements", "elements.ply", elements, 200000, 1),
    ("OBJ: corners of a star", "star.obj", star, 60000, 59998),
    ("OBJ: corners of a spiral", "spiral.obj", spiral, 60000, 59998),
    ("OBJ: corners of a comb", "comb.obj", comb, 60000, 59998),
    ("OBJ: corners between thin triangles", "beams.obj", beams, 100000, ["line 100002", "outline of a face", "Triangulate it"]),
    ("OBJ: groups of an object with a long name", "names.obj", groups, 100000, ["mesh 134", "names", "Shorten it"]),
    ("OBJ: paths to a library", "paths.obj", libraries, 10000, 1),
    ("glTF: children of a node", "wide.gltf", wide, 300000, 1),
    ("glTF: nodes below each other", "deep.gltf", deep, 300000, 1),
    ("glTF: nodes with a skin of as many joints", "skins.gltf", joints, 30000, 30000),
    ("glTF: nodes with a mesh of as many morph targets", "morphs.gltf", morphs, 30000, 30000),
    ("glTF: primitives of one sparse accessor", "sparse.gltf", sparse, 30000, 30000),
    ("glTF: triangles of vertices that are far apart in their list", "apart.gltf", apart, 30000, 30000),
    ("glTF: nodes of primitives without triangles", "points.gltf", points, 50000, ["node 21", "1048576 copies", "--instances auto"]),
]


def hostile(claims):
    claims.write("library.mtl", "newmtl a\n" * 100000)
    for claim, name, make, count, expected in KINDS:
        claim = f"{claim}: {count} of them are read in time"
        content = make(count)
        if isinstance(expected, list):
            claims.refuses(claim, name, content, *expected, options=LIMIT)
            continue
        claims.write(name, content)
        code, document, stderr = claims.run(name, "--effort", "fast", "--max-dropped", "100", *LIMIT)
        claims.check(claim, code == 0, stderr)
        claims.check(claim, document.get("source_triangles") == expected, f"{document.get('source_triangles')} triangles, not {expected}")
