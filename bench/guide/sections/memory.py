"""Chapter memory.md of the guide, the degree of the tree and the ladder: rows of espalier_bench_study ladder."""

import charts
from report_page import fail, table

LADDER, DEGREE = "ladder", "degree"
FIELDS = ("tree", "degree", "leaf_triangles", "nodes", "node_bytes", "bytes_per_triangle", "all_bytes_per_triangle", "rays", "nodes_per_ray",
          "leaves_per_ray", "box_tests_per_ray", "triangle_tests_per_ray", "ns_per_ray", "boxes", "nodes_per_box", "leaves_per_box",
          "box_tests_per_box", "triangle_tests_per_box", "touching_per_box", "ns_per_box", "rays_that_differ", "boxes_that_differ",
          "counted_twice", "rounds")
ROWS = {LADDER: FIELDS, DEGREE: FIELDS}
# Terdiman's ladder and degrees from 2 to 16, in the order of tables and figures: name of the rows, words of the table,
# label in the figure.
TREES = {
    LADDER: (("complete", "1. complete, one triangle a leaf", "1. complete"),
             ("several a leaf", "2. up to {leaf} triangles a leaf", "2. several a leaf"),
             ("no leaf nodes", "3. no leaf nodes (of step 1)", "3. no leaf nodes"),
             ("quantised", "4. step 3, quantised", "4. quantised"),
             ("quantised, several a leaf", "5. step 4, up to {leaf} triangles a leaf", "5. quantised, several"),
             ("espalier fast", "6. Espalier, profile `fast`", "6. Espalier, fast"),
             ("espalier small", "7. Espalier, profile `small`", "7. Espalier, small")),
    DEGREE: (("2", "2", "2"),
             ("4", "4", "4"),
             ("8", "8", "8"),
             ("16", "16", "16"),
             ("espalier balanced", "8, in lanes: Espalier, profile `balanced`", "Espalier, 8 in lanes"),
             ("espalier fast", "16, in lanes: Espalier, profile `fast`", "Espalier, 16 in lanes")),
}


# ---- tables ------------------------------------------------------------------------------------------------------------


def cell(row, query):
    work = "; ".join(charts.number(row[f"{field}_per_{query}"]) for field in ("nodes", "box_tests", "triangle_tests"))
    return f"{work}; {charts.time(row[f'ns_per_{query}'])}"


def range_of(rows, field):
    """The least and the greatest value over the meshes, or the only one."""
    low, high = (f"{end(row[field] for row in rows):.1f}" for end in (min, max))
    return low if low == high else f"{low} to {high}"


def tree_table(rows, measures, what, query, sizes=None):
    """A line for each tree, and a column for each mesh. `sizes`: fields of bytes a triangle, and their words."""
    lines = []
    for name, words, _ in TREES[measures]:
        shown = rows.of(measures, tree=name)
        bytes_of = [str(shown[0]["node_bytes"]), *(range_of(shown, field) for field in sizes)] if sizes else []
        lines.append([words.format(leaf=shown[0]["leaf_triangles"]), *bytes_of,
                      *(cell(rows.one(measures, mesh=mesh, tree=name), query) for mesh in rows.meshes(measures))])
    bytes_words = ["bytes of a node", *sizes.values()] if sizes else []
    return table([what, *bytes_words, *(f"{mesh}: a {query}" for mesh in rows.meshes(measures))], lines)


def recounted(rows):
    """How many queries were counted by both counters, and how many answers of blobs differ."""
    numbers = {row["counted_twice"] for row in rows}
    if len(numbers) != 1:
        fail("rows were counted twice for different numbers of queries")
    most = max(row["rays_that_differ"] for row in rows)
    boxes = max(row["boxes_that_differ"] for row in rows)
    differing = f"of a blob, whose tests are exact, those of at most {most} rays and {boxes} boxes of a mesh differ"
    return (f"A second counter, which shares no code with the walks, has the same counts for the first {numbers.pop()} rays and boxes of each tree;\n"
            "rays of a blob are counted by the library alone, a node again when the ray returns to it, and boxes by a walk over the blob's nodes.\n"
            f"All textbook trees have the same answers; {differing}.")


