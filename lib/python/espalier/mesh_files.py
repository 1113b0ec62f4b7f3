"""Meshes as arrays, and those of files, by the reader of the command."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Any, NamedTuple, Optional, Sequence, Union

from numpy.typing import ArrayLike

from .errors import MeshFileError

Path = Union[str, "os.PathLike[str]"]

_STATUSES = ("ok", "invalid_options", "file_access", "invalid_input", "unsupported", "internal")
_AXES = ("x", "y", "z")
# Ratios, so that each is the double that the command takes.
_UNITS = {"m": 1.0, "km": 1000.0, "cm": 1 / 100, "mm": 1 / 1000, "um": 1 / 1e6, "in": 254 / 1e4, "ft": 3048 / 1e4}


class Mesh(NamedTuple):
    """A mesh of several that are baked into one blob."""

    positions: ArrayLike
    """(n, 3), in the source's units and coordinates"""
    triangles: ArrayLike
    """(m, 3): numbers of positions, counter-clockwise when seen from the front"""
    materials: Optional[ArrayLike] = None
    """(m,): 0 to 65535"""
    name: str = ""
    """for messages"""
    file: int = 0
    """for the sources of hits"""
    mesh: int = 0
    """for the sources of hits"""


class MeshFileWarning(UserWarning):
    """What the triangles that were read may not have of a file. `kind` is one word, for programs."""

    def __init__(self, message: str, kind: str = "", file: str = "", mesh: Optional[int] = None) -> None:
        super().__init__(message)
        self.kind = kind
        self.file = file
        self.mesh = mesh


class SourceNames(NamedTuple):
    """What a file calls its materials and meshes, by the numbers that a blob stores. Empty where it has no name.

    Bytes of the file that are no UTF-8 are U+FFFD; all else is as the file has it, control characters too.
    """

    materials: list[str]
    """by the numbers of blob.materials() and Mesh.materials"""
    meshes: list[str]
    """by the field `mesh` of ORIGINAL_TRIANGLE and Mesh.mesh"""
    paths: list[str]
    """by the same numbers: the names of the nodes that lead to the mesh, as "Walls/Door_02"; empty for formats without nodes"""


class MeshFile(NamedTuple):
    """The meshes of a file, and what the file states."""

    meshes: list[Mesh]
    """in the order of the file; a mesh that it places several times is there for each place"""
    path: str
    opened: list[str]
    """the file itself and what it refers to that was there"""
    format: str
    mesh_names: list[str]
    """empty where the file has none"""
    metres_per_unit: float
    unit_origin: str
    """what states the unit"""
    warnings: list[MeshFileWarning]
    names: SourceNames


def read_mesh(path: Path, **options: Any) -> MeshFile:
    """Reads the meshes of a file: glTF 2.0, 3MF, OBJ, OFF, PLY, STL, RAW, and what assimp reads.

    The positions of `meshes` are float64 in metres, if the file states its unit or `unit` does, and bake_meshes() takes
    them as they are. bake_file() does both.

    Options, all by name:
    format: a name or an ending, such as "obj"; by default content and name decide. unit: of the numbers in the file, in
    metres, or a name of m, km, cm, mm, um, in and ft; by default what the file states, else metres. scale: of all
    coordinates. up: "x", "y" or "z", the axis that points up in the file and is turned to +Y; by default axes stay.
    materials: also reads a number for each triangle.
    keep_vertices: keeps all vertices in the order of the file, as for the poses of a deformable blob.
    require_vertices: refuses a face that names a vertex which the file does not have, or in texts one that is NaN or
        infinite; by default the former is warned of.
    memory: bytes that reading may take, by default half of the machine's; 0 is no limit. seconds: of processor time.

    Reads in a child process where the system has fork(), so that the crash of a library is an error like others. On
    Windows it reads in this process, without limits.

    Raises MeshFileError with the reason and the place. Warns with MeshFileWarning.
    """
    return read_files([path], 3, **options)[0]


def read_files(paths: Sequence[Path], stack_level: int, *, format: str = "", unit: Union[float, str, None] = None,
               scale: float = 1.0, up: Optional[str] = None, materials: bool = False, keep_vertices: bool = False,
               require_vertices: bool = False, memory: Optional[int] = None, seconds: float = 600.0) -> list[MeshFile]:
    """Reads several files. stack_level: whose line warnings name, counted from here."""
    try:
        from . import _import
    except ImportError as error:
        raise MeshFileError(
            f"this build of espalier reads no mesh files ({error}). Build the wheel with assimp, draco, expat, "
            "meshoptimizer, nlohmann-json and zlib installed (docs/python.md), or bake files by the command `espalier`.",
            "unsupported") from error
    if isinstance(unit, str):
        if unit not in _UNITS:
            raise ValueError(f"unit must be metres or one of {', '.join(_UNITS)}, not {unit!r}")
        unit = _UNITS[unit]
    if unit is not None and not 0.0 < unit < float("inf"):
        raise ValueError(f"unit must be a finite number above 0, not {unit}")
    if up is not None and up not in _AXES:
        raise ValueError(f"up must be one of x, y and z, not {up!r}")
    # A limit ends the process that reads.
    separate = hasattr(os, "fork") and sys.platform != "emscripten"
    if memory is None:
        memory = _import.default_memory() or 0
    options = {
        "format": format.lower(), "metres_per_unit": unit, "scale": scale,
        "up": None if up is None else _AXES.index(up), "materials": bool(materials),
        "keep_vertices": bool(keep_vertices), "require_vertices": bool(require_vertices), "separate_process": separate,
        "memory": memory if separate else 0, "seconds": float(seconds) if separate else 0.0,
    }
    status, reason, meshes, files = _import.read([os.fspath(path) for path in paths], options)
    results = []
    for number, file in enumerate(files):
        found = [MeshFileWarning(message, kind, name, mesh) for kind, message, name, mesh, _ in file["warnings"]]
        for warning in found:
            warnings.warn(warning, stacklevel=stack_level)
        of_file = [Mesh(*mesh) for mesh in meshes if mesh[4] == number]
        results.append(MeshFile(of_file, file["path"], file["opened"], file["format"], file["mesh_names"],
                                file["metres_per_unit"], file["unit_origin"], found,
                                SourceNames(file["material_names"], file["mesh_names"], file["mesh_paths"])))
    if status != 0:
        kind, message, name, mesh, triangle = reason
        raise MeshFileError(message, _STATUSES[status], kind, (name, mesh, triangle))
    return results
