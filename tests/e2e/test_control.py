"""The control socket: faults while a run goes on, and what it answers to everything else."""

import contextlib
import json
import os
import re
import shutil
import socket
import stat
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, Emulator
from test_faults import PROTOCOL_VERSION, VERSION_REPLY, Pty, request

SOUNDER = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: ping1d
    model: ping1d
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["pty:{folder}/ping1d"]
control: %s
"""


class Client:
    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(20)
        self.socket.connect(str(path))
        self.lines = self.socket.makefile("r")

    def ask(self, line):
        self.socket.sendall((line if isinstance(line, str) else json.dumps(line)).encode() + b"\n")
        return json.loads(self.lines.readline())

    def close(self):
        self.lines.close()
        self.socket.close()


class Control(unittest.TestCase):
    def start(self, place="unix:{folder}/control", *arguments):
        emulator = Emulator(SOUNDER % place, *arguments)
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator

    def client(self, emulator):
        client = Client(emulator.folder / "control")
        self.addCleanup(client.close)
        return client

    def answered(self, driver):
        driver.write(request(PROTOCOL_VERSION))
        return len(driver.read(VERSION_REPLY, 1)) == VERSION_REPLY

    def test_a_fault_comes_and_goes(self):
        emulator = self.start()
        client = self.client(emulator)
        driver = Pty(emulator.folder / "ping1d")
        self.addCleanup(driver.close)
        self.assertTrue(self.answered(driver))
        self.assertEqual(client.ask({"fault": {"device": "ping1d", "kind": "silence"}}), {"ok": True, "id": 1})
        self.assertFalse(self.answered(driver))
        listed = client.ask({"list": True})["faults"]
        self.assertEqual([(f["id"], f["device"], f["kind"], f["on"], f["made"]) for f in listed],
                         [(1, "ping1d", "silence", True, 1)])
        status = client.ask({"status": True})["devices"][0]
        self.assertEqual((status["name"], status["faults"]), ("ping1d", {"silence": 1}))
        self.assertEqual(client.ask({"clear": 1}), {"ok": True, "cleared": 1})
        self.assertTrue(self.answered(driver))
        self.assertFalse(client.ask({"clear": 1})["ok"])
        self.assertIn("1 silence", emulator.stop()[1])
        self.assertFalse((emulator.folder / "control").exists())

    def test_a_file_that_took_the_sockets_place_stays(self):
        emulator = self.start()
        place = emulator.folder / "control"
        place.unlink()
        place.write_text("of another run")
        self.assertEqual(emulator.stop()[0], 0)
        self.assertEqual(place.read_text(), "of another run")

    def test_what_is_wrong_is_refused_and_the_run_goes_on(self):
        emulator = self.start()
        client, other = self.client(emulator), self.client(emulator)
        for line, reason in (
            ("hello", "JSON object"), ("{", "no JSON"), ("[]", "JSON object"), ('{"stop": true}', "known are"),
            ('{"fault": {"device": "ping1d", "kind": "rust"}}', "unknown value 'rust'"),
            ('{"fault": {"device": "ping1d", "kind": "loss", "rate": "much"}}', "expected a number"),
            ('{"fault": {"device": "ping1d", "kind": "half_open"}}', "TCP"),
            ('{"clear": 99}', "there is no fault 99"), ("{" * 2000, "no JSON")):
            answer = client.ask(line)
            self.assertFalse(answer["ok"], line)
            self.assertIn(reason, answer["error"], line)
        self.assertTrue(other.ask({"list": True})["ok"])
        self.assertFalse(client.ask("x" * 5000)["ok"])
        client.socket.sendall(b"x" * 9000)
        self.assertFalse(json.loads(client.lines.readline())["ok"])
        try:
            self.assertEqual(client.lines.readline(), "", "nobody is listened to who writes lines without an end")
        except ConnectionResetError:
            pass
        self.assertTrue(other.ask({"list": True})["ok"])
        self.assertEqual(emulator.stop()[0], 0)

    def test_the_socket_is_the_users_alone_and_one_run_has_it(self):
        emulator = self.start()
        path = emulator.folder / "control"
        self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o600)
        second = subprocess.run([PROGRAM, "run", str(emulator.file), "--set", "devices.ping1d.endpoints=[\"pty:/tmp/none/p\"]"],
                                capture_output=True, text=True, timeout=60)
        self.assertEqual(second.returncode, 73, second.stderr)
        self.assertIn("exists already", second.stderr)
        emulator.process.kill()
        emulator.process.communicate()
        self.assertTrue(path.exists(), "it had no time to clear up")
        again = subprocess.run([PROGRAM, "run", str(emulator.file), "--duration", "0"], capture_output=True, text=True, timeout=60)
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_a_place_that_somebody_has_and_does_not_serve_keeps_no_run_waiting(self):
        folder = Path(tempfile.mkdtemp(prefix="echoloop-control-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        deaf, waiting = socket.socket(socket.AF_UNIX), []
        self.addCleanup(deaf.close)
        deaf.bind(str(folder / "control"))
        deaf.listen(0)
        with contextlib.suppress(BlockingIOError):
            for _ in range(100):
                waiting.append(socket.socket(socket.AF_UNIX))
                self.addCleanup(waiting[-1].close)
                waiting[-1].setblocking(False)
                waiting[-1].connect(str(folder / "control"))
        with self.assertRaises(RuntimeError) as raised:
            self.start(f"unix:{folder}/control")
        self.assertIn("exists already", str(raised.exception))

    def test_answers_that_are_no_runs_are_refused(self):
        for answer in (b"no JSON\n", b'{"ok": "yes"}\n', b'{"ok": true, "faults": [{"id": []}]}\n', b"{", b""):
            with socket.create_server(("127.0.0.1", 0)) as server:
                place = "tcp-listen://127.0.0.1:%d" % server.getsockname()[1]
                with subprocess.Popen([PROGRAM, "fault", place, os.fsdecode(b"\xff"), "loss", "--token", "any"], stderr=subprocess.PIPE,
                                      stdout=subprocess.DEVNULL) as asking:
                    with server.accept()[0] as connection:
                        with connection.makefile("rb") as lines:
                            self.assertEqual(json.loads(lines.readline()), {"token": "any"})
                            connection.sendall(b'{"ok": true}\n')
                            line = json.loads(lines.readline())
                        self.assertEqual(line["fault"]["device"], "\ufffd")
                        connection.sendall(answer)
                    said = asking.communicate(timeout=60)[1].decode()
            self.assertEqual(asking.returncode, 74, said)

    def test_a_person_types_it(self):
        emulator = self.start("tcp-listen://127.0.0.1:%d" % (port := free_port()))
        place = f"tcp-listen://127.0.0.1:{port}"

        token = re.search(r"^control +tcp-listen://\S+, token ([0-9a-f]{32})$", emulator.output, re.M)[1]

        def fault(*words, token=token):
            return subprocess.run([PROGRAM, "fault", place, *words], capture_output=True, text=True, timeout=60,
                                  env={**os.environ, "ECHOLOOP_TOKEN": token})

        self.assertEqual(fault("list", token="").returncode, 64)
        wrong = fault("ping1d", "silence", token="0" * 32)
        self.assertEqual(wrong.returncode, 65)
        self.assertIn("token", wrong.stderr)
        self.assertEqual(json.loads(fault("list", "--json").stdout)["faults"], [])

        self.assertIn("fault 1", fault("ping1d", "bit_flips", "rate=1e-4", "for=60").stdout)
        self.assertRegex(fault("list").stdout, r"1  ping1d bit_flips .*rate=0.0001")
        fault("ping1d", "silence", "at=1000.6", "for=3", "every=60")
        self.assertRegex(fault("list").stdout, r"2  ping1d silence .*from=1000\.6 for=3\.0 every=60\.0 ")
        self.assertIn("pings", fault("status").stdout)
        wrong = fault("ping1d", "bit_flip")
        self.assertEqual(wrong.returncode, 65)
        self.assertIn("did you mean 'bit_flips'?", wrong.stderr)
        self.assertIn("2 faults cleared", fault("clear", "all").stdout)
        self.assertEqual(json.loads(fault("list", "--json").stdout)["faults"], [])
        self.assertEqual(emulator.stop()[0], 0)
        self.assertEqual(fault("list").returncode, 69)

    def test_places_that_are_none_are_refused(self):
        for place in ("unix:control", "tcp-listen://0.0.0.0:9600", "nowhere"):
            with self.assertRaises(RuntimeError) as raised:
                self.start(place)
            self.assertIn("control: ", str(raised.exception))

    def test_a_reboot_forgets_what_the_device_was_told(self):
        emulator = self.start()
        client = self.client(emulator)
        driver = Pty(emulator.folder / "ping1d")
        self.addCleanup(driver.close)
        self.assertTrue(self.answered(driver))
        client.ask({"fault": {"device": "ping1d", "kind": "reboot", "off": 0.5}})
        answered = False
        begin = time.monotonic()
        self.assertFalse(self.answered(driver) and time.monotonic() - begin < 0.4)
        while not answered and time.monotonic() < begin + 20:
            driver.read(1000, 0.05)
            answered = self.answered(driver)
        self.assertTrue(answered)


if __name__ == "__main__":
    unittest.main()
