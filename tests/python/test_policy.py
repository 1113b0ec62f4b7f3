"""What a bake of arrays may lose before it is refused: as the command's bakes."""

import numpy as np
import pytest

import espalier


def cube_and(extra):
    """Returns a cube of 12 triangles and more triangles, each of three positions."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32)
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    positions = np.concatenate([corners] + [np.array(triangle, np.float32) for triangle in extra])
    more = [[8 + 3 * i, 9 + 3 * i, 10 + 3 * i] for i in range(len(extra))]
    return positions, np.array(faces + more, np.uint32)


def along(i):
    return [[0, 0, 0], [0.25, 0, 0], [1 + i, 0, 0]]


def test_lost_triangles_refuse_a_bake():
    with pytest.raises(espalier.BakeError, match="dropped 2 of 14 triangles: 2 without area .* max_dropped"):
        espalier.bake(*cube_and([along(0), along(1)]))
    blob = espalier.bake(*cube_and([along(0), along(1)]), max_dropped=20)
    assert blob.triangle_count == 12 and blob.report["zero_area"]["count"] == 2
    point = [[0, 0, 0], [0, 0, 0], [1, 0, 0]]
    blob = espalier.bake(*cube_and([point] * 9), max_dropped=0)
    assert blob.report["zero_area"]["count"] == blob.report["equal_corners"] == 9


def test_an_empty_blob_is_for_those_who_want_one():
    nothing = np.zeros((0, 3), np.float32), np.zeros((0, 3), np.uint32)
    with pytest.raises(espalier.BakeError, match="no triangle is left"):
        espalier.bake(*nothing)
    assert espalier.bake(*nothing, allow_empty=True).triangle_count == 0


def test_strict_refuses_warnings():
    positions, faces = cube_and([])
    with pytest.warns(espalier.BakeWarning):
        espalier.bake(positions, faces, bits=24)
    with pytest.raises(espalier.BakeError, match="strict refuses a warning"):
        espalier.bake(positions, faces, bits=24, strict=True)
