"""What messages about broken and misnamed files say: what is wrong, where, and what to do, each once."""
import json

from .claims import SQUARE, SQUARE_BOUNDS
from .obj import obj_box
from .off import SQUARE as OFF_SQUARE
from .off import off_box
from .ply import ply_header
from .stl import stl_bytes, stl_text
from .three_mf import mesh, model, package, thing

BEYOND = "99999999999999999999999"  # no integer of 64 bits
PLY = ply_header("ascii", "element vertex 3", *(f"property double {axis}" for axis in "xyz"), "element face 1",
                 "property list uchar int vertex_index") + "0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n"
DROP = ["--drop-bad-triangles", "--max-dropped", "100"]
ADVICE = ("orrect it", "whole?", "xport it again", "pack it again", "Download", "--format")  # of which a message has one


def messages(claims):
    def refuses(claim, name, content, *words, options=()):
        claims.refuses(f"messages: {claim}", name, content, *words, options=options)
        _, document, _ = claims.run(name, *options)
        message = document.get("error", {}).get("message", "")
        claims.check(f"messages: {claim}: advice comes once", sum(map(message.count, ADVICE)) <= 1, message)

    def warns(claim, name, content, kind, *words, triangles=2, **options):
        document = claims.bakes(f"messages: {claim}", name, content, triangles, SQUARE_BOUNDS, [kind], **options)
        text = " ".join(warning["message"] for warning in document.get("warnings", []))
        for word in words:
            claims.check(f"messages: {claim}", word in text, f"'{word}' is not in: {text}")

    for number, words in ((BEYOND, "counted from 1"), ("-" + BEYOND, "counted back")):
        refuses("an index that no integer holds is printed as written in OBJ", "beyond.obj", SQUARE + f"f 1 2 {number}/1\n", "line 5", f"vertex {number}", words)
    for name, content, line in (("beyond.ply", PLY.replace("3 0 1 2", f"3 0 1 {BEYOND}"), "line 14"),
                                ("beyond.off", OFF_SQUARE.format(1) + f"3 0 1 {BEYOND}\n", "line 7"),
                                ("beyond.3mf", package(model(thing(1, mesh().replace('v3="6"', f'v3="{BEYOND}"', 1)))), "triangle 7")):
        refuses(f"an index that no integer holds is printed as written in {name}", name, content, line, f"vertex {BEYOND}", "counted from 0")
    refuses("an index of a million digits is cut short", "digits.obj", SQUARE + f"f 1 2 {'9' * 1000000}\n", "line 5", "vertex 9999", "9...")

    for value, shown in (("nan", "NaN"), ("inf", "infinity"), ("-1e400", "-infinity")):
        for name, content, words in (
                ("not_finite.obj", "o a\nf 1 2 3\n" + SQUARE.replace("2 2 0", f"2 {value} 0"), ("line 5", "vertex 3, counted from 1", "triangle 0 of mesh 0")),
                ("not_finite.off", OFF_SQUARE.format(1).replace("2 2 0", f"2 {value} 0") + "4 0 1 2 3\n", ("line 5", "vertex 2, counted from 0", "triangle 0")),
                ("not_finite.ply", PLY.replace("2 2 0", f"2 {value} 0"), ("line 13", "vertex 2, counted from 0", "triangle 0")),
                ("not_finite.stl", stl_text().replace("vertex 1 2 0", f"vertex 1 {value} 0", 1), ("a vertex", "mesh 0"))):
            refuses(f"{value} is named with its line in {name}", name, content, f"y = {shown}", "line ", "--drop-bad-triangles", *words)
    claims.bakes("messages: a vertex that no face needs may be NaN", "unused.obj", SQUARE + "v nan 0 0\nf 1 2 3 4\n", 2, SQUARE_BOUNDS)
    claims.bakes("messages: faces with NaN are dropped on demand", "dropped.obj", SQUARE + "v nan 0 0\nf 1 2 3 4\nf 1 2 5\n", 2, SQUARE_BOUNDS, options=DROP)
    refuses("a vertex is counted from 1 in OBJ and says so", "count.obj", SQUARE + "f 1 2 9\n", "vertex 9", "4 vertices, counted from 1")
    refuses("a PLY header without an end", "end.ply", PLY[:PLY.index("end_header")], "no end", "whole?")

    for name, content, looks, form in (
            ("obj.stl", obj_box(), "Wavefront OBJ", "obj"), ("obj.off", obj_box(), "Wavefront OBJ", "obj"), ("obj.ply", obj_box(), "Wavefront OBJ", "obj"),
            ("obj.glb", obj_box(), "Wavefront OBJ", "obj"), ("obj.3mf", obj_box(), "Wavefront OBJ", "obj"), ("obj.raw", obj_box(), "Wavefront OBJ", "obj"),
            ("fbx.obj", b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0", "FBX", "fbx"), ("fbx.stl", "; FBX 7.4.0 project file\n", "FBX", "fbx"),
            ("dae.obj", '<?xml version="1.0"?>\n<COLLADA version="1.4.1"/>', "Collada", "dae")):
        refuses(f"{name} is named with what it looks like", name, content, f"looks like {looks}", f"--format {form}", f"ending .{form}")
    for name, content, form in (("stl.glb", stl_text(), "STL"), ("binary.glb", stl_bytes(), "STL"), ("off.glb", off_box(), "OFF")):
        claims.bakes(f"messages: {name} is read by its content", name, content, 12, ([0, 0, 0], [1, 2, 4]), format=form)

    page = "<!DOCTYPE html>\n<html lang=\"en\"><body>404</body></html>\n"
    for name, content in (("page.stl", page), ("page.obj", "\n  " + page.lower()), ("page.glb", page.upper()), ("page.fbx", page), ("page", page),
                          ("page.3mf", b"\xef\xbb\xbf" + page.encode()), ("page.ply", '<?xml version="1.0"?>\n' + page), ("tag.off", "<html><head/></html>")):
        refuses(f"a web page in place of a file is named: {name}", name, content, "web page (HTML)", "Download the file itself")
        code, document, _ = claims.run(name)
        claims.check("messages: a web page has a kind of its own", document.get("error", {}).get("kind") == "web_page", document)

    zeros = b"\0" * 10
    for name, content in (("zeros.obj", SQUARE + "f 1 2 3 4\n"), ("zeros.off", OFF_SQUARE.format(1) + "4 0 1 2 3\n"),
                          ("zeros.raw", "0 0 0 2 0 0 2 2 0\n0 0 0 2 2 0 0 2 0\n"), ("zeros.ply", PLY), ("zeros.stl", stl_text())):
        if name in ("zeros.ply", "zeros.stl"):
            claims.write(name, content.encode() + zeros)
            code, document, stderr = claims.run(name)
            claims.check(f"messages: {name}", code == 0 and "10 zero bytes" in json.dumps(document["warnings"]), stderr)
        else:
            warns(f"zero bytes after a text are named: {name}", name, content.encode() + zeros, "trailing_bytes", "10 zero bytes after the text")
    refuses("a zero byte within a text is none at its end", "within.obj", SQUARE.encode() + b"\0\0f 1 2 3\n", "no Wavefront OBJ", "byte 32")

    refuses("an STL vertex of two numbers", "two.stl", stl_text().replace("vertex 0 0 0", "vertex 1 2", 1), "line 4", "2 coordinates, not 3", "z is missing")
    refuses("an STL vertex of one number", "one.stl", stl_text().replace("vertex 0 0 0", "vertex 1", 1), "line 4", "1 coordinate, not 3", "y and what follows")
    for corners, count in (("1 2", 1), ("1", 1), ("", 1), ("1 2\nf 3", 2)):
        warns("an OBJ face of fewer than three corners has its line", "short.obj", SQUARE + f"f {corners}\nf 1 2 3 4\n", "short_face", "line 5", "fewer than three corners",
              *(["and 1 more"] if count == 2 else []))

    faces = "3 0 1 2\n3 0 2 3\n"
    for claim, content, words in (
            ("fewer faces", OFF_SQUARE.format(3) + faces, ["line 8", "states 3 faces", "the file has 2"]),
            ("more vertices", OFF_SQUARE.format(2).replace("OFF\n4", "OFF\n5") + faces, ["states 2 faces", "states 5 vertices", "first 4 lines"]),
            ("a file that ends within a face", OFF_SQUARE.format(2) + "3 0 1 2\n3 0\n", ["states 2 faces", "the file has 1", "within face 1"]),
            ("a file that ends within a vertex", "OFF\n4 0 0\n0 0 0\n1 1\n", ["states 4 vertices", "the file has 1", "within vertex 1"]),
            ("far more vertices", OFF_SQUARE.format(2).replace("OFF\n4", "OFF\n4000") + faces, ["line 2", "4000 vertices", "bytes for"])):
        refuses(f"an OFF header that states {claim} is refused with both counts", "counts.off", content, *words)
    warns("an OFF header that states fewer faces is warned of with both counts", "few.off", OFF_SQUARE.format(2) + faces + "3 0 1 2\n3 1 2 3\n", "trailing_bytes", "line 9",
          "states 2 faces", "2 lines more")
