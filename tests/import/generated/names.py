"""What decides on a file's format: its content, its name, --format."""
import io
import json
import zipfile

from .assimp import AMF
from .claims import BOX_BOUNDS, SQUARE, SQUARE_BOUNDS
from .obj import obj_box
from .off import off_box
from .stl import stl_bytes, stl_text

POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n"


def zipped(name, content):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(name, content)
    return file.getvalue()


def names(claims):
    for name, content, form in (
            ("box.stlb", stl_bytes(), "STL"), ("box.stla", stl_text(), "STL"), ("box", stl_bytes(b"solid x"), "STL"), ("solid.dat", stl_bytes(b"OFF 1 2"), "STL"),
            ("box.txt", "\n" + stl_text(name="a # b"), "STL"), ("wide.txt", b"\xff\xfe" + stl_text().encode("utf-16-le"), "STL"),
            ("capital", stl_text().upper(), "STL"), ("box.dat", off_box(), "OFF"), ("coff", off_box("# c\nCOFF\n8 6 12\n", " 1 1 1"), "OFF"),
            ("glued.obj", off_box("OFF8 6 12\n"), "OFF"), ("box.mesh", obj_box(first="# box\nmtllib x.mtl\no box"), "Wavefront OBJ"),
            ("long", obj_box() + "# more\n" * 10000, "Wavefront OBJ")):
        claims.bakes(f"names: {name} is read by its content as {form}", name, content, 12, BOX_BOUNDS, format=form)
    for name, content in (("solid", "solid ground\nis what we want\n"), ("v", "v 1 2 3\nand so on\n"), ("readme", "vertex v f usemtl\n"),
                          ("on", "s off\n"), ("off", "OFF we go\n"), ("bytes", b"v 1 2 3\n\0")):
        claims.refuses(f"names: a text that is no mesh is taken for none: {name}", name, content, "no ending")
    claims.refuses("names: an ending without an importer is named", "scene.wrl", "#VRML V2.0 utf8\nShape { v f }\n", "no importer for '.wrl' files")
    claims.refuses("names: a binary format without an importer is not taken for OBJ", "model.m3d", b"3DMO\x10\0\0\0v f \n\0v 1 2 3\n", "no importer for '.m3d'")
    claims.refuses("names: an empty file is refused", "empty.3ds", "", "is empty")
    collada = "<?xml version=\"1.0\" encoding=\"utf-16\"?><COLLADA version=\"1.4.1\"><asset/></COLLADA>"
    claims.refuses("names: a broken file is refused without a guess about its name", "broken.dae", collada[:40], "cannot be imported")

    claims.bakes("names: --format reads what has no mark", "raw.txt", "0 0 0 2 0 0 2 2 0\n", 1, SQUARE_BOUNDS, options=["--format", "raw"], format="RAW")
    claims.bakes("names: --format comes before the content", "not.ply", "# ply\n" + SQUARE + "f 1 2 3\n", 1, SQUARE_BOUNDS, options=["--format", "OBJ"])
    document = claims.bakes("names: --format takes an ending of assimp's formats", "amf.xml", AMF.format(' unit="meter"'), 2, SQUARE_BOUNDS,
                            options=["--format", "amf"])
    claims.check("names: a file that is read by another ending keeps its name", "/amf.xml\"" in json.dumps(document.get("inputs")), document)
    code, document, _ = claims.run("raw.txt", "--format", "nonsense")
    claims.check("names: another --format is refused", code == 1 and "'nonsense'" in document["error"]["message"], document)
    code, document, _ = claims.run("raw.txt", "--format", "stl")
    claims.check("names: --format is taken at its word", code == 3 and "no STL" in document["error"]["message"], document)

    for name in ("pointer.stl", "pointer.glb", "pointer.fbx", "pointer"):
        claims.refuses("names: a pointer of Git LFS is named with the way to the file", name, POINTER, "Git LFS", "git lfs pull")
    step = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_SCHEMA((\n'AUTOMOTIVE_DESIGN { 1 0 10303 214 }'));\nENDSEC;\n"
    claims.refuses("names: STEP is named", "part.step", step, "STEP", "Export it as STL")
    claims.refuses("names: a zipped AMF is named", "zipped.amf", zipped("model.xml", AMF), "zipped AMF", "Unzip")
    claims.refuses("names: a zipped AMF is named whatever its ending", "zipped.dat", zipped("model.amf", AMF), "zipped AMF", "Unzip")
