"""Queries of two blobs, each at one place in the world or at many.

place_a, place_b: (..., 8), as transform() and transform_from_matrix() return them; by default the origin. They
broadcast against each other, and the results have their common shape. Results are in world space.
A place moves the coordinates of a blob's source, so that two blobs are by default where their sources lie. Where either
blob has an `origin`, places of float64 are not rounded before both were moved near 0 together, and those in results are
float64.
work_limit: the number of pairs of nodes or leaves that each query may visit; None is unlimited. Give one for meshes
that you did not make yourself: a query that reaches it has the status WORK_LIMIT.
threads: how many to use; 0 is one per processor. The results do not depend on it.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .blob import Blob
from .transforms import Origin, in_source, lists_in_source, source_type, transforms_from_origin
from .results import CONTACT, Lists, YesNo

ORIGIN = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
"""The transform that leaves every point where it is."""


def _visits(work_limit: Optional[int]) -> int:
    if work_limit is None:
        return 0xFFFFFFFFFFFFFFFF
    if work_limit < 0:
        raise ValueError("work_limit must be 0 or more")
    return work_limit


class _Placed(NamedTuple):
    """Two blobs as the library takes them."""

    pair: tuple[_core.Blob, _core.Blob, ArrayLike, ArrayLike]
    world: Origin
    """Where 0 0 0 of the world of results is."""

    def in_world(self, results: NDArray[Any]) -> NDArray[Any]:
        if self.world is None:
            return results
        return in_source(results, np.broadcast_to(self.world, (*results.shape, 3)))

    def lists_in_world(self, lists: Lists) -> Lists:
        if self.world is None:
            return lists
        world = np.broadcast_to(self.world, (*lists.status.shape, 3)).reshape(-1, 3)
        return lists_in_source(lists, world[lists.queries()])


def _placed(a: Blob, b: Blob, place_a: ArrayLike, place_b: ArrayLike) -> _Placed:
    for blob in (a, b):
        if not isinstance(blob, Blob):
            raise TypeError(f"espalier.pairs takes two blobs, not a {type(blob).__name__}; `scene.mesh(i)` is one")
    as_given = _Placed((a._core, b._core, place_a, place_b), None)
    if a._origin is None and b._origin is None:
        return as_given
    given = (np.asarray(place_a), np.asarray(place_b))
    if any(place.shape[-1:] != (8,) or place.dtype.kind not in "iuf" for place in given):
        return as_given  # the library refuses them
    moved = (transforms_from_origin(place, blob._origin) for place, blob in zip(given, (a, b)))
    at_a, at_b = np.broadcast_arrays(*moved)
    world = at_a[..., 4:7]
    way = np.zeros_like(at_a)
    way[..., 4:7] = world
    with np.errstate(invalid="ignore"):
        return _Placed((a._core, b._core, at_a - way, at_b - way), world)


def overlaps(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
             work_limit: Optional[int] = None, threads: int = 1) -> YesNo:
    """Returns whether a triangle of a touches one of b. A surface inside another one does not touch it."""
    return YesNo(_core.pairs_touch(*_placed(a, b, place_a, place_b).pair, _visits(work_limit), threads))


def first_contact(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
                  work_limit: Optional[int] = None, threads: int = 1) -> NDArray[Any]:
    """Returns a pair of triangles that touch: an array of PAIR_CONTACT."""
    return _core.pairs_first_contact(*_placed(a, b, place_a, place_b).pair, _visits(work_limit), threads)


def contacts(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
             work_limit: Optional[int] = None, threads: int = 1) -> Lists:
    """Returns all pairs of triangles that touch: lists of PAIR_CONTACT."""
    return Lists(*_core.pairs_contact_lists(*_placed(a, b, place_a, place_b).pair, _visits(work_limit), threads))


def touches(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
            work_limit: Optional[int] = None, threads: int = 1) -> Lists:
    """Returns where, how deep and in which direction each pair of triangles of contacts() touches: lists of PAIR_TOUCH.

    b leaves the triangle of a when it moves by `depth` along `normal`: the shortest way out of these two alone.
    """
    placed = _placed(a, b, place_a, place_b)
    return placed.lists_in_world(Lists(*_core.pairs_touch_lists(*placed.pair, _visits(work_limit), threads)))


def touch_contacts(touches: Lists) -> Lists:
    """Returns the points of touches() as contacts of body b with the surface a, for reduce_contacts(): lists of CONTACT."""
    given = touches.items
    owner, number = np.nonzero(np.arange(given["points"].shape[-2]) < given["count"][:, np.newaxis])
    is_wide = given["points"].dtype == np.float64  # of a blob with an origin
    contacts = np.zeros(len(owner), source_type(CONTACT) if is_wide else CONTACT)
    contacts["point"], contacts["normal"] = given["points"][owner, number], given["normal"][owner]
    contacts["distance"], contacts["triangle"] = -given["depth"][owner], given["a"][owner]
    before = np.concatenate([[0], np.cumsum(given["count"], dtype=np.intp)])
    return Lists(before[touches.offsets], contacts, touches.status)


def distance(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN,
             max_distance: ArrayLike = np.inf, *, work_limit: Optional[int] = None, threads: int = 1) -> NDArray[Any]:
    """Returns the smallest distance of the surfaces within max_distance, and where: an array of BLOB_DISTANCE.

    After WORK_LIMIT the distance is an upper bound.
    """
    placed = _placed(a, b, place_a, place_b)
    return placed.in_world(_core.pairs_distance(*placed.pair, max_distance, _visits(work_limit), threads))


def within_distance(a: Blob, b: Blob, distance: ArrayLike, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
                    work_limit: Optional[int] = None, threads: int = 1) -> YesNo:
    """Returns whether the surfaces are within a distance of each other. Takes less time than distance()."""
    return YesNo(_core.pairs_within(*_placed(a, b, place_a, place_b).pair, distance, _visits(work_limit), threads))
