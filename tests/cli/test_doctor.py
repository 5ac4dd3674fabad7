"""echoloop doctor: what it looks at, and that a fault is named with its remedy."""
import ctypes
import json
import re
import resource
import socket
import subprocess
import unittest

from program import DEMO, PROGRAM, TANK, ProgramTest, run

PR_CAPBSET_DROP, CAP_SYS_NICE = 24, 23


def give_up_real_time():
    """What this process starts may not go before others: as on a machine where nobody has allowed it."""
    resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
    ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_SYS_NICE, 0, 0, 0)


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

    def test_says_whether_a_run_may_go_before_other_programs(self):
        run_it = [PROGRAM, "run", TANK, "--duration", "0", "--realtime", *self.to(f"pty:{self.folder}/micron")]
        for before in (None, give_up_real_time):
            text = subprocess.run([PROGRAM, "doctor"], preexec_fn=before, capture_output=True, text=True, check=True).stdout
            may = subprocess.run(run_it, preexec_fn=before, capture_output=True, check=False).returncode == 0
            line = re.search(r"(?m)^good +real time +(.*)$", text)[1]
            self.assertEqual(line.startswith("allowed: "), may, line)
            self.assertEqual("not allowed" in line, not may, line)
        self.assertFalse(may, "without the right to it")

    def test_says_how_long_a_byte_takes_across_a_pseudo_terminal(self):
        for _ in range(3):
            found = next(f for f in self.json("doctor")["findings"] if f["name"] == "pseudo-terminals")
            half, most = (float(n) for n in re.search(r"takes ([\d.]+) ms, 1 of 100 more than ([\d.]+) ms", found["text"]).groups())
            self.assertTrue(0 <= half <= most, found)
            self.assertGreater(most, 0)
            self.assertEqual(found["state"], "weak" if most > 1 else "good", found)

    def test_tries_a_scenario_on_it(self):
        text = self.good("doctor", TANK, *self.to(f"pty:{self.folder}/micron"))
        self.assertRegex(text, r"endpoints +all can be opened")
        self.assertRegex(text, r"micron: [0-9.]+ ms to render a ping; the sonar listens for 26\.7 ms")
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
