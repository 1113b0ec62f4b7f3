"""Meshes far from 0, whose coordinates float32 does not hold: all places are in the coordinates of the source."""

import itertools
import pickle
import warnings

import numpy as np
import pytest

import espalier
from conftest import raises, same

PLACE = np.array([500123.4567, 5400321.123, 612.3])  # UTM, where float32 has steps of half a metre
NEAR = 0.002  # the tolerance of the bakes is half of it


def cube(middle, half=2.0):
    corners = np.array(list(itertools.product((-half, half), repeat=3)))
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
             [1, 5, 7], [1, 7, 3]]
    return corners + middle, faces


def bake(middle, **options):
    return espalier.bake(*cube(np.asarray(middle)), tolerance=0.001, flat_angle=5.0, bounds=True, original_ids=True, **options)


@pytest.fixture(scope="module")
def far():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return bake(PLACE)


@pytest.fixture(scope="module")
def near():
    return bake(np.zeros(3))


@pytest.fixture
def local(random):
    return random.uniform(-4, 4, (500, 3))


def close(places, expected):
    """Tests whether places are float64 and within 2 mm of others."""
    places = np.asarray(places)
    assert places.dtype == np.float64 and places.shape[-1] == 3
    assert np.abs(places - expected).max(initial=0) < NEAR


def test_an_origin_is_chosen_and_kept(far, near, tmp_path):
    assert np.abs(far.origin - PLACE).max() < 16 and far.origin.dtype == np.float64
    assert far.report["origin"] == tuple(far.origin) == far.info()["origin"] and far.max_error <= 0.001
    far.save(tmp_path / "far.espl")
    for again in (espalier.open_blob(tmp_path / "far.espl"), espalier.open_blob(bytes(far)), pickle.loads(pickle.dumps(far))):
        np.testing.assert_array_equal(again.origin, far.origin)
        same(again.closest_point(PLACE + [0, 0, 3]), far.closest_point(PLACE + [0, 0, 3]))
        same(again.bounds, far.bounds)
    espalier.verify(far)
    assert near.origin.tolist() == [0, 0, 0] and near.report["origin"] == (0, 0, 0)


def test_without_an_origin_all_is_as_before(near, mesh, points, directions):
    assert bytes(bake(np.zeros(3), origin=None)) == bytes(bake(np.zeros(3), origin=(0, 0, 0))) == bytes(near)
    plain, chosen = espalier.bake(*mesh, origin=None), espalier.bake(mesh[0].astype(np.float64), mesh[1])
    assert bytes(plain) == bytes(chosen)
    assert near.bounds.dtype == near.triangles().dtype == near.corners(0)["corners"].dtype == np.float32
    assert near.bounding_sphere().center.dtype == near.oriented_bounds().center.dtype == near.k_dop_bounds().low.dtype == np.float32
    assert near.closest_point(points).dtype == espalier.CLOSEST_POINT
    assert near.sweep(espalier.Sphere(points, 0.1), directions).dtype == espalier.SWEEP_HIT
    assert near.contacts(espalier.Sphere(points, 0.1)).items.dtype == espalier.CONTACT
    assert espalier.pairs.distance(near, near).dtype == espalier.BLOB_DISTANCE
    assert espalier.pairs.touches(near, near).items.dtype == espalier.PAIR_TOUCH


