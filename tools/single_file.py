#!/usr/bin/env python3
"""single_file.py FOLDER: writes the runtime as espalier.hpp and espalier.cpp (and the C header espalier.h) into FOLDER.

For programs that have no build system to add a library to: copy the files, compile espalier.cpp with the rest. Macros choose what
of it is compiled; which instruction set answers is chosen when the program runs, as in the library. The files of lib/runtime are
put one after the other: what several of them include, or repeat, is written once, and what is private to a file gets its name
where another has something that is called the same.
"""
import collections
import fnmatch
import pathlib
import re
import sys

LIBRARY = pathlib.Path(__file__).resolve().parent.parent / "lib"

INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')
CONDITION = re.compile(r"\s*#\s*(if|ifdef|ifndef|elif|else|endif)\b\s*(.*?)\s*(//.*)?$")
NAMESPACE = re.compile(r"(?:inline )?namespace\s*([\w:]*)\s*\{\s*(//.*)?$")
LITERAL = re.compile(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])+\'|//.*')
# A header of fragments, which is written once for each instruction set (lib/runtime/lanes/for_each_set.hpp), and what begins a set.
FRAGMENTS = re.compile(r"^#ifndef (ESPALIER_\w+_HPP)\n#define \1\n(.*^ESPALIER_BEGIN_SET$.*)^#endif\n\Z", re.MULTILINE | re.DOTALL)
OF_SET = re.compile(r"#(define|undef) ESPALIER_(LANES|BEGIN_SET|END_SET|FRAGMENT|\w+_HPP)(?: (.*))?$")
SCALAR = {"LANES": "1", "BEGIN_SET": "namespace espalier::detail::scalar {", "END_SET": "}"}
# What is left of code for an instruction set when all of it stood before; Clang warns of it.
EMPTY_REGION = re.compile(r"^ESPALIER_BEGIN_TARGET.*\nnamespace .*\n(//.*\n|\n)*\}.*\nESPALIER_END_TARGET\n", re.MULTILINE)

# The macros that leave out families, and which of them a file of lib/runtime needs: the first pattern that matches counts. Of the
# queries of instruction sets only those are compiled that something calls.
FAMILIES = ("OVERLAPS", "DISTANCES", "SWEEPS", "CONTACTS", "PAIRS", "SCENES", "MOVING_SCENES", "BATCHES", "DEFORMATION", "C")
BY_SHAPES = "OVERLAPS DISTANCES SWEEPS"
COLLIDING = "MOVING_SCENES SCENES PAIRS OVERLAPS"
FILES_OF_FAMILIES = (
    ("overlap/*", "OVERLAPS"),
    ("proximity/*", "DISTANCES"),
    ("kernels/box_distance.cpp", "DISTANCES"),
    ("sweeps/*", "SWEEPS"),
    ("kernels/moving_*", "SWEEPS"),
    ("contacts/find.cpp", "CONTACTS OVERLAPS DISTANCES"),
    ("contacts/planes.cpp", "CONTACTS OVERLAPS DISTANCES"),
    ("contacts/*pair.cpp", "CONTACTS PAIRS"),
    ("contacts/*", "CONTACTS"),
    ("pairs/*", "PAIRS"),
    ("kernels/triangle_distance.cpp", "PAIRS"),
    ("scenes/overlaps.cpp", "SCENES OVERLAPS"),
    ("scenes/distances.cpp", "SCENES DISTANCES"),
    ("scenes/sweeps.cpp", "SCENES SWEEPS"),
    ("scenes/contacts.cpp", "SCENES CONTACTS OVERLAPS DISTANCES"),
    ("scenes/*", "SCENES"),
    ("moving_scenes/coll*", COLLIDING),
    ("moving_scenes/touching_pairs.cpp", COLLIDING),
    ("moving_scenes/*", "MOVING_SCENES SCENES"),
    ("batches/shapes.cpp", "BATCHES OVERLAPS DISTANCES"),
    ("batches/*", "BATCHES"),
    ("deformation/*", "DEFORMATION"),
    ("c/approximations.cpp", "C OVERLAPS DISTANCES"),
    ("c/batches.cpp", "C BATCHES OVERLAPS DISTANCES"),
    ("c/contacts.cpp", "C CONTACTS OVERLAPS DISTANCES"),
    ("c/deformation.cpp", "C DEFORMATION"),
    ("c/moving_scenes.cpp", f"C MOVING_SCENES SCENES {BY_SHAPES}"),
    ("c/moving_shapes.cpp", "C SWEEPS"),
    ("c/pairs.cpp", "C PAIRS CONTACTS"),
    ("c/points.cpp", "C DISTANCES"),
    ("c/rounding.cpp", "C SWEEPS"),
    ("c/scene_contacts.cpp", "C SCENES CONTACTS OVERLAPS DISTANCES"),
    ("c/scene_pairs.cpp", f"C {COLLIDING}"),
    ("c/scenes.cpp", f"C SCENES {BY_SHAPES}"),
    ("c/volumes.cpp", "C OVERLAPS"),
    ("c/*", "C"),
)

