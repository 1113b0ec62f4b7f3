"""PLY."""
import struct

from .claims import BOX, BOX_BOUNDS, QUADS, SQUARE_BOUNDS
from .obj import obj_box


def ply_header(form, *lines):
    return "\n".join(["ply", f"format {form} 1.0", "comment a box", *lines, "end_header"]) + "\n"


def ply_bytes(order, coordinate, count, index, before=False):
    types = {"b": "char", "B": "uchar", "h": "short", "H": "ushort", "i": "int", "I": "uint", "f": "float", "d": "double"}
    vertex = [f"element vertex {len(BOX)}", "property uchar red", f"property {types[coordinate]} x",
              f"property {types[coordinate]} y", "property list uchar short tags", f"property {types[coordinate]} z"]
    face = [f"element face {len(QUADS)}", "property float quality",
            f"property list {types[count]} {types[index]} vertex_indices", "property uchar flags"]
    extra = ["element camera 2", "property list int double values", "property float f"]
    cameras = b"".join(struct.pack(order + "i3df", 3, 1, 2, 3, 4) for _ in range(2))
    vertices = b"".join(struct.pack(order + "B2" + coordinate + "B2h" + coordinate, 7, x, y, 2, 5, 6, z) for x, y, z in BOX)
    faces = b"".join(struct.pack(order + "f" + count + "4" + index + "B", 0.5, 4, *quad, 1) for quad in QUADS)
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    if before:
        return ply_header(form, *face, *extra, *vertex).encode() + faces + cameras + vertices
    return ply_header(form, *extra, *vertex, *face).encode() + cameras + vertices + faces


