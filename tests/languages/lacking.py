"""Lists the calls of C++ that C, Python and JavaScript lack, and fails where one lacks without a reason.

`lacking.py` reads the headers, the Python files and the types of the npm package. Shapes count one by one: a call that
takes a capsule in C++ takes it here. So do filters, work limits and accuracies.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/c"))

import calls
import counterparts
import declarations
import javascript_calls
import python_calls


class Call:
    """A call of C++: its owner and name in Python, the shape that it takes, and arguments that it must have."""

    def __init__(self, function, text):
        self.text = text
        types = ([] if function.owner == "" or function.is_static else [function.owner]) + function.types
        first = types[0] if types else ""
        plain = re.sub(r"^span<(.*)>$", r"\1", first)
        self.owner = calls.OWNERS.get(plain, "")
        named = [text, f"{function.owner}::{function.name}", f"{function.name}({plain})", function.name]
        self.name = next((calls.NAMES[name] for name in named if name in calls.NAMES), function.name)
        if "." in self.name:
            self.owner, self.name = self.name.split(".")
        self.shape = types[1] if len(types) > 1 and types[1] in calls.SHAPES and first in calls.OWNERS else None
        self.arguments = [name for kind, name in calls.ARGUMENTS.items() if kind in function.types]


def cpp_calls():
    found = declarations.cpp_functions()
    for function in declarations.baker_functions():
        found[str(function)] = function
    return {text: Call(function, text) for text, function in found.items()}


def c_has():
    """Returns the calls of C++ that C has, by tests/c/counterparts.py, which fails where one lacks."""
    pairs = counterparts.Pairs()
    met = {str(cpp) for cpp in [*pairs.of.values(), *pairs.of_moving.values()]}
    met |= set(counterparts.BY_HAND.values()) | counterparts.ONLY_IN_CPP
    functions = set(pairs.c.functions)
    return lambda call: call.text in met or call.text.split("(")[0] in functions


def reason_of(language, text):
    for number, (languages, _, pattern) in enumerate(calls.REASONS):
        if language in languages and re.fullmatch(pattern, text):
            return number
    return None


def main(verbose):
    all_calls = cpp_calls()
    languages = {"C": c_has(), "Python": python_calls.Declared().has, "JavaScript": javascript_calls.Declared().has}
    wrong, used = [], set()
    for language, has in languages.items():
        lacking = [text for text, call in all_calls.items() if not has(call)]
        reasons = {text: reason_of(language, text) for text in lacking}
        used |= {(language, number) for number in reasons.values()}
        without = [text for text, number in reasons.items() if number is None]
        wrong += [f"{language} lacks {text}, without a reason in tests/languages/calls.py" for text in without]
        print(f"{language} has {len(all_calls) - len(lacking)} of {len(all_calls)} calls of C++; "
              f"{len(lacking) - len(without)} lack with a reason, {len(without)} without")
        if verbose:
            for text, number in reasons.items():
                print(f"  {text}: {'NO REASON' if number is None else calls.REASONS[number][1]}")
    wrong += [f"a reason is not needed for {language}: {pattern}" for number, (of, _, pattern) in enumerate(calls.REASONS)
              for language in of if (language, number) not in used]
    if len(all_calls) < 280:
        wrong.append("too few calls are found")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main("--list" in sys.argv))
