"""Edges, contacts that are reduced, and contacts with scenes."""

import ctypes

import numpy as np
import pytest

import espalier
from conftest import raises, same
from c_library import structure


@pytest.fixture(scope="module")
def ground():
    """A flat floor with a valley and a ridge, and its blob."""
    x, y = np.meshgrid(np.arange(13), np.arange(13), indexing="ij")
    z = np.select([x == 4, x == 8], [-1, 1], 0)
    positions = np.stack([x, y, z], -1).reshape(-1, 3)
    at = np.arange(169).reshape(13, 13)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    return espalier.bake(positions, np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]), step_exponent=-10,
                         flat_angle=1.0)


def test_edges_are_those_of_c(library, ground, random):
    opened, count = library.opened(ground), ground.triangle_count
    numbers = np.arange(count + 2)
    kinds = ground.edge_kinds(numbers)
    for i in numbers:
        result = library.edge_kinds_of(opened, int(i))
        assert (result.value.ab, result.value.bc, result.value.ca, result.status) == tuple(kinds[i])
    assert set(np.unique(kinds["ab"][:count])) | set(np.unique(kinds["ca"][:count])) == set(espalier.EdgeKind)
    triangles, features = random.integers(0, count, 500), random.integers(0, 7, 500)
    normals = random.uniform(-1, 1, (500, 3)).astype(np.float32)
    fixed = ground.fix_internal_edge_normals(triangles, features, normals)
    for i in range(500):
        theirs = library.fix_internal_edge_normal(opened, int(triangles[i]), int(features[i]), tuple(normals[i]))
        np.testing.assert_array_equal(fixed[i], np.frombuffer(theirs, np.float32))
    assert (fixed != normals).any() and (fixed == normals).all(axis=1).any()
    same(ground.fix_internal_edge_normals(triangles[:5], espalier.Feature.FACE, normals[0]), np.tile(normals[0], (5, 1)))
    raises(ValueError, "features must be", ground.fix_internal_edge_normals, 0, 7, normals[0])


def test_reduced_contacts_are_those_of_c(library, ground):
    x = np.linspace(1.5, 10.5, 40)
    boxes = espalier.OrientedBox(np.stack([x, x, 0 * x + 0.9], -1), np.eye(3))
    lists = ground.contacts(boxes, 0.5, most=64)
    kept = espalier.reduce_contacts(lists)
    assert kept.counts().max() == 4 and lists.counts().max() > 8
    same(kept.status, lists.status)
    for i, (all_of, some) in enumerate(zip(lists.each(), kept.each())):
        theirs = all_of.copy()
        count = library.reduce_contacts(theirs, len(theirs))
        assert count == len(some)
        same(some, theirs[:count])
    raises(TypeError, "lists of CONTACT", espalier.reduce_contacts, ground.closest_triangles([0, 0, 0], 3))


def test_planes_are_those_of_c(library, ground, random):
    opened = library.opened(ground)
    feet = random.uniform([2, 2, 0], [10, 10, 0.5], (200, 3)).astype(np.float32)
    capsules = espalier.Capsule(feet, feet + np.float32([0, 0, 1]), 0.3)
    lists = ground.planes(capsules, 0.5, most=8)
    assert lists.counts().max() > 1
    for i, planes in enumerate(lists.each()):
        theirs = np.zeros(8, espalier.CONTACT_PLANE)
        shape = (*feet[i], *(feet[i] + np.float32([0, 0, 1])), 0.3)
        filled = library.collect_planes(opened, shape, 0.5, theirs, 8)
        assert filled.count == len(planes)
        same(planes, theirs[:filled.count])
    wishes = random.uniform(-1, 1, (200, 3)).astype(np.float32)
    ways = espalier.solve_planes(lists, wishes, 0.01)
    for i, planes in enumerate(lists.each()):
        theirs = library.solve_planes(planes.copy(), len(planes), tuple(wishes[i]), 0.01)
        assert theirs.status == ways["status"][i]
    assert (ways["status"] == espalier.Status.OK).all() and (ways["value"] != wishes).any()
    raises(ValueError, "a list of planes for each wish", espalier.solve_planes, lists, wishes[:5])


def test_contacts_of_touches(library, blob):
    touches = espalier.pairs.touches(blob, blob, espalier.transform(), espalier.transform(translation=[[0.5, 0, 0], [50, 0, 0]]))
    contacts = espalier.pairs.touch_contacts(touches)
    assert contacts.counts()[1] == 0 and contacts.counts()[0] == touches.items["count"].sum() > 0
    first = np.concatenate([[0], np.cumsum(touches.items["count"], dtype=int)])
    for i in range(0, len(touches.items), 97):
        for k in range(touches.items["count"][i]):
            theirs = np.frombuffer(library.contact_of_touch(touches.items[i : i + 1], k), np.uint8)
            same(contacts.items[first[i] + k : first[i] + k + 1], theirs.view(espalier.CONTACT))
    assert espalier.reduce_contacts(contacts).counts().max() <= 4


