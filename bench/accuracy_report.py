#!/usr/bin/env python3
"""Turns rows of espalier_bench_accuracy into the tables and plots of docs/accuracy.md.

    bench/accuracy_report.py bench/results/FILE.jsonl    writes docs/accuracy.md (between its markers) and the plots
    bench/accuracy_report.py --check                     exits with 1 when those are not what the rows say

Standard library only.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
import binomial  # noqa: E402
import report_plot  # noqa: E402
from report_page import ROOT, fail, fill, links, read_objects, run, table  # noqa: E402

DOCUMENT = ROOT / "docs" / "accuracy.md"
QUERIES = {"sphere": "`overlaps(Sphere, Accuracy)`", "box": "`overlaps(Box, Accuracy)`", "ray": "`occluded(Ray, Accuracy)`",
           "distance": "`distance_bounds`"}
LATTICE_FIELDS = ("bits", "extent", "step", "triangles", "zero_area", "collapsed", "duplicate", "bytes", "max_error_steps",
                  "to_baked_steps", "to_source_steps", "rays", "hits", "missed", "extra", "elsewhere", "doubtful",
                  "t_steps", "normal_degrees", "points", "point_steps")
QUERY_FIELDS = ("accuracy_exponent", "questions", "exact_yes", "false_yes", "missed", "nodes", "triangles",
                "exact_nodes", "exact_triangles")
TIGHT = 1.0011  # bounds of a distance that are closer together than this are told as one figure


class Mesh:
    def __init__(self, name, rows):
        self.name = pathlib.PurePath(name).stem
        self.source_triangles = rows[0]["source_triangles"]
        self.lattices = [row for row in rows if "query" not in row]
        self.queries = [row for row in rows if "query" in row]
        if not self.lattices or not self.queries:
            fail(f"{name}: the rows are not those of a whole run")


def needed(row):
    return ("mesh", "source_triangles", *(QUERY_FIELDS if "query" in row else LATTICE_FIELDS))


def group(rows):
    meshes = {}
    for row in rows:
        meshes.setdefault(row["mesh"], []).append(row)
    return [Mesh(name, own) for name, own in meshes.items()]


# ---- figures ----------------------------------------------------------------------------------------------------------


def short(value):
    """Three digits, without an exponent where that is readable."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if value >= 1000:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value >= 1e-4 else f"{value:.0e}"


def three(values):
    return "–" if values is None else " / ".join(short(value) for value in values)


def distance_bounds(row):
    """Both ways together: the Hausdorff distance between its bounds. An upper one above the header says nothing new: the
    header's own then."""
    low, high = (max(row["to_baked_steps"][i], row["to_source_steps"][i]) for i in (0, 1))
    return low, min(high, row["max_error_steps"])


def bracket(row):
    low, high = distance_bounds(row)
    if high <= low * TIGHT:
        return f"{high:.2f}"
    return f"≥ {low:.2f}" if high == row["max_error_steps"] else f"{low:.2f}–{high:.2f}"


def per_million(count, trials):
    low, high = (bound * 1e6 for bound in binomial.bounds(count, trials))
    return f"{short(count / trials * 1e6)} ({short(low)}–{short(high)})"


def lost(row):
    return row["collapsed"] + row["duplicate"]


# ---- what the document says -------------------------------------------------------------------------------------------


def conditions(rows, meshes, files):
    lattices = [row for mesh in meshes for row in mesh.lattices]
    points = sorted({row["points"] for row in lattices})
    questions = sorted({row["questions"] for row in rows if "query" in row})
    doubtful = sum(row["doubtful"] for row in lattices)
    return (f"All lattices get the same rays. {' or '.join(f'{count:,}' for count in points)} hit points are compared with "
            f"the source.\nEach approximate query is called {' or '.join(f'{q:,}' for q in questions)} times per accuracy.\n"
            f"Rays whose answer on the source could depend on rounding in double precision: {doubtful}.\n"
            f"Rows: {links(DOCUMENT, files)}.")


def lattice_tables(meshes):
    parts = []
    for mesh in meshes:
        parts.append(f"**{mesh.name}**, {mesh.source_triangles:,} triangles"
                     + (f", of which {mesh.lattices[0]['zero_area']:,} have no area"
                        if mesh.lattices[0]["zero_area"] else ""))
        parts.append(table(
            ["bits", "extent in steps", "bytes / triangle", "lost", "header", "distance", "distance / extent"],
            [[str(row["bits"]), f"{row['extent'] / row['step']:,.0f}", f"{row['bytes'] / row['triangles']:.2f}",
              f"{lost(row):,}", f"{row['max_error_steps']:.2f}", bracket(row),
              f"{distance_bounds(row)[0] * row['step'] / row['extent']:.1e}"] for row in mesh.lattices]))
    return "\n\n".join(parts)


