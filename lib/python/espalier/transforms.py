"""Places of blobs in a world: a rotation, a translation and a uniform scale, as rows of eight float32.

The eight numbers are a quaternion x, y, z, w of any length but zero, a translation x, y, z, and a scale above 0.
Also places in the coordinates of a blob's source: those of the blob count from its origin, which float32 may not hold.
"""

from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _core
from .results import Lists, Status


def transform(rotation: ArrayLike = (0.0, 0.0, 0.0, 1.0), translation: ArrayLike = (0.0, 0.0, 0.0),
              scale: ArrayLike = 1.0, dtype: DTypeLike = np.float32) -> NDArray[Any]:
    """Returns transforms, (..., 8), from quaternions x, y, z, w (..., 4), translations (..., 3) and scales (...).

    Rounded to float32; with dtype=np.float64 places far from 0 stay what they are, for the calls that take them so.
    """
    parts = (np.asarray(rotation, dtype), np.asarray(translation, dtype), np.asarray(scale, dtype)[..., np.newaxis])
    if parts[0].shape[-1:] != (4,) or parts[1].shape[-1:] != (3,):
        raise ValueError("rotation must have the shape (..., 4), translation (..., 3)")
    shape = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
    return np.concatenate([np.broadcast_to(part, (*shape, part.shape[-1])) for part in parts], axis=-1)


def transform_from_matrix(matrix: ArrayLike) -> NDArray[np.float32]:
    """Returns transforms, (..., 8), of affine matrices in rows, (..., 4, 4) or (..., 3, 4).

    Raises ValueError for a mirror, shear, unequal scale, a number that is not finite, or a fourth row that is not
    0, 0, 0, 1.
    """
    rows, status = _core.transforms_from_matrices(matrix)
    refused = np.argwhere(status != Status.OK)
    if len(refused):
        first = tuple(int(index) for index in refused[0])
        with np.errstate(over="ignore"):
            reason = _why_no_transform(np.asarray(matrix).astype(np.float32)[first].astype(np.float64))
        raise ValueError(f"matrix {first if first else ''} is no transform: {reason}".replace("  ", " "))
    return rows


def _why_no_transform(matrix: NDArray[np.float64]) -> str:
    if not np.isfinite(matrix).all():
        return "a number is not finite"
    if len(matrix) == 4 and (matrix[3] != (0.0, 0.0, 0.0, 1.0)).any():
        return "its fourth row is not 0, 0, 0, 1"
    linear = matrix[:3, :3]
    scales = np.linalg.norm(linear, axis=0)
    products = linear.T @ linear
    if np.abs(products - np.diag(np.diag(products))).max() > 1e-4 * scales.max()**2:
        return "it shears: apply it to the mesh before its bake"
    if scales.max() > 1.0001 * scales.min():
        return f"it scales unequally, by {', '.join(f'{scale:.6g}' for scale in scales)}: scale the mesh before its bake"
    if np.linalg.det(linear) < 0.0:
        return "it mirrors: mirror the mesh before its bake"
    return "float32 does not hold its scale: apply it to the mesh before its bake"


def to_local(transforms: ArrayLike, points: ArrayLike) -> NDArray[np.float32]:
    """Moves points, (..., 3), from the world into the local space of transforms, (..., 8)."""
    return _core.points_to_local(transforms, points)


def to_world(transforms: ArrayLike, points: ArrayLike) -> NDArray[np.float32]:
    """Moves points, (..., 3), from the local space of transforms, (..., 8), into the world."""
    return _core.points_to_world(transforms, points)


def direction_to_local(transforms: ArrayLike, directions: ArrayLike) -> NDArray[np.float32]:
    """Rotates and scales directions, (..., 3), into the local space of transforms, (..., 8)."""
    return _core.directions_to_local(transforms, directions)


def normal_to_world(transforms: ArrayLike, normals: ArrayLike) -> NDArray[np.float32]:
    """Rotates normals, (..., 3), from the local space of transforms, (..., 8), into the world, without their scale."""
    return _core.normals_to_world(transforms, normals)


def direction_to_world(transforms: ArrayLike, directions: ArrayLike) -> NDArray[np.float32]:
    """Rotates and scales directions, (..., 3), from the local space of transforms, (..., 8), into the world."""
    return _core.directions_to_world(transforms, directions)


Origin = Optional[NDArray[np.float64]]
"""Where 0 0 0 of a blob, or of the world of two, lies in the source, or that of a view in its world: (3,), or (..., 3),
one for each result. None where the two have the same coordinates."""

PLACES = ("point", "on_shape", "corners", "points", "on_a", "on_b")
"""The fields of results that are places."""


def source_type(local: np.dtype[Any], places: Sequence[str] = PLACES) -> np.dtype[Any]:
    """Returns the type of results in the coordinates of the source: their places are float64."""
    fields: list[Any] = []
    for name in local.names or ():
        field = local[name]
        fields.append((name, np.float64 if name in places else field.base, field.shape))
    return np.dtype(fields)


def in_source(results: NDArray[Any], origin: Origin, places: Sequence[str] = PLACES) -> NDArray[Any]:
    """Returns results, or places (..., 3), in the coordinates of the source; without an origin as they are.

    places: the fields that are places, or transforms of eight numbers.
    """
    if origin is None:
        return results
    if results.dtype.names is None:
        return results + origin
    moved = np.empty(results.shape, source_type(results.dtype, places))
    for name in results.dtype.names:
        moved[name] = results[name]
        if name in places:
            *inner, width = results.dtype[name].shape
            place = moved[name][..., 4:7] if width == 8 else moved[name]
            place += origin.reshape(origin.shape[:-1] + (1,) * len(inner) + (3,))
    return moved


def lists_in_source(lists: Lists, origin: Origin) -> Lists:
    """Returns lists whose elements are in the coordinates of the source; without an origin as they are."""
    return lists if origin is None else lists._replace(items=in_source(lists.items, origin))


def transforms_from_origin(transforms: ArrayLike, origin: Origin) -> NDArray[np.float64]:
    """Returns the places of what counts from an origin, (..., 8), of transforms of the source's coordinates."""
    rows = np.array(transforms, np.float64)
    if origin is None:
        return rows
    axis, w, scale = rows[..., :3], rows[..., 3:4], rows[..., 7:]
    with np.errstate(all="ignore"):  # the library refuses what is no transform
        square = (rows[..., :4] ** 2).sum(axis=-1, keepdims=True)
        turned = 2 * np.cross(axis, scale * origin)
        rows[..., 4:7] += scale * origin + (w * turned + np.cross(axis, turned)) / square
    return rows
