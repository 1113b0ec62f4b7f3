"""Every query returns what the function of C returns for each element, bit for bit."""

import ctypes

import numpy as np
import pytest

import espalier
from c_library import Rows, placed, ray
from conftest import codes, same


def of(shape, i):
    """Returns one of the shapes for C."""
    fields = tuple(field[i] for field in shape)
    return Rows(fields[0]) if isinstance(shape, (espalier.ConvexVolume, espalier.ConvexHull)) else fields


@pytest.fixture
def opened(library, blob):
    return library.opened(blob)


@pytest.mark.parametrize("culling", ["none", "back", "front"])
@pytest.mark.parametrize("threads", [1, 3])
def test_rays(library, blob, opened, points, directions, culling, threads):
    number = {"none": 0, "back": 1, "front": 2}[culling]
    limits = np.linspace(0.1, 3, len(points), dtype=np.float32)
    rays = [ray(points[i], directions[i], 0.05, limits[i], number) for i in range(len(points))]
    keywords = dict(t_min=0.05, t_max=limits, culling=culling, threads=threads)
    hits = blob.raycast(points, directions, **keywords)
    assert (hits["status"] == espalier.Status.OK).sum() > 300
    same(hits, library.each("raycast", len(points), lambda i: (opened, rays[i])))
    occluded = blob.occluded(points, directions, **keywords)
    same(codes(occluded), library.each("occluded", len(points), lambda i: (opened, rays[i])))


def test_sources_and_places(library, blob, opened, points, directions):
    hits, places, sources = blob.raycast_sources(points, directions)
    same(hits, blob.raycast(points, directions))
    same(sources, library.each("original_hit_of", len(hits), lambda i: (opened, hits[i : i + 1])))
    same(sources, blob.original_hits(hits))
    same(sources, blob.original_hits(hits, blob.remap))
    with np.errstate(all="ignore"):
        expected = points.astype(np.float64) + hits["t"].astype(np.float64)[:, None] * directions.astype(np.float64)
    hit = hits["status"] == espalier.Status.OK
    np.testing.assert_array_equal(places[hit], expected[hit])
    assert np.isnan(places[~hit]).all()


@pytest.mark.parametrize("threads", [1, 2])
def test_points(library, blob, opened, points, threads):
    for name in ("closest_point", "signed_distance"):
        same(getattr(blob, name)(points, 2.5, threads=threads), library.each(name, len(points), lambda i: (opened, points[i], 2.5)))
    inside = blob.contains(points, threads=threads)
    assert inside.yes.sum() > 50 and inside.no.sum() > 50
    same(codes(inside), library.each("contains", len(points), lambda i: (opened, points[i])))


def test_winding_numbers(library, open_mesh_blob, points):
    opened = library.opened(open_mesh_blob)
    for directions in (7, 64):
        same(open_mesh_blob.winding_number(points, directions, threads=2),
             library.each("winding_number", len(points), lambda i: (opened, points[i], directions)))
    inside = open_mesh_blob.winding_number([[3, 0, 0], [0, 0, 0]], 1024)["value"]
    assert inside[0] > 0.9 and abs(inside[1]) < 0.1


def test_closest_to_segments_and_boxes(library, blob, opened, points):
    ends = np.roll(points, 1, axis=0)
    same(blob.closest_point(espalier.Segment(points, ends), 1.5),
         library.each("closest_point_segment", len(points), lambda i: (opened, (points[i], ends[i]), 1.5)))
    same(blob.closest_point(espalier.Box(points, points + np.float32(0.5))),
         library.each("closest_point_box", len(points), lambda i: (opened, (points[i], points[i] + np.float32(0.5)), np.inf)))


