"""Scenes against a loop over their instances."""

import pickle

import numpy as np
import pytest

import espalier
from conftest import raises, same


@pytest.fixture(scope="module")
def places():
    random = np.random.default_rng(7)
    return espalier.transform(random.uniform(-1, 1, (12, 4)), random.uniform(-20, 20, (12, 3)),
                              random.uniform(0.5, 2, 12))


@pytest.fixture(scope="module")
def scene(blob, places):
    return espalier.bake_scene([blob], places, masks=1 << np.arange(12), users=np.arange(12) * 10)


def test_rays_equal_a_loop(scene, blob, places, random):
    origins = random.uniform(-20, 20, (500, 3)).astype(np.float32)
    directions = random.uniform(-1, 1, (500, 3)).astype(np.float32)
    hits = scene.raycast(origins, directions, threads=2)
    each = blob.raycast(espalier.to_local(places[:, None], origins), espalier.direction_to_local(places[:, None], directions))
    best = each["t"].argmin(axis=0)
    found = hits["status"] == espalier.Status.OK
    assert found.any()
    same(hits["t"], each["t"].min(axis=0))
    np.testing.assert_array_equal(scene.instances()["source"][hits["instance"][found]], best[found])
    np.testing.assert_array_equal(scene.occluded(origins, directions).yes, found)
    lists = scene.all_hits(origins, directions)
    np.testing.assert_array_equal(lists.counts(), (blob_counts(blob, places, origins, directions)).sum(axis=0))
    same(scene.raycast(origins, directions, mask=1)["t"], each["t"][0])


def blob_counts(blob, places, origins, directions):
    return blob.all_hits(espalier.to_local(places[:, None], origins),
                         espalier.direction_to_local(places[:, None], directions)).counts()


def test_points_sweeps_and_volumes(scene, random):
    points = random.uniform(-20, 20, (200, 3)).astype(np.float32)
    closest = scene.closest_point(points)
    touching = scene.overlaps(espalier.Sphere(points, 2.0))
    margin = np.abs(closest["distance"] - 2) > 1e-3
    np.testing.assert_array_equal(touching.yes[margin], (closest["distance"] < 2)[margin])
    lists = scene.overlapping_triangles(espalier.Sphere(points, 2.0))
    np.testing.assert_array_equal(lists.counts() > 0, touching.yes)
    moved = scene.sweep(espalier.Sphere(points, 0.5), closest["point"] - points)
    assert (moved["status"] == 0).all() and (moved["t"] < 1).all()
    kept = scene.sweep(espalier.Sphere(points, 0.5), closest["point"] - points, skin=0.1)
    same(kept["point"], moved["point"])
    assert (kept["t"] <= moved["t"]).all() and (kept["t"] < moved["t"]).any()
    front = scene.sweep(espalier.Sphere(points, 0.5), closest["point"] - points, culling="front")
    assert (front["triangle"] != moved["triangle"]).any()
    boxes = espalier.Box(points - 0.5, points + 0.5)
    axes = np.broadcast_to(0.5 * np.eye(3, dtype=np.float32), (200, 3, 3))
    signs = 0.5 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    ways = 2 * (closest["point"] - points)
    moved = scene.sweep(boxes, ways)
    assert (moved["status"] == 0).all() and (moved["t"] < 0.5).all()
    turned = scene.sweep(espalier.OrientedBox(points, axes), ways)
    np.testing.assert_allclose(turned["t"], moved["t"], atol=1e-5)
    hulls = scene.sweep(espalier.ConvexHull(points[:, None] + signs), ways)
    np.testing.assert_allclose(hulls["t"], moved["t"], atol=1e-5)
    raises(TypeError, "", scene.sweep, espalier.Cone(points, points, 1.0), ways)


def test_instances_bytes_and_refusals(scene, blob, places):
    instances = scene.instances()
    np.testing.assert_array_equal(instances["transform"], places[instances["source"]])
    np.testing.assert_array_equal(instances["user"], instances["source"] * 10)
    assert sorted(instances["source"]) == list(range(12)) and scene.instance_count == 12
    assert bytes(scene.mesh(0)) == bytes(blob) and scene.mesh_count == 1
    assert bytes(pickle.loads(pickle.dumps(scene))) == bytes(scene)
    raises(espalier.OpenError, "", espalier.open_scene, bytes(blob))
    raises(espalier.BakeError, "", espalier.bake_scene, [blob], places, 1)
    raises(espalier.BakeError, "", espalier.bake_scene, [b"nothing"], places)
    raises(IndexError, "", scene.mesh, 1)


def test_transforms():
    matrix = np.eye(4)
    matrix[:3, 3] = [1, 2, 3]
    matrix[:3, :3] *= 2
    place = espalier.transform_from_matrix([matrix, matrix])
    np.testing.assert_allclose(place[0], [0, 0, 0, 1, 1, 2, 3, 2])
    np.testing.assert_allclose(espalier.to_world(place, [1, 1, 1]), [[3, 4, 5]] * 2)
    np.testing.assert_allclose(espalier.direction_to_world(place, [1, 1, 1]), [[2, 2, 2]] * 2)
    np.testing.assert_allclose(espalier.direction_to_local(place, [2, 2, 2]), [[1, 1, 1]] * 2)
    matrix[0] *= -1
    raises(ValueError, "no transform", espalier.transform_from_matrix, matrix)
