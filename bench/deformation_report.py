#!/usr/bin/env python3
"""Turns rows of espalier_bench_study deformation into the tables of docs/moving.md.

    bench/deformation_report.py bench/results/FILE.jsonl    writes docs/moving.md (between its markers)
    bench/deformation_report.py --check                     exits with 1 when the page is not what its rows say

Standard library only.
"""

import statistics
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
from report_page import ROOT, Rows, fail, fill, links, read_objects, run, table  # noqa: E402

DOCUMENT = ROOT / "docs" / "moving.md"
COMMON = ("measures", "mesh", "triangles", "positions", "bits", "rounds", "processor", "instruction_set", "compiler")
FIELDS = {
    "refit": ("system", "profile", "version", "poses", "ns_per_triangle", "times_espalier", "times_espalier_spread", "lost_poses", "bytes"),
    "nodes": ("most_leaf_triangles", "nodes", "leaf_vertices", "ns"),
    "bake": ("effort", "ns_per_triangle"),
    "rays": ("motion", "tree", "rays", "quality", "nodes_per_ray", "ns_per_ray", "times_bake_nodes", "rays_that_differ"),
    "boxes": ("motion", "boxes", "times_built", "times_built_aabb"),
}
SYSTEMS = {"espalier": "Espalier", "embree": "Embree", "bullet": "Bullet", "fcl": "FCL", "textbook": "textbook"}
BOUNDED = ("bend", "twist")  # motions with a goal for the visits of rays
# The number that each goal is compared with, and whether it is a least one.
LEAST = {"embree": 1.0, "bullet": 4.0, "fcl": 10.0}
MOST_RAM, MOST_VISITS = 9.5, 1.3


def needed(row):
    return (*COMMON, *FIELDS.get(row.get("measures"), ()))


class MotionRows(Rows):
    def __init__(self, rows):
        super().__init__(rows)
        machines = {(r["processor"], r["instruction_set"], r["compiler"], r["bits"], r["rounds"]) for r in rows}
        if len(machines) != 1:
            fail("the rows are of several machines, or of runs with other options")
        self.machine = machines.pop()
        self.names = list(dict.fromkeys(row["mesh"] for row in self.all))
        if len({(row["mesh"], row["triangles"]) for row in self.all}) != len(self.names):
            fail("two meshes have one name")
        for measures in FIELDS:
            for mesh in self.names:
                if not self.of(measures, mesh=mesh):
                    fail(f"{mesh}: no row that measures {measures}; the rows are not those of a whole run")

    def systems(self):
        """Names and profiles, in the order of the rows."""
        return list(dict.fromkeys((r["system"], r["profile"]) for r in self.of("refit")))

    def refit(self, mesh, system, profile):
        return self.one("refit", mesh=mesh, system=system, profile=profile)

    def espalier(self, mesh):
        return self.one("refit", mesh=mesh, system="espalier")

    def fastest(self, mesh, system):
        """The row with the fastest refit of a system, or None."""
        return min(self.of("refit", mesh=mesh, system=system), key=lambda row: row["ns_per_triangle"], default=None)

    def rays(self, mesh, motion):
        return {row["tree"]: row for row in self.of("rays", mesh=mesh, motion=motion)}

    def motions(self):
        """Those that deform."""
        return [motion for motion in self.values("rays", "motion") if motion != "turn"]


def name_of(row_or_pair):
    system, profile = row_or_pair if isinstance(row_or_pair, tuple) else (row_or_pair["system"], row_or_pair["profile"])
    return f"{SYSTEMS[system]} {profile}".replace("aabb", "AABB").replace("obbrss", "OBBRSS").replace("obb", "OBB")


def times(value):
    if value is None:
        return "–"
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def per_triangle(row, value):
    return f"{value / row['triangles']:.2f}"


# ---- tables -----------------------------------------------------------------------------------------------------------


def conditions(rows, files):
    processor, instruction_set, compiler, bits, rounds = rows.machine
    versions = {(row["system"], row["version"]) for row in rows.of("refit")}
    peers = ", ".join(f"{SYSTEMS[system]} {version}" for system, version in sorted(versions) if system in LEAST)
    poses = rows.of("refit", mesh=rows.names[0])[0]["poses"]
    rays = rows.of("rays", mesh=rows.names[0])[0]["rays"]
    differing = sum(row["rays_that_differ"] for row in rows.of("rays") if row["tree"] != "moved rays")
    meshes = ", ".join(f"{mesh} ({rows.of('refit', mesh=mesh)[0]['triangles']:,} triangles)" for mesh in rows.names)
    return (f"{processor}, one thread, {instruction_set}; {compiler.replace('gcc', 'GCC')}; {peers}.\n"
            f"Meshes: {meshes}; a lattice of {bits} bits over the range of motion.\n"
            f"Refits are to {poses} poses of {len(rows.motions())} motions, in which the systems are timed in turn; "
            f"figures are the median of {rounds} rounds.\n"
            f"{rays:,} incoherent rays into each pose; {differing} of them had another hit in another tree of the same pose.\n"
            f"Rows: {links(DOCUMENT, files)}.")


