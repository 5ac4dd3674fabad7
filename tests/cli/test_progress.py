"""What long work shows on a terminal, and that it shows nothing anywhere else (the other tests read stderr in pipes)."""
import re
import sys
import unittest

from captures import RTAC_SERIAL, Pcapng, rtac
from program import DEMO, ROOT, TANK, ProgramTest
from test_capture_files import device_data

sys.path.insert(0, str(ROOT / "tests" / "tools" / "import"))
from worlds import needs_worlds  # noqa: E402

WORLD = """<?xml version="1.0"?><sdf version="1.7"><world name="w"><model name="stones"><static>true</static><link name="link">
%s</link></model></world></sdf>"""
STONE = '<visual name="%d"><pose>%d 0 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry></visual>'
FREE = """scene: TANK
clock: {mode: free, duration: 3}
devices: [{name: head, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:9"]}]
"""


class Progress(ProgramTest):
    def test_pings_that_are_rendered(self):
        shown = self.on_a_terminal("render", TANK, "--out", self.folder / "turn.npy")
        self.assertRegex(shown, r"rendering \[\.{40}\] 0/200")
        self.assertRegex(shown, r"rendering \[#{40}\] 200/200\x1b\[K\r\x1b\[K$")

    def test_one_ping_has_no_steps(self):
        self.assertEqual(self.on_a_terminal("render", DEMO, "--device", "sonar", "--out", self.folder / "fan.npy"), "")

    def test_checks(self):
        self.assertRegex(self.on_a_terminal("validate", "--only", "V1,V2"), r"checking \[\.{40}\] 0/2.*checking \[#{40}\] 2/2")

    def test_a_capture_that_is_converted(self):
        capture = Pcapng().interface(RTAC_SERIAL, b"head")
        for i in range(2000):
            capture.packet(0, rtac(device_data(i % 400), 1), round((1000 + i / 10) * 1e9))
        source = self.folder / "dive.pcapng"
        source.write_bytes(capture.data)
        for ending in ("bin", "csv"):
            shown = self.on_a_terminal("convert", source, self.folder / f"out.{ending}")
            self.assertRegex(shown, r"reading \[\.{40}\] \d+ %")
            self.assertRegex(shown, r"reading \[#{40}\] 100 %")
            self.assertTrue(shown.endswith("\r\x1b[K"))

    def test_shots_that_are_written(self):
        """Replies of a head, in a capture and one behind the other in a file."""
        reply = b"IMX\x10\x45\x58\x05\x0a\0\0\x7c\x01" + bytes(252) + b"\xfc"  # id 10, 0 deg, 10 m, 252 points
        capture = Pcapng().interface(RTAC_SERIAL, b"head")
        for i in range(2000):
            capture.packet(0, rtac(reply, 1), round((1000 + i / 10) * 1e9))
        for name, data in (("dive.pcapng", capture.data), ("dive.raw", 2000 * reply)):
            source = self.folder / name
            source.write_bytes(data)
            for ending in ("852", "81A"):
                with self.subTest(name, ending=ending):
                    shown = self.on_a_terminal("convert", source, self.folder / f"out.{ending}")
                    self.assertRegex(shown, r"reading \[\.{40}\] \d+ %")
                    self.assertRegex(shown, r"reading \[#{40}\] 100 %")
                    self.assertTrue(shown.endswith("\r\x1b[K"))

    def test_a_data_set(self):
        scenario = self.scenario(FREE)
        shown = self.on_a_terminal("run", scenario, "--dataset", self.folder / "set")
        self.assertRegex(shown, r"(pinging|writing the data set) \[")
        self.assertTrue((self.folder / "set" / "index.jsonl").exists())

    def test_a_survey_that_is_imported(self):
        needs_worlds(self)
        heights = [" ".join(str((i * j * 7919 + i * 31) % 97 / 10) for i in range(300)) for j in range(300)]
        survey = self.folder / "rough.asc"
        survey.write_text("ncols 300\nnrows 300\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + "\n".join(heights) + "\n")
        shown = self.on_a_terminal("import", survey, "--local", "--out", self.folder / "rough.glb")
        shares = [int(share) for share in re.findall(r"making triangles \[[#.]{40}\] (\d+) %", shown)]
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(shares[-1], 0, shown)

    def test_a_world_that_is_imported(self):
        needs_worlds(self)
        world = self.folder / "a.world"
        world.write_text(WORLD % "".join(STONE % (i, 3 * i) for i in range(40)))
        shown = self.on_a_terminal("import", world, "--out", self.folder / "a.glb")
        self.assertRegex(shown, r"reading shapes \[#{40}\] 40/40")


if __name__ == "__main__":
    unittest.main()
