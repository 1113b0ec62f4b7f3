"""Tables of docs/benchmarks.md about spheres, closest points and pairs of meshes, from the newest rows of each kind."""

import pathlib
import statistics

from report_page import ROOT, fail, links, read_objects, table

PAGE = ROOT / "docs" / "benchmarks.md"
RESULTS = ROOT / "bench" / "results"
POINTS = {"overlap_all": "all triangles that a sphere overlaps", "overlap_any": "any, compared with Embree's all",
          "closest_point": "closest point"}
PAIRS = {"yes_no": "contact or not", "all": "all pairs", "distance": "distance"}
# The fastest peer that answers the same question in double precision, as its users would call it.
PEERS = {"yes_no": ("fcl", "obbrss double"), "all": ("ode", "opcode"), "distance": ("fcl", "obbrss double")}
PROFILES = ("fast", "balanced")
PEER_NAMES = {"fcl": "FCL", "ode": "ODE"}


def newest(kind):
    """The rows of a kind with the latest date, which begins the file's name."""
    files = sorted(RESULTS.glob(f"*_{kind}.jsonl"))
    return files[-1] if files else fail(f"{RESULTS} has no rows of {kind}")


class Runs:
    """Rows by what they measure, each with all of its runs."""

    def __init__(self, kind, key, fields):
        self.file = newest(kind)
        self.rows = {}
        for row in read_objects([self.file], f"espalier_bench_peers {kind}", lambda _: (*key, *fields)):
            mesh = pathlib.PurePath(row["mesh"]).stem
            self.rows.setdefault((mesh, *(row[name] for name in key if name != "mesh")), []).append(row)
        self.meshes = list(dict.fromkeys(name for name, *_ in self.rows))

    def values(self, field, *key):
        return [row[field] for row in self.rows[key]]

    def median(self, field, *key):
        return statistics.median(self.values(field, *key))


def read_points():
    return Runs("points", ("mesh", "profile"), [f"{query}_ratio" for query in POINTS])


def read_pairs():
    return Runs("pairs", ("mesh", "question", "system", "profile"), ("poses", "median_ms", "sum_of_answers"))


def spread(values, digits):
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f}–{max(values):.{digits}f})"


def points_table(rows):
    lines = [[mesh, f"`{profile}`", *(spread(rows.values(f"{query}_ratio", mesh, profile), 2) for query in POINTS)]
             for mesh, profile in rows.rows]
    return table(["mesh", "profile", *POINTS.values()], lines) + f"\n\nRows: {links(PAGE, [rows.file])}."


def times(rows, mesh, question, profile):
    """How many times as long the peer takes as Espalier, in each run."""
    own = rows.values("median_ms", mesh, question, "espalier", profile)
    return [peer / mine for peer, mine in zip(rows.values("median_ms", mesh, question, *PEERS[question]), own)]


def pairs_table(rows):
    lines = []
    for mesh in rows.meshes:
        for question, words in PAIRS.items():
            own = [f"{rows.median('median_ms', mesh, question, 'espalier', profile):.2f}" for profile in PROFILES]
            peer = f"{PEER_NAMES[PEERS[question][0]]} {rows.median('median_ms', mesh, question, *PEERS[question]):.1f}"
            lines.append([mesh, words, *own, peer, *(spread(times(rows, mesh, question, profile), 1) for profile in PROFILES)])
    header = ["mesh", "query", *(f"`{profile}`, ms" for profile in PROFILES), "peer, ms", "peer's time / `fast`'s", "/ `balanced`'s"]
    return table(header, lines) + f"\n\nRows: {links(PAGE, [rows.file])}."


def texts():
    return {"points": points_table(read_points()), "pairs": pairs_table(read_pairs())}
