"""What pages made from measured rows share: reading and selecting rows, tables, filling a page between its markers, and --check."""

import argparse
import json
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def fail(message):
    sys.exit(f"bench/{pathlib.Path(sys.argv[0]).name}: {message}")


def read_objects(files, program, needed):
    """The objects of all files, one a line, or several with `rows` and what they have in common.

    Each must have the fields that needed(object) names.
    """
    rows = []
    for file in files:
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except OSError as error:
            fail(f"{file}: {error.strerror}")
        for number, line in enumerate(lines, 1):
            try:
                common = json.loads(line)
            except ValueError as error:
                fail(f"{file}, line {number}: no JSON object ({error}); rows come from {program}")
            for row in common.pop("rows", [{}]):
                rows.append({**common, **row})
                missing = [field for field in needed(rows[-1]) if field not in rows[-1]]
                if missing:
                    fail(f"{file}, line {number}: no field {', '.join(missing)}; measure again with this version")
    if not rows:
        fail("no rows to report")
    return rows


class Rows:
    """Rows of a whole run; meshes are in the order of the rows."""

    def __init__(self, rows):
        self.all = [{**row, "mesh": pathlib.PurePath(row["mesh"]).stem} if "mesh" in row else row for row in rows]
        self.machines = list(dict.fromkeys((row["processor"], row["compiler"]) for row in self.all))

    def of(self, measures, **fields):
        """The rows that measure this, with these values."""
        return [row for row in self.all if row["measures"] == measures and all(row[name] == value for name, value in fields.items())]

    def one(self, measures, **fields):
        found = self.of(measures, **fields)
        if len(found) != 1:
            fail(f"{len(found)} rows measure {measures} with {fields}; the rows are not those of one whole run")
        return found[0]

    def values(self, measures, field):
        """The values of a field, each once, in the order of the rows."""
        return list(dict.fromkeys(row[field] for row in self.of(measures)))

    def meshes(self, measures):
        return self.values(measures, "mesh")

    def ratios(self, measures, field, compared, **fields):
        """Of each mesh, the value over that of the row in which the fields of `compared` are others."""
        return [self.one(measures, mesh=mesh, **fields)[field] / self.one(measures, mesh=mesh, **{**fields, **compared})[field]
                for mesh in self.meshes(measures)]


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def links(page, files):
    """Links from the page to the files."""
    return ", ".join(f"[{file.name}]({os.path.relpath(file, page.parent).replace(os.sep, '/')})" for file in files)


def fill(page, texts):
    """The page's text with each of the texts between the markers of its name."""
    document = page.read_text(encoding="utf-8")
    for name, text in texts.items():
        begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
        pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
        if len(pattern.findall(document)) != 1:
            fail(f"{page} has no pair of lines '{begin}' and '{end}'")
        document = pattern.sub(lambda _: f"{begin}\n{text}\n{end}", document)
    return document


def named_files(page):
    """The rows that the page was made from."""
    block = page.read_text(encoding="utf-8").partition("<!-- begin conditions -->")[2].partition("<!-- end")[0]
    names = re.findall(r"\]\(([^)]*\.jsonl)\)", block)
    if not names:
        fail(f"{page} names no rows; name a file")
    return [(page.parent / name).resolve() for name in names]


def run(page, description, outputs, merge=None):
    """The command line of a report. outputs(files) returns everything that the rows decide: path and text.

    merge(named, added) returns the files to report when the option --add names one besides those of the page.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--check", action="store_true", help="write nothing; fail when something would change")
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="rows; without any, those that the page names")
    if merge is not None:
        parser.add_argument("--add", metavar="FILE", type=pathlib.Path, help="the page's rows and these")
    arguments = parser.parse_args()
    files = [file.resolve() for file in arguments.files] or named_files(page)
    if merge is not None and arguments.add is not None:
        files = merge(files, arguments.add.resolve())
    outside = [str(file) for file in files if not file.is_relative_to(ROOT)]
    if outside:
        fail(f"{', '.join(outside)}: the page links to its rows; put them into bench/results")
    stale = {path: text for path, text in outputs(files).items()
             if not path.exists() or path.read_text(encoding="utf-8") != text}
    for path, text in stale.items():
        if arguments.check:
            print(f"{path.relative_to(ROOT)} is not what its rows say; run bench/{pathlib.Path(sys.argv[0]).name}",
                  file=sys.stderr)
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
            print(path.relative_to(ROOT))
    sys.exit(1 if arguments.check and stale else 0)
