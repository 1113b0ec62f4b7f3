"""Opening blobs and baking: where bytes lie, how long they live, and what is refused."""

import gc
import mmap
import os
import pickle
import sys

import numpy as np
import pytest

import espalier
from conftest import ply_of, raises, same


@pytest.fixture
def expected(blob, points, directions):
    return blob.raycast(points, directions)


def test_bytes_are_looked_at_and_kept(blob, points, directions, expected):
    data = bytes(blob)
    opened = espalier.open_blob(data)
    assert opened.is_view
    del data
    gc.collect()
    same(opened.raycast(points, directions), expected)
    view = opened.data
    del opened
    gc.collect()
    assert bytes(view) == bytes(blob) and view.readonly


def test_a_blob_is_saved_to_the_file_that_it_was_opened_from(blob, points, directions, expected, tmp_path):
    path = tmp_path / "torus.espl"
    blob.save(path)
    opened = espalier.open_blob(path)
    opened.save(path)
    assert path.read_bytes() == bytes(blob)
    espalier.bake([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]).save(str(path))
    same(opened.raycast(points, directions), expected)
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_that_cannot_be_written_stays(blob, tmp_path, monkeypatch):
    path = tmp_path / "torus.espl"
    path.write_bytes(b"before")

    def refuse(source, target):
        raise PermissionError(target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", refuse)
        raises(PermissionError, "", blob.save, path)
    assert path.read_bytes() == b"before" and list(tmp_path.iterdir()) == [path]
    raises(FileNotFoundError, "", blob.save, tmp_path / "absent" / "torus.espl")
    link = tmp_path / "link.espl"
    link.symlink_to("target.espl")
    blob.save(link)
    assert link.is_symlink() and (tmp_path / "target.espl").read_bytes() == bytes(blob)
    blob.save("/dev/null")


def test_files_are_mapped(blob, points, directions, expected, tmp_path):
    blob.save(tmp_path / "torus.espl")
    opened = espalier.open_blob(tmp_path / "torus.espl")
    assert opened.is_view
    same(opened.raycast(points, directions), expected)
    with open(tmp_path / "torus.espl", "rb") as file:
        mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    by_hand = espalier.open_blob(mapped)
    raises(BufferError, "", mapped.close)
    same(by_hand.raycast(points, directions), expected)
    memmap = np.memmap(tmp_path / "torus.espl", np.uint8, "r")
    assert espalier.open_blob(memmap).is_view


def test_writable_and_misaligned_bytes(blob, points, directions, expected):
    writable = bytearray(bytes(blob))
    opened = espalier.open_blob(writable)
    assert not opened.is_view
    writable[:] = bytes(len(writable))
    same(opened.raycast(points, directions), expected)
    for shift in (1, 2, 8):
        moved = memoryview(bytes(shift) + bytes(blob))[shift:]
        same(espalier.open_blob(moved).raycast(points, directions), expected)
    raises((BufferError, ValueError), "contiguous", espalier.open_blob, np.frombuffer(bytes(blob), np.uint8)[::2])
    raises(TypeError, "", espalier.open_blob, 5)


def test_pickles(blob, points, directions, expected):
    same(pickle.loads(pickle.dumps(blob)).raycast(points, directions), expected)


def test_damaged_bytes_raise(blob, tmp_path):
    data = bytearray(bytes(blob))
    for damaged in (b"", data[:-1], data + b"x", b"x" + data[1:]):
        with pytest.raises(espalier.OpenError) as error:
            espalier.open_blob(bytes(damaged))
        assert str(error.value) and error.value.status > 0
        assert pickle.loads(pickle.dumps(error.value)).status == error.value.status
    (tmp_path / "empty").write_bytes(b"")
    raises(espalier.OpenError, "", espalier.open_blob, tmp_path / "empty")
    raises(FileNotFoundError, "", espalier.open_blob, tmp_path / "missing")
    espalier.verify(blob)
    data[-1] ^= 1
    raises(ValueError, "", espalier.verify, bytes(data))


def test_bake_takes_any_arrays(mesh):
    positions, triangles = mesh
    expected = bytes(espalier.bake(positions, triangles))
    wide = np.zeros((len(positions), 5), np.float64)
    wide[:, 1:4] = positions
    for given in (positions.tolist(), np.asfortranarray(positions), wide[:, 1:4], positions.astype(np.float64)):
        assert bytes(espalier.bake(given, triangles)) == expected
    for given in (triangles.tolist(), triangles.astype(np.int64), triangles.astype(np.uint16), triangles.astype(">i4"),
                  np.asfortranarray(triangles)):
        assert bytes(espalier.bake(positions, given, threads=2)) == expected
    assert bytes(espalier.bake(positions[::-1], (len(positions) - 1 - triangles.astype(int))[::-1][::-1])) == expected


def test_origin_keeps_far_meshes_exact(mesh):
    offset = np.array([500_000.0, 4_000_000.0, 100.0])
    positions = mesh[0].astype(np.float64) + offset
    blob = espalier.bake(positions, mesh[1], origin=offset)
    assert blob.max_error < 0.0002 and np.abs(blob.bounds - offset).max() < 5
    with pytest.warns(espalier.BakeWarning) as warned:
        espalier.bake(positions, mesh[1], origin=None)
    assert warned[0].filename == __file__
    # float64 by another dtype object or another order of bytes is float64.
    for given in (pickle.loads(pickle.dumps(positions)), positions.astype(">f8")):
        assert bytes(espalier.bake(given, mesh[1], origin=offset)) == bytes(blob)


def test_refused_bakes_raise_with_the_place(mesh):
    positions, triangles = mesh
    wrong = triangles.astype(np.int64)
    wrong[17, 1] = -1
    with pytest.raises(espalier.BakeError, match="17") as error:
        espalier.bake(positions, wrong)
    assert error.value.place == (0, 0, 17)
    again = pickle.loads(pickle.dumps(error.value))
    assert str(again) == str(error.value) and (again.status, again.place) == (error.value.status, (0, 0, 17))
    assert espalier.bake(positions, wrong, drop_bad_triangles=True).report["index_out_of_range"]["count"] == 1
    for options in ({"bits": 25}, {"profile": "large"}, {"bits": 8, "tolerance": 0.1}, {"effort": "none"},
                    {"flat_angle": -5.0}, {"flat_angle": float("nan")}):
        raises(ValueError, "", espalier.bake, positions, triangles, **options)
    many, fractions = np.full(len(triangles), 2**32 + 5), np.full(len(triangles), 1.5)
    for arguments in ((positions, triangles, [1, 2]), (positions, triangles, many), (positions, triangles, fractions), (positions[:, :2], triangles), (positions, positions)):
        raises((ValueError, TypeError), "", espalier.bake, *arguments)


def test_several_meshes_and_materials(mesh):
    materials = np.arange(len(mesh[1])) % 7
    blob = espalier.bake_meshes([mesh, espalier.Mesh(mesh[0] + np.float32(20), mesh[1], materials, "moved", 3, 1)],
                                original_ids=True)
    hits, _, sources = blob.raycast_sources([[3, 0, 5], [23, 20, 25]], [0, 0, -1])
    assert sources["file"].tolist() == [0, 3] and sources["mesh"].tolist() == [0, 1]
    assert blob.materials(hits["triangle"])[1] == materials[sources["triangle"][1]]


def test_mesh_files(mesh, tmp_path):
    pytest.importorskip("espalier._import", reason="this build reads no mesh files (ESPALIER_IMPORT)")
    positions, triangles = mesh
    expected = bytes(espalier.bake(positions, triangles))
    lines = ["v %.17g %.17g %.17g" % tuple(row) for row in positions] + ["f %d//1 %d//1 %d//1" % tuple(row + 1) for row in triangles]
    (tmp_path / "a.obj").write_text("\n".join(lines))
    assert bytes(espalier.bake_file(tmp_path / "a.obj")) == expected
    header, vertices, faces = ply_of(positions, triangles)
    (tmp_path / "a.ply").write_bytes(header + vertices + faces)
    assert bytes(espalier.bake_file(tmp_path / "a.ply")) == expected
    facets = np.zeros(len(triangles), [("normal", "<3f4"), ("corners", "<9f4"), ("attribute", "<u2")])
    facets["corners"] = positions[triangles].reshape(-1, 9)
    (tmp_path / "a.stl").write_bytes(bytes(80) + len(triangles).to_bytes(4, "little") + facets.tobytes())
    stl = espalier.bake_file(tmp_path / "a.stl")
    assert stl.triangle_count == len(triangles) and stl.is_closed
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    for text in ("v 0 0 0\nf 1 2 3\n", corners + "f 0 1 2\n", corners + "v 1 1\nv 2 2\nf 1 2 3\n", corners + "f 1 2 -4\n"):
        (tmp_path / "b.obj").write_text(text)
        raises(ValueError, "b.obj", espalier.bake_file, tmp_path / "b.obj")
    (tmp_path / "b.ply").write_bytes(header.replace(b" uchar int", b" char int") + vertices + b"\xff" + faces)
    raises(ValueError, "b.ply", espalier.bake_file, tmp_path / "b.ply")
    raises(ValueError, "cannot read", espalier.bake_file, tmp_path / "a.glb")


def test_a_build_without_the_reader_of_files_states_so(monkeypatch):
    monkeypatch.delattr(espalier, "_import", raising=False)
    monkeypatch.setitem(sys.modules, "espalier._import", None)
    for call in (espalier.read_mesh, espalier.bake_file):
        with pytest.raises(espalier.MeshFileError, match="Build the wheel with assimp") as error:
            call("level.obj")
        assert error.value.status == "unsupported"


def test_joined_borders_carry_a_ball_over_the_seam():
    def ground(x):
        positions = np.array([[x, -4, 0], [x + 4, -4, 0], [x + 4, 4, 0], [x, 4, 0]], np.float32)
        return espalier.bake(positions, [[0, 1, 2], [0, 2, 3]], step_exponent=-8, flat_angle=5)

    def leaning(left, right):
        return [abs(tile.contacts(espalier.Sphere([x, 0, 0.24], 0.25), 0.05).items["normal"][..., 0]).max(initial=0)
                for tile, x in ((left, 0.1), (right, 8.1))]

    tiles, moved = [ground(-4), ground(8)], [[0, 0, 0], [-8, 0, 0]]
    assert max(leaning(*tiles)) > 0
    joined = espalier.join_borders(tiles, moved)
    assert max(leaning(*joined)) == 0
    raises(espalier.BakeError, "blob 1 does not lie", espalier.join_borders, tiles, [[0, 0, 0], [0.001, 0, 0]])
