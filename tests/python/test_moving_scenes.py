"""Moving scenes against those of C, byte for byte, and against loops over their instances."""

import pickle
import threading
import time

import numpy as np
import pytest

import espalier
from c_library import MovingScene, ray
from conftest import codes, raises, same
from test_bits import of, volumes

OK = espalier.Status.OK
MOVEMENT = np.dtype([("slot", "u4"), ("generation", "u4"), ("place", "8f4")])


def some_places(random, count, size=12.0):
    return espalier.transform(random.uniform(-1, 1, (count, 4)), random.uniform(-size, size, (count, 3)),
                              random.uniform(0.5, 2, count))


@pytest.fixture
def scene(blob, random):
    """60 instances, of which some were moved and some removed."""
    scene = espalier.MovingScene([blob], 64)
    handles = scene.insert(some_places(random, 60), masks=1 << (np.arange(60) % 7), users=np.arange(60))
    assert (scene.move(handles[::2], some_places(random, 30)) == OK).all()
    assert (scene.remove(handles[5:15]) == OK).all()
    return scene


def test_changes_equal_those_of_c(library, blob, random):
    scene, theirs = espalier.MovingScene([blob], 64, -8), MovingScene(library, library.opened(blob), 64, -8)
    handles = np.zeros(0, espalier.HANDLE)
    for step in range(6):
        given = np.zeros(20, espalier.INSTANCE)
        given["transform"], given["mask"], given["user"] = some_places(random, 20), 1 << step, np.arange(20)
        given["mesh"][3] = 1  # no mesh has this number
        given["transform"][4] = np.nan
        given["transform"][5, 4] = 1e9
        inserted = scene.insert(given["transform"], given["mesh"], masks=given["mask"], users=given["user"])
        assert inserted.tolist() == [theirs.insert(each) for each in np.split(given, 20)]
        handles = np.append(handles, inserted[inserted["status"] == OK])
        moved = random.choice(handles, 12, replace=False)
        movements = np.zeros(12, MOVEMENT)
        movements["slot"], movements["generation"] = moved["slot"], moved["generation"]
        movements["place"] = some_places(random, 12)
        assert (scene.move(moved, movements["place"]) == theirs.move(movements).status).all()
        assert (scene.set_masks(moved[:3], 5) == [theirs.call("set_mask", each, 5) for each in moved[:3]]).all()
        assert (scene.set_users(moved[:3], [6, 7, 8]) == [theirs.call("set_user", each, 6 + i)
                                                          for i, each in enumerate(moved[:3])]).all()
        gone = np.append(moved[3:10], moved[3])  # one twice
        removed = scene.remove(gone)
        np.testing.assert_array_equal(removed, [theirs.call("remove", each) for each in gone])
        assert removed[-1] == espalier.Status.STALE_HANDLE
        handles = handles[~np.isin(handles["slot"], gone["slot"])]
        if step == 3:
            scene.repack()
            theirs.library.moving_scene_repack(theirs)
        if step == 4:
            scene.end_step()
            theirs.library.moving_scene_end_step(theirs)
        assert scene.snapshot() == theirs.bytes()
        for name, limit in (("candidate", ()), ("colliding", (2**64 - 1,))):
            pairs, status = theirs.pairs(name, *limit)
            ours = getattr(scene, f"{name}_pairs")()
            same(ours.items, pairs)
            assert ours.status == status == OK and len(pairs) > 0
    assert set(inserted["status"]) == {OK, espalier.Status.INVALID_ARGUMENT, espalier.Status.OUT_OF_RANGE,
                                       espalier.Status.NO_ROOM}


