"""The shapes that queries take: one, or one for each query, in the units and the coordinates of the source."""

from __future__ import annotations

from typing import Any, NamedTuple, Union, get_args

from numpy.typing import ArrayLike


class Ray(NamedTuple):
    """The points origin + t * direction, of any t."""

    origin: ArrayLike
    """(..., 3)"""
    direction: ArrayLike
    """(..., 3): of any length but zero"""


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
"""What overlaps() of a blob takes."""
SceneVolume = Union[Sphere, Capsule, Box, OrientedBox, Triangle, Cone]
"""What overlaps() of a scene takes."""
Moving = Union[Sphere, Capsule, Box, OrientedBox, ConvexHull]
"""What sweep() takes."""
Body = Union[Sphere, Capsule, OrientedBox, ConvexHull]
"""What contacts() takes."""
Rounded = Union[Ray, Segment, Sphere, Capsule, Box, OrientedBox, Triangle, ConvexHull]
"""What rounding_error() takes, and points. A ConvexHull is one that sweeps."""


_HULL_OF_CORNERS = "a ConvexHull of its corners is meant: ConvexHull(triangle.corners)"
_MEANT = {
    ("Box", "OrientedBox"): "an OrientedBox is meant: OrientedBox((min + max) / 2, np.diag((max - min) / 2))",
    ("ConvexHull", "ConvexVolume"): "a ConvexVolume is meant, of the planes of the hull's faces",
    ("ConvexVolume", "ConvexHull"): "a ConvexHull is meant, of the corners of the volume",
    ("Triangle", "ConvexHull"): _HULL_OF_CORNERS,
    ("Segment", "Capsule"): "a Capsule is meant: Capsule(start, end)",
    ("Segment", "Ray"): "a Ray is meant: Ray(start, end - start)",
}


def split(shape: object, takes: Any, query: str) -> tuple[str, tuple[ArrayLike, ...]]:
    """Returns the name and the fields of a shape.

    takes: the classes that the query takes, as a union or one. Raises TypeError, which names the class that is meant,
    for others.
    """
    classes = get_args(takes) or (takes,)
    name = type(shape).__name__
    if isinstance(shape, classes):
        return name, tuple(shape)  # type: ignore[arg-type]
    names = [each.__name__ for each in classes]
    listed = " or ".join(filter(None, (", ".join(names[:-1]), names[-1])))
    if not isinstance(shape, (*get_args(Volume), *get_args(Rounded))):
        raise TypeError(f"{query} needs a shape of espalier, {listed}, not {name}")
    meant = next((remedy for (given, instead), remedy in _MEANT.items() if given == name and instead in names), None)
    raise TypeError(f"{query} takes no {name}" + (f"; {meant}" if meant else f", but {listed}"))
