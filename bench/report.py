#!/usr/bin/env python3
"""Turns rows of espalier_bench_peers rays into tables and plots.

    bench/report.py FILE.jsonl...          writes docs/benchmarks.md, docs/benchmarks/rays.md and the README (between their
                                           markers), the plots in docs/images, from these files; spheres, points and pairs
                                           of docs/benchmarks.md from the newest rows of each
    bench/report.py --add FILE.jsonl       the same from the files that docs/benchmarks.md names and this one, which
                                           replaces a file of the same processor and instruction set
    bench/report.py --check                fails if any of them differs from what its rows give

Each file holds the rows of one machine; several machines give ranges. Rows of several runs may follow each other in one
file: a figure is then the median of the runs, with the lowest and the highest; of one run it is the median of its
repetitions, with theirs. Standard library only.
"""

import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import report_chart  # noqa: E402
import report_plot  # noqa: E402
import report_queries  # noqa: E402
import report_tables  # noqa: E402
from report_page import ROOT, fill, links, run  # noqa: E402
from report_rows import machine_of, read_machines  # noqa: E402
from report_tables import mesh_names, span  # noqa: E402

DOCUMENT = ROOT / "docs" / "benchmarks.md"
FIGURES = ROOT / "docs" / "benchmarks" / "rays.md"
README = ROOT / "README.md"
CHART = ROOT / "docs" / "images" / "bytes_and_speed.svg"
PLOTS = ROOT / "docs" / "images" / "benchmarks"
BUSY = 1.5  # load average; the benchmark itself makes 1


# ---- texts of docs/benchmarks.md ----------------------------------------------------------------------------------------


def loads_of(machine):
    return [row["load"] for row in machine.rows if row["load"] is not None]


def is_noisy(machine):
    return max(loads_of(machine), default=0.0) > BUSY


def machine_line(machine, file):
    row = machine.row
    versions = {f"{r['system']} {r['version']}": None for r in machine.rows if r["system"] != "espalier"}
    loads = loads_of(machine)
    noise = (f"\n  **The machine was busy with other work (load {min(loads):.1f} to {max(loads):.1f} on {row['processors']} "
             "processors): take these figures as noisy.**" if is_noisy(machine) else "")
    return (f"* {machine.name}, {' and '.join(sorted({r['date'] for r in machine.rows}))}: {row['compiler']}; "
            f"{', '.join(versions) or 'no peers'}.\n  Rows: {links(DOCUMENT, [file])}.{noise}")


def conditions(machines, files):
    row = machines[0].row
    runs = {len(system.rows) for machine in machines for mesh in machine.meshes for system in mesh.systems}
    spread = (f"Each figure is the median of {span(runs, 0)} runs with the lowest and the highest; within a run, the median"
              if max(runs) > 1 else "One run: each figure is the median, with the lowest and the highest,")
    return "\n".join([
        "Measured on one thread of:", "", *(machine_line(machine, file) for machine, file in zip(machines, files)), "",
        f"{spread} of {row['repetitions']} repetitions in which the systems take turns ({row['builds']} for *build*).",
        f"{row['rays']:,} incoherent rays, {row['bits']}-bit lattice, effort `{row['effort']}`"
        + (f", builder {row['builder']}" if row.get("builder") else "") + "."])


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


def processors(machines):
    names = ", ".join(machine.name + (", which was busy with other work" if is_noisy(machine) else "") for machine in machines)
    noise = " Take the speeds as noisy." if any(map(is_noisy, machines)) else ""
    return f"Measured with one thread on: {names}.{noise}"


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
    made = {
        DOCUMENT: {"conditions": conditions(machines, files), "rays": report_tables.rays(machines),
                   "memory": report_tables.memory(machines), "beside_peers": report_tables.beside_peers(machines),
                   "builds": report_tables.builds(machines), **report_queries.texts()},
        FIGURES: {"glance": report_tables.glance(machines), "every_loss": report_tables.every_loss(machines),
                  "tables": report_tables.tables(machines)},
        ROOT / "docs" / "engines.md": {"engines": report_queries.engines_table(report_queries.read_engines())},
        README: {"numbers": report_tables.numbers(machines) + "\n\n" + processors(machines)}}
    result = {page: fill(page, texts) for page, texts in made.items()}
    result[CHART] = chart(machines)
    for name, text in plots(machines).items():
        result[PLOTS / name] = text
    return result


def replace_machine(named, added):
    """The named files and the added one, in the place of a file of the same machine, which may be gone already."""
    kept = [file for file in named if file != added and file.exists() and machine_of(file) != machine_of(added)]
    return sorted([*kept, added])


if __name__ == "__main__":
    run(DOCUMENT, "Tables and plots from rows of espalier_bench_peers rays.", outputs, replace_machine)
