"""echoloop doctor: what it looks at, and that a fault is named with its remedy."""
import json
import socket
import unittest

from program import DEMO, TANK, ProgramTest, run


class Doctor(ProgramTest):
    def to(self, endpoint):
        return ["--set", f'devices.micron.endpoints=["{endpoint}"]']

    def test_looks_at_the_machine_and_changes_nothing(self):
        report = self.json("doctor")
        self.assertTrue(report["ok"])
        seen = {f["name"]: f for f in report["findings"]}
        for name in ("processors", "memory", "timers", "real time", "OpenGL", "GPU", "pseudo-terminals", "serial ports", "sockets"):
            self.assertTrue(seen[name]["text"], name)
            if seen[name]["state"] != "good":
                self.assertTrue(seen[name]["remedy"], name)
        self.assertEqual(seen["OpenGL"]["state"], "good")

    def test_tries_a_scenario_on_it(self):
        text = self.good("doctor", TANK, *self.to(f"pty:{self.folder}/micron"))
        self.assertRegex(text, r"endpoints +all can be opened")
        self.assertRegex(text, r"micron: [0-9.]+ ms to render what the sonar listens to for 26\.7 ms")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_port_in_use_is_a_fault_with_its_remedy(self):
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = other.getsockname()[1]
            done = run("doctor", TANK, *self.to(f"tcp-listen://127.0.0.1:{port}"), "--json")
        self.assertEqual(done.returncode, 69)
        bad = [f for f in json.loads(done.stdout)["findings"] if f["state"] == "bad"]
        self.assertEqual([f["name"] for f in bad], ["endpoints"])
        for word in (str(port), "already in use", "ss -lunpt"):
            self.assertIn(word, bad[0]["text"])

    def test_a_ping_that_takes_longer_than_its_echo_is_weak(self):
        report = self.json("doctor", DEMO, "--set", "render.pixels=20", *self.to(f"pty:{self.folder}/micron"))
        pings = {f["text"].split(":")[0]: f for f in report["findings"] if f["name"] == "ping"}
        self.assertEqual(pings["sonar"]["state"], "weak", pings)
        self.assertIn("pixels", pings["sonar"]["remedy"])


if __name__ == "__main__":
    unittest.main()
