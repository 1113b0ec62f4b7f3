"""Borders of a scene's instances that part from each other."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Optional

import numpy as np
from numpy.typing import NDArray

from . import _core
from .transforms import to_world

if TYPE_CHECKING:
    from .scenes import Scene

CELL_SHARE = 2.0**-20
"""Edges of two instances are one if their middles are as near as this share of the scene, or as rounding moves them."""


def border_warning(scene: Scene) -> Optional[str]:
    """Returns a warning where instances share edges of their borders with others, from which the bake may have moved them.

    A border edge is one of a single triangle, on a side of its mesh's box. Two that meet part unless both are on the
    scene's common lattice.
    """
    on_lattice = scene.is_on_common_lattice()
    if scene.instance_count < 2 or on_lattice.all():
        return None
    instances = scene._core.instances()  # which place what blobs count from their origins, from that of the scene
    borders = {int(mesh): _border_of(_core.all_triangles(scene._core.mesh(int(mesh))))
               for mesh in np.unique(instances["mesh"]) if mesh < scene.mesh_count}
    owners, middles = [], []
    for number, (place, mesh) in enumerate(zip(instances["transform"], instances["mesh"])):
        if len(border := borders.get(int(mesh), _NONE)):
            owners.append(np.full(len(border), number))
            middles.append(to_world(place, border).astype(np.float64))
    if not owners:
        return None
    apart = _apart(np.concatenate(owners), np.concatenate(middles), on_lattice, scene)
    if apart == 0:
        return None
    return (f"{apart} {'instance shares' if apart == 1 else 'instances share'} border edges with others, and instances are "
            f"rounded apart from each other: a ray can pass through gaps of up to {2 * scene.max_error:.3g}. Bake the blobs "
            "with one step_exponent whose step divides all their positions, or all meshes as one blob.")


_NONE = np.zeros((0, 3), np.float32)


def _border_of(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    """Returns the middles of the edges of one triangle that lie in a side of the box."""
    if len(corners) == 0:
        return _NONE
    corners = corners + np.float32(0)  # -0 as 0
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    edges = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    on_side = ((edges == low).all(axis=1) | (edges == high).all(axis=1)).any(axis=1)
    edges = edges[on_side]
    keys = edges.view(np.uint32)
    first = np.array([tuple(a) <= tuple(b) for a, b in keys.tolist()], bool)
    keys = np.where(first[:, np.newaxis, np.newaxis], keys, keys[:, ::-1]).reshape(-1, 6)
    _, index, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return edges[index[count == 1]].mean(axis=1, dtype=np.float64).astype(np.float32)


def _apart(owners: NDArray[np.int64], middles: NDArray[np.float64], on_lattice: NDArray[np.bool_], scene: Scene) -> int:
    """Returns how many instances have an edge at the place of another one's that part."""
    extent = float((scene.bounds[1] - scene.bounds[0]).max())
    cell = 4 * max(extent * CELL_SHARE, 2 * scene.max_error, extent * 2.0**-22)
    is_apart = np.zeros(len(on_lattice), bool)
    for shift in product((0.0, 0.5), repeat=3):  # two middles within a quarter of a cell are in one cell of some grid
        _, group = np.unique(np.floor(middles / cell + shift), axis=0, return_inverse=True)
        count = int(group.max()) + 1
        lowest, highest = np.full(count, len(on_lattice)), np.full(count, -1)
        np.minimum.at(lowest, group, owners)
        np.maximum.at(highest, group, owners)
        exact = np.ones(count, bool)
        np.logical_and.at(exact, group, on_lattice[owners])
        is_apart[owners[((lowest != highest) & ~exact)[group]]] = True
    return int(is_apart.sum())
