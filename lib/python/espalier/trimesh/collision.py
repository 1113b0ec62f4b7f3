"""Named meshes at places in a world, as trimesh.collision.CollisionManager has them."""

from __future__ import annotations

from itertools import combinations, product
from typing import Any, Iterable, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import pairs
from ..results import Status
from ..transforms import transform_from_matrix
from .baked_mesh import BakedMesh, baked_of

EXTERNAL = "__external"
"""The name of a mesh that is not in the manager."""


class ContactData:
    """Where two triangles touch."""

    def __init__(self, names: tuple[str, str], faces: tuple[int, int], point: Any, normal: Any, depth: float) -> None:
        self.names = set(names)
        self._faces = dict(zip(names, faces))
        self.point = point
        self.normal = normal
        self.depth = depth

    def index(self, name: str) -> int:
        """Returns the face of the object of a name."""
        return self._faces[name]


class DistanceData:
    """The nearest points of two objects."""

    def __init__(self, names: tuple[str, str], faces: tuple[int, int], points: tuple[Any, Any], distance: float) -> None:
        self.names = set(names)
        self._faces, self._points = dict(zip(names, faces)), dict(zip(names, points))
        self.distance = distance

    def index(self, name: str) -> int:
        """Returns the nearest face of the object of a name."""
        return self._faces[name]

    def point(self, name: str) -> Any:
        """Returns the nearest point of the object of a name, (3,)."""
        return self._points[name]


class _Object(NamedTuple):
    baked: BakedMesh
    matrix: NDArray[np.float64]
    place: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    is_solid: bool

    @staticmethod
    def at(mesh: Any, transform: Optional[ArrayLike]) -> _Object:
        matrix = np.eye(4) if transform is None else np.asanyarray(transform, dtype=np.float64)
        if matrix.shape != (4, 4):
            raise ValueError("transform must be (4,4)!")
        baked = baked_of(mesh)
        place = transform_from_matrix(matrix).astype(np.float64)
        place[4:7] = matrix[:3, 3]
        low, high = baked.bounds()
        middle = matrix[:3, :3] @ ((low + high) / 2) + matrix[:3, 3]
        half = np.abs(matrix[:3, :3]) @ ((high - low) / 2)
        half = half + 1e-5 * (np.abs(middle).max() + half.max())  # more than float32 rounds
        is_solid = bool(getattr(mesh, "is_convex", False)) and baked.blob.is_closed
        return _Object(baked, matrix, place, middle - half, middle + half, is_solid)

    def contains(self, other: _Object) -> bool:
        """Returns whether a point of another object is in this one, which is solid."""
        if not self.is_solid or len(other.baked.faces) == 0:
            return False
        point = other.matrix[:3, :3] @ other.baked.vertices[other.baked.faces[0, 0]] + other.matrix[:3, 3]
        local = np.linalg.solve(self.matrix[:3, :3], point - self.matrix[:3, 3])
        return bool(self.baked.contains(local[np.newaxis])[0])


class _Pair(NamedTuple):
    names: tuple[str, str]
    a: _Object
    b: _Object

    def is_near(self) -> bool:
        return bool((self.a.low <= self.b.high).all() and (self.b.low <= self.a.high).all())

    def collides(self) -> bool:
        if not self.is_near():
            return False
        touch = pairs.overlaps(self.a.baked.blob, self.b.baked.blob, self.a.place, self.b.place)
        return bool(touch.yes) or self.a.contains(self.b) or self.b.contains(self.a)

    def contacts(self) -> list[ContactData]:
        found = pairs.touches(self.a.baked.blob, self.b.baked.blob, self.a.place, self.b.place).items
        return [ContactData(self.names, (int(self.a.baked.face_of[each["a"]]), int(self.b.baked.face_of[each["b"]])),
                            each["points"][: each["count"]].astype(float).mean(axis=0), each["normal"].astype(float),
                            float(each["depth"])) for each in found]

    def distance(self, within: float) -> DistanceData:
        if self.is_near() and (self.a.contains(self.b) or self.b.contains(self.a)):
            return DistanceData(self.names, (-1, -1), (np.full(3, np.nan), np.full(3, np.nan)), 0.0)
        found = pairs.distance(self.a.baked.blob, self.b.baked.blob, self.a.place, self.b.place, within)
        if found["status"] != Status.OK:
            return DistanceData(self.names, (-1, -1), (np.full(3, np.nan), np.full(3, np.nan)), np.inf)
        return DistanceData(self.names, (int(self.a.baked.face_of[found["a"]]), int(self.b.baked.face_of[found["b"]])),
                            (found["on_a"].astype(float), found["on_b"].astype(float)), float(found["distance"]))

    def gap(self) -> float:
        """Returns a distance that the two are apart at least: that of their boxes."""
        apart = np.maximum(np.maximum(self.a.low - self.b.high, self.b.low - self.a.high), 0.0)
        return float(np.linalg.norm(apart))


