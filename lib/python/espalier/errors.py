"""Errors that the package raises by a name of its own."""

from __future__ import annotations

import os
from typing import Any, Optional

from . import _core


class OpenError(ValueError):
    """Bytes are no sound blob or scene. `status` is the number of the library's OpenStatus, `path` that of the file or ""."""

    def __init__(self, status: int, source: Any = "") -> None:
        self.status = status
        self.path = os.fsdecode(source) if isinstance(source, (str, os.PathLike)) else ""
        super().__init__((f"{self.path}: " if self.path else "") + _core.describe_open(status))

    def __reduce__(self) -> Any:
        return OpenError, (self.status, self.path)


class MeshFileError(ValueError):
    """A file was not read. The text states what is wrong, where, and what to do.

    `status` is "invalid_options", "file_access", "invalid_input", "unsupported" or "internal". `kind` is narrower where
    there is more to distinguish, such as "importer_crash", else the status. `place` is (file, mesh or None, triangle or
    None).
    """

    def __init__(self, message: str, status: str, kind: str = "",
                 place: tuple[str, Optional[int], Optional[int]] = ("", None, None)) -> None:
        super().__init__(message)
        self.status = status
        self.kind = kind or status
        self.place = place

    def __reduce__(self) -> Any:
        return MeshFileError, (str(self), self.status, self.kind, self.place)


class BakeError(ValueError):
    """Nothing was baked. The text states what is wrong, where, and what to do.

    `status` is the library's number; `place` is (file, mesh, triangle or None) of the first fault, or None.
    """

    def __init__(self, status: int, message: str, place: Optional[tuple[int, int, Optional[int]]] = None) -> None:
        super().__init__(message)
        self.status = status
        self.place = place

    def __reduce__(self) -> Any:
        return BakeError, (self.status, str(self), self.place)
