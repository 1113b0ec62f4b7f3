"""Baked scenes: many instances of blobs, each with a place in the world, in one file."""

from __future__ import annotations

import warnings
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .baked import Baked, bytes_of
from .baking import BakeWarning, origin_numbers
from .blob import Blob
from .borders import border_warning
from .errors import BakeError, OpenError
from .filters import flag_array
from .scene_queries import ALL, SceneQueries
from .transforms import Origin, in_source


class Scene(Baked, SceneQueries):
    """A baked scene, with the queries of SceneQueries. bake_scene() and open_scene() return one."""

    __slots__ = ("_origin",)
    _origin: Origin

    def __init__(self, core: _core.Scene) -> None:
        super().__init__(core)
        self._origin = self.origin if any(self._facts["origin"]) else None

    @property
    def origin(self) -> NDArray[np.float64]:
        """(3,): what the bake subtracted from all places; (0, 0, 0) for most scenes, and kept in files.

        Calls subtract it from places and add it, in float64: places are those of the source.
        """
        return np.array(self._facts["origin"], np.float64)

    @property
    def bounds(self) -> NDArray[Any]:
        """(2, 3): the lower and the upper corner of a box around all instances; float64 if the scene has an `origin`."""
        return np.array(self._facts["bounds"], np.float32 if self._origin is None else np.float64)

    @property
    def instance_count(self) -> int:
        """The number of instances."""
        return int(self._facts["instance_count"])

    @property
    def mesh_count(self) -> int:
        """The number of meshes, without those of tiles."""
        return int(self._facts["mesh_count"])

    def instances(self) -> NDArray[Any]:
        """Returns all instances: an array of INSTANCE, in the order of the field `instance` of results.

        `source` is the index in the places that bake_scene() took. A transform places what a mesh or tile counts from
        its `origin`.
        """
        return in_source(self._core.instances(), self._origin, ("transform",))

    def is_on_common_lattice(self) -> NDArray[np.bool_]:
        """Returns for each instance whether rays are rounded once for it and others, so that none passes between them."""
        return self._core.on_common_lattice()

    def mesh(self, mesh: int) -> Blob:
        """Returns a mesh, whose bytes are those of the scene. Instances place what it counts from its `origin`."""
        return Blob(self._core.mesh(mesh))

    def _flags(self, only: Optional[ArrayLike]) -> Optional[NDArray[np.uint8]]:
        return flag_array(only, self.instance_count, "instances")

    def __reduce__(self) -> Any:
        return open_scene, (bytes(self),)

    def __repr__(self) -> str:
        return f"<espalier.Scene of {self.instance_count} instances of {self.mesh_count} meshes>"


def open_scene(source: Any) -> Scene:
    """Opens a baked scene, as open_blob() opens a blob."""
    opened = _core.open_scene(bytes_of(source))
    if isinstance(opened, int):
        raise OpenError(opened, source)
    return Scene(opened)


def verify_scene(source: Any) -> None:
    """Tests whether a scene is what its header states, and raises ValueError with the first thing that is wrong."""
    message = _core.verify_scene(bytes_of(source._core if isinstance(source, Scene) else source))
    if message:
        raise ValueError(message)


def words(values: ArrayLike, name: str) -> NDArray[np.uint32]:
    """Returns integers of 32 bits, in their shape. Raises ValueError, which names the argument, for others."""
    array = np.asarray(values)
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise ValueError(f"{name} must be integers from 0 to 4294967295")
    return array.astype(np.uint32)


def instance_rows(places: ArrayLike, meshes: ArrayLike, masks: Optional[ArrayLike],
                  users: Optional[ArrayLike]) -> tuple[NDArray[Any], NDArray[np.uint32]]:
    """Returns the places of instances, (n, 8), and the mesh, mask and user's number of each, (n, 3)."""
    rows = np.asarray(places)  # the library takes real numbers of any type, and no others
    if rows.shape[-1:] != (8,) or rows.ndim > 2:
        raise ValueError(f"places must have the shape (n, 8), not {rows.shape}")
    rows = rows.reshape(-1, 8)
    numbers = np.empty((len(rows), 3), np.uint32)
    for column, values in enumerate((meshes, ALL if masks is None else masks, 0 if users is None else users)):
        numbers[:, column] = words(values, "meshes, masks and users")
    return rows, numbers


def bake_scene(blobs: Sequence[Any], places: ArrayLike, meshes: Optional[ArrayLike] = None, *,
               masks: Optional[ArrayLike] = None, users: Optional[ArrayLike] = None,
               origin: Union[str, ArrayLike, None] = "auto") -> Scene:
    """Joins blobs and instances in one scene.

    blobs: Blob objects, scenes, which become tiles, or objects with bytes.
    places: (n, 8), the transform of each instance. meshes: (n,), the number of its blob; one blob needs none. masks,
    users: (n,), 32 bits for queries and for the caller.
    The scene stores instances in another order: the field `instance` of results is an index into `scene.instances()`,
    whose field `source` is the index in `places`.
    A transform places the source of a blob, also where the blob has an `origin`. Translations of float64 are rounded once.
    origin: three numbers, which are subtracted from all places; None for none. "auto": chosen where float32 rounds places
    at an instance by more than a quarter of its step, if it needs float64 or all lie far from 0. The scene keeps it as
    `origin`.

    Raises BakeError with the reason. Warns with BakeWarning of instances that share the edges of their borders, as the
    pieces of a ground do, but are rounded apart, and of an origin from which float32 is too coarse.
    """
    if isinstance(blobs, (Blob, Scene, bytes, bytearray, memoryview)):
        raise TypeError("blobs must be a list of blobs, not one")
    blobs = list(blobs)
    if meshes is None and len(blobs) > 1 and np.size(places) > 0:
        raise ValueError(f"meshes must have the number of the blob of each place, as there are {len(blobs)} blobs")
    rows, numbers = instance_rows(places, 0 if meshes is None else meshes, masks, users)
    cores = [blob._core if isinstance(blob, (Blob, Scene)) else blob for blob in blobs]
    translations = None if rows.dtype == np.float32 else rows[:, 4:7]
    baked = _core.bake_scene(cores, rows, numbers, translations, origin_numbers(origin))
    if isinstance(baked[0], int):
        raise BakeError(*baked)
    scene = Scene(baked[0])
    border = border_warning(scene)
    for message in baked[1] + ([border] if border else []):
        warnings.warn(message, BakeWarning, stacklevel=2)
    return scene
