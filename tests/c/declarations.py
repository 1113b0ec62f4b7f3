"""Reads the declarations of lib/espalier: structures, enumerations, callbacks and functions of C, and functions of C++."""
import re
from pathlib import Path

LIBRARY = Path(__file__).resolve().parents[2] / "lib/espalier"
# Headers of C++ without queries: the baker's, the bytes of a blob, a type of parameters.
CLASS, BASE = r"\b(?:class|struct) (?:\[\[\w+\]\] )?", r"(?:: public \w+ )?"
OTHER_HEADERS = {"bake.hpp", "format.hpp", "function_ref.hpp", "import.hpp"}


def plain(text):
    """Without comments, preprocessor lines and unneeded blanks."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M))


def in_cpp(name):
    """oriented_box as OrientedBox."""
    return "".join(word.capitalize() for word in name.split("_"))


def split(parameters):
    """At the commas that are in no brackets."""
    parts, depth = [""], 0
    for c in parameters:
        depth += (c in "(<[{") - (c in ")>]}")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip() not in ("", "void")]


class CFunction:
    def __init__(self, result, name, parameters, is_baker):
        self.result, self.name, self.is_baker, self.text = result.strip(), name, is_baker, parameters
        self.parameters = [re.fullmatch(r"(.*?[ *])(\w+)(?:\[\d*\])?", p).groups() for p in split(parameters)]
        self.parameters = [(kind.strip() + ("*" if "[" in text else ""), name)
                           for (kind, name), text in zip(self.parameters, split(parameters))]


class C:
    """What the headers of C declare. Names are without espalier_ in front."""

    def __init__(self):
        self.structures, self.enumerations, self.callbacks, self.functions, self.inline = {}, {}, {}, {}, {}
        self.headers, self.bodies = {}, {}  # of structures
        for header in sorted((LIBRARY / "c").rglob("*.h")):
            code = plain(header.read_text())
            is_baker = header.name == "bake.h"
            for name, body in re.findall(r"typedef struct (?:ESPALIER_\w+ )?espalier_(\w+) \{ (.*?) \} espalier_\1;", code):
                if name != "abi_sizes":
                    self.structures[name], self.headers[name] = list(fields(body)), header.name
                    self.bodies[name] = body
            for name, body in re.findall(r"typedef \w+ espalier_(\w+); enum \{(.*?)\}", code):
                self.enumerations[name] = re.findall(r"(\w+) = \d+", body)
            for name, parameters in re.findall(r"typedef \S+\*? ?\(\*espalier_(\w+)\)\((.*?)\);", code):
                self.callbacks[name] = parameters
            declared = re.sub(r"typedef [^{};]*\{.*?\} espalier_\w+;|typedef [^;{]*;|static inline[^}]*\}", "", code)
            for result, name, parameters in re.findall(r"(?<=[;{}] )([\w *]+?)\bespalier_(\w+)\(([^()]*)\);", declared):
                self.functions[name] = CFunction(result, name, parameters, is_baker)
            for result, name, parameters in re.findall(r"static inline (\w+) espalier_(\w+)\(([^()]*)\)", code):
                self.inline[name] = CFunction(result, name, parameters, is_baker)


def fields(body):
    """Yields the type and the name of each field: of a structure without a name its fields' names after a dot."""
    inner = re.match(r"struct \{ (.*?) \} (\w+); ?(.*)", body)
    if inner:
        yield from ((kind, f"{inner[2]}.{name}") for kind, name in fields(inner[1]))
        body = inner[3]
    for declaration in filter(None, (part.strip() for part in body.split(";"))):
        kind, names = re.fullmatch(r"((?:const |unsigned )?\w+[ *]+)(.*)", declaration).groups()
        yield from ((kind.strip(), re.sub(r"\[.*", "", name).strip(" *")) for name in names.split(","))