HEADER_PREAMBLE = """\
// Espalier {version} in one file: what answers queries from a blob. Made by tools/single_file.py out of the library's headers.
// Compile espalier.cpp with the program, as C++20 or later.
//
{licence}
#pragma once
"""

SOURCE_PREAMBLE = """\
// Espalier {version} in one file: the runtime. Made by tools/single_file.py out of lib/runtime.
//
// Macros, for the compiler's command line. By default all queries are compiled, for processors of x86 with AVX2 and for those
// without: the latter take the code of microcontrollers, with the same answers.
// Instruction sets of x86: ESPALIER_SET_SSE42=1 adds one for processors from before 2013, ESPALIER_SET_AVX512=1 one for servers
// and some desktops; ESPALIER_SET_AVX2=0 leaves out that one.
// Families: ESPALIER_OVERLAPS=0, ESPALIER_DISTANCES=0, ESPALIER_SWEEPS=0, ESPALIER_CONTACTS=0, ESPALIER_PAIRS=0,
// ESPALIER_SCENES=0, ESPALIER_MOVING_SCENES=0, ESPALIER_BATCHES=0 and ESPALIER_C=0 leave out queries, and those that are made of
// them; a program that calls one does not link. Rays are always there.
// Profiles: ESPALIER_PLAIN_LEAVES=0 leaves out the code that reads profile `fast`, ESPALIER_STRIP_LEAVES=0 that of `balanced` and
// `small`, ESPALIER_PREDICTED_STRIPS=0 that of `tiny`. Optional sections: ESPALIER_IDS=0, ESPALIER_MATERIALS=0,
// ESPALIER_COPIES=0, ESPALIER_EDGES=0, ESPALIER_BOUNDS=0 and ESPALIER_DEFORMATION=0. Blobs with what is left out are refused by
// open.
// ESPALIER_SMALL_CODE=1 answers the same by less code, as on microcontrollers, where it is the default; 0 is fast.
// Recommended: -O2 -fno-exceptions -fno-rtti.
//
{licence}

// Answers are the same bits everywhere only if each operation is rounded by itself. The library is compiled with flags for
// that; this file has pragmas, before anything else, so that they also hold for what it includes. Clang ignores the pragma
// where its command line has -ffp-contract=fast: leave that out. What pays in lanes is written in lanes: GCC need not look for
// more.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
// In a header, Clang does not warn about functions that are not used.
#pragma clang diagnostic ignored "-Wunneeded-internal-declaration"
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off,no-tree-vectorize")
#endif

#include "espalier.hpp"

// What a game on a desktop needs.
#ifndef ESPALIER_SET_SSE42
#define ESPALIER_SET_SSE42 0
#endif
#ifndef ESPALIER_SET_AVX512
#define ESPALIER_SET_AVX512 0
#endif
#define ESPALIER_QUERY_OF_SET inline
{families}
"""


def licence():
    lines = (LIBRARY.parent / "LICENSE").read_text().splitlines()
    return "\n".join(("// " + line).rstrip() for line in lines)


def version():
    return re.search(r'library_version = "([^"]+)"', (LIBRARY / "espalier/espalier.hpp").read_text()).group(1)


