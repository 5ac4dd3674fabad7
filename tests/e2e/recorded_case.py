"""What runs under the settings of a recording have in common. docs/recordings.md has the table."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, Emulator

import words

HEAD = """
scene: {scenes}/%s.glb
seed: 1
water: {temperature: 10, salinity: 35, ph: 8%s}
vehicle: {%s}
devices:
"""
ALIKE = 0.25  # the Jensen-Shannon distance up to which two histograms are the same


class Case(unittest.TestCase):
    def start(self, scenario, files=()):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-recordings-")
        self.addCleanup(folder.cleanup)
        self.capture = Path(folder.name) / "run.pcapng"
        self.emulator = Emulator(scenario, "--record", str(self.capture), files=files)
        self.addCleanup(self.emulator.__exit__, None, None, None)
        return self.emulator.__enter__()

    def neither_is_constant_alone(self, real, message, kind=None, known=()):
        """Ends the run. No field of that message may be constant in its capture and vary in the recording, or the other way
        round, but the `known` ones. `kind`: the maker's kind of file, into which the capture is converted first."""
        self.emulator.stop()
        ours = self.capture
        if kind:
            ours = ours.with_suffix(kind)
            subprocess.run([PROGRAM, "convert", str(self.capture), str(ours)], check=True, capture_output=True)
        done = subprocess.run([PROGRAM, "diff", "--json", str(ours), str(real)], capture_output=True, text=True)
        fields = [f for d in json.loads(done.stdout)["directions"] for t in d["types"] if t["name"] == message for f in t["fields"]]
        self.assertGreater(len(fields), 5, done.stderr)
        sides = [f for f in fields if "distinct" in f.get("a", {}) and "distinct" in f.get("b", {})]
        alone = {f["name"]: (f["a"], f["b"]) for f in sides if (f["a"]["distinct"] == 1) != (f["b"]["distinct"] == 1)}
        self.assertEqual({name: both for name, both in alone.items() if name not in known}, {})

    def alike(self, ours, real, what):
        fours = lambda side: [int(word) // 4 for word in side]  # so that some thousand words fill the classes
        distance = words.distance(fours(ours), fours(real))
        print(f"{what}: distance {distance:.3f}", *("%s %d, mean %.1f, 5 %% %d, 50 %% %d, 95 %% %d;" % (
            name, s["words"], s["mean"], s["5 %"], s["50 %"], s["95 %"])
            for name, s in (("ours", words.summary(ours)), ("real", words.summary(real)))))
        self.assertLess(distance, ALIKE, what)
