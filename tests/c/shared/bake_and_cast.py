"""bake_and_cast.py LIBRARY: loads libespalier as a binding would, bakes a cube of float64 and queries it in batches."""
import array
import ctypes
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_float, c_int, c_size_t, c_ssize_t, c_uint8, c_uint32, c_void_p

lib = ctypes.CDLL(sys.argv[1])


class MeshView(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("positions", c_void_p), ("position_count", c_size_t), ("position_stride", c_ssize_t),
                ("triangles", c_void_p), ("triangle_count", c_size_t), ("triangle_stride", c_ssize_t), ("materials", c_void_p),
                ("name", c_char_p), ("file", c_uint32), ("mesh", c_uint32), ("coordinate_type", c_uint8), ("index_type", c_uint8)]


class SourcePlace(ctypes.Structure):
    _fields_ = [("file", c_uint32), ("mesh", c_uint32), ("triangle", c_uint32), ("is_known", c_uint8)]


class BakeResult(ctypes.Structure):
    _fields_ = [("bytes", c_void_p), ("byte_count", c_size_t), ("remap", c_void_p), ("remap_count", c_size_t), ("report", c_void_p),
                ("message", c_char_p), ("place", SourcePlace), ("status", c_uint8)]


class Strided(ctypes.Structure):
    _fields_ = [("first", c_void_p), ("stride", c_ssize_t)]


class RayArrays(ctypes.Structure):
    _fields_ = [("origins", Strided), ("directions", Strided), ("t_min", Strided), ("t_max", Strided), ("culling", c_uint8)]


class RayHit(ctypes.Structure):
    _fields_ = [("t", c_float), ("u", c_float), ("v", c_float), ("normal", c_float * 3), ("triangle", c_uint32),
                ("status", c_uint8), ("side", c_uint8), ("reserved", c_uint8 * 2)]


class Filled(ctypes.Structure):
    _fields_ = [("count", c_size_t), ("next", c_uint32 * 3), ("status", c_uint8)]


lib.espalier_version.restype = c_char_p
lib.espalier_size_of.restype = lib.espalier_size_of_baking.restype = c_size_t
lib.espalier_bake.restype = POINTER(BakeResult)
lib.espalier_raycast_arrays.restype = lib.espalier_contains_arrays.restype = Filled
lib.espalier_open.argtypes = [c_void_p, c_size_t, c_void_p]


def expect(condition, what):
    if not condition:
        sys.exit(f"bake_and_cast.py: {what}")


for name, structure in (("ray_hit", RayHit), ("ray_arrays", RayArrays), ("strided_vec3", Strided), ("filled", Filled)):
    expect(lib.espalier_size_of(name.encode()) == ctypes.sizeof(structure), f"another size of {name}")
for name, structure in (("mesh_view", MeshView), ("bake_result", BakeResult)):
    expect(lib.espalier_size_of_baking(name.encode()) == ctypes.sizeof(structure), f"another size of {name}")

corners = array.array("d", [c for z in (0, 1) for y in (0, 1) for x in (0, 1) for c in (x, y, z)])
faces = array.array("I", [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5])
mesh = MeshView()
lib.espalier_init_mesh_view(byref(mesh), c_size_t(ctypes.sizeof(mesh)))
mesh.positions, mesh.position_count, mesh.position_stride, mesh.coordinate_type = corners.buffer_info()[0], 8, 24, 1
mesh.triangles, mesh.triangle_count = faces.buffer_info()[0], 12
mesh.name = b"cube"
baked = lib.espalier_bake(byref(mesh), c_size_t(1), None)
expect(baked.contents.status == 0, baked.contents.message.decode())

room = ctypes.create_string_buffer(lib.espalier_size_of(b"blob") + 16)  # of any alignment
aligned = (ctypes.addressof(room) + 15) & ~15
misaligned = 13
expect(lib.espalier_open(baked.contents.bytes, baked.contents.byte_count, aligned + 8) & 255 == misaligned, "8 modulo 16 is taken")
expect(lib.espalier_open(baked.contents.bytes, baked.contents.byte_count, aligned) & 255 == 0, "the blob does not open")

count = 1000
origins = array.array("f", [c for i in range(count) for c in (0.25 + 0.0005 * i, 0.5, 3.0)])
down = array.array("f", [0.0, 0.0, -1.0])
rays = RayArrays(origins=Strided(origins.buffer_info()[0], 12), directions=Strided(down.buffer_info()[0], 0))
hits = (RayHit * count)()
filled = lib.espalier_raycast_arrays(c_void_p(aligned), byref(rays), hits, c_size_t(count))
expect(filled.status == 0 and filled.count == count, "the batch is refused")
expect(all(hit.status == 0 and hit.t == 2.0 for hit in hits), "a ray misses the cube")
inside = (c_uint8 * count)()
lib.espalier_contains_arrays(c_void_p(aligned), Strided(origins.buffer_info()[0], 12), inside, c_size_t(count))
expect(all(status == 1 for status in inside), "a point above the cube is inside")

faces[3] = 99
lib.espalier_release_bake_result(baked)
refused = lib.espalier_bake(byref(mesh), c_size_t(1), None)
expect(refused.contents.status == 2 and b"cube, triangle 1" in refused.contents.message, "a broken mesh is not refused")
lib.espalier_release_bake_result(refused)
print(f"Espalier {lib.espalier_version().decode()}: baked, {count} rays and points")
