"""OFF."""
from .claims import BOX, BOX_BOUNDS, QUADS, SQUARE_BOUNDS

HEAD = "OFF\n8 6 12\n"
SQUARE = "OFF\n4 {} 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n"


def off_box(head=HEAD, more="", colour="", separator=" ", newline="\n"):
    vertices = [separator.join(map(str, corner)) + more for corner in BOX]
    faces = [separator.join(map(str, (4, *quad))) + colour for quad in QUADS]
    return (head + "\n".join(vertices + faces) + "\n").replace("\n", newline)


def off(claims):
    def box(claim, content, **options):
        claims.bakes("OFF: " + claim, "box.off", content, 12, BOX_BOUNDS, closed=True, format="OFF", **options)

    def square(claim, faces, **options):
        claims.bakes("OFF: " + claim, "square.off", SQUARE.format(1) + faces, 2, SQUARE_BOUNDS, **options)

    box("counts on a line of their own", off_box())
    box("line breaks may stand anywhere", off_box(separator="\n"))
    box("all may be on few lines", off_box().replace("\n", " ", 10))
    for head in ("OFF 8 6 12\n", "OFF\n8\n6\n12\n", "OFF8 6 12\n", "OFF\n8 6\n", "# box\n\nOFF # 1 2\n8 6 0 # 3\n"):
        box(f"{head!r} begins a file", off_box(head))
    box("comments are skipped", off_box(more=" # 7 7", colour="#").replace("\n4 0", "\n# 9\n\n4 0", 1))
    box("lines may end with CR", off_box(newline="\r"))
    for letters, more in (("C", " 255 0 0"), ("C", " .5 0 0 1"), ("N", " 0 0 1"), ("ST", " .5 .5"), ("STCN", " 1 1 1 1 0 0 1 0 0"), ("", " 9 9 9")):
        box(f"{letters}OFF with{more} for each vertex", off_box(letters + HEAD, more))
    box("numbers of a vertex that follow on the next line", off_box("CNOFF\n8 6 12\n", "\n1 1 1 1\n0 0 1"))
    for colour in (" 255 0 0", " 1 0 0 .5", " 3"):
        box(f"a face's colour{colour} ends with its line", off_box(colour=colour))
    square("a face continues in the next line and its colour does not", "4 0\n1 2\n3 9 9 9\n")
    claims.bakes("OFF: faces of one or two corners are points and lines", "loose.off", SQUARE.format(4) + "1 0\n2 0 1\n0\n3 0 1 2\n", 1,
                 SQUARE_BOUNDS, points_and_lines=3)  # and a vertex of no triangle
    arrow = "OFF\n4 1 0\n4 0 0\n1 1 0\n0 4 0\n0 0 0\n4 0 1 2 3\n"
    claims.bakes("OFF: a concave polygon is cut by its shape", "arrow.off", arrow, 2, ([0, 0, 0], [4, 4, 0]))
    square("more than the header states is warned of", "4 0 1 2 3\n3 0 1 2\n", warnings=["trailing_bytes"])
    claims.bakes("OFF: vertices keep their order", "order.off", "OFF\n4 1 0\n9 9 9\n0 0 0\n2 0 0\n2 2 0\n3 1 2 3\n", 1, SQUARE_BOUNDS,
                 options=["--deformable", "--range", "0", "0", "0", "9", "9", "9"])

    for claim, content, words in (
            ("a file that ends within a face", SQUARE.format(1) + "4 0 1 2\n", ["states 1 face, and the file has 0", "within face 0"]),
            ("fewer faces than stated", SQUARE.format(3) + "3 0 1 2\n", ["states 3 faces, and the file has 1"]),
            ("two faces on a line", SQUARE.format(2) + "3 0 1 2 3 0 2 3\n", ["line 7", "line of its own"]),
            ("two polygons on a line", SQUARE.format(2) + "4 0 1 2 3 4 0 1 2 3\n", ["line 7", "5 numbers follow"]),
            ("fewer vertices than stated", "OFF\n4 0 0\n0 0 0\n1 1 # no more\n", ["line 4", "vertex 1"]),
            ("more vertices than bytes", "OFF\n200000000 1 0\n0 0 0\n", ["line 2", "200000000 vertices"]),
            ("more faces than bytes", SQUARE.format(200000000) + "3 0 1 2\n", ["200000000 faces"]),
            ("a word in a vertex", SQUARE.format(1).replace("2 2 0", "2 x 0"), ["line 5", "'x'"]),
            ("a fraction in a face", SQUARE.format(1) + "3 0 1 2.5\n", ["line 7", "'2.5'"]),
            ("a negative count", "OFF\n-4 1 0\n", ["line 2", "'-4'"]), ("no count", "OFF\n", ["''"]),
            ("the binary form", b"OFF BINARY\n\0\0\0\4", ["binary OFF", "text"]),
            ("four axes", "4OFF\n1 0 0\n0 0 0 1\n", ["three coordinates"]), ("a number of axes", "nOFF\n2 1 0 0\n1 1\n", ["three coordinates"]),
            ("another text with this ending", "o box\nw 0 0 0\n", ["no OFF"])):
        claims.refuses(f"OFF: {claim} is refused", "bad.off", content, *words)
    for number in ("9", "-1", "99999999999"):
        claims.refuses("OFF: a missing vertex is refused with its line and its number as written", "missing.off",
                       SQUARE.format(2) + f"3 0 1 2\n3 0 1 {number}\n", "line 8", "face 1", f"vertex {number}")
        claims.bakes("OFF: a missing vertex is named with its face", "missing.off", SQUARE.format(2) + f"3 0 1 2\n3 0 1 {number}\n", 1,
                     SQUARE_BOUNDS, ["missing_vertex"], options=["--drop-bad-triangles", "--max-dropped", "50"])
