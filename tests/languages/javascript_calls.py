"""The calls of the npm package, as its types declare them."""
import re
from pathlib import Path

import calls

PACKAGE = Path(__file__).resolve().parents[2] / "lib/wasm/package"


def in_javascript(name):
    """raycast_sources as raycastSources."""
    head, *tail = name.split("_")
    return head + "".join(word.capitalize() for word in tail)


class Declared:
    def __init__(self):
        self.members, self.bases, self.unions = {"": {}}, {}, {}  # of each interface or class: name and declaration
        for file in sorted(PACKAGE.rglob("*.d.ts")):
            text = re.sub(r"/\*.*?\*/|//[^\n]*", "", file.read_text(), flags=re.S)
            module = "pairs" if file.name == "pairs.d.ts" else ""
            for name, declared in re.findall(r"export (?:function|const|class) (\w+)([^;{]*)", text):
                self.members.setdefault(module, {})[name] = declared
            for name, value in re.findall(r"export type (\w+) =([^;]*);", text):
                self.unions[name] = re.findall(r"\w+", value)
            for name, bases, body in re.findall(
                    r"export (?:class|interface) (\w+)(?:<\w+>)?(?: extends ([^{]*))?\s*\{(.*?)\}(?=\s|$)", text, flags=re.S):
                self.bases.setdefault(name, []).extend(re.findall(r"\w+", bases))
                found = self.members.setdefault(name, {})
                for member, declared in re.findall(r"(?:^|[;{\n])\s*(?:readonly )?(\w+)\??(?=[(:<])(.*?)(?=;|$)", body, flags=re.S):
                    found[member] = found.get(member, "") + declared
        self.members[""] |= self.members.get("Espalier", {})

    def has(self, call):
        name = calls.NAMES_IN_JAVASCRIPT.get(call.name, in_javascript(call.name))
        declared = self.find(call.owner, name)
        if declared is None:
            return False
        if not all(self.names(declared) & {in_javascript(argument)} for argument in call.arguments):
            return False
        return call.shape is None or call.shape in self.names(declared)

    def find(self, owner, name):
        if name in self.members.get(owner, {}):
            return self.members[owner][name]
        return next((found for base in self.bases.get(owner, []) if (found := self.find(base, name)) is not None), None)

    def names(self, declared):
        """Returns all words of a declaration, of the unions that it names, and of the interfaces of its options."""
        found, new = set(), set(re.findall(r"\w+", declared))
        while new:
            found |= new
            more = set()
            for name in new:
                more |= set(self.unions.get(name, [])) | set(self.bases.get(name, []))
                if name.endswith("Options") or name.startswith("Selected"):
                    more |= set(self.members.get(name, {}))
            new = more - found
        return found
