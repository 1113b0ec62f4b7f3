#!/usr/bin/env python3
"""What the sources may look like: the walls of the house (docs/architecture.md), and how folders are made.

Usage: check_sources.py PROJECT includes|extensions|fragments|folders
"""
import collections
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
problems = []

INCLUDE = re.compile(r"""^[ \t]*#[ \t]*include[ \t]*([<"][^>"\n]*[>"]|.*)""", re.MULTILINE)
PLAIN = r"<(array|bit|cfloat|climits|compare|concepts|cstddef|cstdint|limits|span|type_traits|utility)>"
MACHINE = r"<(immintrin|nmmintrin|x86gprintrin|avxintrin|avx2intrin|fmaintrin|arm_neon|wasm_simd128|arm_acle|cpuid)\.h>"
STANDARD = r"<[a-z_0-9]+(\.h)?>"
SOURCES = (".hpp", ".inl", ".cpp")

# Each table has a row for each folder: the folders of earlier rows whose files it may include in addition to its own.
# So no two folders need each other. "." is the root.
WALKS = "base lattice kernels blob lanes answers traversal"
RUNTIME = {  # from numbers to the families of queries
    "base": "",
    "lattice": "base",
    "kernels": "base lattice",
    "blob": "base lattice",
    "lanes": "base lattice blob",
    "answers": "base lattice kernels blob",
    "traversal": "base lattice kernels blob lanes answers",
    "open": "base blob traversal",
    "rays": WALKS,
    "rays/batch": f"{WALKS} rays",
    "rays/small_code": f"{WALKS} rays",
    "proximity": WALKS,
    "overlap": f"{WALKS} proximity",
    "sweeps": f"{WALKS} rays proximity",
    "transforms": "base",
    "pairs": f"{WALKS} transforms",
    "scenes": f"{WALKS} open rays proximity sweeps transforms",
    "moving_scenes/box_tree": "base blob lanes traversal transforms",
    "moving_scenes": "base lattice lanes proximity scenes pairs transforms moving_scenes/box_tree",
    "deformation": "base lattice blob",
    "asset": "base lattice blob traversal",
    "contacts": f"{WALKS} proximity transforms pairs asset",
    "batches": "base lattice traversal",
    "c": "moving_scenes",
}
BAKER = {  # in the order of its stages
    "base": "",
    "input": "base",
    "quantise": "base input",
    "build": "base input quantise",
    "error": "base input quantise build",
    "deformation": "base input quantise build error",
    "optimise": "base input quantise build",
    "collapse": "base input quantise build",
    "sections": "base input quantise build collapse",
    "encode": "base input quantise build collapse sections",
    "verify": "base input quantise build collapse sections",
    "scenes": "base build optimise collapse sections encode verify",
    "c": "base",
}
IMPORT = {  # from the system to the choice of a reader
    "platform": "",
    "platform/posix": "platform",
    "platform/windows": "platform",
    "base": "platform",
    "guards": "base platform",
    "transfer": "",
    "readers": "base platform",
    "gltf/data": "base platform",
    "gltf": "base guards gltf/data",
    "3mf": "base",
    "assimp": "base platform guards",
    "absent": "base gltf/data",
    ".": "base platform guards transfer readers gltf 3mf assimp",
}
TOOLS = {  # from what all of the command uses to the command line
    "base": "",
    "demo": "",
    "report": "base",
    "files": "base report",
    "layout": "base report",
    "bake": "base report files layout",
    "trade": "base report bake",
    "scenes": "base report layout bake",
    "query": "base report files",
    "render": "base files",
    "verify": "base",
    "absent": "base render",
    "commands": "base report files layout bake trade scenes query render verify",
    "command_line": "base report query commands",
    ".": "base report commands command_line",
}
SUPPORT = ("support support/base support/meshes support/machine support/format support/blobs support/queries "
           "support/loops support/answers support/exercise")
