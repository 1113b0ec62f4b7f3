"""A mesh as arrays."""

from __future__ import annotations

from typing import NamedTuple, Optional

from numpy.typing import ArrayLike


class Mesh(NamedTuple):
    """A mesh of several that are baked into one blob."""

    positions: ArrayLike
    """(n, 3), in the source's units"""
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
