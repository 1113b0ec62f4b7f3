"""Reading the triangles of mesh files: .obj, .ply and .stl. The command `espalier bake` reads many more formats."""

from __future__ import annotations

import os
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

Arrays = tuple[NDArray[np.float64], NDArray[np.uint32]]

_PLY_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}


def read_mesh(path: Union[str, os.PathLike[str]]) -> Arrays:
    """Returns the positions (n, 3) and the triangles (m, 3) of a file. Polygons become fans.

    Raises ValueError where the file is damaged or has another format.
    """
    name = os.fspath(path)
    ending = os.path.splitext(name)[1].lower()
    readers = {".obj": _read_obj, ".ply": _read_ply, ".stl": _read_stl}
    if ending not in readers:
        raise ValueError(f"{name}: only .obj, .ply and .stl are read; `espalier bake` reads many more formats")
    with open(path, "rb") as file:
        data = file.read()
    try:
        return readers[ending](data)
    except (ValueError, IndexError, KeyError, UnicodeDecodeError, OverflowError) as error:
        raise ValueError(f"{name}: {error}") from error


def _fans(polygons: list[list[int]], count: int) -> NDArray[np.uint32]:
    triangles = [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]
    array = np.array(triangles, np.int64).reshape(-1, 3)
    if array.size and (array.min() < 0 or array.max() >= count):
        raise ValueError("a polygon has a vertex that does not exist")
    return array.astype(np.uint32)


def _read_obj(data: bytes) -> Arrays:
    positions: list[list[float]] = []
    polygons: list[list[int]] = []
    for number, line in enumerate(data.decode("utf-8", "replace").replace("\\\n", " ").splitlines(), 1):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            if len(words) < 4:
                raise ValueError(f"line {number}: a vertex has fewer than three numbers")
            positions.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            corners = [int(word.split("/")[0]) for word in words[1:]]
            if 0 in corners:
                raise ValueError(f"line {number}: a face has vertex 0; the first vertex is 1")
            polygons.append([corner - 1 if corner > 0 else len(positions) + corner for corner in corners])
    array = np.array(positions, np.float64).reshape(-1, 3)
    return array, _fans(polygons, len(array))


def _read_stl(data: bytes) -> Arrays:
    facet = np.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("attribute", "<u2")])
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + count * facet.itemsize:
        corners = np.frombuffer(data, facet, count, 84)["corners"].reshape(-1, 3).astype(np.float64)
    else:
        words = data.split()
        places = [i for i, word in enumerate(words) if word == b"vertex"]
        if not places:
            raise ValueError("no STL: neither the size of a binary file nor a vertex of a text file")
        corners = np.array([[float(word) for word in words[i + 1 : i + 4]] for i in places], np.float64)
    if len(corners) % 3 != 0:
        raise ValueError("a facet has no three corners")
    positions, numbers = np.unique(corners, axis=0, return_inverse=True)
    return positions, numbers.reshape(-1, 3).astype(np.uint32)


def _read_ply(data: bytes) -> Arrays:
    end = data.index(b"end_header")
    begin = data.index(b"\n", end) + 1
    lines = data[:end].decode("ascii").split("\n")
    kind = ""
    elements: list[tuple[str, int, list[list[str]]]] = []
    for words in (line.split() for line in lines):
        if words[:1] == ["format"]:
            kind = words[1]
        elif words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    if lines[0].strip() != "ply" or kind not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise ValueError("no PLY file")
    reader: Any = _PlyText(data[begin:]) if kind == "ascii" else _PlyBytes(data[begin:], "<" if "little" in kind else ">")
    positions = np.zeros((0, 3))
    polygons: list[list[int]] = []
    for name, count, properties in elements:
        if name == "vertex" and not any(each[0] == "list" for each in properties):
            rows = reader.rows(count, [each[0] for each in properties])
            names = [each[-1] for each in properties]
            positions = np.stack([rows[names.index(axis)] for axis in "xyz"], axis=-1).astype(np.float64)
            continue
        for _ in range(count):
            for each in properties:
                if each[0] != "list":
                    reader.numbers(1, each[0])
                    continue
                numbers = reader.numbers(int(reader.numbers(1, each[1])[0]), each[2])
                if name == "face" and each[3] in ("vertex_indices", "vertex_index"):
                    polygons.append([int(number) for number in numbers])
    return positions, _fans(polygons, len(positions))


def _require_count(count: int) -> None:
    if count < 0:
        raise ValueError("a number of elements is below 0")


class _PlyText:
    def __init__(self, data: bytes) -> None:
        self._words = data.split()
        self._place = 0

    def numbers(self, count: int, kind: str) -> list[float]:
        _require_count(count)
        words = self._words[self._place : self._place + count]
        if len(words) < count:
            raise ValueError("the file ends too early")
        self._place += count
        return [float(word) for word in words]

    def rows(self, count: int, kinds: list[str]) -> list[Any]:
        return list(np.array(self.numbers(count * len(kinds), ""), np.float64).reshape(count, len(kinds)).T)


class _PlyBytes:
    def __init__(self, data: bytes, order: str) -> None:
        self._data = data
        self._order = order
        self._place = 0

    def numbers(self, count: int, kind: str) -> Any:
        _require_count(count)
        numbers = np.frombuffer(self._data, self._order + _PLY_TYPES[kind], count, self._place)
        self._place += numbers.nbytes
        return numbers

    def rows(self, count: int, kinds: list[str]) -> list[Any]:
        _require_count(count)
        row = np.dtype([(f"f{i}", self._order + _PLY_TYPES[kind]) for i, kind in enumerate(kinds)])
        rows = np.frombuffer(self._data, row, count, self._place)
        self._place += rows.nbytes
        return [rows[f"f{i}"] for i in range(len(kinds))]
