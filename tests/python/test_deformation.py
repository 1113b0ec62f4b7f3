"""Deformable blobs: poses are those of C, bit for bit, and what is refused names the position."""

import ctypes
import pickle

import numpy as np
import pytest

import espalier
from conftest import raises, same


@pytest.fixture(scope="module")
def stretched(mesh):
    positions = mesh[0].copy()
    positions[:, 2] *= 2
    positions[:, 0] += 0.25 * positions[:, 1]
    return positions


@pytest.fixture(scope="module")
def cloth(mesh, stretched):
    return espalier.bake(*mesh, deformable=True, range=[[-6, -6, -4], [6, 6, 4]], poses=[stretched], original_ids=True)


def test_a_pose_has_the_bytes_of_c(library, cloth, stretched):
    data = ctypes.create_string_buffer(bytes(cloth), len(bytes(cloth)))
    copy, mesh = library.room_for("blob"), library.room_for("deformable")
    assert library.open(data, len(data), copy) == 0
    assert library.create_deformable(copy, data, library.deformable_bytes(copy), mesh) == 0
    moved = library.deformable_refit(mesh, stretched, len(stretched))
    assert moved.status == 0 and library.deformable_seal(mesh, data, len(data)) == 0
    refitted = cloth.refit(stretched)
    assert bytes(refitted.blob) == data.raw and refitted.quality == moved.quality


def test_a_pose_depends_on_the_positions_alone(mesh, cloth, stretched, points, directions):
    before = bytes(cloth)
    pose = cloth.refit(stretched.astype(np.float64)).blob
    assert bytes(pose) != before and bytes(cloth) == before
    assert bytes(pose.refit(mesh[0]).blob) == before
    assert bytes(cloth.refit(mesh[0].tolist()).blob) == before
    assert pose.is_deformable and not espalier.bake(*mesh).is_deformable
    espalier.verify(pose)
    fresh = espalier.bake(stretched, mesh[1], profile="fast")
    near = points[np.abs(points).max(1) < 10]
    differences = np.abs(pose.closest_point(near)["distance"] - fresh.closest_point(near)["distance"])
    assert len(near) > 1000 and differences.max() < 2 * (pose.max_error + fresh.max_error)
    same(pickle.loads(pickle.dumps(pose)).raycast(points, directions), pose.raycast(points, directions))


def test_poses_are_baked_less_the_origin(mesh, stretched):
    origin = np.array([500_000.0, 4_000_000.0, 100.0])
    options = dict(deformable=True, bits=12)
    near = espalier.bake(*mesh, range=[[-6, -6, -4], [6, 6, 4]], poses=[stretched], **options)
    far = espalier.bake(mesh[0] + origin, mesh[1], range=np.array([[-6, -6, -4], [6, 6, 4]]) + origin,
                        poses=[stretched + origin], origin=origin, **options)
    assert near.report["step"] == far.report["step"]
    np.testing.assert_allclose(near.bounds, far.bounds - origin, atol=0.01)
    assert far.origin.tolist() == far.refit(stretched + origin).blob.origin.tolist() == origin.tolist()
    plain = espalier.bake(*mesh, range=[[-6, -6, -4], [6, 6, 4]], **options)
    assert bytes(plain) != bytes(near)
    plain.refit(mesh[0] * 1.3)  # outside of the range that a bake takes by itself
    raises(ValueError, "outside", espalier.bake(*mesh, **options).refit, mesh[0] * 1.3)


def test_refits_are_refused_by_position(mesh, cloth):
    positions = mesh[0].copy()
    positions[17] = 50
    raises(ValueError, r"position 17, \[50.0, 50.0, 50.0\], is outside", cloth.refit, positions)
    positions[17] = np.nan
    raises(ValueError, "position 17, .nan, nan, nan., is no number of float32", cloth.refit, positions)
    raises(ValueError, "position 17, .*no number of float32", cloth.refit,
           np.where(np.isnan(positions), 1e300, positions.astype(np.float64)))
    for count in (0, 959, 961, 5000):
        raises(ValueError, f"from 960 positions, not from {count}", cloth.refit,
               np.resize(np.where(np.arange(960)[:, None] == 0, np.nan, mesh[0]), (count, 3)))
    raises(ValueError, "without deformable", espalier.bake(*mesh).refit, mesh[0])
    for bad in (mesh[0].ravel(), mesh[0][:, :2], [["a", "b", "c"]]):
        raises(ValueError, "shape", cloth.refit, bad)


def test_bakes_are_refused(mesh, stretched):
    raises(ValueError, "deformable=True", espalier.bake, *mesh, poses=[stretched])
    raises(ValueError, r"pose 1 must be numbers in the shape \(960, 3\)", espalier.bake,
           *mesh, deformable=True, poses=[stretched, stretched[1:]])
    raises(ValueError, r"range must be", espalier.bake, *mesh, deformable=True, range=[-6, 6])
    raises(espalier.BakeError, "", espalier.bake, *mesh, deformable=True, profile="small")