def ladder_words(rows):
    row = rows.of(LADDER)[0]
    touching = ", ".join(f"{mesh} {charts.number(rows.one(LADDER, mesh=mesh, tree=TREES[LADDER][0][0])['touching_per_box'])}"
                         for mesh in rows.meshes(LADDER))
    return (f"Nodes visited; boxes tested; triangles tested; time. Means over {row['rays']:,} incoherent rays to their closest hit,\n"
            f"and over {row['boxes']:,} boxes that find all triangles that they touch (on average: {touching}).\n"
            f"{recounted(rows.of(LADDER))}\n"
            "*With triangles* adds to steps 1 to 5 the mesh, three indices a triangle and three floats a vertex; to Espalier all that a blob has.")


def degree_words(rows):
    row = rows.of(DEGREE)[0]
    return (f"Nodes visited; boxes tested; triangles tested; time. {row['rays']:,} incoherent rays to their closest hit, and {row['boxes']:,} boxes\n"
            f"that find all triangles that they touch. Leaves of degree 2 to 16 are the same, of up to {row['leaf_triangles']} triangles.\n"
            f"{recounted(rows.of(DEGREE))}")


# ---- figures -----------------------------------------------------------------------------------------------------------


def panel(rows, measures, title, field, trees=None, is_ratio=True):
    """A bar for each tree: values, or those over that of the first tree on the same mesh."""
    bars = []
    for name, _, label in trees or TREES[measures]:
        values = (rows.ratios(measures, field, {"tree": TREES[measures][0][0]}, tree=name) if is_ratio else
                  [row[field] for row in rows.of(measures, tree=name)])
        bars.append(charts.mean_bar(label, values, 1 if name.startswith("espalier") else 0))
    return charts.Bars(title, bars)


def ladder_figure(rows):
    panels = [panel(rows, LADDER, "Bytes a triangle, nodes", "bytes_per_triangle", is_ratio=False),
              panel(rows, LADDER, "Bytes a triangle, nodes and triangles", "all_bytes_per_triangle", is_ratio=False),
              panel(rows, LADDER, "Time of a ray, in times of step 1", "ns_per_ray"),
              panel(rows, LADDER, "Time of a box, in times of step 1", "ns_per_box")]
    return charts.draw_bar_panels("Terdiman's ladder: bytes and time", panels,
                     legend=("textbook trees: the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def degree_figure(rows):
    counted = [tree for tree in TREES[DEGREE] if not tree[0].startswith("espalier")]
    panels = [panel(rows, DEGREE, "Nodes that a ray visits, in times of degree 2", "nodes_per_ray"),
              panel(rows, DEGREE, "Boxes that a ray tests, in times of degree 2", "box_tests_per_ray", counted),
              panel(rows, DEGREE, "Time of a ray, in times of degree 2", "ns_per_ray"),
              panel(rows, DEGREE, "Time of a box, in times of degree 2", "ns_per_box")]
    return charts.draw_bar_panels("The degree of the tree", panels,
                     legend=("one box at a time: the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def made(rows):
    nodes = {"bytes_per_triangle": "bytes a triangle: nodes"}
    ladder = (tree_table(rows, LADDER, "step", "ray", {**nodes, "all_bytes_per_triangle": "with triangles"}),
              tree_table(rows, LADDER, "step", "box"), ladder_words(rows))
    degree = (tree_table(rows, DEGREE, "degree", "ray", nodes), tree_table(rows, DEGREE, "degree", "box"), degree_words(rows))
    return {"ladder": "\n\n".join(ladder), "ladder.svg": ladder_figure(rows),
            "degree": "\n\n".join(degree), "degree.svg": degree_figure(rows)}