def test_rays(far, random):
    across = random.uniform(-1.9, 1.9, (300, 2))
    above = np.concatenate([across, np.full((300, 1), 9.0)], axis=1)
    hits, points, sources = far.raycast_sources(PLACE + above, [0, 0, -1])
    assert (hits["status"] == 0).all() and np.abs(hits["t"] - 7).max() < NEAR and set(sources["triangle"]) == {10, 11}
    close(points, PLACE + above - [0, 0, 7])
    assert np.isnan(far.raycast_sources(PLACE + [9, 9, 9], [0, 0, 1]).points).all()
    same(far.raycast(PLACE + above, [0, 0, -1]), hits)
    assert far.occluded(PLACE + above, [0, 0, -1]).yes.all() and far.occluded(PLACE + above, [0, 0, 1]).no.all()
    assert far.occluded(PLACE + above, [0, 0, -1], accuracy=0.01).yes.all()
    for name in ("all_hits", "crossings"):
        lists = getattr(far, name)(PLACE + above, [0, 0, -1])
        np.testing.assert_allclose(np.sort(lists.items["t"].reshape(-1, 2)), np.tile([7.0, 11.0], (300, 1)), atol=NEAR)
    assert np.abs(far.closest_hits(PLACE + above, [0, 0, -1], 1).items["t"] - 7).max() < NEAR
    assert not (far.raycast(above, [0, 0, -1])["status"] == 0).any()  # the numbers of the blob itself are nowhere here
    rounded = far.rounding_error(espalier.Ray(PLACE + above, [0, 0, -1]))
    assert (rounded["status"] == 0).all() and rounded["value"].max() < 0.001


def on_cube(local):
    """Returns the points of the cube's surface that are closest to others outside of it."""
    return np.clip(local, -2, 2)


def test_points(far, local):
    outside = local[np.abs(local).max(axis=1) > 2.1]
    assert len(outside) > 100
    for found in (far.closest_point(PLACE + outside), far.signed_distance(PLACE + outside, threads=2),
                  far.closest_triangles(PLACE + outside, 1).items):
        assert (found["status"] == 0).all() and found["distance"].dtype == found["face_normal"].dtype == np.float32
        close(found["point"], PLACE + on_cube(outside))
        close(found["on_shape"], PLACE + outside)
        np.testing.assert_allclose(found["distance"], np.linalg.norm(outside - on_cube(outside), axis=1), atol=NEAR)
    one = far.closest_point(PLACE + [0, 0, 3])
    assert one.shape == ()
    close(one["point"], PLACE + [0, 0, 2])
    for shape in (espalier.Segment(PLACE + [0.5, 0, 3], PLACE + [0.5, 0, 4]),
                  espalier.Box(PLACE + [0.5, 0, 3], PLACE + [0.5, 0, 4])):
        found = far.closest_point(shape)
        close(found["point"], PLACE + [0.5, 0, 2])
        close(found["on_shape"], PLACE + [0.5, 0, 3])
    clear = np.abs(np.abs(local).max(axis=1) - 2) > NEAR
    inside = np.abs(local).max(axis=1) < 2
    assert (far.contains(PLACE + local).yes == inside)[clear].all() and inside.sum() > 20
    assert ((far.winding_number(PLACE + local)["value"] > 0.5) == inside)[clear].all()
    bounds = far.distance_bounds(PLACE + outside, 0.001)
    distance = np.linalg.norm(outside - on_cube(outside), axis=1)
    assert (bounds["lower"] < distance + NEAR).all() and (bounds["upper"] > distance - NEAR).all()
    assert far.rounding_error(PLACE + local)["value"].max() < 0.001


def bodies(middle):
    """Returns shapes around a place that reach 0.25 from it along z."""
    unit = 0.25 * np.eye(3)
    corners = np.concatenate([unit, -unit])
    return {
        "sphere": espalier.Sphere(middle, 0.25),
        "capsule": espalier.Capsule(middle, middle + np.array([0.1, 0, 0]), 0.25),
        "box": espalier.Box(middle - 0.25, middle + 0.25),
        "oriented_box": espalier.OrientedBox(middle, unit),
        "convex_hull": espalier.ConvexHull(middle + corners),
        "triangle": espalier.Triangle(middle + corners[[0, 2, 5]]),
        "cone": espalier.Cone(middle - [0, 0, 0.25], [0, 0, 0.5], 0.1),
        "convex_volume": espalier.ConvexVolume(np.concatenate(
            [np.concatenate([axes, axes @ middle[:, None] + 0.25], axis=1) for axes in (np.eye(3), -np.eye(3))])),
    }


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box", "triangle", "cone", "convex_volume"])
def test_overlaps(far, kind):
    for height, touches in ((2.24, True), (2.26, False)):
        shape = bodies(PLACE + [0.3, 0.4, height])[kind]
        assert bool(far.overlaps(shape).yes) == touches
        assert (far.overlapping_triangles(shape).counts() > 0) == touches
        if kind in ("sphere", "box"):
            assert bool(far.overlaps(shape, accuracy=0.001).yes) == touches
    if kind not in ("cone", "convex_volume"):
        assert far.rounding_error(shape)["status"] == 0


