"""Section 5 of the guide, the degree of the tree: 2, 4, 8 or 16 children a node."""

import charts
import tree_rows
from report_page import table

DEGREE = "degree"
ROWS = {DEGREE: tree_rows.FIELDS}
# In the order of table and figure: name of the rows, words of the table, label in the figure.
TREES = (
    ("2", "2", "2"),
    ("4", "4", "4"),
    ("8", "8", "8"),
    ("16", "16", "16"),
    ("espalier balanced", "8, in lanes: Espalier, profile `balanced`", "Espalier, 8 in lanes"),
    ("espalier fast", "16, in lanes: Espalier, profile `fast`", "Espalier, 16 in lanes"),
)
FIRST = TREES[0][0]


def degree_table(rows, cell):
    meshes = rows.meshes(DEGREE)
    lines = []
    for name, words, _ in TREES:
        shown = rows.of(DEGREE, tree=name)
        lines.append([words, str(shown[0]["node_bytes"]), tree_rows.range_of(shown, "bytes_per_triangle"),
                      *(cell(rows.one(DEGREE, mesh=mesh, tree=name)) for mesh in meshes)])
    return lines


def text(rows):
    meshes = rows.meshes(DEGREE)
    rays = table(["degree", "bytes of a node", "bytes a triangle: nodes", *(f"{mesh}: a ray" for mesh in meshes)],
                 degree_table(rows, tree_rows.ray_cell))
    boxes = table(["degree", *(f"{mesh}: a box" for mesh in meshes)],
                  [[line[0], *line[3:]] for line in degree_table(rows, tree_rows.box_cell)])
    row = rows.of(DEGREE)[0]
    words = (f"Nodes visited; boxes tested; triangles tested; time. {row['rays']:,} incoherent rays to their closest hit, and {row['boxes']:,} boxes\n"
             f"that find all triangles that they touch. Leaves of degree 2 to 16 are the same, of up to {row['leaf_triangles']} triangles.\n"
             f"{tree_rows.recounted(rows.of(DEGREE))}")
    return f"{rays}\n\n{boxes}\n\n{words}"


def figure(rows):
    counted = [tree for tree in TREES if not tree[0].startswith("espalier")]
    panels = [
        tree_rows.ratio_panel(rows, DEGREE, "Nodes that a ray visits, in times of degree 2", "nodes_per_ray", TREES, FIRST),
        tree_rows.ratio_panel(rows, DEGREE, "Boxes that a ray tests, in times of degree 2", "box_tests_per_ray", counted, FIRST),
        tree_rows.ratio_panel(rows, DEGREE, "Time of a ray, in times of degree 2", "ns_per_ray", TREES, FIRST),
        tree_rows.ratio_panel(rows, DEGREE, "Time of a box, in times of degree 2", "ns_per_box", TREES, FIRST),
    ]
    return charts.draw_bar_panels("The degree of the tree", panels,
                     legend=("one box at a time: the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def made(rows):
    return {"degree": text(rows),
            "degree.svg": figure(rows)}
