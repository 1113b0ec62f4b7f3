"""What queries return: structured NumPy types, lists in one array, yes or no, and the numbers that fields hold."""

from __future__ import annotations

import enum
from typing import Any, Iterator, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core

NO_TRIANGLE = 0xFFFFFFFF
"""The number in `triangle`, `a`, `b`, `instance` and `in_tile` where there is none."""


class Status(enum.IntEnum):
    """The status of one query. Below 16 it was answered, at least in part; from 16 on it was refused."""

    OK = 0
    NOT_FOUND = 1
    STOPPED = 2
    OUTPUT_FULL = 3
    WORK_LIMIT = 4
    NOT_OPEN = 16
    INVALID_ARGUMENT = 17
    OUT_OF_RANGE = 18
    NOT_CLOSED = 19
    NO_DATA = 20
    NO_ROOM = 21
    STALE_HANDLE = 22
    NOT_REFITTED = 23

    def describe(self) -> str:
        """Returns one English sentence without a full stop."""
        return _core.describe_query(int(self))


class Side(enum.IntEnum):
    """A side of a triangle. Its corners run counter-clockwise when seen from the front."""

    FRONT = 0
    BACK = 1


class Feature(enum.IntEnum):
    """The part of a triangle that a point lies on."""

    FACE = 0
    EDGE_AB = 1
    EDGE_BC = 2
    EDGE_CA = 3
    VERTEX_A = 4
    VERTEX_B = 5
    VERTEX_C = 6


class EdgeKind(enum.IntEnum):
    """The bend of the surface at an edge, seen from the front of its triangles."""

    FLAT = 0
    CONVEX = 1
    CONCAVE = 2
    BOUNDARY = 3