@pytest.mark.parametrize("kind", ["sphere", "capsule", "oriented_box", "convex_hull"])
def test_contacts(far, near, kind):
    local = np.array([0.3, 0.4, 2.2])
    lists = far.contacts(bodies(PLACE + local)[kind], 0.1)
    deepest, expected = lists.items[0], near.contacts(bodies(local)[kind], 0.1).items[0]
    np.testing.assert_allclose([deepest["distance"], expected["distance"]], -0.05, atol=NEAR)
    np.testing.assert_allclose(deepest["normal"], [0, 0, 1], atol=1e-3)
    points = lists.items["point"] - PLACE
    assert points.dtype == np.float64 and np.abs(points[:, 2] - 2).max() < NEAR and np.abs(points[:, :2] - [0.3, 0.4]).max() < 0.5
    kept = espalier.reduce_contacts(lists).items
    assert 1 <= len(kept) <= 4 and kept.dtype == lists.items.dtype and np.isin(kept["point"], lists.items["point"]).all()
    if kind == "oriented_box":  # a face on the surface is held at its corners
        assert len(kept) == 4 and np.ptp(kept["point"][:, :2], axis=0).min() > 0.45


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box", "convex_hull"])
def test_sweeps(far, kind):
    shape = bodies(PLACE + [0.3, 0.4, 6.25])[kind]
    hit = far.sweep(shape, [0, 0, -10])
    assert hit["status"] == 0 and abs(hit["t"] - 0.4) < NEAR / 10
    assert hit["point"].dtype == np.float64 and abs(hit["point"][2] - PLACE[2] - 2) < NEAR
    assert np.abs(hit["point"][:2] - PLACE[:2]).max() < 1
    assert far.rounding_error(shape, [0, 0, -10])["value"] < 0.01


def test_bounds_and_corners(far, near):
    close(far.bounds, PLACE + [[-2] * 3, [2] * 3])
    close(np.sort(far.triangles().reshape(-1, 3), axis=0), PLACE + np.sort(near.triangles().reshape(-1, 3), axis=0))
    corners = far.corners(np.arange(far.triangle_count))
    np.testing.assert_array_equal(corners["corners"], far.triangles())
    close(far.info()["bounds"], far.bounds)
    steps = (far.bounds - far.info()["lattice_origin"]) / 2.0 ** far.info()["lattice_step_exponent"]
    assert np.abs(steps - np.round(steps)).max() < 1e-3 and (steps >= 0).all()
    center, radius = far.bounding_sphere()
    assert np.linalg.norm(far.triangles() - center, axis=-1).max() <= radius + NEAR and radius < 3.6
    middle, axes = far.oriented_bounds()
    assert np.abs(middle - PLACE).max() < 0.05 and axes.dtype == np.float32
    slabs = far.k_dop_bounds()
    along = far.triangles().reshape(-1, 3) @ slabs.directions.T.astype(float)
    assert (along >= slabs.low - NEAR).all() and (along <= slabs.high + NEAR).all() and (slabs.high - slabs.low).max() < 13
    grid, expected = espalier.voxel_grid(far, 0.5), espalier.voxel_grid(near, 0.5)
    assert grid.filled.all() and abs(len(grid.filled) - len(expected.filled)) <= 1
    pixels = far.render(width=32, height=24)
    assert pixels.shape == (24, 32, 3) and (pixels != 255).any()


