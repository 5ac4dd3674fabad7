"""What scanning heads hear in closed rooms: the walls that they face, and those again after several mirrors."""
import base64
import csv
import json
import struct
import unittest

from program import ProgramTest

QUADS = ((0, 1, 2), (0, 2, 3))
RING_DOWN = 1.5  # m, within which a head hears itself


def room(east, north, west, south, up, down, sonar):
    """A glTF document of six inner faces about the origin, at those distances in m."""
    corners = {(x, y, z): (east if x else -west, north if y else -south, up if z else -down)
               for x in (0, 1) for y in (0, 1) for z in (0, 1)}
    faces = (((1, 1, 0), (1, 0, 0), (1, 0, 1), (1, 1, 1)), ((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)),
             ((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)), ((1, 0, 0), (0, 0, 0), (0, 0, 1), (1, 0, 1)),
             ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)), ((0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)))
    points, indices = [], []
    for face in faces:
        indices += [len(points) + corner for triangle in QUADS for corner in triangle]
        points += [corners[corner] for corner in face]
    positions = b"".join(struct.pack("<3f", x, z, -y) for x, y, z in points)
    data = positions + struct.pack(f"<{len(indices)}H", *indices)
    limits = [[f(p[i] for p in [(x, z, -y) for x, y, z in points]) for i in range(3)] for f in (min, max)]
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "wall", "extras": {"sonar": sonar}}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(data) - len(positions)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                       "min": limits[0], "max": limits[1]},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}]})


class Rooms(ProgramTest):
    def turn(self, model, reach, walls, sonar):
        """bearing in deg -> levels in dB, and the ranges in m of the bins."""
        (self.folder / "room.gltf").write_text(room(*walls, sonar))
        file = self.scenario(f"""
scene: room.gltf
water: {{temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, surface: none}}
vehicle: {{pose: {{position: [0, 0, 0], rpy_deg: [0, 0, 0]}}}}
devices:
  - {{name: head, model: {model}, endpoints: ["pty:{self.folder}/head"]}}
""")
        out = self.folder / "turn.csv"
        self.good("render", file, "--out", out, "--range", str(reach))
        rows = list(csv.reader(out.read_text().splitlines()))
        ranges = [float(r) for r in rows[0][1:]]
        return ranges, {float(row[0]): [float(v) for v in row[1:]] for row in rows[1:]}

    def at(self, turn, bearing):
        return turn[min(turn, key=lambda b: abs((b - bearing + 180) % 360 - 180))]

    def test_the_loudest_echo_of_every_direction_is_the_wall_that_is_faced(self):
        """Polished, with the roof a little nearer than the floor: edges at one range, in phase, would win by 2 dB."""
        walls = {0: 12, -90: 8, 180: 5, 90: 10}
        for model in ("tritech-micron", "ping360"):
            for up, sonar in ((3.5, {"material": "concrete"}), (3.3, {"material": "concrete", "roughness": 1e-5})):
                ranges, turn = self.turn(model, 20, (12, 8, 5, 10, up, 3.5), sonar)
                bin_length = ranges[1] - ranges[0]
                for bearing, distance in walls.items():
                    levels = self.at(turn, bearing)
                    level, loudest = max((v, r) for v, r in zip(levels, ranges) if r > RING_DOWN)
                    with self.subTest(model=model, bearing=bearing, sonar=sonar):
                        self.assertGreater(loudest, distance - bin_length, level)
                        self.assertLess(loudest, distance + bin_length + 0.2)

    def test_several_round_trips_stand_out_on_every_normal(self):
        """A tank of 3 x 4 m, the head 1 m off the middle of the long side; orders 1, 3 and 5."""
        near = {0: (1, 3), 180: (3, 1), -90: (1.5, 1.5), 90: (1.5, 1.5)}  # ahead, astern
        ranges, turn = self.turn("tritech-micron", 12, (1, 1.5, 3, 1.5, 0.9, 0.9),
                                 {"material": "concrete", "roughness": 1e-5})
        for bearing, (ahead, astern) in near.items():
            levels = self.at(turn, bearing)

            def peak(distance):
                return max(v for r, v in zip(ranges, levels) if abs(r - distance) < 0.1)

            def beside(distance):
                return sorted(v for r, v in zip(ranges, levels) if 0.25 < abs(r - distance) < 0.6)

            orders = [ahead, 2 * ahead + astern, 3 * ahead + 2 * astern]
            found = [peak(distance) for distance in orders]
            with self.subTest(bearing=bearing):
                self.assertEqual(found, sorted(found, reverse=True))
                for distance, level in zip(orders[1:], found[1:]):
                    around = beside(distance)
                    self.assertGreater(level, around[len(around) // 2] + 6)


if __name__ == "__main__":
    unittest.main()
