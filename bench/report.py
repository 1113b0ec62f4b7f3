#!/usr/bin/env python3
"""Turns rows of espalier_bench_peers --json into the tables of docs/benchmarks.md and the plots beside the rows.

    bench/report.py bench/results/FILE.jsonl    writes docs/benchmarks.md (between its markers) and bench/results/*.svg
    bench/report.py --check                     exits with 1 when those are not what the rows that they name say

Rows of several runs may follow each other in one file: a figure is then the median of the runs, with the smallest and
the largest beside it; of one run it is the median of its repetitions, with theirs. Standard library only.
"""

import pathlib
import statistics
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
import report_plot  # noqa: E402
from report_page import ROOT, fail, fill, links, read_objects, run, table  # noqa: E402

DOCUMENT = ROOT / "docs" / "benchmarks.md"
KINDS = ("incoherent", "coherent", "any", "build")
SETTINGS = ("bits", "effort", "builder", "rays", "seed", "repetitions", "builds", "instruction_set", "processor",
            "compiler")
TIE = 0.995  # shares above round to 1.00
BUSY = 1.5  # load average; the benchmark itself makes 1


class Figure:
    """What all runs say about one quantity of one system on one mesh."""

    def __init__(self, rows, kind):
        ratios = [row[f"{kind}_ratio"] for row in rows]
        self.known = None not in ratios
        if not self.known:
            return
        self.median = statistics.median(ratios)
        if len(rows) > 1:
            self.low, self.high = min(ratios), max(ratios)
        else:
            self.low, self.high = rows[0][f"{kind}_spread"]

    def __str__(self):
        return f"{self.median:.2f} ({self.low:.2f}–{self.high:.2f})" if self.known else "–"


class System:
    """One system and profile on one mesh, over all runs."""

    def __init__(self, rows):
        self.row = rows[0]
        self.rows = rows
        self.name = self.row["system"]
        self.profile = self.row["profile"]
        self.label = f"{self.name} {self.profile}"
        self.own = self.name == "espalier"
        self.bytes = self.row["bytes_per_triangle"]
        self.figures = {kind: Figure(rows, kind) for kind in KINDS}

    def most(self, field):
        """The largest count of all runs, or None."""
        values = [row[field] for row in self.rows]
        return None if None in values else max(values)


class Mesh:
    def __init__(self, name, systems):
        self.name = pathlib.PurePath(name).stem
        self.systems = systems
        self.triangles = systems[0].row["triangles"]

    def own(self):
        return [system for system in self.systems if system.own]

    def peers(self):
        return [system for system in self.systems if not system.own]


def needed(_):
    return ("system", "profile", "mesh", "date", "load", "any_contradictions")


def read_rows(files):
    rows = read_objects(files, "espalier_bench_peers --json", needed)
    for field in SETTINGS:
        values = {row.get(field) for row in rows}
        if len(values) > 1:
            fail(f"rows with different {field} do not belong into one table: {sorted(map(str, values))}")
    return rows


def group(rows):
    """Meshes and systems in the order in which they were measured."""
    meshes = {}
    for row in rows:
        meshes.setdefault(row["mesh"], {}).setdefault((row["system"], row["profile"]), []).append(row)
    for name, systems in meshes.items():
        if len({len(runs) for runs in systems.values()}) > 1:
            fail(f"{name}: some systems were measured more often than others; give whole runs")
    return [Mesh(name, [System(runs) for runs in systems.values()]) for name, systems in meshes.items()]


# ---- what the document says -------------------------------------------------------------------------------------------


def decimals(value, digits=2):
    if value is None:
        return "–"
    return f"{value:.{digits}f}" if value < 100 else f"{value:.0f}"


def count(value):
    return "–" if value is None else f"{value:,}"


def conditions(rows, meshes, files):
    row = rows[0]
    runs = len(meshes[0].systems[0].rows)
    versions = {f"{r['system']} {r['version']}": None for r in rows if r["system"] != "espalier"}
    spread = (f"Each figure is the median of {runs} runs with the smallest and the largest of them; within a run, the median"
              if runs > 1 else "One run: each figure is the median, with the smallest and the largest,")
    dates = sorted({r["date"] for r in rows})
    loads = [r["load"] for r in rows if r["load"] is not None]
    noise = (f" **The machine was busy with other work (load {min(loads):.1f} to {max(loads):.1f} on {row['processors']} "
             "processors): take these figures as noisy.**" if loads and max(loads) > BUSY else "")
    return (f"Measured {' and '.join(dates)} on {row['processor'] or 'an unnamed processor'} ({row['instruction_set']}), "
            f"one thread, {row['compiler']}; {', '.join(versions) or 'no peers'}. "
            f"{spread} of {row['repetitions']} repetitions in which the systems take turns ({row['builds']} for *build*). "
            f"{row['rays']:,} incoherent rays, {row['bits']}-bit lattice, effort {row['effort']}"
            + (f", builder {row['builder']}" if row.get("builder") else "") + f". The rows: {links(files)}.{noise}")


