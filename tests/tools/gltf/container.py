"""The file itself: containers, buffers, restarts, extensions, hostile files."""
import os
import shutil
import struct

from .builder import *
from .checks import *
from .scene import instanced_file


def containers():
    claim("a buffer in the file, in base64, or beside it under a name with percent signs is the same")
    bakes(solid_file(), solid())
    bakes(solid_file(), solid(), name="case.gltf")
    solid_file().write("beside.gltf", ("bytes of it.bin", "bytes%20of%20it.bin"))
    bakes("beside.gltf", solid())
    claim("binary glTF is read by its content under any ending")
    solid_file().write("case.glb")
    shutil.copy("case.glb", "case.vrm")
    bakes("case.vrm", solid())
    claim("a file that is cut off, or is no glTF, is refused by name")
    with open("case.glb", "rb") as file:
        whole = file.read()
    for length in (5, 11, 19, 40, len(whole) - 1):
        with open("cut.glb", "wb") as file:
            file.write(whole[:length])
        refused("cut.glb", 3, "cut.glb", f"{length} bytes")
    with open("broken.gltf", "w") as file:
        file.write('{"asset": {"version": "2.0"}, "nodes": [}')
    refused("broken.gltf", 3, "broken.gltf", "line 1")
    claim("binary glTF whose header states fewer bytes than its chunks have is refused")
    for length in (0, 100, len(whole) - 1):
        with open("short.glb", "wb") as file:
            file.write(whole[:8] + struct.pack("<I", length) + whole[12:])
        refused("short.glb", 3, "short.glb", "header states")
    claim("bytes after the last chunk of binary glTF raise a warning, and a chunk of an unknown type raises none")
    for more, counted, kind in ((b"\0\0\0", 0, True), (b"\0\0\0", 3, True), (b"\0" * 99, 0, True),
                                (struct.pack("<I4s", 4, b"MORE") + b"more", 12, False)):
        with open("more.glb", "wb") as file:
            file.write(whole[:8] + struct.pack("<I", len(whole) + counted) + whole[12:] + more)
        warned(bakes("more.glb", solid()), "trailing_bytes", kind)
    refused(changed(solid_file(), "asset.version", "3.0"), 5, "glTF 3.0")
    refused(changed(changed(solid_file(), "asset", {}), "meshes", {"walls": {}}), 5, "glTF 1.0", "Convert it")
    claim("a missing or short file beside it is refused by name")
    solid_file().write("beside.gltf", ("short.bin", "absent.bin"))
    refused("beside.gltf", 2, "absent.bin", "No such file")
    solid_file().write("beside.gltf", ("short.bin", "short.bin"))
    os.truncate("short.bin", 40)
    refused("beside.gltf", 3, "short.bin", "shorter")
    solid_file().write("beside.gltf", ("short.bin", "https://example.org/case.bin"))
    refused("beside.gltf", 5, "https://example.org/case.bin", "Download")


def tile(path, json_text=b"", kind=b"b3dm", version=1, more=0):
    """The solid as a b3dm with that feature table, whose header states so many bytes more than it has."""
    solid_file().write("in_tile.glb")
    with open("in_tile.glb", "rb") as file:
        glb = file.read()
    tables = json_text + b" " * (bool(json_text) * (-(len(json_text) + 28) % 8)) + b'{"id":[0]}'.ljust(16)
    body = tables + glb + b"\0" * (-(28 + len(tables) + len(glb)) % 8)
    with open(path, "wb") as file:
        file.write(struct.pack("<4s6I", kind, version, 28 + len(body) + more, len(tables) - 16, 0, 16, 0) + body)


def tiles():
    claim("the glTF in a b3dm is read whatever its ending, and its triangles are those of the file alone")
    for name, features in (("case.b3dm", b'{"BATCH_LENGTH":1}'), ("case.bin", b""), ("case.b3dm", b'{"RTC_CENTER":[0,0,0]}')):
        tile(name, features)
        warned(bakes(name, solid()), "trailing_bytes", False)
    claim("a tile around a centre is refused by its name with the way out")
    tile("centre.b3dm", b'{"RTC_CENTER":[4e6,0,-1]}')
    refused("centre.b3dm", 5, "RTC_CENTER", "4e+06 0 -1", "0 0 0")
    claim("the centre of CESIUM_RTC moves all of a glTF")
    for required in (True, False):
        for centre in ([0, 0, 0], [0, 96, -8]):
            gltf = solid_file()
            gltf.extension("CESIUM_RTC", required)
            bakes(changed(gltf, "extensions", {"CESIUM_RTC": {"center": centre}}), solid(moved(*centre)))
    refused(changed(gltf, "extensions", {"CESIUM_RTC": {"center": [1, 2]}}), 3, "CESIUM_RTC", "center", "3 numbers")
    claim("tiles of other kinds, versions and lengths are refused by name")
    for kind in (b"i3dm", b"pnts", b"cmpt"):
        tile("other.b3dm", kind=kind)
        refused("other.b3dm", 5, kind.decode(), "b3dm")
    for code, words, options in ((5, "b3dm 2", {"version": 2}), (3, "states", {"more": 8}), (3, "states", {"more": -100}),
                                 (3, "feature table", {"json_text": b"{"}), (3, "RTC_CENTER", {"json_text": b'{"RTC_CENTER":[1]}'})):
        tile("broken.b3dm", **options)
        refused("broken.b3dm", code, words)
    with open("broken.b3dm", "wb") as file:
        file.write(b"b3dm\1\0\0\0")
    refused("broken.b3dm", 3, "8 bytes", "28")