def goals_table(rows):
    lines = []
    for mesh in rows.names:
        for system, least in LEAST.items():
            row = rows.fastest(mesh, system)
            if row is not None:
                lines.append([f"{mesh}: time of {name_of(row)} over Espalier's", times(row["times_espalier"]),
                              f"at least {least:g}", "yes" if row["times_espalier"] >= least else "no"])
        espalier = rows.espalier(mesh)
        ram = espalier["moving_bytes"] / espalier["triangles"]
        lines.append([f"{mesh}: bytes of RAM a triangle", f"{ram:.2f}", f"at most {MOST_RAM}", "yes" if ram <= MOST_RAM else "no"])
        for motion in BOUNDED:
            visits = rows.rays(mesh, motion)["pose"]["times_bake_nodes"]
            lines.append([f"{mesh}: visits of rays after {motion} of 90°, pose baked in, over those after a bake", times(visits),
                          f"at most {MOST_VISITS}", "yes" if visits is not None and visits <= MOST_VISITS else "no"])
    return table(["", "is", "should be", ""], lines)


def refits_table(rows):
    lines = []
    for system, profile in rows.systems():
        cells = []
        for mesh in rows.names:
            row = rows.refit(mesh, system, profile)
            cells.append(f"{times(row['ns_per_triangle'])} ns")
            low, high = row["times_espalier_spread"]
            cells.append("1" if system == "espalier" else f"{times(row['times_espalier'])} ({times(low)}–{times(high)})")
        lines.append([name_of((system, profile)), *cells])
    header = [cell for mesh in rows.names for cell in (mesh, "× Espalier")]
    return table(["refit, a triangle", *header], lines)


def lost_text(rows):
    """A line about the systems that lost poses, or nothing."""
    lost = {}
    for row in rows.of("refit"):
        if row["lost_poses"]:
            lost.setdefault(name_of(row), []).append(row["mesh"])
    if not lost:
        return ""
    systems = "; ".join(f"{name} ({', '.join(meshes)})" for name, meshes in lost.items())
    return f"\n\nAfter the collapse, which makes triangles flat, the outermost box no longer held the mesh: {systems}."


def memory_table(rows):
    lines = []
    for what, field in (("Espalier, moving part (RAM)", "moving_bytes"), ("Espalier, vertex sources (flash or RAM)", "source_bytes"),
                        ("Espalier, corners and the rest (flash or RAM)", "still_bytes")):
        lines.append([what, *(per_triangle(rows.espalier(mesh), rows.espalier(mesh)[field]) for mesh in rows.names)])
    for system, profile in rows.systems():
        if system != "espalier":
            lines.append([f"{name_of((system, profile))}, vertices included",
                          *(per_triangle(row, row["bytes"]) for row in (rows.refit(mesh, system, profile) for mesh in rows.names))])
    return table(["bytes a triangle", *rows.names], lines)


def nodes_table(rows):
    lines = []
    for mesh in rows.names:
        for row in rows.of("nodes", mesh=mesh):
            lines.append([mesh, str(row["most_leaf_triangles"]), f"{row['nodes']:,}", f"{row['leaf_vertices']:,}",
                          f"{row['ns'] / row['triangles']:.2f}", f"{row['ns'] / row['nodes']:.0f}"])
    return table(["mesh", "triangles in a leaf, at most", "Nu: nodes", "leaf vertices", "ns a triangle", "Cu: ns a node, its leaves included"],
                 lines)


def model_text(rows):
    """The costs with the least sum of squared relative differences (normal equations, by Cramer's rule)."""
    found = [(row["nodes"] / row["ns"], row["leaf_vertices"] / row["ns"]) for row in rows.of("nodes")]
    nn, nv, vv = (sum(row[i] * row[j] for row in found) for i, j in ((0, 0), (0, 1), (1, 1)))
    n, v = (sum(row[i] for row in found) for i in (0, 1))
    determinant = nn * vv - nv * nv
    if determinant <= 1e-9 * nn * vv:
        fail("the rows that measure nodes do not determine the costs")
    node, vertex = (n * vv - v * nv) / determinant, (v * nn - n * nv) / determinant
    error = statistics.median(abs(node * nodes + vertex * vertices - 1) for nodes, vertices in found)
    return (f"Fitted to these rows: {node:.0f} ns a node with the boxes of its children, and {vertex:.2f} ns a leaf vertex with the "
            f"test of its position (median relative error {100 * error:.0f} %).")


