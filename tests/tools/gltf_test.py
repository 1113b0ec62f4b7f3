"""Claims about glTF files, made by baking small ones: python3 gltf_test.py ESPALIER [FOLDER_TO_KEEP_FILES_IN [PART...]]

Each file is made here, and so are the triangles that it describes, in Python's own numbers.
"""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile

from gltf_builder import *

espalier = os.path.abspath(sys.argv[1])
claims, broken, claim_text = 0, 0, ""

# A solid of four different corners, counter-clockwise from outside, in whole eighths.
POINTS = [(0.0, 0.0, 0.0), (2.0, 0.25, 0.0), (0.5, 1.5, 0.0), (0.25, 0.5, 3.0)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def claim(text):
    global claims, claim_text
    claims, claim_text = claims + 1, text


def fail(problem):
    global broken
    broken += 1
    print("BROKEN: %s: %s" % (claim_text, problem))


def run(*arguments, code=0):
    done = subprocess.run([espalier, *arguments], capture_output=True, text=True, timeout=300)
    if done.returncode != code:
        fail("'%s' ended with %d, not %d: %s" % (" ".join(arguments), done.returncode, code, done.stderr[:600]))
    return done


# ---- transforms --------------------------------------------------------------------------------------------------------
IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def moved(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def scaled(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def turned_about_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def quaternion_about_z(degrees):
    return [0, 0, math.sin(math.radians(degrees / 2)), math.cos(math.radians(degrees / 2))]


def columns(matrix):
    return [matrix[row][column] for column in range(4) for row in range(4)]


def applied(matrix, point):
    return tuple(sum(matrix[i][k] * point[k] for k in range(3)) + matrix[i][3] for i in range(3))


def solid(matrix=IDENTITY, points=POINTS, mirrored=False):
    """The triangles of POINTS and FACES under a transform; mirrored ones run the other way round."""
    placed = [applied(matrix, point) for point in points]
    return [tuple(placed[i] for i in (face if not mirrored else (face[0], face[2], face[1]))) for face in FACES]


# ---- comparing ---------------------------------------------------------------------------------------------------------
def distance(a, b):
    """How far the corners of two triangles are apart, in the best of the three turns."""
    return min(max(math.dist(a[i], b[(i + turn) % 3]) for i in range(3)) for turn in range(3))


def compare(expected, actual, tolerance):
    """Every expected triangle is there once, with its front where it was; and nothing else is."""
    if len(expected) != len(actual):
        fail("%d triangles, not %d" % (len(actual), len(expected)))
        return
    left = list(actual)
    for triangle in expected:
        best = min(left, key=lambda other: distance(triangle, other))
        if distance(triangle, best) > tolerance:
            fail("no triangle at %s; the nearest is %s" % (triangle, best))
            return
        left.remove(best)


def corners_of(blob):
    listed = json.loads(run("query", blob, "triangles", "--json").stdout)["triangles"]
    return [tuple(tuple(triangle[corner]) for corner in "abc") for triangle in listed]


def bakes(gltf, expected, tolerance=None, name="case.glb", options=()):
    """The file bakes to these triangles, within the blob's own bound and a rounding to float32. Returns the bake."""
    if not isinstance(gltf, str):
        gltf.write(name)
    done = run("bake", name if not isinstance(gltf, str) else gltf, "-o", "case.espl", "--json", *options)
    if done.returncode != 0:
        return done
    report = json.loads(done.stdout)
    size = max(abs(x) for triangle in expected for corner in triangle for x in corner) if expected else 1.0
    compare(expected, corners_of("case.espl"), report["max_error"] + 1e-6 * size + (tolerance or 0.0))
    return done


def refused(gltf, code, *words, name="case.gltf"):
    """The file is refused with this exit status and these words, and nothing is written."""
    if not isinstance(gltf, str):
        gltf.write(name)
        gltf = name
    if os.path.exists("refused.espl"):
        os.remove("refused.espl")
    done = run("bake", gltf, "-o", "refused.espl", "--json", code=code)
    if done.returncode == code and json.loads(done.stdout)["error"]["file"] != gltf:
        fail("the error in JSON names another file: %s" % done.stdout)
    for word in words:
        if word not in done.stderr:
            fail("'%s' is not in: %s" % (word, done.stderr[:600]))
    if os.path.exists("refused.espl"):
        fail("a refused file left a blob")


def solid_primitive(gltf, **rest):
    return {"attributes": {"POSITION": gltf.accessor(POINTS)},
            "indices": gltf.accessor([[i] for face in FACES for i in face], UNSIGNED_SHORT), **rest}


def solid_file(**node):
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), **node)
    return gltf


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
        refused("cut.glb", 3, "cut.glb")
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
    gltf = solid_file()
    gltf.json["asset"]["version"] = "3.0"
    refused(gltf, 5, "glTF 3.0")
    gltf.json["asset"] = {}
    gltf.json["meshes"] = {"walls": {}}
    refused(gltf, 5, "glTF 1.0", "Convert it")
    claim("a missing or short file beside it is refused by name")
    solid_file().write("beside.gltf", ("short.bin", "absent.bin"))
    refused("beside.gltf", 2, "absent.bin", "No such file")
    solid_file().write("beside.gltf", ("short.bin", "short.bin"))
    os.truncate("short.bin", 40)
    refused("beside.gltf", 3, "short.bin", "shorter")
    solid_file().write("beside.gltf", ("short.bin", "https://example.org/case.bin"))
    refused("beside.gltf", 5, "https://example.org/case.bin", "Download")


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
    for more in ([[0]], [[0], [1]]):
        gltf = Gltf()
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(POINTS)},
                                  "indices": gltf.accessor([[i] for face in FACES for i in face] + more, UNSIGNED_BYTE)}))
        warned(bakes(gltf, solid()), "incomplete_triangle")
    claim("an accessor without elements is refused by number")
    gltf = solid_file()
    gltf.json["accessors"][1]["count"] = 0
    refused(gltf, 3, "glTF mesh 0", "indices", "accessor 1", "count")
    claim("points and lines are counted as skipped")
    for mode, count in ((0, 4), (1, 2), (2, 4), (3, 3)):
        gltf = Gltf()
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(POINTS)}, "mode": mode}, solid_primitive(gltf)))
        if json.loads(bakes(gltf, solid()).stdout)["inputs"][0]["points_and_lines"] != count:
            fail("mode %d" % mode)
    claim("vertices that no triangle uses are not in the bounds")
    gltf = Gltf()
    far = POINTS + [(1000.0, 1000.0, 1000.0)]
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(far)},
                              "indices": gltf.accessor([[i] for face in FACES for i in face], UNSIGNED_BYTE)}))
    if json.loads(bakes(gltf, solid()).stdout)["bounds"]["max"] != [2.0, 1.5, 3.0]:
        fail("the bounds are those of all vertices")
    claim("an index beyond the vertices is refused with its triangle, and --repair drops the triangle")
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(POINTS)},
                              "indices": gltf.accessor([[i] for face in FACES for i in face] + [[0], [1], [77]], UNSIGNED_BYTE)}))
    refused(gltf, 3, "triangle 4", "vertex 77")
    bakes(gltf, solid(), options=("--repair", "--max-dropped", "20%"))
    claim("materials are numbered as in the file, and a primitive without one comes after the last")
    gltf = Gltf()
    gltf.json["materials"] = [{}, {}, {}]
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf, material=1)))
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), translation=[8, 0, 0])
    bakes(gltf, solid() + solid(moved(8, 0, 0)), options=("--materials", "8"))
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
                gltf = Gltf()
                gltf.extension("KHR_mesh_quantization")
                position = gltf.accessor(rows, component, normalised, stride or (4 if component in (BYTE, UNSIGNED_BYTE) else 8))
                gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": position},
                                          "indices": gltf.accessor([[i] for f in FACES for i in f], UNSIGNED_BYTE)}),
                          scale=[2, 3, 0.5], translation=[1, 0, -1])
                points = [tuple(max(x / largest, -1.0) if normalised else float(x) for x in row) for row in rows]
                bakes(gltf, solid(times(moved(1, 0, -1), scaled(2, 3, 0.5)), points))
    claim("the lowest normalised integer is -1, as the one above it")
    gltf = Gltf()
    rows = [(-128, 0, 0), (127, 0, 0), (0, 127, 0), (0, 0, 127)]
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(rows, BYTE, True, 4)},
                              "indices": gltf.accessor([[i] for f in FACES for i in f], UNSIGNED_BYTE)}))
    bakes(gltf, solid(points=[(-1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]))
    claim("a flag of normalised integers changes no float")
    gltf = solid_file(scale=[-1, -1, -1])
    gltf.json["accessors"][0]["normalized"] = True
    negative = [tuple(-x for x in p) for p in POINTS]
    bakes(gltf, solid(points=negative, mirrored=True))
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(negative, normalized=True)},
                              "indices": gltf.accessor([[i] for f in FACES for i in f], UNSIGNED_BYTE)}))
    bakes(gltf, solid(points=negative))
    gltf = draco_file(negative)
    gltf.json["accessors"][0]["normalized"] = True
    bakes(gltf, solid(points=negative))
    claim("sparse positions replace stored ones, or zeros, with indices of every type")
    for component in (UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT):
        for view in (None, False):
            gltf = Gltf()
            stored = [POINTS[0], (9.0, 9.0, 9.0), POINTS[2], (8.0, 8.0, 8.0)]
            if view is None:
                sparse = ([1, 3], [POINTS[1], POINTS[3]], component)
            else:
                sparse = ([1, 2, 3], POINTS[1:], component)
            position = gltf.accessor(stored, sparse=sparse, view=view)
            gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": position},
                                      "indices": gltf.accessor([[i] for f in FACES for i in f], UNSIGNED_BYTE)}))
            bakes(gltf, solid())
    claim("sparse indices that do not ascend, or lead beyond the accessor, are refused")
    for places in ([3, 1], [1, 4]):
        gltf = Gltf()
        position = gltf.accessor(POINTS, sparse=(places, [POINTS[1], POINTS[3]], UNSIGNED_BYTE))
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": position}}))
        refused(gltf, 3, "glTF mesh 0", "POSITION", "accessor 0", "sparse")


