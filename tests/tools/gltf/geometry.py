"""Primitives: topology and positions."""
import json

from .builder import *
from .checks import *
from .compression import draco_file


def topology():
    claim("lists, strips and fans of triangles are right with indices of every type and without")
    strip = list(POINTS)
    strip_triangles = [(strip[0], strip[1], strip[2]), (strip[1], strip[3], strip[2])]
    fan = [POINTS[i] for i in (3, 0, 1, 2)]
    fan_triangles = [(fan[i + 1], fan[i + 2], fan[0]) for i in range(2)]
    for mode, corners, expected in ((4, None, solid()), (5, strip, strip_triangles), (6, fan, fan_triangles)):
        for component in (UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT, None):
            gltf = Gltf()
            corners = corners or [POINTS[i] for face in FACES for i in face]
            if component is None:
                primitive = {"attributes": {"POSITION": gltf.accessor(corners)}, "mode": mode}
            else:
                primitive = {"attributes": {"POSITION": gltf.accessor(POINTS)}, "mode": mode,
                             "indices": gltf.accessor([[POINTS.index(c)] for c in corners], component)}
            gltf.node(mesh=gltf.mesh(primitive))
            bakes(gltf, expected)
    claim("corners that repeat to join strips add no triangle")
    gltf = Gltf()
    order = [0, 1, 2, 3, 3, 1, 1, 0, 3]
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(POINTS)}, "mode": 5,
                              "indices": gltf.accessor([[i] for i in order], UNSIGNED_BYTE)}))
    joined = [(0, 1, 2), (1, 3, 2), (1, 0, 3)]
    done = bakes(gltf, [tuple(POINTS[i] for i in corners) for corners in joined])
    if done.returncode == 0 and json.loads(done.stdout)["inputs"][0]["triangles"] != 3:
        fail("the input has more than 3 triangles")
    claim("a primitive without positions is left out with a warning")
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf), {"attributes": {"NORMAL": gltf.accessor(POINTS)}}))
    warned(bakes(gltf, solid()), "missing_positions")
    claim("one or two corners after the last triangle are left out with a warning")
    for more in ([0], [0, 1]):
        warned(bakes(indexed_file(lambda gltf: gltf.accessor(POINTS), more), solid()), "incomplete_triangle")
    claim("an accessor without elements is refused by number")
    refused(changed(solid_file(), "accessors.1.count", 0), 3, "glTF mesh 0", "indices", "accessor 1", "count")
    claim("points and lines are counted as skipped")
    for mode, count in ((0, 4), (1, 2), (2, 4), (3, 3)):
        gltf = Gltf()
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(POINTS)}, "mode": mode}, solid_primitive(gltf)))
        if json.loads(bakes(gltf, solid()).stdout)["inputs"][0]["points_and_lines"] != count:
            fail("mode %d" % mode)
    claim("vertices that no triangle uses are not in the bounds")
    gltf = indexed_file(lambda gltf: gltf.accessor(POINTS + [(1000.0, 1000.0, 1000.0)]))
    if json.loads(bakes(gltf, solid()).stdout)["bounds"]["max"] != [2.0, 1.5, 3.0]:
        fail("the bounds are those of all vertices")
    claim("an index beyond the vertices is refused with its triangle, and --drop-bad-triangles drops the triangle")
    gltf = indexed_file(lambda gltf: gltf.accessor(POINTS), [0, 1, 77])
    refused(gltf, 3, "triangle 4", "vertex 77")
    bakes(gltf, solid(), options=("--drop-bad-triangles", "--max-dropped", "20%"))
    claim("materials are numbered as in the file, and a primitive without one comes after the last")
    gltf = Gltf()
    gltf.json["materials"] = [{}, {}, {}]
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf, material=1)))
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), translation=[8, 0, 0])
    bakes(gltf, solid() + solid(moved(8, 0, 0)), options=("--materials",))
    listed = json.loads(run("query", "case.espl", "triangles", "--json").stdout)["triangles"]
    if sorted((t["a"][0] >= 7, t["material"]) for t in listed) != [(False, 1)] * 4 + [(True, 3)] * 4:
        fail("the numbers are %s" % [t["material"] for t in listed])


def positions():
    claim("positions of 8 and 16 bits, signed and unsigned, normalised or not, are read as KHR_mesh_quantization says")
    for component, largest, lowest in ((BYTE, 127, -127), (UNSIGNED_BYTE, 255, 0), (SHORT, 32767, -32767),
                                       (UNSIGNED_SHORT, 65535, 0)):
        rows = [(lowest, 3, 5), (largest, 0, lowest), (7, largest, 1), (11, 13, largest)]
        for normalised in (False, True):
            for stride in (0, 12):
                width = stride or (4 if component in (BYTE, UNSIGNED_BYTE) else 8)
                gltf = indexed_file(lambda gltf: gltf.accessor(rows, component, normalised, width),
                                    scale=[2, 3, 0.5], translation=[1, 0, -1])
                gltf.extension("KHR_mesh_quantization")
                points = [tuple(max(x / largest, -1.0) if normalised else float(x) for x in row) for row in rows]
                bakes(gltf, solid(times(moved(1, 0, -1), scaled(2, 3, 0.5)), points))
    claim("the lowest normalised integer is -1, as the one above it")
    rows = [(-128, 0, 0), (127, 0, 0), (0, 127, 0), (0, 0, 127)]
    bakes(indexed_file(lambda gltf: gltf.accessor(rows, BYTE, True, 4)),
          solid(points=[(-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]))
    claim("a flag of normalised integers changes no float")
    negative = [tuple(-x for x in p) for p in POINTS]
    bakes(changed(solid_file(scale=[-1, -1, -1]), "accessors.0.normalized", True), solid(points=negative, mirrored=True))
    bakes(indexed_file(lambda gltf: gltf.accessor(negative, normalized=True)), solid(points=negative))
    bakes(changed(draco_file(negative), "accessors.0.normalized", True), solid(points=negative))
    claim("sparse positions replace stored ones, or zeros, with indices of every type")
    for component in (UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT):
        for view in (None, False):
            stored = [POINTS[0], (9.0, 9.0, 9.0), POINTS[2], (8.0, 8.0, 8.0)]
            replaced = [1, 3] if view is None else [1, 2, 3]
            sparse = (replaced, [POINTS[i] for i in replaced], component)
            bakes(indexed_file(lambda gltf: gltf.accessor(stored, sparse=sparse, view=view)), solid())
    claim("sparse indices that do not ascend, or lead beyond the accessor, are refused")
    for places in ([3, 1], [1, 4]):
        gltf = Gltf()
        position = gltf.accessor(POINTS, sparse=(places, [POINTS[1], POINTS[3]], UNSIGNED_BYTE))
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": position}}))
        refused(gltf, 3, "glTF mesh 0", "POSITION", "accessor 0", "sparse")
