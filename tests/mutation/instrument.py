#!/usr/bin/env python3
"""instrument.py SOURCE TARGET LIST: writes a copy of lib with every mutant in it (mutants.hpp), and the list of them.
instrument.py --check SOURCE: only checks that each excuse in lib (excuses.py) is about a mutant that exists.

Patterns, not a parser: operators are told from templates and references by the blanks that clang-format puts around them.
Each file has numbers of its own, so that a change of one file leaves what is made of the others as it is.
"""
import hashlib
import json
import pathlib
import re
import sys

import excuses

# What is mutated until each survivor has an excuse. Every other file of lib that the programs here run is a part with
# the files of its folder: what survives there is reported, and needs none.
EXCUSED_PARTS = {
    "verifier": [
        "runtime/open/open.cpp", "runtime/open/checks.hpp", "runtime/open/header.cpp", "runtime/open/leaves.cpp"],
    "decode": [
        "runtime/base/bits.hpp", "runtime/blob/node.hpp", "runtime/blob/plain_leaf.hpp",
        "runtime/blob/strip_leaf.hpp", "runtime/blob/predicted_strip_leaf.cpp",
        "runtime/blob/vertex_word.hpp", "runtime/blob/duplicate_references.hpp",
        "runtime/blob/id_steps.hpp", "espalier/format/leaves.hpp", "espalier/format/nodes.hpp",
        "espalier/format/sections.hpp", "runtime/lanes/scalar.hpp", "runtime/lanes/axes.inl",
        "runtime/lanes/leaves.inl", "runtime/lanes/strip_corners_portable.inl", "runtime/rays/leaf_filter.hpp"],
    "quantiser": [
        "baker/quantise/lattice.hpp", "baker/quantise/lattice.cpp", "baker/error/fit_lattice.cpp",
        "baker/quantise/snap.cpp", "baker/base/float_rounding.hpp",
        "baker/encode/tree.cpp", "baker/encode/packed_node.cpp", "baker/encode/plain_node.cpp",
        "baker/encode/plain_leaf.cpp", "baker/encode/strip_leaf.cpp", "baker/encode/predicted_strip_leaf.cpp",
        "baker/collapse/numbered_entries.hpp", "baker/collapse/predicted_strip.cpp", "baker/quantise/closed.cpp"],
    "traversal": [
        "runtime/traversal/traverse.hpp", "runtime/rays/slab_test.hpp",
        "runtime/traversal/node_boxes.hpp", "runtime/lanes/prepared_ray.hpp",
        "runtime/traversal/box_nodes.hpp", "runtime/proximity/point_nodes.hpp", "runtime/proximity/point_bounds.hpp",
        "runtime/pairs/nodes.hpp", "runtime/pairs/trees.hpp", "runtime/pairs/walk.hpp"],
    "rounding": [
        "runtime/lattice/round_ray.hpp", "runtime/lattice/round_point.hpp", "runtime/lattice/rounder.hpp",
        "runtime/lattice/to_local.hpp", "runtime/rays/rounded_ray.cpp", "runtime/lattice/rounding.cpp",
        "runtime/sweeps/rounding.cpp"],
    "small": [
        "runtime/rays/small_code/seen_ray.hpp", "runtime/rays/small_code/seen_boxes.hpp",
        "runtime/traversal/small_boxes.hpp"],
    "queries": [
        "runtime/rays/answers.hpp", "runtime/rays/single.hpp", "runtime/answers/best_k.hpp",
        "runtime/rays/batch/group.hpp", "runtime/rays/batch/groups.hpp",
        "runtime/answers/found.hpp", "runtime/answers/answer.hpp", "runtime/traversal/query.hpp",
        "runtime/traversal/find.hpp", "runtime/proximity/point_search.hpp", "runtime/pairs/search.hpp",
        "runtime/pairs/beam.hpp", "runtime/traversal/walk.cpp", "runtime/traversal/find_triangle.cpp",
        "runtime/asset/original.cpp", "runtime/asset/remap.cpp",
        "runtime/rays/small_code/queries.cpp"],
    "scenes": [
        "runtime/scenes/open.cpp", "runtime/scenes/instances.cpp", "runtime/scenes/instances.hpp",
        "runtime/lattice/region.hpp"],
    "ids": ["baker/encode/id_kinds.hpp", "baker/encode/id_kinds.cpp", "baker/encode/ids.cpp"],
    "edges": ["baker/base/edge_table.hpp"],
    "moving": ["runtime/moving_scenes/check.cpp", "runtime/moving_scenes/changes.cpp"],
    "deformation": [
        "runtime/deformation/deformable.cpp", "runtime/deformation/place_vertices.hpp",
        "runtime/deformation/pose_axis.hpp", "runtime/deformation/refit.cpp",
        "runtime/blob/tree_cost.hpp", "runtime/blob/deformable_blob.hpp",
        "baker/deformation/motion.cpp", "baker/input/check_deformation.cpp", "baker/deformation/steered_tree.cpp",
        "baker/encode/motion.cpp"],
}
# Only one instruction set runs these: the programs here have one lane, four and the code for microcontrollers, and other
# tests compare all sets.
SINGLE_SETS = re.compile(r"runtime/(lanes/((avx2|avx512|neon|simd128|sse42|select)\.hpp|predicted_points\.inl)"
                         r"|rays/slab_test_avx2\.hpp)")

