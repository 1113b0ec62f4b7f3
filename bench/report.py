#!/usr/bin/env python3
"""Turns rows of espalier_bench_peers rays into tables and plots.

    bench/report.py FILE.jsonl...          writes docs/benchmarks.md and the README (between their markers), the plots in
                                           docs/images, from these files
    bench/report.py --add FILE.jsonl       the same from the files that docs/benchmarks.md names and this one, which
                                           replaces a file of the same processor and instruction set
    bench/report.py --check                fails if any of them differs from what its rows give

Each file holds the rows of one machine; several machines give ranges. Rows of several runs may follow each other in one
file: a figure is then the median of the runs, with the lowest and the highest; of one run it is the median of its
repetitions, with theirs. Standard library only.
"""

import statistics
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import report_chart  # noqa: E402
import report_plot  # noqa: E402
from report_page import ROOT, fill, links, run, table  # noqa: E402
from report_rows import KINDS, RAYS, machine_of, read_machines  # noqa: E402

DOCUMENT = ROOT / "docs" / "benchmarks.md"
README = ROOT / "README.md"
CHART = ROOT / "docs" / "images" / "bytes_and_speed.svg"
PLOTS = ROOT / "docs" / "images" / "benchmarks"
TIE = 0.995  # shares above round to 1.00
BUSY = 1.5  # load average; the benchmark itself makes 1
REFERENCES = ("default", "robust")  # Embree's modes that speeds are shown beside; rows hold ratios to the first


def decimals(value, digits=2):
    if value is None:
        return "–"
    return f"{value:.{digits}f}" if value < 100 else f"{value:.0f}"


def count(value):
    return "–" if value is None else f"{value:,}"


def span(values, digits=2):
    """One value, or the lowest and the highest of several."""
    known = [f"{value:.{digits}f}" for value in sorted(values)]
    if not known:
        return "–"
    return known[0] if known[0] == known[-1] else f"{known[0]}–{known[-1]}"


def mesh_names(machines):
    return list(dict.fromkeys(mesh.name for machine in machines for mesh in machine.meshes))


def own_profiles(machines):
    return list(dict.fromkeys(system.profile for machine in machines for mesh in machine.meshes for system in mesh.own()))


def find_all(machines, mesh, name, profile):
    """The system on every machine that measured it, each with its mesh."""
    found = [(m, m.find(name, profile)) for m in (machine.find(mesh) for machine in machines) if m is not None]
    return [(m, system) for m, system in found if system is not None]


def speeds(machines, mesh, name, profile, kind, mode):
    """The medians beside one mode of Embree, a value for each machine."""
    values = []
    for measured, system in find_all(machines, mesh, name, profile):
        reference = measured.find("embree", mode)
        figure = system.beside(reference, kind) if reference is not None else None
        if figure is not None and figure.known:
            values.append(figure.median)
    return values


# ---- texts of docs/benchmarks.md ----------------------------------------------------------------------------------------


def machine_line(machine, file):
    row = machine.row
    versions = {f"{r['system']} {r['version']}": None for r in machine.rows if r["system"] != "espalier"}
    loads = [r["load"] for r in machine.rows if r["load"] is not None]
    noise = (f"\n  **The machine was busy with other work (load {min(loads):.1f} to {max(loads):.1f} on {row['processors']} "
             "processors): take these figures as noisy.**" if loads and max(loads) > BUSY else "")
    return (f"* {machine.name}, {' and '.join(sorted({r['date'] for r in machine.rows}))}: {row['compiler']}; "
            f"{', '.join(versions) or 'no peers'}.\n  Rows: {links(DOCUMENT, [file])}.{noise}")


EFFORTS = {0: "`fast`", 5: "`normal`", 8: "`best`"}  # by the number in the rows


def conditions(machines, files):
    row = machines[0].row
    runs = {len(system.rows) for machine in machines for mesh in machine.meshes for system in mesh.systems}
    spread = (f"Each figure is the median of {span(runs, 0)} runs with the lowest and the highest; within a run, the median"
              if max(runs) > 1 else "One run: each figure is the median, with the lowest and the highest,")
    return "\n".join([
        "Measured on one thread of:", "", *(machine_line(machine, file) for machine, file in zip(machines, files)), "",
        f"{spread} of {row['repetitions']} repetitions in which the systems take turns ({row['builds']} for *build*).",
        f"{row['rays']:,} incoherent rays, {row['bits']}-bit lattice, effort {EFFORTS[row['effort']]}"
        + (f", builder {row['builder']}" if row.get("builder") else "") + "."])


def glance(machines):
    """Speeds beside both modes of Embree, from the slowest machine to the fastest."""
    lines = []
    for mesh in mesh_names(machines):
        for profile in own_profiles(machines):
            own = [system for _, system in find_all(machines, mesh, "espalier", profile)]
            cells = [span(speeds(machines, mesh, "espalier", profile, kind, mode)) for kind in RAYS for mode in REFERENCES]
            lines.append([f"`{profile}`", mesh, span([system.bytes for system in own]), *cells])
    header = [f"{kind}: beside {mode}" for kind in RAYS for mode in REFERENCES]
    return table(["profile", "mesh", "B/triangle", *header], lines)


def by_system(shares):
    """Systems, each with its profiles and their values; a dash for none."""
    profiles = {}
    for (name, profile), value in shares.items():
        profiles.setdefault(name, []).append(f"{profile} {value:.2f}")
    return "; ".join(f"{name}: {', '.join(values)}" for name, values in profiles.items()) or "–"