@pytest.mark.parametrize("threads", [1, 2])
def test_queries_equal_those_of_c(library, blob, random, points, directions, threads):
    scene, theirs = espalier.MovingScene([blob], 64), MovingScene(library, library.opened(blob), 64, -10)
    given = np.zeros(40, espalier.INSTANCE)
    given["transform"], given["mask"] = some_places(random, 40), 1 << (np.arange(40) % 3)
    scene.insert(given["transform"], masks=given["mask"])
    for each in np.split(given, 40):
        theirs.insert(each)
    view, filter = theirs.view(), (3, None, None)
    rays = [ray(points[i], directions[i]) for i in range(len(points))]
    hits = scene.raycast(points, directions, mask=3, threads=threads)
    assert (hits["status"] == OK).sum() > 300
    same(hits, library.each("scene_raycast", len(points), lambda i: (view, rays[i], *filter)))
    same(codes(scene.occluded(points, directions, mask=3, threads=threads)),
         library.each("scene_occluded", len(points), lambda i: (view, rays[i], *filter)))
    lists = scene.all_hits(points, directions, mask=3, threads=threads)
    np.testing.assert_array_equal(lists.counts() > 0, hits["status"] == OK)
    first = np.minimum.reduceat(lists.items["t"], lists.offsets[:-1][lists.counts() > 0])
    same(first, hits["t"][hits["status"] == OK])
    assert all((np.diff(each["instance"].astype(int)) >= 0).all() for each in lists.each())
    same(scene.closest_point(points, 3.0, mask=3, threads=threads),
         library.each("scene_closest_point", len(points), lambda i: (view, points[i], 3.0, 3)))
    shape = volumes(points, random)["capsule"]
    same(scene.sweep(shape, directions, mask=3, threads=threads),
         library.each("scene_sweep_capsule", len(points), lambda i: (view, of(shape, i), directions[i], *filter)))
    touching = scene.overlaps(shape, mask=3, threads=threads)
    same(codes(touching), library.each("scene_overlaps_capsule", len(points), lambda i: (view, of(shape, i), *filter)))
    triangles = scene.overlapping_triangles(shape, mask=3, threads=threads)
    np.testing.assert_array_equal(triangles.counts() > 0, touching.yes)
    assert touching.yes.any() and touching.no.any()
    assert all((np.diff(each["instance"].astype(int)) >= 0).all() for each in triangles.each())


def test_lists_equal_those_of_a_baked_scene(blob, scene, points, directions):
    alive = scene.handles()["status"] == OK
    instances = scene.instances()[alive]
    baked = espalier.bake_scene([blob], instances["transform"])
    slots = np.flatnonzero(alive)
    slot_of = slots[baked.instances()["source"]]
    for ours, theirs in ((scene.all_hits(points, directions), baked.all_hits(points, directions)),
                         (scene.overlapping_triangles(espalier.Sphere(points, 1.0)),
                          baked.overlapping_triangles(espalier.Sphere(points, 1.0)))):
        assert len(ours.items) > 300
        np.testing.assert_array_equal(ours.offsets, theirs.offsets)
        order = np.lexsort((theirs.items["triangle"], slot_of[theirs.items["instance"]], theirs.queries()))
        np.testing.assert_array_equal(ours.items["instance"], slot_of[theirs.items["instance"]][order])
        np.testing.assert_array_equal(ours.items["triangle"], theirs.items["triangle"][order])


def test_pairs_equal_a_loop(blob, scene, random):
    slots = np.flatnonzero(scene.handles()["status"] == OK)
    instances = scene.instances()
    a, b = (slots[each] for each in np.triu_indices(len(slots), 1))
    shares = (instances["mask"][a] & instances["mask"][b]) != 0
    place = instances["transform"]
    touch = espalier.pairs.overlaps(blob, blob, place[a], place[b]).yes & shares
    assert 5 < touch.sum() < shares.sum()
    pairs = scene.colliding_pairs()
    assert pairs.status == OK
    np.testing.assert_array_equal(pairs.items["a"], a[touch])
    np.testing.assert_array_equal(pairs.items["b"], b[touch])
    candidates = scene.candidate_pairs()
    assert set(candidates.items.tolist()) > set(pairs.items.tolist())
    rest = scene.candidate_pairs(start=candidates.items[7].tolist())
    same(rest.items, candidates.items[7:])

    scene.end_step()
    assert len(scene.candidate_pairs(only_moved=True).items) == 0
    moved = scene.handles()[slots[4:6]]
    scene.move(moved, some_places(random, 2, 1.0))
    some = scene.colliding_pairs(only_moved=True).items
    all_pairs = scene.colliding_pairs().items
    has_moved = np.isin(all_pairs["a"], moved["slot"]) | np.isin(all_pairs["b"], moved["slot"])
    same(some, all_pairs[has_moved])
    assert len(some) > 0


def test_pairs_with_a_baked_scene(blob, scene, random):
    town = espalier.bake_scene([blob], some_places(random, 20), masks=3)
    slots = np.flatnonzero(scene.handles()["status"] == OK)
    moving, stays = scene.instances(), town.instances()
    a, b = np.repeat(slots, 20), np.tile(np.arange(20), len(slots))
    touch = espalier.pairs.overlaps(blob, blob, moving["transform"][a], stays["transform"][b]).yes
    touch &= (moving["mask"][a] & 3) != 0
    pairs = scene.colliding_pairs(town)
    np.testing.assert_array_equal(pairs.items["moving"], a[touch])
    np.testing.assert_array_equal(pairs.items["instance"], b[touch])
    assert pairs.status == OK and touch.any() and (pairs.items["in_tile"] == espalier.NO_TRIANGLE).all()
    candidates = scene.candidate_pairs(town)
    assert set(candidates.items.tolist()) > set(pairs.items.tolist())
    same(scene.candidate_pairs(town, start=candidates.items[3].tolist()).items, candidates.items[3:])
    # The same town as a tile of a moving scene.
    world = espalier.MovingScene([blob], 2, tiles=[town])
    world.insert(espalier.transform(), 1)
    origins = random.uniform(-12, 12, (200, 3))
    through, into = world.raycast(origins, -origins), town.raycast(origins, -origins)
    same(through["t"], into["t"])
    np.testing.assert_array_equal(through["in_tile"], into["instance"])


