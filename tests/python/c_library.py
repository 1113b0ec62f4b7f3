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
