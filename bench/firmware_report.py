#!/usr/bin/env python3
"""Turns rows of `tools/dev firmware` into the tables of docs/small_cores.md.

    bench/firmware_report.py bench/results/FILE.jsonl    writes docs/small_cores.md (between its markers)
    bench/firmware_report.py --check                     exits with 1 when the page is not what its rows say

Standard library only.
"""

import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
from report_page import ROOT, fail, fill, links, read_objects, run, table  # noqa: E402

DOCUMENT = ROOT / "docs" / "small_cores.md"
CORES = {"m0": "M0", "m3": "M3", "m4f": "M4F", "m7": "M7", "m33": "M33", "m55": "M55"}
IMAGES = {"closest_ray": "`open` and closest ray", "in_steps": "`open_unchecked`, a segment in steps",
          "five_queries": "`open` and the five usual queries", "every_query": "every query"}
FIVE = {"raycast": "closest ray", "occluded": "any ray", "overlaps_sphere": "sphere overlap", "closest_point": "closest point",
        "overlaps_box": "box overlap"}
IN_STEPS = {"overlaps_box_in_steps": "box", "first_hit_in_steps": "segment, first hit", "any_hit_in_steps": "segment, any hit"}
# The calls of the C++ interface, where the rows have other names.
CALLS = {"overlaps_box_in_steps": "overlaps(LatticeBox)", "first_hit_in_steps": "raycast(LatticeSegment)",
         "any_hit_in_steps": "occluded(LatticeSegment)", "collides": "overlaps(PlacedBlob)",
         "minimum_distance": "distance(PlacedBlob)", "within_distance": "within_distance(PlacedBlob)",
         "for_each_contact": "for_each_contact(PlacedBlob)", "collect_touches": "collect_touches(PlacedBlob)",
         "raycast_batch": "raycast(batch)",
         "overlaps_sphere": "overlaps(Sphere)", "overlaps_box": "overlaps(Box)", "overlaps_capsule": "overlaps(Capsule)",
         "overlaps_oriented_box": "overlaps(OrientedBox)", "overlaps_triangle": "overlaps(Triangle)",
         "overlaps_planes": "overlaps(ConvexVolume)", "overlaps_cone": "overlaps(Cone)",
         "winding_number": "winding_number(16 directions)", "for_each_overlap_sphere": "for_each_overlap(Sphere)",
         "for_each_overlap_box": "for_each_overlap(Box)", "closest_to_segment": "closest_point(Segment)",
         "closest_to_box": "closest_point(Box)", "contacts_sphere": "find_contacts(Sphere)",
         "contacts_capsule": "find_contacts(Capsule)", "contacts_oriented_box": "find_contacts(OrientedBox)",
         "contacts_convex_hull": "find_contacts(ConvexHull)", "sweep_oriented_box": "sweep(OrientedBox)",
         "sweep_convex_hull": "sweep(ConvexHull)", "sweep_sphere": "sweep(Sphere)", "sweep_capsule": "sweep(Capsule)",
         "sweep_box": "sweep(Box)", "may_overlap_sphere": "overlaps(Sphere, Accuracy)",
         "may_overlap_box": "overlaps(Box, Accuracy)", "may_be_occluded": "occluded(Ray, Accuracy)",
         "distance_bounds": "distance_bounds(Accuracy)"}
CLOTH_TRIANGLES = 512  # ClothPlaces::triangles of tests/firmware/refit_workload.hpp
STACKS = {"open": "`open`", **FIVE, "collides": "two touch", "minimum_distance": "two: distance"}


def needed(row):
    return ("core", "profile", "compiler", "qemu", *(["queries"] if "mesh" in row else ["code_bytes"]))


class Rows:
    def __init__(self, rows):
        self.code = {(r["core"], r["profile"], image): size for r in rows for image, size in r.get("code_bytes", {}).items()}
        self.blobs = {(r["profile"], mesh): size for r in rows for mesh, size in r.get("blob_size", {}).items()}
        self.queries = {(r["core"], r["profile"], r["mesh"], query): {**r, "query": query, **counts}
                        for r in rows for query, counts in r.get("queries", {}).items()}
        self.tools = sorted({(r["compiler"], r["qemu"]) for r in rows})
        if not self.code or not self.queries or len(self.tools) != 1:
            fail("the rows are not those of a whole run with one compiler and one QEMU")

    def asked(self):
        """Core, profile and mesh, in the order of the rows."""
        return list(dict.fromkeys(key[:3] for key in self.queries))

    def largest(self, core):
        """What the columns of a core are about: a mesh that all but the smallest core hold."""
        for mesh in ("bunny", "fandisk", "level"):
            if (core, "fast", mesh) in self.asked():
                return mesh
        fail(f"{core}: no mesh was asked in profile fast")


