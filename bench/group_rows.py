#!/usr/bin/env python3
"""Writes rows of JSON, an object a line, with those of one mesh in one line: bench/group_rows.py [FILE...] >GROUPED

What they have in common stands once, since the names of their fields would make most of the file. report_page.py reads both forms.
Standard library only.
"""

import fileinput
import json

KEY = ("measures", "mesh", "processor", "compiler", "rounds")  # rows with the same values of these, or without them, share a line


def main():
    groups = {}
    for row in map(json.loads, fileinput.input(encoding="utf-8")):
        common = {name: value for name, value in row.items() if name != "rows"}
        groups.setdefault(tuple(row.get(name) for name in KEY), []).extend({**common, **one} for one in row.get("rows", [{}]))
    for rows in groups.values():
        common = {name: value for name, value in rows[0].items() if all(name in row and row[name] == value for row in rows)}
        others = [{name: value for name, value in row.items() if name not in common} for row in rows]
        print(json.dumps({**common, "rows": others}, separators=(",", ":")))


main()