def test_work_limits_and_many_pairs(blob):
    scene = espalier.MovingScene([blob], 80)
    scene.insert(np.repeat(espalier.transform()[None], 80, axis=0))
    many = scene.candidate_pairs()
    assert len(many.items) == 80 * 79 // 2 and many.status == OK
    np.testing.assert_array_equal(np.stack([many.items["a"], many.items["b"]]), np.triu_indices(80, 1))
    limited = scene.colliding_pairs(work_limit=1000)
    assert limited.status == espalier.Status.WORK_LIMIT and 0 < len(limited.items) < len(many.items)
    assert limited.next == tuple(many.items[len(limited.items)])
    rest = scene.colliding_pairs(start=limited.next)
    same(np.append(limited.items, rest.items), many.items)


def test_refused_movements(blob, scene, random):
    handles = scene.handles()[15:20]
    before = scene.instances()["transform"][15:20].copy()
    places = some_places(random, 5)
    places[1] = np.nan
    places[3, 4] = 1e30
    handles["generation"][4] += 1
    status = scene.move(handles, places)
    assert status.tolist() == [0, espalier.Status.INVALID_ARGUMENT, 0, espalier.Status.OUT_OF_RANGE,
                               espalier.Status.STALE_HANDLE]
    after = scene.instances()["transform"][15:20]
    np.testing.assert_array_equal(after[[0, 2]], places[[0, 2]])
    np.testing.assert_array_equal(after[[1, 3, 4]], before[[1, 3, 4]])
    assert scene.raycast([0, 0, 50], [0, 0, -1])["status"] <= espalier.Status.NOT_FOUND
    one = scene.handles()[15]
    assert scene.move(one, places[0]).shape == () and scene.set_masks([one, one], 1).tolist() == [0, 0]


