#!/usr/bin/env python3
"""Claims about OBJ, PLY and STL, and about files with a wrong name, on small files that are written here.

Usage: generated_test.py PATH_TO_ESPALIER
"""

import io
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import zipfile

BYTES = 4 << 30  # of memory, so that a claim of a file is not taken at its word
BOX = [(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 4)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [(q[0], q[i], q[i + 1]) for q in QUADS for i in (1, 2)]
BOX_BOUNDS = ([0, 0, 0], [1, 2, 4])
SQUARE = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
SQUARE_BOUNDS = ([0, 0, 0], [2, 2, 0])


class Claims:
    def __init__(self, espalier, folder):
        self.espalier = espalier
        self.folder = folder
        self.blob = os.path.join(folder, "blob.espl")
        self.failures = 0

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(content.encode("latin-1") if isinstance(content, str) else content)
        return path

    def run(self, name, *options):
        path = os.path.join(self.folder, name)
        if os.path.exists(self.blob):
            os.remove(self.blob)
        command = [self.espalier, "bake", path, "-o", self.blob, "--json", *options]
        process = subprocess.run(command, capture_output=True, timeout=300, check=False)
        return process.returncode, json.loads(process.stdout or b"{}"), process.stderr.decode("utf-8", "replace")

    def check(self, claim, is_right, found):
        if not is_right:
            self.failures += 1
            print(f"FAILED: {claim}: {found}")

    def bakes(self, claim, name, content, triangles, bounds, warnings=(), options=(), closed=None, **expected):
        """The file bakes to that many triangles and exactly those bounds, with warnings of these kinds."""
        self.write(name, content)
        code, document, stderr = self.run(name, *options)
        self.check(claim, code == 0, stderr)
        if code != 0:
            return {}
        self.check(claim, document["triangles"] == triangles, f"{document['triangles']} triangles, not {triangles}")
        found = (document["bounds"]["min"], document["bounds"]["max"])
        self.check(claim, found == bounds, f"bounds {found}, not {bounds}")
        kinds = [warning["kind"] for warning in document["warnings"]]
        self.check(claim, kinds == list(warnings), f"warnings {document['warnings']}, not {warnings}")
        if closed is not None:
            self.check(claim, document["closed"] == closed, f"closed: {document['closed']}")
        for key, value in expected.items():
            self.check(claim, document["inputs"][0][key] == value, f"{key} is {document['inputs'][0][key]}, not {value}")
        return document

    def refuses(self, claim, name, content, *words):
        """The file is refused with its name and these words, and no blob is left."""
        path = self.write(name, content)
        code, document, stderr = self.run(name)
        message = document.get("error", {}).get("message", "")
        self.check(claim, code in (3, 5), f"exit status {code}: {stderr}")
        for word in (path, *words):
            self.check(claim, word in message, f"'{word}' is not in: {message}")
        self.check(claim, not os.path.exists(self.blob), "a blob is left")


def obj_box(number=str, newline="\n", first="", separator=" "):
    lines = [first] if first else []
    lines += [separator.join(["v", *map(number, corner)]) for corner in BOX]
    lines += [separator.join(["f", *(str(i + 1) for i in quad)]) for quad in QUADS]
    return newline.join(lines) + newline


def obj(claims):
    def box(claim, content, **options):
        claims.bakes("OBJ: " + claim, "box.obj", content, 12, BOX_BOUNDS, closed=True, **options)

    halves = {0: "-.0", 1: "+1.", 2: "2e0", 4: ".4E+1"}
    box("numbers may lack digits before or after the point, and have a sign or an exponent", obj_box(halves.get))
    claims.bakes("OBJ: .5 is a half", "half.obj", "v .5 0 0\nv 1.5 +.5 0\nv -.5 1 .25\nf 1 2 3\n", 1,
                 ([-0.5, 0, 0], [1.5, 1, 0.25]))
    box("lines may end with CR LF", obj_box(newline="\r\n"))
    box("lines may end with CR", obj_box(newline="\r"))
    box("words may be separated by tabs and several spaces", obj_box(separator=" \t "))
    box("the last line needs no end", obj_box().rstrip("\n"))
    box("a backslash continues a line", obj_box(separator=" \\\n"))
    box("a backslash at the end of a comment continues nothing", obj_box(first="# C:\\box\\"))
    box("a backslash at the end of a comment behind numbers continues nothing",
        obj_box().replace("\n", " # C:\\box\\\n").replace("v 0 0 0", "v 0 \\\n0 0"))
    for statement in ("o", "g", "usemtl", "mtllib", "usemap"):
        box(f"a backslash at the end of a name of '{statement}' is part of it", obj_box().replace("f 1", f"{statement} C:\\box\\\nf 1", 1))
    box("a backslash between names continues a line", obj_box().replace("f 1", "g front \\\nback\nf 1", 1))
    box("a comment may follow numbers", obj_box().replace("\n", " # note 7\n"))
    box("UTF-8 may begin with a byte order mark", b"\xef\xbb\xbf" + obj_box().encode())
    for encoding, mark in (("utf-16-le", b"\xff\xfe"), ("utf-16-be", b"\xfe\xff")):
        box(encoding + " with a byte order mark is read", mark + obj_box().encode(encoding))
    box("a long line is read", obj_box(first="# " + "long " * 100000))
    box("colours may follow coordinates", obj_box().replace("\nf", "\nvt 0 0\nf").replace("4\nv", "4 0.5 0.5 1\nv"))
    box("a number too small for any type is 0", obj_box({0: "-.0001e-400", 1: "1", 2: "2", 4: "4e0"}.get))
    repeated = claims.bakes("OBJ: corners that repeat the one before add no triangle", "repeated.obj",
                            SQUARE + "f 1 2 3 3\nf 1 1 3 4\nf 1 1 2 2\n", 2, SQUARE_BOUNDS)
    claims.check("OBJ: corners that repeat the one before count as no triangle", repeated.get("source_triangles") == 2, repeated)
    box("a fourth number of 1 changes nothing", "".join(f"v {x} {y} {z} 1.0\n" for x, y, z in BOX) +
        "".join(f"f {' '.join(str(i + 1) for i in quad)}\n" for quad in QUADS))
    box("negative numbers count back from the last vertex",
        "".join(f"v {x} {y} {z}\n" for x, y, z in BOX) +
        "".join(f"f {' '.join(str(i - 8) for i in quad)}\n" for quad in QUADS))
    box("faces may precede their vertices",
        "".join(f"f {' '.join(str(i + 1) for i in quad)}\n" for quad in QUADS) +
        "".join(f"v {x} {y} {z}\n" for x, y, z in BOX))
    box("texture coordinates and normals of corners are skipped",
        "".join(f"v {x} {y} {z}\n" for x, y, z in BOX) + "vt 0 0\nvn 1 0 0\n" +
        "".join(f"f {' '.join(f'{i + 1}/1/1' if i % 2 else f'{i + 1}//1' for i in quad)}\n" for quad in QUADS))

    arrow = [(4, 0), (1, 1), (0, 4), (0, 0)]
    for turn in range(4):
        corners = arrow[turn:] + arrow[:turn]
        claims.bakes("OBJ: a concave quad is cut into two triangles", "arrow.obj", polygon_obj(corners), 2, ([0, 0, 0], [4, 4, 0]))
        check_area(claims, "OBJ: the triangles of a concave quad cover it once", "arrow.obj", corners)
    comb = [(0, 0)] + [(x, 3 if x % 2 else 1) for x in range(1, 10)] + [(10, 0)]
    comb.reverse()
    claims.bakes("OBJ: a concave polygon is cut into corners - 2 triangles", "comb.obj", polygon_obj(comb), len(comb) - 2,
                 ([0, 0, 0], [10, 3, 0]))
    check_area(claims, "OBJ: the triangles of a concave polygon cover it once", "comb.obj", comb)
    sides = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nv 0 2 0\nv 0 1 0\nf 1 2 3 4 5 6 7 8\n"
    claims.bakes("OBJ: corners on straight sides take part in triangles with an area", "sides.obj", sides, 6, SQUARE_BOUNDS)
    claims.bakes("OBJ: a polygon that crosses itself is warned of", "crossing.obj",
                 "v 0 0 0\nv 4 0 0\nv 1 3 0\nv 2 -2 0\nv 3 3 0\nf 1 2 3 4 5\n", 3, ([0, -2, 0], [4, 3, 0]), ["crossing_polygon"])

    for axes in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        bow = "".join("v {} {} {}\n".format(*(corner[axis] for axis in axes)) for corner in ((1, 1, 5), (3, 3, 5), (3, 1, 5), (1, 3, 5)))
        bounds = ([(1, 1, 5)[axis] for axis in axes], [(3, 3, 5)[axis] for axis in axes])
        claims.bakes("OBJ: a polygon that crosses itself is warned of also if its parts cancel out", "bow.obj", bow + "f 1 2 3 4\n",
                     2, bounds, ["crossing_polygon"])
    claims.bakes("OBJ: a polygon without area is no crossing one", "line.obj", SQUARE + "f 1 2 3 4\nf 1 2 1 3\nf 1 3 1 3\n", 2, SQUARE_BOUNDS,
                 options=["--max-dropped", "100"])

    groups = SQUARE + "f 1 2 3\no roof\nf 1 3 4\ng a b\nf 1 2 4\no roof\nf 2 3 4\no empty\n"
    claims.bakes("OBJ: objects and groups with faces are meshes", "groups.obj", groups, 4, SQUARE_BOUNDS, meshes=3)
    claims.bakes("OBJ: points, lines and unused vertices are counted", "loose.obj",
                 SQUARE + "v 9 9 9\nf 1 2 3 4\np 1 2\nl 1 2 3\nf 1 2\n", 2, SQUARE_BOUNDS, points_and_lines=5)
    claims.bakes("OBJ: free-form surfaces are warned of", "surface.obj",
                 SQUARE + "f 1 2 3 4\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\n", 2, SQUARE_BOUNDS, ["free_form"])
    claims.bakes("OBJ: unknown statements are warned of", "unknown.obj", SQUARE + "f 1 2 3 4\nfaces 7\n", 2, SQUARE_BOUNDS,
                 ["unknown_statement"])
    claims.bakes("OBJ: a weight of a vertex is warned of", "weight.obj", SQUARE.replace("2 2 0", "2 2 0 0.5") + "f 1 2 3 4\n",
                 2, SQUARE_BOUNDS, ["vertex_weight"])
    claims.bakes("OBJ: --repair drops faces whose vertices are missing, with a warning", "missing.obj",
                 SQUARE + "f 1 2 3\nf 1 2 5\nf 1 -5 3\nf 0 1 2\n", 1, SQUARE_BOUNDS, ["missing_vertex"], options=["--repair", "--max-dropped", "100"])

    claims.refuses("OBJ: a vertex that is missing is refused with its number", "missing.obj", SQUARE + "f 1 2 5\n", "vertex 4")
    claims.refuses("OBJ: a vertex that is missing twice in a face is refused", "missing.obj", SQUARE + "f 1 2 9 9\n", "vertex 8")
    claims.refuses("OBJ: a word that is no number is refused with its line", "word.obj", "v 0 0 0\nv 1,5 0 0\n", "line 2", "'1,5'")
    claims.refuses("OBJ: a word behind the coordinates is refused with its line", "word.obj", "v 0 0 0 1 junk\n" + SQUARE + "f 2 3 4\n", "line 1", "'junk'")
    claims.refuses("OBJ: a corner that is no number is refused with its line", "corner.obj", SQUARE + "f 1 2 x\n", "line 5", "'x'")
    claims.refuses("OBJ: two coordinates are refused", "short.obj", "v 0 0\n", "line 1", "2 coordinates")
    claims.refuses("OBJ: a binary file is refused", "binary.obj", b"v 0 0 0\n\0\0", "no Wavefront OBJ")
    claims.refuses("OBJ: a call of another file is refused", "call.obj", "call other.obj\n", "line 1", "'call'")
    claims.refuses("OBJ: an infinite coordinate is refused", "infinite.obj", "v 1e39 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "infinity")

    for huge in ("1e400", "-.1e401", "1" + "0" * 400, "1e99999999999999999999"):
        claims.refuses("OBJ: a coordinate beyond every type is infinite", "infinite.obj", f"v {huge} 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "infinity")

    claims.write("library.mtl", "newmtl red\nnewmtl green paint\n")
    faces = ["f 1 2 3", "usemtl green paint", "f 1 3 4", "usemtl unknown", "f 1 2 4", "usemtl red", "f 2 3 4"]
    claims.bakes("OBJ: materials are baked", "materials.obj", "mtllib library.mtl\n" + SQUARE + "\n".join(faces) + "\n", 4,
                 SQUARE_BOUNDS)
    check_materials(claims, "OBJ: materials are numbered by their library, then by use", "materials.obj", [0, 2, 3, 1])

    red, unknown = "usemtl red\nf 1 2 3\n", "usemtl unknown\nf 1 3 4\n"
    with_materials = ["--materials", "8"]
    for libraries, faces, options, warnings in (
            ("absent.mtl", red, with_materials, ["missing_file"]), ("absent.mtl", red, [], []),
            ("absent.mtl", "f 1 2 3\n", with_materials, []), ("absent.mtl", "f 1 2 3\n" + unknown, with_materials, ["missing_file"]),
            ("library.mtl absent.mtl", red, with_materials, []), ("absent.mtl library.mtl", red, with_materials, ["missing_file"]),
            ("library.mtl", unknown, with_materials, []), ("", red, with_materials, [])):
        document = claims.bakes(f"OBJ: 'mtllib {libraries}' warns exactly if a baked number may be another", "library.obj",
                                f"mtllib {libraries}\n{SQUARE}{faces}f 1 2 3\nf 1 3 4\n", 2, SQUARE_BOUNDS, warnings, options)
        if warnings and document.get("warnings"):
            message = document["warnings"][0]["message"]
            claims.check("OBJ: the missing library is named", "'absent.mtl'" in message and "library.obj" in message, message)


def polygon_obj(corners):
    return "".join(f"v {x} {y} 0\n" for x, y in corners) + "f " + " ".join(str(i + 1) for i in range(len(corners))) + "\n"


def check_area(claims, claim, name, corners):
    """The triangles that were baked from the file have the polygon's area together."""
    expected = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))) / 2
    total = 0.0
    mesh = os.path.join(claims.folder, "area.obj")
    path = os.path.join(claims.folder, name)
    subprocess.run([claims.espalier, "bake", path, "-o", claims.blob, "--reorder", mesh, "-q"], check=True)
    vertices = []
    with open(mesh, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                a, b, c = (vertices[int(word.split("/")[0]) - 1] for word in words[1:4])
                total += abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
    claims.check(claim, total == expected, f"area {total}, not {expected}")


def check_materials(claims, claim, name, expected):
    """The material of the source's triangles, in their order."""
    path = os.path.join(claims.folder, name)
    subprocess.run([claims.espalier, "bake", path, "-o", claims.blob, "--materials", "8", "--ids", "-q"], check=True)
    answer = subprocess.run([claims.espalier, "query", claims.blob, "triangles", "--json"], capture_output=True, check=False)
    triangles = json.loads(answer.stdout or b"{}").get("triangles", [])
    found = {triangle["original"]["triangle"]: triangle["material"] for triangle in triangles}
    claims.check(claim, [found.get(i) for i in range(len(expected))] == expected, answer.stdout[:2000])


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
    claims.bakes("PLY: --repair drops faces whose vertices are missing, with a warning", "missing.ply",
                 text.replace("4 0 1 3 2", "3 0 1 8"), 10, BOX_BOUNDS, ["missing_vertex"], options=["--repair", "--max-dropped", "100"])

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
    claims.refuses("PLY: another format with this ending is refused", "obj.ply", obj_box(), "no PLY")


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
    for name, content in (("a zero byte", stl_text() + "\0"), ("another first word", "color 1 0 0\n" + stl_text())):
        claims.refuses(f"STL: a text with {name} is refused with what a text is", "text.stl", content, "begins with 'solid'", "zero byte")
    claims.refuses("STL: a text that is cut off is refused", "cut.stl", stl_text()[:-60].rsplit("\n", 1)[0], "facet")
    claims.refuses("STL: a facet with four corners is refused", "four.stl", stl_text().replace("endloop", "vertex 0 0 0\nendloop", 1), "4 corners")
    claims.refuses("STL: a word that is no number is refused with its line", "word.stl", stl_text().replace("vertex 0 0 0", "vertex 0 a 0", 1), "line 4", "'a'")
    claims.refuses("STL: another format with this ending is refused", "obj.stl", obj_box(), "STL")


def names(claims):
    claims.refuses("names: an ending without an importer is named", "scene.wrl", "#VRML V2.0 utf8\nShape { v f }\n", "no importer for '.wrl' files")
    claims.refuses("names: a file without an ending or a known content is refused", "readme", "vertex v f usemtl\n", "no ending")
    claims.refuses("names: a binary format without an importer is not taken for OBJ", "model.m3d", b"3DMO\x10\0\0\0v f \n\0v 1 2 3\n", "no importer for '.m3d'")
    claims.bakes("names: what assimp reports as wrong is warned of", "report.off",
                 "OFF\n4 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3\n3 0 1 9\n", 3, SQUARE_BOUNDS,
                 ["importer_report"])
    claims.refuses("names: an empty file is refused", "empty.3ds", "", "is empty")
    collada = "<?xml version=\"1.0\" encoding=\"utf-16\"?><COLLADA version=\"1.4.1\"><asset/></COLLADA>"
    claims.refuses("names: a broken file is refused without a guess about its name", "broken.dae", collada[:40], "cannot be imported")


RAW = "0 0 0 2 0 0 2 2 0\n"
ASE = """*3DSMAX_ASCIIEXPORT 200
*GEOMOBJECT {{
*NODE_NAME "square"
*MESH {{
*MESH_NUMVERTEX 4
*MESH_NUMFACES 2
*MESH_VERTEX_LIST {{
*MESH_VERTEX 0 0 0 0
*MESH_VERTEX 1 2 0 0
*MESH_VERTEX 2 2 2 0
*MESH_VERTEX 3 0 2 0
}}
*MESH_FACE_LIST {{
*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 0
*MESH_FACE 1: A: 0 B: {} C: 3 AB: 1 BC: 1 CA: 0
}}
}}
}}
"""
OGRE = ('<mesh><submeshes><submesh material="m" usesharedvertices="false" operationtype="triangle_list"><faces count="2">'
        '<face v1="0" v2="1" v3="2"/><face v1="0" v2="2" v3="{}"/></faces><geometry vertexcount="4">'
        '<vertexbuffer positions="true" normals="false"><vertex><position x="0" y="0" z="0"/></vertex>'
        '<vertex><position x="2" y="0" z="0"/></vertex><vertex><position x="2" y="2" z="0"/></vertex>'
        '<vertex><position x="0" y="2" z="0"/></vertex></vertexbuffer></geometry></submesh></submeshes></mesh>')
SMD = ("version 1\nnodes\n0 \"r\" -1\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\nend\ntriangles\n"
       "m\n0 0 0 0 0 0 1 0 0\n0 2 0 0 0 0 1 0 0\n0 2 2 0 0 0 1 0 0\nend\n")
DXF_FACE = "0\n3DFACE\n8\n0\n" + "".join(f"1{i}\n{x}\n2{i}\n{y}\n3{i}\n0\n" for i, (x, y) in enumerate([(0, 0), (2, 0), (2, 2), (0, 2)]))
X = "xof 0303txt 0032\nMesh m {{\n4;\n0;0;0;,\n2;0;0;,\n2;2;0;,\n0;2;0;;\n2;\n3;0,1,2;,\n3;0,2,{};;\n}}\n"
AC = ('AC3Db\nMATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n'
      "numvert 4\n0 0 0\n2 0 0\n2 2 0\n0 2 0\nnumsurf {}\n"
      "SURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n2 0 0\n3 0 0\nkids 0\n")
COLLADA = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="m"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="12">0 0 0 2 0 0 2 2 0 0 2 0</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/>{}</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
AMF = ('<?xml version="1.0"?><amf{}><object id="0"><mesh><vertices>' + "".join(
    f"<vertex><coordinates><x>{x}</x><y>{y}</y><z>0</z></coordinates></vertex>" for x, y in ((0, 0), (2, 0), (2, 2), (0, 2))) +
       "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle>"
       "<triangle><v1>0</v1><v2>2</v2><v3>3</v3></triangle></volume></mesh></object></amf>")


def lwo(*lists):
    def chunk(name, data):
        return name + struct.pack(">I", len(data)) + data + b"\0" * (len(data) % 2)

    corners = b"".join(struct.pack(">3f", *corner) for corner in ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)))
    form = b"LWO2" + chunk(b"TAGS", b"a\0") + chunk(b"LAYR", struct.pack(">HH3f", 0, 0, 0, 0, 0) + b"l\0") + chunk(b"PNTS", corners)
    for kind, faces in lists:
        form += chunk(b"POLS", kind + b"".join(struct.pack(f">{len(face) + 1}H", len(face), *face) for face in faces))
    return b"FORM" + struct.pack(">I", len(form)) + form


