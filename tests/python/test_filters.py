"""Flags of triangles and of instances against the filters of C, bit for bit, and against masks."""

import numpy as np
import pytest

import espalier
from c_library import SCENE_FILTER, TRIANGLE_FILTER, MovingScene, ray
from conftest import codes, raises, same
from test_bits import of, volumes
from test_moving_scenes import some_places

OK = espalier.Status.OK


@pytest.fixture
def flags(blob, random):
    return random.uniform(size=blob.triangle_count) < 0.3


@pytest.mark.parametrize("threads", [1, 2])
def test_rays(library, blob, points, directions, flags, threads):
    opened = library.opened(blob)
    keep = TRIANGLE_FILTER(lambda triangle, user: bool(flags[triangle]))
    rays = [ray(points[i], directions[i], culling=1) for i in range(len(points))]
    keywords = dict(culling="back", only=flags, threads=threads)
    hits = blob.raycast(points, directions, **keywords)
    same(hits, library.each("raycast_filtered", len(points), lambda i: (opened, rays[i], keep, None)))
    found = hits["status"] == OK
    assert found.sum() > 100 and flags[hits["triangle"][found]].all()
    same(blob.raycast(points, directions, culling="back", only=flags.astype(np.uint8) * 7), hits)
    same(blob.raycast_sources(points, directions, **keywords).hits, hits)
    same(codes(blob.occluded(points, directions, **keywords)),
         library.each("occluded_filtered", len(points), lambda i: (opened, rays[i], keep, None)))
    lists = blob.closest_hits(points, directions, 3, **keywords)
    for i in range(0, len(points), 3):
        expected = np.zeros(3, espalier.RAY_HIT)
        filled = library.closest_hits_filtered(opened, rays[i], expected, 3, keep, None)
        assert filled.status == lists.status[i]
        same(lists.items[lists.offsets[i] : lists.offsets[i + 1]], expected[: filled.count])


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box"])
def test_sweeps(library, blob, points, directions, random, flags, kind):
    shape = volumes(points, random)[kind]
    keep = TRIANGLE_FILTER(lambda triangle, user: bool(flags[triangle]))
    hits, opened = blob.sweep(shape, directions, only=flags), library.opened(blob)
    same(hits, library.each(f"sweep_{kind}_filtered", len(points), lambda i: (opened, of(shape, i), directions[i], keep, None)))
    assert (hits["status"] == OK).sum() > 100


def test_flags_of_a_moving_scene(library, blob, random, points, directions):
    scene, theirs = espalier.MovingScene([blob], 64), MovingScene(library, library.opened(blob), 64, -10)
    given = np.zeros(40, espalier.INSTANCE)
    given["transform"], given["mask"] = some_places(random, 40), 0xFFFFFFFF
    scene.insert(given["transform"])
    for each in np.split(given, 40):
        theirs.insert(each)
    only = np.arange(40) % 3 == 0
    keep = SCENE_FILTER(lambda instance, triangle, user: bool(only[instance.index]))
    view, filter = theirs.view(), (0xFFFFFFFF, keep, None)
    rays = [ray(points[i], directions[i]) for i in range(len(points))]
    hits = scene.raycast(points, directions, only=only, threads=2)
    same(hits, library.each("scene_raycast", len(points), lambda i: (view, rays[i], *filter)))
    assert (hits["status"] == OK).sum() > 200
    shape = volumes(points, random)["sphere"]
    same(scene.sweep(shape, directions, only=only),
         library.each("scene_sweep_sphere", len(points), lambda i: (view, of(shape, i), directions[i], *filter)))
    same(codes(scene.overlaps(shape, only=only)),
         library.each("scene_overlaps_sphere", len(points), lambda i: (view, of(shape, i), *filter)))


@pytest.mark.parametrize("is_moving", [False, True])
def test_flags_of_instances_equal_masks(blob, random, points, directions, is_moving):
    places, masks = some_places(random, 40), np.where(np.arange(40) % 3 == 0, 2, 1)
    if is_moving:
        scene = espalier.MovingScene([blob], 64)
        scene.insert(places, masks=masks)
    else:
        scene = espalier.bake_scene([blob], places, masks=masks)
    only, shape = scene.instances()["mask"] == 2, espalier.Sphere(points, 0.5)
    every = np.ones(40, bool)
    for query, given in ((scene.raycast, (points, directions)), (scene.occluded, (points, directions)),
                         (scene.all_hits, (points, directions)), (scene.sweep, (shape, directions)),
                         (scene.overlaps, (shape,)), (scene.overlapping_triangles, (shape,))):
        for ours, theirs in ((query(*given, only=only), query(*given, mask=2)),
                             (query(*given, mask=2, only=every), query(*given, mask=2)),
                             (query(*given, only=every), query(*given))):
            if isinstance(ours, espalier.Lists):
                np.testing.assert_array_equal(ours.offsets, theirs.offsets)
                same(ours.items, theirs.items)
                assert len(ours.items) > 100
            else:
                same(getattr(ours, "status", ours), getattr(theirs, "status", theirs))
    none = scene.raycast(points, directions, only=np.zeros(40, bool))["status"]
    assert not (none == OK).any()


def test_flags_of_sources(blob, mesh, points, directions, random):
    of_sources = random.uniform(size=len(mesh[1])) < 0.5
    only = of_sources[blob.remap["triangle"]]
    np.testing.assert_array_equal(only, of_sources[blob.original_triangles(np.arange(blob.triangle_count))["triangle"]])
    view = blob.raycast_sources(points, directions, only=only)
    found = view.hits["status"] == OK
    assert found.any() and of_sources[view.sources["triangle"][found]].all()


def test_strides_and_messages(blob, flags, points, directions):
    wide = np.zeros((len(flags), 2), bool)
    wide[:, 1] = flags
    same(blob.raycast(points, directions, only=wide[:, 1]), blob.raycast(points, directions, only=flags))
    same(blob.raycast(points, directions, only=flags.tolist()), blob.raycast(points, directions, only=flags))
    scene = espalier.bake_scene([blob], espalier.transform()[None])
    for query in (blob.raycast, blob.raycast_sources, blob.occluded, scene.raycast, scene.occluded, scene.all_hits,
                  lambda *given, only: blob.closest_hits(*given, 2, only=only),
                  lambda points, ways, only: blob.sweep(espalier.Sphere(points), ways, only=only),
                  lambda points, ways, only: scene.sweep(espalier.Sphere(points), ways, only=only),
                  lambda points, ways, only: scene.overlaps(espalier.Sphere(points), only=only),
                  lambda points, ways, only: scene.overlapping_triangles(espalier.Sphere(points), only=only)):
        raises(ValueError, "only must have a flag for each of the", query, points, directions, only=np.ones(7, bool))
        raises(TypeError, "bool or uint8, not float64", query, points, directions, only=np.ones(len(flags)))
        raises(TypeError, r"not int64; from numbers: flags = np.zeros", query,
               points, directions, only=np.flatnonzero(flags))
    raises(ValueError, rf"{blob.triangle_count} triangles, .* not \(1, {blob.triangle_count}\)", blob.raycast,
           points, directions, only=flags[None])