def nodes():
    claim("nodes are placed by translation, rotation and scale or a matrix, one below the other")
    outer = times(times(moved(1, 2, 3), turned_about_z(90)), scaled(2, 2, 2))
    inner = times(moved(0, 0.5, 0), turned_about_z(30))
    gltf = Gltf()
    child = gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), matrix=columns(inner))
    gltf.node(children=[child], translation=[1, 2, 3], rotation=quaternion_about_z(90), scale=[2, 2, 2])
    bakes(gltf, solid(times(outer, inner)))
    claim("a sheared mesh, from an uneven scale above a rotation, is right")
    gltf = Gltf()
    child = gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), rotation=quaternion_about_z(30))
    gltf.node(children=[child], scale=[3, 1, 0.5])
    bakes(gltf, solid(times(scaled(3, 1, 0.5), turned_about_z(30))))
    claim("a mirrored mesh keeps its front outside, and one that is mirrored twice")
    bakes(solid_file(scale=[-1, 1, 1]), solid(scaled(-1, 1, 1), mirrored=True))
    gltf = Gltf()
    child = gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), scale=[1, -2, 1])
    gltf.node(children=[child], scale=[-1, 1, 1])
    bakes(gltf, solid(scaled(-1, -2, 1)))
    claim("a rotation need not be of length 1")
    bakes(solid_file(rotation=[2 * x for x in quaternion_about_z(90)]), solid(turned_about_z(90)))
    claim("the last entry of a matrix may be rounded, and no other last row is read")
    bakes(solid_file(matrix=columns(moved(1, 2, 3))[:15] + [0.9999999]), solid(moved(1, 2, 3)))
    for last_row in ([0, 0, 0, 0.999], [0, 0, 0, 2], [0.5, 0, 0, 1]):
        refused(solid_file(matrix=columns(moved(1, 2, 3)[:3] + [last_row])), 3, "node 0", "last row")
    claim("--unit, --scale and --up apply as to other formats")
    bakes(solid_file(), solid(scaled(0.02, 0.02, 0.02)), options=("--unit", "cm", "--scale", "2"))
    bakes(solid_file(), solid([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]), options=("--up", "z"))
    claim("a mesh that several nodes place is there several times")
    gltf = solid_file()
    gltf.node(mesh=0, translation=[8, 0, 0])
    bakes(gltf, solid() + solid(moved(8, 0, 0)))


