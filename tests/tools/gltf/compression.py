"""Meshopt, Draco, and files of gltfpack."""
import math
import shutil
import struct
import subprocess

from .builder import *
from .checks import *
from .skin import blended, skin_file


def meshopt_file(filtering=None, indices="TRIANGLES", damage=None):
    """POINTS as shorts of eighths, or as floats behind a filter."""
    gltf = Gltf()
    points = POINTS * 100  # two blocks of the codec
    if filtering == "EXPONENTIAL":
        data, stride, component = packed([[exponential(x) for x in p] for p in points], UNSIGNED_INT), 12, FLOAT
    else:
        data, stride, component = packed([[round(x * 8) for x in p] for p in points], SHORT, 8), 8, SHORT
    encoded = meshopt_attributes(data, stride)
    if damage:
        encoded = damage(encoded)
    view = meshopt_view(gltf, encoded, len(points), stride, "ATTRIBUTES", filtering)
    position = gltf.accessor([(0, 0, 0)] * len(points), component, view=view)
    corners = [i + 396 for face in FACES for i in face]
    encoded = meshopt_triangles(corners) if indices == "TRIANGLES" else meshopt_sequence(corners)
    view = meshopt_view(gltf, encoded, len(corners), 2, indices, byte_stride=False)
    primitive = {"attributes": {"POSITION": position}, "indices": gltf.accessor([[0]] * len(corners), UNSIGNED_SHORT, view=view)}
    scale = [1, 1, 1] if filtering else [0.125] * 3
    gltf.node(mesh=gltf.mesh(primitive), scale=scale)
    gltf.extension("KHR_mesh_quantization")
    return gltf


def meshopt():
    claim("EXT_meshopt_compression is read: attributes, triangles, indices and the exponential filter")
    for filtering in (None, "EXPONENTIAL"):
        for indices in ("TRIANGLES", "INDICES"):
            bakes(meshopt_file(filtering, indices), solid())
    claim("damaged compressed bytes, and those of an unknown version, are refused")
    refused(meshopt_file(damage=lambda b: b[:-40]), 3, "bufferView 0", "EXT_meshopt_compression", "damaged", name="case.glb")
    refused(meshopt_file(damage=lambda b: b"\xaf" + b[1:]), 5, "unknown", "without compression", name="case.glb")
    claim("a description of compressed bytes that does not fit is refused before anything is decoded")
    for key, value in (("byteStride", 6), ("byteStride", 260), ("count", 10**12), ("mode", "OTHER"), ("filter", "OCTAHEDRAL"),
                       ("filter", "OTHER"), ("byteLength", 10**9), ("buffer", 7)):
        gltf = changed(meshopt_file("EXPONENTIAL"), "bufferViews.0.extensions.EXT_meshopt_compression." + key, value)
        refused(gltf, 3, "bufferView 0", name="case.glb")
    claim("compressed elements of another size than the view or its accessor states are refused")
    for stride, length, element in ((None, 400 * 12, 12), (12, 400 * 12, 12), (16, 400 * 16, 16), (None, 400 * 16, 16), (12, 400 * 16, 16),
                                   (12, 400 * 12, 16), (16, 400 * 16, 12), (16, 400 * 16 - 4, 16)):
        def position(gltf):
            encoded = meshopt_attributes(packed(POINTS * 100, FLOAT, element), element)
            view = meshopt_view(gltf, encoded, 400, element, "ATTRIBUTES", byte_stride=False)
            gltf.json["bufferViews"][view].update({"byteLength": length, **({"byteStride": stride} if stride else {})})
            return gltf.accessor([(0, 0, 0)] * 400, view=view)
        gltf = indexed_file(position, component=UNSIGNED_SHORT)
        gltf.json["buffers"][0] = {"byteLength": len(gltf.bytes)}
        if (stride or 12) == element and length == 400 * element:
            bakes(gltf, solid())
        else:
            refused(gltf, 3, "bufferView 0", "EXT_meshopt_compression", name="case.glb")


def draco_file(positions=POINTS, damage=None, **attributes):
    gltf = Gltf()
    data = draco_mesh(positions, FACES, 7)
    view = gltf.view(damage(data) if damage else data)
    primitive = {"attributes": {"POSITION": gltf.accessor(POINTS, view=False)},
                 "indices": gltf.accessor([[0]] * 12, UNSIGNED_BYTE, view=False),
                 "extensions": {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 7, **attributes}}}}
    gltf.node(mesh=gltf.mesh(primitive))
    gltf.extension("KHR_draco_mesh_compression")
    return gltf


