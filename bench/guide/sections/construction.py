"""Chapter construction.md of the guide: what each builder's tree costs and brings."""

import math
import statistics

import charts
from report_page import fail, table

ROWS = {"builders": ("family", "builder", "reinserted", "build_ms", "reinsertion_ms", "references", "height", "sah_cost", "volumes",
                     "bytes_per_triangle", "rays", "nodes_per_ray", "leaves_per_ray", "triangles_per_ray", "ns_per_ray", "poses",
                     "box_pairs_per_pose", "ns_per_pose", "rounds")}
BASELINE = "binned SAH, 32 bins"
# In the order of the table: name of the rows, label in the figure (empty: the figure leaves it out), source.
BUILDERS = (
    ("object median (equal numbers)", "object median", "Ericson 2005"),
    ("object mean", "object mean", "Ericson 2005"),
    ("spatial median", "spatial median", "Ericson 2005"),
    ("object mean, greatest variance", "", "Klosowski et al. 1998"),
    ("object mean, least sum", "mean, least sum", "Klosowski et al. 1998"),
    ("object mean, least maximum", "", "Klosowski et al. 1998"),
    ("least sum of volumes", "sum of volumes", "Ericson 2005"),
    ("least sum of areas", "sum of areas", "Ericson 2005"),
    ("least maximum", "maximum", "Ericson 2005"),
    ("least intersection", "", "Ericson 2005"),
    ("greatest separation", "separation", "Ericson 2005"),
    ("least sum of areas, a third on each side", "hybrid", "a combination of two of the above"),
    ("binned SAH, 32 bins", "binned SAH", "Wald 2007"),
    ("binned SAH, 16 bins", "", "Wald 2007"),
    ("sweep SAH", "sweep SAH", "MacDonald, Booth 1990"),
    ("spatial splits", "spatial splits", "Stich et al. 2009"),
    ("agglomerative, from 4", "AAC", "Gu et al. 2013"),
    ("agglomerative, from 20", "", "Gu et al. 2013"),
    ("linear", "linear", "Lauterbach et al. 2009"),
    ("insertion", "insertion", "Goldsmith, Salmon 1987"),
)
NAMES = {"agglomerative, from 4": "agglomerative (AAC), δ = 4", "agglomerative, from 20": "agglomerative (AAC), δ = 20",
         "least sum of areas, a third on each side": "hybrid: least sum of areas, a third or more on each side"}
FAMILIES = ("split point", "objective", "SAH", "bottom-up", "curve", "insertion")


def value(row, field):
    """Of a row; its time to build includes the reinsertion."""
    return row["build_ms"] + row["reinsertion_ms"] if field == "build_ms" else row[field]


class Comparison:
    def __init__(self, rows):
        self.rows = rows
        self.meshes = rows.meshes("builders")
        known, found = {name for name, _, _ in BUILDERS}, set(rows.values("builders", "builder"))
        if known != found:
            fail(f"no source for the builders {sorted(found - known)}, no rows of {sorted(known - found)}")

    def row(self, mesh, builder, reinserted=False):
        return self.rows.one("builders", mesh=mesh, builder=builder, reinserted=reinserted)

    def ratio(self, builder, reinserted, field):
        """The geometric mean over the meshes of a value over that of the baseline as it is built."""
        return statistics.geometric_mean(value(self.row(mesh, builder, reinserted), field) / value(self.row(mesh, BASELINE), field)
                                         for mesh in self.meshes)


# ---- tables ------------------------------------------------------------------------------------------------------------

BUILT = ("build_ms", "sah_cost", "volumes", "bytes_per_triangle", "nodes_per_ray", "ns_per_ray", "ns_per_pose")
MOVED = ("build_ms", "sah_cost", "ns_per_ray", "ns_per_pose")


def summary_table(comparison):
    lines = []
    for name, _, source in BUILDERS:
        ratios = [comparison.ratio(name, False, field) for field in BUILT] + [comparison.ratio(name, True, field) for field in MOVED]
        shown = NAMES.get(name, name)
        lines.append([f"**{shown}**" if name == BASELINE else shown, source, *(f"{ratio:.2f}" for ratio in ratios)])
    return table(["builder", "source", "time to build", "SAH cost", "sum of volumes", "bytes", "nodes a ray", "time of a ray",
                  "time of a pair", "reinserted: time to build", "SAH cost", "time of a ray", "time of a pair"], lines)


