"""Also on disk: a mesh that is compressed and built at load beside a blob; a short table of docs/benchmarks.md and a long one."""

import charts
from report_page import table

LOAD = "load"
SUMMARY, PAGE = "docs/benchmarks.md", "docs/benchmarks/load.md"
ROWS = {LOAD: ("ships", "loads", "file_bytes", "deflated_bytes", "memory_bytes", "peak_bytes", "load_ms", "load_ms_spread", "inflate_ms", "rays",
               "rays_differ", "rounds")}
SHIPS = {"floats": "floats and indices", "meshoptimizer": "meshoptimizer, 16 bits"}
LOADS = {"open": "`open`, which checks every byte", "map, open_unchecked": "mapped, `open_unchecked`", "bake, fast": "bake, profile `fast`",
         "bake, balanced": "bake, profile `balanced`"}
# What the summary compares: a column for each way.
WAYS = {"Embree's default build": ("meshoptimizer", "Embree, medium"), "Embree's fastest build": ("meshoptimizer", "Embree, low"),
        "blob, every byte checked": ("blob, balanced", "open"), "blob, mapped and not checked": ("blob, balanced", "map, open_unchecked")}


def megabytes(value):
    return "–" if value is None else f"{value / 1e6:.2f}"


def milliseconds(value):
    return "–" if value is None else charts.number(value)


def smallest_peak(row):
    """The system counts pages by the half megabyte: less than that was added to the file's bytes."""
    return "under 0.5" if row["loads"].startswith("map") else f"{megabytes(row['memory_bytes'])} + under 0.5"


def line(row):
    peak = smallest_peak(row) if row["peak_bytes"] is None else megabytes(row["peak_bytes"])
    return [row["mesh"], SHIPS.get(row["ships"], row["ships"]), LOADS.get(row["loads"], row["loads"]), megabytes(row["file_bytes"]),
            megabytes(row["deflated_bytes"]), megabytes(row["memory_bytes"]), peak, milliseconds(row["inflate_ms"]), milliseconds(row["load_ms"])]


def load_table(rows):
    header = ["mesh", "on disk", "at load", "MB on disk", "MB deflated", "MB in memory", "MB at the peak", "ms to inflate", "ms to load"]
    return table(header, [line(row) for row in rows.of(LOAD)])


def summary_table(rows):
    lines = []
    for mesh in rows.meshes(LOAD):
        ways = [rows.one(LOAD, mesh=mesh, ships=ships, loads=loads) for ships, loads in WAYS.values()]
        lines.append([mesh, *(f"{milliseconds(way['load_ms'])} ms, {megabytes(way['memory_bytes'])} MB" for way in ways)])
    return table(["mesh", *WAYS], lines)


def machine_words(rows):
    first = rows.of(LOAD)[0]
    machine = "; ".join(f"{processor}, {compiler}" for processor, compiler in rows.machines)
    return f"Measured on one thread of {machine}; medians of {first['rounds']} rounds in which the ways take turns."


def words(rows):
    first = rows.of(LOAD)[0]
    differ = ", ".join(f"{mesh} {max(row['rays_differ'] for row in rows.of(LOAD, mesh=mesh))}" for mesh in rows.meshes(LOAD))
    return (f"\n\n{machine_words(rows)}\n"
            f"Rays of {first['rays']:,} that hit in one way and miss in the first (floats are not rounded to 16 bits), at most: {differ}.")


def made(rows):
    return {f"{SUMMARY}#first_ray": f"{summary_table(rows)}\n\n{machine_words(rows)}", f"{PAGE}#load": load_table(rows) + words(rows)}
