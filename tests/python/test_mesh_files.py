"""Files of meshes: the reader of the command, whose bytes and refusals those of Python are."""

import json
import os
import pathlib
import pickle
import subprocess
import sys
import threading
import warnings

import numpy as np
import pytest

import espalier
from conftest import ply_of, raises

pytest.importorskip("espalier._import", reason="this build reads no mesh files (ESPALIER_IMPORT)")

MODELS = pathlib.Path("/usr/share/assimp/models")
FOLDERS = sorted({path.parent.relative_to(MODELS).as_posix() for path in MODELS.rglob("*") if path.is_file()})
LIMIT = 2_000_000  # bytes: larger files take seconds each
CASES = pathlib.Path(os.environ.get("ESPALIER_CASES", pathlib.Path(__file__).resolve().parents[3] / "shared" / "cases"))


@pytest.fixture(scope="session")
def command():
    path = os.environ.get("ESPALIER_COMMAND")
    if not path:
        pytest.skip("ESPALIER_COMMAND does not name the command to compare with")
    return path


def outcome_of_command(command, path, folder, *options):
    """Returns the bytes that the command bakes, or the kind and the message of its refusal."""
    out = folder / "command.espl"
    ran = subprocess.run([command, "bake", str(path), "-o", str(out), "--json", "-q", "--effort", "fast", "--allow-empty",
                          "--max-dropped", "100", *options],
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    document = json.loads(ran.stdout)
    if ran.returncode == 0:
        return out.read_bytes()
    return document["error"]["kind"], document["error"]["message"]


def outcome_of_python(path, **options):
    """Returns the same of Python."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return bytes(espalier.bake_file(path, effort="fast", allow_empty=True, max_dropped=100, **options))
    except espalier.MeshFileError as error:
        return "usage" if error.kind == "invalid_options" else error.kind, str(error)
    except espalier.BakeError as error:
        return "bake", str(error)


def same_outcome(command, path, folder, arguments=(), **options):
    ours, theirs = outcome_of_python(path, **options), outcome_of_command(command, path, folder, *arguments)
    if ours[0] == "bake":  # to whose reason the command adds what its options do about it, by their own names
        assert theirs[1].startswith(ours[1].removesuffix("drop_bad_triangles")), f"{path}: {ours!r} is not {theirs!r}"
    else:
        assert ours == theirs, f"{path}: {ours[:300]!r} is not {theirs[:300]!r}"
    return theirs


@pytest.mark.parametrize("folder", FOLDERS or ["none"])
def test_models_of_strangers_bake_as_by_the_command(command, folder, tmp_path):
    if not FOLDERS:
        pytest.skip(f"there are no models in {MODELS} (assimp-testmodels)")
    for path in sorted((MODELS / folder).iterdir()):
        if path.is_file() and path.stat().st_size <= LIMIT:
            same_outcome(command, path, tmp_path, ["--ids", "--materials"], original_ids=True, materials=True)


def write_cases(folder):
    """Writes small files that a simple reader gets wrong."""
    def write(name, content):
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)

    corners = "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\n"
    write("concave.obj", corners + "f 3 4 5 6 1 2\n")
    write("byte_order_mark.obj", b"\xef\xbb\xbf" + corners.encode() + b"f 1 2 3\n")
    write("utf16.obj", corners.encode("utf-16") + "f 1 2 3\n".encode("utf-16-le"))
    write("backwards.obj", (corners + "f -6 -5 -4\n").replace("\n", "\r\n"))
    write("groups.obj", corners + "o left\nusemtl a\nf 1 2 3\no right\nusemtl b\nf 3 4 5\n")
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n{}endloop\nendfacet\n"
    write("quads.stl", "solid q\n" + facet.format("vertex 0 1 0\n") + "endsolid q\n")
    write("solid.stl", "solid s\n" + facet.format("") + "endsolid s\n")
    header = ("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
              "element {}\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n")
    write("strips.ply", header.format("tristrips 1\nproperty list int int vertex_indices") + "5 0 1 2 3 4\n")
    write("restarted.ply", header.format("tristrips 1\nproperty list int int vertex_indices") + "7 0 1 2 -1 2 3 4\n")
    write("faces.ply", header.format("face 2\nproperty list uchar int vertex_indices") + "4 0 1 3 2\n3 2 3 4\n")
    write("square.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
    write("missing_vertex.obj", corners + "f 1 2 9\n")
    write("zero.obj", corners + "f 0 1 2\n")
    write("not_finite.obj", "v 0 0 nan\n" + corners + "f 1 2 3\n")
    write("cut.ply", header.format("face 2\nproperty list uchar int vertex_indices") + "4 0 1")
    write("empty.obj", "")
    write("nothing.xyz", "this is no mesh")
    write("pointer.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
    (folder / "folder.obj").mkdir()
    return sorted(folder.iterdir()) + [folder / "none.obj"]


def test_small_files_bake_as_by_the_command(command, tmp_path):
    (tmp_path / "cases").mkdir()
    outcomes = {path.name: same_outcome(command, path, tmp_path) for path in write_cases(tmp_path / "cases")}
    assert espalier.open_blob(outcomes["concave.obj"]).triangle_count == 4
    assert espalier.open_blob(outcomes["strips.ply"]).triangle_count == 3
    assert sum(isinstance(outcome, bytes) for outcome in outcomes.values()) >= 10
    assert outcomes["none.obj"][0] == "file_access" and outcomes["pointer.obj"][0] == "git_lfs_pointer"


def test_the_options_are_those_of_the_command(command, tmp_path):
    (tmp_path / "cases").mkdir()
    write_cases(tmp_path / "cases")
    path = tmp_path / "cases" / "concave.obj"
    whole = same_outcome(command, path, tmp_path)
    for arguments, options in ((["--unit", "mm"], {"unit": "mm"}), (["--unit", "in"], {"unit": 254 / 1e4}), (["--scale", "3"], {"scale": 3.0}),
                               (["--up", "z"], {"up": "z"}), (["--deformable"], {"deformable": True})):
        assert same_outcome(command, path, tmp_path, arguments, **options) != whole
    assert same_outcome(command, path, tmp_path, ["--format", "obj"], format="OBJ") == whole
    assert same_outcome(command, path, tmp_path, ["--format", "none"], format="none")[0] == "usage"
    missing = tmp_path / "cases" / "missing_vertex.obj"
    assert same_outcome(command, missing, tmp_path)[0] == "missing_vertex"
    for wrong in ({"unit": "mile"}, {"unit": 0.0}, {"up": "w"}, {"scale": 0.0}, {"scale": float("nan")}):
        raises(ValueError, "", espalier.read_mesh, path, **wrong)


def test_what_a_file_states_is_there(tmp_path):
    write_cases(tmp_path)
    file = espalier.read_mesh(tmp_path / "groups.obj", materials=True)
    assert [mesh.name.split("(")[1] for mesh in file.meshes] == ["left)", "right)"] and file.mesh_names == ["left", "right"]
    assert [mesh.materials.tolist() for mesh in file.meshes] == [[1], [2]]
    assert file.meshes[0].positions.dtype == np.float64 and file.meshes[1].triangles.dtype == np.uint32
    assert file.metres_per_unit == 1.0 and file.opened[0] == file.path == str(tmp_path / "groups.obj")
    assert espalier.read_mesh(tmp_path / "groups.obj").meshes[0].materials is None
    with pytest.warns(espalier.MeshFileWarning, match="missing_vertex.obj") as caught:
        espalier.read_mesh(tmp_path / "missing_vertex.obj")
    assert caught[0].message.kind == "missing_vertex" and caught[0].filename == __file__


def test_names_are_those_of_the_report(command, tmp_path):
    path, wrong, right, long = tmp_path / "names.obj", b"\xc3\xa4 caf\xe9 \xed\xa0\x80 \x01", "\u00e4 caf\ufffd \ufffd\ufffd\ufffd \1", "n" * (1 << 20)
    path.write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no %b\nusemtl %b\nf 1 2 4\no %b\nf 1 3 4\n" % (wrong, wrong, long.encode()))
    blob = espalier.bake_file(path, materials=True, original_ids=True)
    assert blob.names == espalier.read_mesh(path).names == (["", right], ["", right, long], [""] * 3)
    found = zip(blob.original_triangles([0, 1, 2])["mesh"], blob.materials([0, 1, 2]))
    assert {(blob.names.meshes[mesh], blob.names.materials[material]) for mesh, material in found} == {("", ""), (right, right), (long, right)}
    report = json.loads(subprocess.check_output([command, "bake", path, "-o", tmp_path / "x", "--json", "-q", "--materials"]))
    assert (report["inputs"][0]["mesh_names"], [material["name"] for material in report["materials"]]) == (blob.names.meshes, blob.names.materials)
    path.write_bytes(b"v 0 0 \xff\n")
    raises(espalier.MeshFileError, "'\ufffd' is not a number", espalier.read_mesh, path)


@pytest.mark.skipif(not CASES.is_dir(), reason=f"there is no folder {CASES}")
def test_cases_of_bug_reports_are_right(command, tmp_path):
    (tmp_path / "3mf").mkdir()
    subprocess.run([sys.executable, CASES / "make_3mf.py"], cwd=tmp_path, check=True)
    baked = {path.name: same_outcome(command, path, tmp_path, ["--flat-angle", "5", "--tolerance", "1mm"], flat_angle=5.0, tolerance=0.001)
             for path in [*CASES.iterdir(), *(tmp_path / "3mf").iterdir()] if path.suffix in (".obj", ".ply", ".stl", ".3mf")}
    assert baked.keys() > {"floor.obj", "ridge.obj", "rel_type_first.3mf"} and "line 8" in baked["quads.stl"][1]
    opened = {name: espalier.open_blob(outcome) for name, outcome in baked.items() if isinstance(outcome, bytes)}
    assert len(opened) == len(baked) - 1 and baked["thumbnail.3mf"] == baked["png_without_rel.3mf"] == baked["plain.3mf"]
    a, b, c = np.moveaxis(opened["l_shape.obj"].triangles().astype(float), 1, 0)
    assert abs(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 - 5) < 0.01 and opened["strips.ply"].triangle_count == 4
    downwards = lambda name, *start: bool(opened[name].occluded(np.array([start]), np.array([[0, 0, -1.0]])).yes[0])
    assert downwards("l_shape.obj", 0.5, 0.5, 5) and not downwards("l_shape.obj", 2, 2, 5)
    assert downwards("utm_house.obj", 496752.258074, 5556620, 130) and not downwards("utm_house.obj", 496752.658074, 5556620, 130)
    assert [mesh.positions[mesh.triangles].tolist() for mesh in espalier.read_mesh(CASES / "bom.obj").meshes] == [[[[0, 0, 0], [0, 0, 1], [0, 1, 1]]]]
    sizes = [espalier.read_mesh(tmp_path / "3mf" / name).meshes[0].positions / unit for name, unit in (("plain_inch.3mf", 25.4), ("plain.3mf", 1.0))]
    np.testing.assert_allclose(*sizes, rtol=1e-14)
    raises(espalier.BakeError, "dropped", espalier.bake_meshes, espalier.read_mesh(CASES / "screw.obj").meshes, tolerance=0.002)


def test_errors_have_a_status_and_a_place(tmp_path):
    write_cases(tmp_path)
    with pytest.raises(espalier.MeshFileError, match="missing_vertex.obj") as error:
        espalier.bake_file(tmp_path / "missing_vertex.obj")
    assert (error.value.status, error.value.kind) == ("invalid_input", "missing_vertex")
    assert error.value.place == (str(tmp_path / "missing_vertex.obj"), None, None)
    again = pickle.loads(pickle.dumps(error.value))
    assert (str(again), again.status, again.kind, again.place) == (
        str(error.value), error.value.status, error.value.kind, error.value.place)


def test_a_crash_and_a_limit_are_errors_like_others(command, tmp_path):
    # Elements so deep that the importer of Collada uses up its stack.
    depth = 200_000
    deep = tmp_path / "deep.dae"
    deep.write_text('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
                    '<library_visual_scenes><visual_scene id="s">' + "<node>" * depth + "</node>" * depth +
                    "</visual_scene></library_visual_scenes></COLLADA>")
    assert same_outcome(command, deep, tmp_path)[0] == "importer_crash"
    slow = tmp_path / "slow.obj"
    slow.write_text("v 0 0 0\n" * 300_000)
    raises(espalier.MeshFileError, "more than 0.002 s of processor time", espalier.read_mesh, slow, seconds=0.002)
    huge = tmp_path / "huge.ac"  # states more vertices than it has
    huge.write_text('AC3Db\nMATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n'
                    "numvert 20000000\n0 0 0\n")
    assert same_outcome(command, huge, tmp_path, ["--import-memory", "128M"], memory=128 << 20)[0] == "import_memory"


def test_threads_read_at_once(mesh, tmp_path):
    (tmp_path / "a.ply").write_bytes(b"".join(ply_of(*mesh)))
    expected = espalier.read_mesh(tmp_path / "a.ply").meshes[0].positions
    found = []

    def read():
        for _ in range(10):
            found.append(np.array_equal(espalier.read_mesh(tmp_path / "a.ply").meshes[0].positions, expected))

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [True] * 40
