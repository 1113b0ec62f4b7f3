"""Scenes whose instances come, move and go, and which pairs of them touch."""

from __future__ import annotations

import warnings
from threading import RLock
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .blob import Blob
from .filters import flag_array
from .pairs import _visits
from .results import Status
from .scene_queries import SceneQueries
from .scenes import Scene, instance_rows, words
from .transforms import Origin, in_source


class Pairs(NamedTuple):
    """Pairs of instances, in ascending order, and whether they are all."""

    items: NDArray[Any]
    """(n,): INSTANCE_PAIR, or BAKED_PAIR of a moving scene and a baked one."""
    status: Status
    """OK: all. WORK_LIMIT: pairs are missing, from `next` on; if that is `start`, the limit is too small for one pair.
    OUT_OF_RANGE: `next` was refused, and what is behind it is missing."""
    next: tuple[int, ...]
    """A pair to begin at, as `start` of the next call."""


class MovingScene(SceneQueries):
    """Instances of blobs that are inserted, moved and removed, with the queries of SceneQueries.

    blobs: the meshes that instances place, Blob objects; instances name them by their numbers.
    capacity: the largest number of instances at once, 1 to 2^24; it takes 173 bytes for each.
    step_exponent: a step of the world is 2^step_exponent long, -100 to 80. A thousandth of the smallest instance is a
    good step; the world reaches 2^30 - 128 steps from the origin. No ray passes between pieces of a ground that have
    this step (`step_exponent` of their bakes) and are moved by whole steps of it.
    tiles: Scene objects without tiles, numbered after the blobs.

    A world that float32 does not resolve, such as 100 km with millimetres, is seen from places in it: seen_from() returns
    a view, whose places are float64.

    Any number of threads may query a scene at once; a change waits for those that began before it, and those that begin
    later wait for it. Calls release Python's lock. Results do not depend on the order of changes. Pickling writes a snapshot and the blobs.
    """

    __slots__ = ("_core", "_blobs", "_tiles", "_changing", "_origin")
    _core: _core.MovingScene

    def __init__(self, blobs: Sequence[Blob], capacity: int, step_exponent: int = -10, *,
                 tiles: Sequence[Scene] = ()) -> None:
        self._hold(blobs, tiles)
        if not 1 <= capacity <= 1 << 24:
            raise ValueError(f"capacity must be from 1 to 16777216, not {capacity}")
        if not -100 <= step_exponent <= 80:
            raise ValueError(f"step_exponent must be from -100 to 80, not {step_exponent}")
        self._core = _core.create_moving_scene(*self._cores(), capacity, step_exponent)

    def _hold(self, blobs: Sequence[Blob], tiles: Sequence[Scene]) -> None:
        self._origin: Origin = None
        self._changing = RLock()  # the scene and the list of its blobs change together
        self._blobs, self._tiles = list(blobs), list(tiles)
        for each in self._blobs:
            if not isinstance(each, Blob):
                raise TypeError(f"blobs must be Blob objects, not {type(each).__name__}; scenes are given as tiles")
        for tile in self._tiles:
            if not isinstance(tile, Scene):
                raise TypeError(f"tiles must be Scene objects, not {type(tile).__name__}")

    def _cores(self) -> tuple[list[Any], list[Any]]:
        return [blob._core for blob in self._blobs], [tile._core for tile in self._tiles]

    @property
    def instance_count(self) -> int:
        """The number of instances."""
        return int(self._core.facts()["instance_count"])

    @property
    def capacity(self) -> int:
        """The number of instances that there is room for."""
        return int(self._core.facts()["capacity"])

    @property
    def slot_end(self) -> int:
        """A number above each slot that was ever used: the length of instances(), handles() and of flags."""
        return int(self._core.facts()["slot_end"])

    @property
    def step_exponent(self) -> int:
        """A step of the world is 2^step_exponent long."""
        return int(self._core.facts()["step_exponent"])

    @property
    def origin(self) -> NDArray[np.float64]:
        """(3,): the place in the world from which float32 counts in this view. 0 unless seen_from() made it."""
        return np.array(self._core.origin(), np.float64)

    def seen_from(self, place: ArrayLike) -> MovingScene:
        """Returns the same scene as float32 resolves it near a place: a view, whose places are float64. O(1).

        place: (3,), in the world. Each place that is given is rounded once to float32, from the `origin` of the view: the
        multiple of 128 steps nearest to `place`. An instance keeps the place that it was given through a view, and
        others, from elsewhere, round it once more, by less than a ten-millionth of the distance.
        Handles, pairs and the bounds of the world do not depend on the view, and a change through one changes all. Pairs
        with a baked scene take the view with its `origin` by themselves. Raises ValueError for a place that is not in the
        world.
        """
        x, y, z = (float(coordinate) for coordinate in np.asarray(place, np.float64).reshape(3))
        view = MovingScene.__new__(MovingScene)
        view._changing, view._blobs, view._tiles = self._changing, self._blobs, self._tiles
        view._core = self._core.seen_from(x, y, z)
        view._origin = view.origin if view.origin.any() else None
        return view

    @property
    def bounds(self) -> NDArray[Any]:
        """(2, 3): the lower and the upper corner of a box around all instances; of none, an empty one. O(capacity).

        float32, of a view float64.
        """
        boxes = self.boxes(self.handles())
        boxes = boxes[boxes["status"] == Status.OK]
        return np.array([boxes["min"].min(axis=0, initial=np.inf), boxes["max"].max(axis=0, initial=-np.inf)])

    @property
    def quality(self) -> float:
        """How much more surface the boxes of the tree have than after the last repack(); from 1.3 on, repack().

        Infinite before the first repack(); 1 without instances. O(n).
        """
        return self._core.quality()

    @property
    def blobs(self) -> tuple[Blob, ...]:
        """The meshes, by number."""
        return tuple(self._blobs)

    def _flags(self, only: Optional[ArrayLike]) -> Optional[NDArray[np.uint8]]:
        return None if only is None else flag_array(only, self.slot_end, "slots")

    def handles(self) -> NDArray[Any]:
        """Returns the handles of all slots, (slot_end,): an array of HANDLE. A free slot has the status NOT_FOUND."""
        return self._core.handles()

    def instances(self) -> NDArray[Any]:
        """Returns the instances of all slots, (slot_end,): an array of INSTANCE, whose `source` is the slot.

        So `scene.instances()[hits["instance"]]` are those of hits. A free slot has NO_TRIANGLE for `mesh` and `source`,
        and the mask 0.
        """
        return in_source(self._core.instances(), self._origin, ("transform",))

    def boxes(self, handles: ArrayLike) -> NDArray[Any]:
        """Returns the boxes of instances in the tree, rounded outward: an array of BOX. handles: (...), of HANDLE."""
        return in_source(self._core.boxes(_handle_rows(handles)), self._origin, ("min", "max"))

    def is_on_common_lattice(self, handles: ArrayLike) -> NDArray[np.bool_]:
        """Returns whether rays are rounded once for each instance and others, so that none passes between them.

        handles: (...), of HANDLE. False for one that is stale.
        """
        return self._core.on_common_lattice(_handle_rows(handles))

    def insert(self, places: ArrayLike, meshes: ArrayLike = 0, *, masks: Optional[ArrayLike] = None,
               users: Optional[ArrayLike] = None) -> NDArray[Any]:
        """Inserts instances and returns their handles, (n,): an array of HANDLE.

        places: (n, 8), the transform of each instance, which moves what a blob counts from its `origin`; those of
        bake_scene() move the source instead. meshes: (n,), the number of its blob or tile. masks, users: (n,), 32 bits
        for queries and for the caller. Keep the handles: they name instances until these are removed.
        A refused instance has a status from 16 on, the others go on: INVALID_ARGUMENT for a number without a mesh or a
        transform that is not valid, OUT_OF_RANGE for a place outside of the world, NO_ROOM in a full scene.
        Warns of a blob or tile with an `origin` at the translation 0, which is not where its source lies.
        """
        rows, numbers = instance_rows(places, meshes, masks, users)
        if self._origin is None:
            _warn_at_zero([*self._blobs, *self._tiles], rows, numbers[:, 0])
        return self._core.insert(rows, numbers)

    def remove(self, handles: ArrayLike) -> NDArray[np.uint8]:
        """Removes instances and returns the Status of each: OK, or STALE_HANDLE. handles: (...), of HANDLE."""
        return self._core.remove(_handle_rows(handles))

    def move(self, handles: ArrayLike, places: ArrayLike) -> NDArray[np.uint8]:
        """Moves instances to other places, and returns the Status of each.

        handles: (...), of HANDLE. places: (..., 8), which broadcast to the handles. An instance that is refused stays
        where it is, and the others move: STALE_HANDLE, INVALID_ARGUMENT or OUT_OF_RANGE, as of insert(). Renews the
        boxes of the tree once. Give all instances of a step in one call: it takes O(moved + capacity / 8).
        """
        rows = _handle_rows(handles)
        given = np.asarray(places)
        if given.shape[-1:] != (8,):
            raise ValueError(f"places must have the shape (..., 8), not {given.shape}")
        return self._core.move(rows, np.broadcast_to(given, (*rows.shape[:-1], 8)))

    def set_masks(self, handles: ArrayLike, masks: ArrayLike) -> NDArray[np.uint8]:
        """Sets the masks of instances, which broadcast to the handles. Returns the Status of each."""
        return self._set_words(handles, words(masks, "masks"), True)

    def set_users(self, handles: ArrayLike, users: ArrayLike) -> NDArray[np.uint8]:
        """Sets the caller's numbers of instances, which broadcast to the handles. Returns the Status of each."""
        return self._set_words(handles, words(users, "users"), False)

    def _set_words(self, handles: ArrayLike, values: NDArray[np.uint32], is_mask: bool) -> NDArray[np.uint8]:
        rows = _handle_rows(handles)
        return self._core.set_words(rows, np.ascontiguousarray(np.broadcast_to(values, rows.shape[:-1])), is_mask)

    def set_mesh(self, mesh: int, blob: Blob) -> None:
        """Gives all instances of a mesh another blob, such as another pose of it, and renews their boxes.

        O(n) for a pose, which has the lattice of the blob before; another blob repacks the scene.
        The instances count as moved. Raises IndexError for a number without a mesh, and ValueError for a blob without
        triangles or one that leaves the world at the place of an instance; the scene is then as before.
        """
        if not isinstance(blob, Blob):
            raise TypeError(f"a Blob is needed, not {type(blob).__name__}")
        if not 0 <= mesh < len(self._blobs):
            raise IndexError(f"the scene has no mesh {mesh}")
        if not np.array_equal(blob.origin, self._blobs[mesh].origin):
            warnings.warn(f"mesh {mesh} counted from {tuple(self._blobs[mesh].origin.tolist())} and now counts from "
                          f"{tuple(blob.origin.tolist())}: its instances move by the difference", UserWarning, stacklevel=2)
        with self._changing:
            status = Status(self._core.set_mesh(mesh, blob._core))
            if status != Status.OK:
                raise ValueError(f"mesh {mesh} keeps its blob: {status.describe()}")
            self._blobs[mesh] = blob

    def repack(self) -> None:
        """Builds the tree anew, for faster queries. Call it every few steps, or when quality has risen. O(n)."""
        self._core.repack()

    def end_step(self) -> None:
        """Ends a step: no instance counts as moved until it is moved or inserted again (only_moved)."""
        self._core.end_step()

    def candidate_pairs(self, baked: Optional[Scene] = None, *, only_moved: bool = False,
                        start: Optional[Sequence[int]] = None) -> Pairs:
        """Returns the pairs of instances that may touch: those whose boxes do, and whose masks share a bit.

        baked: a scene that stays; the pairs are then those of an instance of each, as BAKED_PAIR. If it has an origin,
        there must be a view with the same one, at a multiple of 128 steps; else the status is INVALID_ARGUMENT.
        Without it: of this scene with itself, as INSTANCE_PAIR, a < b. Both name slots of this scene.
        only_moved: only pairs of which an instance was moved or inserted since end_step().
        start: the pair to begin at, by default the first one.
        """
        if baked is None:
            return _pairs(_core.candidate_pairs(self._core, only_moved, _start(start, 2)))
        return _pairs(_core.candidate_pairs_with_baked(*self._beside(baked), only_moved, _start(start, 3)))

    def colliding_pairs(self, baked: Optional[Scene] = None, *, only_moved: bool = False,
                        work_limit: Optional[int] = None, start: Optional[Sequence[int]] = None) -> Pairs:
        """Returns the candidate pairs of which triangles touch.

        work_limit: the number of pairs of nodes or leaves that all pairs together may visit; None is unlimited.
        Other arguments are those of candidate_pairs(). A surface inside another one does not touch it.
        """
        visits = _visits(work_limit)
        if baked is None:
            return _pairs(_core.colliding_pairs(self._core, only_moved, _start(start, 2), visits))
        return _pairs(_core.colliding_pairs_with_baked(*self._beside(baked), only_moved, _start(start, 3), visits))

    def _beside(self, baked: Scene) -> tuple[_core.MovingScene, _core.Scene]:
        """Returns both as the library takes them: this one in the view, if there is one, that counts as the other does."""
        if not isinstance(baked, Scene):
            raise TypeError(f"baked must be a Scene, not {type(baked).__name__}")
        if baked._origin is None:
            return self._core, baked._core
        try:
            view = self.seen_from(baked._origin)
        except ValueError:
            return self._core, baked._core
        return (view if np.array_equal(view.origin, baked._origin) else self)._core, baked._core

    def snapshot(self) -> bytes:
        """Returns the bytes of the scene without its blobs, with which open_moving_scene() continues."""
        return self._core.snapshot()

    def __reduce__(self) -> Any:
        with self._changing:
            return _open_view, (self.snapshot(), list(self._blobs), self._tiles, tuple(self.origin))

    def __repr__(self) -> str:
        return f"<espalier.MovingScene of {self.instance_count} instances of {len(self._blobs)} meshes>"


