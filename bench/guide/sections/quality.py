"""Chapter quality.md of the guide, what makes a hierarchy good: measures of trees beside the time of queries, over all builders."""

from statistics import correlation, geometric_mean

import charts
from report_page import table

BUILDERS = "builders"
ROWS = {BUILDERS: ("builder", "reinserted", "node_areas", "leaf_areas", "triangle_areas", "node_volumes", "shared_areas", "leaf_depth",
                   "greatest_leaf_depth", "full_leaf_depth", "areas_by_depth", "nodes_per_ray", "ns_per_ray", "ns_per_pose")}
COMPARED = "binned SAH, 32 bins"
# Name of the rows, words of the table; in the order of the table.
SHOWN = (("binned SAH, 32 bins", "binned SAH"), ("object median (equal numbers)", "object median"), ("object mean", "object mean"),
         ("spatial median", "spatial median"), ("least sum of volumes", "least sum of volumes"), ("least maximum", "least maximum"),
         ("greatest separation", "greatest separation"), ("agglomerative, from 20", "agglomerative"), ("linear", "linear"), ("insertion", "insertion"))
# Field, words of the table.
MEASURES = (("areas", "areas"), ("node_areas", "areas of nodes"), ("triangle_areas", "areas × triangles"), ("node_volumes", "volumes"),
            ("shared_areas", "shared by siblings"), ("leaf_depth", "depth of leaves"))
BY_DEPTH = ("binned SAH, 32 bins", "object median (equal numbers)", "greatest separation", "insertion")


def value(row, field):
    return row["node_areas"] + row["leaf_areas"] if field == "areas" else row[field]


def relative(rows, builder, field):
    """To the first builder: the mean over the meshes."""
    return geometric_mean(value(rows.one(BUILDERS, mesh=mesh, builder=builder, reinserted=False), field) /
                value(rows.one(BUILDERS, mesh=mesh, builder=COMPARED, reinserted=False), field) for mesh in rows.meshes(BUILDERS))


def ranks(values):
    """Of equal values, the mean of theirs."""
    ordered = sorted(values)
    return [(2 * ordered.index(v) + ordered.count(v) - 1) / 2 for v in values]


def rank_correlation(rows, measure, time):
    """Spearman's, 1 where both have the same order: the mean over the meshes, of all trees."""
    found = [rows.of(BUILDERS, mesh=mesh) for mesh in rows.meshes(BUILDERS)]
    return sum(correlation(ranks([value(row, measure) for row in of]), ranks([row[time] for row in of])) for of in found) / len(found)


def builder_table(rows):
    lines = []
    for builder, words in SHOWN:
        cells = [f"{relative(rows, builder, field):.2f}" for field, _ in MEASURES]
        lines.append([words, *cells, f"{relative(rows, builder, 'nodes_per_ray'):.2f}", f"**{relative(rows, builder, 'ns_per_ray'):.2f}**",
                      f"**{relative(rows, builder, 'ns_per_pose'):.2f}**"])
    for time, words in (("ns_per_ray", "rank correlation with the time of a ray"), ("ns_per_pose", "rank correlation with the time of a pair")):
        lines.append([words, *(f"{rank_correlation(rows, field, time):.2f}" for field, _ in MEASURES), "", "", ""])
    header = ["builder", *(words for _, words in MEASURES), "nodes of a ray", "**ray**", "**pair**"]
    count = len(rows.of(BUILDERS, mesh=rows.meshes(BUILDERS)[0]))
    return (table(header, lines) + f"\n\nAll relative to binned SAH, means over the meshes, profile `fast`; as built, without reinsertion. "
            f"The rank correlation (Spearman 1904; 1: the same order) is over the {count} trees of a mesh in [Construction](construction.md), as built and after reinsertion.")


def depth_panel(rows, mesh):
    points = []
    for group, builder in enumerate(BY_DEPTH):
        row = rows.one(BUILDERS, mesh=mesh, builder=builder, reinserted=False)
        whole, so_far = value(rows.one(BUILDERS, mesh=mesh, builder=COMPARED, reinserted=False), "areas"), 0.0
        shown = []
        for depth, areas in enumerate(row["areas_by_depth"], 1):
            so_far += areas
            shown.append(charts.Point("", depth, so_far / whole, group))
        shown[-1].name = dict(SHOWN)[builder]
        points += shown
    return charts.Points(f"{mesh}: areas down to each depth, over all of binned SAH", points, "depth", "areas so far", logarithmic=False, path=True)


def time_panel(rows, field, title):
    points = []
    for group, mesh in enumerate(rows.meshes(BUILDERS)):
        base = rows.one(BUILDERS, mesh=mesh, builder=COMPARED, reinserted=False)
        points += [charts.Point("", value(row, "areas") / value(base, "areas"), row[field] / base[field], group) for row in rows.of(BUILDERS, mesh=mesh)]
    return charts.Points(title, points, "sum of areas, over binned SAH", "time, over binned SAH")


def figure(rows):
    panels = [time_panel(rows, "ns_per_ray", "Time of a ray, trees of all builders"), time_panel(rows, "ns_per_pose", "Time of a pair, trees of all builders"),
              *(depth_panel(rows, mesh) for mesh in (rows.meshes(BUILDERS)[0], rows.meshes(BUILDERS)[-1]))]
    return charts.draw_point_panels("Areas of boxes and time (upper panels: a mark for each mesh)", panels, legend=rows.meshes(BUILDERS))


def made(rows):
    return {"quality": builder_table(rows),
            "quality.svg": figure(rows)}
