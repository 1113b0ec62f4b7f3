"""Measures a part by espalier.trimesh: what rays hit, how thick it is, and what it collides with.

    as_trimesh.py [MESH]

MESH is a file that trimesh reads. Without one, and without trimesh, the part is a tube that is made here.
"""

import sys
import types
from typing import Any

import numpy as np

import espalier.trimesh


def tube(sides: int = 64) -> Any:
    """Returns a closed tube, 2 long, of the radii 0.75 and 1: anything with vertices and faces is a mesh."""
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    rings = [(1.0, -1.0), (1.0, 1.0), (0.75, 1.0), (0.75, -1.0)]
    vertices = np.concatenate([np.stack([r * np.cos(turn), r * np.sin(turn), 0 * turn + z], -1) for r, z in rings])
    ring, side = np.meshgrid(np.arange(4), np.arange(sides), indexing="ij")
    at = lambda i, j: (i % 4) * sides + j % sides
    a, b, c, d = at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)
    return types.SimpleNamespace(vertices=vertices, faces=np.stack([a, b, c, a, c, d], -1).reshape(-1, 3))


def load(path: str) -> Any:
    import trimesh

    return trimesh.load(path, force="mesh")


def main(arguments: list[str]) -> None:
    mesh = load(arguments[0]) if arguments else tube()
    rays, query = espalier.trimesh.RayMeshIntersector(mesh), espalier.trimesh.ProximityQuery(mesh)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    middle, size = (low + high) / 2, np.linalg.norm(high - low)

    # A fan of rays through the middle: where they enter and leave, and how much of the part they pass through.
    angles = np.linspace(0, np.pi, 32, endpoint=False)
    ways = np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
    places, numbers, _ = rays.intersects_location(ray_origins=middle - size * ways, ray_directions=ways)
    print(f"{len(places)} crossings of {len(ways)} rays")
    for number in range(3):
        along = (places[numbers == number] - middle) @ ways[number]
        print(f"  ray {number}: {np.round(along, 4)}")

    # Distances: positive inside, as trimesh has them.
    points = middle + np.linspace(0, 1, 5)[:, None] * [size / 2, 0, 0]
    print("distances", np.round(query.signed_distance(points), 4))

    # A copy beside it.
    manager = espalier.trimesh.CollisionManager()
    manager.add_object("part", mesh)
    aside = np.eye(4)
    aside[0, 3] = 1.5 * (high - low)[0]
    print("collides with itself:", manager.in_collision_single(mesh))
    print(f"a copy aside is {manager.min_distance_single(mesh, aside):.4f} away")


if __name__ == "__main__":
    main(sys.argv[1:])
