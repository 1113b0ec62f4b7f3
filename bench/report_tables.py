"""Tables about rays, bytes and builds: short ones for docs/benchmarks.md and the README, all figures for docs/benchmarks/rays.md."""

import statistics

from report_page import table
from report_rows import KINDS, RAYS

REFERENCES = ("default", "robust")  # Embree's modes that speeds are shown beside; rows hold ratios to the first
QUERIES = {"incoherent": "closest hit, incoherent rays", "coherent": "closest hit, coherent rays", "any": "any hit"}
SYSTEMS = {"espalier": "Espalier", "embree": "Embree", "bullet": "Bullet", "ode": "ODE", "fcl": "FCL",
           "embree4": "Embree 4", "tinybvh": "tinybvh", "jolt": "Jolt", "box3d": "Box3D"}
TIE = 0.995  # shares above round to 1.00


# ---- selecting and writing figures ---------------------------------------------------------------------------------------


def decimals(value, digits=2):
    if value is None:
        return "–"
    return f"{value:.{digits}f}" if value < 100 else f"{value:.0f}"


def count(value):
    return "–" if value is None else f"{value:,}"


def span(values, digits=2):
    """One value, or the lowest and the highest of several."""
    known = [f"{value:,.{digits}f}" for value in sorted(values)]
    if not known:
        return "–"
    return known[0] if known[0] == known[-1] else f"{known[0]}–{known[-1]}"


def mesh_names(machines):
    return list(dict.fromkeys(mesh.name for machine in machines for mesh in machine.meshes))


def system_keys(machines):
    """Names and profiles, in the order of the rows."""
    return list(dict.fromkeys((s.name, s.profile) for machine in machines for mesh in machine.meshes for s in mesh.systems))


def own_profiles(machines):
    return [profile for name, profile in system_keys(machines) if name == "espalier"]


def single_profiles(machines):
    """Those that answer one ray at a time: bytes and builds of batches are the same."""
    return [profile for profile in own_profiles(machines) if not profile.endswith("/batch")]


def find_all(machines, mesh, name, profile):
    """The system on every machine that measured it, each with its mesh."""
    found = [(m, m.find(name, profile)) for m in (machine.find(mesh) for machine in machines) if m is not None]
    return [(m, system) for m, system in found if system is not None]


def ratios(machines, mesh, own, peer, kind):
    """The medians of one system beside another, a value for each machine that measured both."""
    values = []
    for measured, system in find_all(machines, mesh, *own):
        reference = measured.find(*peer)
        figure = system.beside(reference, kind) if reference is not None else None
        if figure is not None and figure.known:
            values.append(figure.median)
    return values


def speeds(machines, mesh, profile, kind, mode):
    return ratios(machines, mesh, ("espalier", profile), ("embree", mode), kind)


def bytes_of(machines, mesh, name, profile, digits=2):
    return span([system.bytes for _, system in find_all(machines, mesh, name, profile)], digits)


def name_of(name, profiles):
    """A system with its profiles: those of Espalier are names of code, those of the others are modes."""
    words = ", ".join(f"`{profile}`" if name == "espalier" else profile for profile in profiles)
    return f"{SYSTEMS[name]} " + words.replace("obbrss", "OBBRSS").replace("opcode", "OPCODE")


# ---- docs/benchmarks.md and the README -----------------------------------------------------------------------------------


def rays(machines):
    """Speeds beside both modes of Embree: a row for each mesh and profile."""
    lines = [[mesh, f"`{profile}`", bytes_of(machines, mesh, "espalier", profile, 1),
              *(" / ".join(span(speeds(machines, mesh, profile, kind, mode)) for mode in REFERENCES) for kind in RAYS)]
             for mesh in mesh_names(machines) for profile in single_profiles(machines)]
    return table(["mesh", "profile", "B/triangle", *QUERIES.values()], lines)


def memory(machines):
    """Bytes a triangle, of Espalier first: systems with equal bytes share a row."""
    labels = {}
    for name, profile in sorted(system_keys(machines), key=lambda key: key[0] != "espalier"):
        cells = tuple(bytes_of(machines, mesh, name, profile, 1) for mesh in mesh_names(machines))
        if not profile.endswith("/batch"):
            labels.setdefault((name, cells), []).append(profile)
    return table(["bytes per triangle", *mesh_names(machines)],
                 [[name_of(name, profiles), *cells] for (name, cells), profiles in labels.items()])


def share(machines, mesh, profile, peer, kind):
    """The speed as a share of the peer's where that is lowest, or None where no machine has the peer ahead."""
    lowest = min(ratios(machines, mesh, ("espalier", profile), peer, kind), default=1.0)
    return lowest if lowest < TIE else None


def beside_peers(machines):
    """Speeds as shares of each peer's, from the mesh with the lowest to the one with the highest: a row for each peer."""
    lines = []
    for peer in system_keys(machines):
        cells = [span([value for mesh in mesh_names(machines) for value in ratios(machines, mesh, ("espalier", profile), peer, kind)])
                 for kind in QUERIES for profile in ("fast", "balanced")]
        if peer[0] != "espalier" and any(cell != "–" for cell in cells):
            lines.append([name_of(peer[0], [peer[1]]), *cells])
    return table(["peer", *(f"{query}, `{profile}`" for query in QUERIES.values() for profile in ("fast", "balanced"))], lines)


