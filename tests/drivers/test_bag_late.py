"""Pings that come too late are in a bag's log, each with its lateness: those of a 3D sonar whose image of a large scene is due 16 ms
after the transmission. Also those whose picture the bag had no room for, as it happens with these on a slow machine. Read back by mcap
from PyPI."""

import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from test_bag import PROGRAM, ROOT, free_port, messages

LATE = """
scene: %s/config/scenes/manifold.glb
seed: 1
water: {temperature: 8, salinity: 35, ph: 8}
vehicle: {pose: {position: [-8, 0, -5]}}
clock: {mode: real}
devices:
  - {name: busy, model: sonar-3d-15, mount: {rpy_deg: [0, 20, 0]}, endpoints: ["tcp-listen://127.0.0.1:%d"],
     options: {acoustics: true}}
"""
LINE = re.compile(r"ping (\d+) was (\d+) ms late")


class Late(unittest.TestCase):
    def test_each_late_ping_is_a_line_of_the_log(self):
        with tempfile.TemporaryDirectory(prefix="echoloop-bag-") as folder:
            scenario, file = Path(folder) / "late.yaml", Path(folder) / "late.mcap"
            scenario.write_text(LATE % (ROOT, free_port()))
            for seconds in (4, 8, 16, 32):  # a busy machine draws few pings in a second
                done = subprocess.run([PROGRAM, "run", str(scenario), "--duration", str(seconds), "--mcap", str(file), "--json"],
                                      capture_output=True, text=True, timeout=100)
                self.assertEqual(done.returncode, 0, done.stderr)
                told = json.loads(done.stdout.splitlines()[-1])["devices"][0]
                if told["late_pings"] > 3:
                    break
            found, *_ = messages(file)
        log = [line for _, line in found["/rosout"] if LINE.fullmatch(line.msg)]
        late = [LINE.fullmatch(line.msg).groups() for line in log]
        self.assertGreater(told["late_pings"], 3, "this run has to be late")
        self.assertEqual({line.name for line in log}, {"busy"})
        self.assertEqual({line.level for line in log}, {30}, "rcl_interfaces/Log has 30 for a warning")
        self.assertEqual(len({number for number, _ in late}), len(late))
        self.assertEqual(len(late), told["late_pings"])
        self.assertAlmostEqual(max(int(ms) for _, ms in late), 1000 * told["worst_lateness_s"], delta=1.1)


if __name__ == "__main__":
    unittest.main()
