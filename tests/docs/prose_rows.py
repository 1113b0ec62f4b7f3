"""What the figures of prose.py are computed from: committed rows, the budgets of small cores, and tables that no rows decide."""

import functools
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DOCS = ROOT / "docs"
sys.dont_write_bytecode = True  # the source tree stays as it is
sys.path.insert(0, str(ROOT / "bench"))
import deformation_report  # noqa: E402
import firmware_report  # noqa: E402
import report_queries  # noqa: E402
import report_tables  # noqa: E402
from report import is_noisy  # noqa: E402, F401
from report_page import Rows, named_files, read_objects  # noqa: E402
from report_rows import read_machines  # noqa: E402

FAST_CORE = ("m4f", "fast")
OWN_SHAPES = ("fast", "balanced", "small")  # the adapters' rows in engines.md


@functools.cache
def page_table(page, first):
    """The rows of the table whose header begins with these cells; numbers as such."""
    lines = (DOCS / page).read_text(encoding="utf-8").partition(f"\n| {first} |")[2].splitlines()[2:]
    cells = [[cell.strip(" `") for cell in line.strip("|").split("|")] for line in lines[:lines.index("")]]
    return [[float(cell.replace(",", "")) if re.fullmatch(r"[\d,.]+", cell) else cell for cell in row] for row in cells]


# ---- rays, bytes and builds ----------------------------------------------------------------------------------------------


@functools.cache
def machines():
    return read_machines(named_files(DOCS / "benchmarks.md"))


def systems(name=None, profile=None):
    """Each with its mesh, on all machines."""
    return [(mesh, system) for machine in machines() for mesh in machine.meshes for system in mesh.systems
            if name in (None, system.name) and profile in (None, system.profile)]


def bytes_of(name, profile):
    return [system.bytes for _, system in systems(name, profile)]


def bytes_of_peers():
    return [system.bytes for _, system in systems() if not system.own]


def fast_over_balanced():
    return [fast / balanced for fast, balanced in zip(bytes_of("espalier", "fast"), bytes_of("espalier", "balanced"))]


def beside_default(profile="balanced", kind="incoherent"):
    """Speeds beside Embree's default mode."""
    return [value for mesh in report_tables.mesh_names(machines())
            for value in report_tables.speeds(machines(), mesh, profile, kind, "default")]


def tiny_over_small():
    """Times of incoherent rays."""
    return [1 / value for mesh in report_tables.mesh_names(machines())
            for value in report_tables.ratios(machines(), mesh, ("espalier", "tiny"), ("espalier", "small"), "incoherent")]


def coherent_gains():
    """Of batches over single rays, on each mesh and in each profile."""
    return [value - 1 for profile in report_tables.single_profiles(machines()) for mesh in report_tables.mesh_names(machines())
            for value in report_tables.ratios(machines(), mesh, ("espalier", f"{profile}/batch"), ("espalier", profile), "coherent")]


def peers_behind():
    """Those that answer rays, and are behind every profile on every mesh."""
    with_rays = {system.name for _, system in systems() if system.figures["incoherent"].known}
    ahead = {system.name for mesh, system in systems() for own in mesh.own() for kind in report_tables.RAYS
             if system.figures[kind].known and system.figures[kind].median >= own.figures[kind].median}
    return [words for name, words in report_tables.SYSTEMS.items() if name in with_rays - ahead]


def of_fandisk(name, profile):
    """Kilobytes, and nanoseconds of an incoherent ray."""
    mesh, system = next((mesh, system) for mesh, system in systems(name, profile) if mesh.name == "fandisk")
    return system.bytes * mesh.triangles / 1000, 1000 / statistics.median(row["incoherent_mrays"] for row in system.rows)


# ---- spheres, pairs of meshes, loads -------------------------------------------------------------------------------------


points, pairs = functools.cache(report_queries.read_points), functools.cache(report_queries.read_pairs)


def sphere_speeds(mesh):
    """But in profile tiny."""
    return [points().median("overlap_all_ratio", *key) for key in points().rows if key[0] == mesh and key[1] != "tiny"]


def pair_speeds(question):
    return [statistics.median(report_queries.times(pairs(), mesh, question, profile))
            for mesh in pairs().meshes for profile in report_queries.PROFILES]