def builds(machines):
    """Milliseconds of a build or a bake, and how many times as long as Embree's default."""
    def cell(mesh, name, profile):
        found = find_all(machines, mesh, name, profile)
        if not found:
            return "–"
        milliseconds = span([1000 * statistics.median(row["build_seconds"] for row in system.rows) for _, system in found], 0)
        return f"{milliseconds} ms, {span([1 / system.figures['build'].median for _, system in found], 1)} ×"
    lines = [[name_of(name, [profile]), *(cell(mesh, name, profile) for mesh in mesh_names(machines))]
             for name, profile in system_keys(machines) if not profile.endswith("/batch")]
    return table(["", *mesh_names(machines)], lines)


def numbers(machines):
    """The README's: bytes and speeds of the default profile, in ranges over the machines."""
    lines = []
    for mesh in mesh_names(machines):
        triangles = next(m.triangles for m in (machine.find(mesh) for machine in machines) if m is not None)
        lines.append([mesh, f"{triangles:,}", bytes_of(machines, mesh, "espalier", "balanced", 1),
                      bytes_of(machines, mesh, "embree", "default", 0),
                      *(span(speeds(machines, mesh, "balanced", kind, mode)) for kind in ("incoherent", "any") for mode in REFERENCES)])
    header = [f"{query}: beside {mode}" for query in ("closest hit", "any hit") for mode in REFERENCES]
    return table(["mesh", "triangles", "bytes per triangle", "Embree's bytes", *header], lines)


# ---- docs/benchmarks/rays.md ---------------------------------------------------------------------------------------------


def glance(machines):
    """Speeds beside both modes of Embree, of batches too."""
    lines = []
    for mesh in mesh_names(machines):
        for profile in own_profiles(machines):
            cells = [span(speeds(machines, mesh, profile, kind, mode)) for kind in RAYS for mode in REFERENCES]
            lines.append([f"`{profile}`", mesh, bytes_of(machines, mesh, "espalier", profile), *cells])
    header = [f"{kind}: beside {mode}" for kind in RAYS for mode in REFERENCES]
    return table(["profile", "mesh", "B/triangle", *header], lines)


def every_loss(machines):
    """Each peer that is faster than a profile in something, a row for each mesh; then the peers that take fewer bytes."""
    lines, smaller = [], []
    for kind in KINDS:
        for mesh in mesh_names(machines):
            for peer in system_keys(machines):
                shares = [share(machines, mesh, profile, peer, kind) for profile in own_profiles(machines)]
                if peer[0] != "espalier" and any(value is not None for value in shares):
                    lines.append([kind, mesh, name_of(peer[0], [peer[1]]), *("–" if v is None else f"{v:.2f}" for v in shares)])
    for mesh in mesh_names(machines):
        for name, profile in system_keys(machines):
            peers = [system.bytes for _, system in find_all(machines, mesh, name, profile) if name != "espalier"]
            own = [system.bytes for p in own_profiles(machines) for _, system in find_all(machines, mesh, "espalier", p)]
            if peers and min(peers) < max(own):
                smaller.append(f"{name_of(name, [profile])} on {mesh}")
    words = f"Fewer bytes than a profile of Espalier: {'; '.join(smaller) or 'no peer'}."
    return table(["", "mesh", "faster peer", *(f"`{profile}`" for profile in own_profiles(machines))], lines) + "\n\n" + words


def system_line(system):
    row = system.row
    rates = [r["incoherent_mrays"] for r in system.rows]
    return [f"**{system.label}**" if system.own else system.label, decimals(system.bytes),
            decimals(row["bytes_per_triangle_20_bits"]), decimals(row["bytes_per_triangle_with_ids"]),
            *(str(system.figures[kind]) for kind in KINDS),
            "–" if None in rates else f"{statistics.median(rates):.2f}",
            count(system.most("disagreeing")), count(system.most("t_disagreeing")), count(system.most("any_contradictions"))]


def tables(machines):
    parts = []
    for name in mesh_names(machines):
        measured = [(machine, machine.find(name)) for machine in machines if machine.find(name) is not None]
        parts.append(f"### {name}: {measured[0][1].triangles:,} triangles")
        for machine, mesh in measured:
            own = next((system.row for system in mesh.own()), None)
            lattice = "" if own is None else (
                f": step {own['step']:.6g}, largest extent {own['extent']:.6g} "
                f"({own['extent'] / own['step']:,.0f} steps), largest error {own['max_error']:.3g}; "
                f"{100 * own['hit_fraction']:.0f} % of the incoherent rays hit")
            parts.append(f"{machine.name}{lattice}.")
            parts.append(table(["system", "B/triangle", "at 20 bits", "with ids", *KINDS, "Mray/s", "differ", "t differs",
                                "any differs"], [system_line(system) for system in mesh.systems]))
    return "\n\n".join(parts)
