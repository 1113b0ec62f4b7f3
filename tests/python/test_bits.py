"""Every query returns what the function of C returns for each element, bit for bit."""

import ctypes

import numpy as np
import pytest

import espalier
from c_library import floats, placed, ray, vector
from conftest import same

FLOAT = ctypes.c_float
CURSOR = type("Cursor", (ctypes.Structure,), {"_fields_": [("place", ctypes.c_uint32 * 3)]})


@pytest.fixture
def opened(library, blob):
    return library.open(blob)


@pytest.mark.parametrize("culling", ["none", "back", "front"])
@pytest.mark.parametrize("threads", [1, 3])
def test_rays(library, blob, opened, points, directions, culling, threads):
    number = {"none": 0, "back": 1, "front": 2}[culling]
    limits = np.linspace(0.1, 3, len(points), dtype=np.float32)
    rays = [ray(points[i], directions[i], 0.05, limits[i], number) for i in range(len(points))]
    keywords = dict(t_min=0.05, t_max=limits, culling=culling, threads=threads)
    hits = blob.raycast(points, directions, **keywords)
    assert (hits["status"] == espalier.Status.OK).sum() > 300
    same(hits, library.each("espalier_raycast", espalier.RAY_HIT, opened, len(points), lambda i: (rays[i][0],)))
    occluded = blob.occluded(points, directions, **keywords)
    same(occluded.status, library.each("espalier_occluded", np.dtype(np.uint8), opened, len(points),
                                       lambda i: (rays[i][0],)))


def test_sources_and_places(library, blob, opened, points, directions):
    hits, places, sources = blob.raycast_sources(points, directions)
    same(hits, blob.raycast(points, directions))
    same(sources, library.each("espalier_original_hit_of", espalier.ORIGINAL_HIT, opened, len(hits),
                               lambda i: (hits[i : i + 1].ctypes.data_as(ctypes.c_void_p),)))
    same(sources, blob.original_hits(hits))
    same(sources, blob.original_hits(hits, blob.remap))
    with np.errstate(all="ignore"):
        expected = points.astype(np.float64) + hits["t"].astype(np.float64)[:, None] * directions.astype(np.float64)
    hit = hits["status"] == espalier.Status.OK
    np.testing.assert_array_equal(places[hit], expected[hit])
    assert np.isnan(places[~hit]).all()


@pytest.mark.parametrize("threads", [1, 2])
def test_points(library, blob, opened, points, threads):
    for name, answers in (("espalier_closest_point", blob.closest_point(points, 2.5, threads=threads)),
                          ("espalier_signed_distance", blob.signed_distance(points, 2.5, threads=threads))):
        same(answers, library.each(name, espalier.CLOSEST_POINT, opened, len(points),
                                   lambda i: (vector(points[i]), FLOAT(2.5))))
    inside = blob.contains(points, threads=threads)
    assert inside.yes.sum() > 50 and inside.no.sum() > 50
    same(inside.status, library.each("espalier_contains", np.dtype(np.uint8), opened, len(points),
                                     lambda i: (vector(points[i]),)))


def test_winding_numbers(library, open_mesh_blob, points):
    for directions in (7, 64):
        same(open_mesh_blob.winding_number(points, directions, threads=2),
             library.each("espalier_winding_number", espalier.WINDING, library.open(open_mesh_blob), len(points),
                          lambda i: (vector(points[i]), ctypes.c_uint32(directions))))
    inside = open_mesh_blob.winding_number([[3, 0, 0], [0, 0, 0]], 1024)["value"]
    assert inside[0] > 0.9 and abs(inside[1]) < 0.1


def test_closest_to_segments_and_boxes(library, blob, opened, points):
    ends = np.roll(points, 1, axis=0)
    same(blob.closest_point(espalier.Segment(points, ends), 1.5),
         library.each("espalier_closest_point_segment", espalier.CLOSEST_POINT, opened, len(points),
                      lambda i: (floats(points[i], ends[i]), FLOAT(1.5))))
    same(blob.closest_point(espalier.Box(points, points + np.float32(0.5))),
         library.each("espalier_closest_point_box", espalier.CLOSEST_POINT, opened, len(points),
                      lambda i: (floats(points[i], points[i] + np.float32(0.5)), FLOAT(np.inf))))


