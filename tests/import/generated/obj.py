"""Wavefront OBJ."""
from .claims import BOX, BOX_BOUNDS, QUADS, SQUARE, SQUARE_BOUNDS, check_area, check_materials


def obj_box(number=str, newline="\n", first="", separator=" "):
    lines = [first] if first else []
    lines += [separator.join(["v", *map(number, corner)]) for corner in BOX]
    lines += [separator.join(["f", *(str(i + 1) for i in quad)]) for quad in QUADS]
    return newline.join(lines) + newline


def polygon_obj(corners):
    return "".join(f"v {x} {y} 0\n" for x, y in corners) + "f " + " ".join(str(i + 1) for i in range(len(corners))) + "\n"


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
                 SQUARE + "v 9 9 9\nf 1 2 3 4\np 1 2\nl 1 2 3\nf 1 2\n", 2, SQUARE_BOUNDS, ["short_face"], points_and_lines=5)
    claims.bakes("OBJ: free-form surfaces are warned of", "surface.obj",
                 SQUARE + "f 1 2 3 4\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\n", 2, SQUARE_BOUNDS, ["free_form"])
    claims.bakes("OBJ: unknown statements are warned of", "unknown.obj", SQUARE + "f 1 2 3 4\nfaces 7\n", 2, SQUARE_BOUNDS,
                 ["unknown_statement"])
    claims.bakes("OBJ: a weight of a vertex is warned of", "weight.obj", SQUARE.replace("2 2 0", "2 2 0 0.5") + "f 1 2 3 4\n",
                 2, SQUARE_BOUNDS, ["vertex_weight"])
    claims.bakes("OBJ: --drop-bad-triangles drops faces whose vertices are missing, with a warning", "missing.obj",
                 SQUARE + "f 1 2 3\nf 1 2 5\nf 1 -5 3\nf 0 1 2\n", 1, SQUARE_BOUNDS, ["missing_vertex"], options=["--drop-bad-triangles", "--max-dropped", "100"])

    for numbers, words, more in (("1 2 5", "vertex 5, and the file has 4", ""), ("1 2 9 9", "vertex 9", ""), ("0 1 2", "vertex 0", ""),
                                 ("1 2 -9", "vertex -9", ""), ("1 2 -5", "vertex -5, counted back, and 4 vertices precede it", "v 9 9 9\n"),
                                 ("1 2 99999999999", "vertex 99999999999", "")):
        claims.refuses("OBJ: a missing vertex is refused with its line and its number as written", "missing.obj",
                       SQUARE + f"f 1 2 3\nf {numbers}\n{more}", "line 6", words)
    claims.refuses("OBJ: a word that is no number is refused with its line", "word.obj", "v 0 0 0\nv 1,5 0 0\n", "line 2", "'1,5'")
    claims.refuses("OBJ: a word behind the coordinates is refused with its line", "word.obj", "v 0 0 0 1 junk\n" + SQUARE + "f 2 3 4\n", "line 1", "'junk'")
    claims.refuses("OBJ: a corner that is no number is refused with its line", "corner.obj", SQUARE + "f 1 2 x\n", "line 5", "'x'")
    claims.refuses("OBJ: two coordinates are refused", "short.obj", "v 0 0\n", "line 1", "2 coordinates")
    claims.refuses("OBJ: a binary file is refused", "binary.obj", b"v 0 0 0\n\0\0f", "no Wavefront OBJ")
    claims.refuses("OBJ: a call of another file is refused", "call.obj", "call other.obj\n", "line 1", "'call'")
    for number, words in (("inf", "x = infinity"), ("1e400", "x = infinity"), ("1e39", "1e+39, beyond float32")):
        claims.refuses("OBJ: a coordinate that is infinite or beyond float32 is refused", "infinite.obj",
                       f"v {number} 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", words)

    for huge in ("1e400", "-.1e401", "1" + "0" * 400, "1e99999999999999999999"):
        claims.refuses("OBJ: a coordinate beyond every type is infinite", "infinite.obj", f"v {huge} 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "infinity")

    claims.write("library.mtl", "newmtl red\nnewmtl green paint\n")
    faces = ["f 1 2 3", "usemtl green paint", "f 1 3 4", "usemtl unknown", "f 1 2 4", "usemtl red", "f 2 3 4"]
    claims.bakes("OBJ: materials are baked", "materials.obj", "mtllib library.mtl\n" + SQUARE + "\n".join(faces) + "\n", 4,
                 SQUARE_BOUNDS)
    check_materials(claims, "OBJ: materials are numbered by their library, then by use", "materials.obj", [0, 2, 3, 1])

    red, unknown = "usemtl red\nf 1 2 3\n", "usemtl unknown\nf 1 3 4\n"
    with_materials = ["--materials"]
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