def test_origins_by_hand(far):
    for origin in (PLACE - [100, 0, 3], (PLACE + 1).tolist(), tuple(np.round(PLACE))):
        blob = bake(PLACE, origin=origin)
        assert blob.origin.tolist() == list(origin) and blob.report["origin"] == tuple(origin)
        close(blob.closest_point(PLACE + [0, 0, 3])["point"], PLACE + [0, 0, 2])
        close(blob.bounds, PLACE + [[-2] * 3, [2] * 3])
    with pytest.warns(espalier.BakeWarning):
        assert not espalier.bake(*cube(PLACE), origin=None).origin.any()
    raises(espalier.BakeError, "choose an origin", bake, PLACE, origin=None)
    assert bytes(bake(PLACE, origin="auto")) == bytes(far)
    many = espalier.bake_meshes([cube(PLACE), cube(PLACE + 5)], tolerance=0.001)
    close(many.bounds, PLACE + [[-2] * 3, [7] * 3])
    for wrong in ("middle", [1, 2], [[1, 2, 3]]):
        raises(ValueError, "origin must be", bake, PLACE, origin=wrong)
    raises(espalier.BakeError, "origin", bake, PLACE, origin=[np.nan, 0, 0])


def test_poses_are_in_the_coordinates_of_the_source():
    positions, faces = cube(PLACE)
    cloth = espalier.bake(positions, faces, tolerance=0.001, deformable=True, origin=np.round(PLACE),
                          range=PLACE + [[-5] * 3, [5] * 3], poses=[positions + 1])
    pose = cloth.refit(positions + [0, 0, 0.5]).blob
    assert pose.origin.tolist() == cloth.origin.tolist() == np.round(PLACE).tolist()
    close(cloth.closest_point(PLACE + [0, 0, 3])["point"], PLACE + [0, 0, 2])
    close(pose.closest_point(PLACE + [0, 0, 3])["point"], PLACE + [0, 0, 2.5])
    assert bytes(pose.refit(positions).blob) == bytes(cloth)
    raises(ValueError, "outside of the range", cloth.refit, positions + 10)
    raises(ValueError, "outside of the range", cloth.refit, positions - cloth.origin)  # it is subtracted once


def test_two_blobs(far, near):
    other = bake(PLACE + [3.9, 0, 0])
    pairs = espalier.pairs
    assert pairs.overlaps(far, other).yes and pairs.overlaps(far, bake(PLACE + [4.01, 0, 0])).no
    assert len(pairs.contacts(far, other).items) > 0 and pairs.first_contact(far, other)["status"] == 0
    touches = pairs.touches(far, other)
    contacts = pairs.touch_contacts(touches)
    assert contacts.items["point"].dtype == touches.items["points"].dtype == np.float64
    assert np.abs(contacts.items["point"] - PLACE).max() < 6
    assert 1 <= espalier.reduce_contacts(contacts).counts() <= 4
    # Places of the source's coordinates: of a turn about its 0, and of shifts.
    shifts = espalier.transform(translation=[[0.5, 0, 0], [0.5, 0.25, 0], [-20, 0, 0]])
    found = pairs.distance(far, other, place_b=shifts)
    np.testing.assert_allclose(found["distance"], [0.4, 0.4, 12.1], atol=NEAR)
    np.testing.assert_allclose(found["on_a"][:, 0] - PLACE[0], [2, 2, -2], atol=NEAR)
    np.testing.assert_allclose(found["on_b"][:, 0] - PLACE[0], [2.4, 2.4, -14.1], atol=NEAR)
    assert pairs.within_distance(far, other, 0.41, place_b=shifts).yes.tolist() == [True, True, False]
    turned = espalier.transform([0, 0, 1, 1]).astype(np.float64)
    found = pairs.distance(far, other, turned, turned)
    assert found["distance"] == 0 and np.abs(found["on_a"] - [-PLACE[1], PLACE[0], PLACE[2]]).max() < 2.1
    # One of the two is near 0.
    back = np.array([0, 0, 0, 1, *([4.25, 0, 0] - PLACE), 1])
    found = pairs.distance(near, far, place_b=back)
    np.testing.assert_allclose(found["distance"], 0.25, atol=NEAR)
    assert abs(found["on_a"][0] - 2) < NEAR and abs(found["on_b"][0] - 2.25) < NEAR
    # What is refused is so as without an origin.
    refused = np.tile(espalier.transform(), (3, 1)).astype(np.float64)
    refused[0, 4], refused[1, :4], refused[2, 7] = np.nan, 0, -1
    assert (pairs.distance(far, other, refused)["status"] == espalier.Status.INVALID_ARGUMENT).all()
    assert (pairs.distance(far, other, place_b=refused)["status"] == espalier.Status.INVALID_ARGUMENT).all()
    raises(ValueError, "place_a must have the shape", pairs.overlaps, far, other, np.zeros(7))
    raises(TypeError, "real numbers", pairs.overlaps, far, other, np.zeros(8, complex))