def draco():
    claim("KHR_draco_mesh_compression is read")
    bakes(draco_file(), solid())
    claim("damaged or missing Draco data is refused by name")
    refused(draco_file(damage=lambda b: b[:40]), 3, "primitive 0", "KHR_draco_mesh_compression", "damaged", name="case.glb")
    refused(draco_file(damage=lambda b: b"OTHER" + b[5:]), 3, "KHR_draco_mesh_compression", name="case.glb")
    refused(draco_file(POSITION=8), 3, "attribute 8", name="case.glb")
    extension = "meshes.0.primitives.0.extensions.KHR_draco_mesh_compression."
    refused(changed(draco_file(NORMAL=7), extension + "attributes.POSITION"), 3, "KHR_draco_mesh_compression", "POSITION",
            name="case.glb")
    claim("Draco data of another size than their accessors raise a warning")
    for accessor, count in ((0, 5), (1, 15)):
        warned(bakes(changed(draco_file(), f"accessors.{accessor}.count", count), solid()), "draco_count")
    warned(bakes(draco_file(), solid()), "draco_count", False)
    claim("other damage to a primitive of Draco is refused")
    refused(changed(draco_file(), extension + "bufferView"), 3, "KHR_draco_mesh_compression", "bufferView", name="case.glb")


def grid_file():
    """A hilly square of 338 triangles, twice, one of them turned: enough for gltfpack to do something."""
    gltf = Gltf()
    size = 14
    points = [(i * 0.25, j * 0.5, 0.25 * math.sin(i) * math.cos(2 * j)) for j in range(size) for i in range(size)]
    points = [tuple(struct.unpack("<3f", struct.pack("<3f", *p))) for p in points]
    faces = []
    for j in range(size - 1):
        for i in range(size - 1):
            a = j * size + i
            faces += [(a, a + 1, a + size), (a + 1, a + size + 1, a + size)]
    mesh = gltf.mesh(primitive(gltf, points, faces))
    placements = [moved(0, 0, 0), times(moved(1, 2, 30), times(turned_about_z(30), scaled(2, 2, 2)))]
    gltf.node(mesh=mesh)
    gltf.node(mesh=mesh, translation=[1, 2, 30], rotation=quaternion_about_z(30), scale=[2, 2, 2])
    return gltf, [tuple(applied(m, points[i]) for i in face) for m in placements for face in faces]


def gltfpack():
    program = shutil.which("gltfpack")
    if not program:
        print("gltfpack is not installed: its claims are skipped")
        return
    gltf, expected = grid_file()
    gltf.write("unpacked.glb")
    claim("what gltfpack writes bakes to the same surface")
    for options in ([], ["-noq"], ["-c"], ["-cc"], ["-c", "-noq"], ["-vp", "10"], ["-mi"], ["-mi", "-cc"], ["-kn"]):
        subprocess.run([program, "-i", "unpacked.glb", "-o", "packed.glb", *options], check=True, capture_output=True)
        # Positions of 14 or 10 bits over an extent of 6.5, which one node doubles; rotations of instances of 12 bits,
        # at a distance of up to 15.
        tolerance = 0.0 if "-noq" in options else 13.0 / (1 << (10 if "-vp" in options else 14))
        tolerance += 15.0 / (1 << 11) if "-mi" in options else 0.0
        bakes("packed.glb", expected, tolerance=tolerance)
    claim("what gltfpack writes of skins and morph targets bakes to the same surface")
    weights = [[1, 0, 0, 0], [0.25, 0.75, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0, 0]]
    bound = [times(moved(0, 5, 0), scaled(2, 2, 2)),
             times(times(moved(2, 5, 0), turned_about_z(90)), moved(0, 0, 1))]
    skin_file(weights).write("skin.glb")
    gltf = Gltf()
    target = gltf.accessor([(0.0, 1.0, 0.0)] * 3 + [(0.0, 0.0, 2.0)])
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf, targets=[{"POSITION": target}]), weights=[0.5]))
    gltf.write("morph.glb")
    morphed = [tuple(x + 0.5 * d for x, d in zip(p, m)) for p, m in zip(POINTS, [(0, 1, 0)] * 3 + [(0, 0, 2)])]
    for options in ([], ["-noq"], ["-c"], ["-cc"]):
        for name, points, kind in (("skin.glb", blended(weights, bound), "skinned_mesh"), ("morph.glb", morphed, "morphed_mesh")):
            subprocess.run([program, "-i", name, "-o", "packed.glb", "-ke", *options], check=True, capture_output=True)
            # Weights of 8 bits on joints that are up to 10 apart, positions of 14 bits.
            warned(bakes("packed.glb", solid(points=points), tolerance=10 / 255 + 16 / (1 << 14)), kind)
