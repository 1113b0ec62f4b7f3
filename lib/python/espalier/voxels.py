"""Voxels: which cubes of a grid a blob fills."""

from __future__ import annotations

from typing import NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .blob import Blob
from .shapes import Box

MOST_VOXELS = 1 << 30


class VoxelGrid(NamedTuple):
    """Cubes in a row along each axis."""

    filled: NDArray[np.bool_]
    """(x, y, z): whether the cube touches the surface or has its middle inside."""
    on_surface: NDArray[np.bool_]
    """(x, y, z): whether the cube touches the surface."""
    origin: NDArray[np.float64]
    """(3,): the lower corner of the first cube"""
    pitch: float
    """The length of an edge of a cube"""

    def centers(self) -> NDArray[np.float64]:
        """Returns the middles of all cubes, (x, y, z, 3)."""
        return _centers(self.origin, self.pitch, self.filled.shape)


def voxel_grid(blob: Blob, pitch: float, bounds: Optional[ArrayLike] = None, *, threads: int = 0) -> VoxelGrid:
    """Returns the cubes of a grid that a blob fills.

    pitch: the length of an edge. bounds: (2, 3), what the grid covers; by default the bounds of the blob, and then the
    grid is centered on them. Inside is where contains() is a yes or, of an open surface, where winding_number() is above
    0.5. A query for each cube: O(cubes * log n).

    Raises ValueError for a pitch that is not above 0, and for a grid of more than 2^30 cubes.
    """
    low, high = np.asarray(blob.bounds if bounds is None else bounds, np.float64)
    if not (pitch > 0.0 and np.isfinite([low, high]).all() and (low <= high).all()):
        raise ValueError("pitch must be above 0, and bounds finite, the lower corner first")
    counts = np.maximum(np.ceil((high - low) / pitch * (1 - 2.0**-40)), 1)
    if np.prod(counts) > MOST_VOXELS:
        raise ValueError(f"{np.prod(counts):.3g} cubes are too many: give a larger pitch")
    origin = (low + high) / 2 - counts * pitch / 2 if bounds is None else low
    shape = tuple(int(count) for count in counts)
    on_surface, inside = np.zeros(shape, bool), np.zeros(shape, bool)
    for x in range(shape[0]):  # a slice at a time, for memory
        middles = _centers(origin + [x * pitch, 0.0, 0.0], pitch, (1, *shape[1:]))[0]
        on_surface[x] = blob.overlaps(Box(middles - pitch / 2, middles + pitch / 2), threads=threads).yes
        if blob.is_closed:
            inside[x] = blob.contains(middles, threads=threads).yes
        else:
            winding = blob.winding_number(middles, threads=threads)
            inside[x] = (winding["status"] == 0) & (winding["value"] > 0.5)
    return VoxelGrid(on_surface | inside, on_surface, origin, float(pitch))


def _centers(origin: NDArray[np.float64], pitch: float, shape: tuple[int, ...]) -> NDArray[np.float64]:
    numbers = np.stack(np.meshgrid(*(np.arange(count) for count in shape), indexing="ij"), axis=-1)
    centers: NDArray[np.float64] = origin + (numbers + 0.5) * pitch
    return centers
