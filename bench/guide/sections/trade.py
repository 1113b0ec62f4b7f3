"""Tables of docs/trade.md: what profiles and lattices give and take, and the fitted costs of a ray."""

from statistics import geometric_mean

import charts
import cost
import exactness
import load
import memory
from report_page import table

PAGE = "docs/trade.md"
ROWS = {**memory.ROWS, **cost.ROWS, **load.ROWS, exactness.LATTICES: exactness.ROWS[exactness.LATTICES]}
# Where each profile is timed. The tiny one is only weighed, in the rows of loading.
TIMED = {"fast": memory.DEGREE, "balanced": memory.DEGREE, "small": memory.LADDER}
COUNTS = (("Np", "triangles"), ("Ng", "groups of 8"), ("Nl", "leaves"))


def profile_table(rows):
    lines = []
    for profile in (*TIMED, "tiny"):
        cells = []
        for mesh in rows.meshes(memory.LADDER):
            blob = rows.of(load.LOAD, mesh=mesh, ships=f"blob, {profile}")[0]
            timed = rows.one(TIMED[profile], mesh=mesh, tree=f"espalier {profile}") if profile in TIMED else {}
            times = [charts.time(timed[field]) if timed else "–" for field in ("ns_per_ray", "ns_per_box")]
            cells.append("; ".join([f"{blob['file_bytes'] / blob['triangles']:.1f} B", *times]))
        lines.append([f"`{profile}`", *cells])
    return table(["profile", *rows.meshes(memory.LADDER)], lines)


def lattice_table(rows):
    """All meshes together, relative to 16 bits."""
    lines = []
    for bits in rows.values(exactness.LATTICES, "bits"):
        values = [rows.ratios(exactness.LATTICES, field, {"bits": 16}, bits=bits) for field in ("error_of_extent", "bytes_per_triangle", "ns_per_ray")]
        means = [geometric_mean(ratios) for ratios in values]
        spans = [f"{min(ratios):.2f} to {max(ratios):.2f}" for ratios in values[1:]]
        lines.append([str(bits), charts.number(means[0]), f"{means[1]:.2f} ({spans[0]})", f"{means[2]:.2f} ({spans[1]})"])
    return table(["bits", "greatest error", "bytes", "time of a ray"], lines)


def ray_cost_table(rows):
    """The fits to visited nodes and to one other count: triangles, groups of 8 of them, or leaves."""
    lines = []
    for mesh in rows.meshes(cost.COST):
        fits = rows.of(cost.COST, query="raycast", mesh=mesh) + rows.of(cost.OTHERS, query="raycast", mesh=mesh)
        if not fits:
            continue
        cells = [mesh, charts.number(fits[0]["mean_ns"])]
        for count, _ in COUNTS:
            fit = next(row for row in fits if set(row["costs_ns"]) == {"Nv", count, "constant"})
            node, other = fit["costs_ns"]["Nv"], fit["costs_ns"][count]
            cells.append(f"{node:.1f}, {other:.1f} ({other / node:.2f}); {fit['residual_ns']:.0f}")
        lines.append(cells)
    return table(["mesh", "mean time", *(f"nodes and {words}" for _, words in COUNTS)], lines)


def made(rows):
    return {f"{PAGE}#profiles": profile_table(rows), f"{PAGE}#lattices": lattice_table(rows), f"{PAGE}#ray_costs": ray_cost_table(rows)}
