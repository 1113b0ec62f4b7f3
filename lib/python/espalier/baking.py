"""Baking meshes: arrays and files."""

from __future__ import annotations

import os
import warnings
from typing import Any, Iterable, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .blob import PROFILES, Blob
from .errors import BakeError
from .integers import LARGEST, integer_array
from .mesh_files import Mesh, Path, read_files

EFFORTS = ("fast", "normal", "best")
BUILDERS = ("binned_sah", "sweep_sah", "spatial_splits", "agglomerative", "linear", "insertion")
_BITS, _TOLERANCE, _STEP = 0, 1, 2


class BakeWarning(UserWarning):
    """A property of the input or the blob that bake() accepted, but that its caller may not expect."""


def _index_array(triangles: ArrayLike, name: str) -> Any:
    # A number that is out of range stays so: the baker reports it with its place.
    array = integer_array(triangles, "triangles" + name)
    return array if array.size else np.zeros((0, 3), np.uint32)


def _as_written(message: str, meshes: Sequence[Mesh], place: Any) -> str:
    """Returns a message about a triangle with a number that uint32 does not hold as its caller wrote it."""
    for mesh in meshes:
        if place is None or place[2] is None or (mesh.file, mesh.mesh) != tuple(place[:2]):
            continue
        for number in np.asarray(mesh.triangles).reshape(-1)[3 * place[2]:3 * place[2] + 3]:
            if not 0 <= number <= LARGEST:
                return message.replace(f"vertex {LARGEST}", f"vertex {number}", 1)
    return message


def _position_array(positions: ArrayLike, name: str) -> Any:
    array = np.asarray(positions)
    if array.size == 0:
        return np.zeros((0, 3), np.float32)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"positions{name} must be real numbers, not {array.dtype}")
    return array if array.dtype in (np.float32, np.float64) else array.astype(np.float64)


def _number(of: str, name: str, names: Sequence[str]) -> int:
    if name not in names:
        raise ValueError(f"{of} must be one of {', '.join(names)}, not {name!r}")
    return names.index(name)


def origin_numbers(origin: Union[str, ArrayLike, None]) -> Optional[tuple[float, ...]]:
    """Returns the numbers of an origin; None where the baker chooses them."""
    if isinstance(origin, str):
        if origin != "auto":
            raise ValueError(f'origin must be "auto", None or three numbers, not {origin!r}')
        return None
    numbers = np.zeros(3) if origin is None else np.asarray(origin, np.float64)
    if numbers.shape != (3,):
        raise ValueError(f'origin must be "auto", None or three numbers, not numbers in {numbers.shape}')
    return tuple(float(number) for number in numbers)


def _moved(positions: ArrayLike, origin: Optional[tuple[float, ...]], shape: tuple[int, int], name: str) -> Any:
    """Returns positions less the origin, in float32. A deformable blob has none but one of the caller's."""
    array = np.asarray(positions)
    if array.shape != shape or array.dtype.kind not in "iuf":
        raise ValueError(f"{name} must be numbers in the shape {shape}, not {array.dtype} in {array.shape}")
    with np.errstate(over="ignore"):
        return (array.astype(np.float64) - np.array(origin or (0.0, 0.0, 0.0))).astype(np.float32)


def bake_meshes(meshes: Sequence[Union[Mesh, tuple[ArrayLike, ArrayLike]]], **options: Any) -> Blob:
    """Bakes several meshes into one blob. bake() has the options."""
    return _bake(meshes, 3, **options)


def _bake(meshes: Sequence[Union[Mesh, tuple[ArrayLike, ArrayLike]]], stack_level: int, *, bits: Optional[int] = None,
          tolerance: Optional[float] = None, step_exponent: Optional[int] = None, profile: Optional[str] = None,
          effort: str = "normal", original_ids: bool = False, drop_bad_triangles: bool = False,
          max_dropped: float = 10.0, allow_empty: bool = False, strict: bool = False,
          flat_angle: Optional[float] = None, bounds: bool = False, origin: Union[str, ArrayLike, None] = "auto",
          builder: str = "binned_sah", duplicate_budget: float = 0.3, byte_price: float = 5.0,
          max_leaf_triangles: int = 62, threads: int = 1, deformable: bool = False, range: Optional[ArrayLike] = None,
          poses: Sequence[ArrayLike] = (), **unknown: Any) -> Blob:
    # stack_level: whose line warnings name, counted from here.
    _refuse_unknown(unknown, ())
    given = [option is not None for option in (bits, tolerance, step_exponent)]
    if sum(given) > 1:
        raise ValueError("give one of bits, tolerance and step_exponent")
    if flat_angle is not None and not flat_angle >= 0.0:
        raise ValueError("flat_angle must be None, which stores no edges, or 0 or more degrees")
    if not deformable and (range is not None or len(poses) > 0):
        raise ValueError("range and poses are options of a bake with deformable=True")
    if profile is None:
        profile = "fast" if deformable else "balanced"
    kind, resolution = _BITS, 16.0
    if bits is not None:
        kind, resolution = _BITS, float(bits)
    elif tolerance is not None:
        if isinstance(tolerance, str):
            raise TypeError(f"tolerance must be a number, in the unit of the mesh, not {tolerance!r}")
        kind, resolution = _TOLERANCE, float(tolerance)
    elif step_exponent is not None:
        kind, resolution = _STEP, float(step_exponent)
    options = {
        "resolution_kind": kind, "resolution": resolution, "profile": _number("profile", profile, PROFILES),
        "effort": _number("effort", effort, EFFORTS), "builder": _number("builder", builder, BUILDERS),
        "original_ids": bool(original_ids), "drop_bad_triangles": bool(drop_bad_triangles),
        "max_dropped": max_dropped, "allow_empty": bool(allow_empty), "strict": bool(strict),
        "flat_angle": flat_angle, "bounds": bool(bounds), "duplicate_budget": duplicate_budget,
        "byte_price": byte_price, "max_leaf_triangles": max_leaf_triangles, "threads": threads,
        "origin": origin_numbers(origin), "deformable": bool(deformable),
    }
    arrays, given_meshes = [], []
    for number, each in enumerate(meshes):
        if not isinstance(each, Mesh) and not (isinstance(each, (tuple, list)) and len(each) in (2, 3)):
            raise TypeError(f"meshes must be Mesh objects, or positions, triangles and materials, not {type(each).__name__}; "
                            "of a MeshFile give its `meshes`")
        mesh = each if isinstance(each, Mesh) else Mesh(*each, mesh=number)
        given_meshes.append(mesh)
        name = f" of mesh {number}" if len(meshes) > 1 else ""
        materials = None if mesh.materials is None else integer_array(mesh.materials, "materials" + name)
        arrays.append((_position_array(mesh.positions, name), _index_array(mesh.triangles, name), materials,
                       mesh.name, mesh.file, mesh.mesh))
    options["range"] = None if range is None else _moved(range, options["origin"], (2, 3), "range").reshape(6)
    count = sum(len(array[0]) for array in arrays)
    options["poses"] = np.empty((len(poses), count, 3), np.float32)
    for number, pose in enumerate(poses):
        options["poses"][number] = _moved(pose, options["origin"], (count, 3), f"pose {number}")
    baked = _core.bake(arrays, options)
    if isinstance(baked[0], int):
        status, message, place = baked
        raise BakeError(status, _as_written(message, given_meshes, place), place)
    blob = Blob(*baked)
    for message in baked[1]["warnings"]:
        warnings.warn(message, BakeWarning, stacklevel=stack_level)
    return blob


