"""Groups rows of espalier_bench_peers rays: by machine, mesh and system, with the figures of all runs."""

import pathlib
import statistics

from report_page import fail, read_objects

KINDS = ("incoherent", "coherent", "any", "build")
RAYS = ("incoherent", "coherent", "any")
# What rows of one page, and rows of one machine, must have in common.
RUN_SETTINGS = ("bits", "effort", "builder", "rays", "seed", "repetitions", "builds")
MACHINE = ("processor", "instruction_set")
MACHINE_SETTINGS = ("compiler", "processors")


class Figure:
    """The ratio of one system on one mesh over all runs: median, lowest and highest."""

    def __init__(self, ratios, spread=None):
        self.known = bool(ratios) and None not in ratios
        if not self.known:
            return
        self.median = statistics.median(ratios)
        self.low, self.high = spread if spread and len(ratios) == 1 else (min(ratios), max(ratios))

    def __str__(self):
        return f"{self.median:.2f} ({self.low:.2f}–{self.high:.2f})" if self.known else "–"


class System:
    """One system and profile on one mesh of one machine, over all runs."""

    def __init__(self, rows):
        self.row = rows[0]
        self.rows = rows
        self.name = self.row["system"]
        self.profile = self.row["profile"]
        self.label = f"{self.name} {self.profile}"
        self.own = self.name == "espalier"
        self.bytes = self.row["bytes_per_triangle"]
        # Of one run, the spread is that of its repetitions.
        self.figures = {kind: Figure([row[f"{kind}_ratio"] for row in rows], rows[0][f"{kind}_spread"]) for kind in KINDS}

    def most(self, field):
        """The largest count of all runs, or None."""
        values = [row[field] for row in self.rows]
        return None if None in values else max(values)

    def beside(self, reference, kind):
        """The ratio to a reference other than the one in the rows, taken run by run."""
        ratios = [(own[f"{kind}_ratio"], other[f"{kind}_ratio"]) for own, other in zip(self.rows, reference.rows)]
        return Figure([own / other for own, other in ratios] if all(None not in pair for pair in ratios) else [])


class Mesh:
    """One mesh on one machine."""

    def __init__(self, name, systems):
        self.name = pathlib.PurePath(name).stem
        self.systems = systems
        self.triangles = systems[0].row["triangles"]

    def own(self):
        return [system for system in self.systems if system.own]

    def peers(self):
        return [system for system in self.systems if not system.own]

    def find(self, name, profile):
        return next((system for system in self.systems if (system.name, system.profile) == (name, profile)), None)


class Machine:
    """One processor and instruction set, with all meshes measured on it."""

    def __init__(self, rows, meshes):
        self.rows = rows
        self.row = rows[0]
        self.meshes = meshes
        self.processor = short_name(self.row["processor"])
        self.name = f"{self.processor} ({self.row['instruction_set']})"

    def find(self, mesh):
        return next((m for m in self.meshes if m.name == mesh), None)


def short_name(processor):
    """A processor's name as the kernel gives it, without marks and filler words."""
    for mark in ("(R)", "(TM)", " Processor", " CPU"):
        processor = processor.replace(mark, "")
    return processor.strip() or "unnamed processor"


def check_alike(rows, fields):
    for field in fields:
        values = {row.get(field) for row in rows}
        if len(values) > 1:
            fail(f"rows with different {field} do not belong into one table: {sorted(map(str, values))}")


def make_machine(rows):
    """Meshes and systems keep the order in which they were measured."""
    check_alike(rows, MACHINE_SETTINGS)
    meshes = {}
    for row in rows:
        meshes.setdefault(row["mesh"], {}).setdefault((row["system"], row["profile"]), []).append(row)
    for name, systems in meshes.items():
        if len({len(runs) for runs in systems.values()}) > 1:
            fail(f"{name}: some systems were measured more often than others; give whole runs")
    return Machine(rows, [Mesh(name, [System(runs) for runs in systems.values()]) for name, systems in meshes.items()])


def read_rows(file):
    needed = ("system", "profile", "mesh", "date", "load", "any_contradictions", *MACHINE)
    return read_objects([file], "espalier_bench_peers rays", lambda _: needed)


def machine_of(file):
    """The processor and the instruction set of a file of rows."""
    rows = read_rows(file)
    check_alike(rows, MACHINE)
    return tuple(rows[0][field] for field in MACHINE)


def read_machines(files):
    """One machine for each file, in the order of the files."""
    file_of = {}
    for file in files:
        other = file_of.setdefault(machine_of(file), file)
        if other != file:
            fail(f"{other.name} and {file.name} have rows of one machine; name one of them")
    machines = [make_machine(read_rows(file)) for file in files]
    check_alike([row for machine in machines for row in machine.rows], RUN_SETTINGS)
    return machines
