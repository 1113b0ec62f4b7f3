"""A folder of blobs that are found by their content: the bytes of the source, the options and the baker's version.

Needs no farm: Store(folder).bake(path, options) bakes in this process, and gives the same bytes as bake_file().
"""

from __future__ import annotations

import hashlib
import json
import os
import pathlib
import socket
import time
from typing import Any, NamedTuple, Optional

import espalier


class Stored(NamedTuple):
    """What became of one source."""

    source: str
    key: str = ""
    """The name of the blob in the folder; empty where there is none."""
    was_there: bool = False
    """Whether an earlier bake had stored it."""
    facts: Optional[dict[str, Any]] = None
    """size, triangle_count, max_error and is_closed of the blob."""
    error: str = ""
    """Why there is none."""


class Store:
    """Blobs as FOLDER/ab/abcdef....espl. Any number of processes may write to it at once."""

    def __init__(self, folder: str) -> None:
        self.folder = pathlib.Path(folder)

    def path(self, key: str) -> pathlib.Path:
        return self.folder / key[:2] / f"{key}.espl"

    def key(self, source: str, options: dict[str, Any]) -> str:
        """Returns the name of what a source is baked to."""
        digest = hashlib.sha256()
        ending = os.path.splitext(source)[1].lower()
        digest.update(json.dumps([espalier.__version__, ending, options], sort_keys=True).encode())
        with open(source, "rb") as file:
            for block in iter(lambda: file.read(1 << 20), b""):
                digest.update(block)
        return digest.hexdigest()

    def bake(self, source: str, options: dict[str, Any]) -> Stored:
        """Bakes a source, unless its blob is there. A source that cannot be baked is an error of its own."""
        try:
            key = self.key(source, options)
            path = self.path(key)
            was_there = path.exists()
            blob = espalier.open_blob(path) if was_there else espalier.bake_file(source, **options)
            if not was_there:
                if self.key(source, options) != key:
                    return Stored(source, error="the file changed while it was read")
                self._write(path, blob)
        except (OSError, ValueError, TypeError, MemoryError) as error:
            return Stored(source, error=f"{type(error).__name__}: {error}")
        info = blob.info()
        facts = {name: info[name] for name in ("size", "triangle_count", "max_error", "is_closed")}
        return Stored(source, key, was_there, facts)

    def _write(self, path: pathlib.Path, blob: espalier.Blob) -> None:
        # Under a name of this process until it is whole: a process that is killed leaves no half of a blob.
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{path.stem}.{socket.gethostname()}.{os.getpid()}.part")
        blob.save(part)
        os.replace(part, path)

    def remove_old_parts(self, seconds: float = 86_400.0) -> None:
        """Removes what killed processes left. No bake takes a day."""
        for part in self.folder.glob("*/*.part"):
            if time.time() - part.stat().st_mtime > seconds:
                part.unlink(missing_ok=True)
