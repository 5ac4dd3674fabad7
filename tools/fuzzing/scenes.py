"""Scenes in glTF: those of this repository that are small, and a triangle that uses what the reader knows."""
import json
import pathlib
import struct

ROOT = pathlib.Path(__file__).resolve().parents[2]


def triangle(**changes):
    points = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<3H2x", 0, 1, 2)
    times = struct.pack("<2f", 0, 2) + struct.pack("<6f", 0, 0, 0, 1, 2, 3) + struct.pack("<8f", 0, 0, 0, 1, 0, 0, 1, 0)
    data = points + times
    views = [(0, 36), (36, 6), (44, 8), (52, 24), (76, 32)]
    kinds = [(5126, 3, "VEC3"), (5123, 3, "SCALAR"), (5126, 2, "SCALAR"), (5126, 2, "VEC3"), (5126, 2, "VEC4")]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "a", "mesh": 0, "children": [1], "translation": [1, 2, 3]},
                  {"name": "ball", "rotation": [0, 0, 0, 1], "scale": [1, 1, 2], "extras": {"sonar": {"target_strength_db": -20}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
        "materials": [{"name": "sand", "doubleSided": True, "extras": {"sonar": {"mu_db": -27, "reflection": 0.4}}}],
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
        "accessors": [{"bufferView": n, "componentType": kind, "count": count, "type": shape}
                      for n, (kind, count, shape) in enumerate(kinds)],
        "animations": [{"name": "swim", "channels": [
            {"sampler": 0, "target": {"node": 0, "path": "translation"}}, {"sampler": 1, "target": {"node": 1, "path": "rotation"}}],
            "samplers": [{"input": 2, "output": 3, "interpolation": "LINEAR"}, {"input": 2, "output": 4, "interpolation": "STEP"}]}],
    }
    document["accessors"][0].update({"min": [0, 0, 0], "max": [1, 1, 0]})
    document.update(changes)
    return document, data


def glb(document, data):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def scenes():
    for path in sorted((ROOT / "config" / "scenes").glob("*.glb")):
        if path.stat().st_size < 100000:
            yield path.stem, path.read_bytes()
    yield "triangle", glb(*triangle())
    sparse, data = triangle()
    sparse["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
                                        "values": {"bufferView": 0}}
    yield "sparse", glb(sparse, data)
    for name, change in (("points", {"mode": 0}), ("strip", {"mode": 5}), ("fan", {"mode": 6})):
        document, data = triangle()
        document["meshes"][0]["primitives"][0].update(change)
        yield name, glb(document, data)
    for name, change in (("extension", {"extensionsRequired": ["KHR_draco_mesh_compression"]}), ("no-scene", {"scenes": []})):
        yield name, glb(*triangle(**change))
    document, data = triangle()
    del document["buffers"][0]["byteLength"]
    yield "text", json.dumps(document).encode()
