"""Chapter traversal.md of the guide: rules of descent for two trees, orders of children for rays, and how a ray walks."""

import charts
from report_page import table

PAIRS, RAYS = "traversal pairs", "traversal rays"
ROWS = {PAIRS: ("poses_are", "question", "rule", "poses", "pairs", "poses_that_differ", "box_tests", "triangle_tests", "ns"),
        RAYS: ("order", "rays", "hits", "box_tests", "triangle_tests", "skipped", "ns")}
# In the order of tables and figures: name of the rows, words of the table, label in the figure.
RULES = (
    ("first_until_leaf", "the first tree down to its leaf, then the second", "the first until its leaf"),
    ("alternating", "the two trees in turn", "in turn"),
    ("larger_volume", "the larger box, by volume", "the larger, by volume"),
    ("larger_area", "the larger box, by area", "the larger, by area"),
    ("all_children", "both: all children against all children", "all children of both"),
    ("espalier", "Espalier: the larger box, against all children of a node at once", "Espalier, all children at once"),
)
ORDERS = (
    ("nearest_first", "nearest first, with a stack", "nearest first"),
    ("nearest_recursed", "nearest first, with recursion", "the same, recursive"),
    ("fixed", "in the order of the tree", "order of the tree"),
    ("farthest_first", "farthest first", "farthest first"),
    ("espalier", "Espalier: nearest first, all children of a node at once", "Espalier, all children at once"),
)
RULE_OF_COMPARISON, ORDER_OF_COMPARISON = "all_children", "nearest_first"
CLASSES = {"apart": "apart", "touching": "that touch", "deep": "deep in each other"}
QUESTIONS = {"any": "is there a contact", "all": "all contacts"}


def count(value):
    return "–" if value is None else charts.number(value)


def pair_table(rows):
    meshes = rows.meshes(PAIRS)
    lines = []
    for rule, words, _ in RULES:
        cells = []
        for mesh in meshes:
            for question in QUESTIONS:
                row = rows.one(PAIRS, mesh=mesh, poses_are="touching", question=question, rule=rule)
                cells.append(f"{count(row['box_tests'])}; {charts.number(row['ns'] / 1000)} µs")
        lines.append([words, *cells])
    return table(["descend", *(f"{mesh}: {words}" for mesh in meshes for words in ("a contact", "all contacts"))], lines)


def pair_text(rows):
    poses = rows.of(PAIRS, poses_are="touching", rule=RULE_OF_COMPARISON, question="all")
    contacts = ", ".join(f"{row['mesh']} {count(row['pairs'])}" for row in poses)
    return (f"\n\nTests of boxes and time of a pose, means over the poses that touch ({poses[0]['poses']} or so of a mesh beside itself). "
            f"Contacts of a pose, on average: {contacts}.\n"
            "A test of Espalier is one box against the children of a node; the walk to all contacts does not count them.")


def ray_table(rows):
    lines = []
    for order, words, _ in ORDERS:
        cells = []
        for mesh in rows.meshes(RAYS):
            row = rows.one(RAYS, mesh=mesh, order=order)
            cells.append(f"{count(row['box_tests'])}; {count(row['triangle_tests'])}; {charts.number(row['ns'])} ns")
        lines.append([words, *cells])
    return table(["order", *rows.meshes(RAYS)], lines)


def ray_text(rows):
    row = rows.of(RAYS)[0]
    return (f"\n\nBoxes tested, triangles tested and time of a ray, means over {row['rays']:,} incoherent rays. "
            "A test of Espalier is one ray against the children of a node.")


def bar(label, name, values):
    return charts.mean_bar(label, values, 1 if name == "espalier" else 0)


def figure(rows):
    panels = []
    for poses_are, words in CLASSES.items():
        for question, asked in QUESTIONS.items():
            shown = [bar(label, rule, rows.ratios(PAIRS, "ns", {"rule": RULE_OF_COMPARISON}, poses_are=poses_are, question=question, rule=rule))
                     for rule, _, label in RULES]
            panels.append(charts.Bars(f"Two meshes {words}: {asked}", shown, logarithmic=True))
    shown = [bar(label, order, rows.ratios(RAYS, "ns", {"order": ORDER_OF_COMPARISON}, order=order)) for order, _, label in ORDERS]
    panels.append(charts.Bars("Rays: closest hit", shown))
    return charts.draw_bar_panels("Time of a query, in times of “all children of both” or “nearest first”", panels,
                     legend=("binary tree of boxes, in float: the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def made(rows):
    return {"pair_rules": pair_table(rows) + pair_text(rows), "ray_order": ray_table(rows) + ray_text(rows),
            "traversal.svg": figure(rows)}
