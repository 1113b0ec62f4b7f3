"""Lists of a moving scene: arrays of instances and handles, of which no refused one changes anything, and results."""

import numpy as np

import espalier
from conftest import raises, same
from test_moving_scenes import OK, scene, some_places  # noqa: F401

HUGE = 2**57  # elements, whose results no memory can hold


def refuses(scene, error, message, call):  # noqa: F811
    before = scene.snapshot()
    raises(error, message, call)
    assert scene.snapshot() == before


def with_slots(handles, kind):
    """Returns the handles with numbers of another type."""
    other = np.zeros(handles.shape, [("slot", kind), ("generation", kind), ("status", "u1")])
    other["slot"], other["generation"] = handles["slot"], handles["generation"]
    return other


def test_lists_of_wrong_lengths(scene, random):  # noqa: F811
    handles, places = scene.handles()[20:24], some_places(random, 3)
    for error, message, call in (
            (ValueError, "broadcast", lambda: scene.insert(places, [0, 0])),
            (ValueError, "broadcast", lambda: scene.insert(places, masks=[1, 2, 3, 4])),
            (ValueError, "broadcast", lambda: scene.insert(places, users=np.zeros((3, 3), int))),
            (ValueError, r"places must have the shape \(n, 8\), not \(1, 3, 8\)", lambda: scene.insert(places[None])),
            (ValueError, r"places must have the shape \(n, 8\), not \(24,\)", lambda: scene.insert(places.ravel())),
            (ValueError, r"places must have the shape \(n, 8\), not \(8, 3\)", lambda: scene.insert(places.T)),
            (ValueError, r"places must have the shape \(n, 8\), not \(\)", lambda: scene.insert(1.0)),
            (ValueError, "broadcast", lambda: scene.move(handles, places)),
            (ValueError, "", lambda: scene.move(handles, np.zeros((3, 4, 8)))),
            (ValueError, r"places must have the shape \(..., 8\), not \(\)", lambda: scene.move(handles, 1.0)),
            (ValueError, "broadcast", lambda: scene.set_masks(handles, [1, 2, 3])),
            (ValueError, "", lambda: scene.set_users(handles, np.ones((2, 4), int))),
            (ValueError, "the shape \\(60,\\), not \\(59,\\)",
             lambda: scene.raycast([0, 0, 9], [0, 0, -1], only=np.ones(59, bool)))):
        refuses(scene, error, message, call)


def test_lists_of_wrong_types(scene, random):  # noqa: F811
    handles, places = scene.handles()[20:23], some_places(random, 3)
    objects = places.astype(object)
    for error, message, call in (
            (TypeError, "real numbers", lambda: scene.insert(places.astype(complex))),
            (TypeError, "real numbers", lambda: scene.insert(places.astype(str))),
            (TypeError, "real numbers", lambda: scene.insert(places.astype(bool))),
            (TypeError, "real numbers", lambda: scene.insert(objects)),
            (ValueError, "must be integers", lambda: scene.insert(places, 0.0)),
            (ValueError, "must be integers", lambda: scene.insert(places, [0, 0, -1])),
            (ValueError, "must be integers", lambda: scene.insert(places, masks=2**32)),
            (ValueError, "must be integers", lambda: scene.insert(places, users=[True, False, True])),
            (TypeError, "real numbers", lambda: scene.move(handles, places.astype(complex))),
            (TypeError, "real numbers", lambda: scene.move(handles, objects)),
            (ValueError, "masks must be integers", lambda: scene.set_masks(handles, np.float32(1))),
            (ValueError, "users must be integers", lambda: scene.set_users(handles, 2**32)),
            (TypeError, "those that insert", lambda: scene.remove(handles["slot"])),
            (TypeError, "those that insert", lambda: scene.remove(scene.instances())),
            (TypeError, "", lambda: scene.remove(with_slots(handles, "f4"))),
            (TypeError, "", lambda: scene.move(with_slots(handles, "i8"), places)),
            (TypeError, "only must be flags", lambda: scene.raycast([0, 0, 9], [0, 0, -1], only=np.arange(60)))):
        refuses(scene, error, message, call)


def test_strides_and_types_of_lists_do_not_change_what_happens(blob, scene, random):  # noqa: F811
    twin = espalier.open_moving_scene(scene.snapshot(), [blob])
    handles, places = scene.handles()[20:32], some_places(random, 12)
    wide = np.zeros((12, 3), espalier.HANDLE)
    wide[:, 1] = handles
    numbers = np.zeros((12, 5), np.int64)
    numbers[:, 2] = np.arange(12)
    for each, given in ((scene, {"handles": handles, "places": places, "numbers": np.arange(12, dtype=np.uint32)}),
                        (twin, {"handles": wide[:, 1], "places": np.asfortranarray(places.astype(">f8")),
                                "numbers": numbers[:, 2]})):
        given = {name: array[::-1][::2] for name, array in given.items()}
        inserted = each.insert(given["places"][:4], 0, masks=given["numbers"][:4], users=given["numbers"][1:5])
        assert (inserted["status"] == OK).all()
        assert (each.move(given["handles"], given["places"]) == OK).all()
        assert (each.set_masks(given["handles"].reshape(2, 3), given["numbers"].reshape(2, 3)) == OK).all()
        assert (each.set_users(given["handles"], given["numbers"]) == OK).all()
        assert (each.remove(given["handles"][::3]) == OK).all()
    assert twin.snapshot() == scene.snapshot()
    only = np.zeros((60, 2), bool)
    only[::3, 1] = True
    same(scene.raycast(places[:, 4:7], -places[:, 4:7], only=only[:, 1]),
         scene.raycast(places[:, 4:7].copy(), -places[:, 4:7], only=only[:, 1].copy()))


