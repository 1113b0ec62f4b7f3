"""The table of mutants in docs/testing.md, which mutate.py --publish writes."""
import datetime
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "testing.md"
TABLE = re.compile(r"(<!-- tools/dev mutate --publish writes this table -->\n)(.*?)(?=\n\n|\Z)", re.DOTALL)
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
