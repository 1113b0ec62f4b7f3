"""Section 6 of the guide, memory: Terdiman's ladder, in bytes, work and time."""

import charts
import tree_rows
from report_page import table

LADDER = "ladder"
ROWS = {LADDER: tree_rows.FIELDS}
# In the order of table and figure: name of the rows, words of the table, label in the figure.
STEPS = (
    ("complete", "1. complete, one triangle a leaf", "1. complete"),
    ("several a leaf", "2. up to {leaf} triangles a leaf", "2. several a leaf"),
    ("no leaf nodes", "3. no leaf nodes (of step 1)", "3. no leaf nodes"),
    ("quantised", "4. step 3, quantised", "4. quantised"),
    ("quantised, several a leaf", "5. step 4, up to {leaf} triangles a leaf", "5. quantised, several"),
    ("espalier fast", "6. Espalier, profile `fast`", "6. Espalier, fast"),
    ("espalier small", "7. Espalier, profile `small`", "7. Espalier, small"),
)
FIRST = STEPS[0][0]


def ladder_table(rows):
    leaf = rows.of(LADDER)[0]["leaf_triangles"]
    meshes = rows.meshes(LADDER)
    lines = []
    for name, words, _ in STEPS:
        shown = rows.of(LADDER, tree=name)
        lines.append([words.format(leaf=leaf), str(shown[0]["node_bytes"]), tree_rows.range_of(shown, "bytes_per_triangle"),
                      tree_rows.range_of(shown, "all_bytes_per_triangle"),
                      *(tree_rows.ray_cell(rows.one(LADDER, mesh=mesh, tree=name)) for mesh in meshes)])
    return table(["step", "bytes of a node", "bytes a triangle: nodes", "with triangles", *(f"{mesh}: a ray" for mesh in meshes)], lines)


def box_table(rows):
    leaf = rows.of(LADDER)[0]["leaf_triangles"]
    lines = [[words.format(leaf=leaf), *(tree_rows.box_cell(rows.one(LADDER, mesh=mesh, tree=name)) for mesh in rows.meshes(LADDER))]
             for name, words, _ in STEPS]
    return table(["step", *(f"{mesh}: a box" for mesh in rows.meshes(LADDER))], lines)


def words_of(rows):
    row = rows.of(LADDER)[0]
    touching = ", ".join(f"{mesh} {charts.number(rows.one(LADDER, mesh=mesh, tree=FIRST)['touching_per_box'])}" for mesh in rows.meshes(LADDER))
    return (f"Nodes visited; boxes tested; triangles tested; time. Means over {row['rays']:,} incoherent rays to their closest hit,\n"
            f"and over {row['boxes']:,} boxes that find all triangles that they touch (on average: {touching}).\n"
            f"{tree_rows.recounted(rows.of(LADDER))}\n"
            "*With triangles* adds to steps 1 to 5 the mesh, three indices a triangle and three floats a vertex; to Espalier all that a blob has.")


def figure(rows):
    panels = [
        tree_rows.value_panel(rows, LADDER, "Bytes a triangle, nodes", "bytes_per_triangle", STEPS),
        tree_rows.value_panel(rows, LADDER, "Bytes a triangle, nodes and triangles", "all_bytes_per_triangle", STEPS),
        tree_rows.ratio_panel(rows, LADDER, "Time of a ray, in times of step 1", "ns_per_ray", STEPS, FIRST),
        tree_rows.ratio_panel(rows, LADDER, "Time of a box, in times of step 1", "ns_per_box", STEPS, FIRST),
    ]
    return charts.draw_bar_panels("Terdiman's ladder: bytes and time", panels,
                     legend=("textbook trees: the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def made(rows):
    return {"ladder": f"{ladder_table(rows)}\n\n{box_table(rows)}\n\n{words_of(rows)}",
            "ladder.svg": figure(rows)}