def open_moving_scene(snapshot: bytes, blobs: Sequence[Blob], tiles: Sequence[Scene] = ()) -> MovingScene:
    """Returns a moving scene that continues with a snapshot, whose handles stay valid. O(n log n).

    blobs, tiles: those of the scene. Raises ValueError for bytes that are no snapshot, and for meshes of other bounds or
    lattice steps; others with the same ones give other answers.
    """
    scene = MovingScene.__new__(MovingScene)
    scene._hold(blobs, tiles)
    scene._core = _core.open_moving_scene(bytes(snapshot), *scene._cores())
    return scene


def _open_view(snapshot: bytes, blobs: Sequence[Blob], tiles: Sequence[Scene], origin: Sequence[float]) -> MovingScene:
    scene = open_moving_scene(snapshot, blobs, tiles)
    return scene.seen_from(origin) if any(origin) else scene


def _handle_rows(handles: ArrayLike) -> NDArray[np.uint32]:
    array = np.asarray(handles)
    names = array.dtype.names or ()
    if "slot" not in names or "generation" not in names:
        raise TypeError(f"handles must be those that insert() returned, of espalier.HANDLE, not {array.dtype}")
    return np.stack([array["slot"], array["generation"]], axis=-1).astype(np.uint32, casting="same_kind", copy=False)


def _warn_at_zero(parts: Sequence[Union[Blob, Scene]], rows: NDArray[Any], meshes: NDArray[np.uint32]) -> None:
    """Warns of a mesh with an origin that is placed where that would have to be 0."""
    for number, part in enumerate(parts):
        if part._origin is None or rows.dtype.kind not in "iuf":
            continue
        if (rows[meshes == number, 4:7] == 0).all(axis=1).any():
            origin = tuple(part.origin.tolist())
            warnings.warn(f"mesh {number} counts from its origin {origin}, and at the translation 0 it does not lie where its "
                          "source does: insert it at its `origin`, or bake it with origin=None", UserWarning, stacklevel=3)


def _start(start: Optional[Sequence[int]], length: int) -> tuple[int, ...]:
    if start is None:
        return (0,) * length
    numbers = tuple(int(number) for number in start)
    if len(numbers) != length or min(numbers) < 0 or max(numbers) > 0xFFFFFFFF:
        raise ValueError(f"start must be {length} integers from 0 to 4294967295, as `next` of the call before")
    return numbers


def _pairs(collected: tuple[NDArray[Any], int, tuple[int, ...]]) -> Pairs:
    return Pairs(collected[0], Status(collected[1]), collected[2])
