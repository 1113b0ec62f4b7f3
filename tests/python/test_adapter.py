"""The example that has the shape of trimesh."""

import pathlib
import sys
import types

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "python"))
import as_trimesh  # noqa: E402


@pytest.fixture(scope="module")
def baked(mesh):
    return as_trimesh.bake_trimesh(types.SimpleNamespace(vertices=mesh[0].astype(float), faces=mesh[1].astype(int)))


def test_rays(baked, mesh, points, directions):
    good = np.isfinite(points).all(axis=1) & (np.abs(points) < 100).all(axis=1) & (np.abs(directions).max(axis=1) > 0)
    points, directions = points[good], directions[good]
    rays = as_trimesh.Rays(baked)
    first = rays.intersects_first(points, directions)
    np.testing.assert_array_equal(rays.intersects_any(points, directions), first >= 0)
    places, numbers, triangles = rays.intersects_location(points, directions, multiple_hits=False)
    np.testing.assert_array_equal(triangles, first[numbers])
    corners = mesh[0][mesh[1][triangles]].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert np.abs(np.einsum("ij,ij->i", places - corners[:, 0], normals)).max() < 0.001
    many = rays.intersects_location(points, directions)
    odd = np.bincount(many[1], minlength=len(points)) % 2 == 1
    off_surface = baked.closest_point(points)["distance"] > 0.001
    np.testing.assert_array_equal(odd[off_surface], rays.contains_points(points)[off_surface])


def test_proximity_and_collisions(baked):
    proximity = as_trimesh.Proximity(baked)
    places, distances, _ = proximity.on_surface([[3, 0, 0], [0, 0, 0]])
    assert distances.shape == (2,) and places.shape == (2, 3)
    assert (np.sign(proximity.signed_distance([[3, 0, 0], [0, 0, 0]])) == [1, -1]).all()
    manager = as_trimesh.Collisions()
    manager.add_object("torus", baked)
    away = np.eye(4)
    away[0, 3] = 20
    assert manager.in_collision_single(baked) and not manager.in_collision_single(baked, away)
    assert 11 < manager.min_distance_single(baked, away) < 13