@pytest.mark.parametrize("is_moving", [False, True])
def test_contacts_of_a_scene_are_those_of_each_instance(ground, is_moving):
    places = espalier.transform([[0, 0, 0, 1], [0, 0, 1, 1], [1, 2, 3, 4]], [[0, 0, 0], [0, 0, 3], [5, 0, 1]], [1, 2, 0.5])
    if is_moving:
        scene = espalier.MovingScene([ground], 8, -16)
        scene.insert(places)
    else:
        scene = espalier.bake_scene([ground], places)
    instances = scene.instances()
    middles = np.random.default_rng(3).uniform(-3, 12, (200, 3)) * [1, 1, 0.2]
    for body in (espalier.Sphere(middles, 1.0), espalier.Capsule(middles, middles + 0.5, 0.75),
                 espalier.OrientedBox(middles, 0.5 * np.eye(3)),
                 espalier.ConvexHull(middles[:, np.newaxis] + np.vstack([np.eye(3), -np.eye(3)]))):
        lists = scene.contacts(body, 0.25, most=500, threads=2)
        assert (lists.status == 0).all() and lists.counts().max() > 10
        for i, found in enumerate(lists.each()):
            assert (np.diff(found["distance"]) >= 0).all()
            for number, instance in enumerate(instances):
                place, scale = instance["transform"], instance["transform"][7]
                part = [np.asarray(field[i] if np.ndim(field) > 1 and len(field) == 200 else field) for field in body]
                local = [espalier.to_local(place, field) if name in ("center", "start", "end", "vertices")
                         else espalier.direction_to_local(place, field) if name == "half_axes" else field / scale
                         for name, field in zip(body._fields, part)]
                own = ground.contacts(type(body)(*local), np.float32(0.25) / scale, most=500).items
                ours = found[found["instance"] == number]
                assert len(own) == len(ours)
                order = np.lexsort((own["triangle"], own["distance"]))
                np.testing.assert_allclose(np.sort(own["distance"] * scale), np.sort(ours["distance"]), atol=1e-5)
                assert sorted(own["triangle"]) == sorted(ours["triangle"])
                world = espalier.to_world(place, own["point"])[order]
                np.testing.assert_allclose(np.sort(world, axis=0), np.sort(ours["point"], axis=0), atol=1e-4)
    few = scene.contacts(espalier.Sphere(middles, 1.0), 0.25, most=2)
    assert (few.counts() <= 2).all() and (few.status == espalier.Status.OUTPUT_FULL).any()
    assert not np.isin(scene.contacts(espalier.Sphere(middles, 1.0), only=instances["mesh"] < 0).counts(), [1, 2]).any()
    assert (scene.contacts(espalier.Sphere(middles, -1.0)).status == espalier.Status.INVALID_ARGUMENT).all()
    assert espalier.reduce_contacts(scene.contacts(espalier.Sphere(middles, 1.0), most=64)).counts().max() <= 4


def test_contacts_of_a_tile_are_those_of_its_instances(ground):
    tile = espalier.bake_scene([ground], espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    town = espalier.bake_scene([tile, ground], espalier.transform(translation=[[0, 50, 0], [0, 0, 0]]), [0, 1])
    moving = espalier.MovingScene([ground], 4, -16, tiles=[tile])
    moving.insert(espalier.transform(translation=[[0, 50, 0], [0, 0, 0]]), [1, 0])
    for scene in (town, moving):
        found = scene.contacts(espalier.Sphere([21.3, 51.4, 0.5], 1.0), most=64)
        alone = ground.contacts(espalier.Sphere([1.3, 1.4, 0.5], 1.0), most=64)
        assert len(found.items) == len(alone.items) > 0 and (found.items["in_tile"] == 1).all()
        np.testing.assert_allclose(found.items["distance"], alone.items["distance"], atol=1e-5)
        near = scene.candidates(espalier.Box([21, 51, -1], [22, 52, 1]))
        assert (near.items["in_tile"] != espalier.NO_TRIANGLE).any()


def test_candidates_are_those_of_c(library, ground):
    scene = espalier.MovingScene([ground], 64, -10)
    handles = scene.insert(espalier.transform(translation=np.arange(30)[:, np.newaxis] * [4.0, 0, 0]), masks=1 + np.arange(30) % 2)
    low = np.arange(40)[:, np.newaxis] * [3.0, 0, 0] - 1
    for mask in (1, 3):
        lists = scene.candidates(espalier.Box(low, low + 2), mask=mask)
        boxes = scene.boxes(handles)
        touch = ((boxes["min"] <= (low + 2)[:, np.newaxis]) & (boxes["max"] >= low[:, np.newaxis])).all(axis=2)
        touch &= (scene.instances()["mask"] & mask) != 0
        for i, found in enumerate(lists.each()):
            assert set(np.flatnonzero(touch[i])) <= set(found["instance"]) and (np.diff(found["instance"]) > 0).all()
    raises(TypeError, "candidates", scene.candidates, espalier.Sphere([0, 0, 0], 1))
    stale = handles.copy()
    stale["generation"] += 1
    assert (scene.boxes(stale)["status"] == espalier.Status.STALE_HANDLE).all()
