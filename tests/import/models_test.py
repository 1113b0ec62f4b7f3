#!/usr/bin/env python3
"""Bakes every file of a folder of models, compares each of a format with a reader of its own here (readers/) with what
the command reports, and prints a table of the outcomes.

Usage: models_test.py PATH_TO_ESPALIER FOLDER
"""

import collections
import concurrent.futures
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile

from readers import gltf, obj, ply, stl
from readers.surface import Broken, Unsupported

READERS = {".obj": obj, ".ply": ply, ".stl": stl, ".gltf": gltf, ".glb": gltf}
SECONDS = 100
BYTES = 8 << 30  # of memory: no broken file may take that of the machine
# They advise how to bake, and claim no loss.
ADVICE = {
    "lost_closed", "rays_rounded_coarsely", "step_below_float_spacing", "unexpected_size", "up_axis_kept",
}
# Files without a reader here that bake with a warning, and what they lack.
JUSTIFIED = {
    "DXF/issue_2229.dxf": "an index of 0 where they count from 1, and fewer faces than stated",
    "IFC/AC14-FZK-Haus.ifc": "openings of walls that were not cut",
    "LWO/LWO2/concave_self_intersecting.lwo": "a polygon that was not cut into triangles",
    "LWO/LWO2/nonplanar_polygon.lwo": "a polygon that was not cut into triangles",
}
REFUSED = (3, 5)
OF_THE_WHOLE = ("empty", "dropped")  # errors about all inputs together


class Outcome:
    """What became of one file."""

    def __init__(self, name, kind, failures=(), warnings=(), is_compared=False):
        self.name = name
        self.kind = kind
        self.failures = list(failures)
        self.warnings = list(warnings)
        self.is_compared = is_compared
        self.is_needless = False


def run(espalier, path, folder, *options):
    blob = os.path.join(folder, "blob.espl")
    command = [espalier, "bake", path, "-o", blob, "--json", "--effort", "fast", "--threads", "1", *options]
    try:
        process = subprocess.run(command, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return None, {}, ""
    try:
        document = json.loads(process.stdout)
    except ValueError:
        document = {}
    return process.returncode, document, process.stderr.decode("utf-8", "replace")


def float32(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def differences(document, surface):
    """How the report of a bake differs from what an independent reader finds in the file."""
    found = []
    if document["source_triangles"] != surface.triangles:
        found.append(f"{document['source_triangles']} triangles instead of {surface.triangles}")
    if document["triangles"] == 0 or surface.low[0] > surface.high[0]:
        if (document["triangles"] == 0) != (surface.low[0] > surface.high[0]):
            found.append(f"{document['triangles']} baked triangles, bounds {surface.low} to {surface.high}")
        return found
    largest = max(abs(value) for value in surface.low + surface.high)
    allowed = document["step"] + largest * 2.0**-22  # the lattice, and float32 after transforms
    for name, expected in (("min", surface.low), ("max", surface.high)):
        for axis in range(3):
            if abs(document["bounds"][name][axis] - float32(expected[axis])) > allowed:
                found.append(f"bounds {document['bounds']} instead of {surface.low} to {surface.high}")
                return found
    return found


def judge(espalier, root, name, repair):
    """The outcome of one file."""
    path = os.path.join(root, name)
    with tempfile.TemporaryDirectory() as folder:
        options = ["--drop-bad-triangles"] if repair else []
        code, document, stderr = run(espalier, path, folder, *options)
        if code is None:
            return Outcome(name, "endless", [f"takes more than {SECONDS} seconds"])
        left = os.listdir(folder)
    if code != 0:
        message = document.get("error", {}).get("message", stderr)
        reason = document.get("error", {}).get("kind", "")
        failures = []
        lacks_a_file = code == 2 and "No such file" in message  # beside it
        if code not in REFUSED and not lacks_a_file:
            failures.append(f"exit status {code}: {stderr.strip()}")
        if reason not in OF_THE_WHOLE and name not in message:
            failures.append(f"is refused without its name: {message}")
        if left:
            failures.append(f"is refused, and leaves {left}")
        if "Is it a mesh file" in message:
            failures.append(f"is refused with a guess: {message}")
        kind = "ended by a limit" if reason.startswith("import_") else f"refused: {reason}"
        return Outcome(name, kind, failures)
    warnings = [warning["kind"] for warning in document["warnings"] if warning["kind"] not in ADVICE]
    if document["triangles"] == 0:
        return Outcome(name, "baked", ["bakes to an empty blob with exit status 0"], warnings)
    reader = READERS.get(os.path.splitext(name)[1].lower())
    outcome = Outcome(name, "baked", [], warnings)
    if reader is None:
        outcome.is_needless = bool(warnings) and name not in JUSTIFIED
        return outcome
    try:
        surface = reader.read(path)
    except Unsupported:
        return outcome
    except Broken as reason:
        if not warnings and not repair:
            outcome.failures.append(f"bakes without a warning, although it is broken: {reason}")
        return outcome
    outcome.is_compared = True
    found = differences(document, surface)
    if found and not warnings:
        outcome.failures += found
    outcome.is_needless = bool(warnings) and not found
    return outcome


def files_below(root):
    for folder, _, names in os.walk(root):
        for name in names:
            yield os.path.relpath(os.path.join(folder, name), root)


def main():
    espalier, root = sys.argv[1], sys.argv[2]
    if not os.path.isdir(root):
        print(f"SKIPPED: {root} is not there (Debian: assimp-testmodels)")
        return 0
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    names = sorted(files_below(root))
    jobs = [(name, repair) for name in names for repair in (False, True)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        outcomes = list(pool.map(lambda job: judge(espalier, root, *job), jobs))
    counts = collections.Counter()
    failures = 0
    for (name, repair), outcome in zip(jobs, outcomes):
        counts[outcome.kind, repair] += 1
        counts["compared with a reader", repair] += outcome.is_compared
        counts["baked with a warning", repair] += bool(outcome.warnings)
        counts["baked with a warning, and nothing is lost", repair] += outcome.is_needless
        for failure in outcome.failures:
            failures += 1
            print(f"FAILED: {name}{' --drop-bad-triangles' if repair else ''}: {failure}")
        if outcome.warnings:
            print(f"warned: {name}{' --drop-bad-triangles' if repair else ''}: {', '.join(outcome.warnings)}"
                  f"{' (nothing is lost)' if outcome.is_needless else ''}")
    print(f"{'outcome of ' + str(len(names)) + ' files':44}{'bake':>8}{'--drop-bad-triangles':>22}")
    for kind in sorted({kind for kind, _ in counts}):
        print(f"{kind:44}{counts[kind, False]:8}{counts[kind, True]:22}")
    for repair in (False, True):
        if counts["baked with a warning, and nothing is lost", repair] > 0.02 * counts["baked", repair]:
            failures += 1
            print("FAILED: more than 2 % bake with a warning although nothing is lost")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