def test_tiles_are_joined_where_their_sources_are():
    def ground(x):
        positions = np.array([[x, -4, 0], [x + 4, -4, 0], [x + 4, 4, 0], [x, 4, 0]]) + np.round(PLACE) + 0.1
        return espalier.bake(positions, [[0, 1, 2], [0, 2, 3]], step_exponent=-10, flat_angle=5, origin=np.round(PLACE) + [x, 0, 0])

    tiles = [ground(-4), ground(0)]
    ball = lambda x: espalier.Sphere(np.round(PLACE) + 0.1 + [x, 0, 0.24], 0.25)
    leaning = lambda both: max(np.abs(tile.contacts(ball(x), 0.05).items["normal"][:, 0]).max(initial=0)
                               for tile, x in zip(both, (0.1, -0.1)))
    assert leaning(tiles) > 0.1
    joined = espalier.join_borders(tiles)
    assert leaning(joined) < 1e-6 and all(np.array_equal(a.origin, b.origin) for a, b in zip(joined, tiles))
    apart = [tiles[0], espalier.bake(tiles[1].triangles().reshape(-1, 3), np.arange(6).reshape(2, 3), step_exponent=-10,
                                     flat_angle=5, origin=tiles[1].origin + [0.0001, 0, 0])]
    raises(espalier.BakeError, "blob 1 does not lie", espalier.join_borders, apart)