def _refuse_unknown(options: Iterable[str], others: Sequence[str]) -> None:
    names = [*_bake.__kwdefaults__, *others]
    for name in options:
        if name not in names:
            raise TypeError(f"a bake has no option {name!r}; its options are {', '.join(names)}")


def bake(positions: ArrayLike, triangles: ArrayLike, materials: Optional[ArrayLike] = None, **options: Any) -> Blob:
    """Bakes a mesh into a blob.

    positions: (n, 3), in any unit, which the blob keeps. float32 and float64 are rounded once, to the blob's lattice.
    triangles: (m, 3) numbers of positions, counter-clockwise when seen from the front.
    materials: (m,) numbers from 0 to 65535.

    Options, all by name:
    bits: of the largest extent, 1 to 24; 16 unless one of the next two is given. tolerance: the largest distance
    between source and baked surface, in the unit of the mesh. step_exponent: of the lattice's step, a power of two.
    profile: "fast", "balanced" (the default), "small" or "tiny". effort: "fast", "normal" or "best".
    original_ids: stores the source of each triangle, for raycast_sources(). Without it, `blob.remap` has the same.
    drop_bad_triangles: drops triangles with NaN or wrong indices, which else refuse the bake.
    max_dropped: the share of triangles, in percent, that may be lost: broken, without area, or flattened by the
    lattice. allow_empty: accepts that none is left. strict: refuses what else is a warning.
    flat_angle: in degrees; stores how the surface bends at edges, for contacts(). bounds: stores tighter bounds.
    origin: (3,), subtracted from all positions in float64, and stored in the blob, whose queries take and return places
    in the coordinates of the source. "auto", the default, chooses one near the middle where float32 rounds places at
    the mesh by more than a quarter of the lattice's step, as on a map far from 0, else none; a deformable blob gets
    none. None: (0, 0, 0).
    deformable: bakes a blob whose vertices refit() can move, in profile "fast". range: (2, 3), the box in which all
    positions of all poses lie; by default the box of mesh and poses, a tenth wider on each side. poses: arrays of
    (n, 3), each with the positions of all meshes in a row, which the tree suits; both in the source's coordinates.
    builder, duplicate_budget, byte_price, max_leaf_triangles: for studies; docs/baking.md. threads: 0 is one per
    processor. The bytes depend on neither threads nor machine.

    Raises BakeError with the reason and the place. Warns with BakeWarning. `blob.report` has the figures.
    """
    return _bake([Mesh(positions, triangles, materials)], 3, **options)


_READER_OPTIONS = ("format", "unit", "scale", "up", "materials", "memory", "seconds")


def bake_file(path: Path, **options: Any) -> Blob:
    """Bakes all meshes of a file, as `espalier bake` does, with the options of bake() and of read_mesh().

    materials: stores the numbers of materials. `blob.names` has the names of materials and meshes by their numbers.
    Raises MeshFileError and BakeError, and warns with MeshFileWarning and BakeWarning.
    """
    _refuse_unknown(options, _READER_OPTIONS)
    of_reader = {name: options.pop(name) for name in _READER_OPTIONS if name in options}
    of_reader["keep_vertices"] = bool(options.get("deformable", False))
    of_reader["require_vertices"] = not options.get("drop_bad_triangles", False)
    file = read_files([path], 3, **of_reader)[0]
    try:
        blob = _bake(file.meshes, 3, **options)
    except BakeError as error:
        if os.fsdecode(path) in str(error):
            raise
        raise BakeError(error.status, f"{os.fsdecode(path)}: {error}", error.place) from None
    blob.names = file.names
    return blob
