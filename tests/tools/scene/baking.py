"""Which meshes become instances, and where they stand."""
import hashlib
import os

from .files import *

UNIFORM = times(times(moved(5, 1, 2), turned_about_z(30)), scaled(2, 2, 2))
SHEARED = times(scaled(3, 1, 0.5), turned_about_z(30))


def places():
    claim("a mesh that nodes turn, move and scale is stored once, and stands where they put it")
    matrices = [IDENTITY, moved(8, 0, 0), UNIFORM, times(moved(-20, 0, 0), turned_about_z(90))]
    report = bakes_to(solids(*matrices), "all", [t for m in matrices for t in solid(m)], 4, 1)
    is_equal("the instances of the mesh", report["meshes"][0]["instances"], 4)
    is_equal("the sources", report["sources"], [{"file": 0, "mesh": i} for i in range(4)])
    is_equal("users", sorted(i["user"] for i in Scene("case.esps").instances), [0, 1, 2, 3])
    claim("quarter turns and moves by whole numbers are exact")
    quarter = [i for i in Scene("case.esps").instances if i["user"] == 3][0]
    is_equal("the rotation", sorted(map(abs, quarter["rotation"])), [0, 0, 1, 1])
    is_equal("the translation", quarter["translation"], (-20, 0, 0))
    is_equal("the scale", quarter["scale"], 1)
    claim("units, scale and axes apply to meshes and places; blobs are in metres")
    matrices = [IDENTITY, moved(800, 0, 0)]
    z_up = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
    whole = times(scaled(0.02, 0.02, 0.02), z_up)
    bakes_to(solids(*matrices), "all", [t for m in matrices for t in solid(times(whole, m))], 2, 1,
             "--unit", "cm", "--scale", "2", "--up", "z")
    close("the scale", Scene("case.esps").instances[0]["scale"], 1, 1e-6)
    claim("places of EXT_mesh_gpu_instancing are instances")
    gltf = solids(moved(0, 0, 1))
    gltf.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {
        "TRANSLATION": gltf.accessor([(float(8 * i), 0.0, 0.0) for i in range(50)])}}}
    gltf.extension("EXT_mesh_gpu_instancing")
    bakes_to(gltf, "all", [t for i in range(50) for t in solid(moved(8 * i, 0, 1))], 50, 1)


def variants():
    claim("sheared, unequally scaled and mirrored places share a variant if one turns, scales or moves into the other")
    turned = times(moved(0, 9, 0), times(turned_about_z(75), times(scaled(2, 2, 2), SHEARED)))
    matrices = [IDENTITY, SHEARED, times(moved(9, 0, 0), SHEARED), turned]
    bakes_to(solids(*matrices), "all", [t for m in matrices for t in solid(m)], 4, 2)
    mirror = scaled(-1, 1, 1)
    mirrors = [mirror, times(moved(0, 0, 9), times(turned_about_z(45), mirror)), scaled(1, -1, 1)]
    bakes_to(solids(IDENTITY, *mirrors), "all", solid() + [t for m in mirrors for t in solid(m, mirrored=True)], 4, 2)
    claim("a place of zero determinant is a mesh of its own, and one of zeros has no surface")
    flat = times(moved(0, 0, 7), scaled(1, 1, 0))
    gltf = solids(IDENTITY, moved(9, 0, 0), flat, times(moved(3, 0, 0), flat), scaled(0, 0, 0))
    # A face of the flat solid covers the others: which of them count as duplicates is the baker's business.
    report = baked(gltf, "all", "--max-dropped", "50%")
    is_equal("instances", report["instance_count"], 4)
    is_equal("meshes", report["mesh_count"], 2)
    is_equal("places of zero size", [m["instances"] for m in report["meshes"] if m["triangles"] == 0], [0])
    run("verify", "case.esps", "--deep")
    claim("a place that overflows is refused by name, as in one blob")
    for mode in ("auto", "all"):
        for place in (scaled(1e39, 1, 1), moved(1e39, 0, 0)):
            run("bake", write(solids(IDENTITY, place)), "-o", "none.esps", "--instances", mode, code=3, says=["mesh 1"])
    absent("none.esps")


