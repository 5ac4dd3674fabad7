"""Scenes that a test makes itself: one mesh of one material as a glTF document."""

import base64
import json
import struct


def mesh_scene(points, triangles, sonar):
    """The text of a .gltf file. `points`: (x, y, z) in ENU metres; `triangles`: indices of them, counter-clockwise seen from
    where the surface is heard; `sonar`: `extras.sonar` of its material."""
    turned = [(x, z, -y) for x, y, z in points]  # glTF has y up
    positions = b"".join(struct.pack("<3f", *p) for p in turned)
    corners = [corner for triangle in triangles for corner in triangle]
    data = positions + struct.pack(f"<{len(corners)}I", *corners)
    least, most = ([f(p[i] for p in turned) for i in range(3)] for f in (min, max))
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "surface"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "surface", "doubleSided": True, "extras": {"sonar": sonar}}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(data) - len(positions)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": least, "max": most},
                      {"bufferView": 1, "componentType": 5125, "count": len(corners), "type": "SCALAR"}],
    })  # fmt: skip


def grid_triangles(rows, columns, holds=lambda *corners: True):
    """Two triangles for each cell of a grid of points, row by row, whose corners hold."""
    for row in range(rows - 1):
        for column in range(columns - 1):
            a = row * columns + column
            for corners in ((a, a + 1, a + columns + 1), (a, a + columns + 1, a + columns)):
                if holds(*corners):
                    yield corners