def thousands(number):
    return f"{number:,}"


def mean_and_most(row, field="instructions"):
    return f"{row[field]:,} ({row[field + '_max']:,})"


def goals_table(rows):
    """What the project set out to reach on the M4F with profile fast and the bunny, and what is reached."""
    def query(name):
        return rows.queries["m4f", "fast", rows.largest("m4f"), name]
    pairs = [row for key, row in rows.queries.items()
             if key[:2] == ("m4f", "fast") and key[3] in ("collides", "for_each_contact", "minimum_distance", "within_distance")]
    goals = [("code of `open` and a closest ray", rows.code["m4f", "fast", "closest_ray"], 6 * 1024),
             ("code of every query", rows.code["m4f", "fast", "every_query"], 24 * 1024),
             ("stack of a closest ray", query("raycast")["stack"], 512),
             ("stack of two blobs", max(row["stack"] for row in pairs), 2048),
             ("instructions of a closest ray, on average", query("raycast")["instructions"], 4000),
             ("the level as a blob, profile `small`", rows.blobs["small", "level"], 24 * 1024)]
    return table(["", "is", "should be at most", ""],
                 [[what, thousands(value), thousands(most), "yes" if value <= most else f"no, {value / most:.1f} times"]
                  for what, value, most in goals])


def call(query):
    return f"`{CALLS.get(query, query)}`"


def profiles_table(rows):
    """A closest ray on one mesh for each core that ran it in several profiles."""
    lines = []
    for core, mesh in (("m4f", rows.largest("m4f")), ("m0", "level")):
        for profile in ("fast", "small"):
            if (core, profile, mesh) not in rows.asked():
                continue
            ray, opening = (rows.queries[core, profile, mesh, query] for query in ("raycast", "open"))
            lines.append([CORES[core], mesh, f"`{profile}`", thousands(rows.blobs[profile, mesh]),
                          thousands(rows.code[core, profile, "closest_ray"]), thousands(max(ray["stack"], opening["stack"])),
                          thousands(ray["instructions"])])
    return table(["core", "mesh", "profile", "blob", "code", "stack", "instructions of a ray"], lines)


def code_table(rows):
    kinds = list(dict.fromkeys((core, profile) for core, profile, _ in rows.code))
    return table(["core", "profile"] + list(IMAGES.values()),
                 [[CORES[core], f"`{profile}`"] + [thousands(rows.code[core, profile, image]) for image in IMAGES]
                  for core, profile in kinds])


def of_each_core(rows, names, field="instructions"):
    """A row for each core in profile fast, a column for each query."""
    lines = []
    for core in dict.fromkeys(key[0] for key in rows.queries):
        mesh = rows.largest(core)
        lines.append([CORES[core], mesh] + [mean_and_most(rows.queries[core, "fast", mesh, query], field) for query in names])
    return table(["core", "mesh"] + list(names.values()), lines)


def stack_table(rows):
    """The deepest of all meshes, because which branches run depends on them."""
    lines = []
    for core, profile in dict.fromkeys(key[:2] for key in rows.queries):
        own = [row for key, row in rows.queries.items() if key[:2] == (core, profile) and key[2] not in ("scene", "cube")]
        deepest = {query: max(row["stack"] for row in own if row["query"] == query) for query in STACKS}
        others = max(own, key=lambda row: (row["query"] not in STACKS, row["stack"]))
        lines.append([CORES[core], f"`{profile}`"] + [thousands(deepest[query]) for query in STACKS] +
                     [f"{thousands(others['stack'])} ({call(others['query'])})"])
    return table(["core", "profile"] + list(STACKS.values()) + ["deepest of the others"], lines)


SCENE = {"open_scene": "`open_scene`", "scene_raycast": "closest ray", "scene_occluded": "any hit of a ray",
         "scene_overlaps_sphere": "sphere overlap", "scene_closest_point": "closest point"}


def scenes_table(rows):
    """Code of one query, and instructions and stack of each, in a scene of 64 instances."""
    lines = []
    for core, profile, mesh in rows.asked():
        if mesh != "scene":
            continue
        cells = [rows.queries[core, profile, mesh, query] for query in SCENE]
        lines.append([CORES[core], f"`{profile}`", thousands(rows.code[core, profile, "scene_ray"])] +
                     [f"{thousands(cell['instructions'])}; {thousands(cell['stack'])}" for cell in cells])
    return table(["core", "profile", "code of `open_scene` and closest ray"] + list(SCENE.values()), lines)


