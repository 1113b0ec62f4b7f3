"""Baked bytes, which a blob and a scene both hold."""

from __future__ import annotations

import contextlib
import errno
import mmap
import os
import uuid
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray


def bytes_of(source: Any) -> Any:
    """Returns an object with bytes: the file of a path, mapped into memory, or the object itself."""
    if not isinstance(source, (str, os.PathLike)):
        return source
    with open(source, "rb") as file:
        if os.fstat(file.fileno()).st_size == 0:
            return b""
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)


class Baked:
    """Baked bytes and facts about all that is in them."""

    __slots__ = ("_core", "_facts")

    def __init__(self, core: Any) -> None:
        self._core = core
        self._facts = core.facts()

    @property
    def data(self) -> memoryview:
        """The bytes, without a copy. They live as long as this view or the object."""
        return memoryview(self._core)

    @property
    def bounds(self) -> NDArray[Any]:
        """(2, 3): the lower and the upper corner of a box around all triangles."""
        return np.array(self._facts["bounds"], np.float32)

    @property
    def max_error(self) -> float:
        """The largest distance between the baked surface and its source; in a scene, in world units."""
        return float(self._facts["max_error"])

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the bytes to a file, which replaces one of that name when it is whole.

        So a blob can be saved to the file that it was opened from, and others that are mapped from it stay as they are.
        """
        target = os.fspath(path)
        if os.path.exists(target) and not os.path.isfile(target):  # a pipe or a device
            with open(target, "wb") as file:
                file.write(self.data)
            return
        target = os.path.realpath(target)  # a link stays one
        part = f"{target}.{uuid.uuid4().hex}.part"  # of this call alone
        try:
            with open(part, "xb") as file:
                file.write(self.data)
            os.replace(part, target)
        except FileNotFoundError:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), target) from None
        except BaseException:
            with contextlib.suppress(OSError):
                os.remove(part)
            raise

    def __bytes__(self) -> bytes:
        return bytes(self.data)
