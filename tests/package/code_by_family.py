#!/usr/bin/env python3
"""code_by_family.py LIBRARY.a: prints the table of docs/embedding.md: the code that a program links which calls every function of C of
a family, from the single file by `g++ -O2 -ffunction-sections` and from a library of the runtime.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = PROJECT / "lib/espalier/c"
FAMILIES = {
    "rays": ["ray.h"], "overlaps": ["overlap.h"], "distances of points": ["distance.h"], "sweeps": ["sweep.h"],
    "contacts": ["contact.h"], "two blobs": ["pair.h"], "scenes": ["scene.h"],
    "everything": sorted(str(path.relative_to(HEADERS)) for path in HEADERS.rglob("*.h") if path.name != "bake.h")}


def functions_of(headers):
    texts = [(HEADERS / name).read_text() for name in headers]
    return sorted(set(re.findall(r"^(?!static).*?\b(espalier_\w+)\((?!\*)", "\n".join(texts), re.MULTILINE)))


def linked_code(folder, names, code):
    """Returns the size of the code of a program that refers to these functions, less that of one that refers to none."""
    known = subprocess.run(["nm", "--defined-only", code], stdout=subprocess.PIPE, text=True, check=True).stdout
    names = [name for name in names if f" T {name}\n" in known]
    source = "".join(f'extern "C" void {name}();\n' for name in names)
    source += "using Function = void (*)();\nvolatile Function used;\nint main() {\n"
    source += "".join(f"    used = {name};\n" for name in names) + "    return 0;\n}\n"
    (folder / "program.cpp").write_text(source)
    subprocess.run(["g++", "-std=c++20", "-O2", "program.cpp", code, "-Wl,--gc-sections", "-o", "program"], check=True, cwd=folder)
    return int(subprocess.run(["size", "program"], stdout=subprocess.PIPE, text=True, check=True, cwd=folder).stdout.split()[6])


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: code_by_family.py LIBRARY.a")
    library = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([sys.executable, PROJECT / "tools/single_file.py", folder], check=True)
        subprocess.run(["g++", "-std=c++20", "-O2", "-ffunction-sections", "-c", "espalier.cpp", "-o", "single.o"], check=True, cwd=folder)
        rows = {"`open` and the closest hit of a ray": ["espalier_open", "espalier_raycast"]}
        rows |= {family: functions_of(headers) for family, headers in FAMILIES.items()}
        print("| family | single file | library |\n|---|---|---|")
        for family, names in rows.items():
            sizes = [linked_code(folder, names, code) - linked_code(folder, [], code) for code in (folder / "single.o", library)]
            print(f"| {family} | " + " | ".join(f"{round(size / 1000):,}" for size in sizes) + " |")


main()
