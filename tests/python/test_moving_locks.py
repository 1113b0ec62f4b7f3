"""Threads that query and change one moving scene: none waits for ever, neither for others nor for itself."""

import gc
import threading

import numpy as np
import pytest

import espalier
from test_moving_scenes import OK, scene, some_places  # noqa: F401

READERS = 4
QUERIES = 100


def test_a_change_does_not_wait_for_queries_that_begin_later(scene, random):  # noqa: F811
    """At each moment some of the threads are in a query, so that a lock which prefers readers never becomes free."""
    origins = random.uniform(-12, 12, (20_000, 3)).astype(np.float32)
    directions, handles, places = -origins, scene.handles()[20:], some_places(random, 40)
    counts, is_changed = [0] * READERS, threading.Event()

    def query(reader):
        while counts[reader] < QUERIES and not is_changed.is_set():
            scene.raycast(origins, directions)
            counts[reader] += 1

    readers = [threading.Thread(target=query, args=(reader,)) for reader in range(READERS)]
    for reader in readers:
        reader.start()
    while min(counts) == 0 and all(reader.is_alive() for reader in readers):
        is_changed.wait(0.001)
    for _ in range(5):
        assert (scene.move(handles, places) == OK).all()
    is_changed.set()
    before_the_end = list(counts)
    for reader in readers:
        reader.join()
    # Each change lets a thread end one query; the rest of the bound is for a machine that is busy.
    assert max(before_the_end) < QUERIES


def test_no_query_waits_for_itself(blob, scene, random):  # noqa: F811
    """Python's collector runs where an object is made, and runs the finalizers of others, which may use the scene.

    A call that made an object under the scene's lock would then wait for itself. From Python 3.12 on the collector runs
    between instructions only, and this test cannot fail.
    """
    town = espalier.bake_scene([blob], some_places(random, 5))
    handle, calls = scene.handles()[20], []

    class Restless:
        """Garbage, whose finalizer changes and queries the scene, and leaves the next garbage."""

        def __init__(self):
            self.cycle = self

        def __del__(self):
            scene.set_users(handle, len(calls))
            calls.append(scene.slot_end)
            if not is_done.is_set():
                Restless()

    kept, is_done = [], threading.Event()  # what is kept leaves no objects to be used again without the collector

    def use():
        core, sphere = scene._core, espalier.Sphere(np.zeros((3, 3)), 3.0)
        Restless()
        for _ in range(50):
            kept.extend([core.facts(), core.handles(), core.instances(), core.snapshot(), core.quality()])
            kept.extend([scene.raycast(np.zeros((3, 3)), [0, 0, 1]), scene.closest_point(np.zeros((3, 3))),
                         scene.overlaps(sphere), scene.sweep(sphere, [0, 0, 1])])
            kept.extend([scene.all_hits(np.zeros((3, 3)), [0, 0, 1]), scene.overlapping_triangles(sphere)])
            kept.extend([scene.candidate_pairs(), scene.colliding_pairs(), scene.candidate_pairs(town),
                         scene.colliding_pairs(town)])
            kept.append(scene.remove(scene.insert(espalier.transform()[None])))
            kept.extend([scene.move(handle, espalier.transform()), scene.set_masks(handle, 1)])
            scene.set_mesh(0, blob)
            scene.repack()
            scene.end_step()
        is_done.set()

    thresholds = gc.get_threshold()
    gc.set_threshold(1, 1_000_000, 1_000_000)
    try:
        thread = threading.Thread(target=use, daemon=True)
        thread.start()
        thread.join(120)
    finally:
        gc.set_threshold(*thresholds)
    assert is_done.is_set(), "a call waits for itself"
    assert len(calls) > 100
