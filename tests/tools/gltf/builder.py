"""Small glTF files for the claims about the command, made without code of the project."""
import base64
import json
import struct

BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
FORMATS = {BYTE: "b", UNSIGNED_BYTE: "B", SHORT: "h", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I", FLOAT: "f"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


def packed(rows, component, stride=0):
    """The rows' numbers as little-endian bytes, each row padded to the stride."""
    result = b""
    for row in rows:
        one = struct.pack("<%d%s" % (len(row), FORMATS[component]), *row)
        result += one + b"\0" * max(stride - len(one), 0)
    return result


class Gltf:
    """A file under construction: one buffer, into which everything goes."""

    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": [], "meshes": [], "nodes": []}

    def append(self, data):
        self.bytes += b"\0" * (-len(self.bytes) % 8)
        offset = len(self.bytes)
        self.bytes += data
        return offset

    def view(self, data, stride=0):
        view = {"buffer": 0, "byteOffset": self.append(data), "byteLength": len(data)}
        if stride:
            view["byteStride"] = stride
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, component=FLOAT, normalized=False, stride=0, view=None, sparse=None):
        """Stores the rows, or describes those of a view. Returns the accessor's number."""
        accessor = {"componentType": component, "count": len(rows), "type": TYPES[len(rows[0])]}
        if normalized:
            accessor["normalized"] = True
        if view is not False:
            accessor["bufferView"] = self.view(packed(rows, component, stride), stride) if view is None else view
        if sparse:
            places, values, places_component = sparse
            accessor["sparse"] = {
                "count": len(places),
                "indices": {"bufferView": self.view(packed([[p] for p in places], places_component)),
                            "componentType": places_component},
                "values": {"bufferView": self.view(packed(values, component))}}
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def mesh(self, *primitives, **rest):
        self.json["meshes"].append({"primitives": list(primitives), **rest})
        return len(self.json["meshes"]) - 1

    def node(self, **members):
        self.json["nodes"].append(members)
        return len(self.json["nodes"]) - 1

    def extension(self, name, required=True):
        for key in ("extensionsUsed", "extensionsRequired")[:2 if required else 1]:
            self.json[key] = sorted(set(self.json.get(key, [])) | {name})

    def document(self, uri=None):
        children = {c for node in self.json["nodes"] for c in node.get("children", [])}
        tops = [i for i in range(len(self.json["nodes"])) if i not in children]
        document = {"scenes": [{"nodes": tops}], "scene": 0, **self.json}
        buffer = {"byteLength": len(self.bytes)}
        if uri is not None:
            buffer["uri"] = uri
        if "buffers" not in document:
            document["buffers"] = [buffer]
        return {key: value for key, value in document.items() if value != []}

    def write(self, path, bytes_beside=None):
        """As .glb, or as .gltf with its buffer in base64 or in the file `bytes_beside` = (path, uri)."""
        if path.endswith(".glb"):
            text = json.dumps(self.document()).encode()
            text += b" " * (-len(text) % 4)
            data = self.bytes + b"\0" * (-len(self.bytes) % 4)
            chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
            content = struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
        elif bytes_beside:
            with open(bytes_beside[0], "wb") as file:
                file.write(self.bytes)
            content = json.dumps(self.document(bytes_beside[1])).encode()
        else:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
            content = json.dumps(self.document(uri)).encode()
        with open(path, "wb") as file:
            file.write(content)


# ---- EXT_meshopt_compression, by its specification: the codecs' plainest forms -----------------------------------------
def zigzag(value):
    return value << 1 if value >= 0 else (-value << 1) - 1


def varint(value):
    result = b""
    while value > 127:
        result += bytes([value & 127 | 128])
        value >>= 7
    return result + bytes([value])


def meshopt_attributes(data, stride):
    """Byte by byte of the elements, differences in groups of 16: none when all are zero, else as they are."""
    rows = [data[i:i + stride] for i in range(0, len(data), stride)]
    result, last = b"\xa0", rows[0]
    block_size = min(256, 8192 // stride & ~15)
    for start in range(0, len(rows), block_size):
        block = rows[start:start + block_size]
        for column in range(stride):
            deltas, previous = [], last[column]
            for row in block:
                delta = (row[column] - previous + 128) % 256 - 128
                deltas.append(zigzag(delta) & 255)
                previous = row[column]
            deltas += [0] * (-len(deltas) % 16)
            groups = [deltas[i:i + 16] for i in range(0, len(deltas), 16)]
            modes = [3 if any(group) else 0 for group in groups] + [0] * (-len(groups) % 4)
            for i in range(0, len(modes), 4):
                result += bytes([sum(mode << 2 * k for k, mode in enumerate(modes[i:i + 4]))])
            result += b"".join(bytes(group) for group in groups if any(group))
        last = block[-1]
    return result + b"\0" * max(32 - stride, 0) + rows[0]


def meshopt_triangles(indices):
    """Every corner as a difference from the one before."""
    data, last = b"", 0
    for i in range(0, len(indices), 3):
        data += b"\xff"
        for index in indices[i:i + 3]:
            data += varint(zigzag(index - last))
            last = index
    return b"\xe1" + b"\xff" * (len(indices) // 3) + data + b"\0" * 16


def meshopt_sequence(indices):
    result, last = b"\xd1", 0
    for index in indices:
        result += varint(zigzag(index - last) << 1)
        last = index
    return result + b"\0" * 4


def exponential(value):
    """A float as 8 bits of exponent and 24 of mantissa; exact for whole eighths."""
    return (-3 & 255) << 24 | int(value * 8) & 0xffffff


def meshopt_view(gltf, encoded, count, stride, mode, filtering=None, byte_stride=True):
    """A view of packed bytes, whose unpacked ones have a buffer without data."""
    if len(gltf.json.setdefault("buffers", [None, None])) == 2:
        gltf.json["buffers"][1] = {"byteLength": 1 << 20,
                                   "extensions": {"EXT_meshopt_compression": {"fallback": True}}}
    packing = {"buffer": 0, "byteOffset": gltf.append(encoded), "byteLength": len(encoded), "byteStride": stride,
               "count": count, "mode": mode}
    if filtering:
        packing["filter"] = filtering
    view = {"buffer": 1, "byteLength": count * stride, "extensions": {"EXT_meshopt_compression": packing}}
    if byte_stride:
        view["byteStride"] = stride
    gltf.json["bufferViews"].append(view)
    gltf.json["buffers"][0] = {"byteLength": len(gltf.bytes)}
    gltf.extension("EXT_meshopt_compression")
    return len(gltf.json["bufferViews"]) - 1


# ---- Draco's bitstream 2.2: sequential, nothing compressed -------------------------------------------------------------
def draco_mesh(positions, triangles, position_id):
    result = b"DRACO" + bytes([2, 2, 1, 0]) + struct.pack("<H", 0)
    result += varint(len(triangles)) + varint(len(positions)) + b"\1"
    result += b"".join(bytes(triangle) for triangle in triangles)
    result += b"\1" + varint(1) + bytes([0, 9, 3, 0]) + varint(position_id) + b"\0"
    return result + packed(positions, FLOAT)