class Lists(NamedTuple):
    """A list for each query, all in one array.

    The list of query i, counted in C order, is `items[offsets[i]:offsets[i + 1]]`.
    """

    offsets: NDArray[np.intp]
    """(n + 1,) integers that never fall."""
    items: NDArray[Any]
    """All elements, one list after the other."""
    status: NDArray[np.uint8]
    """The Status of each query, in the shape of the batch."""

    def counts(self) -> NDArray[np.intp]:
        """Returns the length of each list, in the shape of the batch."""
        return np.diff(self.offsets).reshape(self.status.shape)

    def queries(self) -> NDArray[np.intp]:
        """Returns for each element the number of its query."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def each(self) -> Iterator[NDArray[Any]]:
        """Yields the list of each query."""
        for begin, end in zip(self.offsets[:-1], self.offsets[1:]):
            yield self.items[begin:end]


class YesNo:
    """Answers that are yes, no, or neither: a refusal, or a work limit that was reached.

    It has no truth value, so that neither cannot be taken for a no. Where a mistake is dangerous, test `no`, not
    `~yes`.
    """

    __slots__ = ("_codes",)

    def __init__(self, codes: NDArray[np.uint8]) -> None:
        self._codes = codes  # as the library has them: OK is yes, NOT_FOUND is no

    @property
    def status(self) -> Any:
        """The Status of each query, in the shape of the batch: OK for a yes and for a no, else why it is neither."""
        return np.where(self.no, np.uint8(Status.OK), self._codes)

    @property
    def yes(self) -> Any:
        """Booleans, in the shape of the batch."""
        return self._codes == Status.OK

    @property
    def no(self) -> Any:
        """Booleans, in the shape of the batch."""
        return self._codes == Status.NOT_FOUND

    def value_or(self, otherwise: bool) -> Any:
        """Returns booleans: `yes`, or `otherwise` where the answer is neither."""
        return self.yes | (~self.no & otherwise)

    def __bool__(self) -> bool:
        raise TypeError("a YesNo has no truth value: use .yes, .no or .value_or()")

    def __len__(self) -> int:
        return len(self._codes)

    def __repr__(self) -> str:
        """yes, no, or why a single answer is neither; of many the array of these, with the names of statuses."""
        if self._codes.ndim == 0:
            return self._word(int(self._codes), Status(int(self.status)).describe())
        def word(code: Any) -> str:
            return self._word(int(code), Status(int(code)).name)

        return np.array2string(self._codes, separator=", ", formatter={"int": word})

    @staticmethod
    def _word(code: int, reason: str) -> str:
        return "yes" if code == Status.OK else "no" if code == Status.NOT_FOUND else f"neither ({reason})"


class SourceHits(NamedTuple):
    """The hits of rays with their places and their sources, each in the shape of the batch."""

    hits: NDArray[Any]
    """As of raycast()."""
    points: NDArray[np.float64]
    """(..., 3): origin + t * direction in float64, rounded once, and once more for a blob with an `origin`; NaN for a
    miss."""
    sources: NDArray[Any]
    """`file`, `mesh`, `triangle`, `u` and `v` of the source, and `status`."""


def _record(name: str) -> np.dtype[Any]:
    return np.dtype(_core.dtypes[name])


# Of a blob with an origin, the fields that are places are float64: point, on_shape, points, on_a and on_b.
RAY_HIT = _record("ray_hit")
"""t, u, v, normal (3), triangle, status, side. A miss has an infinite t and NO_TRIANGLE."""
CLOSEST_POINT = _record("closest_point")
"""point (3), on_shape (3), face_normal (3), distance, u, v, triangle, status, feature, side."""
WINDING = _record("winding")
"""value, status."""
LENGTH = _record("length")
"""value, status."""
DISTANCE_BOUNDS = _record("distance_bounds")
"""lower, upper, status."""
EDGE_KINDS = _record("edge_kinds")
"""ab, bc, ca, each an EdgeKind, and status."""
BOX = _record("box")
"""min (3), max (3), status."""
SWEEP_HIT = _record("sweep_hit")
"""t, point (3), normal (3), face_normal (3), triangle, status, feature, starts_overlapping. A miss has t 1, a refusal 0."""
ORIGINAL_HIT = _record("original_hit")
"""file, mesh, triangle, u, v, status: zero unless the status is OK."""
ORIGINAL_TRIANGLE = _record("original_triangle")
"""file, mesh, triangle, first_corner, status."""
REMAP = _record("remap")
"""file, mesh, triangle, first_corner of each baked triangle."""
CONTACT = _record("contact")
"""point (3), normal (3), distance, triangle, feature, side."""
CONTACT_PLANE = _record("contact_plane")
"""normal (3), distance, triangle."""
WAY = _record("way")
"""value (3), status."""
PAIR_CONTACT = _record("pair_contact")
"""a, b, status."""
PAIR_TOUCH = _record("pair_touch")
"""points (6, 3), of which the first `count` count, normal (3), depth, a, b, count."""
BLOB_DISTANCE = _record("blob_distance")
"""distance, on_a (3), on_b (3), a, b, status."""
SCENE_RAY_HIT = _record("scene_ray_hit")
"""As RAY_HIT, with instance and in_tile."""
SCENE_CLOSEST_POINT = _record("scene_closest_point")
"""As CLOSEST_POINT, with instance and in_tile."""
SCENE_SWEEP_HIT = _record("scene_sweep_hit")
"""As SWEEP_HIT, with instance and in_tile."""
SCENE_TRIANGLE = _record("scene_triangle")
"""instance, in_tile, triangle."""
SCENE_CONTACT = _record("scene_contact")
"""As CONTACT, with instance and in_tile."""
CANDIDATE = _record("candidate")
"""instance, in_tile."""
INSTANCE = _record("instance")
"""transform (8), mesh, mask, user, source."""
HANDLE = _record("handle")
"""slot, generation, status: the name of an instance of a moving scene. A refused one has NO_TRIANGLE for its slot."""
INSTANCE_PAIR = _record("instance_pair")
"""a, b: two slots of a moving scene."""
BAKED_PAIR = _record("baked_pair")
"""moving, instance, in_tile: a slot of a moving scene, and an instance of a baked one."""
