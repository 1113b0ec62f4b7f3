"""Bounds of a whole blob that are tighter than its box, for blobs that were baked with `bounds`."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .transforms import Origin, in_source
from .results import Status
from .shapes import OrientedBox, Sphere


class Slabs(NamedTuple):
    """Slabs along 13 fixed directions: low <= directions @ corner <= high for each corner."""

    directions: NDArray[np.float32]
    """(13, 3)"""
    low: NDArray[Any]
    """(13,)"""
    high: NDArray[Any]
    """(13,)"""


class StoredBounds:
    """Bounds that the bake stored. Raises ValueError for a blob that was baked without `bounds`.

    Places are in the coordinates of the source, of a blob with an `origin` as float64.
    """

    __slots__ = ()
    _core: _core.Blob
    _origin: Origin

    def bounding_sphere(self) -> Sphere:
        """Returns a sphere close to the smallest one that holds all triangles."""
        center, radius = _floats(*_core.bounding_sphere(self._core))
        return Sphere(in_source(center, self._origin), radius)

    def oriented_bounds(self) -> OrientedBox:
        """Returns a box of little surface, in any orientation, that holds all triangles."""
        center, half_axes = _floats(*_core.oriented_bounds(self._core))
        return OrientedBox(in_source(center, self._origin), half_axes)

    def k_dop_bounds(self) -> Slabs:
        """Returns the slabs that hold all triangles."""
        directions, low, high = _floats(*_core.k_dop_bounds(self._core))
        if self._origin is None:
            return Slabs(directions, low, high)
        along = directions @ self._origin
        return Slabs(directions, low + along, high + along)


def _floats(status: int, fields: tuple[Any, ...]) -> list[NDArray[np.float32]]:
    if status == Status.NO_DATA:
        raise ValueError("the blob was baked without bounds=True")
    return [np.array(field, np.float32) for field in fields]
