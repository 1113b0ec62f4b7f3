"""Chapter update.md of the guide: refit, rebuild and reinsertion, of deforming meshes and of many moving boxes."""

import charts
from report_page import fail, table

REFIT, BAKE, RAYS, BOXES, PHASE = "refit", "bake", "rays", "boxes", "broad phase"
ROWS = {REFIT: ("system", "profile", "ns_per_triangle", "poses"), BAKE: ("effort", "ns_per_triangle"),
        RAYS: ("motion", "tree", "ns_per_ray", "nodes_per_ray", "rays"), BOXES: ("motion", "boxes", "times_built", "times_built_aabb"),
        PHASE: ("objects", "speed", "system", "from", "median_us", "pairs", "steps")}
# Of a refit: system, profile, words.
REFITS = (("espalier", "16 bits", "AABB: Espalier"), ("textbook", "aabb", "AABB: binary tree in float"),
          ("embree", "refit compact", "AABB: Embree, compact"), ("bullet", "tree", "AABB: Bullet"), ("fcl", "aabb float", "AABB: FCL"),
          ("textbook", "obb anew", "OBB, fitted anew: binary tree"), ("fcl", "obb anew float", "OBB, fitted anew: FCL"),
          ("fcl", "obb merged float", "OBB, merged from children: FCL"))
MOTIONS = ("bend", "twist", "fold", "turn")
# Of moving boxes: system, how its tree follows, words.
PHASES = (("espalier", "refit, and rebuilt along a curve from time to time", "Espalier: refit"),
          ("bullet, margin 0.05", "reinsertion of boxes that leave a margin of 0.05", "Bullet, 0.05"),
          ("bullet, margin 0.2", "the same, margin 0.2", "Bullet, 0.2"), ("bullet, margin 0.5", "the same, margin 0.5", "Bullet, 0.5"),
          ("fcl, tree of floats", "refit, and rebuilt in part", "FCL"), ("grid", "no tree: a grid, built in each step", "grid"),
          ("sort and sweep", "no tree: boxes sorted along one axis", "sort and sweep"))


def only(rows, measures, **fields):
    """The row, or None where a library was not installed."""
    found = rows.of(measures, **fields)
    if len(found) > 1:
        fail(f"{len(found)} rows measure {measures} with {fields}")
    return found[0] if found else None


def refit_table(rows):
    meshes = rows.meshes(REFIT)
    lines = []
    for system, profile, words in REFITS:
        found = [only(rows, REFIT, mesh=mesh, system=system, profile=profile) for mesh in meshes]
        if any(found):
            lines.append([f"refit, {words}", *(f"{charts.number(row['ns_per_triangle'])} ns" if row else "–" for row in found)])
    for effort in rows.values(BAKE, "effort"):
        lines.append([f"rebuild: Espalier, effort `{effort}`",
                      *(f"{charts.number(rows.one(BAKE, mesh=mesh, effort=effort)['ns_per_triangle'])} ns" for mesh in meshes)])
    return table(["time a triangle", *meshes], lines)


def after_table(rows):
    meshes = rows.meshes(RAYS)
    lines = []
    for motion in MOTIONS:
        cells = []
        for mesh in meshes:
            anew = rows.one(RAYS, mesh=mesh, motion=motion, tree="bake")
            values = [rows.one(RAYS, mesh=mesh, motion=motion, tree=tree)["nodes_per_ray"] / anew["nodes_per_ray"] for tree in ("rest", "pose")]
            box = {boxes: rows.one(BOXES, mesh=mesh, motion=motion, boxes=boxes)["times_built"] for boxes in ("aabb", "obb anew")}
            shown = [f"{value:.2f}" if value is not None else "–" for value in (*values, box["aabb"], box["obb anew"])]
            cells.append("; ".join(shown))
        lines.append([motion, *cells])
    return table(["motion", *meshes], lines)


def phase_table(rows):
    lines = []
    for system, how, words in PHASES:
        row = only(rows, PHASE, system=system, **{"from": "boxes"})
        if row:
            name = words.split(":")[0].split(",")[0] if words[0].isupper() else words
            lines.append([name, how, f"{charts.number(row['median_us'])} µs", f"{charts.number(row['pairs_us'])} µs"])
    first = rows.of(PHASE)[0]
    return (table(["", "update", "a step", "of it: pairs"], lines) +
            f"\n\n{first['objects']:,} boxes of edge 1, all of which move by up to {first['speed']:g} in each step; {first['pairs']:,} pairs touch. "
            f"Medians of {first['steps']} steps. All find the same pairs.")


def figure(rows):
    meshes = rows.meshes(REFIT)
    panels = []
    for mesh in (meshes[0], meshes[-1]):
        shown = []
        for system, profile, words in REFITS:
            row = only(rows, REFIT, mesh=mesh, system=system, profile=profile)
            if row:
                shown.append(charts.Bar(words, row["ns_per_triangle"], group=1 if system == "espalier" else 0))
        shown.append(charts.Bar("rebuild: Espalier, fast", rows.one(BAKE, mesh=mesh, effort="fast")["ns_per_triangle"], group=1))
        panels.append(charts.Bars(f"{mesh}: a new pose, time a triangle", shown, "ns", logarithmic=True))
    shown = []
    for system, _, words in PHASES:
        row = only(rows, PHASE, system=system, **{"from": "boxes"})
        if row:
            shown.append(charts.Bar(words, row["median_us"] / 1000, group=1 if system == "espalier" else 0))
    panels.append(charts.Bars("A step of many moving boxes", shown, "ms"))
    return charts.draw_bar_panels("Update: time to follow a motion", panels, legend=("others", "Espalier"))


def made(rows):
    return {"refits": refit_table(rows), "after_refit": after_table(rows), "broad_phase": phase_table(rows),
            "update.svg": figure(rows)}
