"""PLY: vertices, faces and triangle strips, as text and binary."""

import re
import struct

from .surface import Broken, Surface, without_repeats

CODES = {
    "char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H", "uint16": "H",
    "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d", "float64": "d",
}


def values_of(data, order, code, at, count):
    values = struct.unpack_from(order + str(count) + code, data, at)
    return values, at + struct.calcsize(order + str(count) + code)


def read(path):
    with open(path, "rb") as file:
        data = file.read()
    end = re.search(rb"end_header[ \t]*\r?\n", data)
    if not data.startswith(b"ply") or end is None:
        raise Broken("no header")
    form = None
    elements = []
    for line in data[:end.start()].decode("latin-1").splitlines():
        words = line.split()
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    rows = {}
    try:
        if form == "ascii":
            read_text(data[end.end():], elements, rows)
        else:
            read_binary(data, end.end(), "<" if form == "binary_little_endian" else ">", elements, rows)
    except (struct.error, IndexError, ValueError) as error:
        raise Broken(str(error)) from error
    return surface_of(rows)


def read_text(data, elements, rows):
    lines = iter([line.split() for line in data.decode("latin-1").splitlines() if line.strip()])
    for name, count, properties in elements:
        for _ in range(count):
            words = next(lines, [])
            row = {}
            for declaration in properties:
                if declaration[0] == "list":
                    length = int(words[0])
                    if len(words) < 1 + length:
                        raise IndexError("short line")
                    row[declaration[3]] = [float(word) for word in words[1:1 + length]]
                    words = words[1 + length:]
                else:
                    row[declaration[1]] = float(words[0])
                    words = words[1:]
            rows.setdefault(name, []).append(row)


def read_binary(data, at, order, elements, rows):
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for declaration in properties:
                if declaration[0] == "list":
                    (length,), at = values_of(data, order, CODES[declaration[1]], at, 1)
                    row[declaration[3]], at = values_of(data, order, CODES[declaration[2]], at, length)
                else:
                    (row[declaration[1]],), at = values_of(data, order, CODES[declaration[0]], at, 1)
            rows.setdefault(name, []).append(row)


def surface_of(rows):
    vertices = [(row["x"], row["y"], row["z"]) for row in rows.get("vertex", [])]
    surface = Surface()

    def add(indices):
        if any(index < 0 or index >= len(vertices) for index in indices):
            raise Broken("index out of range")
        corners = without_repeats(indices)
        if corners:
            surface.add([vertices[int(index)] for index in corners])

    def indices_of(row):
        return row["vertex_indices"] if "vertex_indices" in row else row["vertex_index"]

    for row in rows.get("face", []):
        if len(indices_of(row)) >= 3:
            add(indices_of(row))
    for row in rows.get("tristrips", []):
        strip = []
        for index in list(indices_of(row)) + [-1]:
            if index >= 0:
                strip.append(index)
                continue
            for i in range(2, len(strip)):
                if len(set(strip[i - 2:i + 1])) == 3:
                    add(strip[i - 2:i + 1])
            strip = []
    return surface