def scenes():
    claim("the default scene is baked, else the first one, else all nodes; other meshes raise a warning")
    for scene, expected, warns in ((1, solid(moved(8, 0, 0)), True), (None, solid(), True), ("none", solid() + solid(moved(8, 0, 0)), False)):
        gltf = solid_file()
        gltf.node(mesh=0, translation=[8, 0, 0])
        gltf.json["scenes"] = [{"nodes": [0]}, {"nodes": [1]}] if scene != "none" else []
        gltf.json["scene"] = scene
        if scene in (None, "none"):
            document = gltf.document
            gltf.document = lambda uri=None: {k: v for k, v in document(uri).items() if k != "scene" and v != []}
        warned(bakes(gltf, expected), "scene_left_out", warns)
    claim("a mesh that no node uses is left out with a warning")
    gltf = solid_file()
    gltf.mesh(solid_primitive(gltf), name="spare")
    warned(bakes(gltf, solid()), "unused_mesh")
    warned(bakes(solid_file(), solid()), "unused_mesh", False)
    claim("nodes that are no forest are refused by number")
    gltf = solid_file(children=[1])
    gltf.node(children=[0])
    gltf.json["scenes"] = [{"nodes": [0]}]
    refused(gltf, 3, "node 0")
    gltf = solid_file()
    gltf.node(mesh=0, children=[2])
    gltf.node(children=[1])
    gltf.json["scenes"] = []  # and so all nodes that are below no other one
    refused(gltf, 3, "node 1", "circle")
    gltf = solid_file()
    gltf.node(children=[0])
    gltf.node(children=[0])
    refused(gltf, 3, "node 0", "child of node 1 and of node 2")
    claim("a node with a matrix and another transform is refused")
    for key, value in (("translation", [0, 0, 9]), ("rotation", [0, 0, 0, 1]), ("scale", [2, 2, 2])):
        refused(solid_file(matrix=columns(moved(5, 0, 0)), **{key: value}), 3, "node 0", "matrix", key)
    claim("a hundred thousand nested nodes are placed")
    gltf = solid_file()
    for i in range(100000):
        gltf.node(children=[i])
    bakes(gltf, solid())