def volumes(points, random):
    far = np.roll(points, 1, axis=0)
    radius = random.uniform(0, 1, len(points)).astype(np.float32)
    axes = random.uniform(-1, 1, (len(points), 3, 3)).astype(np.float32)
    normals = np.concatenate([axes, -axes], 1)
    with np.errstate(all="ignore"):
        offsets = (normals * points[:, None]).sum(-1) + radius[:, None]
    return {
        "sphere": espalier.Sphere(points, radius),
        "capsule": espalier.Capsule(points, far, radius),
        "box": espalier.Box(points, points + axes[:, 0]),
        "oriented_box": espalier.OrientedBox(points, axes),
        "cone": espalier.Cone(points, axes[:, 1], radius),
        "triangle": espalier.Triangle(points[:, None] + axes),
        "convex_volume": espalier.ConvexVolume(np.concatenate([normals, offsets[..., None]], -1)),
        "convex_hull": espalier.ConvexHull(points[:, None] + 0.5 * normals),
    }


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box", "cone", "triangle", "convex_volume"])
def test_overlaps(library, blob, opened, points, random, kind):
    shape = volumes(points, random)[kind]
    answers = blob.overlaps(shape)
    same(codes(answers), library.each(f"overlaps_{kind}", len(points), lambda i: (opened, of(shape, i))))
    for threads in (1, 2):
        lists = blob.overlapping_triangles(shape, threads=threads)
        np.testing.assert_array_equal(lists.counts() > 0, answers.yes)
        visitor = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_uint32, ctypes.c_void_p, ctypes.c_void_p)
        for_each = getattr(library, f"for_each_overlap_{kind}")
        for i in range(0, len(points), 5):
            found = []
            visit = visitor(lambda triangle, corners, user: found.append(triangle) or 0)
            assert for_each(opened, of(shape, i), visit, None) == lists.status[i]
            assert found == list(lists.items[lists.offsets[i] : lists.offsets[i + 1]])


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "oriented_box", "convex_hull"])
def test_sweeps(library, blob, opened, points, directions, random, kind):
    shape = volumes(points, random)[kind]
    same(blob.sweep(shape, directions),
         library.each(f"sweep_{kind}", len(points), lambda i: (opened, of(shape, i), directions[i])))


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


@pytest.mark.parametrize("kind", ["sphere", "capsule", "oriented_box", "convex_hull"])
def test_contacts(library, blob, opened, points, random, kind):
    shape = volumes(points, random)[kind]
    lists = blob.contacts(shape, 0.1, most=6)
    found = np.zeros(6, espalier.CONTACT)
    for i in range(len(points)):
        filled = getattr(library, f"find_contacts_{kind}")(opened, of(shape, i), 0.1, found, 6)
        assert filled.status == lists.status[i] and filled.count == lists.counts()[i]
        same(lists.items[lists.offsets[i] : lists.offsets[i + 1]], found[: filled.count])


def test_pairs(library, blob, opened, random):
    places = espalier.transform(random.uniform(-1, 1, (60, 4)), random.uniform(-5, 5, (60, 3)),
                                random.uniform(0.5, 2, 60))
    pairs = espalier.pairs
    others = np.roll(places, 1, axis=0)
    limit = 100_000
    two = lambda i: (placed(opened, places[i]), placed(opened, others[i]))
    touch = pairs.overlaps(blob, blob, places, others, work_limit=100_000)
    same(codes(touch), library.each("overlaps_blob", 60, lambda i: (*two(i), limit)))
    same(pairs.first_contact(blob, blob, places, others, work_limit=100_000),
         library.each("first_contact", 60, lambda i: (*two(i), limit)))
    same(pairs.distance(blob, blob, places, others, 4.0, work_limit=100_000),
         library.each("distance", 60, lambda i: (*two(i), limit, 4.0)))
    lists = pairs.contacts(blob, blob, places, others, work_limit=100_000, threads=2)
    np.testing.assert_array_equal((lists.counts() > 0)[touch.yes], True)
    assert touch.yes.any() and touch.no.any()
    within = pairs.within_distance(blob, blob, 1.5, places, others, work_limit=100_000)
    same(codes(within), library.each("within_distance", 60, lambda i: (*two(i), 1.5, limit)))
    assert within.yes.any() and within.no.any()
    for i in range(60):
        found = np.zeros(max(lists.counts()[i], 1) + 1, espalier.PAIR_CONTACT)
        filled = library.collect_contacts(*two(i), found, len(found), limit, ())
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
         library.each("pair_touch_of", len(contacts), lambda i: (*two(owner[some][i]), contacts[i : i + 1])))
