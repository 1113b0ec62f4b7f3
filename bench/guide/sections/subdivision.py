"""Chapter introduction.md of the guide, subdivision of space: a k-d tree and a grid beside a hierarchy of boxes."""

import charts
from report_page import table

SUBDIVISION = "subdivision"
ROWS = {SUBDIVISION: ("structure", "build_ms", "cells", "references_per_triangle", "bytes_per_triangle", "has_triangles", "rays", "cells_per_ray",
                      "triangles_per_ray", "ray_ns", "boxes", "box_ns", "edge_rays", "lost", "lost_with_float_test")}
# Name of the rows, words of the table, label in the figure.
STRUCTURES = (("hierarchy", "hierarchy: binary tree", "hierarchy"), ("k-d tree", "k-d tree", "k-d tree"), ("grid", "uniform grid", "grid"),
              ("espalier", "hierarchy: Espalier", "Espalier"))
COMPARED = "hierarchy"


def cell(row):
    if row["build_ms"] is None:
        built = f"{row['bytes_per_triangle']:.1f} B with triangles"
    else:
        built = f"{charts.number(row['build_ms'])} ms; {row['references_per_triangle']:.1f}; {row['bytes_per_triangle']:.1f} B"
    return f"{built}; {charts.time(row['ray_ns'])}; {charts.time(row['box_ns'])}"


def time_table(rows):
    meshes = rows.meshes(SUBDIVISION)
    lines = [[words, *(cell(rows.one(SUBDIVISION, mesh=mesh, structure=name)) for mesh in meshes)] for name, words, _ in STRUCTURES]
    return table(["", *meshes], lines)


def lost_table(rows):
    lines = []
    for name, words, _ in STRUCTURES:
        found = rows.of(SUBDIVISION, structure=name)
        in_float = [row["lost_with_float_test"] for row in found]
        lines.append([words, str(sum(row["lost"] for row in found)), "–" if None in in_float else f"{sum(in_float):,}"])
    return table(["", "lost, test of triangles in double (Espalier: integers)", "lost, the same test in float"], lines)


def words_of(rows):
    first = rows.of(SUBDIVISION)[0]
    aimed = sum(row["edge_rays"] for row in rows.of(SUBDIVISION, structure=COMPARED))
    return (f"\n\nTime to build; references a triangle; bytes a triangle, without the triangles; a ray ({first['rays']:,} closest hits); "
            f"a box of a sixty-fourth of the mesh's side ({first['boxes']:,}, all triangles that touch it). "
            "Espalier is in its fastest profile, `fast`. All others have the same tests of triangles and the same answers.\n\n"
            f"Of {aimed:,} rays aimed at vertices and edges of the four meshes:\n\n")


def ratio_panel(rows, title, field):
    shown = []
    for name, _, label in STRUCTURES:
        if rows.of(SUBDIVISION, structure=name)[0][field] is not None:
            values = rows.ratios(SUBDIVISION, field, {"structure": COMPARED}, structure=name)
            shown.append(charts.mean_bar(label, values, 1 if name == "espalier" else 0))
    return charts.Bars(title, shown)


def figure(rows):
    panels = [ratio_panel(rows, "Time of a ray", "ray_ns"), ratio_panel(rows, "Time of a box", "box_ns"),
              ratio_panel(rows, "Time to build", "build_ms"), ratio_panel(rows, "Bytes (Espalier: with triangles)", "bytes_per_triangle")]
    return charts.draw_bar_panels("Subdivisions of space, in times of the binary tree of boxes", panels,
                     legend=("the mean over the meshes, and a line from the least to the greatest", "Espalier"))


def made(rows):
    return {"subdivision": time_table(rows) + words_of(rows) + lost_table(rows),
            "subdivision.svg": figure(rows)}
