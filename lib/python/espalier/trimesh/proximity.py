"""Closest points and signed distances, as those of trimesh.proximity."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..shapes import Sphere
from .baked_mesh import BakedMesh, baked_of, checked_points, lasting
from .geometry import closest_points, dot, normals

TIE = 1e-8
"""trimesh.tol.merge: squared distances that differ by less are equal, and a point that is nearer lies on the surface."""
PAIRS_AT_ONCE = 1 << 20

Found = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]


def closest_point(mesh: Any, points: ArrayLike) -> Found:
    """Returns (closest points (n, 3), distances (n,), numbers of faces (n,)), of trimesh.proximity.closest_point.

    Of several faces at one distance, the one that faces the point most. A point that is not finite has NaN and -1.
    """
    baked, given = baked_of(mesh), checked_points(points, "points")
    closest = np.full(given.shape, np.nan)
    distance = np.full(len(given), np.nan)
    face = np.full(len(given), -1, np.int64)
    finite = np.isfinite(given).all(axis=1)
    for begin in range(0, len(given), 4096):
        some = np.flatnonzero(finite[begin : begin + 4096]) + begin
        if len(some) and len(baked.face_of):
            closest[some], distance[some], face[some] = _closest(baked, given[some])
    return closest, distance, face


def _closest(baked: BakedMesh, points: NDArray[np.float64]) -> Found:
    rows, faces = _near_faces(baked, points)
    results: tuple[Any, ...] = (np.empty(points.shape), np.empty(len(points)), np.empty(len(points), np.int64))
    begin = 0
    while begin < len(rows):  # whole points at a time
        last = rows[min(begin + PAIRS_AT_ONCE, len(rows)) - 1]
        if last == rows[-1]:
            last += 1
        end = int(np.searchsorted(rows, max(last, rows[begin] + 1)))
        of, which = rows[begin:end], faces[begin:end]
        corners = baked.corners(which)
        places = closest_points(corners, points[of])
        ways = points[of] - places
        squared = dot(ways, ways)
        starts = np.flatnonzero(np.diff(of, prepend=-1))
        lengths = np.diff(starts, append=len(of))
        best = np.repeat(np.minimum.reduceat(squared, starts), lengths)
        facing = dot(normals(corners), ways)
        is_tied = (squared - best < TIE) & (squared > TIE) & (best > TIE)
        cosine = np.divide(facing, np.sqrt(squared), out=np.zeros_like(facing), where=squared > 0)
        order = np.lexsort((which, squared, -np.where(is_tied, cosine, 0.0), ~is_tied & (squared > best), of))
        first = order[starts]
        for result, value in zip(results, (places, np.sqrt(squared), which)):
            result[of[first]] = value[first]
        begin = end
    return results[0], results[1], results[2]


def _near_faces(baked: BakedMesh, points: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """Returns the faces, one or more of each point, among which the closest is, and those at about the same distance."""
    blob = baked.blob
    found, moved = blob.closest_point(points), blob.rounding_error(points)
    answered = (found["status"] == 0) & (moved["status"] == 0)
    distance = found["distance"].astype(np.float64)
    bound = baked.error + moved["value"].astype(np.float64) + 2.0**-20 * distance
    reach = np.where(distance > TIE**0.5 - bound, np.sqrt(distance**2 + TIE), distance) + 4 * bound
    near = blob.overlapping_triangles(Sphere(points[answered], reach[answered]))
    rows = np.flatnonzero(answered)[near.queries()]
    faces = baked.face_of[near.items]
    rest = np.setdiff1d(np.arange(len(points)), rows)  # too far away for the lattice: all faces
    rows = np.concatenate([rows, np.repeat(rest, len(baked.faces))])
    faces = np.concatenate([faces, np.tile(np.arange(len(baked.faces)), len(rest))])
    order = np.argsort(rows, kind="stable")
    return rows[order], faces[order]


def signed_distance(mesh: Any, points: ArrayLike) -> NDArray[np.float64]:
    """Returns distances to the surface, (n,), positive inside and negative outside.

    Inside of an open surface is where it winds around a point by more than a half. As trimesh.proximity has it, a
    distance of no more than 1e-8 is positive.
    """
    baked, given = baked_of(mesh), checked_points(points, "points")
    _, distance, _ = closest_point(baked, given)
    return np.where((distance <= TIE) | baked.contains(given), distance, -distance)


class ProximityQuery:
    """trimesh.proximity.ProximityQuery."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh
        self._given = lasting(mesh)

    def on_surface(self, points: ArrayLike) -> Found:
        """Returns (closest points, distances, numbers of faces)."""
        return closest_point(self._given, points)

    def vertex(self, points: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Returns (distances, numbers of vertices) of the closest vertices. Takes the tree of trimesh, where there is one."""
        mesh = self._mesh.mesh if isinstance(self._mesh, BakedMesh) else self._mesh
        tree = getattr(mesh, "kdtree", None)
        if tree is not None:
            distance, vertex = tree.query(points)
            return distance, vertex
        given, vertices = checked_points(points, "points"), np.asarray(mesh.vertices, np.float64)
        ways = [vertices - point for point in given]
        numbers = np.array([np.argmin(dot(way, way)) for way in ways], np.int64)
        return np.linalg.norm(vertices[numbers] - given, axis=1), numbers

    def signed_distance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Returns distances to the surface, positive inside."""
        return signed_distance(self._given, points)
