"""Writes nodes with meshes as one binary glTF 2.0 file; the same nodes always give the same bytes.

glTF is y-up: an ENU point (x, y, z) is written as (x, z, -y).
"""
import array
import json
import math
import struct
import sys
from dataclasses import dataclass, field

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5123, 5125, 5126


@dataclass
class Node:
    name: str
    parts: list = field(default_factory=list)  # (material name, Mesh), one glTF primitive each
    position: tuple = (0.0, 0.0, 0.0)          # ENU metres, in the parent's frame
    yaw: float = 0.0                           # rad about the vertical, counter-clockwise from east
    pitch: float = 0.0                         # rad about the body's y axis; positive lowers the nose
    children: list = field(default_factory=list)
    strength: float | None = None              # dB re 1 m^2: the node is a point target, too


def y_up(p):
    return (p[0], p[2], -p[1])


def tidy(value):
    """Six decimals: keeps the noise of sin(pi) and the sign of zero out of the file."""
    return round(value, 6) + 0.0


def rotation(yaw, pitch):
    """glTF order x y z w of a turn by pitch about ENU y, then by yaw about ENU z."""
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    x, y, z = y_up((-sy * sp, cy * sp, sy * cp))
    return [tidy(v) for v in (x, y, z, cy * cp)]


class Writer:
    def __init__(self, materials):
        self.materials = materials  # name -> extras.sonar
        self.used = []
        self.binary = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "tools/make_scenes.py"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": [], "buffers": []}

    def append(self, key, value):
        self.json[key].append(value)
        return len(self.json[key]) - 1

    def accessor(self, data, component, kind, count, target, **extra):
        if sys.byteorder == "big":
            data.byteswap()
        view = self.append("bufferViews", {"buffer": 0, "byteOffset": len(self.binary),
                                           "byteLength": len(data) * data.itemsize, "target": target})
        self.binary += data.tobytes()
        self.binary += bytes(-len(self.binary) % 4)
        return self.append("accessors", {"bufferView": view, "componentType": component, "count": count,
                                         "type": kind, **extra})

    def vectors(self, vectors, bounds):
        data = array.array("f", (tidy(v) for vector in vectors for v in y_up(vector)))
        extra = {}
        if bounds:
            extra = {"min": [min(data[k::3]) for k in range(3)], "max": [max(data[k::3]) for k in range(3)]}
        return self.accessor(data, FLOAT, "VEC3", len(data) // 3, ARRAY_BUFFER, **extra)

    def indices(self, mesh):
        short = len(mesh.positions) <= 65535
        data = array.array("H" if short else "I", (i for triangle in mesh.triangles for i in triangle))
        return self.accessor(data, UNSIGNED_SHORT if short else UNSIGNED_INT, "SCALAR", len(data),
                             ELEMENT_ARRAY_BUFFER)

    def material(self, name):
        if name not in self.used:
            self.used.append(name)
            self.append("materials", {"name": name, "extras": {"sonar": self.materials[name]}})
        return self.used.index(name)

    def primitive(self, material, mesh):
        return {"attributes": {"POSITION": self.vectors(mesh.positions, bounds=True),
                               "NORMAL": self.vectors(mesh.normals, bounds=False)},
                "indices": self.indices(mesh), "material": self.material(material)}

    def node(self, node):
        entry = {"name": node.name}
        if any(node.position):
            entry["translation"] = [tidy(v) for v in y_up(node.position)]
        if node.yaw or node.pitch:
            entry["rotation"] = rotation(node.yaw, node.pitch)
        if node.parts:
            primitives = [self.primitive(*part) for part in node.parts]
            entry["mesh"] = self.append("meshes", {"name": node.name, "primitives": primitives})
        if node.strength is not None:
            entry["extras"] = {"sonar": {"target_strength_db": node.strength}}
        if node.children:
            entry["children"] = [self.node(child) for child in node.children]
        return self.append("nodes", entry)


def glb(nodes, materials):
    """The bytes of a .glb file; `materials` maps each material name to its `extras.sonar`."""
    writer = Writer(materials)
    writer.json["scenes"][0]["nodes"] = [writer.node(node) for node in nodes]
    writer.json["buffers"] = [{"byteLength": len(writer.binary)}]
    text = json.dumps(writer.json, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(writer.binary)
    return b"".join([struct.pack("<4sII", b"glTF", 2, total), struct.pack("<I4s", len(text), b"JSON"), text,
                     struct.pack("<I4s", len(writer.binary), b"BIN\0"), bytes(writer.binary)])
