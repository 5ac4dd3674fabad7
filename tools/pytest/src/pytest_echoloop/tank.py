"""A tank as a glTF scene: a box with walls, a floor and open water above, the origin in the middle of the surface."""

import base64
import json
import struct


def gltf(length, width, depth):
    """Text of the scene; metres along x (east), along y (north) and down."""
    x, y = length / 2, width / 2
    corners = [(x, y), (-x, y), (-x, -y), (x, -y)]
    names = ["wall_north", "wall_west", "wall_south", "wall_east"]
    faces = [(name, [(*a, 0), (*a, -depth), (*b, -depth), (*b, 0)])
             for name, a, b in zip(names, corners, corners[1:] + corners[:1])]
    faces.append(("floor", [(*corner, -depth) for corner in corners]))
    data, accessors, meshes = b"", [], []
    for name, face in faces:
        points = [(east, up, -north) for east, north, up in face]  # glTF has its y axis up
        accessors.append({"bufferView": 0, "byteOffset": len(data), "componentType": 5126, "count": 4, "type": "VEC3",
                          "min": [min(p[i] for p in points) for i in range(3)],
                          "max": [max(p[i] for p in points) for i in range(3)]})
        meshes.append({"name": name, "primitives": [{"attributes": {"POSITION": len(meshes)}, "indices": len(faces),
                                                     "material": 0}]})
        data += b"".join(struct.pack("<3f", *p) for p in points)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    accessors.append({"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(faces)))}],
        "nodes": [{"name": name, "mesh": i} for i, (name, _) in enumerate(faces)],
        "meshes": meshes,
        "materials": [{"name": "concrete", "doubleSided": True}],
        "accessors": accessors,
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(data)},
                        {"buffer": 0, "byteOffset": len(data), "byteLength": len(indices)}],
        "buffers": [{"byteLength": len(data) + len(indices), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data + indices).decode()}],
    })
