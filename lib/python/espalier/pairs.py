"""Queries of two blobs, each at one place in the world or at many.

place_a, place_b: (..., 8), as transform() and transform_from_matrix() return them; by default the origin. They
broadcast against each other, and the results have their common shape. Results are in world space.
work_limit: the number of pairs of nodes or leaves that each query may visit; None is unlimited. Give one for meshes
that you did not make yourself: a query that reaches it has the status WORK_LIMIT.
threads: how many to use; 0 is one per processor. The results do not depend on it.
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .blob import Blob
from .results import CONTACT, Lists, YesNo

ORIGIN = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
"""The transform that leaves every point where it is."""


def _visits(work_limit: Optional[int]) -> int:
    if work_limit is None:
        return 0xFFFFFFFFFFFFFFFF
    if work_limit < 0:
        raise ValueError("work_limit must be 0 or more")
    return work_limit


def overlaps(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
             work_limit: Optional[int] = None, threads: int = 1) -> YesNo:
    """Returns whether a triangle of a touches one of b. A surface inside another one does not touch it."""
    return YesNo(_core.pairs_touch(a._core, b._core, place_a, place_b, _visits(work_limit), threads))


def first_contact(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
                  work_limit: Optional[int] = None, threads: int = 1) -> NDArray[Any]:
    """Returns a pair of triangles that touch: an array of PAIR_CONTACT."""
    return _core.pairs_first_contact(a._core, b._core, place_a, place_b, _visits(work_limit), threads)


def contacts(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
             work_limit: Optional[int] = None, threads: int = 1) -> Lists:
    """Returns all pairs of triangles that touch: lists of PAIR_CONTACT."""
    return Lists(*_core.pairs_contact_lists(a._core, b._core, place_a, place_b, _visits(work_limit), threads))


def touches(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
            work_limit: Optional[int] = None, threads: int = 1) -> Lists:
    """Returns where, how deep and in which direction each pair of triangles of contacts() touches: lists of PAIR_TOUCH.

    b leaves the triangle of a when it moves by `depth` along `normal`: the shortest way out of these two alone.
    """
    return Lists(*_core.pairs_touch_lists(a._core, b._core, place_a, place_b, _visits(work_limit), threads))


def touch_contacts(touches: Lists) -> Lists:
    """Returns the points of touches() as contacts of body b with the surface a, for reduce_contacts(): lists of CONTACT."""
    given = touches.items
    owner, number = np.nonzero(np.arange(given["points"].shape[-2]) < given["count"][:, np.newaxis])
    contacts = np.zeros(len(owner), CONTACT)
    contacts["point"], contacts["normal"] = given["points"][owner, number], given["normal"][owner]
    contacts["distance"], contacts["triangle"] = -given["depth"][owner], given["a"][owner]
    before = np.concatenate([[0], np.cumsum(given["count"], dtype=np.intp)])
    return Lists(before[touches.offsets], contacts, touches.status)


def distance(a: Blob, b: Blob, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN,
             max_distance: ArrayLike = np.inf, *, work_limit: Optional[int] = None, threads: int = 1) -> NDArray[Any]:
    """Returns the smallest distance of the surfaces within max_distance, and where: an array of BLOB_DISTANCE.

    After WORK_LIMIT the distance is an upper bound.
    """
    return _core.pairs_distance(a._core, b._core, place_a, place_b, max_distance, _visits(work_limit), threads)


def within_distance(a: Blob, b: Blob, distance: ArrayLike, place_a: ArrayLike = ORIGIN, place_b: ArrayLike = ORIGIN, *,
                    work_limit: Optional[int] = None, threads: int = 1) -> YesNo:
    """Returns whether the surfaces are within a distance of each other. Takes less time than distance()."""
    return YesNo(_core.pairs_within(a._core, b._core, place_a, place_b, distance, _visits(work_limit), threads))
