"""Section 11 of the guide, where it comes from: libraries of collision detection, and what this project took from each."""

import dataclasses

import charts
from report_page import table

ROWS = {}


@dataclasses.dataclass
class Package:
    name: str
    year: int  # of its first paper or release
    source: str
    volume: str
    tree: str
    queries: str
    memory: str
    taken: str
    family: int  # selects the row of the drawing
    parents: tuple = ()


FAMILIES = ("research: two meshes", "boxes along the axes", "physics engines", "rays")
PACKAGES = (
    Package("RAPID", 1996, "Gottschalk, Lin, Manocha 1996", "OBB", "binary, one triangle a leaf, top-down by covariance (paper: of the hull's surface; code: of the triangles)",
            "contacts of two meshes", "2n − 1 nodes, each a rotation, a place and three half sides in double",
            "the test of two boxes by 15 axes; time as counts times costs", 0),
    Package("V-COLLIDE", 1997, "Hudson et al. 1997", "OBB; AABB of bodies", "RAPID's", "colliding pairs of many bodies", "RAPID's, and sorted ends of intervals",
            "two phases: pairs of bodies, then triangles", 0, ("RAPID",)),
    Package("QuickCD", 1998, "Klosowski et al. 1998", "k-DOP, k = 18", "binary, split at the mean of the best axis", "contacts of a moving mesh",
            "18 numbers a node", "splitting rules compared, and the term Nu of the cost", 0),
    Package("PQP", 1999, "Larsen et al. 1999", "rectangle swept by a sphere; OBB", "binary, one triangle a leaf", "contacts, distance, tolerance",
            "2n − 1 nodes with both volumes", "distance of two trees: the nearer pair first", 0, ("RAPID",)),
    Package("SOLID", 1997, "van den Bergen 1997", "AABB", "binary, split in the middle of the longest side", "contacts, distance, rays; meshes that deform",
            "2n − 1 boxes", "AABBs for what deforms, and their refit", 1),
    Package("OPCODE", 2001, "Terdiman 2001", "AABB, 16 bits a plane", "binary, no leaf nodes", "contacts, rays, shapes",
            "n − 1 nodes of 20 bytes; triangles stay with the user", "the root of this project: no leaf nodes, quantised boxes", 1, ("SOLID", "RAPID")),
    Package("ODE", 2001, "Smith 2001", "AABB", "OPCODE's", "contacts of rigid bodies", "OPCODE's", "a peer for contacts", 2, ("OPCODE",)),
    Package("Bullet", 2003, "Coumans 2003", "AABB, 16 bits a plane", "binary, in the order of a walk, with numbers to skip; a tree with reinsertion for bodies",
            "contacts, rays, convex sweeps", "2n − 1 nodes of 16 bytes, with triangles that stay", "a walk without a stack and reinsertion, as peers", 2),
    Package("FCL", 2012, "Pan, Chitta, Manocha 2012", "AABB, OBB, k-DOP, rectangle swept by a sphere", "binary, one triangle a leaf", "contacts, distance, continuous motion",
            "2n − 1 nodes in double", "each volume beside the others, a peer for two meshes", 0, ("PQP",)),
    Package("Embree", 2014, "Wald et al. 2014", "AABB", "4 or 8 children, binned SAH, spatial splits", "rays, closest points", "nodes of 4 or 8 boxes, triangles copied in groups of 4",
            "wide nodes tested by SIMD, binned SAH; the peer for rays", 3),
    Package("PhysX", 2016, "NVIDIA 2016", "AABB, 16 bits a plane", "4 children (BV4, by Terdiman), up to 15 triangles a leaf", "rays, overlaps, sweeps, contacts",
            "16 bytes a child, with triangles that stay", "OPCODE's ideas at degree 4; several triangles a leaf", 2, ("OPCODE",)),
    Package("Jolt", 2021, "Rouwé 2021", "AABB, half floats", "4 children, up to 8 triangles a leaf", "rays, sweeps, contacts",
            "64 bytes a node, vertices of 21 bits in the leaf", "compressed triangles inside the tree", 2),
    Package("Espalier", 2026, "this project", "AABB, 8 or 16 bits a plane", "8 or 16 children, no leaf nodes, up to 62 triangles a leaf", "rays, overlaps, distances, sweeps, two meshes, scenes, refit",
            "one block of bytes, triangles on a lattice included", "", 1, ("OPCODE", "Embree")),
)
WIDTH, HEIGHT, LEFT, RIGHT, ROW, BOX = 880, 284, 170, 60, 62, 76


def packages_table():
    lines = [[f"{p.name} ({p.source})", p.volume, p.tree, p.queries, p.memory, p.taken] for p in PACKAGES if p.taken]
    return table(["package", "volume", "tree", "queries", "memory", "what this project took"], lines)


def place(package):
    first, last = 1996, 2026
    # Years are stretched where many packages are.
    share = ((package.year - first) / (last - first)) ** 0.62
    return LEFT + 30 + share * (WIDTH - LEFT - RIGHT - 60), 70 + package.family * ROW


def spread_out(packages):
    """Places in which no two boxes of a row overlap, in the order of years."""
    places = {}
    for family in range(len(FAMILIES)):
        end = 0.0
        for package in sorted((p for p in packages if p.family == family), key=lambda p: (p.year, p.name)):
            x, y = place(package)
            x = max(x, end)
            places[package.name] = (x, y)
            end = x + BOX + 8
    return places


def drawing():
    places = spread_out(PACKAGES)
    parts = [charts.title("Packages by year; a line leads to one that took over a tree or its main idea")]
    for family, name in enumerate(FAMILIES):
        y = 70 + family * ROW
        parts += [charts.text(12, y + 4, name, extra=f' fill="{charts.colour(family)}" font-weight="bold"'),
                  charts.line(LEFT - 20, y, WIDTH - 12, y, charts.RULE)]
    for package in PACKAGES:
        x, y = places[package.name]
        for parent in package.parents:
            from_x, from_y = places[parent]
            bend = 18 if from_y == y else 0
            middle = (from_x + x) / 2
            parts.append(f'<path d="M{from_x:.1f},{from_y} Q{middle:.1f},{(from_y + y) / 2 - 2 * bend:.1f} {x:.1f},{y}" fill="none" stroke="#888"/>')
    for package in PACKAGES:
        x, y = places[package.name]
        colour = charts.colour(package.family)
        parts += [f'<rect x="{x - BOX / 2:.1f}" y="{y - 16}" width="{BOX}" height="32" rx="5" fill="white" stroke="{colour}" stroke-width="1.5"/>',
                  charts.text(round(x, 1), y - 2, package.name, "middle", ' font-weight="bold"'),
                  charts.text(round(x, 1), y + 11, str(package.year), "middle", f' fill="{charts.GREY}"')]
    return charts.picture(WIDTH, HEIGHT, parts)


def made(rows):
    return {"packages": packages_table(),
            "origin.svg": drawing()}
