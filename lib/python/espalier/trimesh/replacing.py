"""Replacing trimesh's own back ends."""

from __future__ import annotations

import importlib
from typing import Any

from . import collision, proximity, ray

_REPLACED: dict[str, dict[str, Any]] = {
    "trimesh.ray.ray_triangle": {"RayMeshIntersector": ray.RayMeshIntersector},
    "trimesh.ray.ray_pyembree": {"RayMeshIntersector": ray.RayMeshIntersector},
    "trimesh.proximity": {"closest_point": proximity.closest_point, "signed_distance": proximity.signed_distance,
                          "ProximityQuery": proximity.ProximityQuery},
    "trimesh.collision": {"CollisionManager": collision.CollisionManager},
}
_own: dict[tuple[Any, str], Any] = {}


def install() -> None:
    """Replaces trimesh's rays, proximity and collisions: for meshes and managers that are made from now on.

    trimesh.proximity's other functions, such as thickness(), then take espalier too. Raises ImportError without
    trimesh. Installing again does nothing.
    """
    importlib.import_module("trimesh")
    for name, replacements in _REPLACED.items():
        try:
            module = importlib.import_module(name)
        except ImportError:  # trimesh's own back end has its needs, such as embreex
            continue
        for attribute, replacement in replacements.items():
            if hasattr(module, attribute) and (module, attribute) not in _own:
                _own[module, attribute] = getattr(module, attribute)
                setattr(module, attribute, replacement)


def uninstall() -> None:
    """Gives trimesh its own back ends back. Meshes that were made meanwhile keep espalier."""
    for (module, attribute), own in _own.items():
        setattr(module, attribute, own)
    _own.clear()