class CppFunction:
    def __init__(self, name, owner, parameters, is_static, header):
        self.name, self.owner, self.is_static, self.header = name, owner, is_static, header
        self.types, self.pointers, self.required = [], [], 0
        for parameter in parameters:
            kind, _, default = parameter.partition("=")
            self.pointers.append("*" in kind)
            kind = re.sub(r"\bconst |std::|[&*]|\bESPALIER_\w+", "", kind).strip()
            self.types.append(re.sub(r" \(?\w+\)?(\[.*)?$", "", kind).strip())
            if not default:
                self.required = len(self.types)

    def __str__(self):
        return f"{self.owner}::{self.name}({', '.join(self.types)})".removeprefix("::")

    def in_shape(self, template, shape):
        copy = CppFunction(self.name, self.owner, [], self.is_static, self.header)
        copy.types = [re.sub(rf"\b{template}\b", shape, kind) for kind in self.types]
        copy.pointers, copy.required = self.pointers, self.required
        return copy


def closed(code, begin, brackets="()"):
    """Where a bracket that is opened before a place is closed."""
    depth = 1
    while depth:
        depth += (code[begin] == brackets[0]) - (code[begin] == brackets[1])
        begin += 1
    return begin


def without(code, pattern):
    """Without what a pattern begins and a brace ends."""
    while found := re.search(pattern, code):
        code = code[:found.start()] + code[closed(code, found.end(), "{}"):]
    return code


def cpp_functions():
    """Returns the functions of the C++ headers, those of templates once for each shape that they take."""
    headers = [header for folder in ("", "advanced", "scenes", "batches") for header in sorted((LIBRARY / folder).glob("*.hpp"))
               if header.name not in OTHER_HEADERS]
    texts = {header: without(plain(header.read_text()), r"namespace detail \{") for header in headers}
    concepts = {name: re.findall(r"same_as<Shape, (\w+)>", text)
                for name, text in re.findall(r"concept (\w+) = (.*?);", " ".join(texts.values()))}
    found = {}
    for header, code in texts.items():
        for owner, body in [("", code)] + classes(code):
            scope = without(body, CLASS + r"(?:\w+ )?" + BASE + r"\{")
            for function in functions_in(scope, owner, header, concepts):
                for each in of_scenes(function):
                    found[str(each)] = each
    return found


def of_scenes(function):
    """A query of a SceneView once for each kind of scene, and a member of SceneView as that of BakedScene, which has it too."""
    if function.owner == "SceneView":
        function.owner = "BakedScene"
    if "SceneView" not in function.types:
        return [function]
    return [function.in_shape("SceneView", scene) for scene in ("BakedScene", "MovingScene")]


def baker_functions():
    """Returns the functions of the baker's headers outside of classes."""
    for header in (LIBRARY / "bake.hpp", LIBRARY / "scenes/bake.hpp"):
        code = without(plain(header.read_text()), r"namespace detail \{")
        yield from functions_in(without(code, CLASS + r"(?:\w+ )?" + BASE + r"\{"), "", header, {})


def classes(code):
    pattern = re.compile(CLASS + r"(\w+) " + BASE + r"\{")
    return [(match[1], code[match.end():closed(code, match.end(), "{}") - 1]) for match in pattern.finditer(code)]


def functions_in(scope, owner, header, concepts):
    for match in re.finditer(r"([\w>&*\]]+) (\w+)\(", scope):
        end = closed(scope, match.end())
        if match[1] in ("return", "operator") or not re.match(r"(?: const)?(?: noexcept)? ?[;{]", scope[end:]):
            continue
        before = re.split(r"[;}]|\{ ", scope[:match.start()])[-1] + match[1]
        function = CppFunction(match[2], "" if "friend " in before else owner,
                               split(scope[match.end():end - 1]), "static " in before, header)
        variants = [function]
        template = re.search(r"template <((?:[^<>]|<[^<>]*>)*)>", before)
        for concept, taken, name in re.findall(r"(?:std::)?(\w+)(?:<(\w+)>)? (\w+)(?:,|$)", template[1] if template else ""):
            shapes = [taken] if taken else concepts.get(concept) or re.findall(r"same_as<Shape, (\w+)>", before)
            variants = [each.in_shape(name, shape) for each in variants for shape in shapes]
        yield from variants
