#!/usr/bin/env python3
"""Turns the rows of tools/dev guide into the tables of docs/guide and the figures of docs/images/guide.

    bench/guide/report.py bench/results/FILE.jsonl        writes the chapters (between markers) and the figures
    bench/guide/report.py --check                         exits with 1 when a chapter or a figure is not what its rows say
    bench/guide/report.py --section NAME FOLDER FILE...   writes the tables and figures of one section into a folder

Standard library only.
"""

import importlib
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from report_page import ROOT, Rows, fail, fill, links, read_objects, run  # noqa: E402

GUIDE = ROOT / "docs" / "guide"
INDEX = GUIDE / "README.md"  # names the rows
FIGURES = ROOT / "docs" / "images" / "guide"
# Pictures of how something works: no row decides them, and neither does the table between the markers `packages`.
DRAWINGS = {"aac.svg", "ladder_drawing.svg", "origin.svg", "ray_walk.svg", "subdivision_drawing.svg", "top_down.svg",
            "volumes_drawing.svg"}
COMMON = ("measures", "processor", "compiler")
# A section is a module sections/NAME.py: ROWS (fields by what a row measures), and made(rows), which returns texts by
# name: FILE.svg is a figure, PAGE.md#MARKER a text of another page, MARKER one of the chapter that has the marker.
SECTIONS = tuple(sorted(file.stem for file in (pathlib.Path(__file__).parent / "sections").glob("*.py")))


def section_modules(names):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "sections"))
    return [importlib.import_module(name) for name in names]


def read(files, modules):
    fields = {measures: needed for module in modules for measures, needed in module.ROWS.items()}
    rows = Rows(read_objects(files, "tools/dev guide", lambda row: (*COMMON, *fields.get(row.get("measures"), ()))))
    for measures in fields:
        if not rows.of(measures):
            fail(f"no row measures {measures}; the rows are not those of a whole run")
    return rows


def conditions(rows, files):
    machines = "; ".join(f"{processor}, {compiler.replace('gcc', 'GCC')}" for processor, compiler in rows.machines)
    return f"Measured on one thread of {machines}.\nRows: {links(INDEX, files)}."


def chapter_with(marker):
    found = [chapter for chapter in sorted(GUIDE.glob("*.md")) if f"<!-- begin {marker} -->" in chapter.read_text(encoding="utf-8")]
    if len(found) != 1:
        fail(f"{len(found)} chapters of {GUIDE.relative_to(ROOT)} have the line '<!-- begin {marker} -->'")
    return found[0]


def check_chapters(text, figures):
    """Every figure is made here, or is one of the drawings; all are shown, and every table stands between markers."""
    shown = set(re.findall(r"\]\(\.\./images/guide/([^)]+)\)", text))
    made = {*figures, *DRAWINGS}
    if shown != made:
        fail(f"{GUIDE.name} shows {sorted(shown - made)}, which no section draws, and lacks {sorted(made - shown)}")
    loose = re.sub(r"<!-- begin (\S+) -->.*?<!-- end \1 -->", "", text, flags=re.DOTALL)
    tables = [line for line in loose.splitlines() if line.startswith("|")]
    if tables:
        fail(f"{GUIDE.name} has a table outside of markers: {tables[0]}")
    files = {file.name for file in FIGURES.glob("*")}
    if files - made or DRAWINGS - files:
        fail(f"{FIGURES.relative_to(ROOT)} has {sorted(files - made)}, which no section draws, and lacks {sorted(DRAWINGS - files)}")


def outputs(files):
    modules = section_modules(SECTIONS)
    rows = read(files, modules)
    figures, pages = {}, {INDEX: {"conditions": conditions(rows, files)}}
    for name, text in (item for module in modules for item in module.made(rows).items()):
        if name.endswith(".svg"):
            figures[name] = text
        else:
            path, _, marker = name.rpartition("#")
            pages.setdefault(ROOT / path if path else chapter_with(marker), {})[marker] = text
    made = {path: fill(path, blocks) for path, blocks in pages.items()}
    chapters = (made.get(path) or path.read_text(encoding="utf-8") for path in sorted(GUIDE.glob("*.md")))
    check_chapters("\n".join(chapters), figures)
    return {**made, **{FIGURES / name: text for name, text in figures.items()}}


def write_section(name, folder, files):
    (module,) = section_modules([name])
    rows = read([pathlib.Path(file) for file in files], [module])
    target = pathlib.Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    for name, text in module.made(rows).items():
        is_figure = name.endswith(".svg")
        file = name if is_figure else pathlib.PurePath(name).name.replace(".md#", "_") + ".md"
        (target / file).write_text(text if is_figure else text + "\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--section"]:
        if len(sys.argv) < 5:
            fail("--section NAME FOLDER FILE...")
        write_section(sys.argv[2], sys.argv[3], sys.argv[4:])
    else:
        run(INDEX, __doc__, outputs)
