"""Scenes: many instances of blobs, each with a place in the world, in one file."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .baked import Baked, bytes_of
from .blob import Blob
from .errors import BakeError, OpenError
from .rays import culling_number
from .results import Lists, YesNo
from .shapes import Moving, Volume, split

ALL = 0xFFFFFFFF
"""The mask that shares a bit with that of every instance but 0."""


class Scene(Baked):
    """A baked scene. bake_scene() and open_scene() return one.

    Shapes and results are in world space. Arguments broadcast and results have shapes as those of Blob, with the
    fields `instance` and `in_tile` more. mask: instances whose mask shares no bit with it are passed over.
    """

    __slots__ = ()

    @property
    def instance_count(self) -> int:
        """The number of instances."""
        return int(self._facts["instance_count"])

    @property
    def mesh_count(self) -> int:
        """The number of meshes, without those of tiles."""
        return int(self._facts["mesh_count"])

    def instances(self) -> NDArray[Any]:
        """Returns all instances: an array of INSTANCE."""
        return self._core.instances()

    def mesh(self, mesh: int) -> Blob:
        """Returns a mesh, whose bytes are those of the scene."""
        return Blob(self._core.mesh(mesh))

    def raycast(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                culling: str = "none", mask: int = ALL, threads: int = 1) -> NDArray[Any]:
        """Returns the closest hit of each ray: an array of SCENE_RAY_HIT."""
        rays = (origins, directions, t_min, t_max)
        return _core.scene_raycasts(self._core, rays, culling_number(culling), mask, threads)

    def occluded(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", mask: int = ALL, threads: int = 1) -> YesNo:
        """Returns whether each ray hits any triangle."""
        rays = (origins, directions, t_min, t_max)
        return YesNo(_core.scene_occlusions(self._core, rays, culling_number(culling), mask, threads))

    def all_hits(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", mask: int = ALL, threads: int = 1) -> Lists:
        """Returns all hits of each ray, ascending by instance, then triangle: lists of SCENE_RAY_HIT."""
        rays = (origins, directions, t_min, t_max)
        return Lists(*_core.scene_hit_lists(self._core, rays, culling_number(culling), mask, threads))

    def closest_point(self, points: ArrayLike, max_distance: ArrayLike = np.inf, *, mask: int = ALL,
                      threads: int = 1) -> NDArray[Any]:
        """Returns the closest point of any surface to each point: an array of SCENE_CLOSEST_POINT."""
        return _core.scene_closest_points(self._core, points, max_distance, mask, threads)

    def sweep(self, shape: Moving, displacement: ArrayLike, *, culling: str = "none", ignore_leaving: bool = False,
              skin: float = 0.0, mask: int = ALL, threads: int = 1) -> NDArray[Any]:
        """Returns the first contact of each shape as it moves by a displacement: an array of SCENE_SWEEP_HIT.

        Options are those of Blob.sweep(), with the skin in world units.
        """
        options = (culling_number(culling), ignore_leaving, skin)
        return _core.scene_sweeps(self._core, *split(shape), displacement, options, mask, threads)

    def overlaps(self, shape: Volume, *, mask: int = ALL, threads: int = 1) -> YesNo:
        """Returns whether any triangle touches each shape. Takes no ConvexVolume."""
        return YesNo(_core.scene_touching(self._core, *split(shape), mask, threads))

    def overlapping_triangles(self, shape: Volume, *, mask: int = ALL, threads: int = 1) -> Lists:
        """Returns the triangles that touch each shape: lists of SCENE_TRIANGLE. Takes no ConvexVolume."""
        return Lists(*_core.scene_touching_lists(self._core, *split(shape), mask, threads))

    def __reduce__(self) -> Any:
        return open_scene, (bytes(self),)

    def __repr__(self) -> str:
        return f"<espalier.Scene of {self.instance_count} instances of {self.mesh_count} meshes>"


def open_scene(source: Any) -> Scene:
    """Opens a baked scene, as open_blob() opens a blob."""
    opened = _core.open_scene(bytes_of(source))
    if isinstance(opened, int):
        raise OpenError(opened)
    return Scene(opened)


def bake_scene(blobs: Sequence[Any], places: ArrayLike, meshes: ArrayLike = 0, *, masks: Optional[ArrayLike] = None,
               users: Optional[ArrayLike] = None) -> Scene:
    """Joins blobs and instances in one scene.

    blobs: Blob objects, scenes, which become tiles, or objects with bytes.
    places: (n, 8), the transform of each instance. meshes: (n,), the number of its blob. masks, users: (n,), 32 bits
    for queries and for the caller. Raises BakeError with the reason.
    """
    rows = np.asarray(places, np.float32)
    if rows.shape[-1:] != (8,) or rows.ndim > 2:
        raise ValueError(f"places must have the shape (n, 8), not {rows.shape}")
    rows = rows.reshape(-1, 8)
    numbers = np.empty((len(rows), 3), np.uint32)
    for column, values in enumerate((meshes, ALL if masks is None else masks, 0 if users is None else users)):
        array = np.asarray(values)
        if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
            raise ValueError("meshes, masks and users must be integers from 0 to 4294967295")
        numbers[:, column] = array
    cores = [blob._core if isinstance(blob, (Blob, Scene)) else blob for blob in blobs]
    baked = _core.bake_scene(cores, rows, numbers)
    if isinstance(baked, tuple):
        raise BakeError(*baked)
    if isinstance(baked, int):
        raise OpenError(baked)
    return Scene(baked)