TESTS = {
    "support/base": "",
    "support/machine": "support/base",
    ".": "support/machine",
    "support/meshes": "support/base",
    "support/format": "support/base",
    "support/blobs": "support/base support/meshes support/format",
    "support/queries": "support/base support/meshes support/format support/blobs",
    "support": "support/base support/machine support/meshes support/format support/blobs support/queries",
    "support/loops": "support/base support/format",
    "support/answers": "support/base support/machine support/format support/blobs support/queries support/loops",
    "support/exercise": "support/base support/machine support/blobs support/queries",
    "oracle": "support/base support/machine support/meshes support/format",
    "support/exact": "support support/base support/format support/queries oracle",
    "platform": "",
    "platform/microsoft": "",
    "wasm/answers": "support/machine",
    "firmware": "platform support/base support/meshes support/blobs",
    "firmware/image": "platform firmware",
    "firmware/plugin": "",
    "mutation": "",
    "package/find_package": "",
    "package/program": "",
    "sections": "",
    "docs": "support/meshes",
    "threads": "platform",
    "promises": f"{SUPPORT} oracle",
    "c": SUPPORT,
    "c/baking": f"{SUPPORT} c",
    "runtime/base": f"{SUPPORT} oracle",
    "runtime/blob": SUPPORT,
    "runtime/lattice": f"{SUPPORT} support/exact oracle platform",
    "runtime/kernels": f"{SUPPORT} support/exact oracle",
    "runtime/traversal": f"{SUPPORT} support/exact oracle platform",
    "runtime/rays": f"{SUPPORT} support/exact oracle platform",
    "runtime/proximity": f"{SUPPORT} support/exact",
    "runtime/overlap": f"{SUPPORT} support/exact oracle",
    "runtime/sweeps": f"{SUPPORT} oracle",
    "runtime/contacts": f"{SUPPORT} support/exact oracle",
    "runtime/transforms": f"{SUPPORT} oracle",
    "runtime/pairs": f"{SUPPORT} support/exact",
    "runtime/scenes": f"{SUPPORT} platform oracle",
    "runtime/moving_scenes": f"{SUPPORT} runtime/scenes oracle",
    "runtime/deformation": f"{SUPPORT} runtime/moving_scenes runtime/pairs",
    "runtime/batches": SUPPORT,
    "runtime/asset": f"{SUPPORT} support/exact oracle",
    "baker": f"{SUPPORT} oracle",
    **{f"baker/{stage}": f"{SUPPORT} baker" for stage in ("base", "input", "deformation", "error", "build", "collapse",
                                                          "encode", "scenes", "verify")},
    "baker/quantise": f"{SUPPORT} baker oracle",
    "baker/optimise": f"{SUPPORT} baker baker/build",
    "baker/sections": f"{SUPPORT} support/exact baker oracle",
    "import": "",
    "tools": f"{SUPPORT} baker/quantise",
}


def files(folder, *patterns):
    """The files below a folder, by patterns of pathlib."""
    return sorted({file for pattern in patterns for file in (ROOT / folder).glob(pattern) if file.is_file()})


def sources(folder):
    return files(folder, *(f"**/*{ending}" for ending in SOURCES))


def includes_of(file):
    """What a file includes, but for what the includer of for_each_set.hpp names: that is among its own."""
    return [name for name in INCLUDE.findall(file.read_text()) if name != "ESPALIER_FRAGMENT"]


def shown(file):
    return file.relative_to(ROOT).as_posix()


def check(what, chosen, allowed=".*", forbidden=None):
    """Every include of the files is like one regular expression, and begins like none of another."""
    for file in chosen:
        for name in includes_of(file):
            if not re.fullmatch(allowed, name) or (forbidden and re.match(forbidden, name)):
                problems.append(f"{shown(file)} includes {name}: {what}")


def folder_of(name, file, top):
    """The folder of an included file in `top`. Files of lib name it by its path there, others as compilers find it."""
    if top.startswith("lib/"):
        inside = re.fullmatch(rf"<{top[4:]}/(?:([a-z_0-9/]+)/)?[a-z_0-9]+\.(hpp|inl)>", name)
        return (inside[1] or ".") if inside else None
    for base in (file.parent, ROOT / top):
        if name[0] == '"' and (base / name[1:-1]).is_file():
            return pathlib.Path(os.path.relpath((base / name[1:-1]).parent, ROOT / top)).as_posix()
    return None


def check_layers(top, rows, others, *, has_root=True):
    """Each folder of `top` has a row and includes what it names, and what else `others` allows."""
    allowed = {}
    for folder, names in rows.items():
        problems.extend(f"the row of {top}/{folder} names {name}, which has no earlier row"
                        for name in names.split() if name not in allowed)
        allowed[folder] = {folder, *names.split()}
    seen = set()
    for file in sources(top) + files(top, "**/*.[ch]"):
        folder = file.parent.relative_to(ROOT / top).as_posix()
        if folder == "." and not has_root:
            continue
        if folder not in allowed:
            problems.append(f"{top}/{folder} has no row in check_sources.py")
            continue
        seen.add(folder)
        for name in includes_of(file):
            other = folder_of(name, file, top)
            if other not in allowed[folder] if other else not re.fullmatch(others, name):
                problems.append(f"{shown(file)} includes {name}: the row of {top}/{folder} in check_sources.py "
                                "does not allow that")
    problems.extend(f"check_sources.py has a row of {top}/{folder}, where no sources are"
                    for folder in allowed if folder not in seen)


