"""Rays, as those of trimesh.ray.ray_triangle.RayMeshIntersector."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .baked_mesh import BakedMesh, baked_of, checked_points, lasting
from .geometry import dot, normals, unit

BEHIND = 1e-6
"""How far behind the origin of a ray trimesh counts a hit: a ray that starts on the surface hits it."""


class _Hits(NamedTuple):
    faces: NDArray[np.int64]
    rays: NDArray[np.int64]
    places: NDArray[np.float64]


class RayMeshIntersector:
    """mesh.ray of one mesh, or of what bake_trimesh() returned. Faces and rays are int64.

    A hit is a crossing of the surface: one that meets a shared edge or vertex counts once, so that counts are those of
    crossings. Hits of one ray are sorted along it. As in trimesh, a ray that starts on the surface hits it there.
    """

    def __init__(self, mesh: Any, **_options: Any) -> None:
        self._given = lasting(mesh)
        self.mesh = mesh.mesh if isinstance(mesh, BakedMesh) else mesh

    def intersects_id(self, ray_origins: ArrayLike, ray_directions: ArrayLike, return_locations: bool = False,
                      multiple_hits: bool = True, **_options: Any) -> tuple[NDArray[Any], ...]:
        """Returns (faces (h,), rays (h,)) and, if wanted, locations (h, 3)."""
        hits = self._hits(ray_origins, ray_directions, multiple_hits)
        return hits if return_locations else hits[:2]

    def intersects_location(self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool = True,
                            **_options: Any) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
        """Returns (locations (h, 3), rays (h,), faces (h,))."""
        hits = self._hits(ray_origins, ray_directions, multiple_hits)
        return hits.places, hits.rays, hits.faces

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike, **_options: Any) -> NDArray[np.int64]:
        """Returns the face that each ray hits first, (n,), or -1."""
        hits = self._hits(ray_origins, ray_directions, False)
        faces = np.full(len(np.asarray(ray_origins)), -1, np.int64)
        faces[hits.rays] = hits.faces
        return faces

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike, **options: Any) -> NDArray[np.bool_]:
        """Returns whether each ray hits the mesh, (n,)."""
        return self.intersects_first(ray_origins, ray_directions, **options) >= 0

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Returns whether each point is inside, (n,): of an open surface, whether it winds around it by more than a half."""
        return baked_of(self._given).contains(checked_points(points, "points"))

    def _hits(self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool) -> _Hits:
        baked = baked_of(self._given)
        origins, directions = checked_points(ray_origins, "ray_origins"), checked_points(ray_directions, "ray_directions")
        origins, directions = np.broadcast_arrays(origins, directions)
        ways = unit(directions)
        starts = _starts(baked, origins, ways)
        begins = origins + starts[:, np.newaxis] * ways
        hits = _on_faces(baked, origins, ways, directions, starts, baked.blob.crossings(begins, ways)) \
            if multiple_hits else _firsts(baked, origins, ways, directions, starts, begins)
        return hits


def _starts(baked: BakedMesh, origins: NDArray[np.float64], ways: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns where rays begin along themselves: a little behind their origins, or near the mesh if that is far away.

    There, float32 rounds the least.
    """
    low, high = baked.bounds()
    radius = np.linalg.norm(high - low) / 2
    to_middle = dot((low + high) / 2 - origins, ways)
    behind = 2 * BEHIND + 8 * baked.error + 2.0**-22 * radius
    return np.where(to_middle > 4 * radius + behind, to_middle - 2 * radius, -behind)


def _on_faces(baked: BakedMesh, origins: NDArray[np.float64], ways: NDArray[np.float64],
              directions: NDArray[np.float64], starts: NDArray[np.float64], lists: Any) -> _Hits:
    """Returns hits on the faces of the mesh, in float64, without those behind the origins."""
    rays, faces = lists.queries().astype(np.int64), baked.face_of[lists.items["triangle"]]
    along = starts[rays] + lists.items["t"].astype(np.float64)
    corners = baked.corners(faces)
    across = normals(corners)
    slope = dot(across, ways[rays])
    to_plane = dot(across, corners[:, 0] - origins[rays])
    exact = np.divide(to_plane, slope, out=along.copy(), where=np.abs(slope) > 1e-9)
    # A ray along a face meets its plane anywhere: there the place is that of the baked surface.
    reach = np.abs(baked.bounds() - baked.origin).max(initial=0.0)
    bound = 16 * (baked.error + 2.0**-22 * (np.abs(along - starts[rays]) + reach))
    along = np.where(np.abs(exact - along) * np.abs(slope) <= bound, exact, along)
    length = np.sqrt(dot(directions, directions))
    forward = along * length[rays] > -BEHIND
    rays, faces, along = rays[forward], faces[forward], along[forward]
    order = np.lexsort((faces, along, rays))
    rays, faces, along = rays[order], faces[order], along[order]
    return _Hits(faces, rays, origins[rays] + along[:, np.newaxis] * ways[rays])


def _firsts(baked: BakedMesh, origins: NDArray[np.float64], ways: NDArray[np.float64],
            directions: NDArray[np.float64], starts: NDArray[np.float64], begins: NDArray[np.float64]) -> _Hits:
    """Returns the first hit of each ray that has one: the closest, unless it is behind the origin."""
    lists = baked.blob.closest_hits(begins, ways, 1)
    hits = _on_faces(baked, origins, ways, directions, starts, lists)
    left = np.setdiff1d(np.unique(lists.queries()), hits.rays)
    if len(left) == 0:
        return hits
    every = _on_faces(baked, origins[left], ways[left], directions[left], starts[left],
                      baked.blob.all_hits(begins[left], ways[left]))
    _, first = np.unique(every.rays, return_index=True)
    more = _Hits(every.faces[first], left[every.rays[first]], every.places[first])
    order = np.argsort(np.concatenate([hits.rays, more.rays]), kind="stable")
    return _Hits(*(np.concatenate(both)[order] for both in zip(hits, more)))