def ply(claims):
    def box(claim, content):
        claims.bakes("PLY: " + claim, "box.ply", content, 12, BOX_BOUNDS, closed=True, format="PLY")

    for order, name in (("<", "little endian"), (">", "big endian")):
        for coordinate in "fdhi":
            box(f"{name} with coordinates of type {coordinate}", ply_bytes(order, coordinate, "B", "i"))
        for count in "bBhHiI":
            for index in "bBhHiI":
                box(f"{name} with lists of {count} {index}", ply_bytes(order, "f", count, index))
        box(f"{name} with faces before vertices", ply_bytes(order, "f", "B", "i", before=True))

    for name, index, count in (("uchar", "B", 200), ("ushort", "H", 40000)):
        header = ply_header("binary_little_endian", f"element vertex {count}", "property float x", "property float y", "property float z",
                            "element face 1", f"property list uchar {name} vertex_indices")
        points = [(9, 9, 9)] * (count - 3) + [(0, 0, 0), (2, 0, 0), (2, 2, 0)]
        data = b"".join(struct.pack("<3f", *point) for point in points) + struct.pack("<B3" + index, 3, *range(count - 3, count))
        claims.bakes(f"PLY: numbers of type {name} have no sign", "sign.ply", header.encode() + data, 1, SQUARE_BOUNDS,
                     points_and_lines=count - 3)

    vertex = ["element vertex 8", "property float x", "property float y", "property float z"]
    face = ["element face 6", "property list uchar int vertex_index"]
    corners = [f"{x} {y} {z}" for x, y, z in BOX]
    faces = ["4 " + " ".join(map(str, quad)) for quad in QUADS]
    text = ply_header("ascii", *vertex, *face) + "\n".join(corners + faces) + "\n"
    box("text", text)
    box("text with CR LF", text.replace("\n", "\r\n"))
    box("text with empty lines and no last line end", text.replace("4\n", "4\n\n").rstrip("\n"))
    box("text with numbers such as .0 and +2.", text.replace("\n0 ", "\n.0 ").replace(" 2 4\n", " +2. 4E0\n"))
    box("a PLY with another ending is read by its content", text)
    claims.bakes("PLY: one named .obj is read as PLY", "ply.obj", text, 12, BOX_BOUNDS, format="PLY")

    strips = ply_header("binary_little_endian", *vertex, "element tristrips 1", "property list int int vertex_indices")
    ring = [0, 4, 1, 5, 3, 7, 2, 6, 0, 4]
    numbers = ring + [-1] + [0, 1, 2, 3] + [-1] + [4, 6, 5, 7]
    data = b"".join(struct.pack("<3f", *corner) for corner in BOX) + struct.pack(f"<i{len(numbers)}i", len(numbers), *numbers)
    box("tristrips turn every second triangle, and begin anew after -1", strips.encode() + data)

    points = ply_header("ascii", *vertex) + "\n".join(corners) + "\n"
    path = claims.write("points.ply", points)
    _, document, _ = claims.run("box.ply", path, "--allow-empty")
    counts = [file["points_and_lines"] for file in document.get("inputs", [])]
    claims.check("PLY: points are counted", counts == [0, 8], counts)
    loose = text.replace("element vertex 8", "element vertex 9").replace("\n4 0 1", "\n7 7 7\n4 0 1", 1)
    claims.bakes("PLY: vertices that no face uses are counted", "loose.ply", loose, 12, BOX_BOUNDS, points_and_lines=1)
    claims.bakes("PLY: data after the last element is warned of", "more.ply", text + "4 0 1 2 3\n", 12, BOX_BOUNDS, ["trailing_bytes"])
    patches = text.replace("end_header", "element patch 1\nproperty list uchar int vertex_indices\nend_header") + "3 0 1 2\n"
    claims.bakes("PLY: elements of other names with vertices are warned of", "patch.ply", patches, 12, BOX_BOUNDS, ["unknown_element"])
    for element, line in (("quad 1\nproperty list uchar int indices", "3 0 1 2"), ("Face 1\nproperty list uchar int Vertex_Indices", "3 0 1 2"),
                          ("polygon 1\nproperty list uchar float vertex_indices", "3 0 1 2"),
                          ("triangle 1\nproperty int v1\nproperty int v2\nproperty int v3", "0 1 2")):
        claims.bakes("PLY: elements of other names that may be faces are warned of", "other.ply",
                     text.replace("end_header", f"element {element}\nend_header") + line + "\n", 12, BOX_BOUNDS, ["unknown_element"])
    colours = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    box("edges and materials are no faces", text.replace(
        "end_header", f"element edge 1\nproperty int vertex1\nproperty int vertex2\n{colours}element material 1\n{colours}end_header") +
        "0 1 9 9 9\n7 7 7\n")
    numbers = ring + [4, 0] + [0, 1, 2, 3] + [3, 4] + [4, 6, 5, 7]
    data = b"".join(struct.pack("<3f", *corner) for corner in BOX) + struct.pack(f"<i{len(numbers)}i", len(numbers), *numbers)
    stitched = claims.bakes("PLY: repeated corners that join strips add no triangle", "stitched.ply", strips.encode() + data, 12,
                            BOX_BOUNDS, closed=True)
    claims.check("PLY: repeated corners that join strips count as no triangle", stitched.get("source_triangles") == 12, stitched)
    claims.bakes("PLY: --drop-bad-triangles drops faces whose vertices are missing, with a warning", "missing.ply",
                 text.replace("4 0 1 3 2", "3 0 1 8"), 10, BOX_BOUNDS, ["missing_vertex"], options=["--drop-bad-triangles", "--max-dropped", "100"])

    for number in ("8", "-1"):
        claims.refuses("PLY: a missing vertex is refused with its line and its number as written", "missing.ply",
                       text.replace("4 0 1 3 2", f"3 0 1 {number}"), "line 19", f"vertex {number}, and the file has 8")

    box_bytes = ply_bytes("<", "f", "B", "i")
    claims.refuses("PLY: a file that is cut off is refused", "cut.ply", box_bytes[:-3], "ends before")
    claims.refuses("PLY: a text that is cut off is refused", "cut.ply", text[:-20], "line")
    claims.refuses("PLY: more vertices than bytes are refused before memory is taken", "huge.ply",
                   ply_header("binary_little_endian", "element vertex 4000000000", *vertex[1:], *face).encode() + b"\0" * 100, "ends before")
    claims.refuses("PLY: more vertices than lines are refused before memory is taken", "huge.ply",
                   ply_header("ascii", "element vertex 4000000000", *vertex[1:], *face) + "0 0 0\n", "ends before")
    claims.refuses("PLY: a list longer than the file is refused", "list.ply",
                   ply_header("binary_little_endian", *vertex, "element face 1", "property list uint int vertex_indices").encode() +
                   b"\0" * 96 + b"\xff\xff\xff\xff" + b"\0" * 100, "ends before")
    claims.refuses("PLY: a negative length is refused", "negative.ply", text.replace("4 0 1 3 2", "-4 0 1 3 2"), "negative")
    claims.refuses("PLY: a line with too few values is refused", "few.ply", text.replace("1 2 4\n", "1 2\n"), "line")
    claims.refuses("PLY: a line with too many values is refused", "many.ply", text.replace("1 2 4\n", "1 2 4 8\n"), "line")
    claims.refuses("PLY: missing coordinates are refused", "flat.ply", text.replace("property float z\n", ""), "'z'")
    claims.refuses("PLY: faces without vertices are refused", "faces.ply", text.replace("vertex_index", "corners"), "vertex_indices")
    claims.refuses("PLY: vertices as fractions are refused", "float.ply", text.replace("uchar int", "uchar float"), "integers")
    for name in ("vertex_index", "vertex_indices"):
        lists = [face[0], face[1].replace("vertex_index", "vertex_indices"), f"property list uchar int {name}"]
        two = ply_header("ascii", *vertex, *lists) + "\n".join(corners + [line + " 3 0 1 2" for line in faces]) + "\n"
        claims.refuses("PLY: faces with two lists of vertices are refused", "two.ply", two, "vertex_indices", "'face'")
    claims.refuses("PLY: a property that an element has twice is refused with its line", "twice.ply",
                   ply_header("ascii", *vertex[:2], *vertex[1:], *face) + "\n".join(["9 " + line for line in corners] + faces),
                   "line 6", "'x' twice", "'vertex'")
    claims.refuses("PLY: an unknown type is refused", "type.ply", text.replace("property float z", "property real z"), "'real'")
    claims.refuses("PLY: an unknown format is refused", "format.ply", text.replace("ascii", "utf8"), "'utf8'")
    claims.refuses("PLY: a header without an end is refused", "header.ply", text[:text.index("end_header")], "no end")
    claims.refuses("PLY: another text with this ending is refused", "text.ply", "vertices\n" + obj_box(), "no PLY")
