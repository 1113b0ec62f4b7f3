"""Pairs of instances that touch, against separating axes of the solids that Python reads from the scene."""
import itertools
import random

from .files import *
from .verbs import ask


def difference(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def edges(corners):
    return [difference(b, a) for a, b in itertools.combinations(corners, 2)]


def normals(corners):
    return [cross(difference(corners[b], corners[a]), difference(corners[c], corners[a])) for a, b, c in FACES]


def gap(a, b):
    """How far two solids of four corners are apart along the best axis; below 0 they share points."""
    widest = -math.inf
    for axis in normals(a) + normals(b) + [cross(e, f) for e in edges(a) for f in edges(b)]:
        length = math.sqrt(dot(axis, axis))
        if length < 1e-6:
            continue
        along_a, along_b = ([dot(axis, corner) / length for corner in corners] for corners in (a, b))
        widest = max(widest, min(along_b) - max(along_a), min(along_a) - max(along_b))
    return widest


def depth(inner, outer):
    """How deep the first solid lies inside the other one; below 0 a corner is outside."""
    least = math.inf
    for normal, face in zip(normals(outer), FACES):
        length = math.sqrt(dot(normal, normal))
        least = min(least, *(dot(normal, difference(outer[face[0]], corner)) / length for corner in inner))
    return least


def pairs():
    claim("pairs are those of solids that no axis separates and of which none is inside the other")
    chance = random.Random(11)
    matrices = [times(moved(*(chance.uniform(0, 6) for _ in range(3))), turned_about_z(chance.uniform(0, 360)))
                for _ in range(40)]
    # Far inside the first one: their boxes touch, their surfaces do not.
    matrices.append(times(matrices[0], times(moved(0.6, 0.5, 0.4), scaled(0.05, 0.05, 0.05))))
    baked(solids(*matrices), "all", "--step", "2^-14")
    scene = Scene("case.esps")
    with open("mesh.espl", "wb") as file:
        file.write(scene.meshes[0])
    farthest = max(min(math.dist(corner, point) for point in POINTS)
                   for triangle in corners_of("mesh.espl") for corner in triangle)
    close("a corner of the mesh", farthest, 0.0, 1e-3)
    places = [[placed(instance, point) for point in POINTS] for instance in scene.instances]
    wanted, inside, unclear = set(), 0, 0
    for a, b in itertools.combinations(range(len(places)), 2):
        apart = gap(places[a], places[b])
        deep = max(depth(places[a], places[b]), depth(places[b], places[a]))
        unclear += min(abs(apart), abs(deep)) < 3e-3
        inside += deep > 0
        if apart < 0 and deep < 0:
            wanted.add((a, b))
    is_equal("what the solids decide", (len(scene.meshes), unclear, inside, len(wanted) > 20), (1, 0, 1, True))
    listed = ask("case.esps", "pairs")
    found = [(pair["a"]["instance"], pair["b"]["instance"]) for pair in listed["pairs"]]
    is_equal("the pairs", found, sorted(wanted))
    claim("pages, a mask and a limit of work shorten the list of pairs, which names the sources")
    limited = ask("case.esps", "pairs", "--limit", "3")
    is_equal("the limited list", (limited["status"], limited["pairs"]), ("output_full", listed["pairs"][:3]))
    is_equal("where the next page begins", (limited["next"], "next" in listed), (3, False))
    pages, page = [], {"status": "output_full", "next": 0}
    while page["status"] == "output_full":
        page = ask("case.esps", "pairs", "--limit", "7", "--from", page["next"])
        pages += page["pairs"]
    is_equal("pages that are joined", pages, listed["pairs"])
    behind = ask("case.esps", "pairs", "--from", len(found) + 1)
    is_equal("behind the last pair", (behind["status"], behind["pairs"]), ("ok", []))
    for pair in listed["pairs"]:
        for side in "ab":
            is_equal("the source", pair[side]["source"], scene.instances[pair[side]["instance"]]["source"])
    is_equal("pairs of no instance", ask("case.esps", "pairs", "--mask", "0")["count"], 0)
    stopped = ask("case.esps", "pairs", "--work-limit", "5", code=6)
    is_equal("after little work", (stopped["status"], stopped["pairs"]), ("work_limit", listed["pairs"][:stopped["count"]]))
    text = run("query", "case.esps", "pairs").stdout
    if "a instance %d of mesh 0" % found[0][0] not in text or "%d pairs" % len(found) not in text:
        fail("the text is %s" % text[-300:])
    if ": --from 3 goes on" not in run("query", "case.esps", "pairs", "--limit", "3").stdout:
        fail("the text of a page does not name the next one")
    run("query", "mesh.espl", "pairs", code=5)