def fbx(second, up=1):
    def mesh(number, vertices):
        return (f'\tGeometry: {number}, "Geometry::g", "Mesh" {{\n\t\tVertices: *{vertices.count(",") + 1} {{\n\t\t\ta: {vertices}\n\t\t}}\n'
                f'\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: 0,1,-3\n\t\t}}\n\t}}\n\tModel: {number + 1}, "Model::m", "Mesh" {{\n\t\tVersion: 232\n\t}}\n')

    return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\nGlobalSettings:  {\n\tVersion: 1000\n"
            '\tProperties70:  {\n\t\tP: "UpAxis", "int", "Integer", "",' + str(up) + '\n\t\tP: "UnitScaleFactor", "double", "Number", "",100\n\t}\n}\n'
            "Objects:  {\n" + mesh(100, "0,0,0,2,0,0,2,2,0") + mesh(200, second) + "}\nConnections:  {\n" +
            "".join(f'\tC: "OO",{i + 1},0\n\tC: "OO",{i},{i + 1}\n' for i in (100, 200)) + "}\n")


def three_mf():
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr("[Content_Types].xml", '<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
                         '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
                         '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        archive.writestr("_rels/.rels", '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", '<?xml version="1.0"?><model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
                         '<resources><object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="2" y="0" z="0"/>'
                         '<vertex x="2" y="2" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources>'
                         '<build><item objectid="1"/></build></model>')
    return content.getvalue()


