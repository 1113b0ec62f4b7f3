#!/usr/bin/env python3
"""Turns rows of espalier_bench_peers --json into the tables of docs/benchmarks.md and the plots beside the rows.

    bench/report.py bench/results/FILE.jsonl    writes docs/benchmarks.md (between its markers) and bench/results/*.svg
    bench/report.py --check                     exits with 1 when those are not what the rows that they name say

Rows of several runs may follow each other in one file: a figure is then the median of the runs, with the smallest and
the largest beside it; of one run it is the median of its repetitions, with theirs. Standard library only.
"""

import argparse
import json
import pathlib
import re
import statistics
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
import report_plot  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
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


def fail(message):
    sys.exit(f"bench/report.py: {message}")


def read_rows(files):
    rows = []
    for file in files:
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except OSError as error:
            fail(f"{file}: {error.strerror}")
        for number, line in enumerate(lines, 1):
            try:
                rows.append(json.loads(line))
            except ValueError as error:
                fail(f"{file}, line {number}: no JSON object ({error}); rows come from espalier_bench_peers --json")
            missing = [f for f in ("system", "profile", "mesh", "date", "load", "any_contradictions") if f not in rows[-1]]
            if missing:
                fail(f"{file}, line {number}: no field {', '.join(missing)}; measure again with this version")
    if not rows:
        fail("no rows to report")
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


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


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
    names = ", ".join(f"[{file.name}](../{file.relative_to(ROOT).as_posix()})" for file in files)
    return (f"Measured {' and '.join(dates)} on {row['processor'] or 'an unnamed processor'} ({row['instruction_set']}), "
            f"one thread, {row['compiler']}; {', '.join(versions) or 'no peers'}. "
            f"{spread} of {row['repetitions']} repetitions in which the systems take turns ({row['builds']} for *build*). "
            f"{row['rays']:,} incoherent rays, {row['bits']}-bit lattice, effort {row['effort']}"
            + (f", builder {row['builder']}" if row.get("builder") else "") + f". The rows: {names}.{noise}")


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


def fill(document, name, text):
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if len(pattern.findall(document)) != 1:
        fail(f"{DOCUMENT} has no pair of lines '{begin}' and '{end}'")
    return pattern.sub(lambda _: f"{begin}\n{text}\n{end}", document)


def outputs(files):
    """Everything that the rows decide: path and text."""
    rows = read_rows(files)
    meshes = group(rows)
    document = DOCUMENT.read_text(encoding="utf-8")
    document = fill(document, "conditions", conditions(rows, meshes, files))
    document = fill(document, "slower", slower(meshes))
    document = fill(document, "tables", tables(meshes))
    result = {DOCUMENT: document}
    for name, text in plots(meshes).items():
        result[ROOT / "bench" / "results" / name] = text
    return result


def named_files():
    """The rows that the document was made from."""
    block = DOCUMENT.read_text(encoding="utf-8").partition("<!-- begin conditions -->")[2].partition("<!-- end")[0]
    names = re.findall(r"\]\(\.\./([^)]*\.jsonl)\)", block)
    if not names:
        fail(f"{DOCUMENT} names no rows; name a file")
    return [ROOT / name for name in names]


def main():
    parser = argparse.ArgumentParser(description="Tables and plots from rows of espalier_bench_peers --json.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail when something would change")
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="rows; without any, those that the document names")
    arguments = parser.parse_args()
    files = [file.resolve() for file in arguments.files] or named_files()
    outside = [str(file) for file in files if not file.is_relative_to(ROOT)]
    if outside:
        fail(f"{', '.join(outside)}: the document links to its rows; put them into bench/results")
    stale = [path for path, text in outputs(files).items()
             if not path.exists() or path.read_text(encoding="utf-8") != text]
    if arguments.check:
        for path in stale:
            print(f"{path.relative_to(ROOT)} is not what its rows say; run bench/report.py", file=sys.stderr)
        sys.exit(1 if stale else 0)
    for path, text in outputs(files).items():
        path.write_text(text, encoding="utf-8")
        print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