def test_lists_of_any_length(blob, scene):  # noqa: F811
    place, handle = espalier.transform(), scene.handles()[20]
    many = np.broadcast_to(handle, HUGE)
    for error, message, call in (
            (MemoryError, "", lambda: scene.insert(np.broadcast_to(place, (HUGE, 8)))),
            (MemoryError, "", lambda: scene.remove(many)),
            (MemoryError, "", lambda: scene.move(many, place)),
            (MemoryError, "", lambda: scene.set_masks(many, 1)),
            (ValueError, "the shape", lambda: scene.raycast([0, 0, 9], [0, 0, -1], only=np.broadcast_to(True, HUGE))),
            (MemoryError, "", lambda: scene.all_hits(np.broadcast_to(np.float32(1), (HUGE, 3)), [0, 0, 1])),
            (MemoryError, "", lambda: scene.overlapping_triangles(
                espalier.Sphere(np.broadcast_to(np.float32(1), (HUGE, 3)), 1.0)))):
        refuses(scene, error, message, call)
    for capacity in (-1, 2**24 + 1, 2**64):
        raises(ValueError, "capacity must be from 1 to 16777216", espalier.MovingScene, [blob], capacity)
    # Many more than there are: the first of them leaves, and what no place is left for is refused.
    assert scene.remove(np.repeat(handle[None], 100_000)).tolist() == [OK] + [espalier.Status.STALE_HANDLE] * 99_999
    inserted = scene.insert(np.repeat(place[None], 100_000, axis=0))["status"]
    assert (inserted[:15] == OK).all() and (inserted[15:] == espalier.Status.NO_ROOM).all()
    for empty in (scene.remove(scene.handles()[:0]), scene.move(scene.handles()[:0], np.zeros((0, 8))),
                  scene.set_users(scene.handles()[:0], []), scene.insert(np.zeros((0, 8)))):
        assert empty.shape == (0,)


def test_lists_that_the_package_would_not_pass_on(scene, random):  # noqa: F811
    """The core reads no element behind the end of an array."""
    core, rows, places = scene._core, np.zeros((3, 2), np.uint32), some_places(random, 3)
    numbers = np.zeros((3, 3), np.uint32)
    for message, call in (
            ("a mesh, a mask and a user's number", lambda: core.insert(places, numbers[:2])),
            ("a mesh, a mask and a user's number", lambda: core.insert(places, numbers[:, :2])),
            ("a mesh, a mask and a user's number", lambda: core.insert(places, numbers.ravel())),
            ("a slot and a generation", lambda: core.remove(numbers)),
            ("a slot and a generation", lambda: core.remove(np.zeros((), np.uint32))),
            ("a place for each handle", lambda: core.move(rows, places[:2])),
            ("a place for each handle", lambda: core.move(rows, places[0])),
            ("a number for each handle", lambda: core.set_words(rows, np.zeros(2, np.uint32), True)),
            ("a number for each handle", lambda: core.set_words(rows, np.zeros(4, np.uint32), False))):
        refuses(scene, ValueError, message, call)


def test_lists_of_refused_queries_are_empty(blob):
    """One instance is so small that the query has no finite numbers in its space; others were visited before it."""
    places = espalier.transform(translation=[[0, 0, 0], [9, 0, 0], [0, 0, 0], [0, 9, 0]], scale=[1, 2, 1e-25, 1])
    rays = ([[1e15, 0.1, 0], [20, 0.1, 0]], [-1, 0, 0])
    shapes = espalier.Sphere([[1e15, 0, 0], [0, 0, 0]], [2e15, 4])
    for order in ([0, 1, 2, 3], [2, 3, 1, 0], [3, 0, 2, 1]):
        scene = espalier.MovingScene([blob], 4)  # noqa: F811
        assert (scene.insert(places[order], masks=[1 + (each == 2) for each in order])["status"] == OK).all()
        for _ in range(2):
            visited = scene.overlapping_triangles(shapes, mask=1)
            assert (visited.status == OK).all() and visited.counts()[0] == 3 * blob.triangle_count
            refused = scene.overlapping_triangles(shapes)
            assert refused.status.tolist() == [espalier.Status.OUT_OF_RANGE, OK]
            assert refused.counts()[0] == 0 < visited.counts()[1]
            others = refused.items["instance"] != order.index(2)
            same(refused.items[others], visited.items[visited.queries() == 1])
            hits = scene.all_hits(*rays)
            assert hits.status.tolist() == [espalier.Status.OUT_OF_RANGE, OK]
            assert hits.counts()[0] == 0 < hits.counts()[1]
            scene.repack()
