"""STL."""
import struct

from .claims import BOX, BOX_BOUNDS, TRIANGLES
from .obj import obj_box


def stl_bytes(header=b"box", count=None):
    return (header.ljust(80, b" ") + struct.pack("<I", len(TRIANGLES) if count is None else count) +
            b"".join(struct.pack("<12fH", 0, 0, 0, *BOX[a], *BOX[b], *BOX[c], 0) for a, b, c in TRIANGLES))


def stl_text(triangles=TRIANGLES, name="box"):
    lines = [f"solid {name}"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *("vertex {} {} {}".format(*BOX[i]) for i in triangle), "endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}"]) + "\n"


def stl(claims):
    def box(claim, content, **options):
        claims.bakes("STL: " + claim, "box.stl", content, 12, BOX_BOUNDS, closed=True, format="STL", **options)

    box("binary", stl_bytes())
    box("binary with a header that begins with 'solid'", stl_bytes(b"solid box\nfacet normal"))
    box("text", stl_text())
    box("text in capitals with CR LF and tabs", stl_text().upper().replace("\n", "\r\n").replace(" ", "\t"))
    box("text in UTF-16", b"\xff\xfe" + stl_text().encode("utf-16-le"))
    box("text on one line", stl_text().replace("\n", " "))
    box("a facet on the line of its solid's name", stl_text(name="a facet").replace("a facet\nfacet", "a facet facet"))
    claims.refuses("STL: a facet behind the end of its solid is refused", "behind.stl",
                   stl_text().rstrip("\n") + " " + stl_text(name="roof").replace("\n", " "), "'facet'")
    box("numbers too small for any type are 0", stl_text().replace("vertex 0 0 0", "vertex 1e-400 -0e0 1E-999"))
    claims.refuses("STL: a coordinate beyond every type is infinite", "infinite.stl", stl_text().replace("vertex 0 0 0", "vertex 1e400 0 0", 1), "infinity")
    box("several solids are several meshes", stl_text(TRIANGLES[:5], "a facet") + stl_text([], "none") + stl_text(TRIANGLES[5:]), meshes=2)
    box("bytes after the triangles are warned of", stl_bytes() + b"\0" * 50, warnings=["trailing_bytes"])
    box("a missing 'endsolid' is warned of", stl_text().replace("endsolid box\n", ""), warnings=["missing_end"])
    claims.bakes("STL: one without an ending is read by its content", "text_without_ending", stl_text(), 12, BOX_BOUNDS)
    claims.refuses("STL: a binary file that is cut off is refused", "cut.stl", stl_bytes()[:-1], "room for 11")
    claims.refuses("STL: a binary file that states more triangles is refused", "more.stl", stl_bytes(count=4000000000), "4000000000")
    for name, content in (("a zero byte", stl_text() + "\0\n"), ("another first word", "color 1 0 0\n" + stl_text())):
        claims.refuses(f"STL: a text with {name} is refused with what a text is", "text.stl", content, "begins with 'solid'", "zero byte")
    claims.refuses("STL: a text that is cut off is refused", "cut.stl", stl_text()[:-60].rsplit("\n", 1)[0], "facet")
    claims.refuses("STL: a facet with four corners is refused", "four.stl", stl_text().replace("endloop", "vertex 0 0 0\nendloop", 1), "4 corners")
    claims.refuses("STL: a word that is no number is refused with its line", "word.stl", stl_text().replace("vertex 0 0 0", "vertex 0 a 0", 1), "line 4", "'a'")
    claims.refuses("STL: another format with this ending is refused", "obj.stl", obj_box(), "STL")
