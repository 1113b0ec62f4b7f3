"""The other verbs on scenes: their answers are those of the same triangles in one blob."""
import os
import random
import struct
import subprocess

from .files import *


def forest():
    """A scene of turned and scaled sheets and its flattened blob, on lattices far finer than the comparisons."""
    matrices = []
    for i in range(9):
        turn = times(turned_about_z(7 * i), scaled(1 + i % 3, 1 + i % 3, 1 + i % 3))
        matrices.append(times(moved(50 * (i % 3), 3 * i, 45 * (i // 3)), turn))
    sheets(matrices).write("forest.glb")
    run("bake", "forest.glb", "-o", "forest.esps", "--instances", "auto", "--tolerance", "0.02mm", "--ids", "-q")
    run("bake", "forest.glb", "-o", "forest.espl", "--tolerance", "0.02mm", "--ids", "-q")


def ask(path, *words, code=0):
    return documented("query", run("query", path, *map(str, words), "--json", code=code).stdout)


def queries():
    forest()
    chance = random.Random(5)
    claim("rays and segments hit what they hit in one blob, and name instance and source")
    hits = 0
    for _ in range(12):
        origin = [chance.uniform(-10, 130), 60.0, chance.uniform(-10, 120)]
        direction = [chance.uniform(-0.2, 0.2), -1.0, chance.uniform(-0.2, 0.2)]
        scene, blob = ask("forest.esps", "ray", *origin, *direction), ask("forest.espl", "ray", *origin, *direction)
        is_equal("the hit", scene["hit"], blob["hit"])
        if not scene["hit"] or not blob["hit"]:
            continue
        hits += 1
        close("t", scene["t"], blob["t"], 2e-3)
        is_equal("the triangle of the source", scene["original"]["triangle"], blob["original"]["triangle"])
        is_equal("the mesh of the source", scene["user"], blob["original"]["mesh"])
        any_hit = ask("forest.esps", "ray", *origin, *direction, "--any")
        is_equal("occluded", any_hit["occluded"], True)
        everything = ask("forest.esps", "ray", *origin, *direction, "--all")
        is_equal("the first of all", min(h["t"] for h in everything["hits"]), scene["t"])
        masked = ask("forest.esps", "ray", *origin, *direction, "--mask", "0")
        is_equal("the hit with a mask of no bit", masked["hit"], False)
    if hits < 3:
        fail("only %d rays hit" % hits)
    claim("overlaps, distances and sweeps find what they find in one blob")
    for _ in range(4):
        at = [chance.uniform(0, 110), chance.uniform(0, 25), chance.uniform(0, 100)]
        corner = [x + 9 for x in at]
        found = []
        for shape in (("sphere", *at, 6), ("capsule", *at, *corner, 3), ("box", *at, *corner), ("cone", *at, 0, 9, 0, 4),
                      ("triangle", *at, *corner, at[0], corner[1], at[2]),
                      ("oriented-box", *at, 5, 1, 0, -1, 5, 0, 0, 0, 4)):
            scene, blob = ask("forest.esps", *shape), ask("forest.espl", *shape)
            found.append((shape[0], scene["count"], blob["count"]))
            is_equal("any", ask("forest.esps", *shape, "--any")["overlaps"], scene["count"] > 0)
        if any(abs(a - b) > 1 for _, a, b in found):
            fail("counts are %s" % found)
        scene, blob = ask("forest.esps", "closest-point", *at), ask("forest.espl", "closest-point", *at)
        close("the distance", scene["distance"], blob["distance"], 1e-3)
        scene, blob = (ask(path, "sweep-sphere", *at, 0.5, 0, -40, 0) for path in ("forest.esps", "forest.espl"))
        is_equal("the contact", scene["hit"], blob["hit"])
        if scene["hit"] and blob["hit"]:
            close("t", scene["t"], blob["t"], 1e-3)
        corners = [c for x in (at[0], corner[0]) for z in (at[2], corner[2]) for c in (x, at[1], z)]
        for shape in (("sweep-capsule", *at, *corner, 0.5, 0, -40, 0), ("sweep-box", *at, *corner, 0, -40, 0),
                      ("sweep-oriented-box", *at, 5, 1, 0, -1, 5, 0, 0, 0, 4, 0, -40, 0),
                      ("sweep-hull", 0, -40, 0, *corners)):
            for options in ((), ("--culling", "back"), ("--ignore-leaving",)):
                scene, blob = (ask(path, *shape, *options) for path in ("forest.esps", "forest.espl"))
                is_equal("the contact of %s" % shape[0], scene["hit"], blob["hit"])
                if scene["hit"]:
                    close("t", scene["t"], blob["t"], 1e-3)
                    is_equal("the start", scene["starts_overlapping"], blob["starts_overlapping"])
            is_equal("a mask of no bit", ask("forest.esps", *shape, "--mask", "0")["hit"], False)
    stops = 0
    for _ in range(12):
        ball = [chance.uniform(0, 110), 80, chance.uniform(0, 100), 0.5, 0, -100, 0]
        scene, stopped = (ask("forest.esps", "sweep-sphere", *ball, "--skin", skin) for skin in (0, 2))
        if scene["hit"] and scene["normal"][1] > 0.5:
            stops += 1
            close("the skin in world units", (scene["t"] - stopped["t"]) * 100 * scene["normal"][1], 2, 1e-3)
    if stops == 0:
        fail("no ball was stopped by its skin")
    claim("limits, lists of candidates, instances and bounds")
    limited = ask("forest.esps", "box", -500, -500, -500, 500, 500, 500, "--limit", "5")
    is_equal("the limited list", (limited["status"], limited["count"]), ("output_full", 5))
    listed = ask("forest.esps", "candidates", -500, -500, -500, 500, 500, 500)
    is_equal("the candidates", [i["instance"] for i in listed["instances"]], list(range(listed["count"])))
    one = ask("forest.esps", "instance", 0)
    is_equal("the instance", one["source"] in range(9), True)
    has(run("query", "forest.esps", "instance", "0").stdout, "scale ")
    ask("forest.esps", "bounds")
    claim("what a scene does not answer is refused, and says so")
    for words, text in ((["contains", 0, 0, 0], "contains"), (["tree"], "tree"),
                        (["lattice-segment", *[0] * 6], "lattice-segment"),
                        (["ray", 0, 0, 0, 1, 0, 0, "--first", 2], "--first"),
                        (["sphere", 0, 0, 0, 1, "--accuracy", 1], "--accuracy"),
                        (["overlaps", "forest.espl"], "overlaps")):
        run("query", "forest.esps", *map(str, words), code=5, says=(text, "forest.esps"))
    run("query", "forest.espl", "instance", "0", code=5)
    run("query", "forest.espl", "ray", *"0 0 0 1 0 0 --mask 1".split(), code=5)
    run("query", "forest.esps", "ray", *"0 0 0 1 0 0 --mask x".split(), code=1)
    run("query", "forest.esps", "instance", "99999", code=6, says=("instance is 99999; the scene has ",))
    run("query", "forest.esps", "ray", *"nan 0 0 1 0 0".split(), code=6)
    run("query", "forest.espl", "overlaps", "forest.esps", code=5)


def listings():
    forest()
    claim("info tells what is in a scene, and what it saves")
    info = documented("info", run("info", "forest.esps", "--json").stdout)
    is_equal("the bytes", info["bytes"], os.path.getsize("forest.esps"))
    is_equal("the bytes of the sections", sum(info["sections"].values()), info["bytes"])
    is_equal("instances", (info["instances"], len(info["meshes"])), (9, 1))
    close("the estimate", info["flattened_bytes"] / os.path.getsize("forest.espl"), 1, 0.25)
    close("the scales", info["meshes"][0]["largest_scale"] / info["meshes"][0]["least_scale"], 3, 1e-5)
    is_equal("the common lattice of turned sheets", info["common_lattice"]["instances"], 1)
    sheets([moved(50 * i, 0, 0) for i in range(4)]).write("row.glb")
    run("bake", "row.glb", "-o", "row.esps", "--instances", "all", "--step", "2^-10", "-q")
    lattice = documented("info", run("info", "row.esps", "--json").stdout)["common_lattice"]
    is_equal("the instances on the common lattice", lattice["instances"], 4)
    has(run("info", "row.esps").stdout, "common step   %s, of 4 instances" % lattice["step"])
    with_quality = documented("info", run("info", "forest.esps", "--histogram", "--json").stdout)["meshes"]
    leaves = [[leaf["triangles"] * leaf["leaves"] for leaf in mesh["tree_quality"]["leaf_sizes"]] for mesh in with_quality]
    is_equal("the triangles in leaves", [sum(of_mesh) for of_mesh in leaves], [mesh["triangles"] for mesh in with_quality])
    if run("info", "forest.esps", "--histogram").stdout.count("areas so far") != len(info["meshes"]):
        fail("info --histogram does not print the tree of each mesh")
    has(run("info", "forest.esps").stdout, "scene 1.0", "instances     9", "meshes        1", "bounds", "max error", "depth",
        "flattened", "mesh 0")
    claim("dump shows every byte once and in order")
    listed = run("dump", "forest.esps").stdout.splitlines()
    shown = "".join(line[10:57].replace(" ", "") for line in listed if not line.startswith("--"))
    is_equal("the bytes", shown, open("forest.esps", "rb").read().hex())
    has("\n".join(listed), 'magic "ESPS"', "mesh 0 has", 'magic "ESPL"', "first instance 0", "instance 8: rotation", "source ")
    documented("dump", run("dump", "forest.esps", "--limit", "100", "--json").stdout)
    claim("verify checks a scene, deep and against its source")
    run("verify", "forest.esps", "--deep", "--source", "forest.glb")
    documented("verify", run("verify", "forest.esps", "--deep", "--source", "forest.glb", "--json").stdout)
    run("verify", "forest.esps", "--source", "forest.glb", "--scale", "1.01", code=3)
    claim("verify finds triangles that a scene has and its source has not, and the other way round")
    points, faces = grid(12)
    places = [IDENTITY, moved(30, 0, 0), times(moved(0, 30, 0), turned_about_z(30)), times(moved(0, -30, 0), scaled(-2, 2, 2))]
    turned = faces[:-1] + [tuple(reversed(faces[-1]))]
    for name, kept in (("whole", faces), ("less", faces[:-1]), ("turned", turned)):
        baked(placed_by(places, "sheet", points, kept), "all", name=name + ".glb", output=name + ".esps")
        run("verify", name + ".esps", "--source", name + ".glb")
    all_of_them = 4 * len(faces)
    run("verify", "whole.esps", "--source", "less.glb", code=3,
        says=("4 of %d triangles of the scene are not in the source, the first: triangle " % all_of_them, " of instance 0"))
    run("verify", "less.esps", "--source", "whole.glb", code=3,
        says=("4 of %d triangles of the source are not in the scene, the first: whole.glb, mesh 0 (sheet), triangle %d."
              % (all_of_them, len(faces) - 1),))
    run("verify", "whole.esps", "--source", "turned.glb", code=3, says=("the first: turned.glb", "not in the source"))
    claim("render draws a scene, and counts no steps of it")
    run("render", "forest.esps", "-o", "forest.png", "--size", "64x48")
    run("render", "forest.espl", "-o", "flat.png", "--size", "64x48")
    run("render", "forest.esps", "-o", "heat.png", "--heatmap", "steps", code=5)
    claim("embed takes a scene")
    run("embed", "forest.esps", "-o", "forest.c", "--header", "forest.h")
    has(open("forest.h").read(), "forest[%d]" % os.path.getsize("forest.esps"))


def broken():
    claim("a scene that is cut short, changed or newer is refused by every verb")
    forest()
    data = open("forest.esps", "rb").read()
    changed = bytearray(data)
    changed[len(data) // 2] ^= 1
    for name, content in (("short", data[:-1]), ("stub", data[:20]), ("long", data + b"x"), ("changed", bytes(changed))):
        with open(name + ".esps", "wb") as file:
            file.write(content)
        for verb in (["info"], ["verify"], ["dump"], ["query", 0, "ray", *"0 0 0 1 0 0".split()], ["render", 0, "-o", "x.png"],
                     ["embed", 0, "-o", "x.c"]):
            words = [name + ".esps" if word == 0 else word for word in verb]
            run(*(words if 0 in verb else words + [name + ".esps"]), code=3, says=["'%s.esps' is refused: " % name])
    with open("newer.esps", "wb") as file:
        file.write(data[:4] + struct.pack("<H", 9) + data[6:])
    run("info", "newer.esps", code=5)
    claim("a scene is no mesh and no blob where one is needed")
    run("bake", "forest.esps", "-o", "x.espl", code=5)
    run("bake", "forest.glb", "-o", "x.espl", "--lattice-of", "forest.esps", code=5)
    claim("options of one blob are refused with --instances")
    for option in (["--remap", "r"], ["--reorder", "r.ply"], ["--max-bytes", "1M"], ["--fastest-under", "1M"], ["--max-error", "1mm"]):
        run("bake", "forest.glb", "-o", "x.esps", "--instances", "auto", *option, code=1, says=option[:1])
    run("bake", "forest.glb", "-o", "x.esps", "--instances", "some", code=1)
    absent("x.esps", "x.espl", "x.png", "x.c")


def policies():
    claim("policies hold for scenes: empty results, dropped triangles, sizes, warnings")
    empty = Gltf()
    empty.node(mesh=empty.mesh({"mode": 0, "attributes": {"POSITION": empty.accessor(POINTS)}}))
    for mode in ("auto", "all"):
        baked(empty, mode, code=3)
        report = baked(empty, mode, "--allow-empty")
        is_equal("an empty scene", (report["instance_count"], report["bytes"]), (0, 128))
        for verb in (["info"], ["verify", "--deep"], ["dump"]):
            run(verb[0], "case.esps", *verb[1:])
        is_equal("a ray", ask("case.esps", "ray", *"0 0 0 1 0 0".split())["hit"], False)
        run("render", "case.esps", "-o", "empty.png", "--size", "8x8")
        squashed = solids(IDENTITY, scaled(0, 0, 0), scaled(0, 0, 0))
        is_equal("the error", baked(squashed, mode, code=3)["error"]["kind"], "dropped")
        far = solids(IDENTITY, moved(4000, 0, 0))
        is_equal("warnings", [w["kind"] for w in baked(far, mode)["warnings"]], ["unexpected_size"])
        baked(far, mode, "--strict", code=3)
        baked(far, mode, "--expect-size", "4000m..4010m", "--strict")
        baked(far, mode, "--expect-size", "1m..2m", code=3)
    claim("a depfile names the scene and its sources")
    solids(IDENTITY).write("beside.gltf", ("beside.bin", "beside.bin"))
    run("bake", "beside.gltf", "-o", "case.esps", "--instances", "all", "--depfile", "case.d", "-q")
    rule = open("case.d").read()
    is_equal("the target", rule.split()[0], "case.esps:")
    has(rule, "beside.gltf", "beside.bin")
    claim("bake says for people what it made")
    run("bake", "beside.gltf", "-o", "case.esps", "--instances", "all",
        says=("scene: 1 instance of 1 mesh", "max error", "size: ", "wrote case.esps", "1 instance; 4 triangles"))
