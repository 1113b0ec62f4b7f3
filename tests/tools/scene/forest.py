"""A forest: thousands of trees of a few kinds, each turned and scaled, on a hilly ground."""
import math
import random

from gltf.builder import *

from .files import grid, primitive


def cone(sides, radius, low, high):
    """A cone about the y axis with a closed base, as points and faces."""
    points = [(0.0, high, 0.0), (0.0, low, 0.0)]
    for i in range(sides):
        angle = 2 * math.pi * i / sides
        points.append((radius * math.cos(angle), low, radius * math.sin(angle)))
    faces = []
    for i in range(sides):
        a, b = 2 + i, 2 + (i + 1) % sides
        faces += [(0, b, a), (1, a, b)]
    return points, faces


def tree(kind):
    """A trunk and `kind` + 2 cones of needles."""
    points, faces = cone(6, 0.25, 0.0, 6.0)
    for i in range(kind + 2):
        more_points, more_faces = cone(9, 2.0 - 0.3 * i, 1.0 + 1.5 * i, 4.0 + 1.5 * i)
        faces += [tuple(corner + len(points) for corner in face) for face in more_faces]
        points += more_points
    return points, faces


def forest(count):
    """A glTF file of so many trees of four kinds."""
    gltf = Gltf()
    chance = random.Random(10000)
    kinds = [gltf.mesh(primitive(gltf, *tree(kind)), name=f"tree {kind}") for kind in range(4)]
    side = math.isqrt(count) * 4.0
    gltf.node(mesh=gltf.mesh(primitive(gltf, *grid(40)), name="ground"), scale=[side / 40, 1.0, side / 40])
    for _ in range(count):
        half = chance.uniform(0.0, math.pi)
        gltf.node(mesh=chance.choice(kinds), scale=[chance.uniform(0.5, 1.5)] * 3,
                  translation=[chance.uniform(0.0, side), 0.0, chance.uniform(0.0, side)],
                  rotation=[0.0, math.sin(half), 0.0, math.cos(half)])
    return gltf