def by_system(pairs):
    """Systems, each with its profiles and their values; a dash for none."""
    profiles = {}
    for system, value in pairs:
        profiles.setdefault(system.name, []).append(f"{system.profile} {value:.2f}")
    return "; ".join(f"{name}: {', '.join(values)}" for name, values in profiles.items()) or "–"


def slower(meshes):
    """Every peer that is faster or smaller than one of Espalier's profiles."""
    lines = []
    for mesh in meshes:
        for own in mesh.own():
            cells = []
            for kind in KINDS:
                mine = own.figures[kind]
                faster = [(p, mine.median / p.figures[kind].median) for p in mesh.peers()
                          if mine.known and p.figures[kind].known and mine.median / p.figures[kind].median < TIE]
                cells.append(by_system(faster))
            smaller = [(p, p.bytes) for p in mesh.peers() if p.bytes < own.bytes]
            lines.append([f"`{own.profile}`", mesh.name, *cells, by_system(smaller)])
    lines.sort(key=lambda line: [m.profile for m in meshes[0].own()].index(line[0].strip("`")))
    return table(["profile", "mesh", *KINDS, "smaller peer, B/triangle"], lines)


def tables(meshes):
    parts = []
    for mesh in meshes:
        parts.append(f"### {mesh.name}: {mesh.triangles:,} triangles")
        lattice = next((system.row for system in mesh.own()), None)
        if lattice is not None:
            parts.append(f"Step {lattice['step']:.6g}, largest extent {lattice['extent']:.6g} "
                         f"({lattice['extent'] / lattice['step']:,.0f} steps), largest error {lattice['max_error']:.3g}; "
                         f"{100 * lattice['hit_fraction']:.0f} % of the incoherent rays hit.")
        lines = []
        for system in mesh.systems:
            row = system.row
            name = f"**{system.label}**" if system.own else system.label
            rates = [r["incoherent_mrays"] for r in system.rows]
            lines.append([name, decimals(system.bytes), decimals(row["bytes_per_triangle_20_bits"]),
                          decimals(row["bytes_per_triangle_with_ids"]), *(str(system.figures[kind]) for kind in KINDS),
                          "–" if None in rates else f"{statistics.median(rates):.2f}",
                          count(system.most("disagreeing")), count(system.most("t_disagreeing")),
                          count(system.most("any_contradictions"))])
        parts.append(table(["system", "B/triangle", "at 20 bits", "with ids", *KINDS, "Mray/s", "differ", "t differs",
                            "any differs"], lines))
    return "\n\n".join(parts)


def plots(meshes):
    """The plots' texts by file name."""
    result = {}
    titles = {"incoherent": "Incoherent rays", "coherent": "Coherent rays", "any": "Any-hit rays"}
    for kind, title in titles.items():
        panels = []
        for mesh in meshes:
            marks = [report_plot.Mark(s.name, s.profile, s.bytes, f.median, f.low, f.high)
                     for s in mesh.systems for f in [s.figures[kind]] if f.known]
            panels.append(report_plot.Panel(f"{mesh.name}, {mesh.triangles:,} triangles", marks))
        result[f"{kind}.svg"] = report_plot.draw(f"{title}: speed and bytes a triangle", panels)
    return result


# ---- where it is written ----------------------------------------------------------------------------------------------


def outputs(files):
    """Everything that the rows decide: path and text."""
    rows = read_rows(files)
    meshes = group(rows)
    texts = {"conditions": conditions(rows, meshes, files), "slower": slower(meshes), "tables": tables(meshes)}
    result = {DOCUMENT: fill(DOCUMENT, texts)}
    for name, text in plots(meshes).items():
        result[ROOT / "bench" / "results" / name] = text
    return result


if __name__ == "__main__":
    run(DOCUMENT, "Tables and plots from rows of espalier_bench_peers --json.", outputs)