def baseline_text(comparison):
    """What 1.00 stands for, and how it was measured."""
    lines, row = [], comparison.row(comparison.meshes[0], BASELINE)
    text_before = (f"Geometric means over {len(comparison.meshes)} meshes; {row['rays']:,} incoherent rays, {row['poses']:,} poses.\n"
                   f"The trees take turns in {row['rounds']} rounds of queries, of which the median counts.\n"
                   "1.00 is binned SAH with 32 bins as it is built:")
    for mesh in comparison.meshes:
        row = comparison.row(mesh, BASELINE)
        lines.append([f"{mesh}, {row['triangles']:,} triangles", f"{charts.number(row['build_ms'])} ms", f"{row['sah_cost']:.1f}",
                      f"{row['volumes']:.2f}", f"{row['bytes_per_triangle']:.1f} a triangle", f"{row['nodes_per_ray']:.2f}",
                      f"{row['ns_per_ray']:.0f} ns", f"{row['ns_per_pose'] / 1000:.2f} µs"])
    header = ["mesh", "time to build", "SAH cost", "sum of volumes", "bytes", "nodes a ray", "time of a ray", "time of a pair"]
    return f"{text_before}\n\n{table(header, lines)}"


def pair_of(comparison, mesh, builder, field, digits):
    cells = [f"{comparison.row(mesh, builder, reinserted)[field]:,.{digits}f}" for reinserted in (False, True)]
    return "; ".join(cells)


def full_table(comparison):
    """Every row, with the conditions of the measurement."""
    lines, row = [], comparison.row(comparison.meshes[0], BASELINE)
    machines = "; ".join(f"{processor}, {compiler.replace('gcc', 'GCC')}" for processor, compiler in comparison.rows.machines)
    conditions = (f"{machines}; {row['rays']:,} rays, {row['poses']:,} poses; the trees take turns in {row['rounds']} rounds of queries, "
                  "of which the median counts.")
    for mesh in comparison.meshes:
        for name, _, _ in BUILDERS:
            moved = comparison.row(mesh, name, True)
            lines.append([mesh, NAMES.get(name, name), f"{moved['build_ms']:.1f}", f"{moved['reinsertion_ms']:.1f}",
                          f"{moved['references'] / moved['triangles']:.2f}",
                          *(pair_of(comparison, mesh, name, field, digits) for field, digits in (
                              ("height", 0), ("sah_cost", 1), ("volumes", 2), ("bytes_per_triangle", 2), ("nodes_per_ray", 2),
                              ("leaves_per_ray", 2), ("triangles_per_ray", 1), ("ns_per_ray", 0), ("box_pairs_per_pose", 1),
                              ("ns_per_pose", 0)))])
    header = ["mesh", "builder", "build ms", "reinsertion ms", "references a triangle", "height", "SAH cost", "volumes", "bytes a triangle",
              "nodes a ray", "leaves a ray", "triangles a ray", "ns a ray", "box pairs a pose", "ns a pose"]
    return f"{conditions}\n\n{table(header, lines)}"


# ---- figure ------------------------------------------------------------------------------------------------------------

def ratio_panel(comparison, reinserted):
    points = [charts.Point(label, comparison.ratio(name, reinserted, "build_ms"), comparison.ratio(name, reinserted, "ns_per_ray"),
                            FAMILIES.index(comparison.row(comparison.meshes[0], name)["family"])) for name, label, _ in BUILDERS if label]
    title = "After reinsertion, whose time is included" if reinserted else "As built"
    return charts.Points(title, points, "time to build, relative (logarithmic)", "time of a ray, relative")


def draw_ratios(comparison):
    panels = [ratio_panel(comparison, reinserted) for reinserted in (False, True)]
    every = [point for panel in panels for point in panel.points]  # both panels have the same axes
    across, up = charts.axes_of(every)
    ratios = [point.y for point in every]  # linear, from just below the least
    up = charts.Axis(min(ratios) - 0.06, max(ratios) + 0.06, up.begin, up.end, False)
    up_ticks = [(up.at(i / 10), f"{i / 10:.4g}") for i in range(math.ceil(10 * up.low), math.floor(10 * up.high) + 1)]

    def draw_panel(panel):
        parts = charts.FRAME.draw(panel.title, panel.across, panel.up, charts.ticks_of(across), up_ticks)
        places = [(across.at(point.x), up.at(point.y)) for point in panel.points]
        taken = [(x - 5, y - 5, x + 5, y + 5) for x, y in places]
        for point, (x, y) in zip(panel.points, places):
            colour = charts.colour(point.group)
            label_x, label_y, anchor = charts.place_label(point.name, x, y, taken)
            if label_y != y:
                parts.append(charts.line(x, y, label_x, label_y, colour, 0.7))
            parts += [charts.shape(charts.kind(point.group), x, y, colour, 4.0),
                      charts.text(label_x, label_y + 4, point.name, anchor, f' fill="{colour}"')]
        return parts

    return charts.draw_point_panels("Time to build and time of a ray, over those of binned SAH with 32 bins", panels, FAMILIES, draw_panel)


# ---- what the report calls ---------------------------------------------------------------------------------------------


def made(rows):
    comparison = Comparison(rows)
    return {"construction": f"{summary_table(comparison)}\n\n{baseline_text(comparison)}",
            "construction.svg": draw_ratios(comparison),
            "docs/log/builders.md#builders": full_table(comparison)}
