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
from replaying import Folder, open_line, read_line
from test_record import packets, payload
from test_record_device import Recorder

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

    def test_a_real_port_is_recorded_and_passed_on_to_a_driver(self):
        other_end = self.testbed.get_dev_fd("/dev/ttyEL0")
        folder = Folder()
        self.addCleanup(folder.remove)
        capture = folder.path / "lake.pcapng"
        asked, answer = b"\x01\x02 ask", bytes(range(256)) * 4
        with Recorder("serial:///dev/ttyEL0:115200", f"pty:{folder.path}/line", "--out", capture) as recorder:
            line = open_line(folder.path / "line")
            os.write(line, asked)
            self.assertEqual(b"".join(data for _, data in read_line(other_end, len(asked))), asked)
            os.write(other_end, answer)
            self.assertEqual(b"".join(data for _, data in read_line(line, len(answer))), answer)
            os.close(line)
            recorder.stop()
        rows = packets(capture, "rtacser.eventtype", "data.data", "frame.interface_name")
        self.assertEqual({row["frame.interface_name"][0] for row in rows}, {"device line"})
        said = [row for row in rows if int(row["rtacser.eventtype"][0], 0) == 1]
        self.assertEqual(payload(said, "data.data"), answer)
        self.assertEqual(payload([row for row in rows if row not in said], "data.data"), asked)


if __name__ == "__main__":
    unittest.main()
