"""Arrays of any type and strides, shapes that broadcast, and what is refused."""

import os

import numpy as np

import espalier
from conftest import raises, same


def test_strides_and_types_do_not_change_answers(blob, points, directions):
    expected = blob.raycast(points, directions)
    wide = np.zeros((len(points), 7), np.float32)
    wide[:, 2:5] = points
    same(blob.raycast(wide[:, 2:5], directions), expected)
    same(blob.raycast(np.asfortranarray(points), directions), expected)
    same(blob.raycast(points[::-1], directions[::-1])[::-1].copy(), expected)
    same(blob.raycast(points.astype(">f4"), directions.astype(np.float64)), expected)
    unaligned = np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view("V12")
    unaligned = np.ndarray(points.shape, np.float32, unaligned.base, 1)
    same(blob.raycast(unaligned, directions), expected)
    same(blob.raycast(points.reshape(40, 50, 3), directions.reshape(40, 50, 3)).ravel(), expected)
    grid = points.reshape(40, 50, 3).swapaxes(0, 1)
    same(blob.raycast(grid, directions.reshape(40, 50, 3).swapaxes(0, 1)).swapaxes(0, 1).copy().ravel(), expected)


def test_float64_is_rounded_to_the_nearest(blob):
    origin = np.array([0.1, 1 / 3, 5.0])
    same(blob.closest_point(origin), blob.closest_point(origin.astype(np.float32)))
    with np.errstate(over="ignore"):
        assert blob.closest_point([1e300, 0, 0])["status"] == espalier.Status.INVALID_ARGUMENT


def test_arguments_broadcast(blob, points):
    origins, directions = points[20:30, None], np.eye(3, dtype=np.float32)
    hits = blob.raycast(origins, directions, t_max=[1.0, 2.0, 3.0])
    assert hits.shape == (10, 3)
    for i in range(10):
        for k in range(3):
            one = blob.raycast(origins[i, 0], directions[k], t_max=k + 1)
            assert one.shape == () and one.tobytes()[:30] == hits[i, k].tobytes()[:30]
    assert blob.raycast(np.zeros((0, 3)), [0, 0, 1]).shape == (0,)
    assert blob.all_hits(np.zeros((0, 3)), [0, 0, 1]).offsets.tolist() == [0]


def test_wrong_arguments_raise(blob, points):
    for error, message, call in (
            (ValueError, r"origins must have the shape \(..., 3\), not \(4, 2\)",
             lambda: blob.raycast(np.zeros((4, 2)), [0, 0, 1])),
            (ValueError, "do not broadcast", lambda: blob.raycast(points, points[:7])),
            (TypeError, "real numbers", lambda: blob.contains(points.astype(complex))),
            (TypeError, "", lambda: blob.contains([["a", "b", "c"]])),
            (ValueError, "culling", lambda: blob.raycast(points, [0, 0, 1], culling="left")),
            (TypeError, "shape of espalier", lambda: blob.overlaps(points)),
            (TypeError, "no ConvexHull", lambda: blob.overlaps(espalier.ConvexHull(points[:4]))),
            (TypeError, "takes no", lambda: blob.overlaps(espalier.ConvexHull(points[:4]))),
            (TypeError, "takes no", lambda: blob.overlaps(espalier.Segment(points[:4], points[:4]))),
            (TypeError, "integers", lambda: blob.corners([0.5])),
            (ValueError, "rotation", lambda: espalier.transform((5, 6, 7), (0, 0, 0, 1))),
            (ValueError, "no transform",
             lambda: espalier.transform_from_matrix(np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [5, 6, 7, 1]]))),
            (ValueError, "places", lambda: espalier.bake_scene([blob], np.zeros((4, 16)))),
            (ValueError, "the number of the blob of each place, as there are 2 blobs",
             lambda: espalier.bake_scene([blob, blob], espalier.transform())),
            (TypeError, "a list of blobs", lambda: espalier.bake_scene(blob, espalier.transform())),
            (TypeError, "not a Scene", lambda: espalier.pairs.distance(espalier.bake_scene([blob], espalier.transform()), blob))):
        raises(error, message, call)


def test_points_are_no_shapes(blob):
    scene, at = espalier.bake_scene([blob], espalier.transform()), [3.0, 0.0, 5.0]
    moving = espalier.MovingScene([blob], 4, -20)
    class Own(espalier.Segment):
        pass

    segment = espalier.Segment(at, at)
    for shape in (segment, espalier.Box(at, at), espalier.Ray(at, at), espalier.Triangle([at, at, at]), Own(at, at),
                  [segment, segment], ([segment],)):
        name = "Segment" if type(shape) in (list, tuple) else type(shape).__name__
        for call in (scene.closest_point, moving.closest_point, blob.signed_distance, blob.contains, blob.winding_number,
                     lambda points: blob.distance_bounds(points, 0.1), lambda points: blob.closest_triangles(points, 4),
                     lambda points: blob.raycast(points, at)):
            raises(TypeError, f"must be an array of numbers, not a {name}", call, shape)
    raises(TypeError, "not a Ray", blob.closest_point, espalier.Ray(at, at))


def test_matrices_that_are_no_transforms_say_why():
    for why, matrix in (("scales unequally, by 1, 2, 1", np.diag([1, 2, 1, 1])), ("mirrors", np.diag([-1, 1, 1, 1])),
                        ("shears", [[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]),
                        ("fourth row", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [5, 6, 7, 1]]),
                        ("not finite", np.diag([1, np.nan, 1, 1])), ("not finite", np.diag([1e300, 1e300, 1e300, 1]))):
        with np.errstate(over="ignore"):
            raises(ValueError, why, espalier.transform_from_matrix, np.array(matrix, np.float64))
    raises(ValueError, r"matrix \(1,\) is no transform: it mirrors", espalier.transform_from_matrix,
           np.array([np.eye(4), np.diag([1, -1, 1, 1])]))


