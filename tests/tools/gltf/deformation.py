"""Deformable blobs: the order of the vertices."""
from .builder import *
from .checks import *
from .compression import draco_file

RANGE = ["--deformable", "--range", "-9", "-9", "-9", "9", "9", "9"]


def write_obj(path, points, faces):
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v %r %r %r\n" % point for point in points)
        file.writelines("f %d %d %d\n" % tuple(corner + 1 for corner in face) for face in faces)


def deformation():
    claim("a deformable bake keeps each primitive's positions in the order of its accessor with unused ones")
    points = [(5.0, 5.0, 5.0), *POINTS[::-1], (1.0, 1.0, 1.0)]
    faces = [tuple(4 - corner for corner in face) for face in FACES]
    gltf = Gltf()
    shared = gltf.accessor(points)
    halves = [{"attributes": {"POSITION": shared}, "indices": gltf.accessor([[i] for face in half for i in face], UNSIGNED_SHORT)}
              for half in (faces[:2], faces[2:])]
    gltf.node(mesh=gltf.mesh(*halves))
    gltf.write("shared.glb")
    write_obj("shared.obj", points + points, faces[:2] + [tuple(i + len(points) for i in face) for face in faces[2:]])
    for name in ("shared.glb", "shared.obj"):
        run("bake", name, "-o", name + ".espl", "-q", *RANGE)
    if open("shared.glb.espl", "rb").read() != open("shared.obj.espl", "rb").read():
        fail("the vertices differ from those of the OBJ")
    claim("a glTF pose is refitted in the order of its accessors")
    moved_points = [(x + 1.0, 1.5 * y, z - x) for x, y, z in points]
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh({"attributes": {"POSITION": gltf.accessor(moved_points + moved_points)}}))
    gltf.write("moved.glb")
    write_obj("moved.obj", moved_points + moved_points, [])
    for name in ("moved.glb", "moved.obj"):
        run("refit", "shared.glb.espl", name, "-o", name + ".espl", "-q")
    if open("moved.glb.espl", "rb").read() != open("moved.obj.espl", "rb").read():
        fail("the refitted vertices differ from those of the OBJ")
    claim("Draco sorts vertices and is refused for a deformable blob")
    draco_file().write("draco.glb")
    done = run("bake", "draco.glb", "-o", "x.espl", *RANGE, code=5)
    if "Draco sorts its vertices" not in done.stderr or "without compression" not in done.stderr:
        fail(done.stderr)
    if "drop" in done.stderr:
        fail("the message offers to drop triangles: " + done.stderr)
