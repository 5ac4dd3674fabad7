"""Who connects and does nothing keeps nobody out: the one that has been idle for the longest time makes way."""

import json
import socket
import time
import unittest

from ports import free_port
from program import Emulator

import norbit_host

SCENARIO = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
control: "unix:{folder}/control"
devices:
  - name: sonar
    %s
"""
SOUNDER = 'model: ping1d\n    endpoints: ["tcp-listen://127.0.0.1:%d%s"]\n'
NORBIT = """model: norbit-wbms
    endpoints: ["tcp-listen://127.0.0.1:%d?idle=1", "tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d"]
"""
DEVICE_INFORMATION = bytes.fromhex("4252020006000000" "0400a000")  # a request of the Ping protocol
MOST_CLIENTS = 16  # at the control place


class Squatters(unittest.TestCase):
    def start(self, device):
        emulator = Emulator(SCENARIO % device)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def sounder(self, setting=""):
        self.port = free_port()
        return self.start(SOUNDER % (self.port, setting))

    def connected(self, port):
        line = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.addCleanup(line.close)
        return line

    def newcomer_is_served(self):
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as line:
            return self.is_served(line)

    @staticmethod
    def is_served(line):
        """Whether the sounder answers."""
        try:
            line.sendall(DEVICE_INFORMATION)
            return line.recv(100).startswith(b"BR")
        except (BrokenPipeError, ConnectionResetError):
            return False

    def seconds_until_served(self, longest):
        begin = time.monotonic()
        while time.monotonic() < begin + longest:
            if self.newcomer_is_served():
                return time.monotonic() - begin
        self.fail(f"not served within {longest} s")

    def status(self, emulator):
        with socket.socket(socket.AF_UNIX) as control:
            control.settimeout(20)
            control.connect(str(emulator.folder / "control"))
            control.sendall(b'{"status": true}\n')
            return json.loads(control.makefile().readline())["devices"][0]

    def test_the_only_place_is_free_after_a_while(self):
        emulator = self.sounder("?idle=1")
        squatter = self.connected(self.port)
        waited = self.seconds_until_served(10)
        self.assertGreater(waited, 0.7)
        self.assertLess(waited, 3)
        self.assertEqual(squatter.recv(1), b"")
        self.assertIn("makes way for another driver", emulator.stop()[1])

    def test_ten_seconds_unless_told_otherwise(self):
        self.sounder()
        self.connected(self.port)
        self.assertGreater(self.seconds_until_served(30), 9)

    def test_who_is_at_work_stays(self):
        emulator = self.sounder("?idle=1")
        driver = self.connected(self.port)
        name = "{}:{}".format(*driver.getsockname())
        end = time.monotonic() + 2.5
        while time.monotonic() < end:
            self.assertTrue(self.is_served(driver))
            self.assertFalse(self.newcomer_is_served())
        self.assertEqual(self.status(emulator)["connected"], [name])

    def test_off_means_for_ever(self):
        self.sounder("?idle=off")
        self.connected(self.port)
        end = time.monotonic() + 2
        while time.monotonic() < end:
            self.assertFalse(self.newcomer_is_served())

    def test_of_several_the_oldest_idle_one_goes(self):
        ports = [free_port() for _ in range(3)]
        emulator = self.start(NORBIT % tuple(ports))
        busy = norbit_host.Line(ports[0])
        self.addCleanup(busy.close)
        squatters = [norbit_host.Line(ports[0]) for _ in range(7)]
        for squatter in squatters:
            self.addCleanup(squatter.close)
        self.assertEqual(len(self.status(emulator)["connected"]), 8)
        end = time.monotonic() + 10
        while True:
            self.assertTrue(busy.ask("set_range"))
            with socket.create_connection(("127.0.0.1", ports[0]), timeout=10) as ninth:
                try:
                    if ninth.recv(100):  # the greeting
                        break
                except ConnectionResetError:
                    pass
            self.assertLess(time.monotonic(), end, "the ninth was never let in")
        self.assertEqual(squatters[0].socket.recv(1), b"", "the oldest has gone")
        self.assertTrue(busy.ask("set_range"))
        self.assertTrue(squatters[1].ask("set_range"), "the others stay")

    def test_the_control_place(self):
        emulator = self.sounder()
        for _ in range(MOST_CLIENTS):
            squatter = socket.socket(socket.AF_UNIX)
            self.addCleanup(squatter.close)
            squatter.connect(str(emulator.folder / "control"))
        end = time.monotonic() + 30
        while time.monotonic() < end:
            try:
                self.assertEqual(self.status(emulator)["name"], "sonar")
                return
            except (json.JSONDecodeError, ConnectionError):  # turned away
                continue
        self.fail("nobody could command the run any more")


if __name__ == "__main__":
    unittest.main()
