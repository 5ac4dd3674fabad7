"""Whoever starts the emulator may not read what it logs: the sonars go on all the same."""

import fcntl
import os
import select
import socket
import unittest

from ports import free_port
from program import Emulator

from oculus_host import Host

SCENARIO = """
scene: "{scenes}/tank.glb"
vehicle: {pose: {position: [0, 0, -3]}}
devices:
  - name: oculus
    model: oculus-m750d
    endpoints: ["tcp-listen://127.0.0.1:%d", "udp://127.255.255.255:%d"]
"""
PIPE = 4096   # bytes: a page, which takes a line only while it is empty


class Unread(unittest.TestCase):
    def setUp(self):
        self.data, status = free_port(), free_port()
        self.host = Host(status, self.data)
        self.addCleanup(self.host.close)
        self.emulator = Emulator(SCENARIO % (self.data, status))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()
        fcntl.fcntl(self.emulator.process.stdout, fcntl.F_SETPIPE_SZ, PIPE)
        self.host.wait_status()
        self.host.connect()

    def be_turned_away(self):
        """One line of the log."""
        with socket.create_connection(("127.0.0.1", self.data), timeout=5) as second:
            try:
                self.assertEqual(second.recv(1), b"")
            except ConnectionResetError:
                pass

    def read_all(self):
        """What the pipe holds."""
        pipe, text = self.emulator.process.stdout, b""
        while select.select([pipe], [], [], 0)[0]:
            text += os.read(pipe.fileno(), PIPE)
        return text.decode()

    def test_a_full_pipe_holds_nothing_up_and_the_log_says_later_what_it_left_out(self):
        for _ in range(4):
            self.be_turned_away()
        while select.select([self.host.udp], [], [], 0)[0]:
            self.host.wait_status()  # from before
        self.host.wait_status()
        self.assertEqual(self.read_all().count("turned away"), 1)
        self.be_turned_away()
        self.emulator.read_until("lines of the log were left out", 10)
        self.assertEqual(self.emulator.stop()[0], 0)

    def test_a_peer_cannot_fill_the_disk_with_lines(self):
        for _ in range(500):
            self.be_turned_away()
        status, output = self.emulator.stop()
        self.assertEqual(status, 0)
        self.assertLessEqual(output.count("turned away"), 10)
        self.assertRegex(output, r"4\d\d more lines of a kind that came too often were left out")


if __name__ == "__main__":
    unittest.main()
