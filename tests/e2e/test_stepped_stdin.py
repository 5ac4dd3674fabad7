"""Steps on standard input: from a pipe or a file, the answers on standard output, and at their end the run ends."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, ROOT
from test_stepped import SCENARIO, SOUNDER

STEPS = "\n".join(json.dumps({"now": n / 4, "position": [0, 0, -2]}) for n in range(13))  # the last line has no end

SENDERS = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
clock: {mode: stepped, input: stdin}
devices:
  - {name: sonic, model: r2sonic-2024, endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]}
  - {name: depth, model: nmea-echosounder, endpoints: ["udp://127.0.0.1:%d"]}
  - {name: images, model: sonar-3d-15, endpoints: ["tcp-listen://127.0.0.1:%d"], options: {acoustics: true}}
""" % tuple(free_port() for _ in range(4))


class Steps(unittest.TestCase):
    def run_on(self, vehicle="", clock=", input: stdin", **stdin):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "scenario.yaml"
            text = SCENARIO % {"devices": SOUNDER % 9, "vehicle": vehicle, "clock": clock}
            file.write_text(text.replace("{scenes}", str(ROOT / "config" / "scenes")))
            done = subprocess.run([PROGRAM, "run", file, "--json"], capture_output=True, text=True, timeout=60, **stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        started, *answers, ended = map(json.loads, done.stdout.splitlines())
        self.assertEqual((started["event"], ended["event"]), ("started", "ended"))
        return answers, ended

    def test_a_pipe_and_a_file_say_the_same(self):
        answers, ended = self.run_on(input=STEPS)
        self.assertEqual([(a["now"], a["ack"]) for a in answers], [(n / 4, n + 1) for n in range(13)])
        self.assertGreater(answers[-1]["sent"]["sounder"], 0)
        self.assertEqual((ended["clock"]["steps"], ended["clock"]["run_time_s"]), (13, 3))
        self.assertEqual(ended["vehicle"]["poses"], 13)
        with tempfile.TemporaryFile("w+") as file:
            file.write(STEPS)
            file.seek(0)
            self.assertEqual(self.run_on(stdin=file)[0], answers)

    def test_the_vehicles_input_serves_for_both(self):
        answers, ended = self.run_on(vehicle=", input: stdin", clock="", input="nonsense\n" + STEPS)
        self.assertEqual(answers[0]["error"], "no JSON")
        self.assertEqual(answers[-1]["ack"], 13)
        self.assertEqual((ended["clock"]["steps"], ended["clock"]["refused"]), (13, 1))

    def test_recordings_of_equal_runs_are_equal_to_the_byte(self):
        """Of sonars that send from ports of the system's choice, too."""
        recordings = []
        with tempfile.TemporaryDirectory() as folder:
            file, recording = Path(folder) / "scenario.yaml", Path(folder) / "run.pcapng"
            file.write_text(SENDERS.replace("{scenes}", str(ROOT / "config" / "scenes")))
            for _ in range(2):
                done = subprocess.run([PROGRAM, "run", file, "--record", recording], capture_output=True, text=True,
                                      input=STEPS, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                recordings.append(recording.read_bytes())
        self.assertGreater(len(recordings[0]), 10_000)
        self.assertEqual(recordings[0], recordings[1])


if __name__ == "__main__":
    unittest.main()
