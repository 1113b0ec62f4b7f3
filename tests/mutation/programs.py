"""The programs that judge mutants, built from a copy of the project whose library has every mutant in it: the ordinary
programs of tests, those that bake and answer for every machine, and those that replay the corpus of the fuzz targets.
Once as usual, and once as the code for microcontrollers. One lane and four have between them all that is mutated; what is wider
is held to their bits elsewhere."""
import filecmp
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
JOBS = int(os.environ.get("MUTATION_JOBS", os.cpu_count() or 1))
TESTS = [f"espalier_tests_{name}" for name in ("runtime", "baker", "promises", "oracle", "c")]
REPLAYED = ["open", "tree", "bake", "bake_c", "scene", "moving", "refit"]
BUILDS = {
    "build": ["espalier_make_blobs", "espalier_query_answers", *TESTS, *(f"espalier_fuzz_{name}" for name in REPLAYED)],
    "build_small_code": ["espalier_query_answers", "espalier_tests_runtime"]}
COPIED = ("CMakeLists.txt", "README.md", "docs", "fuzz", "lib", "tests", "tools")


def write_sources(folder):
    """The project with all mutants in it, and the list of mutants."""
    source, fresh = folder / "source", folder / "fresh"
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    for name in COPIED:
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, fresh / name)
    with open(fresh / "CMakeLists.txt", "a") as top:
        top.write("add_subdirectory(tests/mutation)\n")
    written = subprocess.run([sys.executable, HERE / "instrument.py", ROOT / "lib", fresh / "lib",
                              folder / "mutants.jsonl"])
    if written.returncode != 0:
        raise SystemExit(written.returncode)
    # Only what changed is touched, and compiled again.
    for path in fresh.rglob("*"):
        old = source / path.relative_to(fresh)
        if path.is_file() and not (old.is_file() and filecmp.cmp(path, old, shallow=False)):
            old.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, old)
    for path in source.rglob("*"):
        if path.is_file() and not (fresh / path.relative_to(source)).is_file():
            path.unlink()
    return [json.loads(line) for line in (folder / "mutants.jsonl").open()]


def build(folder, mutants):
    source = folder / "source"
    flags = f"-std=c++20 -O1 -w -include {source}/tests/mutation/mutants.hpp"
    if platform.machine() in ("x86_64", "AMD64"):  # mutants.hpp calls operators of lanes, in no set
        flags += " -msse4.2 -mpopcnt"
    for name, targets in BUILDS.items():
        small_code = "ON" if name == "build_small_code" else ""
        configured = subprocess.run(["cmake", "-S", source, "-B", folder / name, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                                     "-DESPALIER_TOOLS=OFF", "-DESPALIER_BENCH=OFF", "-DESPALIER_INSTALL=OFF", "-DESPALIER_UNITY=ON",
                                     "-DESPALIER_COUNT_STEPS=ON", "-DESPALIER_SETS=sse42", f"-DESPALIER_SMALL_CODE={small_code}",
                                     f"-DCMAKE_CXX_FLAGS={flags}", f"-DMUTANT_COUNT={mutants[-1]['number'] + 1}"],
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if configured.returncode != 0:
            raise SystemExit(configured.stdout)
        built = subprocess.run(["cmake", "--build", folder / name, "-j", str(JOBS), "--target", *targets],
                               stdout=subprocess.PIPE, text=True)
        if built.returncode != 0:
            raise SystemExit(built.stdout)