def warned(done, kind, expected=True):
    """The bake has a warning of this kind, by its JSON."""
    warnings = json.loads(done.stdout)["warnings"] if done.returncode == 0 else []
    if any(w["kind"] == kind for w in warnings) != expected:
        fail("warnings are %s" % warnings)


def skin_file(weights, joints=None, weights_component=FLOAT, matrices=True, **rest):
    """Joint 1 stands 5 up, joint 2 stands 2 to the right of it; the mesh's own node stands elsewhere."""
    gltf = Gltf()
    primitive = solid_primitive(gltf)
    joints = joints or [[0, 1, 0, 0]] * 4
    primitive["attributes"]["JOINTS_0"] = gltf.accessor(joints, UNSIGNED_BYTE)
    primitive["attributes"]["WEIGHTS_0"] = gltf.accessor(weights, weights_component, weights_component != FLOAT)
    gltf.node(mesh=gltf.mesh(primitive), skin=0, translation=[100, 0, 0])
    gltf.node(translation=[0, 5, 0], children=[2], **rest)
    gltf.node(translation=[2, 0, 0], rotation=quaternion_about_z(90))
    gltf.json["skins"] = [{"joints": [1, 2]}]
    if matrices:
        bind = [columns(scaled(2, 2, 2)), columns(moved(0, 0, 1))]
        gltf.json["skins"][0]["inverseBindMatrices"] = gltf.accessor(bind)
    return gltf