def text_for(path, of_set):
    """The text of a file, of fragments for an instruction set: without its include guard, and with the set's region."""
    text = re.sub(r"^#define ESPALIER_(?:BEGIN|END)_SET(?:.*\\\n)+", lambda lines: re.sub(r"\s*\\\n\s*", " ", lines.group(0)),
                  path.read_text(), flags=re.MULTILINE)
    if not FRAGMENTS.search(text):
        return text
    text = FRAGMENTS.sub(r"\2", text)
    for name, value in of_set.items():
        text = re.sub(rf"\bESPALIER_{name}\b", re.sub(r" (?=namespace|ESPALIER|\})", r"\n", value), text)
    return text


def classify(path, of_set=SCALAR):
    """Each line with what it is: includes, condition, directive, opens or closes (a namespace) or code; and the match."""
    depth, namespaces, continued = 0, [], False
    for line in text_for(path, of_set).splitlines():
        if continued or line.lstrip().startswith("#"):
            kind, match = "directive", None
            if not continued:
                if match := INCLUDE.match(line):
                    kind = "includes"
                elif match := CONDITION.match(line):
                    kind = "condition"
            continued = line.endswith("\\")
            yield line, kind, match
            continue
        code = LITERAL.sub("", line)
        opened = NAMESPACE.match(line)
        if opened:
            namespaces.append(depth)
        depth += code.count("{") - code.count("}")
        closed = not opened and namespaces and depth == namespaces[-1] and code.strip() == "}"
        if closed:
            namespaces.pop()
        yield line, "opens" if opened else "closes" if closed else "code", opened
    if depth != 0 or namespaces:
        sys.exit(f"single_file.py: {path}: braces do not match; two branches of an #if may share one")


def declared_names(path, only_private=False):
    """Returns the types, functions and constants that a file declares. The code is formatted, so each begins a line. Private
    names are those in unnamed namespaces."""
    names, namespaces = set(), []
    for line, kind, match in classify(path):
        if kind == "opens":
            namespaces.append(match.group(1))
        elif kind == "closes":
            namespaces.pop()
        elif kind == "code" and ("" in namespaces or not only_private) and re.match(r"[A-Za-z\[]", line):
            line = re.sub(r"^(template <.*?>\s+(?=[\w\[])|\[\[.*?\]\]\s*)+", "", line)
            if found := re.match(r"(?:struct|class|enum class|enum|union)\s+(?:alignas\(\w+\)\s*)?(\w+)|using (\w+) =", line):
                names.add(found.group(1) or found.group(2))
            elif not re.match(r"(template|static_assert|using|public|private|protected)\b", line):
                if found := re.search(r"(\w+)(?:\(|\s*=|\{|\[|;)", line):
                    names.add(found.group(1))
    return names


def included_headers(path, found):
    """Adds the headers of the runtime that a file includes, also through others, to `found` and returns it."""
    for line, kind, match in classify(path):
        if line.startswith("#define ESPALIER_FRAGMENT "):
            kind, match = "includes", INCLUDE.match(line.replace("#define ESPALIER_FRAGMENT", "#include"))
        if kind == "includes" and match.group(1).startswith("runtime/") and match.group(1) not in found:
            found.add(match.group(1))
            included_headers(LIBRARY / match.group(1), found)
    return found


def words_of(path):
    return set(re.findall(r"\w+", LITERAL.sub("", path.read_text())))


