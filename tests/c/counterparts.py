"""Pairs each function of the headers of C with the one of C++ that it forwards to, by its name and parameters.

`counterparts.py TESTS...` fails where a language has what the other one lacks, and where no test calls a function.
"""
import re
import sys
from pathlib import Path

import declarations

# Functions of C++ without counterpart: of types that C lays out as structures, and internals.
ONLY_IN_CPP = set("""
    Deformable::create(Blob, byte)  Filled::in(auto)  FilledPairs::in(auto)  PlacedBlob::blob()  PlacedBlob::transform()
    QueryCounters::count_node()  QueryCounters::count_leaf(unsigned)
    QueryCounters::count_candidates(unsigned)  PairCounters::count_leaves(unsigned, unsigned)
    RayArrays::at(size_t)  RayArrays::from(size_t)  SphereArrays::at(size_t)  SphereArrays::from(size_t)
    BoxArrays::at(size_t)  BoxArrays::from(size_t)  Strided::at(size_t)  Strided::from(size_t)
    RoundedRay::data()  RoundedRay::RoundedRay(QueryStatus)  SceneFilter::mask()  SceneFilter::keep()
    WorkLimit::unlimited()  WorkLimit::visits()  YesNo::of(bool)  YesNo::value_or(bool)  YesNo::status()
""".split("  "))
ONLY_IN_CPP = {name.strip() for name in ONLY_IN_CPP}
# What C has instead of C++ constructors, defaults and conversions. Tests call it one by one.
BY_HAND = {"version": "", "abi": "", "size_of": "", "default_ray": "", "identity": "", "moving_scene_is_open": "",
           "moving_scene_view": "", "moving_scene_seen_from": "seen_from(MovingScene, Vec3d)", "open": "open(span<byte>)", "open_unchecked": "open_unchecked(span<byte>)",
           "open_scene": "open_scene(span<byte>, span<Blob>, span<BakedScene>)",
           "create_deformable": "create_deformable(Blob, span<byte>)",
           "create_moving_scene": "create_moving_scene(span<byte>, uint32_t, int, span<Blob>, span<BakedScene>)",
           "open_moving_scene": "open_moving_scene(span<byte>, span<Blob>, span<BakedScene>)"}
# Names in C that do not contain those of C++.
OTHER_NAMES = {"scene_mesh_count": "mesh_count_of_scene", "scene_tile_count": "tile_count_of_scene",
               "moving_scene_instance_of_id": "instance_at", "moving_scene_block": "bytes"}
EXPANDED = {"SceneFilter": ["uint32_t", "filter"], "SceneSweepOptions": ["uint32_t", "SceneSweepOptions"],
            "Accuracy": ["float"], "WorkLimit": ["uint64_t"], "unsigned": ["uint32_t"], "TriangleFilter": ["filter"],
            "TriangleVisitor": ["visit"], "size_t": []}


def twins():
    """Returns the C++ name of each structure of C, as abi.hpp lists them, and which have another layout."""
    text = (declarations.LIBRARY.parent / "runtime/c/abi.hpp").read_text()
    shapes = (declarations.LIBRARY / "c/shapes.h").read_text()
    pattern = r"(twin|other|apply|TWIN)\((\w+), ([\w<>]+)\)"
    found = re.findall(pattern, text + shapes)
    return {name: cpp for _, name, cpp in found}, {name for kind, name, _ in found if kind == "other"}


