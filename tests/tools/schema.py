#!/usr/bin/env python3
"""Checks what `espalier --json` prints: one JSON document that the schema of its verb describes.

Usage: schema.py VERB DOCUMENT.json

Stricter than JSON Schema in two ways: an object has no keys besides those that its schema names, so that a new key
without a description is found, and 1.0 is no integer. The schemas are as strict, so that a mistyped word is found.
"""

import json
import pathlib
import sys

from jsonschema import Draft4Validator, Draft7Validator, ValidationError
from jsonschema.exceptions import best_match
from jsonschema.validators import extend

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs" / "schema"


def properties(validator, named, value, schema):
    yield from Draft7Validator.VALIDATORS["properties"](validator, named, value, schema)
    for key in value if isinstance(value, dict) else ():
        if key not in named:
            yield ValidationError(f"its schema does not name {key!r}")


# By its version it also judges what a "$ref" leads to, whose file names the version.
Strict = extend(Draft7Validator, {"properties": properties}, "draft7", Draft4Validator.TYPE_CHECKER)
MISTYPED = [error for file in FOLDER.glob("*.json")
            for error in Strict(Draft7Validator.META_SCHEMA).iter_errors(json.loads(file.read_text()))]


def complaint(verb, text):
    """What is wrong with a document, with its place; nothing if it is as its schema says."""
    schema = FOLDER / f"{verb}.json"
    if not schema.exists():  # a verb that does not exist: any verb's failure
        schema = FOLDER / "bake.json"
    try:
        document = json.loads(text)
    except ValueError as error:
        return f"not one JSON document: {error}: {text[:200]!r}"
    found = [*MISTYPED, *Strict({"$ref": schema.as_uri()}).iter_errors(document)]
    return f"{best_match(found).json_path}: {best_match(found).message}" if found else ""


if __name__ == "__main__":
    found = complaint(sys.argv[1], pathlib.Path(sys.argv[2]).read_text())
    print(found)
    sys.exit(1 if found else 0)
