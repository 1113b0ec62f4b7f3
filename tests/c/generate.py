"""generate.py FOLDER: writes what the tests of espalier.h repeat for each function and structure that its headers declare.

c99.c, c99.h: for each function one with c99_ in front, in C99, that calls it and returns what it returns.
layouts.inc:  assertions that each structure and enumeration of C is laid out as its twin in C++.
slots.inc:    a member of Pool for each structure, in which arguments and results lie.
tells.inc:    functions that log each field of a structure.
entries.cpp:  for each function a call from C, and one of its counterpart in C++, of the arguments in a pool.
"""
import re
import sys
from pathlib import Path

import counterparts
from declarations import in_cpp

LAST = "slots - 1"  # the slot of where a page begins
DIRECTIONS = {"displacement", "direction", "normal"}
SIZES = {"capacity": "p.capacity", "places": "p.places", "position_count": "p.given(p.position_count)"}
WORDS = {"mask": "p.mask", "mesh": "p.mesh", "slot": "p.slot", "directions": "p.bits % 9", "work_limit": "p.work_limit"}
NOT_TOLD = {"blob", "scene", "deformable", "moving_scene", "mesh_result"}  # hold addresses: a log tells what is there

PAIRS = counterparts.Pairs()
C = PAIRS.c
QUERIED = {name: fields for name, fields in C.structures.items() if name in PAIRS.twins}


def signature(function):
    return f"{function.result} c99_{function.name}({function.text or 'void'})"


def c99():
    yield "#include <c99.h>"
    for function in (C.functions | C.inline).values():
        names = ", ".join(name for _, name in function.parameters)
        call = f"espalier_{function.name}({names})"
        yield f"{signature(function)} {{ {'' if function.result == 'void' else 'return '}{call}; }}"
    yield "const size_t c99_layouts[] = {%s};" % ", ".join(layouts())


def c99_header():
    yield "#pragma once\n#include <espalier/c/bake.h>\n#include <espalier/espalier.h>"
    yield "#define LAYOUTS_ " + ", ".join(layouts())
    yield "#define STRUCTURES_ " + ", ".join(f'"{name}"' for name, header in C.headers.items() if header != "bake.h")
    yield "#define BAKING_STRUCTURES(of) " + " ".join(f"of({name})" for name, header in C.headers.items() if header == "bake.h")
    yield '#ifdef __cplusplus\nextern "C" {\n#endif'
    yield "extern const size_t c99_layouts[];"
    for function in (C.functions | C.inline).values():
        yield signature(function) + ";"
    yield "#ifdef __cplusplus\n}\n#endif"


def layouts():
    """The sizes and offsets of all structures."""
    for name, fields in C.structures.items():
        if fields:
            yield f"sizeof(espalier_{name})"
            for _, field in fields:
                yield f"offsetof(espalier_{name}, {field})"
                yield f"sizeof(((espalier_{name}*)0)->{field})"


def layout_assertions():
    for name, fields in QUERIED.items():
        if name in PAIRS.others | {"yes_no"} or any("opaque" in field for _, field in fields):  # the fields are private
            continue
        yield from (f"SAME_FIELD(espalier_{name}, {field.split('.')[0]});" for _, field in fields)
    for name, values in C.enumerations.items():
        cpp = in_cpp(name)
        if cpp in CPP_ENUMERATIONS:
            yield f"SAME_SIZE(espalier_{name}, {cpp});" if cpp not in ("Visit", "NodeVisit") else ""
            prefix = counterparts.common_prefix(values)
            yield from (f"SAME_VALUE({value}, {cpp}::{value.removeprefix(prefix).lower()});" for value in values)


def slots():
    for name in [*QUERIED, "triangle_id"]:
        yield f"espalier_{name} {name}[slots] = {{}};"


def tells():
    for name, fields in QUERIED.items():
        if name not in NOT_TOLD | {"ray_arrays", "sphere_arrays", "box_arrays"} and not any("*" in kind for kind, _ in fields):
            body = " ".join(f"tell(v.{field});" for kind, field in fields)
            yield f"void tell(const espalier_{name}& v) {{ {body} }}"