def volumes(points, random):
    far = np.roll(points, 1, axis=0)
    radius = random.uniform(0, 1, len(points)).astype(np.float32)
    axes = random.uniform(-1, 1, (len(points), 3, 3)).astype(np.float32)
    return {
        "sphere": espalier.Sphere(points, radius),
        "capsule": espalier.Capsule(points, far, radius),
        "box": espalier.Box(points, points + axes[:, 0]),
        "oriented_box": espalier.OrientedBox(points, axes),
        "cone": espalier.Cone(points, axes[:, 1], radius),
        "triangle": espalier.Triangle(points[:, None] + axes),
    }


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box", "cone", "triangle"])
def test_overlaps(library, blob, opened, points, random, kind):
    shape = volumes(points, random)[kind]
    answers = blob.overlaps(shape)
    arguments = lambda i: (floats(*(field[i] for field in shape)),)
    same(answers.status, library.each(f"espalier_overlaps_{kind}", np.dtype(np.uint8), opened, len(points), arguments))
    for threads in (1, 2):
        lists = blob.overlapping_triangles(shape, threads=threads)
        np.testing.assert_array_equal(lists.counts() > 0, answers.yes)
        visitor = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_uint32, ctypes.c_void_p, ctypes.c_void_p)
        for_each = getattr(library.c, f"espalier_for_each_overlap_{kind}")
        for_each.restype = ctypes.c_uint8
        for i in range(0, len(points), 5):
            found = []
            visit = visitor(lambda triangle, corners, user: found.append(triangle) or 0)
            assert for_each(ctypes.c_void_p(opened.address), *arguments(i), visit, None) == lists.status[i]
            assert found == list(lists.items[lists.offsets[i] : lists.offsets[i + 1]])


def test_convex_volumes(blob, random):
    center = random.uniform(-4, 4, (300, 3)).astype(np.float32)
    normals = np.concatenate([np.eye(3), -np.eye(3)]).astype(np.float32)
    offsets = np.einsum("nk,pk->np", center, normals) + np.float32(0.5)
    planes = np.concatenate([np.broadcast_to(normals, (300, 6, 3)), offsets[..., None]], -1).astype(np.float32)
    as_planes = blob.overlaps(espalier.ConvexVolume(planes)).yes
    as_boxes = blob.overlaps(espalier.Box(center - 0.5, center + 0.5)).yes
    assert (as_planes != as_boxes).sum() <= 3 and as_boxes.any()


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box"])
def test_sweeps(library, blob, opened, points, directions, random, kind):
    shape = volumes(points, random)[kind]
    same(blob.sweep(shape, directions),
         library.each(f"espalier_sweep_{kind}", espalier.SWEEP_HIT, opened, len(points),
                      lambda i: (floats(*(field[i] for field in shape)), vector(directions[i]))))


def test_sweeps_with_options(blob, points, directions, random):
    shape = volumes(points, random)["sphere"]
    plain = blob.sweep(shape, directions)
    found = (plain["status"] == 0) & ~plain["starts_overlapping"]
    back = blob.sweep(shape, directions, culling="back")
    leads_along = np.einsum("ij,ij->i", back["face_normal"], directions) > 0
    assert not leads_along[back["status"] == 0].any() and (back["triangle"] != plain["triangle"]).any()
    with_skin = blob.sweep(shape, directions, skin=0.01)
    assert (with_skin["t"][found] <= plain["t"][found]).all() and (with_skin["t"] < plain["t"]).any()
    same(with_skin[["point", "feature", "triangle"]], plain[["point", "feature", "triangle"]])
    leaving = blob.sweep(shape, directions, ignore_leaving=True)
    assert leaving["starts_overlapping"].sum() < plain["starts_overlapping"].sum()
    assert set(np.unique(plain["feature"])) > {espalier.Feature.FACE}
    assert (blob.sweep(shape, directions, skin=-1.0)["status"] >= 16).all()


def test_contacts_of_hulls(blob):
    corners = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2)], np.float32)
    center = np.array([[3, 0, 1], [4, 0, 0], [9, 9, 9]], np.float32)
    hull = blob.contacts(espalier.ConvexHull(center[:, None] + corners), 0.1, most=64)
    box = blob.contacts(espalier.OrientedBox(center, np.eye(3) * 0.2), 0.1, most=64)
    assert hull.counts()[0] > 0 and hull.counts()[1] > 0 and hull.counts()[2] == 0
    # Places differ, but not which triangles are touched, nor how deep.
    deepest = lambda contacts: {t: contacts["distance"][contacts["triangle"] == t].min() for t in contacts["triangle"]}
    for of_hull, of_box in zip(hull.each(), box.each()):
        ours, theirs = deepest(of_hull), deepest(of_box)
        assert ours.keys() == theirs.keys()
        np.testing.assert_allclose([ours[t] for t in ours], [theirs[t] for t in ours], atol=1e-4)


