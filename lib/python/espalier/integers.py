"""Integers as the library takes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

LARGEST = 0xFFFFFFFF


def integer_array(numbers: ArrayLike, name: str) -> Any:
    """Returns integers as uint32, in their shape; those that uint32 does not hold become the largest one.

    uint16 stays as it is. Raises TypeError, which names the argument, for numbers of other kinds.
    """
    array = np.asarray(numbers)
    if array.size == 0:
        return np.zeros(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.dtype in (np.uint32, np.uint16):
        return array
    wide = array if array.dtype.itemsize == 8 else array.astype(np.int64)
    return np.where((wide < 0) | (wide > LARGEST), LARGEST, wide).astype(np.uint32)


def triangle_numbers(triangles: ArrayLike) -> NDArray[np.uint32]:
    """Returns numbers of triangles as the library takes them: those that no blob can have become NO_TRIANGLE."""
    array = integer_array(triangles, "numbers of triangles")
    return np.ascontiguousarray(array, np.uint32).reshape(array.shape)
