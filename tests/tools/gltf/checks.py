"""Runs the command on a file and compares the baked triangles with the expected ones."""
import json
import math
import os
import subprocess
import sys
import tempfile

from .builder import *

ESPALIER = os.path.abspath(sys.argv[1])
claims, broken, claim_text = 0, 0, ""

# A solid of four different corners, counter-clockwise from outside, in whole eighths.
POINTS = [(0.0, 0.0, 0.0), (2.0, 0.25, 0.0), (0.5, 1.5, 0.0), (0.25, 0.5, 3.0)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def claim(text):
    global claims, claim_text
    claims, claim_text = claims + 1, text


def fail(problem):
    global broken
    broken += 1
    print("BROKEN: %s: %s" % (claim_text, problem))


def run(*arguments, code=0, says=()):
    """Runs the command, which ends with this exit status and these words on stderr."""
    done = subprocess.run([ESPALIER, *arguments], capture_output=True, text=True, timeout=300)
    if done.returncode != code:
        fail("'%s' ended with %d, not %d: %s" % (" ".join(arguments), done.returncode, code, done.stderr[:600]))
    has(done.stderr, *says)
    return done


def has(text, *words):
    for word in words:
        if word not in text:
            fail("'%s' is not in: %s" % (word, text[:600]))


def absent(*paths):
    for path in paths:
        if os.path.exists(path):
            fail("%s is there" % path)


# ---- transforms --------------------------------------------------------------------------------------------------------
IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def moved(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def scaled(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def turned_about_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def quaternion_about_z(degrees):
    return [0, 0, math.sin(math.radians(degrees / 2)), math.cos(math.radians(degrees / 2))]


def columns(matrix):
    return [matrix[row][column] for column in range(4) for row in range(4)]


def applied(matrix, point):
    return tuple(sum(matrix[i][k] * point[k] for k in range(3)) + matrix[i][3] for i in range(3))


def solid(matrix=IDENTITY, points=POINTS, mirrored=False):
    """The triangles of POINTS and FACES under a transform; mirrored ones run the other way round."""
    placed = [applied(matrix, point) for point in points]
    return [tuple(placed[i] for i in (face if not mirrored else (face[0], face[2], face[1]))) for face in FACES]


# ---- comparing ---------------------------------------------------------------------------------------------------------
def distance(a, b):
    """How far the corners of two triangles are apart, in the best of the three turns."""
    return min(max(math.dist(a[i], b[(i + turn) % 3]) for i in range(3)) for turn in range(3))


def compare(expected, actual, tolerance):
    """Every expected triangle is there once, with its front where it was; and nothing else is."""
    if len(expected) != len(actual):
        fail("%d triangles, not %d" % (len(actual), len(expected)))
        return
    left = list(actual)
    for triangle in expected:
        best = min(left, key=lambda other: distance(triangle, other))
        if distance(triangle, best) > tolerance:
            fail("no triangle at %s; the nearest is %s" % (triangle, best))
            return
        left.remove(best)


def corners_of(blob):
    listed = json.loads(run("query", blob, "triangles", "--json").stdout)["triangles"]
    return [tuple(tuple(triangle[corner]) for corner in "abc") for triangle in listed]


def bakes(gltf, expected, tolerance=None, name="case.glb", options=()):
    """The file bakes to these triangles, within the blob's own bound and a rounding to float32. Returns the bake."""
    if not isinstance(gltf, str):
        gltf.write(name)
    done = run("bake", name if not isinstance(gltf, str) else gltf, "-o", "case.espl", "--json", *options)
    if done.returncode != 0:
        return done
    report = json.loads(done.stdout)
    size = max(abs(x) for triangle in expected for corner in triangle for x in corner) if expected else 1.0
    compare(expected, corners_of("case.espl"), report["max_error"] + 1e-6 * size + (tolerance or 0.0))
    return done


def refused(gltf, code, *words, name="case.gltf"):
    """The file is refused with this exit status and these words, and nothing is written."""
    if not isinstance(gltf, str):
        gltf.write(name)
        gltf = name
    if os.path.exists("refused.espl"):
        os.remove("refused.espl")
    done = run("bake", gltf, "-o", "refused.espl", "--json", code=code, says=words)
    if done.returncode == code and json.loads(done.stdout)["error"]["file"] != gltf:
        fail("the error in JSON names another file: %s" % done.stdout)
    absent("refused.espl")


def primitive(gltf, points, faces, **rest):
    return {"attributes": {"POSITION": gltf.accessor(points)},
            "indices": gltf.accessor([[i] for face in faces for i in face], UNSIGNED_SHORT), **rest}


def solid_primitive(gltf, **rest):
    return primitive(gltf, POINTS, FACES, **rest)


def solid_file(**node):
    gltf = Gltf()
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf)), **node)
    return gltf


def changed(gltf, path, *value):
    """The file with another value at "accessors.0.count", or without that member."""
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place = gltf.json
    for key in way:
        place = place[key]
    if value:
        place[last], = value
    else:
        del place[last]
    return gltf


def indexed_file(position, corners=(), component=UNSIGNED_BYTE, **node):
    """A mesh of FACES, and of more corners, of the positions that position(gltf) stores."""
    gltf = Gltf()
    indices = [[i] for face in FACES for i in face] + [[i] for i in corners]
    primitive = {"attributes": {"POSITION": position(gltf)}, "indices": gltf.accessor(indices, component)}
    gltf.node(mesh=gltf.mesh(primitive), **node)
    return gltf


def warned(done, kind, expected=True):
    """The bake has a warning of this kind, by its JSON."""
    warnings = json.loads(done.stdout)["warnings"] if done.returncode == 0 else []
    if any(w["kind"] == kind for w in warnings) != expected:
        fail("warnings are %s" % warnings)


def run_parts(*parts):
    """Runs those that the command line names, or all, in a folder that it names or in one of their own. Ends the program."""
    with tempfile.TemporaryDirectory() as temporary:
        os.chdir(sys.argv[2] if len(sys.argv) > 2 else temporary)
        for part in parts:
            if len(sys.argv) < 4 or part.__name__ in sys.argv[3:]:
                part()
        os.chdir("/")
    print("%d claims, %d broken" % (claims, broken))
    sys.exit(1 if broken else 0)