def ray_tables(meshes):
    parts = []
    for mesh in meshes:
        row = mesh.lattices[0]
        parts.append(f"**{mesh.name}**, {100 * row['hits'] / row['rays']:.0f} % of {row['rays']:,} rays hit the source")
        parts.append(table(
            ["bits", "missed / million", "extra / million", "elsewhere / million", "t, steps", "normal, degrees",
             "point, steps"],
            [[str(row["bits"]), per_million(row["missed"], row["rays"]), per_million(row["extra"], row["rays"]),
              per_million(row["elsewhere"], row["rays"]), three(row["t_steps"]), three(row["normal_degrees"]),
              three(row["point_steps"])] for row in mesh.lattices]))
    return "\n\n".join(parts)


def changed(row):
    """Whether the accuracy made any difference."""
    return row["false_yes"] or row["nodes"] != row["exact_nodes"] or row["triangles"] != row["exact_triangles"]


def query_table(meshes):
    lines = []
    for query, name in QUERIES.items():
        for mesh in meshes:
            rows = [row for row in mesh.queries if row["query"] == query]
            for row in rows:
                if not changed(row):
                    continue
                no = row["questions"] - row["exact_yes"]
                lines.append([name, mesh.name, f"1/{2 ** -row['accuracy_exponent']}",
                              "–" if query == "distance" else f"{100 * row['false_yes'] / no:.1f} %", str(row["missed"]),
                              three(row.get("error_accuracies")), three(row.get("width_accuracies")),
                              f"{row['nodes']:.3g} / {row['exact_nodes']:.3g}",
                              f"{row['triangles']:.3g} / {row['exact_triangles']:.3g}"])
    return table(["query", "mesh", "accuracy / extent", "yes for no", "broken", "error / accuracy", "width / accuracy",
                  "nodes, of exact", "triangles, of exact"], lines)


def no_difference(meshes):
    """The finest accuracy at which each query does anything else than the exact one."""
    lines = []
    for query, name in QUERIES.items():
        cells = []
        for mesh in meshes:
            rows = [row for row in mesh.queries if row["query"] == query and changed(row)]
            cells.append(f"1/{2 ** -min(row['accuracy_exponent'] for row in rows)}" if rows else "none")
        lines.append([name, *cells])
    return table(["the finest accuracy / extent that changes anything", *(mesh.name for mesh in meshes)], lines)


# ---- plots ------------------------------------------------------------------------------------------------------------


def lines_of(meshes, point):
    return [report_plot.Line(mesh.name, [point(row) for row in mesh.lattices]) for mesh in meshes]


def lattice_plot(meshes):
    def wrong(row):
        count, trials = row["missed"] + row["extra"], row["rays"]
        low, high = binomial.bounds(count, trials)
        return report_plot.Point(row["bits"], count / trials * 1e6 or None, low * 1e6, high * 1e6)

    def distance(row):
        low, high = (value * row["step"] / row["extent"] for value in distance_bounds(row))
        return report_plot.Point(row["bits"], low, low, high)

    def normal(row):
        return report_plot.Point(row["bits"], row["normal_degrees"][1])

    def size(row):
        return report_plot.Point(row["bits"], row["bytes"] / row["triangles"])

    bits = "bits of the lattice"
    panels = [report_plot.Lines("missed and extra hits per million rays, 95 % bounds", lines_of(meshes, wrong), bits,
                                 floor=0.3),
              report_plot.Lines("Hausdorff distance / largest extent", lines_of(meshes, distance), bits),
              report_plot.Lines("normal error in degrees, 99 % quantile", lines_of(meshes, normal), bits),
              report_plot.Lines("bytes a kept triangle, profile balanced", lines_of(meshes, size), bits, False)]
    return report_plot.draw_line_panels("Against the source mesh", panels)


def query_plot(meshes):
    panels = []
    for query in QUERIES:
        lines = []
        for dashed, field in ((False, "nodes"), (True, "triangles")):
            for mesh in meshes:
                rows = [row for row in mesh.queries if row["query"] == query]
                lines.append(report_plot.Line(mesh.name, [
                    report_plot.Point(row["accuracy_exponent"], row[field] / max(row[f"exact_{field}"], 1e-9))
                    for row in rows], dashed))
        panels.append(report_plot.Lines(f"{query}: work / exact (dashed: triangles)", lines,
                                         "log2 (accuracy / extent)", False))
    return report_plot.draw_line_panels("Work of the approximate queries: nodes and triangles", panels)


def outputs(files):
    """Everything that the rows decide: path and text."""
    rows = read_objects(files, "espalier_bench_accuracy", needed)
    meshes = group(rows)
    plots = ROOT / "docs" / "images" / "benchmarks"
    return {DOCUMENT: fill(DOCUMENT, {"conditions": conditions(rows, meshes, files), "lattices": lattice_tables(meshes),
                                      "rays": ray_tables(meshes), "unchanged": no_difference(meshes),
                                      "approximate": query_table(meshes)}),
            plots / "accuracy.svg": lattice_plot(meshes), plots / "accuracy_approximate.svg": query_plot(meshes)}


if __name__ == "__main__":
    run(DOCUMENT, "Tables and plots from rows of espalier_bench_accuracy.", outputs)
