"""The page of what was captured: pictures read back from the bytes on the wire, for `view` and for `replay --view`."""

import asyncio
import json
import math
import re
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

import websockets

from ports import free_port
from program import PROGRAM, ROOT
from shared_data import needs_data

import test_pipe_profiler

LINK = re.compile(rb"http://(127\.0\.0\.1:\d+)/#([0-9a-f]{32})")
FLOOR = 2.0  # m below the vehicle in the tank
ASKED = ["ping1d", "imagenex-881a", "tritech-profiler", "imagenex-831l"]  # a driver of the scenario's asks them
BY_THEMSELVES = ["kongsberg-kmall", "r2sonic-2024", "imagenex-deltat", "micron-echosounder", "nmea-echosounder"]


def picture(message):
    """Head, levels (0: nothing) and ranges of a picture that was said."""
    length = struct.unpack_from("<I", message)[0]
    head = json.loads(message[4: 4 + length])
    directions = head["rows"] * head["beams"]
    levels = message[4 + length:][: directions * head["bins"]]
    ranges = struct.unpack_from(f"<{directions}f", message, 4 + length + len(levels)) if head.get("ranges") else ()
    return head, levels, ranges


def loudest_range(head, levels, beam):
    """m, of the loudest bin of a beam beyond the first half metre."""
    first = max(0, math.ceil((0.5 - head["first_range"]) / head["bin_size"]))
    line = levels[beam * head["bins"]:][: head["bins"]]
    best = max(range(first, head["bins"]), key=lambda b: line[b])
    return head["first_range"] + (best + 0.5) * head["bin_size"]


class Shown(unittest.TestCase):
    def shown(self, *command, enough):
        """What `enough(said)` makes of {name: last (head, levels, ranges)} of `echoloop view` and the like."""
        process = subprocess.Popen([PROGRAM, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        output = b""
        while not (found := LINK.search(output)) or b"Ctrl-C" not in output:
            line = process.stdout.readline()
            self.assertTrue(line, output)
            output += line

        async def look():
            said = {}
            host, token = (text.decode() for text in found.groups())
            async with websockets.connect(f"ws://{host}/news", subprotocols=["echoloop.view", token], max_size=None) as viewer:
                self.hello = json.loads(await viewer.recv())
                while True:
                    message = await viewer.recv()
                    if isinstance(message, bytes):
                        head, levels, ranges = picture(message)
                        if not any(levels) and not any(ranges):
                            continue  # a Ping1D that is asked before its first ping says an empty profile
                        said[(head["device"], head["name"])] = head, levels, ranges
                        if done := enough(said):
                            return done

        return asyncio.run(asyncio.wait_for(look(), 60))

    def capture(self, *models, scene="tank", at=(0, 0, -2), pitch=90):
        """What models that look down say in 4 s, in a file."""
        folder = tempfile.TemporaryDirectory(prefix="echoloop-view-")
        self.addCleanup(folder.cleanup)
        file = Path(folder.name) / "run.pcapng"
        text = f"""
scene: {ROOT}/config/scenes/{scene}.glb
water: {{temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{pose: {{position: {list(at)}}}}}
clock: {{mode: free, duration: 6}}
devices:
"""
        for model in models:
            asked = ", pings: {interval: 0.5, count: 8}" if model in ASKED else ""
            text += f"  - {{name: {model}, model: {model}, mount: {{rpy_deg: [0, {pitch}, 0]}}{asked}}}\n"
        (Path(folder.name) / "s.yaml").write_text(text)
        done = subprocess.run([PROGRAM, "run", str(Path(folder.name) / "s.yaml"), "--record", str(file)], capture_output=True,
                              timeout=100, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return file

    def test_the_floor_is_at_its_depth_in_what_each_sonar_says(self):
        wanted = {*ASKED, *BY_THEMSELVES} - {"imagenex-831l"}  # whose driver asks for a metre
        file = self.capture(*wanted)

        def enough(said):
            return len({device for device, _ in said}) == len(wanted) and said

        said = self.shown("view", str(file), "--speed", "5", "--loop", enough=enough)
        for (device, name), (head, levels, ranges) in said.items():
            with self.subTest(device, message=name):
                middle = min(range(head["beams"]), key=lambda b: abs(head["bearings"][b] + head["pan"]))
                if ranges:
                    self.assertAlmostEqual(ranges[middle], FLOOR, delta=0.05)
                if levels:
                    self.assertAlmostEqual(loudest_range(head, levels, middle), FLOOR, delta=0.1)

    def test_the_samples_around_each_sounding_lie_on_the_floor(self):
        file = self.capture("kongsberg-kmall")

        def enough(said):
            return next((one for (_, name), one in said.items() if name == "MRZ seabed image"), None)

        head, levels, _ = self.shown("view", str(file), "--loop", enough=enough)
        self.assertGreater(head["beams"], 300)
        for bearing in (-30, 0, 30):
            beam = min(range(head["beams"]), key=lambda b: abs(math.degrees(head["bearings"][b]) - bearing))
            slant = FLOOR / math.cos(head["bearings"][beam])
            self.assertAlmostEqual(loudest_range(head, levels, beam), slant, delta=0.1)
            line = levels[beam * head["bins"]:][: head["bins"]]
            self.assertLess(sum(byte > 0 for byte in line), head["bins"] / 4, "the rest is not told")

    def test_a_pipe_s_wall_is_where_it_is_in_what_a_profiler_says(self):
        file = self.capture("imagenex-831l", scene="pipe", at=(0, 0.03, -3.02), pitch=-90)

        def enough(said):
            return next((one for one in said.values() if any(one[2])), None)

        head, levels, ranges = self.shown("view", str(file), "--loop", enough=enough)
        wall = test_pipe_profiler.wall(math.degrees(head["pan"]))
        self.assertEqual(head["name"], "IMX831L")
        self.assertAlmostEqual(head["bins"] * head["bin_size"], 1, places=6)
        self.assertAlmostEqual(ranges[0], wall, delta=0.003)
        loudest = max(range(head["bins"]), key=lambda b: levels[b])
        self.assertAlmostEqual((loudest + 0.5) * head["bin_size"], wall, delta=0.015)

    def test_a_recording_of_a_maker_is_shown(self):
        file = needs_data("r2sonic/r2sonic_bth0_20.pcap")

        def enough(said):
            return next((one for (_, name), one in said.items() if name == "BTH0"), None)

        head, _, ranges = self.shown("view", str(file), enough=enough)
        self.assertEqual(len(ranges), 256)
        self.assertGreater(sum(one > 1 for one in ranges), 200)
        self.assertEqual(head["bearings"], sorted(head["bearings"]))

    def test_a_replay_shows_what_it_says(self):
        file = self.capture("ping1d")
        port = free_port()

        def enough(said):
            return next(iter(said.values()), None)

        head, levels, ranges = self.shown("replay", str(file), f"udp://127.0.0.1:{port}", "--loop", "--view", enough=enough)
        self.assertAlmostEqual(ranges[0], FLOOR, delta=0.1)
        self.assertAlmostEqual(loudest_range(head, levels, 0), FLOOR, delta=0.15)
        self.assertTrue(self.hello["captured"])


if __name__ == "__main__":
    unittest.main()
