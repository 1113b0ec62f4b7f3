"""The queries of baked and of moving scenes."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .filters import flag_array
from .pictures import Pictures
from .rays import culling_number
from .results import Lists, YesNo
from .shapes import Body, Box, Moving, SceneVolume, split
from .transforms import Origin, in_source, lists_in_source

ALL = 0xFFFFFFFF
"""The mask that shares a bit with that of every instance but 0."""


class SceneQueries(Pictures):
    """Queries of all instances of a scene.

    Shapes and results are in world space. Of a baked scene with an `origin`, and of a view of a moving one (seen_from()),
    places in results are float64, and those in arguments should be: each is rounded once, from the origin. Arguments
    broadcast and results have shapes as those of Blob, with the fields `instance` and `in_tile` more: of a baked scene
    an index into instances(), whose field `source` is the index of the place that bake_scene() took; of a moving one the
    slot.
    mask: instances whose mask shares no bit with it are passed over.
    only: a flag, bool or uint8, for each instance of a baked scene, (instance_count,), or for each slot of a moving
    one, (slot_end,): the query takes those that are not 0 into account, as if there were no others. A tile is one
    instance. None: all. Passing over by mask takes less time. Raises TypeError for numbers of other kinds, ValueError
    for another shape.
    threads: how many to use; 0 is one per processor. The results do not depend on it.
    """

    __slots__ = ()
    _core: Union[_core.Scene, _core.MovingScene]
    _origin: Origin = None

    def _flags(self, only: Optional[ArrayLike]) -> Optional[NDArray[np.uint8]]:
        raise NotImplementedError

    def raycast(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                culling: str = "none", mask: int = ALL, only: Optional[ArrayLike] = None,
                threads: int = 1) -> NDArray[Any]:
        """Returns the closest hit of each ray: an array of SCENE_RAY_HIT.

        mask: 32 bits; instances whose mask shares no bit with it are passed over. only: a flag for each instance of a
        baked scene, (instance_count,), or for each slot of a moving one, (slot_end,).
        """
        rays = (origins, directions, t_min, t_max)
        return _core.scene_raycasts(self._core, rays, culling_number(culling), mask, self._flags(only), threads)

    def occluded(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", mask: int = ALL, only: Optional[ArrayLike] = None, threads: int = 1) -> YesNo:
        """Returns whether each ray hits any triangle."""
        rays = (origins, directions, t_min, t_max)
        flags = self._flags(only)
        return YesNo(_core.scene_occlusions(self._core, rays, culling_number(culling), mask, flags, threads))

    def all_hits(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", mask: int = ALL, only: Optional[ArrayLike] = None, threads: int = 1) -> Lists:
        """Returns all hits of each ray, ascending by instance, then triangle: lists of SCENE_RAY_HIT."""
        rays = (origins, directions, t_min, t_max)
        flags = self._flags(only)
        return Lists(*_core.scene_hit_lists(self._core, rays, culling_number(culling), mask, flags, threads))

    def closest_point(self, points: ArrayLike, max_distance: ArrayLike = np.inf, *, mask: int = ALL,
                      threads: int = 1) -> NDArray[Any]:
        """Returns the closest point of any surface to each point: an array of SCENE_CLOSEST_POINT."""
        return in_source(_core.scene_closest_points(self._core, points, max_distance, mask, threads), self._origin)

    def sweep(self, shape: Moving, displacement: ArrayLike, *, culling: str = "none", ignore_leaving: bool = False,
              skin: float = 0.0, mask: int = ALL, only: Optional[ArrayLike] = None, threads: int = 1) -> NDArray[Any]:
        """Returns the first contact of each shape as it moves by a displacement: an array of SCENE_SWEEP_HIT.

        Options are those of Blob.sweep(), with the skin in world units.
        """
        options = (culling_number(culling), ignore_leaving, skin)
        hits = _core.scene_sweeps(self._core, *split(shape, Moving, "sweep()"), displacement, options, mask,
                                  self._flags(only), threads)
        return in_source(hits, self._origin)

    def candidates(self, box: Box, *, mask: int = ALL, threads: int = 1) -> Lists:
        """Returns the instances whose boxes in the tree touch each box, for queries of your own: lists of CANDIDATE.

        These boxes are larger than their instances. Ascending by instance; of a tile each instance in it.
        """
        return Lists(*_core.scene_candidate_lists(self._core, split(box, Box, "candidates()")[1], mask, threads))

    def contacts(self, shape: Body, margin: ArrayLike = 0.0, *, most: int = 16, mask: int = ALL,
                 only: Optional[ArrayLike] = None, threads: int = 1) -> Lists:
        """Returns the contacts of each body with all instances, the deepest first: lists of SCENE_CONTACT.

        They are those of Blob.contacts() with each instance by itself. margin: (...), 0 or more, in world units. Of
        more contacts than `most` the deepest are kept, with the status OUTPUT_FULL.
        """
        kind, fields = split(shape, Body, "contacts()")
        flags = self._flags(only)
        contacts = _core.scene_contact_lists(self._core, kind, fields, margin, most, mask, flags, threads)
        return lists_in_source(Lists(*contacts), self._origin)

    def overlaps(self, shape: SceneVolume, *, mask: int = ALL, only: Optional[ArrayLike] = None,
                 threads: int = 1) -> YesNo:
        """Returns whether any triangle touches each shape."""
        kind, fields = split(shape, SceneVolume, "overlaps() of a scene")
        return YesNo(_core.scene_touching(self._core, kind, fields, mask, self._flags(only), threads))

    def overlapping_triangles(self, shape: SceneVolume, *, mask: int = ALL, only: Optional[ArrayLike] = None,
                              threads: int = 1) -> Lists:
        """Returns the triangles that touch each shape, ascending by instance: lists of SCENE_TRIANGLE."""
        kind, fields = split(shape, SceneVolume, "overlapping_triangles() of a scene")
        return Lists(*_core.scene_touching_lists(self._core, kind, fields, mask, self._flags(only), threads))
