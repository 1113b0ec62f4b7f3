"""Espalier in the shape of trimesh's back ends for rays, proximity and collisions. Needs no trimesh.

    blob = bake_trimesh(mesh)                      # anything with .vertices and .faces
    Rays(blob).intersects_location(origins, directions)
    Proximity(blob).signed_distance(points)
"""

from typing import Any

import numpy as np

import espalier
from espalier import Status


def bake_trimesh(mesh: Any, **options: Any) -> espalier.Blob:
    """Bakes a mesh with `vertices` and `faces`."""
    return espalier.bake(mesh.vertices, mesh.faces, original_ids=True, **options)


class Rays:
    """mesh.ray: triangles are those of the mesh. Each crossing of an edge counts once, as multiple hits."""

    def __init__(self, blob: espalier.Blob) -> None:
        self.blob = blob

    def intersects_any(self, origins: Any, directions: Any) -> Any:
        return self.blob.occluded(origins, directions).value_or(False)

    def intersects_first(self, origins: Any, directions: Any) -> Any:
        view = self.blob.raycast_sources(origins, directions)
        return np.where(view.sources["status"] == Status.OK, view.sources["triangle"].astype(np.int64), -1)

    def intersects_location(self, origins: Any, directions: Any, multiple_hits: bool = True) -> Any:
        """Returns (locations, numbers of rays, numbers of triangles)."""
        blob, origins, directions = self.blob, np.asarray(origins, np.float32), np.asarray(directions, np.float32)
        lists = blob.crossings(origins, directions) if multiple_hits else blob.closest_hits(origins, directions, 1)
        rays = lists.queries()
        places = origins[rays].astype(float) + lists.items["t"].astype(float)[:, None] * directions[rays]
        return places, rays, blob.original_hits(lists.items)["triangle"].astype(np.int64)

    def contains_points(self, points: Any) -> Any:
        return self.blob.contains(points).value_or(False)


class Proximity:
    """trimesh.proximity.ProximityQuery."""

    def __init__(self, blob: espalier.Blob) -> None:
        self.blob = blob

    def on_surface(self, points: Any) -> Any:
        """Returns (closest points, distances, numbers of triangles)."""
        found = self.blob.closest_point(points)
        return found["point"], found["distance"], self.blob.original_triangles(found["triangle"])["triangle"]

    def signed_distance(self, points: Any) -> Any:
        """Positive inside, as trimesh has it. NaN for a surface that is not closed."""
        found = self.blob.signed_distance(points)
        return np.where(found["status"] == Status.OK, -found["distance"], np.nan)


class Collisions:
    """trimesh.collision.CollisionManager: named blobs, each with a matrix (4, 4) of its place."""

    def __init__(self) -> None:
        self.objects: dict[str, tuple[espalier.Blob, Any]] = {}

    def add_object(self, name: str, blob: espalier.Blob, transform: Any = np.eye(4)) -> None:
        self.objects[name] = (blob, espalier.transform_from_matrix(transform))

    def in_collision_single(self, blob: espalier.Blob, transform: Any = np.eye(4)) -> bool:
        return any(self._with_each(espalier.pairs.overlaps, blob, transform, lambda answer: bool(answer.yes)))

    def min_distance_single(self, blob: espalier.Blob, transform: Any = np.eye(4)) -> float:
        return min(self._with_each(espalier.pairs.distance, blob, transform, lambda found: float(found["distance"])))

    def _with_each(self, query: Any, blob: espalier.Blob, transform: Any, use: Any) -> Any:
        place = espalier.transform_from_matrix(transform)
        return (use(query(other, blob, at, place)) for other, at in self.objects.values())
