"""Chapter volumes.md of the guide: how tightly they fit, what a test costs, and what that makes of queries."""

from statistics import geometric_mean

import charts
from report_page import table

VOLUMES = "volumes"
ROWS = {VOLUMES: ("kind", "volume_bytes", "node_bytes", "rays", "hits", "poses", "touching_poses", "contacts", "ray_volume_tests",
                  "ray_triangle_tests", "ray_ns", "pose_ns")}
# In the order of tables and figures: name of the rows, words of the tables, label in the figure.
KINDS = (("sphere", "sphere", "sphere"), ("aabb", "AABB", "AABB"), ("obb", "OBB", "OBB"), ("dop_14", "14-DOP", "14-DOP"),
         ("dop_18", "18-DOP", "18-DOP"), ("dop_26", "26-DOP", "26-DOP"))
OWN = "espalier"
COMPARED = "aabb"
# What a query is: its prefix in the rows, the field of a test's time, and the title of a panel.
QUERIES = (("ray", "ray_test_ns", "A ray and one mesh"), ("pose", "pair_test_ns", "Two meshes: all contacts"))


def mean_of(rows, kind, field):
    return geometric_mean(row[field] for row in rows.of(VOLUMES, kind=kind))


def ratio(rows, kind, field):
    """Relative to boxes: the mean over the meshes."""
    return geometric_mean(rows.ratios(VOLUMES, field, {"kind": COMPARED}, kind=kind))


def times(value):
    return f"{value:.2f}"


def comparison(rows):
    lines = []
    for kind, words, _ in KINDS:
        cells = [words, str(rows.of(VOLUMES, kind=kind)[0]["volume_bytes"]), times(mean_of(rows, kind, "area")),
                 times(mean_of(rows, kind, "volume"))]
        for prefix, test, _ in QUERIES:
            cells += [f"{mean_of(rows, kind, test):.1f} ns",
                      *(times(ratio(rows, kind, f"{prefix}_{field}")) for field in ("volume_tests", "triangle_tests", "ns"))]
        lines.append(cells)
    own = rows.of(VOLUMES, kind=OWN)[0]
    lines.append([f"Espalier: AABBs, {own['node_bytes'] // own['volume_bytes']} at once", str(own["volume_bytes"]), "–", "–", "–", "–", "–",
                  times(ratio(rows, OWN, "ray_ns")), "–", "–", "–", times(ratio(rows, OWN, "pose_ns"))])
    header = ["kind", "bytes", "area", "volume"]
    for words in ("ray", "pair"):
        header += [f"{words}: one test", f"{words}: tests", f"{words}: triangles", f"{words}: **time**"]
    return table(header, lines)


def conditions(rows):
    first = rows.of(VOLUMES)[0]
    return ("\n\nThe same binary tree, built for AABBs, with each kind in its nodes, up to 8 triangles in a leaf, in float, one volume tested at a time. "
            "*Bytes* of a volume; *area* and *volume*: sums over all nodes. A *test* is timed in the cache, on those that the AABB tree makes. "
            f"The other numbers are relative to AABBs, means over {len(rows.meshes(VOLUMES))} meshes: "
            "*tests* of volumes, tests of *triangles*, and **time** of a query. "
            f"*Ray*: the closest hit of {first['rays']:,} rays. *Pair*: all contacts of a mesh and its copy in {first['poses']} poses, "
            "of which about half touch. Each mesh on its own: [volumes.md](../log/volumes.md).")


def full_table(rows):
    """Each mesh on its own."""
    lines = []
    for mesh in rows.meshes(VOLUMES):
        for kind, words, _ in KINDS:
            row = rows.one(VOLUMES, mesh=mesh, kind=kind)
            lines.append([mesh, words, str(row["volume_bytes"]), times(row["area"]), times(row["volume"]),
                          *(query_cell(row, prefix) for prefix in ("ray", "ball", "pose"))])
        own = rows.one(VOLUMES, mesh=mesh, kind=OWN)
        lines.append([mesh, "Espalier", str(own["volume_bytes"]), "–", "–", query_cell(own, "ray"), "–",
                      f"{charts.number(own['pose_ns'] / 1000)} µs"])
    return table(["mesh", "kind", "bytes", "area", "volume", "ray", "ball", "two meshes"], lines)


def query_cell(row, prefix):
    tests = "; ".join(charts.number(row[f"{prefix}_{field}"]) for field in ("volume_tests", "triangle_tests"))
    ns = row[f"{prefix}_ns"]
    return f"{tests}; " + (f"{charts.number(ns / 1000)} µs" if prefix == "pose" else f"{ns:,.0f} ns")


def panel(rows, prefix, test, title):
    points = [charts.Point(label, ratio(rows, kind, f"{prefix}_volume_tests"), ratio(rows, kind, test), 1 if kind == COMPARED else 0)
              for kind, _, label in KINDS]
    return charts.Points(title, points, "tests of volumes in a query, relative to AABBs", "time of a test, relative to AABBs")


def draw_panel(shown):
    """The points, and the line on which fewer tests just pay for their price."""
    across, up = charts.axes_of(shown.points)
    low, high = max(across.low, 1 / up.high), min(across.high, 1 / up.low)
    return [*charts.draw_points(shown),
            charts.line(across.at(low), up.at(1 / low), across.at(high), up.at(1 / high), charts.GREY, dash="4 3")]


def figure(rows):
    panels = [panel(rows, *query) for query in QUERIES]
    header = [charts.title("Fewer tests against dearer ones"),
              charts.text(12, 44, "On the dashed line, all tests of volumes together take as long as with AABBs: below it they take less. "
                           "Means over the meshes, logarithmic.")]
    return charts.Layout(charts.FRAME.width, charts.FRAME.height, header=58).draw(header, panels, draw_panel)


def made(rows):
    return {"volumes": comparison(rows) + conditions(rows),
            "volumes.svg": figure(rows),
            "docs/log/volumes.md#volumes": full_table(rows)}
