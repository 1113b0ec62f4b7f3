"""glTF 1.0 and 2.0: the triangles of the scene, placed by its nodes, skins in the pose of their joints."""

import base64
import json
import os
import struct
import urllib.parse

from .surface import Broken, Surface, Unsupported

# Extensions that change neither positions nor triangles.
HARMLESS = (
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_technique_webgl", "KHR_techniques_webgl", "KHR_binary_glTF",
    "KHR_mesh_quantization", "KHR_xmp", "EXT_texture_", "KHR_animation_pointer",
)
CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, STRIP, FAN = range(7)
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]  # by columns, as all matrices here


def product(a, b):
    return [sum(a[4 * k + row] * b[4 * column + k] for k in range(4)) for column in range(4) for row in range(4)]


def transformed(matrix, point):
    return [sum(matrix[4 * k + row] * (list(point) + [1])[k] for k in range(4)) for row in range(3)]


def local_matrix(node):
    if "matrix" in node:
        return node["matrix"]
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    sx, sy, sz = node.get("scale", [1, 1, 1])
    tx, ty, tz = node.get("translation", [0, 0, 0])
    return [
        sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w), 0,
        sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w), 0,
        sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y)), 0,
        tx, ty, tz, 1,
    ]


class Document:
    def __init__(self, path):
        self.folder = os.path.dirname(path)
        with open(path, "rb") as file:
            data = file.read()
        self.body = None
        if data[:4] == b"glTF":
            data = self.unpacked(data)
        try:
            self.json = json.loads(data.decode("utf-8-sig"))
        except ValueError as error:
            raise Broken(str(error)) from error
        for extension in self.json.get("extensionsRequired", []) + self.json.get("extensionsUsed", []):
            if not extension.startswith(HARMLESS):
                raise Unsupported(extension)
        self.buffers = {}

    def unpacked(self, data):
        version, _, length, kind = struct.unpack_from("<IIII", data, 4)
        if version == 1:
            self.body = data[20 + length:]
            return data[20:20 + length]
        at = 20 + length
        if at + 8 <= len(data):
            size = struct.unpack_from("<I", data, at)[0]
            self.body = data[at + 8:at + 8 + size]
        return data[20:20 + length]

    def item(self, kind, key):
        items = self.json.get(kind, [])
        try:
            return items[key]
        except (KeyError, IndexError, TypeError) as error:
            raise Broken(f"{kind} {key}") from error

    def buffer(self, key):
        if key not in self.buffers:
            uri = self.item("buffers", key).get("uri")
            if uri is None or key == "binary_glTF":
                self.buffers[key] = self.body
            elif uri.startswith("data:"):
                self.buffers[key] = base64.b64decode(uri.split(",", 1)[1])
            else:
                try:
                    with open(os.path.join(self.folder, urllib.parse.unquote(uri)), "rb") as file:
                        self.buffers[key] = file.read()
                except OSError as error:
                    raise Broken(str(error)) from error
        return self.buffers[key]

    def stored(self, view_key, offset, component, width, count, stride=None):
        view = self.item("bufferViews", view_key)
        data = self.buffer(view["buffer"])
        form = "<" + str(width) + CODES[component]
        stride = view.get("byteStride") or stride or struct.calcsize(form)
        at = view.get("byteOffset", 0) + offset
        try:
            return [list(struct.unpack_from(form, data, at + i * stride)) for i in range(count)]
        except struct.error as error:
            raise Broken(str(error)) from error

    def accessor(self, key):
        accessor = self.item("accessors", key)
        component = accessor["componentType"]
        width = WIDTHS[accessor["type"]]
        count = accessor["count"]
        if "bufferView" in accessor:
            values = self.stored(accessor["bufferView"], accessor.get("byteOffset", 0), component, width, count,
                                 accessor.get("byteStride"))
        else:
            values = [[0] * width for _ in range(count)]
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            where = sparse["indices"]
            what = sparse["values"]
            indices = self.stored(where["bufferView"], where.get("byteOffset", 0), where["componentType"], 1, sparse["count"])
            changed = self.stored(what["bufferView"], what.get("byteOffset", 0), component, width, sparse["count"])
            for (index,), value in zip(indices, changed):
                values[index] = value
        if accessor.get("normalized"):
            values = [[max(value / LARGEST[component], -1.0) for value in row] for row in values]
        return values


def triangles_of(mode, indices):
    if mode == TRIANGLES:
        return [indices[i:i + 3] for i in range(0, len(indices) - 2, 3)]
    if mode == STRIP:
        return [indices[i:i + 3] for i in range(len(indices) - 2)]
    if mode == FAN:
        return [[indices[0], indices[i], indices[i + 1]] for i in range(1, len(indices) - 1)]
    return []


def morphed(document, primitive, positions, weights):
    for target, weight in zip(primitive.get("targets", []), weights):
        if weight and "POSITION" in target:
            for position, delta in zip(positions, document.accessor(target["POSITION"])):
                for axis in range(3):
                    position[axis] += weight * delta[axis]


def skinned(document, primitive, positions, skin, worlds):
    attributes = primitive["attributes"]
    joints = skin["joints"]
    inverse = document.accessor(skin["inverseBindMatrices"]) if "inverseBindMatrices" in skin else [IDENTITY] * len(joints)
    matrices = [product(worlds[joint], bind) for joint, bind in zip(joints, inverse)]
    result = []
    for point, numbers, weights in zip(positions, document.accessor(attributes["JOINTS_0"]), document.accessor(attributes["WEIGHTS_0"])):
        placed = [0, 0, 0]
        for joint, weight in zip(numbers, weights):
            if weight:
                moved = transformed(matrices[joint], point)
                placed = [placed[axis] + weight * moved[axis] for axis in range(3)]
        result.append(placed)
    return result


def read(path):
    document = Document(path)
    scene = document.item("scenes", document.json.get("scene", 0))
    worlds = {}
    waiting = [(key, IDENTITY) for key in scene.get("nodes", [])]
    while waiting:
        key, parent = waiting.pop()
        if key in worlds:
            raise Broken("a node has two parents")
        node = document.item("nodes", key)
        worlds[key] = product(parent, local_matrix(node))
        waiting.extend((child, worlds[key]) for child in node.get("children", []))
    surface = Surface()
    for key, world in worlds.items():
        node = document.item("nodes", key)
        meshes = node.get("meshes", []) if "meshes" in node else [node["mesh"]] if "mesh" in node else []
        for mesh_key in meshes:
            mesh = document.item("meshes", mesh_key)
            for primitive in mesh["primitives"]:
                add_primitive(document, primitive, node, mesh, world, worlds, surface)
    return surface


def add_primitive(document, primitive, node, mesh, world, worlds, surface):
    if "POSITION" not in primitive["attributes"]:
        return
    positions = document.accessor(primitive["attributes"]["POSITION"])
    morphed(document, primitive, positions, node.get("weights", mesh.get("weights", [])))
    if "skin" in node and "JOINTS_0" in primitive["attributes"]:
        placed = skinned(document, primitive, positions, document.item("skins", node["skin"]), worlds)
    else:
        placed = [transformed(world, position) for position in positions]
    if "indices" in primitive:
        indices = [index for (index,) in document.accessor(primitive["indices"])]
    else:
        indices = list(range(len(positions)))
    mode = primitive.get("mode", TRIANGLES)
    for triangle in triangles_of(mode, indices):
        if any(index >= len(placed) for index in triangle):
            raise Broken("index out of range")
        if mode == TRIANGLES or len(set(triangle)) == 3:
            surface.add([placed[index] for index in triangle])