def includes():
    offline = [ROOT / "lib/espalier" / name for name in ("bake.hpp", "import.hpp", "scenes/bake.hpp")]
    public = [file for file in files("lib/espalier", "*.hpp", "format/*.hpp", "scenes/*.hpp", "advanced/*.hpp", "batches/*.hpp")
              if file not in offline]
    check("a public header of the runtime includes public headers and freestanding ones only", public,
          rf"<espalier/((advanced|base|format|scenes|batches)/)?[a-z_]+\.hpp>|{PLAIN}", r"<espalier/((scenes/)?bake|import)\.hpp>")
    check("a public header of the baker or the importers includes public and standard headers only", offline,
          rf"<espalier/((base|scenes)/)?[a-z_]+\.hpp>|{STANDARD}")
    check("a header for C includes headers for C and freestanding ones only", files("lib/espalier", "**/*.h"),
          r"<espalier/c/((advanced|scenes|batches)/)?[a-z_]+\.h>|<std(bool|def|int)\.h>")
    runtime = sources("lib/runtime")
    check("the runtime includes public headers, its own and freestanding ones only", runtime,
          r"<espalier/[a-ac-z_][a-z_]*\.hpp>|<espalier/(blob|bounds|(advanced|base|batches)/[a-z_]+|scenes/[a-ac-z_][a-z_]*)\.hpp>"
          rf"|<espalier/espalier\.h>|<runtime/[a-z_0-9/]+\.(hpp|inl)>|{PLAIN}|{MACHINE}")
    check_layers("lib/runtime", RUNTIME, rf"<espalier/((advanced|base|scenes|batches)/)?[a-z_]+\.h(pp)?>|{PLAIN}|{MACHINE}",
                 has_root=False)
    check_layers("lib/baker", BAKER, r"<espalier/((advanced|base|scenes)/)?[a-z_]+\.hpp>|<espalier/c/bake\.h>"
                 rf"|<runtime/(base|lattice|blob)/[a-z_0-9]+\.hpp>|{STANDARD}", has_root=False)
    check("a file of the baker's root includes public and standard headers and the baker's own only",
          files("lib/baker", "*.?pp"),
          rf"<espalier/((advanced|base|scenes)/)?[a-z_]+\.hpp>|<baker/([a-z]+/)?[a-z_0-9]+\.hpp>|{STANDARD}")
    check_layers("lib/import", IMPORT, rf"<espalier/((base|scenes)/)?[a-z_]+\.hpp>|<[a-wyz][a-z_0-9/]*\.h>|<assimp/.*>"
                 rf"|<nlohmann/json(_fwd)?\.hpp>|{STANDARD}")
    # It testifies to what the rest of the baker writes and the runtime reads.
    witness = files("lib/baker/verify", "decode_*.?pp", "check_tree.?pp", "field_reader.hpp")
    check("the baker's own reader includes the format and its own files only", witness,
          r"<espalier/(format|base/function_ref)\.hpp>|<baker/verify/(check_tree|decode_tree|field_reader)\.hpp>"
          rf"|{STANDARD}")
    if len(witness) < 6:
        problems.append(f"only {len(witness)} files of the baker's own reader found")
    of_load = ROOT / "bench/load/meshopt_file.cpp"  # compares with meshoptimizer's codec itself
    importers = sources("lib/import")
    others = [file for folder in ("lib", "tools", "tests", "fuzz", "bench") for file in sources(folder)
              if file not in importers and file != of_load]
    check("only lib/import may include an importer's library", others, forbidden="<(assimp/|draco/|expat|meshoptimizer)")
    check("the libraries beside lib/import do not need it", [file for file in others if shown(file).startswith("lib/")],
          forbidden="<import/")
    for folder in ("lib", "tools", "fuzz", "bench"):
        check("only tests/ may include Eigen or GMP", sources(folder), forbidden="<(Eigen/|gmp)")
    # Headers that take seconds to compile stand behind narrow ones of the command.
    heavy = [ROOT / name for name in ("tools/command_line/verb.cpp", "tools/command_line/usage_error.cpp",
                                      "tools/report/json.cpp", "lib/import/gltf/data/json.cpp")]
    check("only verb.cpp, usage_error.cpp and the two json.cpp may include CLI11 or JSON",
          [file for file in importers + sources("tools") if file not in heavy], forbidden=r"<(CLI/|nlohmann/json\.hpp)")
    check("the oracle must not know the code that it judges",
          files("tests/oracle", "big_integer.*", "rational.*", "exact_geometry.*"), forbidden="<(espalier|runtime)/")
    check("the command includes of the importers what their files share, and a guard for its malloc", sources("tools"),
          forbidden=r"<import/(?!(base|platform)/[a-z_]+\.hpp>|guards/limit_guard\.hpp>)")
    check_layers("tools", TOOLS, "<.*>")
    check_layers("tests", TESTS, '<.*>|"semihosting\\.hpp"')  # the last is of docs/examples/firmware
    if len(runtime) < 150:
        problems.append(f"only {len(runtime)} files seen in lib/runtime: is {ROOT} the project?")


