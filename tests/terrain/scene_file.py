"""A .glb of one terrain, read apart from the program: corners in ENU, triangles, the origin."""

import bisect
import json
import struct
from pathlib import Path


def read(file):
    data = Path(file).read_bytes()
    size, = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + size])
    binary = data[20 + size + 8 :]

    def accessor(index, form):
        entry = document["accessors"][index]
        start = document["bufferViews"][entry["bufferView"]]["byteOffset"]
        return list(struct.iter_unpack(form, binary[start : start + entry["count"] * struct.calcsize(form)]))

    primitive = document["meshes"][-1]["primitives"][0]
    points = [(x, -z, y) for x, y, z in accessor(primitive["attributes"]["POSITION"], "<3f")]
    flat = [i for i, in accessor(primitive["indices"], "<I")]
    origin = document["scenes"][0].get("extras", {}).get("sonar", {}).get("origin")
    return {"points": points, "triangles": list(zip(flat[::3], flat[1::3], flat[2::3])), "origin": origin,
            "names": [node["name"] for node in document["nodes"]],
            "material": document["materials"][primitive["material"]]}


def heights_at(scene, places):
    """For each (x, y): the heights of the triangles that it is in, of all."""
    found = {place: [] for place in places}
    ordered = sorted(places)
    xs = [x for x, _ in ordered]
    for a, b, c in scene["triangles"]:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (scene["points"][i] for i in (a, b, c))
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        assert area > 0, "clockwise from above"
        for i in range(bisect.bisect_left(xs, min(ax, bx, cx) - 1e-6), bisect.bisect_right(xs, max(ax, bx, cx) + 1e-6)):
            x, y = ordered[i]
            u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
            v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
            if min(u, v, 1 - u - v) >= -1e-6:
                found[x, y].append(u * az + v * bz + (1 - u - v) * cz)
    return found
