"""Chapter introduction.md of the guide: how the time of a query grows with the number of triangles."""

import charts
from report_page import table

RAYS, PAIRS = "growth of rays", "growth of pairs"
ROWS = {measures: ("method", "queries", "ns") for measures in (RAYS, PAIRS)}
METHODS = (("loop", "loop over all triangles"), ("hierarchy", "binary tree of boxes"), ("espalier", "Espalier"))


def cell(rows, measures, triangles, method):
    found = rows.of(measures, triangles=triangles, method=method)
    return charts.time(found[0]["ns"]) if found else "–"


def growth_table(rows):
    sizes = rows.values(RAYS, "triangles")
    lines = [[f"{n:,}", *(cell(rows, measures, n, method) for measures in (RAYS, PAIRS) for method, _ in METHODS)] for n in sizes]
    return table(["triangles", *(f"{query}: {words}" for query in ("a ray", "two meshes") for _, words in METHODS)], lines)


def figure(rows):
    panels = []
    for measures, title in ((RAYS, "A ray and a mesh: the closest hit"), (PAIRS, "Two meshes: all pairs that touch")):
        points = []
        for group, (method, words) in enumerate(METHODS):
            shown = rows.of(measures, method=method)
            points += [charts.Point(words if row is shown[-1] else "", row["triangles"], row["ns"] / 1000, group) for row in shown]
        panels.append(charts.Points(title, points, "triangles of a mesh", "µs", path=True))
    return charts.draw_point_panels("Time of a query by the size of the mesh", panels)


def made(rows):
    return {"growth": growth_table(rows),
            "growth.svg": figure(rows)}
