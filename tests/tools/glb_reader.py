"""Reads a .glb file back into triangles in world coordinates (ENU), apart from the code that writes them."""
import json
import struct


def chunks(data):
    magic, version, total = struct.unpack_from("<4sII", data)
    assert (magic, version, total) == (b"glTF", 2, len(data)), "header"
    offset, found = 12, []
    while offset < total:
        length, kind = struct.unpack_from("<I4s", data, offset)
        assert length % 4 == 0, "chunk length"
        found.append((kind, data[offset + 8:offset + 8 + length]))
        offset += 8 + length
    assert [kind for kind, _ in found] == [b"JSON", b"BIN\0"] and offset == total, "chunks"
    return json.loads(found[0][1]), found[1][1]


def quaternion_rotate(q, v):
    x, y, z, w = q
    t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


class Glb:
    def __init__(self, path):
        self.json, self.binary = chunks(path.read_bytes())
        self.nodes = {node["name"]: node for node in self.json["nodes"]}

    def accessor(self, index):
        a = self.json["accessors"][index]
        view = self.json["bufferViews"][a["bufferView"]]
        code, size = {5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}[a["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[a["type"]]
        assert view["byteOffset"] % size == 0 and view["byteLength"] == a["count"] * width * size, "buffer view"
        values = struct.unpack_from(f"<{a['count'] * width}{code}", self.binary, view["byteOffset"])
        return values if width == 1 else list(zip(values[0::3], values[1::3], values[2::3])), a

    def primitives(self, name, place=lambda v: v, turn=lambda v: v):
        """(material name, positions, normals, triangles) of a node and its children, ENU, in the node's frame."""
        node = self.nodes[name]
        for primitive in self.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            positions, _ = self.accessor(primitive["attributes"]["POSITION"])
            normals, _ = self.accessor(primitive["attributes"]["NORMAL"])
            indices, _ = self.accessor(primitive["indices"])
            to_enu = lambda v: (v[0], -v[2], v[1])  # noqa: E731
            yield (self.json["materials"][primitive["material"]]["name"],
                   [to_enu(place(p)) for p in positions], [to_enu(turn(n)) for n in normals],
                   list(zip(indices[0::3], indices[1::3], indices[2::3])))
        for child in node.get("children", []):
            yield from self.primitives(self.json["nodes"][child]["name"], place, turn)

    def world_primitives(self, name):
        """The same in world coordinates; for nodes of the first level."""
        node = self.nodes[name]
        q, t = node.get("rotation", (0, 0, 0, 1)), node.get("translation", (0, 0, 0))
        turn = lambda v: quaternion_rotate(q, v)  # noqa: E731
        return self.primitives(name, lambda v: tuple(a + b for a, b in zip(turn(v), t)), turn)

    def bounds(self, name):
        """Lowest and highest corner of a node in its own frame, ENU metres."""
        points = [p for _, positions, _, _ in self.primitives(name) for p in positions]
        return tuple(tuple(f(p[k] for p in points) for k in range(3)) for f in (min, max))
