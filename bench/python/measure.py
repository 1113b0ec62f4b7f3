"""Times the batches of Python on one thread against plain loops of C++ on the same arrays, in turns.

    measure.py LOOPS.so [MESH.obj | MESH.ply | MESH.stl]

A figure of 1.1 means that Python took 1 / 1.1 of the time of the loop. Times are the median of 7 turns; both sides write
to new memory in each. Run it alone.
"""

import ctypes
import sys
import time

import numpy as np

import espalier

COUNT = 1_000_000
TURNS = 7


def torus(rings=260, sides=100):
    a, b = np.meshgrid(np.linspace(0, 2 * np.pi, rings, False), np.linspace(0, 2 * np.pi, sides, False), indexing="ij")
    distance = 3 + np.cos(b) * (1 + 0.1 * np.sin(15 * a))
    positions = np.stack([distance * np.cos(a), distance * np.sin(a), np.sin(b)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    at = lambda row, column: (row % rings) * sides + column % sides
    corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)]
    return positions, np.stack(corners, -1).reshape(-1, 3)


def empty(count, dtype, *shape):
    return np.empty((count, *shape), dtype)


def main():
    loops = ctypes.CDLL(sys.argv[1])
    positions, triangles = espalier.read_mesh(sys.argv[2]).meshes[0][:2] if len(sys.argv) > 2 else torus()
    positions = positions * (8 / np.ptp(positions, axis=0).max())  # spheres below have a radius of 0.1
    blob = espalier.bake(positions, triangles, original_ids=True)
    print(blob)
    data = np.frombuffer(blob.data, np.uint8)
    random = np.random.default_rng(1)
    low, high = blob.bounds
    size = np.float32(np.max(high - low))
    points = random.uniform(low - 0.1 * size, high + 0.1 * size, (COUNT, 3)).astype(np.float32)
    aims = random.uniform(low, high, (COUNT, 3)).astype(np.float32)
    incoherent = (points, aims - points)
    eye = (high + 0.7 * size).astype(np.float32)
    side = int(COUNT**0.5)
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, side), np.linspace(-0.5, 0.5, side))
    toward = (low + high) / 2 - eye
    right = np.cross(toward, [0, 0, 1])
    right *= np.linalg.norm(toward) / np.linalg.norm(right)
    up = np.cross(right, toward) / np.linalg.norm(toward)
    camera_directions = (toward + u[..., None] * right + v[..., None] * up).reshape(-1, 3).astype(np.float32)
    camera = (np.broadcast_to(eye, camera_directions.shape).copy(), camera_directions)
    scale = np.float32(0.02)
    sources = [(espalier.RAY_HIT,), (np.float64, 3), (espalier.ORIGINAL_HIT,)]
    total = [(np.intp,)]
    status = [(np.uint8,)]
    cases = [
        ("rays, sources, places: incoherent", "raycast_sources", incoherent, sources, COUNT, blob.raycast_sources),
        ("rays, sources, places: camera", "raycast_sources", camera, sources, COUNT, blob.raycast_sources),
        ("closest hits: incoherent", "raycast", incoherent, sources[:1], COUNT, blob.raycast),
        ("closest hits: camera", "raycast", camera, sources[:1], COUNT, blob.raycast),
        ("any hit: incoherent", "occluded", incoherent, status, COUNT, blob.occluded),
        ("all hits: incoherent", "all_hits", incoherent, total, COUNT, blob.all_hits),
        ("closest points", "closest_point", (points, points), [(espalier.CLOSEST_POINT,)], COUNT // 10,
         lambda p, _: blob.closest_point(p)),
        ("signed distances", "signed_distance", (points, points), [(espalier.CLOSEST_POINT,)], COUNT // 10,
         lambda p, _: blob.signed_distance(p)),
        ("inside", "contains", (points, points), status, COUNT, lambda p, _: blob.contains(p)),
        ("overlaps of spheres", "overlaps", (points, points), status, COUNT,
         lambda p, _: blob.overlaps(espalier.Sphere(p, 0.1))),
        ("triangles in spheres", "overlapping_triangles", (points, points), total, COUNT,
         lambda p, _: blob.overlapping_triangles(espalier.Sphere(p, 0.1))),
        ("sweeps of spheres", "sweep", (points, (aims - points) * scale), [(espalier.SWEEP_HIT,)], COUNT // 10,
         lambda p, d: blob.sweep(espalier.Sphere(p, 0.1), d)),
    ]
    for name, loop, (first, second), outputs, count, query in cases:
        first, second = first[:count], second[:count]
        pointer = lambda array: array.ctypes.data_as(ctypes.c_void_p)
        times = [[], []]
        for _ in range(TURNS):
            start = time.perf_counter()
            arrays = [empty(count, *output) for output in outputs]
            getattr(loops, "loop_" + loop)(pointer(data), ctypes.c_size_t(len(data)), ctypes.c_size_t(count),
                                           pointer(first), pointer(second), *(pointer(array) for array in arrays))
            middle = time.perf_counter()
            query(first, second)
            end = time.perf_counter()
            times[0].append(middle - start)
            times[1].append(end - middle)
        ours, theirs = np.median(times[1]), np.median(times[0])
        print(f"{name:36} C++ {theirs * 1e9 / count:8.1f} ns   Python {ours * 1e9 / count:8.1f} ns   {theirs / ours:5.2f}")


main()
