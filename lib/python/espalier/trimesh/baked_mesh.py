"""A mesh of trimesh with its blob."""

from __future__ import annotations

import weakref
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..baking import bake
from ..blob import Blob

BITS = 22
"""Of the largest extent: fine enough for float64 to take over, with room to query from 16,384 times as far."""


class BakedMesh:
    """A mesh and its blob, whose queries take float64 in the coordinates of the mesh."""

    def __init__(self, mesh: Any, blob: Blob) -> None:
        self.mesh = mesh
        self.blob = blob
        self.origin = blob.origin
        self.faces = np.asarray(mesh.faces).reshape(-1, 3)
        self.vertices = np.asarray(mesh.vertices, np.float64).reshape(-1, 3)
        remap = blob.remap
        assert remap is not None  # bake() has returned one
        self.face_of = remap["triangle"].astype(np.int64)
        self.error = blob.max_error
        """How far the baked surface is from the mesh at most."""

    def corners(self, faces: NDArray[np.int64]) -> NDArray[np.float64]:
        """Returns the corners of faces of the mesh, (n, 3, 3)."""
        return self.vertices[self.faces[faces]]

    def bounds(self) -> NDArray[np.float64]:
        """Returns a box around the blob, (2, 3)."""
        return self.blob.bounds.astype(np.float64)

    def contains(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Returns whether points are inside: of an open surface, whether it winds around them by more than a half."""
        low, high = self.bounds() + np.array([[-1.0], [1.0]]) * self.error
        inside = ((points >= low) & (points <= high)).all(axis=1)
        near = points[inside]
        if self.blob.is_closed:
            inside[inside] = self.blob.contains(near).yes
        else:
            winding = self.blob.winding_number(near)
            inside[inside] = (winding["status"] == 0) & (winding["value"] > 0.5)
        return inside


def bake_trimesh(mesh: Any, *, origin: Union[str, ArrayLike, None] = None, **options: Any) -> BakedMesh:
    """Bakes a mesh with `vertices` and `faces`.

    origin: as that of espalier.bake(), but by default the middle of the mesh. Other options are those of
    espalier.bake(). Faces that no surface has, of NaN or of no area, are left out.
    """
    vertices = np.asarray(mesh.vertices, np.float64).reshape(-1, 3)
    faces = np.asarray(mesh.faces).reshape(-1, 3)
    if origin is None:
        used = vertices[faces.reshape(-1)] if len(faces) else np.zeros((1, 3))
        used = used[np.isfinite(used).all(axis=1)]
        origin = (used.min(axis=0) + used.max(axis=0)) / 2 if len(used) else np.zeros(3)
    if not {"bits", "tolerance", "step_exponent"} & set(options):
        options["bits"] = BITS
    return BakedMesh(mesh, _quietly(vertices, faces, {"drop_bad_triangles": True, **options, "origin": origin}))


def _quietly(vertices: NDArray[np.float64], faces: NDArray[Any], options: dict[str, Any]) -> Blob:
    # What the bake warns of, open surfaces and faces without area, is usual in meshes of trimesh, and allowed here.
    import warnings

    from ..baking import BakeWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", BakeWarning)
        return bake(vertices, faces, **options)


class _Kept(NamedTuple):
    content: int
    baked: BakedMesh


_kept: dict[int, _Kept] = {}


def baked_of(mesh: Any) -> BakedMesh:
    """Returns a mesh with its blob, which all queries of the mesh share until it is changed or goes."""
    if isinstance(mesh, BakedMesh):
        return mesh
    if not _can_be_shared(mesh):
        return bake_trimesh(mesh)
    key, content = id(mesh), hash(mesh) if type(mesh).__hash__ is not None else 0
    found = _kept.get(key)
    if found is None:
        weakref.finalize(mesh, lambda: _kept.pop(key, None))
    if found is None or found.content != content:
        found = _kept[key] = _Kept(content, _without_cycle(bake_trimesh(mesh), mesh))
    return found.baked


def lasting(mesh: Any) -> Any:
    """Returns what an object that queries a mesh keeps: the mesh or, where that cannot be shared, its bake."""
    return mesh if isinstance(mesh, BakedMesh) or _can_be_shared(mesh) else bake_trimesh(mesh)


def _can_be_shared(mesh: Any) -> bool:
    try:
        weakref.ref(mesh)
    except TypeError:
        return False
    return True


def _without_cycle(baked: BakedMesh, mesh: Any) -> BakedMesh:
    baked.mesh = weakref.proxy(mesh)  # what is kept must not keep the mesh
    return baked


def checked_points(points: ArrayLike, name: str) -> NDArray[np.float64]:
    """Returns points or directions as (n, 3). Raises ValueError for other shapes."""
    array = np.asanyarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must be (n,3)!")
    return array
