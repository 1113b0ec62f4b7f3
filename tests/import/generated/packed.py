"""Files that gzip packed."""
import gzip

from .claims import BOX_BOUNDS, SQUARE_BOUNDS
from .digits import gltf
from .obj import obj_box
from .off import off_box
from .ply import ply_bytes
from .stl import stl_bytes, stl_text
from .three_mf import package


def packed(claims):
    def box(claim, name, content, form, **options):
        claims.bakes("gzip: " + claim, name, content, 12, BOX_BOUNDS, format=form, **options)

    def zipped(content):
        return gzip.compress(content if isinstance(content, bytes) else content.encode())

    for name, content, form in (("box.obj", obj_box(), "Wavefront OBJ"), ("box.off", off_box(), "OFF"), ("box.ply", ply_bytes("<", "f", "B", "i"), "PLY"),
                                ("binary.stl", stl_bytes(), "STL"), ("text.stl", stl_text(), "STL"), ("box.3mf", package(), "3MF")):
        box(f"{name}.gz is read by the ending before .gz", name + ".gz", zipped(content), form)
        box(f"{name} is read by its first bytes without .gz", name, zipped(content), form)
        box(f"{name}.gz that is not packed is read", name + ".gz", content, form)
    for name in ("digits.gltf.gz", "digits.gltf"):
        claims.write(name, zipped(gltf()))
        code, _, stderr = claims.run(name)
        claims.check(f"gzip: {name} is read", code == 0, stderr)
    box("a binary STL without any ending is read by its size", "packed", zipped(stl_bytes(b"solid x")), "STL")
    box("OBJ without any ending is read by its first lines", "packed", zipped(obj_box() + "# more\n" * 20000), "Wavefront OBJ")
    half = len(obj_box()) // 2
    box("parts that follow each other are one file", "parts.obj.gz", zipped(obj_box()[:half]) + zipped(obj_box()[half:]), "Wavefront OBJ")
    box("zero bytes may follow", "zeros.obj.gz", zipped(obj_box()) + b"\0" * 512, "Wavefront OBJ")
    document = claims.bakes("gzip: vertices keep their order", "order.obj.gz", zipped("v 0 0 0\nv 2 0 0\nv 2 2 0\nf 1 2 3\n"), 1, SQUARE_BOUNDS,
                            options=["--deformable", "--range", "0", "0", "0", "9", "9", "9"])
    claims.check("gzip: the file keeps its name", "order.obj.gz" in str(document.get("inputs")), document)

    whole = zipped(obj_box())
    for claim, content in (("a file that is cut off", whole[:-9]), ("a file without its checksum", whole[:-4]), ("a damaged file", whole[:20] + b"\xff" + whole[21:]),
                           ("a file with another checksum", whole[:-8] + b"\0\0\0\0" + whole[-4:]), ("a file with other bytes behind it", whole + b"more")):
        claims.refuses(f"gzip: {claim} is refused", "bad.obj.gz", content, "gzip", "damaged or cut off", "pack it again")
    claims.refuses("gzip: a web page in it is named", "page.obj.gz", zipped("<!DOCTYPE html>"), "web page (HTML)")
    claims.refuses("gzip: messages have the lines of what is in it", "word.obj.gz", zipped("v 0 0 0\nv 1,5 0 0\n"), "line 2", "'1,5'")
    claims.write("bomb.obj.gz", gzip.compress(b"#" * (1 << 28)))
    code, document, _ = claims.run("bomb.obj.gz", "--import-memory", "64M")
    claims.check("gzip: what is too large for the memory is refused", code == 3 and document["error"]["kind"] == "import_memory", document)
