"""STL, as text and binary."""

import struct

from .surface import Broken, Surface


def read(path):
    with open(path, "rb") as file:
        data = file.read()
    surface = Surface()
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else None
    if count is not None and len(data) == 84 + 50 * count:
        for i in range(count):
            numbers = struct.unpack_from("<12f", data, 84 + 50 * i)
            surface.add([numbers[3:6], numbers[6:9], numbers[9:12]])
        return surface
    if not data.lstrip().lower().startswith(b"solid"):
        raise Broken("neither text nor as long as its triangles")
    corners = []
    for line in data.decode("latin-1").lower().splitlines():
        words = line.split()
        if words[:1] == ["vertex"]:
            corners.append([float(word) for word in words[1:4]])
        elif words[:1] == ["endfacet"]:
            if len(corners) != 3:
                raise Broken("a facet without three corners")
            surface.add(corners)
            corners = []
    if corners:
        raise Broken("ends within a facet")
    return surface