class Pairs:
    def __init__(self):
        self.c, self.cpp = declarations.C(), declarations.cpp_functions()
        self.twins, self.others = twins()
        self.of = {}  # of each function of C, the one of C++
        for function in (self.c.functions | self.c.inline).values():
            if not function.is_baker and function.name not in BY_HAND:
                self.of[function.name] = self.counterpart(function, self.tokens(function))
        self.of_moving = {}  # and of those of a scene, the one of a moving scene
        for name, function in self.c.functions.items():
            tokens = self.tokens(function)
            if tokens[:1] == ["BakedScene"] and "uint32_t" in tokens:  # a query, which takes a mask
                self.of_moving[name] = self.counterpart(function, ["MovingScene"] + tokens[1:])

    def tokens(self, function):
        """Returns what the parameters of C are in C++, without sizes and what is passed to callbacks."""
        found = []
        for kind, _ in function.parameters:
            kind = re.sub(r"const |espalier_|\*", "", kind)
            if kind in self.c.callbacks:
                found.append("visit" if kind.endswith("visitor") else "filter")
            elif kind == "void":
                found += ["byte"] if "bytes" in function.text or "file" in function.text else []
            elif kind != "size_t":
                found.append(self.twins.get(kind) or
                             (declarations.in_cpp(kind) if kind in self.c.enumerations else kind))
        return found

    def counterpart(self, function, wanted):
        """Returns the function of C++ with the same parameters, or with defaults for those that C leaves out."""
        name, best = OTHER_NAMES.get(function.name, function.name), None
        for cpp in self.cpp.values():
            tokens = cpp_tokens(cpp)
            required = len(cpp_tokens(cpp, cpp.required))
            if re.search(rf"(^|_){cpp.name}(_|$)", name) and required <= len(wanted) and tokens[:len(wanted)] == wanted:
                rank = (len(tokens) == len(wanted), len(cpp.name))
                if best is None or rank > best[0]:
                    best = (rank, cpp)
        return best and best[1]


def cpp_tokens(function, count=None):
    tokens = [] if function.owner == "" or function.is_static else [function.owner]
    for kind in function.types[:count]:
        kind = re.sub(r"^span<(.*)>$", r"\1", kind)
        tokens += ["visit"] if re.match("Visitor|FunctionRef", kind) else EXPANDED.get(kind, [kind])
    return tokens


def main(tests):
    pairs = Pairs()
    wrong = [f"espalier_{name} is the counterpart of nothing" for name, cpp in pairs.of.items() if cpp is None]
    met = {str(cpp) for cpp in [*pairs.of.values(), *pairs.of_moving.values()]} | set(BY_HAND.values()) | ONLY_IN_CPP
    wrong += [f"{name} has no counterpart" for name in pairs.cpp if name not in met]
    wrong += [f"no header declares {name}" for name in sorted(met) if name not in pairs.cpp and name not in ("", "None")]
    text = "".join(Path(test).read_text() for test in tests)
    wrong += [f"no test calls c99_{name}" for name, function in pairs.c.functions.items()
              if (function.is_baker or name in BY_HAND) and not re.search(rf"\bc99_{name}\b", text)]
    code = " ".join(declarations.plain(header.read_text()) for header in declarations.LIBRARY.rglob("*.hpp")
                    if header.name not in ("bake.hpp", "import.hpp"))
    for name, body in re.findall(r"enum class (?:\[\[nodiscard\]\] )?(\w+) : std::uint8_t ?\{(.*?)\}", code):
        in_c = [values for c, values in pairs.c.enumerations.items() if declarations.in_cpp(c) == name]
        values = re.findall(r"\w+", re.sub(r"= \d+", "", body))
        prefix = common_prefix(in_c[0]) if in_c else ""
        wrong += [f"espalier/c lacks {name}::{value}" for value in values if prefix + value.upper() not in sum(in_c, [])]
    for line in wrong:
        print(line)
    if len(pairs.of) < 200 or len(pairs.cpp) < 250:
        wrong.append("too few functions are found")
    print(f"{len(pairs.of)} functions of C have counterparts")
    return 1 if wrong else 0


def common_prefix(enumerators):
    """ESPALIER_OPEN_ of ESPALIER_OPEN_OK and ESPALIER_OPEN_TOO_SHORT."""
    low, high = min(enumerators), max(enumerators)
    count = next(i for i, (a, b) in enumerate(zip(low, high)) if a != b)
    return low[:low.rindex("_", 0, count) + 1]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
