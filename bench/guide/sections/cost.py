"""Chapter quality.md of the guide, the cost function: costs that are fitted, and predicted beside measured times."""

import charts
from report_page import fail, table

COST, OTHERS = "cost", "cost by other counts"
FIELDS = ("query", "costs_ns", "mean_ns", "held_out_median_error", "held_out_worst_error", "group_count")
ROWS = {COST: (*FIELDS, "groups"), OTHERS: FIELDS}
# Name of the rows, words of the table, title of the figure, and the unit there, in nanoseconds.
QUERIES = (("raycast", "ray", "Rays", "ns", 1), ("overlaps", "contact of two meshes", "Two meshes: is there a contact", "µs", 1e3),
           ("distance", "distance of two meshes", "Two meshes: distance", "µs", 1e3),
           ("step", "step of a moving scene", "Steps of a moving scene", "µs", 1e3))
# What stands in for one of the counts, where that is tried.
OTHER_COUNTS = {"raycast": ({"Nv", "Nl"}, "leaves for triangles"), "overlaps": ({"Nv", "Nl"}, "leaves for triangles"),
                "distance": ({"Nv", "Nl"}, "leaves for triangles"), "step": ({"Nv", "Np", "Nn"}, "nodes alone for boxes")}
DRAWN = 64  # groups of a query and mesh, about


def cost(row, symbol):
    value = row["costs_ns"].get(symbol)
    return "–" if value is None else f"{value:,.1f}" if abs(value) < 100 else f"{value:,.0f}"


def percent(value):
    return f"{100 * value:.0f} %"


def other_error(rows, row):
    symbols, words = OTHER_COUNTS[row["query"]]
    found = [other for other in rows.of(OTHERS, query=row["query"], mesh=row["mesh"]) if set(other["costs_ns"]) == symbols | {"constant"}]
    if len(found) != 1:
        fail(f"{len(found)} rows fit {sorted(symbols)} to {row['query']} of {row['mesh']}")
    return f"{percent(found[0]['held_out_median_error'])} ({words})"


def cost_table(rows):
    lines = []
    for query, words, *_ in QUERIES:
        for row in rows.of(COST, query=query):
            lines.append([words, row["mesh"], *(cost(row, symbol) for symbol in ("Nv", "Np", "Nu", "constant")),
                          charts.number(row["mean_ns"]), percent(row["held_out_median_error"]), percent(row["held_out_worst_error"]),
                          other_error(rows, row)])
    return table(["query", "mesh", "Cv, ns", "Cp, ns", "Cu, ns", "Co, ns", "mean time, ns", "median error", "worst error",
                  "median error with other counts"], lines)


def drawn_groups(row):
    """Some of the groups, from the fastest to the slowest, and the one that is predicted worst."""
    groups = sorted(row["groups"], key=lambda group: group[-2:])
    worst = max(groups, key=lambda group: abs(group[-1] / group[-2] - 1))
    chosen = groups[:: max(1, len(groups) // DRAWN)]
    return [group for group in [*chosen, worst] if group[-1] > 0]


def figure(rows):
    meshes = rows.meshes(COST)
    panels = []
    for query, _, title, unit, nanoseconds in QUERIES:
        points = [charts.Point("", group[-2] / nanoseconds, group[-1] / nanoseconds, meshes.index(row["mesh"]))
                  for row in rows.of(COST, query=query) for group in drawn_groups(row)]
        panels.append(charts.Points(title, points, f"measured, {unit}", f"predicted, {unit}", diagonal=True))
    return charts.draw_point_panels("Time of groups of queries: predicted by a fit to other groups, and measured", panels, legend=meshes)


def made(rows):
    return {"cost": cost_table(rows),
            "cost.svg": figure(rows)}
