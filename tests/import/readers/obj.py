"""Wavefront OBJ: vertices and faces."""

import codecs
import re

from .surface import Broken, Surface, without_repeats

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")


def decoded(data):
    for mark, encoding in ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be")):
        if data.startswith(mark):
            return data[len(mark):].decode(encoding, "replace")
    return data.decode("latin-1")


def number(word):
    if not NUMBER.match(word):
        raise Broken(word)
    return float(word)


def read(path):
    with open(path, "rb") as file:
        content = decoded(file.read())
    lines = []
    continues = False
    for line in re.split("\r\n|\n|\r", content):
        if continues:
            lines[-1] += " " + line
        else:
            lines.append(line)
        continues = line.endswith("\\") and not lines[-1].lstrip().startswith("#")
        if continues:
            lines[-1] = lines[-1][:-1]
    vertices = []
    faces = []
    for line in lines:
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([number(word) for word in words[1:4]])
        elif words[0] == "f":
            indices = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([index - 1 if index > 0 else len(vertices) + index if index < 0 else -1 for index in indices])
    surface = Surface()
    for face in faces:
        if len(face) < 3:
            continue
        if not all(0 <= index < len(vertices) for index in face):
            raise Broken("index out of range")
        corners = without_repeats(face)
        if corners:
            surface.add([vertices[index] for index in corners])
    return surface