def blended(weights, joints):
    return [tuple(sum(w * applied(j, p)[i] for w, j in zip(row, joints)) / sum(row) for i in range(3))
            for p, row in zip(POINTS, weights)]


def skins():
    first, second = moved(0, 5, 0), times(moved(2, 5, 0), turned_about_z(90))
    bound = [times(first, scaled(2, 2, 2)), times(second, moved(0, 0, 1))]
    claim("a skinned mesh stands where its joints are, and not where its node is; with a warning")
    warned(bakes(skin_file([[1, 0, 0, 0]] * 4), solid(bound[0])), "skinned_mesh")
    bakes(skin_file([[1, 0, 0, 0]] * 4, matrices=False), solid(first))
    claim("a vertex between joints is their mean by weights, in every type of weights")
    weights = [[1, 0, 0, 0], [0.25, 0.75, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0, 0]]
    bakes(skin_file(weights), solid(points=blended(weights, bound)))
    for component, largest in ((UNSIGNED_BYTE, 255), (UNSIGNED_SHORT, 65535)):
        whole = [[round(w * largest) for w in row] for row in weights]
        bakes(skin_file(whole, weights_component=component), solid(points=blended(whole, bound)))
    claim("weights that do not add up to 1 are scaled, and a vertex without weights stays")
    bakes(skin_file([[2 * w for w in row] for row in weights]), solid(points=blended(weights, bound)))
    points = blended([[1, 0]] * 4, bound)
    points[3] = POINTS[3]
    bakes(skin_file([[1, 0, 0, 0]] * 3 + [[0, 0, 0, 0]]), solid(points=points))
    claim("a mirrored joint keeps the front outside")
    bakes(skin_file([[1, 0, 0, 0]] * 4, scale=[-1, 1, 1]),
          solid(times(times(first, scaled(-1, 1, 1)), scaled(2, 2, 2)), mirrored=True))
    claim("a joint that the skin lacks is refused, unless its weight is 0")
    refused(skin_file(weights, joints=[[0, 1, 0, 0]] * 3 + [[0, 9, 0, 0]]), 3, "primitive 0", "joint 9")
    bakes(skin_file(weights, joints=[[0, 1, 9, 9]] * 4), solid(points=blended(weights, bound)))
    claim("a weight that is negative or no number is refused with its vertex")
    for weight in (-0.5, -math.inf, math.inf, math.nan):
        refused(skin_file([[1, 0, 0, 0]] * 2 + [[0.5, weight, 0, 0]] + [[1, 0, 0, 0]]), 3, "primitive 0", "weight of vertex 2")
    claim("an inverse bind matrix whose last row is not 0 0 0 1 is refused with its number")
    for entry, value in ((3, 1.0), (7, 0.5), (11, math.nan), (15, 2.0)):
        gltf = skin_file(weights, matrices=False)
        bind = [columns(scaled(2, 2, 2)), columns(moved(0, 0, 1))]
        bind[1][entry] = value
        gltf.json["skins"][0]["inverseBindMatrices"] = gltf.accessor(bind)
        refused(gltf, 3, "skin 0", "inverse bind matrix 1", "0 0 0 1")
    claim("a mesh without joints and weights on a node with a skin stands where its node is; with a warning")
    gltf = skin_file(weights)
    del gltf.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"]
    warned(bakes(gltf, solid(moved(100, 0, 0))), "unweighted_mesh")


