"""Meshes, hard arguments, and the library's functions of C, which every answer is compared with bit for bit."""

import os

import numpy as np
import pytest

import espalier
from c_library import Library


def torus(rings=40, sides=24):
    """Returns a closed mesh of many triangles."""
    angles = np.linspace(0, 2 * np.pi, rings, endpoint=False)[:, None]
    turns = np.linspace(0, 2 * np.pi, sides, endpoint=False)[None, :]
    distance = 3 + np.cos(turns) * (1 + 0.1 * np.sin(5 * angles))
    positions = np.stack([distance * np.cos(angles), distance * np.sin(angles), np.sin(turns) + 0 * angles], -1)
    ring, side = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    at = lambda i, j: (i % rings) * sides + j % sides
    a, b, c, d = at(ring, side), at(ring + 1, side), at(ring + 1, side + 1), at(ring, side + 1)
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return positions.reshape(-1, 3).astype(np.float32), triangles.astype(np.uint32)


def ply_of(positions, triangles):
    """Returns the parts of a binary PLY file: header, vertices and faces."""
    faces = np.zeros(len(triangles), [("n", "u1"), ("v", "<3i4")])
    faces["n"], faces["v"] = 3, triangles
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    return header.encode(), positions.astype("<f4").tobytes(), faces.tobytes()


@pytest.fixture(scope="session")
def mesh():
    return torus()


@pytest.fixture(scope="session", params=["balanced", "fast"])
def blob(request, mesh):
    return espalier.bake(*mesh, profile=request.param, original_ids=True, flat_angle=5.0)


@pytest.fixture(scope="session")
def open_mesh_blob(mesh):
    return espalier.bake(mesh[0], mesh[1][5:])


@pytest.fixture
def random():
    return np.random.default_rng(12345)


@pytest.fixture
def points(random):
    """2,000 points: most near the mesh, some far away, infinite or NaN."""
    points = random.uniform(-5, 5, (2000, 3)).astype(np.float32)
    points[::97] *= np.float32(1e20)
    points[5], points[6], points[7] = np.nan, np.inf, 3e38
    points[8:11] = [[4, 0, 0], [3, 0, 1], [0, 0, 0]]
    return points


@pytest.fixture
def directions(random, points):
    directions = (random.uniform(-1, 1, points.shape) - points).astype(np.float32)
    directions[11], directions[12] = 0, np.nan
    return directions


@pytest.fixture(scope="session")
def library():
    path = os.environ.get("ESPALIER_LIBRARY")
    if not path:
        pytest.skip("ESPALIER_LIBRARY does not name a libespalier.so to compare with")
    return Library(path)


def raises(error, message, call, *arguments, **options):
    """Tests whether a call raises this error with this message, a regular expression."""
    with pytest.raises(error, match=message or None):
        call(*arguments, **options)


def codes(answers):
    """Returns the numbers that the functions of C return for a YesNo: there, NOT_FOUND is a no."""
    return np.where(answers.no, np.uint8(espalier.Status.NOT_FOUND), answers.status)


def same(answers, expected):
    """Tests whether two arrays have the same bits in all fields; only NaNs may differ in theirs."""
    assert answers.shape == expected.shape and answers.dtype == expected.dtype
    if answers.dtype.names is None:
        np.testing.assert_array_equal(answers, expected)
        return
    for name in answers.dtype.names:
        ours, theirs = np.ascontiguousarray(answers[name]), np.ascontiguousarray(expected[name])
        np.testing.assert_array_equal(ours, theirs, err_msg=name)
        if ours.dtype.kind == "f":
            np.testing.assert_array_equal(np.signbit(ours), np.signbit(theirs), err_msg=name)
