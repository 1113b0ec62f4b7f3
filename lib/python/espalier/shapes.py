"""The shapes that queries take: one, or one for each query, in the units and axes of the baked mesh."""

from __future__ import annotations

from typing import NamedTuple, Union

from numpy.typing import ArrayLike


class Segment(NamedTuple):
    """The points between two points."""

    start: ArrayLike
    """(..., 3)"""
    end: ArrayLike
    """(..., 3)"""


class Sphere(NamedTuple):
    """All points within a radius of a center."""

    center: ArrayLike
    """(..., 3)"""
    radius: ArrayLike = 0.0
    """(...)"""


class Capsule(NamedTuple):
    """All points within a radius of a segment."""

    start: ArrayLike
    """(..., 3)"""
    end: ArrayLike
    """(..., 3)"""
    radius: ArrayLike = 0.0
    """(...)"""


class Box(NamedTuple):
    """An axis-aligned box. Empty where a coordinate of `min` is above that of `max`."""

    min: ArrayLike
    """(..., 3)"""
    max: ArrayLike
    """(..., 3)"""


class OrientedBox(NamedTuple):
    """A box of any orientation: each half axis leads from the center to the middle of a face."""

    center: ArrayLike
    """(..., 3)"""
    half_axes: ArrayLike
    """(..., 3, 3): a half axis in each row"""


class Triangle(NamedTuple):
    """A triangle."""

    corners: ArrayLike
    """(..., 3, 3): a corner in each row"""


class Cone(NamedTuple):
    """The convex hull of a point and of a disc around apex + axis, perpendicular to the axis."""

    apex: ArrayLike
    """(..., 3)"""
    axis: ArrayLike
    """(..., 3)"""
    radius: ArrayLike
    """(...): of the disc"""


class ConvexVolume(NamedTuple):
    """All points with dot(normal, x) <= offset for each of at most 32 planes."""

    planes: ArrayLike
    """(..., planes, 4): the normal, of any length but zero, and the offset in each row"""


class ConvexHull(NamedTuple):
    """The convex hull of at most 64 vertices, in any order."""

    vertices: ArrayLike
    """(..., vertices, 3)"""


Volume = Union[Sphere, Capsule, Box, OrientedBox, Triangle, Cone, ConvexVolume]
"""What overlaps() takes. Scenes take no ConvexVolume."""
Moving = Union[Sphere, Capsule, Box, OrientedBox, ConvexHull]
"""What sweep() takes."""
Body = Union[Sphere, Capsule, OrientedBox, ConvexHull]
"""What contacts() takes."""


def split(shape: object) -> tuple[str, tuple[ArrayLike, ...]]:
    """Returns the name and the fields of a shape."""
    if not isinstance(shape, (Sphere, Capsule, Box, OrientedBox, Triangle, Cone, ConvexVolume, ConvexHull, Segment)):
        raise TypeError(f"a shape of espalier is needed, such as espalier.Sphere, not {type(shape).__name__}")
    return type(shape).__name__, tuple(shape)