def test_another_pose(mesh):
    rest = espalier.bake(*mesh, deformable=True, range=[[-9, -9, -9], [9, 9, 9]])
    pose = rest.refit(mesh[0] + np.float32([0, 0, 3])).blob
    scene = espalier.MovingScene([rest], 4)
    scene.insert(espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    scene.end_step()
    low = scene.raycast([3, 0, 10], [0, 0, -1])["t"]
    scene.set_mesh(0, pose)
    assert abs(low - scene.raycast([3, 0, 10], [0, 0, -1])["t"] - 3) < 1e-3
    other = espalier.MovingScene([pose], 4)
    other.insert(espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    same(scene.raycast([[23, 0, 10], [3, 0, 10]], [0, 0, -1]), other.raycast([[23, 0, 10], [3, 0, 10]], [0, 0, -1]))
    assert scene.blobs == (pose,)
    for wrong in (-1, 1):
        raises(IndexError, f"no mesh {wrong}", scene.set_mesh, wrong, pose)
    far = espalier.MovingScene([rest], 1, -30)
    far.insert(espalier.transform(scale=0.1))
    before = far.raycast([0.3, 0, 10], [0, 0, -1])
    raises(ValueError, "mesh 0 keeps its blob", far.set_mesh, 0, espalier.bake(mesh[0] * 100, mesh[1]))
    same(far.raycast([0.3, 0, 10], [0, 0, -1]), before)
    assert before["status"] == OK and far.blobs == (rest,)


def test_a_mesh_with_another_lattice(mesh, blob, points, directions):
    """The slack of queries, which a snapshot has, follows from the lattices."""
    large = espalier.bake(mesh[0] * 100, mesh[1])
    scene, other = espalier.MovingScene([blob], 4), espalier.MovingScene([large], 4)
    for each in (scene, other):
        each.insert(espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    scene.set_mesh(0, large)
    same(scene.raycast(points, directions), other.raycast(points, directions))
    copy = pickle.loads(pickle.dumps(scene))
    same(copy.raycast(points, directions), other.raycast(points, directions))


def test_snapshots(blob, scene, points, directions):
    copy = pickle.loads(pickle.dumps(scene))
    same(copy.raycast(points, directions), scene.raycast(points, directions))
    assert copy.snapshot() == scene.snapshot()
    again = espalier.open_moving_scene(scene.snapshot(), [blob])
    handle = scene.handles()[20]
    assert again.remove(handle) == OK and again.instance_count == scene.instance_count - 1 == 49
    for wrong in (b"", scene.snapshot()[:-1], bytes(1000)):
        raises(ValueError, "no snapshot", espalier.open_moving_scene, wrong, [blob])
    raises(ValueError, "no snapshot", espalier.open_moving_scene, scene.snapshot(), [])


def test_slots_and_facts(scene):
    assert (scene.instance_count, scene.capacity, scene.slot_end, scene.step_exponent) == (50, 64, 60, -10)
    handles, instances = scene.handles(), scene.instances()
    free = handles["status"] == espalier.Status.NOT_FOUND
    assert np.flatnonzero(free).tolist() == list(range(5, 15))
    assert (instances["source"][free] == espalier.NO_TRIANGLE).all() and (instances["mask"][free] == 0).all()
    np.testing.assert_array_equal(instances["user"][~free], np.flatnonzero(~free))
    assert scene.quality == np.inf
    scene.repack()
    assert scene.quality == 1 and "50 instances" in repr(scene)


def test_queries_and_changes_of_many_threads(scene, random):
    origins, answers = random.uniform(-12, 12, (3000, 3)).astype(np.float32), []
    handles = scene.handles()[20:]
    states, expected = [some_places(random, len(handles)) for _ in range(2)], []
    bits = lambda hits: tuple(hits[name].tobytes() for name in ("t", "triangle", "instance", "status"))
    for places in states:
        scene.move(handles, places)
        expected.append(bits(scene.raycast(origins, -origins)))

    assert expected[0] != expected[1]

    def query():  # until both states were met
        end = time.monotonic() + 60
        for _ in range(10):
            answers.append(bits(scene.raycast(origins, -origins, threads=2)))
        while len(set(answers)) < 2 and time.monotonic() < end:
            answers.append(bits(scene.raycast(origins, -origins, threads=2)))

    threads = [threading.Thread(target=query) for _ in range(2)]
    for thread in threads:
        thread.start()
    step = 0
    while any(thread.is_alive() for thread in threads):  # each query meets one state, and no mixture
        assert (scene.move(handles, states[step % 2]) == OK).all()
        scene.colliding_pairs(only_moved=True, work_limit=1000)
        step += 1
    assert set(answers) == set(expected)


def test_instances_moved_by_whole_steps_of_the_world_are_on_its_lattice():
    tile = espalier.bake([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], step_exponent=-10)
    scene = espalier.MovingScene([tile], 3, -10)
    handles = scene.insert(espalier.transform(translation=[(0, 0, 0), (1, 0, 0), (1, 0, 2**-12)]))
    assert scene.is_on_common_lattice(handles).tolist() == [True, True, False]
    scene.remove(handles[:1])
    assert scene.is_on_common_lattice(handles).tolist() == [False, True, False]


def test_messages(blob, scene):
    handles = scene.handles()
    for call, error, message in (
            (lambda: espalier.MovingScene([blob], 0), ValueError, "capacity must be from 1"),
            (lambda: espalier.MovingScene([blob], 8, 81), ValueError, "step_exponent"),
            (lambda: espalier.MovingScene([bytes(blob)], 8), TypeError, "blobs must be Blob objects"),
            (lambda: espalier.MovingScene([blob], 8, tiles=[blob]), TypeError, "tiles must be Scene objects"),
            (lambda: scene.remove([0, 1]), TypeError, "those that insert"),
            (lambda: scene.move(handles, np.zeros((60, 7))), ValueError, r"places must have the shape \(..., 8\)"),
            (lambda: scene.move(handles, np.zeros((4, 8))), ValueError, "broadcast"),
            (lambda: scene.set_masks(handles, -1), ValueError, "masks must be integers from 0"),
            (lambda: scene.candidate_pairs(blob), TypeError, "baked must be a Scene"),
            (lambda: scene.candidate_pairs(start=(0, 0, 0)), ValueError, "start must be 2 integers"),
            (lambda: scene.colliding_pairs(work_limit=-1), ValueError, "work_limit"),
            (lambda: scene.insert(np.zeros((2, 7))), ValueError, "places must have the shape"),
            (lambda: scene.overlaps(espalier.ConvexVolume(np.zeros((4, 4)))), TypeError, "takes no ConvexVolume")):
        raises(error, message, call)