def write(gltf, name="case.glb"):
    gltf.write(name)
    return name


def repeats():
    claim("copies are found by content, in one file and in several, whatever their names")
    gltf = Gltf()
    for i in range(3):
        gltf.node(mesh=gltf.mesh(solid_primitive(gltf), name="copy %d" % i), translation=[8 * i, 0, 0])
    bakes_to(gltf, "all", [t for i in range(3) for t in solid(moved(8 * i, 0, 0))], 3, 1)
    solids(IDENTITY).write("first.glb")
    solids(moved(8, 0, 0)).write("second.glb")
    done = run("bake", "first.glb", "second.glb", "-o", "case.esps", "--instances", "all", "--json")
    report = documented("bake", done.stdout)
    is_equal("meshes", report["mesh_count"], 1)
    is_equal("the sources", report["sources"], [{"file": 0, "mesh": 0}, {"file": 1, "mesh": 0}])
    is_equal("users", sorted(i["user"] for i in Scene("case.esps").instances), [0, 1])
    claim("other materials make another mesh only where materials are stored")
    gltf = Gltf()
    gltf.json["materials"] = [{}, {}]
    for i in range(2):
        gltf.node(mesh=gltf.mesh(solid_primitive(gltf, material=i)), translation=[8 * i, 0, 0])
    is_equal("meshes without materials", baked(gltf, "all")["mesh_count"], 1)
    is_equal("meshes with materials", baked(gltf, "all", "--materials")["mesh_count"], 2)


def automatic():
    claim("auto merges what is not repeated, and keeps repeats that save bytes")
    gltf = sheets([moved(20 * i, 0, 0) for i in range(6)])
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), translation=[0, 50, 0])
    gltf.node(mesh=gltf.mesh({**solid_primitive(gltf), "indices": gltf.accessor([[0], [1], [2]], UNSIGNED_SHORT)}))
    report = baked(gltf, "auto")
    is_equal("instances", report["instance_count"], 7)
    is_equal("meshes", report["mesh_count"], 2)
    is_equal("the merged mesh", (report["meshes"][0]["name"], report["meshes"][0]["places"]), (None, 2))
    is_equal("its source", report["sources"][0], None)
    merged = [i for i in Scene("case.esps").instances if i["source"] == 0][0]
    is_equal("its place", (merged["rotation"], merged["translation"], merged["scale"], merged["user"]),
             ((0, 0, 0, 1), (0, 0, 0), 1, 0xFFFFFFFF))
    run("verify", "case.esps", "--deep", "--source", "case.glb")
    claim("auto is smaller than one blob of the same step, and than all")
    sizes = {}
    for mode in ("off", "auto", "all"):
        run("bake", "case.glb", "-o", mode, "--instances", mode, "--step", "2^-8", "-q")
        sizes[mode] = os.path.getsize(mode)
    if not (sizes["auto"] < sizes["off"] and sizes["auto"] <= sizes["all"]):
        fail("bytes are %s" % sizes)
    claim("small meshes are not merged where they alone would pay for the merged blob")
    sizes = {mode: baked(sheets([moved(20 * i, 0, 0) for i in range(5)], 3), mode)["bytes"] for mode in ("auto", "all")}
    is_equal("the bytes of auto", sizes["auto"], sizes["all"])
    claim("small meshes with few repeats are merged, as are files without repeats")
    report = bakes_to(solids(IDENTITY, moved(8, 0, 0)), "auto", solid() + solid(moved(8, 0, 0)), 1, 1)
    is_equal("places", report["meshes"][0]["places"], 2)
    bakes_to(solids(UNIFORM), "auto", solid(UNIFORM), 1, 1)
    claim("off, like no option, gives the blob of before")
    run("bake", "case.glb", "-o", "off.espl", "--instances", "off", "-q")
    run("bake", "case.glb", "-o", "none.espl", "-q")
    is_equal("the blob", open("off.espl", "rb").read(), open("none.espl", "rb").read())


