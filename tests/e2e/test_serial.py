"""The Micron on a serial port opened through libserialport.

No serial hardware can be had here: Debian's umockdev makes the device node and its /sys entries, a small shim answers
the modem-line requests (uart_shim.c). Run under umockdev-wrapper; UART_SHIM names the compiled shim.
"""

import os
import unittest

import gi

gi.require_version("UMockdev", "1.0")
from gi.repository import UMockdev

from program import Emulator

from byte_line import ByteLine
from seanet_handshakes import HANDSHAKES
from seanet_host import scan
from seanet_session import Session
from seanet_styles import Settings

UART = """P: /devices/virtual/tty/ttyEL0
N: ttyEL0
E: DEVNAME=/dev/ttyEL0
E: SUBSYSTEM=tty
A: dev=4:64

"""
SCENARIO = """
scene: {scenes}/tank.glb
devices:
  - name: micron
    model: tritech-micron
    endpoints: ["serial://%s:115200"]
    options: {first_alive: 0.1, recentring_alives: 2}
"""


class OverSerialPort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.testbed = UMockdev.Testbed.new()
        cls.testbed.add_from_string(UART)
        os.environ["UMOCKDEV_DIR"] = cls.testbed.get_root_dir()  # set by the library behind Python's back
        os.environ["LD_PRELOAD"] = os.environ["UART_SHIM"] + ":" + os.environ.get("LD_PRELOAD", "")

    def test_lines_come_over_a_uart(self):
        other_end = self.testbed.get_dev_fd("/dev/ttyEL0")
        with Emulator(SCENARIO % "/dev/ttyEL0"):
            line = ByteLine(other_end)
            lines = []
            session = Session(line, "mcgill", Settings(range=10.0, bins=200), limit=40)
            HANDSHAKES["mcgill"](session)
            scan(session, 30, (), lambda _n, data, faults, _j: lines.append((data.bearing, faults)))
            self.assertEqual(len(lines), 30)
            self.assertEqual([faults for _, faults in lines if faults], [])
            self.assertEqual(session.framer.skipped, 0)


if __name__ == "__main__":
    unittest.main()
