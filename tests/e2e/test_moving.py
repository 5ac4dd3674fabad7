"""Things that move in the scene: by a file, by the scene's own animation, by lines, and what is refused. What happens is
read from the ground truth and from the depths of a sounder that looks ahead at them."""

import json
import socket
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, ROOT, Emulator
from test_pose import Depths
from test_truth import wait_for_lines

# A sounder in the middle of the tank looks to the west, where a ball of 0.4 m hangs in the water; the wall is at x = -6.
RADIUS = 0.4
PULSE = 0.1  # m, as far as it moves between two pings
SCENARIO = """scene: %s
water: {sound_speed: 1500, surface: none}
vehicle: {pose: {position: [0, 0, -2], rpy_deg: [0, 0, 180]}%s}
%s
devices:
  - name: sounder
    model: nmea-echosounder
    endpoints: ["udp://127.0.0.1:%d"]
    options: {rate: 10, sentences: DBT}
"""


def animated_tank(folder, keys):
    """The tank's glb with an animation of the ball, [(t, (x, y, z) in ENU), ...], written apart from the program."""
    data = (ROOT / "config" / "scenes" / "tank.glb").read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20 : 20 + length]), data[28 + length :]
    document["bufferViews"] += [
        {"buffer": 0, "byteOffset": len(binary), "byteLength": 4 * len(keys)},
        {"buffer": 0, "byteOffset": len(binary) + 4 * len(keys), "byteLength": 12 * len(keys)},
    ]
    binary += b"".join(struct.pack("<f", t) for t, _ in keys)
    binary += b"".join(struct.pack("<3f", x, z, -y) for _, (x, y, z) in keys)
    document["buffers"][0]["byteLength"] = len(binary)
    views, accessors = len(document["bufferViews"]), len(document["accessors"])
    document["accessors"] += [
        {"bufferView": views - 2, "componentType": 5126, "count": len(keys), "type": "SCALAR"},
        {"bufferView": views - 1, "componentType": 5126, "count": len(keys), "type": "VEC3"},
    ]
    ball = [node.get("name") for node in document["nodes"]].index("ball")
    document["animations"] = [
        {
            "channels": [{"sampler": 0, "target": {"node": ball, "path": "translation"}}],
            "samplers": [{"input": accessors, "output": accessors + 1}],
        }
    ]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    file = Path(folder) / "animated.glb"
    file.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)
    return file


class Moving(unittest.TestCase):
    def setUp(self):
        self.depths = Depths(self)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def start(self, objects, *arguments, vehicle="", scene="{scenes}/tank.glb", files=()):
        text = SCENARIO % (scene, vehicle, objects, self.depths.port)
        emulator = Emulator(text, *arguments, files=files)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def test_a_place_in_the_scenario(self):
        self.start("objects: [{node: ball, pose: {position: [-4.4, 0, -2]}}]")
        self.depths.wait_for(4.4 - RADIUS)

    def test_a_trajectory_from_a_file(self):
        rows = ["t,x,y,z,qw,qx,qy,qz", "0,-2.4,0,-2,1,0,0,0", "3,-5.4,0,-2,1,0,0,0"]
        self.start("objects: [{node: ball, trajectory: way.csv}]", files={"way.csv": "\n".join(rows)})
        seen = [self.depths.next()]
        while seen[-1] < 4.9:
            seen.append(self.depths.next())
        # It moves away; speckle hides the beginning of one echo and not of the next.
        self.assertEqual([(a, b) for a, b in zip(seen, seen[1:]) if b < a - PULSE], [])
        self.assertGreater(len(seen), 10)

    def test_an_animation_of_the_scene_loops(self):
        keys = [(0, (-2.4, 0, -2)), (1, (-4.4, 0, -2)), (2, (-2.4, 0, -2))]
        truth = self.folder / "truth.jsonl"
        scene = animated_tank(self.folder, keys)
        with Emulator(SCENARIO % (scene, "", "", self.depths.port), "--truth", str(truth)) as emulator:
            header, pings = wait_for_lines(truth, 35)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertEqual(header["movers"], ["ball"])
        self.assertGreater(pings[-1]["t"], 3, "more than once round")
        for ping in pings:
            x, y, z = ping["movers"][0]["position"]
            self.assertAlmostEqual(x, -4.4 + 2 * abs(ping["t"] % 2 - 1), delta=1e-5)
            self.assertEqual((round(y, 6), round(z, 6)), (0, -2))
            self.assertAlmostEqual(ping["axis_range"][0], -x - RADIUS, delta=0.02)

    def test_an_animation_can_be_off(self):
        scene = animated_tank(self.folder, [(0, (-2.4, 0, -2)), (1, (-4.4, 0, -2))])
        self.start("animations: off", scene=scene)
        self.depths.wait_for(6)  # the ball is where the file puts it, out of the beam

    def test_lines_move_objects_and_the_vehicle(self):
        base = free_port(8)
        emulator = self.start(
            "objects: [{node: ball}, {node: post}]", vehicle=", input: 'udp-listen://127.0.0.1:%d'" % base
        )
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:

            def say(**line):
                sender.sendto(json.dumps(line).encode(), ("127.0.0.1", base))

            say(object="ball", position=[-4.4, 0, -2])
            self.depths.wait_for(4.4 - RADIUS)
            say(object="ball", position=[-2.4, 0, -2], orientation=[1, 0, 0, 0])
            self.depths.wait_for(2.4 - RADIUS)
            say(position=[1, 0, -2], rpy_deg=[0, 0, 180])
            self.depths.wait_for(3.4 - RADIUS)
            say(object="bal", position=[0, 0, 0])
            say(object=7, position=[0, 0, 0])
            say(object="ball", position=[-3.4, 0, -2])
            self.depths.wait_for(4.4 - RADIUS)
        status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"vehicle +4 poses from \S+, 2 refused")
        self.assertIn("did you mean 'ball'?", output)

    def test_an_input_of_its_own(self):
        base = free_port(8)
        ball = "{node: ball, pose: {position: [-4.4, 0, -2]}, input: 'udp-listen://127.0.0.1:%d'}" % base
        emulator = self.start(f"objects: [{ball}]")
        self.depths.wait_for(4.4 - RADIUS)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(b"nonsense", ("127.0.0.1", base))
            sender.sendto(b'{"position": [-3.4, 0, -2]}', ("127.0.0.1", base))
            self.depths.wait_for(3.4 - RADIUS)
            emulator.read_until("object ball: no pose for more than a second", 20)
        output = emulator.stop()[1]
        self.assertRegex(output, r"object ball +1 pose from udp\S+, 1 refused \(the last: no JSON\), 0 jumps, [1-9]\d* ping")

    def test_an_unknown_node_is_an_error_with_its_place(self):
        file = self.folder / "scenario.yaml"
        scene = ROOT / "config" / "scenes" / "tank.glb"
        file.write_text(SCENARIO % (scene, "", "objects:\n  - {node: pst}", 9))
        for verb in ("run", "check"):
            done = subprocess.run([PROGRAM, verb, str(file)], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 78, done.stderr)
            self.assertIn("scenario.yaml:5:12: objects: the scene has no node 'pst'; did you mean 'post'?", done.stderr)


if __name__ == "__main__":
    unittest.main()
