"""Chapter volumes.md of the guide, oriented boxes: how well and how fast each fit encloses triangles, and trees of OBBs beside trees of AABBs."""

from statistics import geometric_mean

import charts
from report_page import table

FITS, TREES, BUILDS = "obb fits", "obb trees", "obb builds"
ROWS = {FITS: ("size", "fit", "sets", "set_triangles", "volume", "worst_over_least", "set_us", "triangle_ns"),
        TREES: ("poses_are", "question", "topology", "boxes", "poses", "box_tests", "triangle_tests", "ns"),
        BUILDS: ("topology", "boxes", "build_ms")}
# Name of the rows, words of the table, label in the figure.
FIT_WORDS = (("aligned", "AABB", "AABB"), ("vertices", "covariance of the vertices", "vertices"),
             ("hull", "covariance of the hull's surface", "hull's surface"), ("flush", "least with a side on a face of the hull", "on a face"),
             ("search", "search of the least volume", "search"))
SIZES = (("10", "5 to 10"), ("100", "50 to 100"), ("1000", "500 to 1,000"), ("all", "all"))
# Topology, boxes, words of the table, label in the figure.
KINDS = (("obb", "obb", "for OBBs: OBBs, 15 axes", "OBB tree: OBBs"),
         ("obb", "aabb turned", "for OBBs: AABBs, turned, 15 axes", "OBB tree: AABBs, 15 axes"),
         ("obb", "aabb reboxed", "for OBBs: AABBs around turned AABBs, 3 axes", "OBB tree: AABBs, 3 axes"),
         ("sah", "obb", "for AABBs: OBBs, 15 axes", "AABB tree: OBBs"),
         ("sah", "aabb turned", "for AABBs: AABBs, turned, 15 axes", "AABB tree: AABBs, 15 axes"),
         ("sah", "aabb reboxed", "for AABBs: AABBs around turned AABBs, 3 axes", "AABB tree: AABBs, 3 axes"))
CLASSES = (("apart", "any", "apart: any contact"), ("touching", "any", "touching: any contact"), ("touching", "all", "touching: all contacts"),
           ("parallel", "all", "parallel: all contacts"))
COMPARED = {"topology": "sah", "boxes": "aabb turned"}


def of_fit(rows, fit, size, field):
    return [rows.one(FITS, mesh=mesh, fit=fit, size=size)[field] for mesh in rows.meshes(FITS)]


def fit_table(rows):
    lines = []
    for fit, words, _ in FIT_WORDS:
        cells = [words]
        for size, _ in SIZES:
            cells.append(f"{geometric_mean(of_fit(rows, fit, size, 'volume')):.2f}; {charts.time(1000 * geometric_mean(of_fit(rows, fit, size, 'set_us')))}")
        worst = max(max(of_fit(rows, fit, size, "worst_over_least")) for size, _ in SIZES[1:])
        cells.append(charts.number(worst))
        lines.append(cells)
    return table(["axes", *(f"{words} triangles" for _, words in SIZES), "worst"], lines)


def fit_words(rows):
    meshes = rows.meshes(FITS)
    return (f"\n\nVolume of boxes around the triangles of a tree's nodes, over that of their AABBs; and time of a fit. Means over {len(meshes)} meshes "
            f"({', '.join(meshes)}). *Worst*: the greatest volume over the least of all fits, of sets of 50 triangles or more that are not flat.")


def ratios(rows, measured, field, kind):
    poses, question, _ = measured
    return rows.ratios(TREES, field, COMPARED, poses_are=poses, question=question, topology=kind[0], boxes=kind[1])


def build_ratio(rows, kind):
    boxes = "obb" if kind[1] == "obb" else "aabb"
    found = [(rows.of(BUILDS, mesh=mesh, topology=kind[0], boxes=boxes), rows.one(BUILDS, mesh=mesh, topology="sah", boxes="aabb"))
             for mesh in rows.meshes(BUILDS)]
    if not all(shown for shown, _ in found):
        return "–"
    return f"{geometric_mean(shown[0]['build_ms'] / base['build_ms'] for shown, base in found):.1f}"


def tree_table(rows):
    lines = []
    for kind in KINDS:
        cells = [kind[2], build_ratio(rows, kind)]
        for measured in CLASSES:
            cells.append(f"{geometric_mean(ratios(rows, measured, 'box_tests', kind)):.2f}; **{geometric_mean(ratios(rows, measured, 'ns', kind)):.2f}**")
        lines.append(cells)
    return table(["tree built; boxes", "build", *(words for _, _, words in CLASSES)], lines)


def tree_words(rows):
    row = rows.of(TREES, poses_are="touching")[0]
    return ("\n\nTests of boxes; **time** of a pose, both relative to AABBs in the tree for AABBs (its fifth row). Means over the meshes, one triangle a leaf. "
            f"About {row['poses']} poses that touch and as many apart, and a few in which the second surface is the first, "
            "moved outward by half a percent of its radius.")


def fit_figure(rows):
    panels = []
    for size, words in SIZES[:3]:
        shown = [charts.mean_bar(label, of_fit(rows, fit, size, "volume")) for fit, _, label in FIT_WORDS]
        panels.append(charts.Bars(f"Volume over that of the AABB, {words} triangles", shown))
    shown = [charts.Bar(label, geometric_mean(of_fit(rows, fit, "100", "set_us")), group=1) for fit, _, label in FIT_WORDS]
    panels.append(charts.Bars("Time of a fit, 50 to 100 triangles", shown, "µs", logarithmic=True))
    return charts.draw_bar_panels("Oriented boxes: fits", panels, legend=("volume: the mean over the meshes, and a line from the least to the greatest", "time"))


def tree_figure(rows):
    panels = []
    for measured in CLASSES:
        shown = [charts.mean_bar(kind[3], ratios(rows, measured, "ns", kind), 1 if kind[1] == "obb" else 0) for kind in KINDS]
        panels.append(charts.Bars(f"Two meshes {measured[2]}", shown, logarithmic=True))
    return charts.draw_bar_panels("Time of a pose, in times of AABBs in the AABB tree", panels, legend=("AABBs: mean, least and greatest of the meshes", "OBBs"))


def made(rows):
    return {"obb_fits": fit_table(rows) + fit_words(rows), "obb_trees": tree_table(rows) + tree_words(rows),
            "obb_fits.svg": fit_figure(rows), "obb_trees.svg": tree_figure(rows)}