class Call:
    """The arguments of a call in C and in C++, which lie in a pool p."""

    def __init__(self, function, cpp):
        self.function, self.cpp, self.used, self.outputs = function, cpp, {}, []
        self.visits = any(kind.endswith("_visitor") for kind, _ in function.parameters)
        self.by_parameter = [self.argument(i) for i in range(len(function.parameters))]
        self.of_cpp = self.cpp_arguments()

    def size_after(self, i):
        """The size of the array that parameter i begins."""
        name = next((name for kind, name in self.function.parameters[i:] if kind == "size_t"), "")
        array = self.function.parameters[i][1]
        size = SIZES.get("position_count" if array == "positions" else name, "p.count")
        if array in ("bytes", "file"):
            return "p.room.size()" if self.function.parameters[i][0] == "void*" else "p.input.size()"
        return size + {"offsets": " + 1"}.get(array, " * p.count" if name == "places" else "")

    def argument(self, i):
        kind, name = self.function.parameters[i]
        base = re.sub(r"const |espalier_|[ *]", "", kind)
        if kind.startswith("espalier_") and base in C.callbacks:
            return f"p.callback<espalier_{base}>()"
        if kind == "size_t":
            array = max((k for k in range(i) if self.function.parameters[k][0].endswith("*")), default=0)
            return "p.bits % 8" if name == "number" else SIZES.get(name) or self.size_after(array).removesuffix(" + 1")
        if base == "void":
            return {"bytes": "p.room.data()" if kind == "void*" else "p.input.data()", "file": "p.input.data()"}.get(name, "&p")
        if kind == "size_t*" and name != "offsets":
            return "&p.found"
        if base in ("float", "uint32_t", "uint64_t") or base in C.enumerations:
            if kind == "espalier_query_status*":
                self.outputs.append("statuses")
                return self.listed("p.statuses", i)
            k = self.used[base] = self.used.get(base, -1) + 1
            return "p.rows" if "*" in kind else f"p.number[{k}]" if base == "float" else \
                "p.byte" if base in C.enumerations else WORDS.get(name, "p.bits")
        if base == "cursor" or name == "from" and base.endswith("pair"):
            return f"p.{base}[{LAST}]"
        k = self.used[base] = self.used.get(base, -1) + 1
        if base == "vec3":
            k = 2 * k + (name in DIRECTIONS)
        base = {"size_t": "offsets", "uint16_t": "materials"}.get(base, base)
        if "*" in kind and not kind.startswith("const") and base not in NOT_TOLD:
            self.outputs.append(base)
        if "*" not in kind:
            return f"p.{base}[{k}]"
        if self.is_array(i):
            return self.listed("p.positions" if name == "positions" else f"p.{base}", i)
        if "counters" in base and any(self.cpp.pointers):
            return f"p.optional(p.{base})"
        if base == "pair_filter":
            return f"p.optional(p.{base})"
        return f"&p.{base}[{k}]"

    def listed(self, array, i):
        return f"p.list({array}, {self.size_after(i)})"

    def is_array(self, i):
        """Whether C++ has a span for parameter i: as many pointers of C and parameters of C++ lie behind it."""
        base = re.sub(r"const |espalier_|[ *]", "", self.function.parameters[i][0])
        cpp = {"size_t": "size_t", "uint16_t": "uint16_t"}.get(base) or PAIRS.twins.get(base, base)
        same = [k for k, (kind, _) in enumerate(self.function.parameters)
                if re.sub(r"const |espalier_|[ *]", "", kind) == base]
        kinds = ([self.cpp.owner] if self.cpp.owner and not self.cpp.is_static else []) + self.cpp.types
        kinds = [kind for kind in kinds if kind in (cpp, f"span<{cpp}>")]
        return bool(kinds) and kinds[same.index(i)].startswith("span")

    def cpp_arguments(self):
        """An expression for each parameter of C++, which takes one or more of C."""
        left = [i for i, (kind, name) in enumerate(self.function.parameters)
                if kind != "size_t" and self.by_parameter[i] not in ("&p", "&p.found")]
        kinds = list(zip(self.cpp.types, self.cpp.pointers))
        if self.cpp.owner and not self.cpp.is_static:
            kinds.insert(0, (self.cpp.owner, False))
        for kind, is_pointer in kinds:
            if kind == "size_t":
                yield "p.bits % 8"
            elif left:
                taken = [left.pop(0) for _ in range(2 if kind in ("SceneFilter", "SceneSweepOptions") else 1)]
                yield self.cpp_argument(kind, is_pointer, taken)

    def cpp_argument(self, kind, is_pointer, taken):
        expressions = ", ".join(self.by_parameter[i] for i in taken)
        in_c = self.function.parameters[taken[0]][0]
        if re.match("Visitor|TriangleVisitor", kind):
            return f"Visits<Visit, {in_c}>{{{expressions}, &p}}"
        if kind.startswith("FunctionRef"):
            return f"Visits<NodeVisit, {in_c}>{{{expressions}, &p}}"
        if kind == "TriangleFilter":
            return f"Keeps<{in_c}>{{{expressions}, &p}}"
        if kind == "SceneFilter":
            mask, keep = expressions.split(", ")
            return f"SceneFilter({mask}, Keeps<espalier_scene_filter>{{{keep}, &p}})"
        if kind.startswith("span<"):
            element = kind[5:-1].replace("size_t", "std::size_t").replace("byte", "std::byte")
            const = "const " if in_c.startswith("const") else ""
            return f"spanned<{const}{element}>({expressions}, {self.size_after(taken[0])})"
        if kind == "float" and "*" in in_c:
            return f"rows_of({expressions})"
        return f"{'pointer_to' if is_pointer else 'to'}<{kind}>({expressions})"

    def entry(self, label):
        name = self.function.name
        in_c = f"c99_{name}({', '.join(self.by_parameter)})"
        arguments = list(self.of_cpp)
        method = self.cpp.owner and not self.cpp.is_static
        in_cpp_ = f"{arguments[0]}.{self.cpp.name}({', '.join(arguments[1:])})" if method else \
            f"espalier::{self.cpp.owner + '::' if self.cpp.owner else ''}{self.cpp.name}({', '.join(arguments)})"
        result, told = self.function.result, "".join(f" p.tell_all(p.{name});" for name in self.outputs)
        if result == "void":
            calls = [in_c + ";", in_cpp_ + ";"]
        elif "&p.found" in in_c:
            calls = [f"p.tell_list({in_c});", f"p.tell_list({in_cpp_});"]
        else:
            calls = [f"p.tell_result({in_c});", f"p.tell_result(from_cpp<{result}>({in_cpp_}));"]
        if self.visits:
            calls[1] = f"if (p.nothing) p.tell_result(std::uint8_t{{ESPALIER_QUERY_INVALID_ARGUMENT}}); else {calls[1]}"
        pages = "true" if LAST in in_c else "false"
        return (f'{{"{name}{label[1]}", Takes::{label[0]}, {pages}, [](Pool& p) {{ {calls[0]}{told} }}, '
                f"[](Pool& p) {{ {calls[1]}{told} }}}},")