def borders():
    claim("pieces of a ground lie on one lattice also where axes turn, or the bake warns of their borders")

    def ground(side, before=IDENTITY):
        gltf = Gltf()
        points = [(x * side / 2, 0.3 if x == z == 1 else 0.0, z * side / 2) for x in range(3) for z in range(3)]
        faces = [f for a in (0, 1, 3, 4) for f in ((a, a + 1, a + 4), (a, a + 4, a + 3))]
        mesh = gltf.mesh(primitive(gltf, points, faces), name="piece")
        for i in range(4):
            gltf.node(mesh=mesh, matrix=columns(times(before, moved(i % 2 * side, 0, i // 2 * side))))
        return gltf

    def warnings_of(report):
        return [w["message"] for w in report["warnings"] if w["kind"] == "borders_apart"]

    for gltf, options in ((ground(10), ()), (ground(10), ("--up", "z")), (ground(10, turned_about_z(90)), ()),
                          (ground(0.75), ("--scale", "4"))):
        report = baked(gltf, "all", "--step", "2^-8", *options)
        is_equal("pieces on one lattice", report["on_common_lattice"], 4)
        is_equal("warnings", warnings_of(report), [])
    run("bake", "case.glb", "-o", "case.esps", "--instances", "all", "--step", "2^-8", "--scale", "4",
        says=["common lattice: 4 of 4 instances; where two of them share an edge or a vertex, no ray passes between them"])
    report = baked(ground(10.02), "all", "--step", "2^-8")
    is_equal("pieces on one lattice", report["on_common_lattice"], 1)
    if len(warnings_of(report)) != 1 or not warnings_of(report)[0].startswith("4 mesh places share border edges"):
        fail("no warning of borders: %s" % report["warnings"])
    is_equal("one blob", warnings_of(baked(ground(10.02), "auto", "--step", "2^-8")), [])
    baked(ground(10.02), "all", "--step", "2^-8", "--strict", code=3)


def tolerances():
    claim("a tolerance holds in the world: meshes that places enlarge are baked finer")
    matrices = [moved(100 * i, 7.1 * i, 0) for i in range(8)]
    matrices[5] = times(matrices[5], scaled(7, 7, 7))
    for tolerance in ("1mm", "0.1mm"):
        report = baked(sheets(matrices), "all", "--tolerance", tolerance)
        if report["total_error"] > float(tolerance[:-2]) / 1000:
            fail("the error is %s at a tolerance of %s" % (report["total_error"], tolerance))
        close("the error in the header", Scene("case.esps").max_error, report["max_error"], 1e-9)
        is_equal("meshes", report["mesh_count"], 1)
        run("verify", "case.esps", "--deep", "--source", "case.glb")
    claim("what a Transform cannot place within the tolerance keeps its vertices in the world")
    far = [moved(1e6 + 0.03, 0, 0), IDENTITY, moved(50, 0, 0)]
    report = baked(sheets(far), "all", "--tolerance", "5mm")
    is_equal("meshes", report["mesh_count"], 2)
    report = baked(sheets(far), "all")
    is_equal("meshes without a tolerance", report["mesh_count"], 1)
    close("the error of placing", report["placing_error"], 0.03, 1e-6)


def many():
    claim("thousands of places take little time and the same bytes with any number of threads")
    gltf = sheets([], 8)
    for i in range(5000):
        gltf.node(mesh=0, translation=[10 * (i % 71), 3 * (i % 7), 10 * (i // 71)], rotation=quaternion_about_z(i % 360))
    report = baked(gltf, "auto", "--threads", "1")
    is_equal("instances", (report["instance_count"], report["mesh_count"]), (5000, 1))
    first = hashlib.sha256(open("case.esps", "rb").read()).digest()
    baked("case.glb", "auto", "--threads", "2")
    is_equal("the bytes", hashlib.sha256(open("case.esps", "rb").read()).digest(), first)
    run("verify", "case.esps", "--deep", "--source", "case.glb")
    claim("a hundred thousand nested nodes are placed")
    gltf = solids(IDENTITY)
    for i in range(100000):
        gltf.node(children=[i])
    bakes_to(gltf, "all", solid(), 1, 1)