def extensions():
    """What compilers have beyond the standards is in one header for C++ and one for C.

    Assembly is left: the instructions of processors.
    """
    # std::bit_cast is the builtin function that is not here, which all compilers have.
    extension = re.compile("__attribute__|__declspec|gnu::|__extension__|_Pragma|#pragma [a-np-zA-Z]|__builtin_[ac-z]|"
                           "__builtin_b[a-hj-z]")
    chosen = files("lib/espalier", "**/*.h*") + sources("lib/runtime")
    for file in chosen:
        if shown(file) in ("lib/espalier/base/compiler.hpp", "lib/espalier/c/attributes.h"):
            continue
        problems.extend(f"{shown(file)} has an extension of a compiler, which belongs in compiler.hpp: {line}"
                        for line in file.read_text().splitlines() if extension.search(line))
    if not chosen:
        problems.append(f"no sources seen: is {ROOT} the project?")


def fragments():
    """Code that is compiled once for each instruction set (lanes/for_each_set.hpp).

    A fragment whose guard is not lifted is compiled for the first set alone. What it includes inside of a set's region
    would be compiled for that set, and every other user would share it.
    """
    end_of_set = (ROOT / "lib/runtime/lanes/end_set.hpp").read_text()
    lifted = re.findall(r"^#undef (ESPALIER_\w+_HPP)$", end_of_set, re.MULTILINE)
    guards = []
    for file in sources("lib/runtime"):
        region = re.search(r"^ESPALIER_BEGIN_SET$", text := file.read_text(), re.MULTILINE)
        if not region:
            continue
        guard = "ESPALIER_" + re.sub("[^A-Z0-9]", "_", file.relative_to(ROOT / "lib/runtime").as_posix().upper())
        guards.append(guard)
        if not re.search(rf"^#ifndef {guard}\n#define {guard}$", text, re.MULTILINE):
            problems.append(f"{shown(file)} is compiled once for each set: its guard must be {guard}, and no #pragma once")
        if "#include" in text[region.start():]:
            problems.append(f"{shown(file)} includes a file inside of a set's region: move it in front")
    problems.extend(f"end_set.hpp does not lift {guard}" for guard in guards if guard not in lifted)
    problems.extend(f"end_set.hpp lifts {guard}, which no fragment has" for guard in lifted if guard not in guards)
    if len(guards) < 30:
        problems.append(f"only {len(guards)} fragments seen: is {ROOT} the project?")


def folders():
    """The size of folders and the names in them: rays/ray_batch.cpp should be rays/batch.cpp."""
    largest = 25
    counts = collections.Counter()
    for file in files("lib", "**/*") + files("tools", "**/*") + files("tests", "**/*"):
        path = file.relative_to(ROOT)
        if any(part == "__pycache__" or part.startswith(".") for part in path.parts):
            continue
        counts[path.parent.as_posix()] += 1
        word = path.parent.name.removesuffix("s")
        if re.match(f"{re.escape(word)}s?_(?!test$)", path.name.split(".")[0]):
            problems.append(f"{shown(file)} repeats the name of its folder")
    problems.extend(f"{folder} holds {count} files, more than {largest}: group them by concept"
                    for folder, count in counts.items() if count > largest)
    if len(counts) < 50:
        problems.append(f"only {len(counts)} folders found: is {ROOT} the project?")


{"includes": includes, "extensions": extensions, "fragments": fragments, "folders": folders}[sys.argv[2]]()
sys.exit("\n".join(dict.fromkeys(problems)) if problems else 0)
