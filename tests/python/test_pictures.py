"""Cameras, pictures, voxels, and borders that part."""

import struct
import warnings
import zlib

import numpy as np
import pytest

import espalier
from conftest import raises


def unpacked(png):
    """Returns the pixels of a PNG file without filters."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, header = 8, b"", None
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at : at + 8])
        body, check = png[at + 8 : at + 8 + size], png[at + 8 + size : at + 12 + size]
        assert struct.unpack(">I", check)[0] == zlib.crc32(kind + body)
        header, data = (body if kind == b"IHDR" else header), data + (body if kind == b"IDAT" else b"")
        at += 12 + size
    width, height, depth, color = struct.unpack(">IIBB", header[:10])
    assert (depth, color, kind) == (8, 2, b"IEND")
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + 3 * width)
    assert (rows[:, 0] == 0).all()
    return rows[:, 1:].reshape(height, width, 3)


def test_a_camera_sees_its_target_in_the_middle():
    rays = espalier.pinhole([0, -10, 0], [0, 0, 0], width=201, height=101, field_of_view=90)
    assert rays.direction.shape == (101, 201, 3)
    np.testing.assert_allclose(rays.direction[50, 100], [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(rays.direction[0, 100], [0, 1, 100 / 101], atol=1e-12)   # the top is up
    np.testing.assert_allclose(rays.direction[50, 200], [200 / 101, 1, 0], atol=1e-12)  # and the end of a row is right
    raises(ValueError, "one point", espalier.pinhole, [0, 0, 0], [0, 0, 0])
    raises(ValueError, "up is along", espalier.pinhole, [0, 0, 0], [0, 0, 1])
    raises(ValueError, "field_of_view", espalier.pinhole, [0, 0, 0], [1, 0, 0], field_of_view=180)


def test_pictures_show_all_and_nothing_else(blob, tmp_path):
    scene = espalier.bake_scene([blob], espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    moving = espalier.MovingScene([blob], 4)
    moving.insert(espalier.transform(translation=[[0, 0, 0], [20, 0, 0]]))
    for shown in (blob, scene, moving):
        picture = shown.render(width=160, height=120)
        drawn = (picture != 255).any(axis=2)
        assert 0.02 < drawn.mean() < 0.7
        assert not drawn[0].any() and not drawn[-1].any() and not drawn[:, 0].any() and not drawn[:, -1].any()
        assert unpacked(shown._repr_png_()).shape == (360, 480, 3)
    espalier.write_png(tmp_path / "torus.png", picture)
    np.testing.assert_array_equal(unpacked((tmp_path / "torus.png").read_bytes()), picture)
    close = blob.render(espalier.pinhole([0, 0, 9], [0, 0, 0], up=[0, 1, 0], width=64, height=64))
    assert (close[32, 32] == 255).all() and (close[32, 5] != 255).any()  # through the hole of the torus
    assert (espalier.MovingScene([blob], 4).render(width=8, height=8) == 255).all()
    raises(ValueError, "shape", blob.render, espalier.Ray([0, 0, 9], [0, 0, -1]))
    raises(ValueError, "uint8", espalier.png_of, np.zeros((4, 4)))


@pytest.mark.parametrize("pitch", [0.5, 0.31])
def test_voxels_fill_the_volume(blob, open_mesh_blob, mesh, pitch):
    grid = espalier.voxel_grid(blob, pitch)
    corners = mesh[0][mesh[1]].astype(float)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    inner, outer = (grid.filled & ~grid.on_surface).sum() * pitch**3, grid.filled.sum() * pitch**3
    assert 0 < inner < abs(volume) < outer
    centers = grid.centers()
    assert centers.shape == (*grid.filled.shape, 3)
    np.testing.assert_array_equal(blob.contains(centers).yes & ~grid.filled, False)
    half = 0.51 * pitch
    low, high = centers[grid.on_surface].min(axis=0) - half, centers[grid.on_surface].max(axis=0) + half
    assert (low <= blob.bounds[0]).all() and (high >= blob.bounds[1]).all()
    near = espalier.voxel_grid(open_mesh_blob, pitch)  # five triangles are missing: nearly the same
    assert near.filled.shape == grid.filled.shape and (near.filled != grid.filled).mean() < 0.02
    some = espalier.voxel_grid(blob, pitch, bounds=[[0, 0, 0], [4, 1, 1]])
    np.testing.assert_array_equal(some.origin, 0)
    raises(ValueError, "pitch", espalier.voxel_grid, blob, 0.0)
    raises(ValueError, "too many", espalier.voxel_grid, blob, 1e-9)


def tile(size, step, z=0.0):
    x, y = np.meshgrid(np.linspace(0, size, 5), np.linspace(0, size, 5), indexing="ij")
    at = np.arange(25).reshape(5, 5)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    heights = np.sin(x * 0.9) * np.cos(y * 1.1) * (x > 0) * (x < size) + z
    return espalier.bake(np.stack([x, y, heights], -1).reshape(-1, 3),
                         np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]), **step)


@pytest.mark.parametrize("size, step, count", [(1.1, {"bits": 16}, 4), (1.0, {"step_exponent": -14}, 0)])
def test_scenes_warn_of_borders_that_part(size, step, count):
    blob, places = tile(size, step), espalier.transform(translation=np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]) * size)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        scene = espalier.bake_scene([blob], places)
        espalier.bake_scene([blob], espalier.transform(translation=[[0, 0, 0], [50, 0, 0]]))  # apart: nothing is shared
        espalier.bake_scene([blob], places[:1])
    assert [each.category for each in caught] == [espalier.BakeWarning] * (count > 0)
    if count:
        assert f"{count} instances share border edges" in str(caught[0].message) and caught[0].filename == __file__
    assert scene.is_on_common_lattice().all() == (count == 0)