def slower(machines):
    """Every peer that is faster or smaller than one of Espalier's profiles, with the share on the machine where it is lowest."""
    lines = []
    for profile in own_profiles(machines):
        for mesh in mesh_names(machines):
            faster, smaller = {kind: {} for kind in KINDS}, {}
            for measured, own in find_all(machines, mesh, "espalier", profile):
                for peer in measured.peers():
                    key = peer.name, peer.profile
                    if peer.bytes < own.bytes:
                        smaller[key] = peer.bytes
                    for kind in KINDS:
                        mine, other = own.figures[kind], peer.figures[kind]
                        if mine.known and other.known and mine.median / other.median < TIE:
                            faster[kind][key] = min(faster[kind].get(key, 1.0), mine.median / other.median)
            lines.append([f"`{profile}`", mesh, *(by_system(faster[kind]) for kind in KINDS), by_system(smaller)])
    return table(["profile", "mesh", *KINDS, "smaller peer, B/triangle"], lines)


def system_line(system):
    row = system.row
    rates = [r["incoherent_mrays"] for r in system.rows]
    return [f"**{system.label}**" if system.own else system.label, decimals(system.bytes),
            decimals(row["bytes_per_triangle_20_bits"]), decimals(row["bytes_per_triangle_with_ids"]),
            *(str(system.figures[kind]) for kind in KINDS),
            "–" if None in rates else f"{statistics.median(rates):.2f}",
            count(system.most("disagreeing")), count(system.most("t_disagreeing")), count(system.most("any_contradictions"))]


def tables(machines):
    parts = []
    for name in mesh_names(machines):
        measured = [(machine, machine.find(name)) for machine in machines if machine.find(name) is not None]
        parts.append(f"### {name}: {measured[0][1].triangles:,} triangles")
        for machine, mesh in measured:
            own = next((system.row for system in mesh.own()), None)
            lattice = "" if own is None else (
                f": step {own['step']:.6g}, largest extent {own['extent']:.6g} "
                f"({own['extent'] / own['step']:,.0f} steps), largest error {own['max_error']:.3g}; "
                f"{100 * own['hit_fraction']:.0f} % of the incoherent rays hit")
            parts.append(f"{machine.name}{lattice}.")
            parts.append(table(["system", "B/triangle", "at 20 bits", "with ids", *KINDS, "Mray/s", "differ", "t differs",
                                "any differs"], [system_line(system) for system in mesh.systems]))
    return "\n\n".join(parts)


def plots(machines):
    """The plots' texts by file name: a row of panels for each mesh, a panel for each machine."""
    result = {}
    titles = {"incoherent": "Incoherent rays", "coherent": "Coherent rays", "any": "Any-hit rays"}
    for kind, title in titles.items():
        panels = []
        for name in mesh_names(machines):
            for machine in machines:
                mesh = machine.find(name)
                if mesh is None:
                    continue
                marks = [report_plot.Mark(s.name, s.profile, s.bytes, f.median, f.low, f.high)
                         for s in mesh.systems for f in [s.figures[kind]] if f.known]
                panels.append(report_plot.Marks(f"{name}, {mesh.triangles:,} triangles: {machine.name}", marks))
        result[f"{kind}.svg"] = report_plot.draw_mark_panels(f"{title}: speed and bytes a triangle", panels)
    return result


# ---- the README ---------------------------------------------------------------------------------------------------------


def numbers(machines):
    """Bytes and speeds of the default profile, in ranges over the machines."""
    lines = []
    for mesh in mesh_names(machines):
        embree = span([system.bytes for _, system in find_all(machines, mesh, "embree", "default")], 0)
        own = span([system.bytes for _, system in find_all(machines, mesh, "espalier", "balanced")], 1)
        triangles = next(m.triangles for m in (machine.find(mesh) for machine in machines) if m is not None)
        cells = [span(speeds(machines, mesh, "espalier", "balanced", kind, mode))
                 for kind in ("incoherent", "any") for mode in REFERENCES]
        lines.append([mesh, f"{triangles:,}", own, embree, *cells])
    header = ["mesh", "triangles", "bytes per triangle", "Embree's bytes", *(f"{kind}: beside {mode}" for kind in ("closest hit", "any hit") for mode in REFERENCES)]
    return table(header, lines)


def processors(machines):
    return "Measured with one thread on: " + ", ".join(machine.name for machine in machines) + "."


def chart(machines):
    """Closest hits of incoherent rays: all meshes of all machines."""
    panels = []
    for machine in machines:
        marks = [report_chart.Mark(system.name, system.profile, mesh.name, system.bytes, system.figures["incoherent"].median)
                 for mesh in machine.meshes for system in mesh.systems if system.figures["incoherent"].known]
        panels.append(report_chart.Panel(machine.processor, marks))
    return report_chart.draw(panels)


# ---- files --------------------------------------------------------------------------------------------------------------


def outputs(files):
    """Everything that the rows decide: path and text."""
    machines = read_machines(files)
    texts = {"conditions": conditions(machines, files), "glance": glance(machines), "slower": slower(machines),
             "tables": tables(machines)}
    result = {DOCUMENT: fill(DOCUMENT, texts), CHART: chart(machines),
              README: fill(README, {"numbers": numbers(machines) + "\n\n" + processors(machines)})}
    for name, text in plots(machines).items():
        result[PLOTS / name] = text
    return result


def replace_machine(named, added):
    """The named files and the added one, in the place of a file of the same machine."""
    kept = [file for file in named if file != added and machine_of(file) != machine_of(added)]
    return sorted([*kept, added])


if __name__ == "__main__":
    run(DOCUMENT, "Tables and plots from rows of espalier_bench_peers rays.", outputs, replace_machine)
