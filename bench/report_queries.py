"""Tables of docs/benchmarks.md about all but single rays, and that of docs/engines.md, from the newest rows of each kind."""

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
PEER_NAMES = {"fcl": "FCL", "ode": "ODE", "bullet": "Bullet", "box3d": "Box3D"}
SHAPES = {8: "oriented box", 16: "hull of 16", 64: "hull of 64"}  # by vertices
OWN_SHAPES = ("fast", "balanced", "small")
SWEPT_BY = ("bullet", "box3d")
SCENE_PROFILES = ("fast", "balanced")
# Of each column of docs/engines.md its header and decimals; None: text.
ENGINES = {"engine": ("engine", None), "shape": ("mesh shape", None), "bytes": ("bytes", 0), "ms_per_step": ("ms a step", 3),
           "times_own": ("times its own", 2), "fallen": ("fallen off", 0), "moving": ("still moving", 0),
           "energy": ("energy of motion, J", 2), "metres_apart": ("median distance between resting places, m", 2)}


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
            if "mesh" in row:
                row["mesh"] = pathlib.PurePath(row["mesh"]).stem
            self.rows.setdefault(tuple(row[name] for name in key), []).append(row)
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


def measured(rows):
    """Where and when, and a link to the rows."""
    all_rows = [row for runs in rows.rows.values() for row in runs]
    machines = list(dict.fromkeys((row["processor"], row["instruction_set"], row["compiler"], row["date"]) for row in all_rows))
    return "\n\n" + "".join(f"One thread of {processor} ({name}), {compiler}, {date}. " for processor, name, compiler, date in machines) + (
        f"Rows: {links(PAGE, [rows.file])}.")


def points_table(rows):
    lines = [[mesh, f"`{profile}`", *(spread(rows.values(f"{query}_ratio", mesh, profile), 2) for query in POINTS)]
             for mesh, profile in rows.rows]
    return table(["mesh", "profile", *POINTS.values()], lines) + measured(rows)


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
    return table(header, lines) + measured(rows)


def read_sweeps():
    return Runs("sweeps", ("mesh", "vertices", "size"), ("espalier_us", *(f"{peer}_{field}" for peer in SWEPT_BY for field in ("ratio", "differing"))))


def sweeps_table(rows):
    """A line for each mesh and shape: microseconds by size, and how many times as long each peer takes."""
    lines = []
    for mesh in rows.meshes:
        for vertices, shape in SHAPES.items():
            keys = [key for key in rows.rows if key[:2] == (mesh, vertices)]
            own = " / ".join(f"{rows.median('espalier_us', *key):.1f}" for key in keys)
            lines.append([mesh, shape, own, *(" / ".join(f"{rows.median(f'{peer}_ratio', *key):.1f}" for key in keys) for peer in SWEPT_BY)])
    header = ["mesh", "shape", "Espalier, µs", *(f"{PEER_NAMES[peer]}'s time / Espalier's" for peer in SWEPT_BY)]
    return table(header, lines) + measured(rows)


def read_bodies():
    fields = [f"{system}_us" for system in (*PROFILES, "box3d")] + [f"{profile}_ratio" for profile in PROFILES]
    return Runs("bodies", ("mesh", "question", "size"), fields)


def bodies_table(rows):
    """A line for each question and mesh: nanoseconds by size, and how many times as long Box3D takes."""
    lines = []
    for question in dict.fromkeys(key[1] for key in rows.rows):
        for mesh in rows.meshes:
            keys = [key for key in rows.rows if key[:2] == (mesh, question)]
            by_size = lambda field, scale, digits: " / ".join(f"{scale * rows.median(field, *key):.{digits}f}" for key in keys)
            lines.append([question, mesh, *(by_size(f"{system}_us", 1000, 0) for system in (*PROFILES, "box3d")),
                          *(by_size(f"{profile}_ratio", 1, 2) for profile in PROFILES)])
    header = ["query", "mesh", *(f"`{profile}`, ns" for profile in PROFILES), "Box3D, ns", "Box3D's time / `fast`'s", "/ `balanced`'s"]
    return table(header, lines) + measured(rows)


def read_scenes():
    return Runs("scenes", ("mesh", "scene", "system", "profile"), ("instances", "us_per_ray", "ratio_to_last", "bytes"))


def scenes_table(rows):
    lines = []
    for mesh in rows.meshes:
        for scene in dict.fromkeys(key[1] for key in rows.rows if key[0] == mesh):
            own = [(mesh, scene, "espalier", profile) for profile in SCENE_PROFILES]
            peer = (mesh, scene, "embree", "default")
            speeds = [spread([peer_us / own_us for own_us, peer_us in zip(rows.values("us_per_ray", *key), rows.values("us_per_ray", *peer))], 2)
                      for key in own]
            lines.append([mesh, scene, f"{rows.median('us_per_ray', *peer):.2f}", *speeds,
                          *(f"{rows.median('bytes', *key) / 1e6:.2f}" for key in (*own, peer))])
    header = ["mesh", "rays into", "Embree, µs a ray", *(f"speed of `{profile}`" for profile in SCENE_PROFILES),
              *(f"`{profile}`, MB" for profile in SCENE_PROFILES), "Embree, MB"]
    return table(header, lines) + measured(rows)


def read_engines():
    return Runs("engines", ("engine", "shape"), ENGINES)


def engines_table(rows):
    def cell(value, digits):
        if digits is not None:
            return f"{value:.{digits}f}"
        return f"`{value}`" if value in OWN_SHAPES else value
    lines = [[cell(row[name], digits) for name, (_, digits) in ENGINES.items()] for (row,) in rows.rows.values()]
    return table([words for words, _ in ENGINES.values()], lines) + measured(rows)


def texts():
    return {"points": points_table(read_points()), "pairs": pairs_table(read_pairs()), "sweeps": sweeps_table(read_sweeps()),
            "bodies": bodies_table(read_bodies()), "scenes": scenes_table(read_scenes())}
