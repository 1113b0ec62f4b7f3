"""Runs the command on a small file and compares what it reports."""
import json
import os
import subprocess

BOX = [(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 4)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [(q[0], q[i], q[i + 1]) for q in QUADS for i in (1, 2)]
BOX_BOUNDS = ([0, 0, 0], [1, 2, 4])
SQUARE = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
SQUARE_BOUNDS = ([0, 0, 0], [2, 2, 0])


class Claims:
    def __init__(self, espalier, folder):
        self.espalier = espalier
        self.folder = folder
        self.blob = os.path.join(folder, "blob.espl")
        self.failures = 0

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(content.encode("latin-1") if isinstance(content, str) else content)
        return path

    def run(self, name, *options):
        path = os.path.join(self.folder, name)
        if os.path.exists(self.blob):
            os.remove(self.blob)
        command = [self.espalier, "bake", path, "-o", self.blob, "--json", *options]
        process = subprocess.run(command, capture_output=True, timeout=300, check=False)
        return process.returncode, json.loads(process.stdout or b"{}"), process.stderr.decode("utf-8", "replace")

    def check(self, claim, is_right, found):
        if not is_right:
            self.failures += 1
            print(f"FAILED: {claim}: {found}")

    def bakes(self, claim, name, content, triangles, bounds, warnings=(), options=(), closed=None, **expected):
        """The file bakes to that many triangles and exactly those bounds, with warnings of these kinds."""
        self.write(name, content)
        code, document, stderr = self.run(name, *options)
        self.check(claim, code == 0, stderr)
        if code != 0:
            return {}
        self.check(claim, document["triangles"] == triangles, f"{document['triangles']} triangles, not {triangles}")
        found = (document["bounds"]["min"], document["bounds"]["max"])
        self.check(claim, found == bounds, f"bounds {found}, not {bounds}")
        kinds = [warning["kind"] for warning in document["warnings"]]
        self.check(claim, kinds == list(warnings), f"warnings {document['warnings']}, not {warnings}")
        if closed is not None:
            self.check(claim, document["closed"] == closed, f"closed: {document['closed']}")
        for key, value in expected.items():
            self.check(claim, document["inputs"][0][key] == value, f"{key} is {document['inputs'][0][key]}, not {value}")
        return document

    def refuses(self, claim, name, content, *words, options=()):
        """The file is refused with its name and these words, and no blob is left."""
        path = self.write(name, content)
        code, document, stderr = self.run(name, *options)
        message = document.get("error", {}).get("message", "")
        self.check(claim, code in (3, 5), f"exit status {code}: {stderr}")
        for word in (path, *words):
            self.check(claim, word in message, f"'{word}' is not in: {message}")
        self.check(claim, not os.path.exists(self.blob), "a blob is left")


def check_area(claims, claim, name, corners):
    """The triangles that were baked from the file have the polygon's area together."""
    expected = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))) / 2
    total = 0.0
    mesh = os.path.join(claims.folder, "area.obj")
    path = os.path.join(claims.folder, name)
    subprocess.run([claims.espalier, "bake", path, "-o", claims.blob, "--reorder", mesh, "-q"], check=True)
    vertices = []
    with open(mesh, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                a, b, c = (vertices[int(word.split("/")[0]) - 1] for word in words[1:4])
                total += abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
    claims.check(claim, total == expected, f"area {total}, not {expected}")


def check_materials(claims, claim, name, expected):
    """The material of the source's triangles, in their order."""
    path = os.path.join(claims.folder, name)
    subprocess.run([claims.espalier, "bake", path, "-o", claims.blob, "--materials", "--ids", "-q"], check=True)
    answer = subprocess.run([claims.espalier, "query", claims.blob, "triangles", "--json"], capture_output=True, check=False)
    triangles = json.loads(answer.stdout or b"{}").get("triangles", [])
    found = {triangle["original"]["triangle"]: triangle.get("material") for triangle in triangles}
    claims.check(claim, [found.get(i) for i in range(len(expected))] == expected, answer.stdout[:2000])
