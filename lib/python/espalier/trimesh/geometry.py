"""Triangles in float64: normals and closest points."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def dot(a: Array, b: Array) -> Array:
    """Returns the dot products of rows."""
    product: Array = np.einsum("...i,...i->...", a, b)
    return product


def unit(vectors: Array) -> Array:
    """Returns rows of length 1; those without a length become 0."""
    length = np.sqrt(dot(vectors, vectors))[..., np.newaxis]
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def normals(corners: Array) -> Array:
    """Returns the unit normals of triangles, (n, 3)."""
    return unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))


def closest_points(corners: Array, points: Array) -> Array:
    """Returns the point of each triangle, (n, 3, 3), that is closest to the point of its row, (n, 3).

    Inside of a face by its barycentric weights, else the nearest of the points of the three edges.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    best, least = a.copy(), dot(points - a, points - a)
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        length = dot(along, along)
        share = np.divide(dot(points - start, along), length, out=np.zeros_like(length), where=length > 0)
        place = start + np.clip(share, 0.0, 1.0)[:, np.newaxis] * along
        distance = dot(points - place, points - place)
        nearer = distance < least
        best[nearer], least[nearer] = place[nearer], distance[nearer]
    first, second, way = b - a, c - a, points - a
    p, q, r = dot(first, first), dot(first, second), dot(second, second)
    s, t = dot(way, first), dot(way, second)
    area = p * r - q * q
    with np.errstate(divide="ignore", invalid="ignore"):
        v, w = (r * s - q * t) / area, (p * t - q * s) / area
    within: NDArray[Any] = (area > 0) & (v >= 0) & (w >= 0) & (v + w <= 1)
    best[within] = (a + v[:, np.newaxis] * first + w[:, np.newaxis] * second)[within]
    return best