def ray_cell(row, bake):
    return f"{times(row['times_bake_nodes'])}; {times(row['ns_per_ray'] / bake['ns_per_ray'])}"


def rays_table(rows):
    lines = []
    for mesh in rows.names:
        for motion in rows.motions():
            trees = rows.rays(mesh, motion)
            bake = trees["bake"]
            lines.append([mesh, motion, f"{bake['nodes_per_ray']:.1f}; {bake['ns_per_ray']:.0f} ns", ray_cell(trees["rest"], bake),
                          ray_cell(trees["pose"], bake), ray_cell(trees["all poses"], bake), times(trees["rest"]["quality"]),
                          times(trees["pose"]["quality"])])
    return table(["mesh", "motion", "bake: nodes; time of a ray", "refit, × nodes; × time", "with that pose baked in",
                  "with all poses baked in", "`quality`", "`quality` with that pose"], lines)


def rigid_table(rows):
    lines = []
    for mesh in rows.names:
        trees = rows.rays(mesh, "turn")
        bake_ns = rows.one("bake", mesh=mesh, effort="normal")["ns_per_triangle"]
        work = {"moved rays": "none", "rest": f"{times(rows.espalier(mesh)['ns_per_triangle'])} ns", "bake": f"{times(bake_ns)} ns"}
        ways = {"moved rays": "move the rays", "rest": "refit", "bake": "bake"}
        for tree, way in ways.items():
            lines.append([mesh, way, work[tree], f"{trees[tree]['nodes_per_ray']:.1f}", f"{trees[tree]['ns_per_ray']:.0f} ns"])
    return table(["mesh", "a turn by 60°", "work a triangle", "nodes of a ray", "time of a ray"], lines)


def bakes_table(rows):
    efforts = rows.values("bake", "effort")
    lines = []
    for mesh in rows.names:
        bakes = [rows.one("bake", mesh=mesh, effort=effort)["ns_per_triangle"] for effort in efforts]
        refit = rows.espalier(mesh)["ns_per_triangle"]
        lines.append([mesh, f"{times(refit)} ns", *(f"{times(bake)} ns ({times(bake / refit)} ×)" for bake in bakes)])
    return table(["mesh", "refit, a triangle", *(f"bake, effort `{effort}`" for effort in efforts)], lines)


def break_even(rows, mesh, motion, effort, tree):
    """The rays into one pose from which on a bake and its rays take less time than a refit and its rays."""
    trees = rows.rays(mesh, motion)
    saved = trees[tree]["ns_per_ray"] - trees["bake"]["ns_per_ray"]
    bake = rows.one("bake", mesh=mesh, effort=effort)
    more = (bake["ns_per_triangle"] - rows.espalier(mesh)["ns_per_triangle"]) * bake["triangles"]
    # A ray's time is not known to one per cent.
    return None if saved <= 0.01 * trees["bake"]["ns_per_ray"] else more / saved


def choice_table(rows):
    lines = []
    for mesh in rows.names:
        for motion in rows.motions():
            rays = [break_even(rows, mesh, motion, "fast", tree) for tree in ("rest", "pose")]
            lines.append([mesh, motion, *("none" if count is None else f"{count:,.0f}" for count in rays)])
    return table(["mesh", "motion", "rays into a pose from which a bake (effort `fast`) pays", "with that pose baked in"], lines)


def boxes_table(rows):
    lines = []
    for mesh in rows.names:
        for motion in rows.values("boxes", "motion"):
            aabb, obb = (rows.one("boxes", mesh=mesh, motion=motion, boxes=boxes) for boxes in ("aabb", "obb anew"))
            lines.append([mesh, motion, times(aabb["times_built"]), times(obb["times_built"]), times(obb["times_built_aabb"])])
    return table(["mesh", "motion", "AABB, refit / built", "OBB, fitted anew / built", "OBB, fitted anew / AABB, built"], lines)


def outputs(files):
    rows = MotionRows(read_objects(files, "espalier_bench_study deformation", needed))
    return {DOCUMENT: fill(DOCUMENT, {"conditions": conditions(rows, files), "goals": goals_table(rows), "refits": refits_table(rows) + lost_text(rows),
                                      "memory": memory_table(rows), "nodes": f"{nodes_table(rows)}\n\n{model_text(rows)}",
                                      "bakes": bakes_table(rows), "rays": rays_table(rows), "rigid": rigid_table(rows),
                                      "choice": choice_table(rows), "boxes": boxes_table(rows)})}


if __name__ == "__main__":
    run(DOCUMENT, __doc__, outputs)