def test_scenes_place_the_source_and_have_an_origin(far, near, tmp_path, points):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        places = espalier.transform(translation=[[0, 0, 0], PLACE + [8, 0, 0]], dtype=np.float64)
        scene = espalier.bake_scene([far, near], places, [0, 1])
    assert np.abs(scene.origin - PLACE).max() < 32 and scene.max_error < NEAR
    scene.save(tmp_path / "scene.espl")
    for each in (scene, espalier.open_scene(tmp_path / "scene.espl"), pickle.loads(pickle.dumps(scene))):
        np.testing.assert_array_equal(each.origin, scene.origin)
        found = each.closest_point(PLACE + [[0, 0, 3], [8, 0, 3]])
        assert found["instance"].tolist() == [0, 1]
        close(found["point"], PLACE + [[0, 0, 2], [8, 0, 2]])
    low, high = scene.bounds - PLACE  # around boxes, which are larger
    assert scene.bounds.dtype == np.float64 and (low < -1.99).all() and (high > [9.99, 1.99, 1.99]).all() and high.max() < 16
    assert np.abs(scene.raycast(PLACE + [8, 0, 9], [0, 0, -1])["t"] - 7) < NEAR
    ball = espalier.Sphere(PLACE + [8, 0, 2.24], 0.25)
    assert scene.overlaps(ball).yes and set(scene.overlapping_triangles(ball).items["instance"]) == {1}
    assert set(scene.candidates(espalier.Box(PLACE + [7, 0, 0], PLACE + [9, 1, 1])).items["instance"]) == {1}
    close(scene.sweep(espalier.Sphere(PLACE + [8, 0, 5], 0.25), [0, 0, -5])["point"], PLACE + [8, 0, 2])
    close(scene.contacts(ball).items["point"], PLACE + [8, 0, 2])
    close(scene.instances()["transform"][:, 4:7], [far.origin, PLACE + [8, 0, 0]])
    same(scene.mesh(0).closest_point(PLACE + [0, 0, 3]), far.closest_point(PLACE + [0, 0, 3]))
    assert scene.render(width=8, height=6).min() < 255
    again = espalier.bake_scene([scene], espalier.transform())  # as a tile
    close(again.closest_point(PLACE + [8, 0, 3])["point"], PLACE + [8, 0, 2])
    moving = espalier.MovingScene([far], 4, -6, tiles=[scene]).seen_from(PLACE)
    moving.insert(espalier.transform(translation=scene.origin), 1)
    close(moving.closest_point(PLACE + [8, 0, 3])["point"], PLACE + [8, 0, 2])
    bodies = espalier.MovingScene([near], 4, -7)
    view = bodies.seen_from(scene.origin)  # the one view that counts as the baked scene does
    np.testing.assert_array_equal(view.origin, scene.origin)
    view.insert(espalier.transform(translation=PLACE + [11, 0, 0], dtype=np.float64))
    assert view.colliding_pairs(scene).items["instance"].tolist() == [1]
    for other in (bodies, view.seen_from(PLACE + 4000)):  # which take that view themselves
        assert other.colliding_pairs(scene).items["instance"].tolist() == [1]
        assert other.candidate_pairs(scene).items["instance"].tolist() == [1]
    coarse = espalier.MovingScene([near], 4, 0)  # whose views count from multiples of 128
    odd = espalier.bake_scene([near], espalier.transform(translation=PLACE, dtype=np.float64), origin=PLACE)
    assert coarse.colliding_pairs(odd).status == coarse.candidate_pairs(odd).status == espalier.Status.INVALID_ARGUMENT
    by_hand = espalier.bake_scene([far], espalier.transform(), origin=PLACE)
    assert tuple(by_hand.origin) == tuple(PLACE)
    with pytest.warns(espalier.BakeWarning, match="instance 0 lies where float32 is coarser"):
        espalier.bake_scene([far], espalier.transform(), origin=None)
    raises(ValueError, "origin must be", espalier.bake_scene, [far], espalier.transform(), origin="near")
    raises(espalier.BakeError, "origin", espalier.bake_scene, [far], espalier.transform(), origin=[0, np.nan, 0])
    plain = espalier.bake_scene([near], espalier.transform())
    assert not plain.origin.any() and plain.bounds.dtype == np.float32
    assert plain.closest_point(points).dtype == espalier.SCENE_CLOSEST_POINT


def test_meshes_that_float32_holds_far_from_0():
    whole = np.array([431000.0, 5312000.0, 500.0])
    positions, triangles = cube(np.zeros(3))
    assert (positions == positions.astype(np.float32)).all()
    local = espalier.bake(positions, triangles, tolerance=0.001)
    for given in (positions + whole, (positions + whole).astype(np.float32)):
        blob = espalier.bake(given, triangles, tolerance=0.001)
        assert np.abs(blob.origin - whole).max() < 32 and blob.max_error < NEAR
        for each, place in ((blob, whole), (espalier.bake_scene([local], espalier.transform(translation=whole)), whole)):
            beside = place + [0, -2.2, 0]
            assert abs(each.closest_point(beside)["distance"] - 0.2) < NEAR
            assert each.overlaps(espalier.Sphere(beside, 0.1)).no and each.overlaps(espalier.Sphere(beside, 0.3)).yes
            assert abs(each.raycast(place + [0.3, 0.1, 7.2], [0, 0, -1])["t"] - 5.2) < NEAR
        assert blob.contains(whole + [0, -2.2, 0]).no and blob.contains(whole + [0, -1.8, 0]).yes