def test_arguments_of_bakes_are_named(mesh, tmp_path):
    raises(TypeError, "no option 'ids'; its options are bits, tolerance.*original_ids", espalier.bake, *mesh, ids=True)
    raises(TypeError, "tolerance must be a number, in the unit of the mesh, not '0.5mm'", espalier.bake, *mesh, tolerance="0.5mm")
    raises(TypeError, "of a MeshFile give its `meshes`", espalier.bake_meshes, [mesh[0], mesh[1]])
    triangles = np.array(mesh[1], np.int64)
    triangles[5, 2] = -7
    raises(espalier.BakeError, "triangle 5: .*vertex -7,", espalier.bake, mesh[0], triangles)
    triangles[5, 2] = 2**32
    raises(espalier.BakeError, "vertex 4294967296,", espalier.bake_meshes, [mesh, (mesh[0], triangles)])
    assert espalier.bake(mesh[0], triangles, drop_bad_triangles=True).triangle_count == len(triangles) - 1
    path = tmp_path / "flat.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    raises(espalier.BakeError, "flat.obj", espalier.bake_file, path)
    raises(FileNotFoundError, "none/x.espl'$", espalier.bake(*mesh).save, tmp_path / "none" / "x.espl")
    raises(espalier.BakeError, "flat.obj", espalier.bake_file, os.fsencode(path))
    raises(TypeError, "no option 'tol'; its options are bits, .*, format, unit", espalier.bake_file, path, tol=1)
    path.write_bytes(b"espalier")
    raises(espalier.OpenError, "flat.obj: ", espalier.open_blob, path)
    raises(espalier.OpenError, "flat.obj: ", espalier.open_scene, str(path))


def test_statuses_of_single_queries(blob, open_mesh_blob):
    status = blob.raycast([[0, 0, 5], [np.nan, 0, 0], [9, 9, 9]], [[0, 1, -1], [0, 0, 1], [0, 0, 1]])["status"]
    assert status[1] == espalier.Status.INVALID_ARGUMENT and status[2] == espalier.Status.NOT_FOUND
    miss = blob.raycast([9, 9, 9], [0, 0, 1])
    assert miss["t"] == np.inf and miss["triangle"] == espalier.NO_TRIANGLE
    refused = open_mesh_blob.contains([0, 0, 0])
    assert refused.status == espalier.Status.NOT_CLOSED and not refused.yes and not refused.no
    assert refused.value_or(True) and not refused.value_or(False)
    raises(TypeError, "no truth value", bool, refused)
    assert open_mesh_blob.raycast_sources([3, 0, 5], [0, 0, -1]).sources["status"] == espalier.Status.NO_DATA
    assert blob.original_triangles([0, -1, 2**40])["status"].tolist() == [0, 1, 1]
    assert all(each.describe() for each in espalier.Status)


def test_lists(blob, points, directions):
    hits = blob.all_hits(points, directions, threads=2)
    same(hits.items, blob.all_hits(points, directions).items)
    closest = blob.raycast(points, directions)
    found = closest["status"] == espalier.Status.OK
    np.testing.assert_array_equal(hits.counts() > 0, found)
    np.testing.assert_array_equal(np.minimum.reduceat(hits.items["t"], hits.offsets[:-1][found]), closest["t"][found])
    first = blob.closest_hits(points, directions, 1)
    same(first.items, closest[found])
    assert set(first.status) >= {espalier.Status.OK, espalier.Status.OUTPUT_FULL}
    crossings = blob.crossings(points, directions)
    outside = blob.contains(points).no & (crossings.status == 0)
    assert (crossings.counts()[outside] % 2 == 0).all()
    near = blob.closest_triangles(points[20:40], 4)
    assert near.counts().tolist() == [4] * 20
    same(near.items[near.offsets[:-1]], blob.closest_point(points[20:40]))
    assert [len(each) for each in near.each()] == [4] * 20 and near.queries()[5] == 1


def test_lists_of_any_length(blob, points):
    assert blob.closest_triangles(points[20], 2**62).counts() == blob.triangle_count
    assert blob.closest_hits([3, 0.1, 5], [0, 0, -1], 2**62).counts() == 2
    assert blob.closest_hits([3, 0.1, 5], [0, 0, -1], 0).counts() == 0
    raises(MemoryError, "", blob.contacts, espalier.Sphere([4, 0, 0], 1), most=2**62)
    raises((TypeError, ValueError), "", blob.closest_triangles, points, -1)
    # 2^62 rays: their bytes do not fit an integer of 64 bits.
    origins, far = np.zeros((2, 1, 1, 3), np.float32), np.broadcast_to(np.float32(1), (1, 1, 2**31))
    raises(MemoryError, "", blob.raycast, origins, np.broadcast_to(np.float32([0, 0, 1]), (1, 2**30, 1, 3)), t_max=far)


def test_triangles(blob, mesh):
    corners = blob.triangles()
    assert corners.shape == (blob.triangle_count, 3, 3)
    np.testing.assert_array_equal(blob.corners(np.arange(blob.triangle_count))["corners"], corners)
    source = blob.original_triangles(np.arange(blob.triangle_count))
    turn = (np.arange(3) + source["first_corner"][:, None]) % 3
    original = mesh[0][np.take_along_axis(mesh[1][source["triangle"]], turn, axis=1)]
    assert np.abs(original - corners).max() <= 2 * blob.max_error