class CollisionManager:
    """Named meshes, each with a matrix (4, 4) of its place: a rotation, a translation and one scale.

    A mesh is a surface, or a solid where it is convex, as in trimesh. Distances of objects that touch are 0; a contact
    has the depth of two triangles by themselves.
    """

    def __init__(self) -> None:
        self._objs: dict[str, Any] = {}

    def add_object(self, name: str, mesh: Any, transform: Optional[ArrayLike] = None) -> Any:
        """Adds an object, or replaces the one of that name. mesh: one of trimesh, or what bake_trimesh() returned."""
        self._objs[name] = (mesh, _Object.at(mesh, transform))
        return self._objs[name][1]

    def remove_object(self, name: str) -> None:
        """Removes an object. Raises ValueError for a name that there is none of."""
        self._require(name)
        del self._objs[name]

    def set_transform(self, name: str, transform: ArrayLike) -> None:
        """Moves an object to another place. Raises ValueError for a name that there is none of."""
        self._require(name)
        self.add_object(name, self._objs[name][0], transform)

    def in_collision_single(self, mesh: Any, transform: Optional[ArrayLike] = None, return_names: bool = False,
                            return_data: bool = False) -> Any:
        """Returns whether a mesh collides with any object, and if wanted the names of those and all contacts."""
        other = _Object.at(mesh, transform)
        found = _collisions([_Pair((name, EXTERNAL), each, other) for name, each in self._all()], return_names, return_data)
        names = {pair[0] for pair in found[1]}
        return _wanted((found[0], names, found[2]), return_names, return_data)

    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Returns whether any two objects collide, and if wanted their names, each pair sorted, and all contacts."""
        found = _collisions(self._pairs(), return_names, return_data)
        names = {tuple(sorted(pair)) for pair in found[1]}
        return _wanted((found[0], names, found[2]), return_names, return_data)

    def in_collision_other(self, other_manager: CollisionManager, return_names: bool = False,
                           return_data: bool = False) -> Any:
        """Returns whether an object collides with one of another manager, and if wanted their names and all contacts."""
        found = _collisions(self._pairs_with(other_manager), return_names, return_data)
        return _wanted(found, return_names, return_data)

    def min_distance_single(self, mesh: Any, transform: Optional[ArrayLike] = None, return_name: bool = False,
                            return_data: bool = False) -> Any:
        """Returns the distance of a mesh to the nearest object, and if wanted its name and a DistanceData."""
        other = _Object.at(mesh, transform)
        best = _nearest([_Pair((name, EXTERNAL), each, other) for name, each in self._all()])
        return _wanted((best[0], best[1] and best[1][0], best[2]), return_name, return_data)

    def min_distance_internal(self, name: Optional[str] = None, return_names: bool = False,
                              return_data: bool = False) -> Any:
        """Returns the smallest distance of two objects, or of one and all others, and if wanted their names and data."""
        if name is not None:
            self._require(name)
        best = _nearest(pair for pair in self._pairs() if name is None or name in pair.names)
        return _wanted((best[0], best[1] and tuple(sorted(best[1])), best[2]), return_names, return_data)

    def min_distance_other(self, other_manager: CollisionManager, return_names: bool = False,
                           return_data: bool = False) -> Any:
        """Returns the smallest distance of two objects, one of each manager, and if wanted their names and data."""
        return _wanted(_nearest(self._pairs_with(other_manager)), return_names, return_data)

    def _require(self, name: str) -> None:
        if name not in self._objs:
            raise ValueError(f"{name} not in collision manager!")

    def _all(self) -> list[tuple[str, _Object]]:
        return [(name, each[1]) for name, each in self._objs.items()]

    def _pairs(self) -> list[_Pair]:
        return [_Pair((first, second), a, b) for (first, a), (second, b) in combinations(self._all(), 2)]

    def _pairs_with(self, other: CollisionManager) -> list[_Pair]:
        return [_Pair((first, second), a, b) for (first, a), (second, b) in product(self._all(), other._all())]


def _collisions(candidates: Iterable[_Pair], all_names: bool, data: bool) -> tuple[bool, set[Any], list[ContactData]]:
    names, contacts = set(), []
    for pair in candidates:
        if pair.collides():
            names.add(pair.names)
            if not (all_names or data):
                break
            if data:
                contacts += pair.contacts()
    return bool(names), names, contacts


def _nearest(candidates: Iterable[_Pair]) -> tuple[float, Any, Optional[DistanceData]]:
    best: tuple[float, Any, Optional[DistanceData]] = (np.inf, None, None)
    for pair in sorted(candidates, key=_Pair.gap):
        if pair.gap() > best[0]:
            break
        found = pair.distance(best[0])
        if found.distance < best[0]:
            best = (found.distance, pair.names, found)
    return best


def _wanted(results: tuple[Any, Any, Any], names: bool, data: bool) -> Any:
    chosen = (results[0], *([results[1]] if names else []), *([results[2]] if data else []))
    return chosen if len(chosen) > 1 else chosen[0]