class SingleFile:
    """One output: files are added, each with what it includes that is not there yet."""

    def __init__(self, skips_public_headers):
        self.skips_public_headers = skips_public_headers
        self.system_headers = set()
        self.lines = []
        self.conditions = []  # of the preprocessor, around the line that is being written
        self.namespaces = []  # around the same line
        self.written = collections.defaultdict(list)  # what, in which namespace: under which conditions
        self.of_set = {}  # what the instruction set at hand defines, and the fragments that it has of its own

    def namespace(self):
        return "::".join(name or "unnamed" for name in self.namespaces)

    def is_written(self, key):
        """Returns whether it is written already, under conditions that hold wherever those of this line do."""
        here = {part for condition in self.conditions for part in self.parts_of(condition)}
        return any(here.issuperset(conditions) for conditions in self.written[key])

    @staticmethod
    def parts_of(condition):
        """What holds where a condition does: of `if A && B` also `if A` and `if B`."""
        if condition.startswith("if ") and "||" not in condition:
            return [condition, *(f"if {part.strip()}" for part in condition[3:].split("&&"))]
        return [condition]

    def add_once(self, name, path, place=None):
        key = (name, place or self.namespace())
        if self.is_written(key):
            return
        # Elsewhere it may stand under a condition that is another one, and that may hold too.
        guard = None
        if self.conditions or self.written[key]:
            guard = re.sub(r"\W+", "_", "ESPALIER_SEEN_" + "_".join(key)).upper()
            self.lines += [f"#ifndef {guard}", f"#define {guard}"]
        self.written[key].append(list(self.conditions))
        self.add(path)
        if guard is not None:
            self.lines.append(f"#endif  // {guard}")

    def add(self, path, renamed=None, condition=None):
        """Appends the lines of a file. Names in `renamed` are replaced, unless a class or namespace qualifies them. What follows
        the first includes is compiled under the condition; those are for all that comes later."""
        self.lines.append(f"// ---- {path.relative_to(LIBRARY)}")
        definitions = []
        waits = condition is not None
        for line, kind, match in classify(path, self.of_set if "BEGIN_SET" in self.of_set else SCALAR):
            if of_set := OF_SET.match(line):
                name, value = of_set.group(2, 3)
                self.of_set.pop(name, None)
                if of_set.group(1) == "define":
                    self.of_set[name] = value or ""
                continue
            if line == "#include ESPALIER_FRAGMENT":
                kind, match = "includes", INCLUDE.match(f"#include {self.of_set['FRAGMENT']}")
            if waits and kind != "includes" and line.strip() and not line.startswith("//"):
                self.add_definitions(definitions)
                definitions = []
                waits = False
                self.lines.append(f"#if {condition}")
                self.conditions.append(f"if {condition}")
            if renamed:
                line = re.sub(r"(?<![\w.:>])(\w+)\b", lambda word: renamed.get(word.group(1), word.group(1)), line)
            if kind in ("code", "directive"):
                definitions.append(line)
                continue
            self.add_definitions(definitions)
            definitions = []
            if kind == "includes":
                self.include(match.group(1), line, path)
                continue
            if kind == "condition":
                self.follow(*match.group(1, 2))
            elif kind == "opens":
                self.namespaces.append(match.group(1))
            else:
                self.namespaces.pop()
            self.lines.append(line)
        self.add_definitions(definitions)
        if condition is not None:
            self.conditions.pop()
            self.lines.append(f"#endif  // {condition}")

    def add_definitions(self, lines):
        """Appends the lines between two includes. Definitions that files of one namespace repeat are written once."""
        text = "\n".join(line for line in lines if line.strip() and not line.lstrip().startswith("//"))
        text = text.replace("#pragma once", "").strip()
        if self.namespaces and text.strip("}"):
            key = (text, self.namespace())
            if self.is_written(key):
                return
            self.written[key].append(list(self.conditions))
        self.lines += [line for line in lines if line != "#pragma once"]

    def follow(self, directive, condition):
        if directive in ("if", "ifdef", "ifndef"):
            self.conditions.append(f"{directive} {condition}")
        else:
            before = self.conditions.pop()
            if directive != "endif":
                self.conditions.append(f"{directive} {condition} after {before}")

    def include(self, name, line, path):
        if name == "runtime/lanes/for_each_set.hpp":
            self.add(LIBRARY / name)
        elif name == "runtime/lanes/end_set.hpp":
            self.of_set = {"FRAGMENT": self.of_set.get("FRAGMENT")}
        elif name == "runtime/lanes/set.hpp":
            if "BEGIN_SET" not in self.of_set:
                self.include("runtime/lanes/scalar.hpp", line, path)
        elif name.startswith("runtime/") and (fragments := FRAGMENTS.search((LIBRARY / name).read_text())):
            region = self.of_set.get("BEGIN_SET", SCALAR["BEGIN_SET"])
            if fragments.group(1).removeprefix("ESPALIER_") not in self.of_set:
                self.add_once(name, LIBRARY / name, re.search(r"detail::\w+", region).group(0))
        elif name.startswith(("espalier/", "runtime/")):
            if name.endswith(".h"):
                self.lines.append(f'#include "{pathlib.PurePath(name).name}"')
            elif name.startswith("runtime/") or not self.skips_public_headers:
                self.add_once(name, LIBRARY / name)
        elif self.conditions:
            self.lines.append(line)
        elif self.namespaces:
            sys.exit(f"single_file.py: {path}: {name} is included inside a namespace")
        else:
            self.system_headers.add(name)

    def text(self, preamble):
        headers = "".join(f"#include <{name}>\n" for name in sorted(self.system_headers))
        body = re.sub(r"\n{3,}", "\n\n", "\n".join(self.lines))
        body = EMPTY_REGION.sub("", body)
        families = "".join(f"#ifndef ESPALIER_{name}\n#define ESPALIER_{name} 1\n#endif\n" for name in FAMILIES)
        return f"{preamble.format(version=version(), licence=licence(), families=families)}\n{headers}\n{body}\n"


