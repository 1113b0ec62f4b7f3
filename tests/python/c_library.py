"""libespalier.so by ctypes: its functions with the types that the headers of C declare, and arrays of the types that the package has."""

import ctypes
import functools
import pathlib
import re
import sys

import numpy as np

import espalier

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "c"))
import declarations  # noqa: E402

C = declarations.C()
FUNCTIONS = C.functions | C.inline
NUMBERS = {"float": ctypes.c_float, "bool": ctypes.c_bool, "int": ctypes.c_int, "size_t": ctypes.c_size_t, "void": None,
           "uint8_t": ctypes.c_uint8, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64, "triangle_id": ctypes.c_uint32}
TRIANGLE_FILTER = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_uint32, ctypes.c_void_p)


def type_of(kind):
    name = kind.removeprefix("const ").removeprefix("espalier_")
    if "*" in name or name in C.callbacks:
        return ctypes.c_void_p
    return ctypes.c_uint8 if name in C.enumerations else NUMBERS[name] if name in NUMBERS else structure(name)


def dtype_of(name):
    """Returns the type that the package has for a structure, if any."""
    name = name.removeprefix("espalier_")
    other = {"yes_no": np.dtype(np.uint8), "float_result": espalier.WINDING}
    return other.get(name) or getattr(espalier, name.removesuffix("_result").upper(), None)


@functools.cache
def structure(name):
    dtype, fields = dtype_of(name), []
    if dtype is not None and dtype.itemsize > 16:  # C returns it by its address
        fields = [("words", ctypes.c_uint32 * (dtype.itemsize // 4))]
    for kind, field in C.structures[name] if not fields else ():
        length = re.search(rf"\b{field}\[(\d+)\]", C.bodies[name])
        fields.append((field, type_of(kind) * int(length[1]) if length else type_of(kind)))
    return type(name, (ctypes.Structure,), {"_fields_": fields})


SCENE_FILTER = ctypes.CFUNCTYPE(ctypes.c_bool, structure("instance_id"), ctypes.c_uint32, ctypes.c_void_p)


def converted(kind, argument):
    """Returns an argument as ctypes takes it: the address of an array or of a structure of floats, or a structure by its fields."""
    if kind is ctypes.c_void_p:
        if isinstance(argument, np.ndarray):
            return argument.ctypes.data
        return floats(*argument) if isinstance(argument, tuple) else getattr(argument, "address", argument)
    if issubclass(kind, ctypes.Structure):
        return kind(*(getattr(x, "item", lambda x=x: x)() for x in argument))
    return getattr(argument, "item", lambda: argument)()


class Room:
    """Memory at an address that is a multiple of 32."""

    def __init__(self, size):
        self._memory = ctypes.create_string_buffer(size + 32)
        self.address = (ctypes.addressof(self._memory) + 31) & ~31


class Rows:
    """An espalier_convex_volume or espalier_convex_hull: where its planes or vertices are, and their number."""

    def __init__(self, rows):
        self._rows = np.ascontiguousarray(rows, np.float32)
        self._words = np.array([self._rows.ctypes.data, len(rows)], np.uint64)
        self.address = self._words.ctypes.data


class Library:
    def __init__(self, path):
        self.c = ctypes.CDLL(path)

    @functools.cache
    def __getattr__(self, name):
        """Returns a function by its name without espalier_."""
        function = getattr(self.c, f"espalier_{name}")
        function.restype = type_of(FUNCTIONS[name].result)
        function.argtypes = [type_of(kind) for kind, _ in FUNCTIONS[name].parameters]
        return lambda *arguments: function(*map(converted, function.argtypes, arguments))

    def room_for(self, name):
        return Room(self.size_of(name.encode()))

    def opened(self, blob):
        """Returns an espalier_blob, with its bytes."""
        place = self.room_for("blob")
        place.bytes = bytes(blob.data)
        assert self.open(place.bytes, len(place.bytes), place) == 0
        return place

    def each(self, name, count, arguments):
        """Returns what a function returns for each query, where arguments(i) are its arguments."""
        function = getattr(self, name)
        results = np.zeros(count, dtype_of(FUNCTIONS[name].result))
        raw = results.view(np.uint8).reshape(count, -1)
        for i in range(count):
            raw[i] = np.frombuffer(function(*arguments(i)), np.uint8)
        return results


def floats(*parts):
    """Returns a structure of floats, such as a sphere."""
    numbers = np.concatenate([np.atleast_1d(np.asarray(part, np.float32)).ravel() for part in parts])
    return (ctypes.c_float * len(numbers))(*numbers)


def ray(origin, direction, t_min=0.0, t_max=np.inf, culling=0):
    """Returns an espalier_ray."""
    numbers = np.zeros(9, np.float32)
    numbers[:3], numbers[3:6], numbers[6], numbers[7] = origin, direction, t_min, t_max
    numbers[8:].view(np.uint8)[0] = culling
    return numbers


def placed(opened, transform):
    """Returns an espalier_placed_blob."""
    return np.array([opened.address], np.uint64).view(np.uint8).tobytes() + np.asarray(transform, np.float32).tobytes()


class MovingScene:
    """An espalier_moving_scene of one mesh, and the view of it that queries take."""

    def __init__(self, library, opened, capacity, step_exponent):
        self.library, self.opened = library, opened
        size = library.moving_scene_bytes(capacity)
        self._block, self._scene, self._view = Room(size), library.room_for("moving_scene"), library.room_for("scene")
        self.address = self._scene.address
        assert library.create_moving_scene(self._block, size, capacity, step_exponent, opened, 1, None, 0, self)

    def insert(self, instance):
        """Inserts a record of espalier.INSTANCE, and returns one of espalier.HANDLE as a tuple."""
        result = self.library.moving_scene_insert(self, instance)
        return result.value.slot, result.value.generation, result.status

    def call(self, name, handle, *arguments):
        """Calls a function of one instance, and returns its status."""
        return getattr(self.library, f"moving_scene_{name}")(self, (handle["slot"], handle["generation"]), *arguments)

    def move(self, movements):
        """Moves a batch, then renews the tree, and returns what the batch returned."""
        result = self.library.moving_scene_move_batch(self, movements, len(movements))
        self.library.moving_scene_refit(self)
        return result

    def bytes(self):
        size = ctypes.c_size_t()
        return ctypes.string_at(self.library.moving_scene_block(self, ctypes.byref(size)), size.value)

    def view(self):
        """Returns the scene that queries take until the next change."""
        assert self.library.moving_scene_view(self, self._view) == 0
        return self._view

    def pairs(self, name, *arguments):
        """Returns all pairs of slots, and the status."""
        found = np.zeros(100_000, espalier.INSTANCE_PAIR)
        filled = getattr(self.library, f"collect_{name}_pairs")(self, found, len(found), *arguments, None, (0, 0))
        return found[: filled.count], filled.status