def morphs():
    claim("morph targets move vertices by the weights of the mesh, or of the node, or not at all; with a warning")
    up, right = [(0.0, 1.0, 0.0)] * 4, [(0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.25), (1.0, 0.0, 0.0)]
    for mesh_weights, node_weights, expected in ((None, None, (0, 0)), ([1, 0.5], None, (1, 0.5)), ([1, 0.5], [0, 2], (0, 2))):
        gltf = Gltf()
        # The second target is sparse above nothing, as exporters write it.
        targets = [{"POSITION": gltf.accessor(up)},
                   {"POSITION": gltf.accessor(up, view=False, sparse=([0, 2, 3], [right[0], right[2], right[3]], UNSIGNED_BYTE))}]
        mesh = gltf.mesh(solid_primitive(gltf, targets=targets))
        if mesh_weights:
            gltf.json["meshes"][0]["weights"] = mesh_weights
        gltf.node(mesh=mesh, **({"weights": node_weights} if node_weights else {}))
        points = [tuple(p[i] + expected[0] * u[i] + expected[1] * r[i] for i in range(3)) for p, u, r in zip(POINTS, up, right)]
        warned(bakes(gltf, solid(points=points)), "morphed_mesh")
    claim("a target of normalised integers is scaled")
    gltf = Gltf()
    target = gltf.accessor([(127, 0, 0)] * 4, BYTE, True, 4)
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf, targets=[{"POSITION": target}]), weights=[2.0]))
    bakes(gltf, solid(moved(2, 0, 0)))


def instanced_file(**attributes):
    gltf = solid_file(translation=[0, 0, 1])
    gltf.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {
        name: gltf.accessor(*value) for name, value in attributes.items()}}}
    gltf.extension("EXT_mesh_gpu_instancing")
    return gltf


