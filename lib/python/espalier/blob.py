"""Blobs: opening, facts and lookups by triangle."""

from __future__ import annotations

import mmap
import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .points import ShapeQueries
from .rays import RayQueries
from .results import NO_TRIANGLE

PROFILES = ("fast", "balanced", "small", "tiny")


class OpenError(ValueError):
    """Bytes are no sound blob or scene. `status` is the number of the library's OpenStatus."""

    def __init__(self, status: int) -> None:
        super().__init__(_core.describe_open(status))
        self.status = status


class BakeError(ValueError):
    """Nothing was baked. The text states what is wrong, where, and what to do.

    `status` is the library's number; `place` is (file, mesh, triangle or None) of the first fault, or None.
    """

    def __init__(self, status: int, message: str, place: Optional[tuple[int, int, Optional[int]]] = None) -> None:
        super().__init__(message)
        self.status = status
        self.place = place


def bytes_of(source: Any) -> Any:
    """Returns an object with bytes: the file of a path, mapped into memory, or the object itself."""
    if not isinstance(source, (str, os.PathLike)):
        return source
    with open(source, "rb") as file:
        if os.fstat(file.fileno()).st_size == 0:
            return b""
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)


def triangle_numbers(triangles: ArrayLike) -> NDArray[np.uint32]:
    """Returns numbers of triangles as the library takes them: those that no blob can have become NO_TRIANGLE."""
    array = np.asarray(triangles)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise TypeError(f"numbers of triangles must be integers, not {array.dtype}")
    if array.dtype == np.uint32:
        return np.ascontiguousarray(array).reshape(array.shape)
    return np.where((array < 0) | (array > NO_TRIANGLE), NO_TRIANGLE, array).astype(np.uint32)


class Blob(RayQueries, ShapeQueries):
    """A baked mesh. bake() and open_blob() return one.

    It holds its bytes: `blob.data` looks at them, `bytes(blob)` copies them. It never changes; any number of threads
    may query it at once, and queries release Python's lock. Coordinates are in the space and units of the mesh.
    Pickling writes the bytes.
    """

    __slots__ = ("_core", "_facts", "report", "remap")
    report: Optional[dict[str, Any]]
    """The figures of the bake; None for a blob that was opened."""
    remap: Optional[NDArray[Any]]
    """The source of each triangle, an array of REMAP; None for a blob that was opened."""

    def __init__(self, core: _core.Blob, report: Optional[dict[str, Any]] = None,
                 remap: Optional[NDArray[Any]] = None) -> None:
        self._core = core
        self._facts = core.facts()
        self.report = report
        self.remap = remap

    @property
    def data(self) -> memoryview:
        """The bytes, without a copy. They live as long as this view or the blob."""
        return memoryview(self._core)

    @property
    def triangle_count(self) -> int:
        """The number of triangles, duplicate references included."""
        return int(self._facts["triangle_count"])

    @property
    def vertex_count(self) -> int:
        """The number of vertices."""
        return int(self._facts["vertex_count"])

    @property
    def bounds(self) -> NDArray[np.float32]:
        """(2, 3): the lower and the upper corner of the box around all triangles."""
        return np.array(self._facts["bounds"], np.float32)

    @property
    def max_error(self) -> float:
        """The largest distance between the baked surface and its float32 source, in the blob's units."""
        return float(self._facts["max_error"])

    @property
    def is_closed(self) -> bool:
        """Whether contains() and signed_distance() answer."""
        return bool(self._facts["is_closed"])

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
        """Returns all facts: the properties, and size, checksum, depth, lattice_origin, lattice_step_exponent, ..."""
        return {**self._facts, "profile": self.profile}

    def triangles(self) -> NDArray[np.float32]:
        """Returns the corners of all triangles, (n, 3, 3), in baked order, without duplicate references."""
        return _core.all_triangles(self._core)

    def corners(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[Any]:
        """Returns the corners of triangles: `corners` (..., 3, 3) and `status`."""
        return _core.corners(self._core, triangle_numbers(triangles), threads)

    def materials(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[np.uint16]:
        """Returns the materials of triangles; 0 where the blob stores none."""
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

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the bytes to a file."""
        with open(path, "wb") as file:
            file.write(self.data)

    def __bytes__(self) -> bytes:
        return bytes(self.data)

    def __reduce__(self) -> Any:
        return open_blob, (bytes(self),)

    def __repr__(self) -> str:
        return f"<espalier.Blob of {self.triangle_count} triangles, {self._facts['size']} bytes, {self.profile}>"


def open_blob(source: Any) -> Blob:
    """Opens a baked mesh: a path, whose file is mapped into memory, or an object with bytes.

    Read-only objects (bytes, a read-only mmap or array) are looked at where they lie, at any alignment, and kept
    alive; their bytes must not change behind Python's back. Writable ones are copied. All bytes are checked, in time
    proportional to the size. Raises OpenError where they are no sound blob, and OSError for the file.
    """
    opened = _core.open(bytes_of(source))
    if isinstance(opened, int):
        raise OpenError(opened)
    return Blob(opened)


def verify(source: Any) -> None:
    """Tests whether a blob is what its header states, and raises ValueError with the first thing that is wrong."""
    message = _core.verify(bytes_of(source._core if isinstance(source, Blob) else source))
    if message:
        raise ValueError(message)
