"""Whoever starts the emulator may not read what it logs: the sonars go on all the same."""

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
PIPE = 65536  # bytes that it holds
LINE = 60     # of the log, at least


class Unread(unittest.TestCase):
    def setUp(self):
        self.data, status = free_port(), free_port()
        self.host = Host(status, self.data)
        self.addCleanup(self.host.close)
        self.emulator = Emulator(SCENARIO % (self.data, status))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()
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
        for _ in range(PIPE // LINE + 200):
            self.be_turned_away()
        while select.select([self.host.udp], [], [], 0)[0]:
            self.host.wait_status()  # from before
        self.host.wait_status()
        self.assertGreater(len(self.read_all()), PIPE // 2)
        self.be_turned_away()
        self.emulator.read_until("lines of the log were left out", 10)
        self.assertEqual(self.emulator.stop()[0], 0)


if __name__ == "__main__":
    unittest.main()