def instances():
    claim("EXT_mesh_gpu_instancing places the mesh by translation, rotation and scale, each of which may be absent")
    places = [(0.0, 0.0, 0.0), (8.0, 0.0, 0.0), (0.0, 16.0, 0.0)]
    bakes(instanced_file(TRANSLATION=(places,)), [t for p in places for t in solid(times(moved(0, 0, 1), moved(*p)))])
    turns, sizes = [0, 90, 180], [(1.0, 1.0, 1.0), (2.0, 1.0, 1.0), (-1.0, 1.0, 1.0)]
    everything = []
    for place, turn, size in zip(places, turns, sizes):
        matrix = times(times(moved(*place), turned_about_z(turn)), scaled(*size))
        everything += solid(times(moved(0, 0, 1), matrix), mirrored=size[0] < 0)
    quaternions = [quaternion_about_z(turn) for turn in turns]
    bakes(instanced_file(TRANSLATION=(places,), ROTATION=(quaternions,), SCALE=(sizes,)), everything)
    short = [[round(x * 32767) for x in q] for q in quaternions]
    bakes(instanced_file(TRANSLATION=(places,), ROTATION=(short, SHORT, True), SCALE=(sizes,)), everything, tolerance=1e-3)
    claim("instances of which there are none are refused")
    gltf = instanced_file(TRANSLATION=(places,))
    gltf.json["accessors"][2]["count"] = 0
    refused(gltf, 3, "node 0", "accessor 2", "count")
    claim("instances of different counts, and of a skinned mesh, are refused")
    refused(instanced_file(TRANSLATION=(places,), SCALE=(sizes[:2],)), 3, "node 0", "different numbers")
    gltf = skin_file([[1, 0, 0, 0]] * 4)
    gltf.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": gltf.accessor(places)}}}
    refused(gltf, 5, "node 0", "skinned and instanced")


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
        gltf = meshopt_file("EXPONENTIAL")
        gltf.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value
        refused(gltf, 3, "bufferView 0", name="case.glb")
    claim("compressed elements of another size than the view or its accessor states are refused")
    for stride, length, element in ((None, 400 * 12, 12), (12, 400 * 12, 12), (16, 400 * 16, 16), (None, 400 * 16, 16), (12, 400 * 16, 16),
                                   (12, 400 * 12, 16), (16, 400 * 16, 12), (16, 400 * 16 - 4, 16)):
        gltf = Gltf()
        encoded = meshopt_attributes(packed(POINTS * 100, FLOAT, element), element)
        view = meshopt_view(gltf, encoded, 400, element, "ATTRIBUTES", byte_stride=False)
        gltf.json["bufferViews"][view].update({"byteLength": length, **({"byteStride": stride} if stride else {})})
        position = gltf.accessor([(0, 0, 0)] * 400, view=view)
        corners = gltf.accessor([[i] for face in FACES for i in face], UNSIGNED_SHORT)
        gltf.json["buffers"][0] = {"byteLength": len(gltf.bytes)}
        gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": position}, "indices": corners}))
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
    gltf = draco_file(NORMAL=7)
    del gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"]
    refused(gltf, 3, "KHR_draco_mesh_compression", "POSITION", name="case.glb")
    claim("Draco data of another size than their accessors raise a warning")
    for accessor, count in ((0, 5), (1, 15)):
        gltf = draco_file()
        gltf.json["accessors"][accessor]["count"] = count
        warned(bakes(gltf, solid()), "draco_count")
    warned(bakes(draco_file(), solid()), "draco_count", False)
    claim("other damage to a primitive of Draco is refused")
    gltf = draco_file()
    del gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"]
    refused(gltf, 3, "KHR_draco_mesh_compression", "bufferView", name="case.glb")


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
        gltf = solid_file()
        gltf.json["accessors"][0][key] = value
        refused(gltf, 5 if value == 5124 else 3, "glTF mesh 0", "primitive 0", "POSITION", "accessor 0")
    for key, value in (("byteLength", 10**12), ("byteOffset", 2**63), ("byteOffset", 2**64 - 8), ("buffer", 1), ("byteStride", 4)):
        gltf = solid_file()
        gltf.json["bufferViews"][0][key] = value
        refused(gltf, 3, "case.gltf", "bufferView 0" if key != "byteStride" else "byteStride")
    claim("counts that no bytes stand behind are refused, not allocated")
    for count, code in ((10**12, 5), (2 * 10**9, 5)):
        gltf = solid_file()
        gltf.json["accessors"][0] = {"componentType": FLOAT, "count": count, "type": "VEC3"}
        del gltf.json["meshes"][0]["primitives"][0]["indices"]
        refused(gltf, code, "glTF mesh 0", "primitive 0")
    gltf = solid_file()
    gltf.json["accessors"][1] = {"componentType": UNSIGNED_INT, "count": 300000, "type": "SCALAR"}
    for i in range(30000):
        gltf.node(mesh=0)
    refused(gltf, 5, "2147483647 triangles")
    gltf = instanced_file(TRANSLATION=(POINTS,))
    gltf.json["accessors"][2]["count"] = 10**12
    refused(gltf, 5, "node 0")
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
    gltf = solid_file()
    gltf.json["extras"] = {"name": {"name": [{"name": {}}, {"name": 1}]}, "asset": "name"}
    bakes(gltf, solid())
    claim("names of a broken file reach the terminal without control characters")
    gltf = solid_file()
    gltf.json["meshes"][0]["name"] = "red\x1b[31m"
    gltf.json["accessors"][0]["count"] = 99
    refused(gltf, 3, "red?[31m")


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
    mesh = gltf.mesh({"attributes": {"POSITION": gltf.accessor(points)},
                      "indices": gltf.accessor([[i] for face in faces for i in face], UNSIGNED_SHORT)})
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


def main():
    folder = sys.argv[2] if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as temporary:
        os.chdir(folder or temporary)
        for part in (containers, topology, positions, nodes, scenes, skins, morphs, instances, meshopt, draco, restarts, extensions,
                     hostile, gltfpack):
            if len(sys.argv) < 4 or part.__name__ in sys.argv[3:]:
                part()
        os.chdir("/")
    print("%d claims, %d broken" % (claims, broken))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