def test_hulls(blob, points, directions):
    corners = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2)], np.float32)
    hull = blob.sweep(espalier.ConvexHull(points[20:90, None] + corners), directions[20:90])
    box = blob.sweep(espalier.Box(points[20:90] - 0.2, points[20:90] + 0.2), directions[20:90])
    assert np.allclose(hull["t"], box["t"], atol=1e-4) and (hull["status"] == 0).any()


FILLED = type("Filled", (ctypes.Structure,), {
    "_fields_": [("count", ctypes.c_size_t), ("cursor", ctypes.c_uint32 * 3), ("status", ctypes.c_uint8)]})


@pytest.mark.parametrize("kind", ["sphere", "capsule", "oriented_box"])
def test_contacts(library, blob, opened, points, random, kind):
    shape = volumes(points, random)[kind]
    lists = blob.contacts(shape, 0.1, most=6)
    function = getattr(library.c, f"espalier_find_contacts_{kind}")
    function.restype = FILLED
    found = np.zeros(6, espalier.CONTACT)
    for i in range(len(points)):
        filled = function(ctypes.c_void_p(opened.address), floats(*(field[i] for field in shape)), FLOAT(0.1),
                          found.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(6))
        assert filled.status == lists.status[i] and filled.count == lists.counts()[i]
        same(lists.items[lists.offsets[i] : lists.offsets[i + 1]], found[: filled.count])


def test_pairs(library, blob, opened, random):
    places = espalier.transform(random.uniform(-1, 1, (60, 4)), random.uniform(-5, 5, (60, 3)),
                                random.uniform(0.5, 2, 60))
    pairs = espalier.pairs
    others = np.roll(places, 1, axis=0)
    limit = (ctypes.c_uint64(100_000),)
    two = lambda i: (placed(opened, places[i]), placed(opened, others[i]))
    touch = pairs.overlaps(blob, blob, places, others, work_limit=100_000)
    same(touch.status, library.each("espalier_overlaps_blob", np.dtype(np.uint8), None, 60, lambda i: two(i) + limit))
    same(pairs.first_contact(blob, blob, places, others, work_limit=100_000),
         library.each("espalier_first_contact", espalier.PAIR_CONTACT, None, 60, lambda i: two(i) + limit))
    same(pairs.distance(blob, blob, places, others, 4.0, work_limit=100_000),
         library.each("espalier_distance", espalier.BLOB_DISTANCE, None, 60, lambda i: two(i) + limit + (FLOAT(4),)))
    lists = pairs.contacts(blob, blob, places, others, work_limit=100_000, threads=2)
    np.testing.assert_array_equal((lists.counts() > 0)[touch.yes], True)
    assert touch.yes.any() and touch.no.any()
    within = pairs.within_distance(blob, blob, 1.5, places, others, work_limit=100_000)
    same(within.status, library.each("espalier_within_distance", np.dtype(np.uint8), None, 60,
                                     lambda i: two(i) + (FLOAT(1.5),) + limit))
    assert within.yes.any() and within.no.any()
    collect = library.c.espalier_collect_contacts
    collect.restype = FILLED
    for i in range(60):
        found = np.zeros(max(lists.counts()[i], 1) + 1, espalier.PAIR_CONTACT)
        filled = collect(*two(i), found.ctypes.data_as(ctypes.c_void_p), ctypes.c_size_t(len(found)), *limit, CURSOR())
        assert filled.count == lists.counts()[i]
        ours = lists.items[lists.offsets[i] : lists.offsets[i + 1]]
        np.testing.assert_array_equal(np.sort(ours[["a", "b"]]), np.sort(found[: filled.count][["a", "b"]]))
    touches = pairs.touches(blob, blob, places, others, work_limit=100_000, threads=2)
    for name in "ab":
        np.testing.assert_array_equal(touches.items[name], lists.items[name])
    same(touches.status, lists.status)
    owner = touches.queries()
    some = slice(None, None, 7)
    contacts = lists.items[some]
    assert 1 <= touches.items["count"].min() and touches.items["depth"].min() >= 0 and len(contacts) > 100
    same(touches.items[some],
         library.each("espalier_pair_touch_of", espalier.PAIR_TOUCH, None, len(contacts),
                      lambda i: two(owner[some][i]) + (contacts[i : i + 1].ctypes.data_as(ctypes.c_void_p),)))