def test_moving_scenes_beside_what_float32_holds(near):
    prop = espalier.bake(*cube(np.zeros(3), 0.05))
    town = espalier.bake_scene([prop], espalier.transform(translation=[[300.0625, 0, 0], [300.5625, 0, 0]]))
    moving = espalier.MovingScene([prop], 4)
    moving.insert(espalier.transform(translation=[300.1125, 0, 0]))
    assert moving.colliding_pairs(town).items["instance"].tolist() == moving.candidate_pairs(town).items["instance"].tolist() == [0]
    far = espalier.bake(*cube(np.array([300.0, 0, 0]), 0.5))
    assert far.origin.any()
    moving = espalier.MovingScene([far, near], 4, tiles=[town])
    for mesh in (0, 2):
        with pytest.warns(UserWarning, match=f"mesh {mesh} counts from its origin .* insert it at its `origin`"):
            moving.insert(espalier.transform(), mesh)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        moving.insert(espalier.transform(translation=far.origin), 0)
        moving.insert(espalier.transform(), 1)
    with pytest.warns(UserWarning, match="its instances move by the difference"):
        moving.set_mesh(0, near)


def test_other_numbers_than_float64(far):
    place = np.round(PLACE)
    place[2] += 40
    for given in (place.astype(np.int64), place.tolist(), place.astype(">f8"), place.astype(np.float32)):
        found = far.closest_point(given)
        close(found["point"] * [0, 0, 1], [0, 0, PLACE[2] + 2])
    grid = np.broadcast_to(PLACE + [0, 0, 3], (4, 5, 3))
    assert far.closest_point(grid).shape == (4, 5) and far.closest_point(grid[:0]).shape == (0, 5)
    assert len(far.all_hits(np.zeros((0, 3)), [0, 0, 1]).items) == 0
    raises(ValueError, r"points must have the shape \(..., 3\), not \(4, 2\)", far.closest_point, np.zeros((4, 2)))
    raises(TypeError, "real numbers", far.contains, PLACE.astype(complex))
    refused = far.closest_point([[np.nan, 0, 0], [np.inf, 0, 0]])
    assert (refused["status"] == espalier.Status.INVALID_ARGUMENT).all()


WORLD = np.array([99_876.5, -42_123.25, 12.0])  # as far as float32 has steps of 8 mm


@pytest.fixture
def world():
    """Two cubes with a middle in the world that float32 does not hold, each placed through a view of its own."""
    scene = espalier.MovingScene([espalier.bake(*cube(np.zeros(3)), bits=16)], 8)
    for apart, x in ((0.0, 0.0), (700.0, 8.001)):
        places = np.array([[0, 0, 0, 1, *(WORLD + [x, 0, 0]), 1]])
        assert (scene.seen_from(WORLD + [apart, -apart, 0]).insert(places)["status"] == 0).all()
    return scene


