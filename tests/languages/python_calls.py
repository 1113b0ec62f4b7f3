"""The calls of the Python package, as its files declare them."""
import ast
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "lib/python/espalier"


class Declared:
    def __init__(self):
        self.functions, self.classes, self.bases, self.unions = {}, {}, {}, {}  # by owner and name
        for file in sorted(PACKAGE.glob("*.py")):
            for node in ast.parse(file.read_text()).body:
                if isinstance(node, ast.FunctionDef):
                    self.functions[("pairs" if file.stem == "pairs" else "", node.name)] = node
                elif isinstance(node, ast.ClassDef):
                    self.classes[node.name] = node
                    self.bases[node.name] = [base.id for base in node.bases if isinstance(base, ast.Name)]
                elif isinstance(node, ast.Assign) and file.stem == "shapes":
                    self.unions[node.targets[0].id] = names_in(node.value)

    def has(self, call):
        method = self.find(call.owner, call.name)
        if method is None:
            return call.owner == "" and call.name in self.classes
        if not isinstance(method, ast.FunctionDef):
            return not call.arguments and call.shape is None
        arguments = method.args.posonlyargs + method.args.args + method.args.kwonlyargs
        if not {argument.arg for argument in arguments} >= set(call.arguments):
            return False
        return call.shape is None or any(call.shape in self.shapes(argument.annotation) for argument in arguments)

    def find(self, owner, name):
        if (owner, name) in self.functions:
            return self.functions[owner, name]
        for node in self.classes[owner].body if owner in self.classes else []:
            if isinstance(node, ast.FunctionDef) and node.name == name:
                return node
            if isinstance(node, ast.AnnAssign) and node.target.id == name:
                return node
        return next(filter(None, (self.find(base, name) for base in self.bases.get(owner, []))), None)

    def shapes(self, annotation):
        """Returns the classes that an annotation names, those of unions too."""
        names = names_in(annotation) if annotation is not None else set()
        return set().union(*(self.shapes_of(name) for name in names))

    def shapes_of(self, name):
        return set().union(*(self.shapes_of(each) for each in self.unions[name])) if name in self.unions else {name}


def names_in(node):
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
