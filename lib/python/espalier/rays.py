"""Rays against one blob."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .filters import flag_array
from .transforms import Origin, in_source
from .results import Lists, SourceHits, YesNo

CULLING = {"none": 0, "back": 1, "front": 2}
_ALL_HITS, _CROSSINGS, _FIRST_HITS = 0, 1, 2


def culling_number(culling: str) -> int:
    """Returns the library's number of "none", "back" or "front"."""
    try:
        return CULLING[culling]
    except KeyError:
        raise ValueError(f"culling must be 'none', 'back' or 'front', not {culling!r}") from None


class RayQueries:
    """Queries of rays: the points origin + t * direction with t_min <= t <= t_max.

    origins, directions: (..., 3), in the units and the coordinates of the source, of which float64 is not rounded before
    the blob's `origin` was subtracted; a direction has any length but zero, and t counts in multiples of it. t_min, t_max: (...). All broadcast against each other; the results have their common shape.
    culling: "back" or "front" ignores the triangles that show this side.
    only: a flag, bool or uint8, for each triangle, (triangle_count,): the query takes those that are not 0 into
    account, as if the blob held no others. None: all. Raises TypeError for numbers of other kinds, ValueError for
    another shape.
    threads: how many to use; 0 is one per processor. The results do not depend on it.
    """

    __slots__ = ()
    _core: _core.Blob
    _origin: Origin
    triangle_count: int

    def raycast(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                culling: str = "none", only: Optional[ArrayLike] = None, threads: int = 1) -> NDArray[Any]:
        """Returns the closest hit of each ray: an array of RAY_HIT.

        Of equal t, the lowest triangle. A miss has the status NOT_FOUND, an infinite t and NO_TRIANGLE; so has a
        refusal, with its status.
        """
        return _core.raycasts(self._core, origins, directions, t_min, t_max, culling_number(culling),
                              self._flags(only), threads)

    def raycast_sources(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0,
                        t_max: ArrayLike = np.inf, culling: str = "none", only: Optional[ArrayLike] = None,
                        threads: int = 1) -> SourceHits:
        """Returns what raycast() returns, with the places in float64 and the sources of original_hits(), at once."""
        hits, points, sources = _core.raycast_sources(self._core, origins, directions, t_min, t_max,
                                                      culling_number(culling), self._flags(only), threads)
        return SourceHits(hits, in_source(points, self._origin), sources)

    def occluded(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", only: Optional[ArrayLike] = None, accuracy: Optional[float] = None,
                 threads: int = 1) -> YesNo:
        """Returns whether each ray hits any triangle. Takes less time than raycast().

        accuracy: a length in the blob's units. With one, a no is certain and a yes may be off by about as much, for
        less work; it takes no `only`.
        """
        if accuracy is not None:
            if only is not None:
                raise ValueError("a ray with an accuracy takes no filter: `only` must be None")
            return YesNo(_core.nearly_occluded(self._core, origins, directions, t_min, t_max, culling_number(culling),
                                               accuracy, threads))
        return YesNo(_core.occlusions(self._core, origins, directions, t_min, t_max, culling_number(culling),
                                      self._flags(only), threads))

    def closest_hits(self, origins: ArrayLike, directions: ArrayLike, most: int, *, t_min: ArrayLike = 0.0,
                     t_max: ArrayLike = np.inf, culling: str = "none", only: Optional[ArrayLike] = None,
                     threads: int = 1) -> Lists:
        """Returns the first hits of each ray, at most `most`, sorted by t: lists of RAY_HIT.

        The status is OUTPUT_FULL where there are more.
        """
        return self._lists(_FIRST_HITS, origins, directions, t_min, t_max, culling, threads, most, self._flags(only))

    def all_hits(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0, t_max: ArrayLike = np.inf,
                 culling: str = "none", threads: int = 1) -> Lists:
        """Returns all hits of each ray, in ascending order of triangles and not of t: lists of RAY_HIT."""
        return self._lists(_ALL_HITS, origins, directions, t_min, t_max, culling, threads, 0)

    def crossings(self, origins: ArrayLike, directions: ArrayLike, *, t_min: ArrayLike = 0.0,
                  t_max: ArrayLike = np.inf, culling: str = "none", threads: int = 1) -> Lists:
        """Returns each crossing of the surface once, for counting, parity and thickness: lists of RAY_HIT.

        A shared edge or vertex that a ray meets exactly is one crossing, or as many as the surface has there.
        """
        return self._lists(_CROSSINGS, origins, directions, t_min, t_max, culling, threads, 0)

    def _lists(self, kind: int, origins: ArrayLike, directions: ArrayLike, t_min: ArrayLike, t_max: ArrayLike,
               culling: str, threads: int, most: int, flags: Optional[NDArray[np.uint8]] = None) -> Lists:
        return Lists(*_core.hit_lists(self._core, origins, directions, t_min, t_max, culling_number(culling), flags,
                                      threads, kind, most))

    def _flags(self, only: Optional[ArrayLike]) -> Optional[NDArray[np.uint8]]:
        return flag_array(only, self.triangle_count, "triangles")
