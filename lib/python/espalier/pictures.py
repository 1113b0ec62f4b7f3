"""Pictures of blobs and scenes: a camera, shading by the direction to it, and PNG. For notebooks and for a first look."""

from __future__ import annotations

import os
import struct
import zlib
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .results import Status
from .shapes import Ray

SURFACE = np.array([0.62, 0.70, 0.80])
BACK = np.array([0.80, 0.55, 0.45])
BACKGROUND = np.array([1.0, 1.0, 1.0])


def pinhole(eye: ArrayLike, target: ArrayLike, up: ArrayLike = (0.0, 0.0, 1.0), *, width: int = 640, height: int = 480,
            field_of_view: float = 40.0) -> Ray:
    """Returns the rays of a pinhole camera, one through the middle of each pixel: a Ray of (height, width) queries.

    eye, target, up: (3,); up is not along the view. field_of_view: in degrees, from the bottom to the top, below 180.
    Row 0 is the top. `blob.raycast(*espalier.pinhole(eye, target))` casts them. Directions reach one unit along the
    view, so that t is the depth.
    """
    if width < 1 or height < 1:
        raise ValueError(f"a picture has at least one pixel, not {width} x {height}")
    if not 0.0 < field_of_view < 180.0:
        raise ValueError(f"field_of_view must be above 0 and below 180 degrees, not {field_of_view}")
    place = np.asarray(eye, np.float64)
    forward = _unit(np.asarray(target, np.float64) - place, "eye and target are one point")
    right = _unit(np.cross(forward, np.asarray(up, np.float64)), "up is along the view")
    top = np.tan(np.radians(field_of_view) / 2)
    down = (1.0 - (2.0 * np.arange(height) + 1.0) / height) * top
    across = ((2.0 * np.arange(width) + 1.0) / width - 1.0) * top * width / height
    directions = forward + across[:, np.newaxis] * right + down[:, np.newaxis, np.newaxis] * np.cross(right, forward)
    return Ray(place, directions)


def write_png(path: Union[str, os.PathLike[str]], pixels: ArrayLike) -> None:
    """Writes pixels, (height, width, 3) of uint8, to a PNG file."""
    with open(path, "wb") as file:
        file.write(png_of(pixels))


def png_of(pixels: ArrayLike) -> bytes:
    """Returns the bytes of a PNG file. pixels: (height, width, 3) of uint8, red, green and blue."""
    array = np.asarray(pixels)
    if array.ndim != 3 or array.shape[2] != 3 or array.dtype != np.uint8:
        raise ValueError(f"pixels must be uint8 in the shape (height, width, 3), not {array.dtype} in {array.shape}")

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = array.shape[:2]
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each begins with the number of its filter: none
    rows[:, 1:] = array.reshape(height, -1)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))


class Pictures:
    """Pictures of what has `bounds` and raycast()."""

    __slots__ = ()

    def render(self, camera: Optional[Ray] = None, *, width: int = 640, height: int = 480,
               threads: int = 0) -> NDArray[np.uint8]:
        """Returns a picture, (height, width, 3) of uint8: faces that look at the camera are bright, backs are brown.

        camera: rays in the shape (height, width), such as those of pinhole(); by default one from above a corner, which
        has all in view. write_png() writes the picture to a file.
        """
        rays = self._view(width, height) if camera is None else camera
        directions = np.asarray(rays.direction, np.float64)
        hits = self.raycast(*rays, threads=threads)  # type: ignore[attr-defined]
        if hits.ndim != 2:
            raise ValueError(f"a camera has rays in the shape (height, width), not {hits.shape}")
        length = np.linalg.norm(directions, axis=-1)
        cosine = np.einsum("...i,...i->...", hits["normal"], directions) / np.where(length > 0, length, 1)
        colors = np.where((hits["side"] == 1)[..., np.newaxis], BACK, SURFACE)
        colors = colors * (0.25 + 0.75 * np.minimum(np.abs(cosine), 1.0))[..., np.newaxis]
        colors[hits["status"] != Status.OK] = BACKGROUND
        return np.round(255.0 * colors).astype(np.uint8)

    def _view(self, width: int, height: int) -> Ray:
        low, high = np.asarray(self.bounds, np.float64)  # type: ignore[attr-defined]
        if not np.isfinite([low, high]).all():  # of nothing
            low = high = np.zeros(3)
        middle, radius = (low + high) / 2, np.linalg.norm(high - low) / 2 or 1.0
        narrow = np.arctan(np.tan(np.radians(20.0)) * min(1.0, width / height))
        eye = middle + _unit(np.array([0.6, -1.0, 0.7]), "") * radius / np.sin(narrow)
        return pinhole(eye, middle, width=width, height=height)

    def _repr_png_(self) -> bytes:
        return png_of(self.render(width=480, height=360))


def _unit(vector: NDArray[Any], mistake: str) -> NDArray[np.float64]:
    length = np.linalg.norm(vector)
    if not length > 0.0:
        raise ValueError(mistake)
    unit: NDArray[np.float64] = vector / length
    return unit
