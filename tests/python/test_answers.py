"""Yes, no or neither, and errors that name what is meant."""

import numpy as np

import espalier
from conftest import raises


def test_yes_no_prints_as_its_answers(blob, open_mesh_blob):
    assert repr(blob.contains([3, 0, 0])) == "yes" and str(blob.contains([0, 0, 0])) == "no"
    reason = espalier.Status.NOT_CLOSED.describe()
    assert repr(open_mesh_blob.contains([0, 0, 0])) == f"neither ({reason})"
    assert repr(blob.contains([[3, 0, 0], [0, 0, 0], [np.nan, 0, 0]])) == "[yes, no, neither (INVALID_ARGUMENT)]"
    assert len(repr(blob.contains(np.zeros((100_000, 3))))) < 200


def test_a_plain_no_has_the_status_ok(blob, open_mesh_blob):
    answers = blob.contains([[3, 0, 0], [0, 0, 0], [np.nan, 0, 0]])
    assert answers.yes.tolist() == [True, False, False] and answers.no.tolist() == [False, True, False]
    assert answers.status.tolist() == [espalier.Status.OK, espalier.Status.OK, espalier.Status.INVALID_ARGUMENT]
    assert open_mesh_blob.contains([0, 0, 0]).status == espalier.Status.NOT_CLOSED


def test_type_errors_name_the_class_that_is_meant(blob):
    scene, box = espalier.bake_scene([blob], espalier.transform()), espalier.Box([0, 0, 0], [1, 2, 3])
    hull = espalier.ConvexHull(np.eye(3))
    for holder in (blob, scene):
        raises(TypeError, r"contacts\(\) takes no Box; an OrientedBox is meant", holder.contacts, box)
        raises(TypeError, r"sweep\(\) takes no Triangle; a ConvexHull of its corners", holder.sweep,
               espalier.Triangle(np.eye(3)), [0, 0, 1])
        raises(TypeError, "needs a shape of espalier, Sphere, Capsule, OrientedBox or ConvexHull, not ndarray",
               holder.contacts, np.zeros(3))
    raises(TypeError, r"overlaps\(\) takes no ConvexHull; a ConvexVolume is meant", blob.overlaps, hull)
    raises(TypeError, "overlaps.* takes no ConvexHull, but Sphere, Capsule", scene.overlaps, hull)
    raises(TypeError, "takes no ConvexVolume, but", scene.overlaps, espalier.ConvexVolume(np.eye(4)))
    meant = espalier.OrientedBox((np.array(box.min) + box.max) / 2, np.diag((np.array(box.max) - box.min) / 2))
    assert np.abs(blob.contacts(meant, most=64).items["distance"]).max() < 10


def test_accuracies_never_lose_a_yes(blob, points, directions):
    exact, sphere = blob.occluded(points, directions), espalier.Sphere(points, 0.5)
    for accuracy in (0.0, 0.1, 1.0):
        near = blob.occluded(points, directions, accuracy=accuracy)
        assert not (near.no & exact.yes).any()
        assert accuracy > 0 or (near.yes == exact.yes).all()
        touch = blob.overlaps(sphere, accuracy=accuracy)
        assert not (touch.no & blob.overlaps(sphere).yes).any()
        bounds, distance = blob.distance_bounds(points, accuracy), blob.closest_point(points)
        found = distance["status"] == 0
        assert (bounds["lower"][found] <= distance["distance"][found] * (1 + 1e-6)).all()
        assert (bounds["upper"][found] * (1 + 1e-6) >= distance["distance"][found]).all()
    assert (blob.overlaps(espalier.Sphere(points, 0.05), accuracy=4.0).yes & blob.overlaps(espalier.Sphere(points, 0.05)).no).any()
    raises(ValueError, "takes no filter", blob.occluded, points, directions, accuracy=1.0, only=np.ones(blob.triangle_count, bool))
    raises(TypeError, "takes no Capsule", blob.overlaps, espalier.Capsule([0, 0, 0], [1, 1, 1]), accuracy=1.0)


def test_stored_bounds(mesh):
    blob = espalier.bake(*mesh, bounds=True)
    corners = blob.triangles().reshape(-1, 3).astype(float)
    center, radius = blob.bounding_sphere()
    assert (np.linalg.norm(corners - center, axis=1) <= radius * (1 + 1e-6)).all() and radius < 5
    middle, axes = blob.oriented_bounds()
    assert (np.abs((corners - middle) @ axes.T.astype(float)) <= (axes.astype(float) ** 2).sum(axis=1) * (1 + 1e-5)).all()
    slabs = blob.k_dop_bounds()
    along = corners @ slabs.directions.T.astype(float)
    assert (along >= slabs.low).all() and (along <= slabs.high).all() and slabs.directions.shape == (13, 3)
    raises(ValueError, "without bounds=True", espalier.bake(*mesh).bounding_sphere)


def test_remap_files(mesh, tmp_path):
    blob = espalier.bake(*mesh)
    path = tmp_path / "torus.remap"
    path.write_bytes(blob.remap_file())
    opened = espalier.open_blob(bytes(blob))
    table = espalier.read_remap(path, opened)
    np.testing.assert_array_equal(table, blob.remap)
    hits = opened.raycast([3, 0.1, 5], [0, 0, -1])
    assert opened.original_hits(hits, table)["triangle"] == blob.remap["triangle"][hits["triangle"]]
    raises(espalier.OpenError, "", espalier.read_remap, path, espalier.bake(mesh[0], mesh[1][:-1]))
    raises(espalier.OpenError, "", espalier.read_remap, b"espalier", opened)
    raises(ValueError, "no remap table", opened.remap_file)


def test_normals_and_scenes_that_are_verified(blob):
    place = espalier.transform([0, 0, 1, 1], [1, 2, 3], 5.0)
    np.testing.assert_allclose(espalier.normal_to_world(place, [1, 0, 0]), [0, 1, 0], atol=1e-6)
    scene = espalier.bake_scene([blob], place)
    espalier.verify_scene(scene)
    damaged = bytearray(bytes(scene))
    damaged[-1] ^= 255
    raises(ValueError, "", espalier.verify_scene, bytes(damaged))
