"""Filters: which triangles or instances count, as an array of flags."""

from __future__ import annotations

from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray


def flag_array(only: Optional[ArrayLike], count: int, name: str) -> Optional[NDArray[np.uint8]]:
    """Returns flags as the library takes them, one for each of the `count` triangles, instances or slots; None for all.

    Raises TypeError for numbers of other kinds, such as those of triangles, and ValueError for another shape.
    """
    if only is None:
        return None
    array = np.asarray(only)
    if array.dtype not in (np.bool_, np.uint8):
        remedy = ("; of 0 and 1: np.asarray(only, bool)" if array.shape == (count,) else
                  f"; from numbers: flags = np.zeros({count}, bool); flags[numbers] = True")
        raise TypeError(f"only must be flags, an array of bool or uint8, not {array.dtype}"
                        + (remedy if array.dtype.kind in "iu" else ""))
    if array.shape != (count,):
        raise ValueError(f"only must have a flag for each of the {count} {name}, the shape ({count},), "
                         f"not {array.shape}")
    return np.ascontiguousarray(array).view(np.uint8)