def condition_of(path):
    """Returns the condition under which a file of lib/runtime is compiled, or None."""
    for pattern, families in FILES_OF_FAMILIES:
        if fnmatch.fnmatch(path, pattern):
            return " && ".join(f"ESPALIER_{family}" for family in families.split())
    return None


def make_header():
    header = SingleFile(skips_public_headers=False)
    for folder in ("espalier", "espalier/advanced", "espalier/batches", "espalier/scenes"):
        for path in sorted((LIBRARY / folder).glob("*.hpp")):
            if path.name != "bake.hpp":
                header.add_once(f"{folder}/{path.name}", path)
    return header.text(HEADER_PREAMBLE)


def make_c_header():
    """espalier.h, with the headers that it includes in place of its includes: each once, after those that it includes."""
    include = re.compile(r"^#include <(espalier/c/.*)>\n", re.MULTILINE)
    written, parts = set(), []

    def add(name):
        if name not in written:
            written.add(name)
            text = (LIBRARY / name).read_text()
            for other in include.findall(text):
                add(other)
            parts.append(include.sub("", text))

    text = (LIBRARY / "espalier/espalier.h").read_text()
    for name in include.findall(text):
        add(name)
    places = list(include.finditer(text))
    text = text[:places[0].start()] + "\n".join(parts) + text[places[-1].end():]
    return re.sub(r"\n{3,}", "\n\n", text)


def make_source():
    """Returns the source with private names made unique.

    A private name that included headers have too is one more overload of theirs, and is kept. Any other name is kept only
    if no other file uses it: else a call could find another function, or a variable could hide a constant."""
    runtime = LIBRARY / "runtime"
    files = sorted(runtime.rglob("*.cpp"))
    private = {path: declared_names(path, only_private=True) for path in files}
    users = collections.Counter(name for names in private.values() for name in names)
    everything = {path: words_of(path) for path in runtime.rglob("*.[chi][pn][pl]")}
    seen_by = {path: {LIBRARY / name for name in included_headers(path, set())} for path in files}
    known_to = {path: set().union(*(declared_names(header) for header in seen_by[path])) for path in files}
    source = SingleFile(skips_public_headers=True)
    # An overload in an unnamed namespace hides the headers' in what follows: files with such come last.
    for path in sorted(files, key=lambda path: bool(private[path] & known_to[path])):
        seen, known = seen_by[path], known_to[path]
        new = set().union(*(words for other, words in everything.items() if other != path and other not in seen))
        renamed = {name for name in private[path] if name not in known and (users[name] > 1 or name in new)}
        place = "_".join(path.relative_to(runtime).with_suffix("").parts)
        condition = condition_of(str(path.relative_to(runtime)))
        source.add(path, {name: f"{name}_of_{place}" for name in renamed}, condition)
    return source.text(SOURCE_PREAMBLE)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit("usage: single_file.py FOLDER: writes espalier.hpp, espalier.cpp and espalier.h there")
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "espalier.hpp").write_text(make_header())
    (folder / "espalier.cpp").write_text(make_source())
    (folder / "espalier.h").write_text(make_c_header())


main()