def assimp(claims):
    """Formats that assimp reads, and RAW, which it read wrong."""
    def square(claim, name, content, warnings=(), triangles=2, **options):
        is_turned = name.endswith((".ase", ".dxf"))  # from +Z up
        claims.bakes(claim, name, content, triangles, ([0, 0, -2], [2, 0, 0]) if is_turned else SQUARE_BOUNDS, warnings, **options)

    square("reports: a whole Collada is baked without a warning", "node.dae", COLLADA.format(""))
    for name, node in (("missing", "#zz"), ("external", "other.dae#zz")):
        square(f"reports: a {name} node of Collada is warned of", "node.dae", COLLADA.format(f'<instance_node url="{node}"/>'),
               ["importer_report"])
    square("reports: a missing block of DXF is warned of", "block.dxf",
           "0\nSECTION\n2\nENTITIES\n" + DXF_FACE + "0\nINSERT\n2\nBLK\n10\n5\n20\n5\n30\n5\n0\nENDSEC\n0\nEOF\n", ["importer_report"])
    square("reports: a whole AC3D is baked without a warning", "square.ac", AC.format(2))
    code, document, _ = bake(claims, "two.fbx", fbx("9,0,0,8,0,0,8,2,0"))
    claims.check("reports: two meshes of FBX are baked without a warning", code == 0 and document["warnings"] == [], document)
    for name, vertices in (("floats that are no multiple of three", "9,0,0,8,0,0,8,2"), ("a word among the floats", "9,x,0,8,0,0,8,2,0")):
        code, document, _ = bake(claims, "two.fbx", fbx(vertices))
        kinds = [warning["kind"] for warning in document.get("warnings", [])]
        claims.check(f"reports: {name} of FBX are warned of", code != 0 or "importer_report" in kinds, document)

    square("RAW: nine numbers are a triangle", "square.raw", RAW + "0 0 0 2 2 0 0 2 0\n", format="RAW")
    square("RAW: groups are meshes, and a texture is skipped", "group.raw", "one\n" + RAW + "two\n0 0 0 2 2 0 0 2 0 a b.png\n", meshes=2)
    claims.bakes("RAW: .5 is a half", "half.raw", ".5 0 0 2.5 0 0 2 2 -.5\n", 1, ([0.5, 0, -0.5], [2.5, 2, 0]))
    square("RAW: twelve numbers begin with a colour and are warned of", "colour.raw", "1 .5 1 " + RAW, ["colour_or_corner"], triangles=1)
    for name, line, words in (("eight numbers", "0 0 0 9 0 0 0 9", "8 numbers"), ("a word", "0 0 0 9 0 0 0 x 0", "'x'"),
                              ("commas", "0,0,0,9,0,0,0,9,0 0", "'0,0,0,9,0,0,0,9,0'"), ("13 numbers", "1 1 1 " + RAW[:-1] + " 3", "more than"),
                              ("numbers behind a word", RAW[:-1] + " tex 5 5 5", "'5'"), ("a comma behind nine", RAW[:-1] + " 0,0", "'0,0'"),
                              ("a number behind a texture of twelve", "1 1 1 " + RAW[:-1] + " tex 5", "more than")):
        claims.refuses(f"RAW: a line with {name} is refused", "line.raw", RAW + line + "\n", "line 2", words)

    square("ASE: a whole file is baked without a warning", "square.ase", ASE.format(2))
    for index in (4, 9):
        claims.refuses(f"ASE: vertex {index} of four is refused with its line", "index.ase", ASE.format(index), "line 15", f"vertex {index}")
    square("Ogre: a whole file is baked without a warning", "square.mesh.xml", OGRE.format(3))
    for index in (4, 9):
        claims.refuses(f"Ogre: vertex {index} of four is refused", "index.mesh.xml", OGRE.format(index), f"vertex {index}")
    square("X: a whole file is baked without a warning", "square.x", X.format(3))
    code, document, _ = bake(claims, "index.x", X.format(9))
    kinds = [warning["kind"] for warning in document.get("warnings", [])]
    claims.check("X: a face with a missing vertex is warned of", code == 0 and kinds == ["empty_face"], document)
    square("LWO: one list of polygons is baked without a warning", "square.lwo", lwo((b"FACE", [(0, 1, 2), (0, 2, 3)])))
    claims.refuses("LWO: two lists of polygons are refused", "two.lwo", lwo((b"FACE", [(0, 1, 2)]), (b"FACE", [(0, 2, 3)])), "POLS", "glTF")

    end = "0\nENDSEC\n0\nEOF\n"
    dxf = "0\nSECTION\n2\nENTITIES\n" + DXF_FACE
    square("DXF: a whole file is baked without a warning", "end.dxf", dxf + end)
    square("DXF: a missing EOF is warned of", "end.dxf", dxf + end.replace("EOF\n", ""), ["missing_end"])
    for text, warnings in ((SMD, []), (SMD[:-4], ["missing_end"])):
        code, document, _ = bake(claims, "end.smd", text)
        kinds = [warning["kind"] for warning in document.get("warnings", [])]
        claims.check("SMD: a missing end is warned of", code == 0 and kinds == warnings, document)

    for unit, metres in (("", 0.001), (' unit="inch"', 0.0254), (' version="1.1" unit="meter"', 1)):
        code, document, stderr = bake(claims, "unit.amf", AMF.format(unit))
        found = document.get("inputs", [{}])[0].get("metres_per_unit")
        claims.check(f"AMF: the unit of <amf{unit}> is read", code == 0 and found == metres, (found, stderr))
    for options, metres, warnings in (((), 0.001, ["unit_not_read"]), (("--unit", "in"), 0.0254, [])):
        code, document, stderr = bake(claims, "unit.3mf", three_mf(), *options)
        found = document.get("inputs", [{}])[0].get("metres_per_unit"), [warning["kind"] for warning in document.get("warnings", [])]
        claims.check("3MF: a unit that is not read is warned of", code == 0 and found == (metres, warnings), (found, stderr))
    for options, warnings in (((), ["up_axis_kept"]), (("--up", "z"), [])):
        code, document, stderr = bake(claims, "up.fbx", fbx("9,0,0,8,0,0,8,2,0", 2), *options)
        kinds = [warning["kind"] for warning in document.get("warnings", [])]
        claims.check("FBX: an up axis that was kept is warned of", code == 0 and kinds == warnings, (kinds, stderr))
    square("names: an ending without an importer is warned of if the content has one", "square.model", AC.format(2), ["unknown_ending"])
    skeleton = SMD[:SMD.index("triangles")]
    code, document, stderr = bake(claims, "skeleton.smd", skeleton, "--allow-empty")
    kinds = [warning["kind"] for warning in document.get("warnings", [])]
    claims.check("SMD: a skeleton alone is an incomplete scene", code == 0 and kinds == ["incomplete_scene"], (kinds, stderr))
    claims.refuses("SMD: a skeleton alone is refused with the cause", "skeleton.smd", skeleton, "incomplete", "--allow-empty")
    claims.refuses("LWO: splines alone are refused", "spline.lwo", lwo((b"CURV", [(0, 1, 2), (0, 2, 3)])), "No meshes")
    square("AC3D: more surfaces than stated are warned of", "square.ac", AC.format(1), ["surface_count"], triangles=1)
    square("AC3D: fewer vertices than stated are warned of", "square.ac", AC.format(2).replace("numvert 4", "numvert 5"), ["importer_report"])
    code, document, stderr = bake(claims, "square.ac", AC.format(2).replace("3 0 0\nkids", "9 0 0\nkids"), "--max-dropped", "50")
    kinds = [warning["kind"] for warning in document.get("warnings", [])]
    claims.check("AC3D: a missing vertex is warned of", code == 0 and kinds == ["importer_report"], (kinds, stderr))
    claims.refuses("AMF: an unknown unit is refused", "unit.amf", AMF.format(' unit="ell"'), "ell")


def bake(claims, name, content, *options):
    claims.write(name, content)
    return claims.run(name, *options)


def main():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    with tempfile.TemporaryDirectory() as folder:
        claims = Claims(sys.argv[1], folder)
        for family in (obj, ply, stl, names, assimp):
            family(claims)
        if claims.failures:
            print(f"{claims.failures} claims failed")
        return 1 if claims.failures else 0


if __name__ == "__main__":
    sys.exit(main())
