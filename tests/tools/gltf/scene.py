"""Scenes, nodes and instances."""
from .builder import *
from .checks import *
from .skin import skin_file


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
    refused(changed(instanced_file(TRANSLATION=(places,)), "accessors.2.count", 0), 3, "node 0", "accessor 2", "count")
    claim("instances of different counts, and of a skinned mesh, are refused")
    refused(instanced_file(TRANSLATION=(places,), SCALE=(sizes[:2],)), 3, "node 0", "different numbers")
    gltf = skin_file([[1, 0, 0, 0]] * 4)
    gltf.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": gltf.accessor(places)}}}
    refused(gltf, 5, "node 0", "skinned and instanced")
