#!/usr/bin/env python3
"""Checks what `espalier --json` prints: one JSON document that its schema describes.

Usage: schema.py SCHEMA.json DOCUMENT.json

Knows the words of JSON Schema that docs/schema uses and refuses others. Stricter than JSON Schema in one way: an
object has no keys besides those that its schema names, so that a new key without a description is found.
"""

import json
import pathlib
import re
import sys

NOTES = {"$schema", "title", "description", "definitions"}
TYPES = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "null": lambda value: value is None,
    "integer": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "number": lambda value: isinstance(value, (int, float)) and not isinstance(value, bool),
}


class Schema:
    """One part of a schema, and the file that it stands in."""

    def __init__(self, path, part=None):
        self.path = path
        self.part = json.loads(path.read_text()) if part is None else part

    def within(self, part):
        return Schema(self.path, part)

    def referred(self):
        name, _, pointer = self.part["$ref"].partition("#")
        target = Schema(self.path.parent / name) if name else Schema(self.path)
        for key in pointer.strip("/").split("/"):
            target = target.within(target.part[key])
        return target


def complaints(value, schema, at="$"):
    """What is wrong with `value`, each with its place."""
    found = []
    for word, wanted in schema.part.items():
        if word in NOTES:
            continue
        if word == "$ref":
            found += complaints(value, schema.referred(), at)
        elif word == "allOf":
            for part in wanted:
                found += complaints(value, schema.within(part), at)
        elif word == "anyOf":
            found += min((complaints(value, schema.within(part), at) for part in wanted), key=len)
        elif word == "const":
            if value != wanted or isinstance(value, bool) != isinstance(wanted, bool):
                found.append(f"{at} is {value!r}, not {wanted!r}")
        elif word == "enum":
            if value not in wanted:
                found.append(f"{at} is {value!r}, none of {wanted}")
        elif word == "type":
            names = [wanted] if isinstance(wanted, str) else wanted
            if not any(TYPES[name](value) for name in names):
                found.append(f"{at} is {value!r}, which is no {' or '.join(names)}")
        elif word == "pattern":
            if isinstance(value, str) and not re.search(wanted, value):
                found.append(f"{at} is {value!r}, unlike {wanted}")
        elif word in ("minimum", "maximum"):
            beyond = value is not None and (value < wanted if word == "minimum" else value > wanted)
            if beyond:
                found.append(f"{at} is {value!r}, beyond {wanted}")
        elif word in ("minItems", "maxItems"):
            if len(value) < wanted if word == "minItems" else len(value) > wanted:
                found.append(f"{at} has {len(value)} items, not {wanted}")
        elif word == "items":
            for number, item in enumerate(value if isinstance(value, list) else []):
                found += complaints(item, schema.within(wanted), f"{at}[{number}]")
        elif word == "required":
            found += [f"{at} lacks {key!r}" for key in wanted if isinstance(value, dict) and key not in value]
        elif word == "properties":
            for key, item in value.items() if isinstance(value, dict) else ():
                if key not in wanted:
                    found.append(f"{at} has {key!r}, which its schema does not name")
                else:
                    found += complaints(item, schema.within(wanted[key]), f"{at}.{key}")
        elif word == "additionalProperties":
            for key, item in value.items() if isinstance(value, dict) else ():
                found += complaints(item, schema.within(wanted), f"{at}.{key}")
        else:
            raise ValueError(f"{schema.path}: '{word}' is unknown here")
    return found


def main():
    schema = Schema(pathlib.Path(sys.argv[1]))
    text = pathlib.Path(sys.argv[2]).read_text()
    try:
        document = json.loads(text)
    except ValueError as error:
        sys.exit(f"not one JSON document: {error}: {text[:200]!r}")
    found = complaints(document, schema)
    for line in found[:5]:
        print(line)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
