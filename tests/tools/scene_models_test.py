#!/usr/bin/env python3
"""Bakes every glTF and IFC file of a folder, or without one a forest of 10,000 trees, as one blob and as a scene. Each
scene must be sound and give the answers of the loop over its instances and, within both errors, those of the blob. Prints
a table of bytes.

Usage: scene_models_test.py PATH_TO_ESPALIER PATH_TO_JUDGE [FOLDER]
"""

import concurrent.futures
import os
import subprocess
import sys
import tempfile

from scene.forest import forest

ENDINGS = (".gltf", ".glb", ".ifc")
MODES = ("off", "auto", "all")


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)


def judge(espalier, program, root, name):
    """A row of the table, and what failed."""
    sizes, report = [], ""
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, mode) for mode in MODES]
        for mode, path in zip(MODES, paths):
            baked = run(espalier, "bake", os.path.join(root, name), "-o", path, "--instances", mode, "-q", "--effort",
                        "fast", "--drop-bad-triangles")
            if mode == "off" and baked.returncode != 0:
                return None, []  # models_test.py judges refusals
            if baked.returncode != 0:
                return None, [f"{name}: --instances {mode}: exit status {baked.returncode}: {baked.stderr.strip()}"]
            sizes.append(os.path.getsize(path))
        for path in paths[1:]:
            for done in (run(espalier, "verify", path, "--deep"), run(program, paths[0], path)):
                if done.returncode != 0:
                    return None, [f"{name}: {done.stderr.strip() or done.stdout.strip()}"]
                report = done.stdout.strip()
    return (name, *sizes, report), []


def files_below(root):
    for folder, _, names in os.walk(root):
        for name in names:
            if name.lower().endswith(ENDINGS):
                yield os.path.relpath(os.path.join(folder, name), root)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    if len(sys.argv) == 4:
        compare(sys.argv[3])
        return
    with tempfile.TemporaryDirectory() as folder:
        forest(10000).write(os.path.join(folder, "forest.glb"))
        compare(folder)


def compare(root):
    """Judges the files below a folder and prints the table."""
    espalier, program = sys.argv[1:3]
    names = sorted(files_below(root))
    if not names:
        print(f"SKIPPED: there are no models in {root}")
        return
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        outcomes = list(pool.map(lambda name: judge(espalier, program, root, name), names))
    rows = [row for row, _ in outcomes if row]
    failures = [failure for _, found in outcomes for failure in found]
    print(f"{'one blob':>10} {'auto':>10} {'all':>10}  model; of --instances all")
    for name, off, auto, everything, report in rows:
        print(f"{off:10} {auto:10} {everything:10}  {name}: {report}")
    for failure in failures:
        print(failure)
    print(f"{len(rows)} of {len(names)} models as scenes, {len(failures)} failures")
    if failures or not rows:
        sys.exit(1)


if __name__ == "__main__":
    main()
