"""How far rounding moves queries, and rays that are lifted off the surface by it."""

import numpy as np
import pytest

import espalier
from conftest import raises, same
from c_library import ray
from test_bits import of, volumes


def test_bounds_are_those_of_c(library, blob, points, directions, random):
    opened, count = library.opened(blob), len(points)
    each = lambda name, arguments: library.each(f"rounding_error_{name}", count, arguments)
    same(blob.rounding_error(points), each("point", lambda i: (opened, points[i])))
    same(blob.rounding_error(espalier.Ray(points, directions), threads=2),
         each("ray", lambda i: (opened, ray(points[i], directions[i]))))
    shapes = volumes(points, random)
    with np.errstate(invalid="ignore"):
        shapes["segment"] = espalier.Segment(points, points + directions)
    for kind in ("segment", "sphere", "capsule", "box", "oriented_box", "triangle"):
        shape = shapes[kind]
        same(blob.rounding_error(shape), each(kind, lambda i: (opened, of(shape, i))))
    for kind in ("sphere", "capsule", "box", "oriented_box", "convex_hull"):
        shape = shapes[kind]
        same(blob.rounding_error(shape, directions),
             library.each(f"rounding_error_sweep_{kind}", count, lambda i: (opened, of(shape, i), directions[i])))


def test_what_it_does_not_take_names_what_it_takes(blob):
    raises(TypeError, r"rounding_error\(\) takes no ConvexHull, but Segment, Sphere", blob.rounding_error,
           espalier.ConvexHull(np.eye(3)))
    raises(TypeError, "a Capsule is meant", blob.rounding_error, espalier.Segment([0, 0, 0], [1, 1, 1]), [1, 0, 0])


@pytest.mark.parametrize("place", [0, 1000])
def test_a_lift_by_the_bounds_leaves_the_surface(random, place):
    """Whole coordinates are baked as they are, so that max_error is 0 and no lift by it helps."""
    x, y = np.meshgrid(np.arange(33), np.arange(33), indexing="ij")
    z = (7 * np.sin(x / 3.0) * np.cos(y / 4.0)).round()
    positions = np.stack([x, y, z], -1).reshape(-1, 3) + place
    at = np.arange(33 * 33).reshape(33, 33)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    blob = espalier.bake(positions, np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]), step_exponent=0)
    assert blob.max_error == 0
    eyes = random.uniform(2, 30, (4000, 3)) + [place, place, place + 60]
    ways = random.uniform(2, 30, (4000, 3)) + place - eyes
    hits = blob.raycast_sources(eyes, ways)
    found = hits.hits["status"] == 0
    hits, eyes, ways = espalier.SourceHits(*(part[found] for part in hits)), eyes[found], ways[found]
    assert found.sum() > 3000
    normal = hits.hits["normal"] * np.where(hits.hits["side"] == 1, -1, 1)[:, np.newaxis]
    bounce = ways - 2 * np.einsum("ij,ij->i", ways, normal)[:, np.newaxis] * normal
    bounds = (blob.rounding_error(espalier.Ray(eyes, ways))["value"]
              + blob.rounding_error(espalier.Ray(hits.points, bounce))["value"])
    lifted = hits.points + 2 * bounds[:, np.newaxis] * normal
    again = blob.raycast(lifted, bounce)
    own = lambda found: (found["status"] == 0) & (found["triangle"] == hits.hits["triangle"])
    assert not own(again).any()
    assert own(blob.raycast(hits.points, bounce)).mean() > 0.2  # what a lift by max_error leaves
