"""The mutants that no test can notice, and why: comments in the library, directly above the code that they are about.

    // mutant(> -> >=) equivalent: both sides are equal then
    // mutant(never, < -> <= 2) work: visits a leaf that the next test rejects

In brackets are the changes of mutants.jsonl; a `without` names its operand by number, and a change that the code has
several times is followed by its number. The code is the next line, with the statements that begin there. Kinds:
"equivalent" changes nothing that can be observed, on any blob and any argument; "sanitizer" is undefined behaviour that
comes out right on the machine where mutants run, and that builds with sanitizers refuse; "compiler" does not compile
where the compiler evaluates it; "huge" needs a blob that no test bakes; "work" changes how long something takes.
"""
import collections
import re

KINDS = ("equivalent", "sanitizer", "compiler", "huge", "work")
FORM = re.compile(r"mutant\(([^)]*)\) (\w+): (\S.*)", re.DOTALL)


class WrongExcuse(Exception):
    pass


BLOCK_BEFORE = re.compile(r"([)}$]|\b(else|do|try|const|noexcept|override|final|mutable)|-> [\w:<>*& ]+)$")
BLOCK_HEAD = re.compile(r"\b(struct|class|union|enum|namespace)\b")


def statement_ends(code):
    """Where statements end: at semicolons outside of brackets, and at the braces of blocks."""
    ends, open_brackets = [], []
    for at, character in enumerate(code):
        if character in "([":
            open_brackets.append(character)
        elif character == "{":
            before = code[ends[-1] if ends else 0:at].rstrip()
            is_block = BLOCK_BEFORE.search(before) or BLOCK_HEAD.search(before)
            open_brackets.append("block" if is_block else "{")
            if is_block:
                ends.append(at + 1)
        elif character in ")]}":
            if not open_brackets or open_brackets.pop() == "block":
                ends.append(at + 1)
        elif character == ";" and (not open_brackets or open_brackets[-1] == "block"):
            ends.append(at + 1)
    return ends


def excuses_of(text, code):
    """Of each comment its line, its changes, its reason, and where the code that it is about begins and ends."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)
    ends, pending, found = statement_ends(code), [], []
    for number, line in enumerate(lines):
        stripped = line.strip()
        if stripped.startswith("// mutant("):
            pending.append([number + 1, stripped[3:]])
        elif stripped.startswith("//") and pending:
            pending[-1][1] += " " + stripped[2:].strip()
        elif pending and stripped:
            end_of_line = starts[number] + len(line.rstrip())
            end_of_code = len(code[:end_of_line].rstrip())
            end = next((end for end in ends if end >= end_of_code), len(code))
            for at, comment in pending:
                form = FORM.fullmatch(comment)
                if form is None or form.group(2) not in KINDS:
                    raise WrongExcuse(f"{at}: not 'mutant(CHANGES) KIND: REASON': {comment}")
                changes = [change.strip() for change in form.group(1).split(",")]
                found.append((at, changes, f"{form.group(2)}: {form.group(3)}", starts[number], end))
            pending = []
    if pending:
        raise WrongExcuse(f"{pending[0][0]}: a mutant is excused behind which there is no code")
    return found


def short_name(change):
    """A change without the source text in it."""
    return re.sub(r"^(without|never).*", r"\1", change, flags=re.DOTALL)


def excuse_mutants(text, code, mutants):
    """Gives each mutant its "excuse" or None. A mutant has "at", its place in the code; mutants are in the order of the
    file. What is excused must be there, and once."""
    for mutant in mutants:
        mutant["excuse"] = None
    for line, changes, reason, start, end in excuses_of(text, code):
        by_name = collections.defaultdict(list)
        for mutant in sorted(mutants, key=lambda mutant: mutant["at"]):
            if start <= mutant["at"] < end:
                by_name[short_name(mutant["change"])].append(mutant)
        for change in changes:
            name, _, number = change.rpartition(" ")
            name, number = (name, int(number)) if number.isdigit() else (change, None)
            candidates = by_name.get(name, [])
            if not candidates or number is not None and not 1 <= number <= len(candidates):
                raise WrongExcuse(f"{line}: there is no mutant '{change}' here: {', '.join(by_name) or 'none at all'}")
            if number is None and len(candidates) > 1:
                raise WrongExcuse(f"{line}: there are {len(candidates)} mutants '{name}' here; add a number")
            mutant = candidates[(number or 1) - 1]
            if mutant["excuse"] is not None:
                raise WrongExcuse(f"{line}: '{change}' is excused twice")
            mutant["excuse"] = reason