def restarts():
    claim("an index with the largest value of its type is refused where it would name a vertex")
    for component, largest in ((UNSIGNED_BYTE, 255), (UNSIGNED_SHORT, 65535)):
        for offset in (3, 4):
            gltf = Gltf()
            points = [POINTS[0]] * (largest - offset) + POINTS + [POINTS[0]]
            corners = [[i + largest - offset] for face in FACES for i in face]
            gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(points)}, "indices": gltf.accessor(corners, component)}))
            if offset == 4:
                bakes(gltf, solid())
            else:
                refused(gltf, 3, "primitive 0", "index 5", str(largest), name="case.glb")


def extensions():
    claim("a required extension that is not read is refused by name with the way out")
    for name, way in (("EXT_made_up", "without this extension"), ("KHR_meshopt_compression", "EXT_meshopt_compression")):
        gltf = solid_file()
        gltf.extension(name)
        refused(gltf, 5, name, way)
    claim("a required extension about materials, and an unknown one that is not required, change nothing")
    gltf = solid_file()
    gltf.extension("KHR_materials_unlit")
    gltf.extension("KHR_texture_transform")
    gltf.extension("EXT_made_up", required=False)
    bakes(gltf, solid())


def hostile():
    claim("a count, an offset or a length beyond the bytes is refused with the accessor")
    for key, value in (("count", 10**9), ("byteOffset", 13), ("byteOffset", 2**63), ("byteOffset", 2**64 - 8), ("bufferView", 99), ("count", -1), ("count", "4"),
                       ("componentType", 5124), ("componentType", 5125), ("type", "VEC4"), ("type", 7)):
        gltf = changed(solid_file(), "accessors.0." + key, value)
        refused(gltf, 5 if value == 5124 else 3, "glTF mesh 0", "primitive 0", "POSITION", "accessor 0")
    for key, value in (("byteLength", 10**12), ("byteOffset", 2**63), ("byteOffset", 2**64 - 8), ("buffer", 1), ("byteStride", 4)):
        gltf = changed(solid_file(), "bufferViews.0." + key, value)
        refused(gltf, 3, "case.gltf", "bufferView 0" if key != "byteStride" else "byteStride")
    claim("counts that no bytes stand behind are refused, not allocated")
    for count, code in ((10**12, 5), (2 * 10**9, 5)):
        gltf = changed(solid_file(), "accessors.0", {"componentType": FLOAT, "count": count, "type": "VEC3"})
        refused(changed(gltf, "meshes.0.primitives.0.indices"), code, "glTF mesh 0", "primitive 0")
    gltf = changed(solid_file(), "accessors.1", {"componentType": UNSIGNED_INT, "count": 300000, "type": "SCALAR"})
    for i in range(30000):
        gltf.node(mesh=0)
    refused(gltf, 5, "2147483647 triangles")
    refused(changed(instanced_file(TRANSLATION=(POINTS,)), "accessors.2.count", 10**12), 5, "node 0")
    claim("a key that an object has twice is refused with its place, and equal keys of two objects are not")
    for doubled, words in (('{"asset": {"version": "2.0"}, "nodes": [], "scenes": [], "nodes": []}', ['"nodes"']),
                           ('{"asset": {"version": "2.0", "x": 1, "version": "2.0"}}', ['"version"', "at asset"]),
                           ('{"asset": {"version": "2.0"}, "meshes": [{}, {"primitives": [{"mode": 4, "mode": 5}]}]}',
                            ['"mode"', "at meshes[1].primitives[0]"]),
                           ('{"asset": {"version": "2.0"}, "extras": {"a": {"k": 1}, "b": [{"k": 1}, {"k": 2, "\\u006b": 3}]}}',
                            ['"k"', "at extras.b[1]"])):
        with open("doubled.gltf", "w") as file:
            file.write(doubled)
        refused("doubled.gltf", 3, "twice in one object", *words)
    bakes(changed(solid_file(), "extras", {"name": {"name": [{"name": {}}, {"name": 1}]}, "asset": "name"}), solid())
    claim("names of a broken file reach the terminal without control characters")
    gltf = changed(solid_file(), "meshes.0.name", "red\x1b[31m")
    refused(changed(gltf, "accessors.0.count", 99), 3, "red?[31m")
