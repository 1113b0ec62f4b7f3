#!/usr/bin/env python3
"""Shows rows of JSON, an object a line, as tables for people: PROGRAM... | bench/rows.py FIELD... -- COLUMN...

The fields stand above the rows that agree about them. Standard library only.
"""

import json
import sys


def text(value):
    if isinstance(value, list):
        return " to ".join(map(text, value))
    return "–" if value is None else str(value)


def main():
    end = sys.argv.index("--")
    above, columns = sys.argv[1:end], sys.argv[end + 1:]
    widths = [30] + [max(len(column), 16) for column in columns[1:]]
    shown = None
    for row in map(json.loads, sys.stdin):
        heading = "; ".join(f"{field} {text(row[field])}" for field in above)
        lines = [columns] if heading != shown else []
        if lines:
            print(f"\n{heading}" if shown else heading)
        for line in [*lines, [text(row.get(column)) for column in columns]]:
            print("  ".join(f"{cell:<{width}}" for cell, width in zip(line, widths)).rstrip(), flush=True)
        shown = heading


main()
