#!/usr/bin/env python3
"""Checks what `espalier --json` printed: one JSON document a run, which the schema of its verb describes, and which has an error
exactly if the run failed.

Usage: schema.py DOCUMENTS, a file of four strings a run, each ended by a zero byte: exit code, verb, a name of the run, what it
printed. Prints a line for each run whose document is wrong.

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


def complaints(runs):
    """Yields a line for each run, (exit code, verb, name, what it printed), whose document is wrong."""
    for code, verb, name, text in runs:
        wrong = complaint(verb, text)
        if wrong:
            yield f"{name}: the JSON is not what {verb}.json describes: {wrong}"
        elif ("error" in json.loads(text)) != (code != "0"):
            yield f"{name}: the run ended with {code}, and its JSON has {'an' if code == '0' else 'no'} error"


if __name__ == "__main__":
    fields = pathlib.Path(sys.argv[1]).read_text(errors="replace").split("\0")[:-1]
    for line in complaints(zip(*[iter(fields)] * 4)):
        print(line)
