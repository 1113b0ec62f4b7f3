"""libespalier.so by ctypes: one call for each query, into arrays of the types that the package has."""

import ctypes

import numpy as np

import espalier


class Vec3(ctypes.Structure):
    _fields_ = [("x", ctypes.c_float), ("y", ctypes.c_float), ("z", ctypes.c_float)]


class YesNo(ctypes.Structure):
    _fields_ = [("status", ctypes.c_uint8)]


class PairContact(ctypes.Structure):
    _fields_ = [("a", ctypes.c_uint32), ("b", ctypes.c_uint32), ("status", ctypes.c_uint8)]


class FloatResult(ctypes.Structure):
    _fields_ = [("value", ctypes.c_float), ("status", ctypes.c_uint8)]


def record(dtype):
    """Returns a structure of more than 16 bytes, which C returns by its address."""
    return type("Record", (ctypes.Structure,), {"_fields_": [("bytes", ctypes.c_uint32 * (dtype.itemsize // 4))]})


class Placed(ctypes.Structure):
    _fields_ = [("blob", ctypes.c_void_p), ("transform", ctypes.c_float * 8)]


class OpenBlob:
    """An espalier_blob, at an address that is a multiple of 16, with its bytes."""

    def __init__(self, library, data):
        self.bytes = bytes(data)
        self._memory = ctypes.create_string_buffer(library.espalier_size_of(b"blob") + 16)
        self.address = (ctypes.addressof(self._memory) + 15) & ~15
        assert library.espalier_open(self.bytes, ctypes.c_size_t(len(self.bytes)), ctypes.c_void_p(self.address)) == 0


class Library:
    def __init__(self, path):
        self.c = ctypes.CDLL(path)
        self.c.espalier_size_of.restype = ctypes.c_size_t

    def open(self, blob):
        return OpenBlob(self.c, blob.data)

    def each(self, name, dtype, opened, count, arguments):
        """Returns what a function returns for each query, where arguments(i) are those after the blob."""
        function = getattr(self.c, name)
        if dtype == np.uint8:
            function.restype = YesNo
        elif dtype == espalier.PAIR_CONTACT:
            function.restype = PairContact
        elif dtype == espalier.WINDING:
            function.restype = FloatResult
        else:
            function.restype = record(dtype)
        results = np.zeros(count, dtype)
        first = () if opened is None else (ctypes.c_void_p(opened.address),)
        raw = results.view(np.uint8).reshape(count, -1)
        for i in range(count):
            answer = function(*first, *arguments(i))
            raw[i] = np.frombuffer(answer, np.uint8)
        return results


def vector(row):
    return Vec3(*(float(x) for x in row))


def floats(*parts):
    """Returns the address of a structure of floats, such as a sphere."""
    numbers = np.concatenate([np.atleast_1d(np.asarray(part, np.float32)).ravel() for part in parts])
    return (ctypes.c_float * len(numbers))(*numbers)


def ray(origin, direction, t_min=0.0, t_max=np.inf, culling=0):
    """Returns an espalier_ray."""
    numbers = np.zeros(9, np.float32)
    numbers[:3], numbers[3:6], numbers[6], numbers[7] = origin, direction, t_min, t_max
    numbers[8:].view(np.uint8)[0] = culling
    return numbers.ctypes.data_as(ctypes.c_void_p), numbers


def placed(opened, transform):
    return ctypes.byref(Placed(opened.address, (ctypes.c_float * 8)(*transform)))


class InstanceId(ctypes.Structure):
    _fields_ = [("index", ctypes.c_uint32), ("in_tile", ctypes.c_uint32)]


class Handle(ctypes.Structure):
    _fields_ = [("slot", ctypes.c_uint32), ("generation", ctypes.c_uint32)]


class HandleResult(ctypes.Structure):
    _fields_ = [("value", Handle), ("status", ctypes.c_uint8)]


class FilledPairs(ctypes.Structure):
    _fields_ = [("count", ctypes.c_size_t), ("next", ctypes.c_uint32 * 2), ("status", ctypes.c_uint8)]


TRIANGLE_FILTER = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_uint32, ctypes.c_void_p)
SCENE_FILTER = ctypes.CFUNCTYPE(ctypes.c_bool, InstanceId, ctypes.c_uint32, ctypes.c_void_p)


def aligned(size):
    """Returns memory and an address in it that is a multiple of 32, with `size` bytes behind it."""
    memory = ctypes.create_string_buffer(size + 32)
    return memory, ctypes.c_void_p((ctypes.addressof(memory) + 31) & ~31)


class MovingScene:
    """An espalier_moving_scene of one mesh, and the view of it that queries take."""

    def __init__(self, library, opened, capacity, step_exponent):
        self.library, self.opened = library.c, opened
        self.library.espalier_moving_scene_bytes.restype = ctypes.c_uint64
        self.library.espalier_moving_scene_insert.restype = HandleResult
        self.library.espalier_moving_scene_block.restype = ctypes.c_void_p
        size = self.library.espalier_moving_scene_bytes(capacity)
        self._block, address = aligned(size)
        self._scene, self.address = aligned(self.library.espalier_size_of(b"moving_scene"))
        self._view, self.view_address = aligned(self.library.espalier_size_of(b"scene"))
        self.library.espalier_create_moving_scene.restype = ctypes.c_bool
        assert self.library.espalier_create_moving_scene(
            address, ctypes.c_size_t(size), ctypes.c_uint32(capacity), step_exponent, ctypes.c_void_p(opened.address),
            ctypes.c_size_t(1), None, ctypes.c_size_t(0), self.address)

    def insert(self, instance):
        """Inserts a record of espalier.INSTANCE, and returns one of espalier.HANDLE as a tuple."""
        result = self.library.espalier_moving_scene_insert(self.address, instance.ctypes.data_as(ctypes.c_void_p))
        return result.value.slot, result.value.generation, result.status

    def call(self, name, handle, *arguments):
        """Calls a function of one instance, and returns its status."""
        function = getattr(self.library, f"espalier_moving_scene_{name}")
        function.restype = ctypes.c_uint8
        return function(self.address, Handle(int(handle["slot"]), int(handle["generation"])), *arguments)

    def move(self, movements, filled):
        """Moves a batch, then renews the tree, and returns what the batch returned."""
        function = self.library.espalier_moving_scene_move_batch
        function.restype = filled
        result = function(self.address, movements.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(movements)))
        self.library.espalier_moving_scene_refit(self.address)
        return result

    def bytes(self):
        size = ctypes.c_size_t()
        block = self.library.espalier_moving_scene_block(self.address, ctypes.byref(size))
        return ctypes.string_at(block, size.value)

    def view(self):
        """Returns the address of the scene that queries take until the next change."""
        assert self.library.espalier_moving_scene_view(self.address, self.view_address) == 0
        return self.view_address

    def pairs(self, name, *arguments):
        """Returns all pairs of slots, and the status."""
        function = getattr(self.library, f"espalier_collect_{name}_pairs")
        function.restype = FilledPairs
        found = np.zeros(100_000, espalier.INSTANCE_PAIR)
        filled = function(self.address, found.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(found)), *arguments,
                          None, InstanceId(0, 0))
        return found[: filled.count], filled.status
