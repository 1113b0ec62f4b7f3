"""Chapter exactness.md of the guide: rays that pass between triangles, and what kernels in integers and lattices cost."""

from statistics import geometric_mean

import charts
from report_page import table

LEAKS, KERNELS, LATTICES = "leaks", "kernels", "lattices"
ROWS = {LEAKS: ("system", "aim", "rays", "leaks"),
        KERNELS: ("kernel", "rays", "tests_per_ray", "prepare_ns", "test_ns", "hit_ns", "ray_ns", "filtered_per_ray", "decided_per_ray"),
        LATTICES: ("bits", "bytes_per_triangle", "error_of_extent", "ns_per_ray", "rays")}
# Name of the rows, words of the table.
SYSTEMS = (("Möller–Trumbore in float", "float (Möller and Trumbore)"), ("Möller–Trumbore in double", "double, the same test"),
           ("watertight in float", "float, watertight (Woop et al.)"), ("integers", "integers of this library"),
           ("ode opcode", "ODE"), ("embree default", "Embree, default"), ("embree robust", "Embree, robust"),
           ("bullet quantised", "Bullet"), ("espalier fast", "Espalier"))
OWN = ("integers", "espalier fast")
AIMS = (("vertex", "at vertices"), ("edge middle", "at middles of edges"), ("edge point", "at other points of edges"))
FIRST = "Möller–Trumbore in float"


def share(rows):
    """Leaks of a million rays; None where nothing was measured."""
    rays = sum(row["rays"] for row in rows)
    return sum(row["leaks"] for row in rows) / rays * 1e6 if rays else None


def measured_systems(rows):
    present = rows.values(LEAKS, "system")
    return [(name, words) for name, words in SYSTEMS if name in present]


def leak_table(rows):
    lines = []
    for name, words in measured_systems(rows):
        cells = [charts.number(share(rows.of(LEAKS, system=name, aim=aim))) for aim, _ in AIMS]
        found = rows.of(LEAKS, system=name)
        lines.append([words, *cells, f"{sum(row['leaks'] for row in found):,} of {sum(row['rays'] for row in found):,}"])
    return table(["test of a ray and a triangle", *(words for _, words in AIMS), "rays that passed"], lines)


def leak_words(rows):
    meshes = rows.meshes(LEAKS)
    return (f"\n\nRays of a million that pass between triangles, over {len(meshes)} meshes on a lattice of 16 bits ({', '.join(meshes)}). "
            "Each ray is aimed at a place where triangles meet that surround it and face the ray, so that a hit is certain.\n"
            "The first four tests have the same binary tree and boxes; the others are the libraries as they are.")


def kernel_table(rows):
    meshes = rows.meshes(KERNELS)
    lines = []
    for kernel in rows.values(KERNELS, "kernel"):
        shown = [rows.one(KERNELS, mesh=mesh, kernel=kernel) for mesh in meshes]
        lines.append([dict(SYSTEMS)[kernel], *(f"{geometric_mean(row[field] for row in shown):.1f} ns" for field in ("prepare_ns", "test_ns")),
                      *(f"{row['ray_ns']:.0f} ns" for row in shown), f"{ratio(rows, kernel):.2f}"])
    return table(["test", "once for a ray", "a test", *(f"{mesh}: a ray" for mesh in meshes), "times the first"], lines)


def ratio(rows, kernel):
    return geometric_mean(rows.ratios(KERNELS, "ray_ns", {"kernel": FIRST}, kernel=kernel))


def kernel_words(rows):
    own = rows.of(KERNELS, kernel="integers")
    filtered = ", ".join(f"{row['mesh']} {row['filtered_per_ray']:.0f} and {row['decided_per_ray']:.1f}" for row in own)
    return (f"\n\nOne test at a time in the same binary tree, closest hits of {own[0]['rays']:,} rays; the means of the first columns are over the meshes. "
            "Corners are in memory as 36 bytes a triangle.\n"
            f"Triangles of a ray that Espalier's filter takes, and that integers then decide: {filtered}.")


def lattice_table(rows):
    meshes = rows.meshes(LATTICES)
    lines = []
    for bits in rows.values(LATTICES, "bits"):
        cells = [str(bits)]
        for mesh in meshes:
            row = rows.one(LATTICES, mesh=mesh, bits=bits)
            cells.append(f"{row['bytes_per_triangle']:.2f} B; {1e6 * row['error_of_extent']:,.0f}; {row['ns_per_ray']:.0f} ns")
        lines.append(cells)
    return table(["bits", *meshes], lines)


def lattice_words(rows):
    return ("\n\nBytes a triangle of the whole blob; greatest distance between the baked and the source mesh, in millionths of the longest side; "
            f"time of a ray ({rows.of(LATTICES)[0]['rays']:,} closest hits). Profile `balanced`.")


def figure_of_leaks(rows):
    leaks = [charts.Bar(words, share(rows.of(LEAKS, system=name)), group=1 if name in OWN else 0) for name, words in measured_systems(rows)]
    times = [charts.Bar(dict(SYSTEMS)[kernel], ratio(rows, kernel), group=1 if kernel in OWN else 0) for kernel in rows.values(KERNELS, "kernel")]
    panels = [charts.Bars("Of a million rays at edges and vertices, those that pass", leaks),
              charts.Bars("Time of a ray, in times of the first", times)]
    return charts.draw_bar_panels("What floats lose, and what integers cost", panels, legend=("others", "this library's integers"))


def figure_of_lattices(rows):
    panels = []
    for field, up in (("bytes_per_triangle", "bytes a triangle"), ("ns_per_ray", "ns a ray")):
        points = []
        for group, mesh in enumerate(rows.meshes(LATTICES)):
            for row in rows.of(LATTICES, mesh=mesh):
                is_first = group == 0
                points.append(charts.Point(f"{row['bits']} bits" if is_first else "", 1e6 * row["error_of_extent"], row[field], group))
        panels.append(charts.Points(up[0].upper() + up[1:], points, "greatest error, millionths of the longest side", up, path=True))
    return charts.draw_point_panels("The trade: error against memory and time", panels, legend=rows.meshes(LATTICES))


def made(rows):
    return {"leaks": leak_table(rows) + leak_words(rows), "kernels": kernel_table(rows) + kernel_words(rows),
            "lattices": lattice_table(rows) + lattice_words(rows),
            "exactness.svg": figure_of_leaks(rows), "lattices.svg": figure_of_lattices(rows)}
