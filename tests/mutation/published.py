"""The tables of mutants in docs/testing.md, which mutate.py --publish writes."""
import collections
import datetime
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "testing.md"
TABLE = re.compile(r"(<!-- tools/dev mutate --publish writes this table -->\n)(.*?)(?=\n\n|\Z)", re.DOTALL)
SAMPLE = re.compile(r"(<!-- tools/dev mutate --sample N --publish writes from here -->\n)(.*?)(?=<!-- to here -->)", re.DOTALL)
OUTCOMES = ("quick", "none", "excused")  # of a sample; others are parts of `tools/dev prove`
COLUMNS = ("red", "crash", "too slow", "equivalent", "sanitizer", "compiler", "huge", "work", "not explained")


def row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def publish(tally, counts):
    """Replaces the row of each part all of whose mutants have an outcome; the others stay as they are."""
    page, rows = PAGE.read_text(), {}
    for line in TABLE.search(page).group(2).split("\n")[2:]:
        part, *cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[part] = cells
    for part, outcomes in tally.items():
        if sum(outcomes.values()) == counts[part]:
            rows[part] = [counts[part], *(outcomes[column] for column in COLUMNS), datetime.date.today().isoformat()]
        else:
            print(f"not published: {part}, since some of its mutants were not run")
    lines = [row(["", "mutants", *COLUMNS, "run"]), row(["---"] * (len(COLUMNS) + 3))]
    lines += [row([part, *rows[part]]) for part in counts if part in rows]
    PAGE.write_text(TABLE.sub(lambda match: match.group(1) + "\n".join(lines), page))


def publish_sample(results, seed):
    """Replaces the table of the two tiers, and the list of what only `tools/dev prove` kills."""
    by_library = collections.defaultdict(collections.Counter)
    for result in results:
        for library in (result["file"].split("/")[0], "all"):
            by_library[library][result["outcome"] if result["outcome"] in OUTCOMES else "whole"] += 1
    lines = [row(["", "mutants", "killed by `tools/dev test`", "only by `tools/dev prove`", "by none", "excused", "share of `test`"]),
             row(["---"] * 7)]
    for library in sorted(by_library, key=lambda library: (library == "all", library)):
        found = by_library[library]
        lines.append(row([library, sum(found.values()), found["quick"], found["whole"], found["none"], found["excused"],
                          f"{100 * found['quick'] / max(found['quick'] + found['whole'], 1):.1f} %"]))
    lines += ["", f"Drawn with the seed {seed}, run on {datetime.date.today().isoformat()}."]
    missed = [result for result in results if result["outcome"] not in OUTCOMES]
    if missed:
        lines += ["", row(["only `tools/dev prove` kills", "part", "test"]), row(["---"] * 3)]
    for result in missed:
        change = f"`lib/{result['file']}`: `{result['text']}`, {result['change']}".replace("|", "\\|")
        lines.append(row([change, result["outcome"], result["by"]]))
    PAGE.write_text(SAMPLE.sub(lambda match: match.group(1) + "\n".join(lines) + "\n", PAGE.read_text()))
