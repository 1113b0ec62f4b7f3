"""How the surface bends at edges, and contacts that it leaves out or turns there."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .integers import triangle_numbers
from .results import CONTACT, Lists


class EdgeQueries:
    """Queries of edges, for blobs that were baked with `flat_angle`."""

    __slots__ = ()
    _core: _core.Blob

    def edge_kinds(self, triangles: ArrayLike, *, threads: int = 1) -> NDArray[Any]:
        """Returns the kinds of the edges of triangles, between the corners of corners(): an array of EDGE_KINDS.

        Without edge flags the status is NO_DATA.
        """
        return _core.edge_kinds(self._core, triangle_numbers(triangles), threads)

    def fix_internal_edge_normals(self, triangles: ArrayLike, features: ArrayLike, normals: ArrayLike, *,
                                  threads: int = 1) -> NDArray[np.float32]:
        """Returns the normals to use for contacts on features of triangles, (..., 3).

        triangles: (...), features: (...), of Feature, as closest_triangles() returns both. normals: (..., 3), of any
        length, from the surface to the body. On an internal edge, flat or a valley on the side of the normal, that of
        the triangle on that side replaces it; else it stays. contacts() does this by itself.
        """
        numbers, parts = triangle_numbers(triangles), np.asarray(features)
        if parts.size and (parts.dtype.kind not in "iu" or parts.min() < 0 or parts.max() > 6):
            raise ValueError("features must be integers from 0 to 6, of espalier.Feature")
        given = np.asarray(normals)
        shape = np.broadcast_shapes(numbers.shape, parts.shape, given.shape[:-1])
        numbers = np.ascontiguousarray(np.broadcast_to(numbers, shape))
        parts = np.ascontiguousarray(np.broadcast_to(parts.astype(np.uint8), shape))
        return _core.fixed_normals(self._core, numbers, parts, np.broadcast_to(given, (*shape, *given.shape[-1:])), threads)


def reduce_contacts(contacts: Lists) -> Lists:
    """Returns of each list of contacts() of a blob or a scene the contacts that support its body best, at most 4.

    The deepest comes first. Of a body that lies on many triangles, a solver needs no more.
    """
    items = contacts.items
    if not set(CONTACT.names or ()) <= set(items.dtype.names or ()):
        raise TypeError(f"contacts must be lists of CONTACT, not of {items.dtype}")
    alone = np.zeros(len(items), CONTACT)
    for name in CONTACT.names or ():
        alone[name] = items[name]
    if items["point"].dtype == np.float64:  # of a blob with an origin; only where points lie to each other counts
        alone["point"] = items["point"] - items["point"][:1]
    offsets, kept = _core.kept_contacts(contacts.offsets, alone)
    return Lists(offsets, items[kept], contacts.status)
