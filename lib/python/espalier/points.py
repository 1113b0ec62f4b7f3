"""Closest points, inside, overlaps, sweeps and contacts with one blob."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .filters import flag_array
from .transforms import Origin, in_source, lists_in_source
from .rays import culling_number
from .results import Lists, YesNo
from .shapes import Body, Box, Capsule, Moving, OrientedBox, Ray, Rounded, Segment, Sphere, Triangle, Volume, split


class ShapeQueries:
    """Queries of points and shapes.

    points: (..., 3), in the units and the coordinates of the source, as the places of shapes and those in results. Of a blob
    with an `origin`, give float64: it is rounded after the origin was subtracted, and the places in results are float64.
    The fields of a shape, and distances, displacements and margins with them, broadcast against each other; the results
    have their common shape.
    threads: how many to use; 0 is one per processor. The results do not depend on it.
    """

    __slots__ = ()
    _core: _core.Blob
    _origin: Origin
    triangle_count: int

    def closest_point(self, points: Union[ArrayLike, Segment, Box], max_distance: ArrayLike = np.inf, *,
                      threads: int = 1) -> NDArray[Any]:
        """Returns the closest point of the surface to each point, segment or box: an array of CLOSEST_POINT.

        max_distance: (...), 0 or more. Where nothing is within it, the status is NOT_FOUND, the distance infinite.
        """
        if isinstance(points, (Segment, Box)):
            kind, fields = split(points, Union[Segment, Box], "closest_point()")
            return in_source(_core.closest_to_shapes(self._core, kind, fields, max_distance, threads), self._origin)
        return in_source(_core.closest_points(self._core, points, max_distance, False, threads), self._origin)

    def signed_distance(self, points: ArrayLike, max_distance: ArrayLike = np.inf, *, threads: int = 1) -> NDArray[Any]:
        """Returns the closest point with a negative distance inside of a closed surface: an array of CLOSEST_POINT.

        Where nothing is within max_distance, the status is NOT_FOUND and the distance max_distance, negative inside.
        A surface that is not closed refuses with NOT_CLOSED.
        """
        return in_source(_core.closest_points(self._core, points, max_distance, True, threads), self._origin)

    def closest_triangles(self, points: ArrayLike, most: int, max_distance: ArrayLike = np.inf, *,
                          threads: int = 1) -> Lists:
        """Returns the triangles closest to each point, at most `most`, sorted by distance: lists of CLOSEST_POINT."""
        lists = Lists(*_core.closest_triangle_lists(self._core, points, max_distance, most, threads))
        return lists_in_source(lists, self._origin)

    def contains(self, points: ArrayLike, *, threads: int = 1) -> YesNo:
        """Returns whether each point is inside of the closed surface. A point on the surface is inside.

        A surface that is not closed refuses with NOT_CLOSED.
        """
        return YesNo(_core.inside(self._core, points, threads))

    def winding_number(self, points: ArrayLike, directions: int = 64, *, threads: int = 1) -> NDArray[Any]:
        """Returns approximately how often the surface, open or closed, winds around each point: an array of WINDING.

        A `value` above 0.5 is the usual meaning of inside. directions: of rays, 2 to 4096; the error falls with them.
        Where the surface is closed around a point, the value is a whole number.
        """
        return _core.winding_numbers(self._core, points, directions, threads)

    def distance_bounds(self, points: ArrayLike, accuracy: float, max_distance: ArrayLike = np.inf, *,
                        threads: int = 1) -> NDArray[Any]:
        """Returns a lower and an upper bound of the distance to each point: an array of DISTANCE_BOUNDS.

        accuracy: a length; the larger, the less work. The bounds differ by no more than about that. Where nothing is
        within max_distance, the status is NOT_FOUND.
        """
        return _core.distance_bounds(self._core, points, max_distance, accuracy, threads)

    def rounding_error(self, shape: Union[ArrayLike, Rounded], displacement: Optional[ArrayLike] = None, *,
                       threads: int = 1) -> NDArray[Any]:
        """Returns how far rounding moves each query at most: an array of LENGTH.

        shape: points, rays or shapes of a query; a Ray counts inside of the blob's box. displacement: (..., 3), of the
        shape of a sweep, whose whole way counts. Lift a ray that leaves the surface by this, on the side of its
        normal: without, most such rays hit the wall that they start from.
        """
        if displacement is not None:
            return _core.rounding_of_sweeps(self._core, *split(shape, Moving, "rounding_error() of a sweep"),
                                            displacement, threads)
        if isinstance(shape, Ray):
            return _core.rounding_of_rays(self._core, shape.origin, shape.direction, threads)
        if isinstance(shape, tuple) and hasattr(shape, "_fields"):
            taken = Union[Segment, Sphere, Capsule, Box, OrientedBox, Triangle]
            return _core.rounding_of_shapes(self._core, *split(shape, taken, "rounding_error()"), threads)
        return _core.rounding_of_points(self._core, np.asarray(shape), threads)

    def overlaps(self, shape: Volume, *, accuracy: Optional[float] = None, threads: int = 1) -> YesNo:
        """Returns whether any triangle touches each shape.

        accuracy: a length in the blob's units. With one, a no is certain and a yes may be off by about as much, for
        less work; then the shape is a Sphere or a Box.
        """
        if accuracy is not None:
            fields = split(shape, Union[Sphere, Box], "overlaps() with an accuracy")
            return YesNo(_core.nearly_touching(self._core, *fields, accuracy, threads))
        return YesNo(_core.touching(self._core, *split(shape, Volume, "overlaps()"), threads))

    def overlapping_triangles(self, shape: Volume, *, threads: int = 1) -> Lists:
        """Returns the triangles that touch each shape: lists of numbers of triangles, ascending."""
        return Lists(*_core.touching_lists(self._core, *split(shape, Volume, "overlapping_triangles()"), threads))

    def sweep(self, shape: Moving, displacement: ArrayLike, *, culling: str = "none", ignore_leaving: bool = False,
              skin: float = 0.0, only: Optional[ArrayLike] = None, threads: int = 1) -> NDArray[Any]:
        """Returns the first contact of each shape as it moves by a displacement: an array of SWEEP_HIT.

        displacement: (..., 3). t is the share of it, from 0 to 1, at which the shape stops: where it touches, or a
        skin earlier. culling: "back" ignores triangles that show their back to the motion, "front" the others.
        ignore_leaving: ignores triangles that a shape touches at the start and leaves. skin: 0 or more.
        only: a flag for each triangle, as of raycast().
        """
        options = (culling_number(culling), ignore_leaving, skin)
        flags = flag_array(only, self.triangle_count, "triangles")
        kind, fields = split(shape, Moving, "sweep()")
        hits = _core.sweeps(self._core, kind, fields, displacement, options, flags, threads)
        return in_source(hits, self._origin)

    def contacts(self, shape: Body, margin: ArrayLike = 0.0, *, most: int = 16, threads: int = 1) -> Lists:
        """Returns the contacts of each body with triangles within a margin, the deepest first: lists of CONTACT.

        margin: (...), 0 or more. A body whose middle is inside a solid, where the winding number of a closed surface is
        positive, has a contact at any depth. Of more contacts than `most` the deepest are kept, with the status OUTPUT_FULL.
        """
        kind, fields = split(shape, Body, "contacts()")
        return lists_in_source(Lists(*_core.contact_lists(self._core, kind, fields, margin, most, threads)), self._origin)

    def planes(self, capsule: Capsule, margin: ArrayLike, *, most: int = 16, threads: int = 1) -> Lists:
        """Returns the planes that hold each capsule back which moves by at most a margin: lists of CONTACT_PLANE.

        The nearest come first: an even floor has one, a step's edge one that leans, without edge flags too. Of more planes
        than `most` the nearest are kept, with the status OUTPUT_FULL. solve_planes() returns the way along them.
        """
        kind, fields = split(capsule, Capsule, "planes()")
        return Lists(*_core.plane_lists(self._core, kind, fields, margin, most, threads))


def solve_planes(planes: Lists, wish: ArrayLike, skin: ArrayLike = 0.0) -> NDArray[Any]:
    """Returns, for each list of planes(), the way nearest to a wish that comes no nearer to any plane than a skin: WAY.

    wish: (..., 3), in the shape of the lists. Where no way keeps off all planes the status is NOT_FOUND.
    """
    return _core.solved_ways(planes.offsets, planes.items, wish, skin)
