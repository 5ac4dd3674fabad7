"""The Micron on a serial port opened through libserialport.

No serial hardware can be had here: Debian's umockdev makes the device node and its /sys entries, a small shim answers
the modem-line requests (uart_shim.c). Run under umockdev-wrapper; UART_SHIM names the compiled shim.
"""

import os
import re
import select
import signal
import subprocess
import sys
import time
import tty
import unittest
from pathlib import Path

import gi

gi.require_version("UMockdev", "1.0")
from gi.repository import UMockdev

from program import Emulator
from replaying import Folder, open_line, read_line
from test_record import packets, payload
from test_record_device import Recorder

import imagenex_host
import imagenex_wire
import seanet_wire
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

SOUNDER = """
scene: {scenes}/flat.glb
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - name: sounder
    model: imagenex-852
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["serial://%s:115200"]
    options: {reply_baud: honoured}
"""


class OverSerialPort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.testbed = UMockdev.Testbed.new()
        cls.testbed.add_from_string(UART)
        os.environ["UMOCKDEV_DIR"] = cls.testbed.get_root_dir()  # set by the library behind Python's back
        cls.skip_where_the_libraries_do_not_fit()
        os.environ["LD_PRELOAD"] = os.environ["UART_SHIM"] + ":" + os.environ.get("LD_PRELOAD", "")

    @staticmethod
    def skip_where_the_libraries_do_not_fit():
        """On Debian 13 libserialport 0.1.2 alone, without echoloop, crashes over a node of umockdev 0.19."""
        look_up = ("import ctypes; port = ctypes.c_void_p(); "
                   "ctypes.CDLL('libserialport.so.0').sp_get_port_by_name(b'/dev/ttyEL0', ctypes.byref(port))")
        if subprocess.run([sys.executable, "-c", look_up]).returncode != -signal.SIGSEGV:
            return
        reason = "libserialport itself crashes over this release's umockdev"
        if os.environ.get("CI") == "true":
            raise AssertionError(reason)
        raise unittest.SkipTest(reason)

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

    def test_the_port_has_the_rate_that_a_command_asks_for_while_it_answers(self):
        other_end = self.testbed.get_dev_fd("/dev/ttyEL0")
        with Emulator(SOUNDER % "/dev/ttyEL0") as emulator:
            host = imagenex_host.Host(ByteLine(other_end), seconds=20)
            for code in (6, 0x0B, 0x02):
                self.assertEqual(host.ask(imagenex_wire.sounder_command(baud=code)).letter, "G")
                if code != 6:
                    emulator.read_until("uart: 115200 bit/s", 20)
                    emulator.output = emulator.output.replace("uart: 115200", "uart: then 115200")
            _, output = emulator.stop()
        changes = re.findall(r"uart: (?:then )?(\d+) bit/s, (\d+) left to send", output)
        self.assertEqual(changes, [("9600", "0"), ("115200", "0"), ("38400", "0"), ("115200", "0")])

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

    def test_a_pulled_adapter_is_waited_for(self):
        """The kernel hangs up on a port whose adapter has gone, as on a pty whose master is closed."""
        node = Path(self.testbed.get_root_dir()) / "dev" / "ttyEL0"
        original = os.readlink(node)
        self.addCleanup(point_to, node, original)
        point_to(node, self.adapter())
        with Emulator(SCENARIO % "/dev/ttyEL0") as emulator:
            self.assertTrue(self.alive(self.other_end))
            os.close(self.other_end)
            point_to(node, "/dev/pts/none")
            emulator.read_until("serial port /dev/ttyEL0: unplugged", 20)
            busy = processor_seconds(emulator.process.pid)
            self.assertEqual(select.select([emulator.process.stdout], [], [], 2)[0], [], "it says so once")
            self.assertLess(processor_seconds(emulator.process.pid) - busy, 0.25)
            point_to(node, self.adapter())
            emulator.read_until("serial port /dev/ttyEL0: plugged in again", 20)
            self.assertTrue(self.alive(self.other_end), "the device has gone on meanwhile")
            os.write(self.other_end, seanet_wire.build(seanet_wire.SEND_VERSION))
            self.assertTrue(self.alive(self.other_end, seanet_wire.VERSION_DATA), "and listens")
            status, output = emulator.stop()
        os.close(self.other_end)
        self.assertEqual(status, 0, output)
        self.assertEqual(output.count("unplugged"), 1)

    def adapter(self):
        """A new one, named by its terminal; its other end is ours."""
        self.other_end, line = os.openpty()
        tty.setraw(line)
        self.addCleanup(os.close, line)
        return os.ttyname(line)

    def alive(self, line, message=seanet_wire.ALIVE, seconds=10):
        """True when such a frame has come."""
        framer, end = seanet_wire.Framer(), time.monotonic() + seconds
        while select.select([line], [], [], max(0, end - time.monotonic()))[0]:
            framer.feed(os.read(line, 4096))
            while frame := framer.next():
                if frame.message == message:
                    return True
        return False


def point_to(node, terminal):
    """What udev does when an adapter comes and goes."""
    node.unlink(missing_ok=True)
    node.symlink_to(terminal)


def processor_seconds(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    unittest.main()
