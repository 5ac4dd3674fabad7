#!/usr/bin/env python3
"""What tools/fuzz begins with: the program itself reads the captures and scenes, every target has inputs of its own kind, and
the table of coverage keeps what it does not measure."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["ECHOLOOP"]
sys.path.insert(0, str(ROOT / "tools" / "fuzzing"))

import table  # noqa: E402
from seeds import main, golden  # noqa: E402

SCENARIO = """scene: {scene}
water: {{temperature: 10, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{pose: {{position: [0, 0, -2]}}}}
devices: [{{name: a, model: nmea-echosounder, endpoints: ["udp://127.0.0.1:9"]}}]
"""


def targets():
    for path in (ROOT / "tests").rglob("*fuzz*.cpp"):
        name = re.sub(r"_fuzz$|^fuzz_", "", path.stem)
        kinds = re.findall(r'kind == "(\w+)"\) \{', path.read_text()) if name == "makers_file" else [name]  # one program for each
        yield from ((kind, path) for kind in kinds)


class Seeds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        main(cls.folder)

    def test_every_target_has_inputs_of_its_kind(self):
        folders = {path.name for path in self.folder.iterdir() if path.is_dir()}
        names = dict(targets())
        self.assertGreater(len(names), 35)
        self.assertEqual(folders - names.keys(), {"bytes"}, "for targets that are not there")
        of_records = {"makers_file"}  # several programs, of a file's records, which are messages
        for name in names.keys() - folders - of_records:
            self.assertEqual(names[name].parent.name, "protocols", f"{name} begins with messages of sonars")

    def test_captures_begin_with_recordings_of_our_own_runs(self):
        for target in ("capture_file", "pcapng", "replay_source"):
            self.assertTrue(list((self.folder / target).glob("run-kmall*")), target)

    def test_dictionaries_are_in_the_syntax_of_libfuzzer(self):
        dictionaries = list(self.folder.glob("*.dict")) + [self.folder / "dictionary"]
        for path in dictionaries:
            for line in path.read_text().splitlines():
                self.assertRegex(line, r'^"(\\x[0-9a-f]{2})+"$')
        words = (self.folder / "dictionary").read_text()
        for word in ("BTH0", "83P", "CMD0"):
            self.assertIn('"' + "".join(f"\\x{ord(c):02x}" for c in word) + '"', words)
        self.assertIn('"\\xb0\\x04"', words)  # 1200, FirmwareVersion of the Ping protocol
        for target, word in (("scene", "bufferViews"), ("control", "clear"), ("scenario", "endpoints"), ("steps", "orientation")):
            written = "".join(f"\\x{ord(c):02x}" for c in word)
            self.assertIn(f'"{written}"', (self.folder / f"{target}.dict").read_text(), target)
        self.assertEqual({path.stem.split("-")[0] for path in dictionaries} - {"dictionary", "devices"} - dict(targets()).keys(), set())

    def test_the_program_reads_the_captures(self):
        for family in ("seanet", "ping", "r2sonic", "kmall", "reson7k"):
            message = next(name for name in golden() if name.startswith(family))
            text = (ROOT / "tests" / "data" / family / (message.split("-")[1] + ".hex")).read_text()
            wanted = re.search(r"^message (.*)$", text, re.M)[1].split()[0]
            for kind in ("log", "pcapng", "tcp", "serial"):
                if family in ("r2sonic", "kmall") and kind in ("log", "tcp", "serial"):
                    continue  # they come as datagrams
                self.check_inspected(f"{message}-{kind}", wanted)
        for link in ("ethernet", "vlan", "raw", "sll", "sll2", "null"):
            for kind in ("big", "little", "pcapng"):
                self.check_inspected(f"link-{link}-{kind}", "STH0")
        for kind, wanted in (("ping_viewer_log", "Nack"), ("oculus_file", "Result"), ("aris_file", "FramePart"), ("xtf_file", "BTH0"),
                             ("kmall_file", "#SVP"), ("gzip_file", "#IIP")):
            self.check_inspected(f"makers-{kind}", wanted)

    def check_inspected(self, name, wanted):
        result = subprocess.run([PROGRAM, "inspect", self.folder / "capture_file" / name], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, f"{name}: {result.stderr}")
        self.assertIn(wanted, result.stdout, name)

    def test_the_program_reads_the_scenes(self):
        for name, status in (("triangle", 0), ("tank", 0), ("sparse", 65), ("extension", 65)):
            scene = self.folder / f"{name}.glb"
            scene.write_bytes((self.folder / "scene" / name).read_bytes())
            scenario = self.folder / f"{name}.yaml"
            scenario.write_text(SCENARIO.format(scene=scene))
            result = subprocess.run([PROGRAM, "check", scenario], capture_output=True, text=True)
            self.assertEqual(result.returncode, status, f"{name}: {result.stdout}{result.stderr}")


class Table(unittest.TestCase):
    PAGE = f"# Fuzzing\n\n{table.HEADING}\n|---|---:|---|---:|---:|---|\n| aris | 10 | a, 5 s | 900 | | |\n| ping | 7 | a, 5 s | 8 | 3 | b, 1 s |\n\nEnd.\n"

    def test_what_was_measured_becomes_what_was_before(self):
        page = table.renewed(self.PAGE, {"aris": ("12", "1000"), "set": ("4", "9")}, "c, 30 s")
        self.assertIn("| aris | 12 | c, 30 s | 1000 | 10 | a, 5 s |\n", page)
        self.assertIn("| ping | 7 | a, 5 s | 8 | 3 | b, 1 s |\n| set | 4 | c, 30 s | 9 | | |\n\nEnd.\n", page)
        self.assertTrue(page.startswith("# Fuzzing\n"))

    def test_the_page_has_a_table_of_targets_that_there_are(self):
        _, rows, _ = table.rows_of((ROOT / "docs" / "fuzzing.md").read_text())
        self.assertGreater(len(rows), 20)
        self.assertEqual({name.split("/")[0] for name in rows} - dict(targets()).keys(), set())


if __name__ == "__main__":
    unittest.main()