def test_a_view_of_a_moving_scene_takes_and_returns_places_in_the_world(world):
    view = world.seen_from(WORLD + [0, 0, 40])
    assert np.abs(view.origin - WORLD).max() < 41 and (view.origin % 0.125 == 0).all() and not world.origin.any()
    assert world.seen_from([0.01, 0, 0]).origin.tolist() == [0, 0, 0] == view.seen_from([0, 0, 0]).origin.tolist()
    assert np.abs(view.raycast(WORLD + [[0, 0, 9], [8.001, 1.999, 9]], [0, 0, -1])["t"] - 7).max() < 1e-5
    assert view.occluded(WORLD + [0, 0, 9], [0, 0, -1]).yes and view.occluded(WORLD + [4, 0, 9], [0, 0, -1]).no
    np.testing.assert_allclose(np.sort(view.all_hits(WORLD + [0.3, 0.4, 9], [0, 0, -1]).items["t"]), [7, 11], atol=1e-5)
    nearest = view.closest_point(WORLD + [5.0, 0.5, 0.25])
    close(nearest["point"], WORLD + [6.001, 0.5, 0.25])
    assert nearest["instance"] == 1 and abs(nearest["distance"] - 1.001) < 1e-4
    ball = espalier.Sphere(WORLD + [4.0, 0, 0], 0.5)
    hit = view.sweep(ball, [-10, 0, 0])
    close(hit["point"], WORLD + [2, 0, 0])
    assert hit["instance"] == 0 and abs(hit["t"] - 0.15) < 1e-4
    assert view.overlaps(espalier.Box(WORLD + [2, 0, 0], WORLD + [2.5, 1, 1])).yes
    assert view.overlaps(espalier.Box(WORLD + [2.001, 0, 0], WORLD + [2.5, 1, 1])).no
    assert set(view.overlapping_triangles(espalier.Sphere(WORLD + [8.001, 0, 0], 3)).items["instance"]) == {1}
    assert list(view.candidates(espalier.Box(WORLD + [6.5, 0, 0], WORLD + [7, 1, 1])).items["instance"]) == [1]
    contacts = view.contacts(espalier.Sphere(WORLD + [0, 0, 2.25], 0.5))
    close(contacts.items["point"], WORLD + [[0, 0, 2]])
    assert abs(contacts.items["distance"][0] + 0.25) < 1e-4


def test_a_view_places_instances_and_shares_the_scene_with_others(world):
    view, other = world.seen_from(WORLD), world.seen_from(WORLD + [5000, 0, 0])
    handles = view.handles()
    np.testing.assert_allclose(view.instances()["transform"][:, 4:7], WORLD + [[0, 0, 0], [8.001, 0, 0]], atol=1e-4, rtol=0)
    assert view.instances()["transform"].dtype == np.float64 and world.instances().dtype == espalier.INSTANCE
    assert np.abs(world.instances()["transform"][:, 4:7] - WORLD - [[0, 0, 0], [8.001, 0, 0]]).max() > 5e-4
    boxes = view.boxes(handles)
    close(boxes["min"], WORLD + [[-2, -2, -2], [6.001, -2, -2]])
    close(view.bounds, WORLD + [[-2, -2, -2], [10.001, 2, 2]])
    assert view.bounds.dtype == np.float64 and world.bounds.dtype == np.float32
    assert (other.move(handles[:1], [[0, 0, 0, 1, *(WORLD + [4.5, 0, 0]), 1]]) == 0).all()
    for each in (view, other, world):
        assert each.instance_count == 2 and each.colliding_pairs().items.tolist() == [(0, 1)]
    assert abs(view.raycast(WORLD + [4.5, 0, 9], [0, 0, -1])["t"] - 7) < 1e-3
    again = pickle.loads(pickle.dumps(view))
    np.testing.assert_array_equal(again.origin, view.origin)
    same(again.instances(), view.instances())
    same(espalier.open_moving_scene(other.snapshot(), world.blobs).seen_from(WORLD).instances(), view.instances())
    del world, other
    assert view.occluded(WORLD + [4.5, 0, 9], [0, 0, -1]).yes
    view.set_mesh(0, espalier.bake(*cube(np.zeros(3), 1.0), bits=16))
    assert abs(view.raycast(WORLD + [4.5, 0, 9], [0, 0, -1])["t"] - 8) < 1e-3


def test_a_place_beyond_the_world_has_no_view(world):
    for place in ([2.0 ** 20, 0, 0], [np.nan, 0, 0], [0, 0, -np.inf]):
        raises(ValueError, r"place must be finite and less than 2\^30 - 64 steps from 0", world.seen_from, place)