def moving_table(rows):
    """A step of 64 movers: every eighth repacks, the others refit. Empty if the rows are from before moving scenes."""
    lines = []
    for core, profile, mesh in rows.asked():
        if (core, profile, mesh, "moving_step") not in rows.queries:
            continue
        refits, repacks = (rows.queries[core, profile, mesh, query] for query in ("moving_step", "moving_step_repack"))
        calls = refits["calls"] + repacks["calls"]
        mean = -(-(refits["calls"] * refits["instructions"] + repacks["calls"] * repacks["instructions"]) // calls)
        lines.append([CORES[core], f"`{profile}`", thousands(rows.code[core, profile, "moving_step"]), thousands(mean)] +
                     [mean_and_most(row) for row in (refits, repacks)] +
                     [thousands(max(refits["stack"], repacks["stack"]))])
    return table(["core", "profile", "code", "instructions of a step", "with refit", "with repack", "stack"], lines)


def refit_table(rows):
    """Refits of a cloth. Empty if the rows are from before deformable meshes."""
    lines = []
    for core, profile, mesh in rows.asked():
        if (core, profile, mesh, "refit") not in rows.queries:
            continue
        row = rows.queries[core, profile, mesh, "refit"]
        lines.append([CORES[core], f"`{profile}`", thousands(rows.code[core, profile, "refit_mesh"]),
                      mean_and_most(row),
                      thousands(-(-row["instructions_max"] // CLOTH_TRIANGLES)), thousands(row["stack"])])
    return table(["core", "profile", "code", "instructions of a refit", "at most for each triangle", "stack"], lines)


def level_table(rows):
    lines = []
    for core, profile, mesh in rows.asked():
        if mesh != "level":
            continue
        blob = rows.blobs[profile, mesh]
        ray, five = (rows.code[core, profile, image] for image in ("closest_ray", "five_queries"))
        ray_stack = rows.queries[core, profile, mesh, "raycast"]["stack"]
        five_stack = max(rows.queries[core, profile, mesh, query]["stack"] for query in FIVE)
        opening = rows.queries[core, profile, mesh, "open"]["stack"]
        lines.append([CORES[core], f"`{profile}`", thousands(blob), thousands(blob + ray), thousands(max(ray_stack, opening)),
                      thousands(blob + five), thousands(max(five_stack, opening))])
    return table(["core", "profile", "blob", "blob and code of a closest ray", "stack of it", "blob and code of the five usual queries",
                  "stack of them"], lines)


def largest_table(rows):
    lines = []
    for core in dict.fromkeys(key[0] for key in rows.queries):
        _, profile, mesh = max((key for key in rows.asked() if key[0] == core), key=lambda key: rows.blobs[key[1:]])
        ray = rows.queries[core, profile, mesh, "raycast"]
        opening = rows.queries[core, profile, mesh, "open"]
        lines.append([CORES[core], mesh, f"`{profile}`", thousands(rows.blobs[profile, mesh]), thousands(opening["instructions"]),
                      mean_and_most(ray)])
    return table(["core", "mesh", "profile", "blob", "instructions of `open`", "closest ray"], lines)


def all_queries_table(rows):
    """What refuses the mesh, since it has holes, and so reads nothing of it, is shown on the torus."""
    own = [row if row["blob_bytes_max"] else rows.queries["m4f", "fast", "torus", row["query"]]
           for key, row in rows.queries.items() if key[:3] == ("m4f", "fast", rows.largest("m4f"))]
    return table(["query", "instructions (most)", "blob bytes (most)", "stack"],
                 [[call(r['query']) + (", torus" if r["mesh"] == "torus" else ""), mean_and_most(r),
                   mean_and_most(r, "blob_bytes"), thousands(r["stack"])] for r in own])


def outputs(files):
    rows = Rows(read_objects(files, "tools/dev firmware --publish", needed))
    compiler, qemu = rows.tools[0]
    elsewhere = sum(row["writes_elsewhere"] for row in rows.queries.values())
    conditions = (f"Rows: {links(DOCUMENT, files)}.\nGCC {compiler} `-Os`, one profile in the library, linked by `-nostdlib -lgcc`; QEMU {qemu}.\n"
                  f"Writes outside the stack in all {sum(row['calls'] for row in rows.queries.values()):,} calls: {elsewhere}.")
    return {DOCUMENT: fill(DOCUMENT, {"conditions": conditions, "goals": goals_table(rows), "profiles": profiles_table(rows), "code": code_table(rows), "instructions": of_each_core(rows, FIVE), "steps": of_each_core(rows, IN_STEPS),
                                      "bytes": of_each_core(rows, FIVE, "blob_bytes"), "stack": stack_table(rows), "level": level_table(rows), "scenes": scenes_table(rows), "moving": moving_table(rows), "refit": refit_table(rows),
                                      "largest": largest_table(rows), "queries": all_queries_table(rows)})}


if __name__ == "__main__":
    run(DOCUMENT, __doc__, outputs)