def counts(question, system, profile):
    return [pairs().median("sum_of_answers", mesh, question, system, profile) for mesh in pairs().meshes]


def more_pairs(system, profile):
    """What a peer counts more than Espalier, as a share, on each mesh."""
    both = zip(pairs().meshes, counts("all", "espalier", "fast"), counts("all", system, profile))
    return {mesh: peer / own - 1 for mesh, own, peer in both}


@functools.cache
def guide():
    return Rows(read_objects(named_files(DOCS / "guide/README.md"), "tools/dev guide", lambda _: ("measures", "processor", "compiler")))


def build_over_blob(build, way, field):
    """What a build at load takes over what a blob takes, on each mesh and in each profile."""
    return [guide().one("load", mesh=blob["mesh"], ships="meshoptimizer", loads=build)[field] / blob[field]
            for blob in guide().of("load", loads=way)]


def bake_over_build(profile, field):
    """What a bake at load takes over what Embree's default build takes, on each mesh."""
    return guide().ratios("load", field, {"loads": "Embree, medium"}, ships="meshoptimizer", loads=f"bake, {profile}")


# ---- engines, small cores, meshes and scenes that move -------------------------------------------------------------------


def engine(name, shape, column):
    row = next(row for row in page_table("engines.md", "engine | mesh shape") if row[:2] == [name, shape])
    return row[("engine", "shape", "bytes", "ms", "times", "fallen", "moving", "energy", "metres").index(column)]


def engines(name, column):
    return [engine(name, shape, column) for shape in OWN_SHAPES]


def times_own_bytes(name, *shapes):
    return [engine(name, "its own", "bytes") / engine(name, shape, "bytes") for shape in shapes or OWN_SHAPES]


@functools.cache
def firmware():
    return firmware_report.Rows(read_objects(named_files(DOCS / "small_cores.md"), "tools/dev firmware", firmware_report.needed))


def instructions(core, profile, mesh, query):
    return firmware().queries[core, profile, mesh, query]["instructions"]


def fast_over_small(core, mesh, query):
    return instructions(core, "fast", mesh, query) / instructions(core, "small", mesh, query)


def sweeps_over_ray():
    """Instructions on the core with a floating-point unit."""
    return [instructions(*FAST_CORE, "bunny", f"sweep_{shape}") / instructions(*FAST_CORE, "bunny", "raycast")
            for shape in ("sphere", "capsule", "box", "oriented_box", "convex_hull")]


@functools.cache
def budgets():
    """The lines, each split into its words."""
    lines = (ROOT / "tests" / "firmware" / "budgets.txt").read_text(encoding="utf-8").splitlines()
    return [line.split() for line in lines if not line.startswith("#")]


def code_budgets():
    """Bytes by core, profile and image."""
    return {(core, profile, image): int(size) for core, profile, kind, *sizes in budgets() if kind == "code"
            for image, size in (word.split("=") for word in sizes)}


def code_budgets_over_rows():
    return [size / firmware().code[key] for key, size in code_budgets().items()]


def ray_budget():
    """Bytes of code and of stack that a test holds `open` and the closest ray to."""
    stacks = [int(line[-1]) for line in budgets() if tuple(line[:2]) == FAST_CORE and line[3] in ("open", "raycast")]
    return code_budgets()[(*FAST_CORE, "closest_ray")], max(stacks)


@functools.cache
def motion():
    return deformation_report.MotionRows(read_objects(named_files(DOCS / "moving.md"), "espalier_bench_study deformation",
                                                      deformation_report.needed))


def deformable(*fields, scale=1):
    """Sums of fields for each triangle, on each mesh."""
    return [scale * sum(row[field] for field in fields) / row["triangles"] for row in map(motion().espalier, motion().names)]


def bakes_over_refits():
    return [row["ns_per_triangle"] / motion().espalier(row["mesh"])["ns_per_triangle"] for row in motion().of("bake", effort="normal")]


def balanced_over_deformable():
    whole = dict(zip(motion().names, deformable("bytes")))
    return [system.bytes / whole[mesh.name] for mesh, system in systems("espalier", "balanced") if mesh.name in whole]


def block_bytes(column):
    """Bytes an instance of a large moving scene; column 1 is the size for any order of calls, 2 the least."""
    return [row[column] / row[0] for row in page_table("scenes.md", "instances") if row[0] >= 1000]
