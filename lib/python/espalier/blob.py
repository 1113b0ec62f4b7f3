"""Blobs: opening, facts and lookups by triangle."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .baked import Baked, bytes_of
from .bounds import StoredBounds
from .edges import EdgeQueries
from .errors import BakeError, OpenError
from .integers import triangle_numbers
from .mesh_files import SourceNames
from .pictures import Pictures
from .transforms import Origin, in_source
from .points import ShapeQueries
from .rays import RayQueries
from .results import Status

PROFILES = ("fast", "balanced", "small", "tiny")


class Refitted(NamedTuple):
    """A deformable blob in another pose."""

    blob: Blob
    """The blob in the pose, with bytes of its own."""
    quality: float
    """The cost of the tree in this pose over that at rest, for an average ray. About 1 is as good as at rest; from 1.5
    on, bake again with this pose among `poses`."""


class Blob(Baked, RayQueries, ShapeQueries, EdgeQueries, StoredBounds, Pictures):
    """A baked mesh. bake() and open_blob() return one.

    It holds its bytes: `blob.data` looks at them, `bytes(blob)` copies them. It never changes; any number of threads
    may query it at once, and queries release Python's lock. Coordinates are in the space and units of the mesh, also
    where the blob has an `origin`: then places in results are float64, and those in arguments should be.
    Pickling writes the bytes.
    """

    __slots__ = ("report", "remap", "names", "_origin")
    report: Optional[dict[str, Any]]
    """The figures of the bake; None for a blob that was opened."""
    remap: Optional[NDArray[Any]]
    """The source of each triangle, an array of REMAP; None for a blob that was opened."""
    names: Optional[SourceNames]
    """What the file calls materials and meshes; None unless bake_file() returned the blob."""
    _origin: Origin

    def __init__(self, core: _core.Blob, report: Optional[dict[str, Any]] = None,
                 remap: Optional[NDArray[Any]] = None) -> None:
        super().__init__(core)
        self.report = report
        self.remap = remap
        self.names = None
        self._origin = self.origin if any(self._facts["origin"]) else None

    @property
    def origin(self) -> NDArray[np.float64]:
        """(3,): what the bake subtracted from all positions, in float64; zero for most blobs.

        The blob stores it and counts all places from there in float32. Every call here takes and returns places in the
        coordinates of the source: it subtracts and adds the origin in float64. Only moving scenes place what
        counts from the origin.
        """
        return np.array(self._facts["origin"], np.float64)

    @property
    def bounds(self) -> NDArray[Any]:
        """(2, 3): the lower and the upper corner of a box around all triangles; float64 if the blob has an `origin`."""
        return np.array(self._facts["bounds"], np.float32 if self._origin is None else np.float64)

    @property
    def triangle_count(self) -> int:
        """The number of triangles, duplicate references included."""
        return int(self._facts["triangle_count"])

    @property
    def vertex_count(self) -> int:
        """The number of vertices."""
        return int(self._facts["vertex_count"])

    @property
    def is_closed(self) -> bool:
        """Whether contains() and signed_distance() answer."""
        return bool(self._facts["is_closed"])

    @property
    def is_deformable(self) -> bool:
        """Whether refit() can move the vertices."""
        return bool(self._facts["is_deformable"])

    @property
    def has_original_ids(self) -> bool:
        """Whether the blob stores the source of each triangle."""
        return bool(self._facts["has_original_ids"])

    @property
    def profile(self) -> str:
        """ "fast", "balanced", "small" or "tiny"."""
        return PROFILES[self._facts["profile"]]

    @property
    def is_view(self) -> bool:
        """Whether the blob looks at the bytes that open_blob() was given, and has no copy."""
        return bool(self._facts["is_view"])

    def info(self) -> dict[str, Any]:
        """Returns all facts: the properties, and size, checksum, depth, lattice_origin, lattice_step_exponent, ...

        `bounds` and `lattice_origin` are in the coordinates of the source.
        """
        return {**self._facts, "profile": self.profile}

    def triangles(self) -> NDArray[Any]:
        """Returns the corners of all triangles, (n, 3, 3), in baked order, without duplicate references.

        They are float32, or float64 where the blob has an `origin`.
        """
        return in_source(_core.all_triangles(self._core), self._origin)

    def corners(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[Any]:
        """Returns the corners of triangles: `corners` (..., 3, 3) and `status`."""
        return in_source(_core.corners(self._core, triangle_numbers(triangles), threads), self._origin)

    def materials(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[np.uint16]:
        """Returns the materials of triangles; 0 where the blob stores none.

        Numbers of no triangle, as misses have, get 0 too: look at the status of a hit first.
        """
        return _core.materials(self._core, triangle_numbers(triangles), threads)

    def original_triangles(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[Any]:
        """Returns the sources of triangles: an array of ORIGINAL_TRIANGLE. Without ids the status is NO_DATA."""
        return _core.original_triangles(self._core, triangle_numbers(triangles), threads)

    def original_hits(self, hits: NDArray[Any], remap: Optional[NDArray[Any]] = None, *,
                      threads: int = 1) -> NDArray[Any]:
        """Returns the sources of hits that a ray query of this blob returned: an array of ORIGINAL_HIT.

        u and v are the weights of the source's second and third corner. A blob without ids takes the table that its
        bake returned, `remap`; without one the status is NO_DATA.
        """
        return _core.original_hits(self._core, np.ascontiguousarray(hits).reshape(np.shape(hits)), remap, threads)

    def remap_file(self) -> bytes:
        """Returns `remap` as the bytes of a file, which read_remap() and read_remap of C++ read.

        Raises ValueError for a blob without `remap`.
        """
        if self.remap is None:
            raise ValueError("the blob was not baked here, and has no remap table")
        return _core.remap_file(self._core, np.ascontiguousarray(self.remap))

    def refit(self, positions: ArrayLike) -> Refitted:
        """Returns the blob with its vertices at other positions, without a bake. This blob stays as it is.

        positions: (n, 3), of all baked meshes in a row, unused ones included, in the coordinates of the source: the
        blob's `origin` is subtracted in float64. Each pose is within max_error of its source, rounded to float32. Its
        bytes depend on the positions alone, not on earlier poses. O(n).

        Raises ValueError for a blob that was baked without `deformable`, for another number of positions, and for a
        position that is not finite or outside of the `range` of the bake.
        """
        array = np.asarray(positions)
        if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iuf":
            raise ValueError(f"positions must be numbers in the shape (n, 3), not {array.dtype} in {array.shape}")
        local = array if self._origin is None else array - self._origin
        with np.errstate(over="ignore"):
            moved = _core.refit(self._core, np.ascontiguousarray(local, np.float32))
        if isinstance(moved[0], int):
            raise ValueError(_refusal_of_refit(Status(moved[0]), moved[1], moved[2], array))
        refitted = Blob(moved[0], None, self.remap)
        refitted.names = self.names
        return Refitted(refitted, moved[1])

    def __reduce__(self) -> Any:
        return open_blob, (bytes(self),)

    def __repr__(self) -> str:
        return f"<espalier.Blob of {self.triangle_count} triangles, {self._facts['size']} bytes, {self.profile}>"


def _refusal_of_refit(status: Status, position: int, count: int, positions: NDArray[Any]) -> str:
    if status == Status.NO_DATA:
        return "the blob was baked without deformable=True"
    if len(positions) != count:
        return f"the blob was baked from {count} positions, not from {len(positions)}"
    reason = "no number of float32" if status == Status.INVALID_ARGUMENT else "outside of the range of the bake"
    return f"position {position}, {positions[position].tolist()}, is {reason}"


def open_blob(source: Any) -> Blob:
    """Opens a baked mesh: a path, whose file is mapped into memory, or an object with bytes.

    Read-only objects (bytes, a read-only mmap or array) are looked at where they lie, at any alignment, and kept
    alive; their bytes must not change behind Python's back. Writable ones are copied. All bytes are checked, in time
    proportional to the size. Raises OpenError where they are no sound blob, and OSError for the file.
    """
    opened = _core.open(bytes_of(source))
    if isinstance(opened, int):
        raise OpenError(opened, source)
    return Blob(opened)


def read_remap(source: Any, blob: Blob) -> NDArray[Any]:
    """Returns the table of a remap file, (triangle_count,), of REMAP: the source of each triangle of the blob.

    source: a path or an object with bytes, of `espalier bake --remap` or Blob.remap_file(). Raises OpenError for other
    bytes, and for a file that belongs to another blob.
    """
    table = _core.read_remap(blob._core, bytes_of(source))
    if isinstance(table, int):
        raise OpenError(table, source)
    return table


def join_borders(blobs: Sequence[Blob], translations: ArrayLike = 0.0) -> list[Blob]:
    """Returns the blobs with the kinds of edges that the surface has where it goes on in another of them: the pieces of
    a ground, on which contacts then do not lean over the seams.

    The blobs have edge flags of one flat_angle, and one lattice: bake them with the same `step_exponent`. translations: (n, 3),
    how far each is moved from where its source lies, by whole steps. Origins have to be whole steps apart too, as those
    that bakes choose. Raises BakeError with the number of the blob that does not fit.
    """
    moved = np.broadcast_to(np.asarray(translations, np.float32), (len(blobs), 3))
    if any(blob._origin is not None for blob in blobs):
        apart = [blob.origin - blobs[0].origin for blob in blobs]
        moved = (np.asarray(translations, np.float64) + apart).astype(np.float32)
    joined = _core.join_borders([blob._core for blob in blobs], moved.tolist())
    if isinstance(joined, tuple):
        raise BakeError(*joined)
    return [Blob(core) for core in joined]


def verify(source: Any) -> None:
    """Tests whether a blob is what its header states, and raises ValueError with the first thing that is wrong."""
    message = _core.verify(bytes_of(source._core if isinstance(source, Blob) else source))
    if message:
        raise ValueError(message)
