"""The names of meshes and materials in the report, and how many triangles have them."""
import base64
import json
import struct

from .assimp import AC
from .claims import SQUARE
from .off import off_box
from .stl import stl_text
from .three_mf import mesh, model, package, thing

CORNERS = base64.b64encode(struct.pack("<9f", 0, 0, 0, 2, 0, 0, 2, 2, 0)).decode()
LONG = "\u00e4" * 300  # 600 bytes each, and one for the slash: 199 characters of the first one are left
FACES = mesh(((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)), ((0, 1, 2), (0, 2, 3))).replace('v3="2"', 'v3="2" pid="9" p1="1"')
GROUPS = "o {}\nusemtl {}\nf 1 2 3\no other\nf 1 3 4\nf 1 2 4\n"


def gltf():
    """Nodes: a door in a room without a name in walls, twice; and one below names of 1,200 bytes."""
    primitives = [{"attributes": {"POSITION": 0}, "material": 1}, {"attributes": {"POSITION": 0}}]
    nodes = [{"name": "Walls", "children": [1]}, {"children": [2, 3]}, {"name": "Door_02", "mesh": 0}, {"name": "Door_03", "mesh": 0},
             {"name": LONG, "children": [5]}, {"name": LONG, "mesh": 1}]
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": nodes, "materials": [{"name": "glass"}, {"name": "a\0b"}, {"name": 5}],
        "meshes": [{"name": "leaf", "primitives": primitives}, {"primitives": primitives[:1]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [2, 2, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + CORNERS}]})


def source_names(claims):
    claims.write("materials.mtl", "newmtl unused\nnewmtl concrete\n")
    doors = ["Walls/Door_02"] * 2 + ["Walls/Door_03"] * 2 + ["..." + "\u00e4" * 199 + "/" + LONG]
    long, wrong, right = "n" * (1 << 20), b"\xc3\xa4 caf\xe9 \xed\xa0\x80 \xf5 \x01", "\u00e4 caf\ufffd \ufffd\ufffd\ufffd \ufffd \1"
    base = '<basematerials id="9"><base name="oak"/><base name="&#228;&lt;"/></basematerials>'
    for name, content, meshes, paths, materials in (
            ("o.obj", SQUARE + "f 1 2 3\nmtllib materials.mtl\n" + GROUPS.format("a\ng b", "concrete"), [("", 1), ("a/b", 1), ("other", 2)], None,
             [("", 1), ("unused", 0), ("concrete", 3)]),
            ("wrong.obj", SQUARE.encode() + GROUPS.encode().replace(b"{}", wrong, 1).replace(b"{}", long.encode()), [(right, 1), ("other", 2)], None,
             [("", 0), (long, 3)]),
            ("a.stl", stl_text(name="wall") + stl_text(name="wall") + stl_text(name=""), [("wall", 12), ("wall", 12), ("", 12)], None, [("", 36)]),
            ("a.off", off_box(), [("", 12)], None, [("", 12)]),
            ("a.3mf", package(model(base + thing(1, FACES, 'name="Chair&#10;1"'), '<item objectid="1"/><item objectid="1"/>')),
             [("Chair\n1", 2)] * 2, None, [("", 2), ("oak", 0), ("\u00e4<", 2)]),
            ("a.gltf", gltf(), [("leaf-0", 1), ("leaf-1", 1)] * 2 + [("", 1)], doors, [("glass", 0), ("a\0b", 3), ("", 0), ("", 2)]),
            ("a.ac", AC.format(2).replace("world\n", 'world\nname "Walls"\n').replace('""', '"caf\xe9"').replace("poly\n", 'poly\nname "Door"\n'), [("", 2)], ["Walls/Door"], [("caf\ufffd", 2)])):
        claims.write(name, content)
        for options in ([], ["--instances", "all"]):
            _, document, stderr = claims.run(name, "--materials", "--allow-empty", "--max-dropped", "100", *options)
            file = document.get("inputs", [{}])[0]
            found = [list(zip(file.get("mesh_names", []), file.get("mesh_triangles", []))), file.get("mesh_paths"), document.get("materials")]
            claims.check(f"source names: the report has those of {name}, {options}", found == [
                meshes, paths or [""] * len(meshes), [{"number": i, "file": 0, "name": n, "triangles": t} for i, (n, t) in enumerate(materials)]],
                f"{found} {stderr}"[:2000])
    _, document, stderr = claims.run("a.off", claims.write("b.gltf", gltf()), "--materials")
    numbers = [(material["number"], material["file"]) for material in document["materials"]]
    claims.check("source names: numbers of materials go on from file to file, and are printed",
                 numbers == [(0, 0), (1, 1), (2, 1), (3, 1), (4, 1)] and "materials: 1 glass, 2 a?b, 3, 4" in stderr, stderr)
    claims.check("source names: materials that are not stored are not listed", "materials" not in claims.run("a.off")[1], "materials")