def takes(function):
    first = function.parameters[0][0] if function.parameters else ""
    if "moving_scene" in first:
        return "changes" if function.name.startswith("moving_scene_") and "const" not in first else "moving"
    return next((name for name in ("scene", "deformable") if f"espalier_{name}" in first), "blob")


def entries():
    yield '#include "pool.hpp"\n\nnamespace espalier::tests {\nconst std::vector<Entry> entries = {'
    for name, function in (C.functions | C.inline).items():
        if PAIRS.of.get(name):
            yield Call(function, PAIRS.of[name]).entry((takes(function), ""))
        if PAIRS.of_moving.get(name):
            entry = Call(function, PAIRS.of_moving[name]).entry(("moving", " of a moving scene"))
            view, scene = "&p.scene[0]", "&p.moving_scene[0]"
            in_c, in_moving = entry.split("}, [](Pool& p)")
            yield in_c.replace(view, "&p.scene[1]") + "}, [](Pool& p)" + in_moving.replace(view, scene)
    yield "};\n}  // namespace espalier::tests"


CPP_ENUMERATIONS = {"OpenStatus", "QueryStatus", "Feature", "Visit", "Profile", "EdgeKind", "FaceCulling", "NodeVisit", "Side"}

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for file, lines in {"c99.c": c99(), "c99.h": c99_header(), "layouts.inc": layout_assertions(), "slots.inc": slots(),
                        "tells.inc": tells(), "entries.cpp": entries()}.items():
        (folder / file).write_text("\n".join(lines) + "\n")