LIBRARIES = ("runtime", "baker", "espalier")
NUMBERS_OF_A_FILE = 1000
FALSE_BY = {"&&": ("(::mutation::on(%d) || (", "))"), "||": ("(!::mutation::on(%d) && (", "))")}
OPERATORS = {
    "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!=", "true"], "!=": ["==", "true"],
    "+": ["-", "right side dropped"], "-": ["+", "right side dropped"],
    "<<": ["one more", "one less"], ">>": ["one more", "one less"]}


def blank(text, patterns):
    """The text with what matches a pattern made blanks, each other character in its place."""
    for pattern in patterns:
        text = re.sub(pattern, lambda match: re.sub(r"[^\n]", " ", match.group(0)), text, flags=re.MULTILINE)
    return text


def without_comments(text):
    text = re.sub(r'"(?:[^"\\\n]|\\.)*"', lambda match: "$" * len(match.group(0)), text)
    return blank(text, (r"//[^\n]*", r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*"))


def blanked(text):
    """The text with comments, literals and what cannot be mutated made blanks."""
    return blank(without_comments(text), (
        r"static_assert\([^;]*;",
        r"constexpr [\w:<>, ]+? \w+ = \[\][^}]*?(?:\}[^}(]*?)*\}\(\);",  # a table that the compiler fills
        r"constexpr [\w:<>, ]+? \w+(?:\[[^\]\n]*\])* =[^;]*;", r"template <[^\n]*", r"^using [^;]*;", r"if constexpr \([^\n]*",
        r"std::conditional_t<[^\n]*",
        r"alignas\(\w+\)", r"__asm__[^;]*;",
        r"^[ \t]*(?!return )(?:const )?[\w:<>]+ \w+(?:\[[^\]\n]*\])+(?: = \{[^}\n]*\})?;[ ]*$"))


def last_semicolon(text):
    """Behind the last one outside of brackets; 0 where there is none."""
    depth, found = 0, 0
    for i, character in enumerate(text):
        depth += (character in "([{") - (character in ")]}")
        if character == ";" and depth == 0:
            found = i + 1
    return found


STOPS = re.compile(r"&& |\|\| |&&\n|\|\|\n|[;,?]| : |[^=!<>]= |return ")


def end_of_term(text, at, stops):
    """Where the bracket around `at` is closed, or the first place outside of further brackets at which stops(place) is true."""
    depth = 0
    for i in range(at, len(text)):
        if text[i] in "([{":
            depth += 1
        elif text[i] in ")]}":
            if depth == 0:
                return i
            depth -= 1
        elif depth == 0 and stops(i):
            return i
    return len(text)


def term_left(text, at):
    depth, i = 0, at - 1
    while i >= 0:
        if text[i] in ")]}":
            depth += 1
        elif text[i] in "([{":
            if depth == 0:
                return i + 1
            depth -= 1
        elif depth == 0:
            if text[i] in ";,?" or text.startswith(" : ", i) or text.startswith(("&& ", "|| ", "&&\n", "||\n"), i):
                return i + (1 if text[i] in ";,?" else 3)
            if text[i] == "=" and text[i - 1] not in "=!<>" and text[i + 1] in " \n":
                return i + 1
            if text.startswith("return ", i):
                return i + 7
        i -= 1
    return 0


class Source:
    def __init__(self, path, name, part, first_number):
        self.text = path.read_text()
        self.code = blanked(self.text)
        self.name, self.part, self.first_number = name, part, first_number
        self.spans, self.points, self.mutants = [], [], []

    def add(self, at, what):
        line = self.text.count("\n", 0, at) + 1
        number = self.first_number + len(self.mutants)
        self.mutants.append({"number": number, "nth": len(self.mutants), "part": self.part, "file": self.name, "line": line,
                             "change": what, "at": at, "text": self.text.split("\n")[line - 1].strip()})
        return number

    def wrap(self, start, end, before, after, what):
        while self.code[start] in " \n":
            start += 1
        while self.code[end - 1] in " \n":
            end -= 1
        self.spans.append((start, end, before % self.add(start, what), after))

    def is_no_answer(self, at):
        """Whether a text is put together here, or memory fetched ahead: what a message says is no answer. Or whether the
        compiler must have these numbers, since an instruction contains them."""
        start = max(self.code.rfind(mark, 0, at) for mark in ";{}")
        ends = [end for end in (self.code.find(mark, at) for mark in ";{}") if end >= 0]
        statement = self.code[start + 1:min(ends, default=len(self.code))]
        return "$" in statement or "prefetch(" in statement or "SHUFFLE_VECTOR(" in statement

    def instrument(self):
        code = self.code
        for match in re.finditer(r"(?<=[\w)\]}]) (<|<=|>|>=|==|!=|\+|-|<<|>>)(?=[ \n])", code):
            op = match.group(1)
            if op in "+-<" and self.is_no_answer(match.start(1)):
                continue
            number = self.add(match.start(1), f"{op} -> {OPERATORS[op][0]}")
            self.add(match.start(1), f"{op} -> {OPERATORS[op][1]}")
            self.points.append((match.end(1), f" ::mutation::Between<{number}>{{}} {op}"))
        seen = set()
        for match in re.finditer(r"(?<=[\w)\]}]) (&&|\|\|)(?=[ \n])", code):
            op = match.group(1)
            for start, end in ((term_left(code, match.start()), match.start()),
                               (match.end(), end_of_term(code, match.end(), lambda i: STOPS.match(code, i) and code[i] != "="))):
                if (start, end) not in seen:
                    seen.add((start, end))
                    self.wrap(start, end, *FALSE_BY[op], f"without '{' '.join(self.text[start:end].split())}'")
        for match in re.finditer(r"\bif \(", code):
            end = end_of_term(code, match.end(), lambda i: False)
            start = match.end()
            condition = code[start:end]
            if initialised := last_semicolon(condition):
                start += initialised
            elif re.search(r"[^=!<>]= ", condition) or "prefetch(" in code[end:code.index("\n", end)]:
                continue
            self.wrap(start, end, "!::mutation::on(%d) && (", ")", "never: " + " ".join(self.text[start:end].split()))
        for match in re.finditer(r"(?<=[\w)\]]) (\+=|-=|\|=|&=)(?=[ \n])", code):
            op = match.group(1)
            if self.is_no_answer(match.start(1)):
                continue
            by = "everything" if op == "&=" else "nothing"
            end = end_of_term(code, match.end(), lambda i: code[i] in ",;")
            self.wrap(match.end(), end, f"::mutation::{by}<%d>(", ")", f"{op} {by}")
        for match in re.finditer(r"std::(min|max)(?=\()", code):
            other = "most" if match.group(1) == "max" else "least"
            number = self.add(match.start(), "other of min and max")
            self.points.append((match.start(), f"::mutation::{other}<{number}>", match.end()))
        swaps = {"minimum": "maximum", "maximum": "minimum", "smaller": "larger", "larger": "smaller"}
        for match in re.finditer(r"(?:(?<=[(=,?:n] )|(?<=\())(minimum|maximum|smaller|larger)(?=\()", code):
            name = match.group(1)
            number = self.add(match.start(), f"{name} -> {swaps[name]}")
            self.points.append((match.start(), "[&](auto a_, auto b_) { return ::mutation::on(%d) ? %s(a_, b_) : %s(a_, b_); }"
                                % (number, swaps[name], name), match.end()))
        self.excuse()
        return self.written()

    def excuse(self):
        try:
            excuses.excuse_mutants(self.text, without_comments(self.text), self.mutants)
        except excuses.WrongExcuse as wrong:
            raise SystemExit(f"lib/{self.name}:{wrong}")

    def written(self):
        before, after, replaced = {}, {}, {}
        for start, end, opening, closing in self.spans:
            before.setdefault(start, []).append((-end, opening))
            after.setdefault(end, []).append((-start, closing))
        for point in self.points:
            at, text = point[0], point[1]
            replaced[at] = (text, point[2] if len(point) == 3 else at)
        out, i = [], 0
        while i <= len(self.text):
            out += [closing for _, closing in sorted(after.get(i, []), key=lambda x: x[0])]
            out += [opening for _, opening in sorted(before.get(i, []), key=lambda x: x[0])]
            if i in replaced:
                text, end = replaced[i]
                out.append(text)
                if end > i:
                    i = end
                    continue
            out.append(self.text[i:i + 1])
            i += 1
        return "".join(out)


def filled_at_start(text):
    """A table that the compiler fills is filled when the program starts: then it has mutants too."""
    text = text.replace("inline constexpr std::array<PlaneOrder, 8>", "inline const std::array<PlaneOrder, 8>")
    return text.replace("std::array<PlaneOrder, 8> orders{};",
                        "std::array<PlaneOrder, 8> orders{}; const int no_constant = ::mutation::active;")


def version_of(text):
    """The same for two texts of a file that differ in comments and blanks alone."""
    code = re.sub(r"//[^\n]*", "", text)
    return hashlib.sha256("".join(code.split()).encode()).hexdigest()[:16]


def parts_of(folder):
    """The files of each part, by its name."""
    parts = {part: list(names) for part, names in EXCUSED_PARTS.items()}
    named = {name for names in parts.values() for name in names}
    for path in sorted(path for library in LIBRARIES for path in (folder / library).rglob("*.*")):
        name = path.relative_to(folder)
        if path.suffix in (".cpp", ".hpp", ".inl") and str(name) not in named and not SINGLE_SETS.fullmatch(str(name)):
            parts.setdefault(str(name.parent), []).append(str(name))
    return parts


def sources(folder):
    """Every file that has mutants, with its mutants."""
    names = ((part, name) for part, names in parts_of(folder).items() for name in names)
    for number, (part, name) in enumerate(names):
        file = Source(folder / name, name, part, number * NUMBERS_OF_A_FILE)
        text = filled_at_start(file.instrument())
        assert len(file.mutants) <= NUMBERS_OF_A_FILE
        for mutant in file.mutants:
            mutant["version"] = version_of(file.text)
        yield file, text


def check(folder):
    files = {file.name for file, _ in sources(folder)}
    for path in sorted(folder.rglob("*.*")):
        name = str(path.relative_to(folder))
        if name not in files and re.search(r"^[ \t]*// mutant\(", path.read_text(), re.MULTILINE):
            raise SystemExit(f"lib/{name}: a mutant is excused, but this file is not mutated")


def main():
    if sys.argv[1] == "--check":
        return check(pathlib.Path(sys.argv[2]))
    source, target, listing = map(pathlib.Path, sys.argv[1:4])
    mutants = []
    for file, text in sources(source):
        (target / file.name).write_text(text)
        mutants += file.mutants
    listing.write_text("\n".join(json.dumps(mutant) for mutant in mutants) + "\n")


if __name__ == "__main__":
    main()
