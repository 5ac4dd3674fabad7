"""When bytes arrive, seen from outside: the pace of a line, garbage at a wrong rate, USB bursts. Bounds are generous, since
the machine may be busy; tools/timing measures exactly."""

import json
import os
import re
import select
import signal
import socket
import subprocess
import sys
import termios
import time
import tty
import unittest

from ports import free_port
from program import PROGRAM, ROOT, Emulator

SOUNDER = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2], rpy_deg: [0, 0, 0]}}
devices:
  - name: sounder
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["pty:{folder}/line%s"]
    options: {rate: 5, baud: %d}
"""

FAR = """
scene: {scenes}/flat.glb
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: bathymetry
    model: r2sonic-2024
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]
    options: {range: 400, ping_rate: 60}
"""


def open_line(path, baud=None):
    fd = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    if baud is not None:
        tty.setraw(fd, termios.TCSANOW)
        attributes = termios.tcgetattr(fd)
        attributes[4] = attributes[5] = getattr(termios, f"B{baud}")
        termios.tcsetattr(fd, termios.TCSANOW, attributes)
    return fd


def hear(fd, seconds):
    """What comes within that time: all of it, and the time of each read."""
    end, heard, times = time.monotonic() + seconds, b"", []
    while (left := end - time.monotonic()) > 0:
        if select.select([fd], [], [], left)[0]:
            heard += os.read(fd, 65536)
            times.append(time.monotonic())
    return heard, times


class Lines(unittest.TestCase):
    def listen(self, baud, device_baud=38400, query="", seconds=1.2):
        with Emulator(SOUNDER % (query, device_baud)) as emulator:
            fd = open_line(emulator.folder / "line", baud)
            heard, times = hear(fd, seconds)
            os.close(fd)
            return heard, times, emulator.stop()[1]

    def test_the_right_rate_and_none_at_all_give_sentences(self):
        for baud in (38400, None):
            with self.subTest(baud):
                heard, _, log = self.listen(baud)
                self.assertIn(b"$SDDPT,", heard)
                self.assertNotIn("garbage", log)

    def test_a_wrong_rate_gives_garbage_and_one_line_that_says_why(self):
        heard, _, log = self.listen(9600)
        self.assertNotIn(b"$SD", heard)
        self.assertGreater(len(heard), 5, "garbage, not silence")
        self.assertEqual(log.count("garbage"), 1, log)
        self.assertIn("option baud to 9600", log)

    def test_who_does_not_want_that_can_say_so(self):
        heard, _, log = self.listen(9600, query="?baud_check=off")
        self.assertIn(b"$SDDPT,", heard)
        self.assertNotIn("garbage", log)

    def test_a_usb_adapter_gathers_what_a_line_trickles(self):
        _, plain, _ = self.listen(38400)
        _, gathered, _ = self.listen(38400, query="?usb_latency=50")
        self.assertLess(len(gathered), len(plain) / 2)


class Late(unittest.TestCase):
    def test_pings_that_were_late_since_the_program_did_not_run_are_told_apart(self):
        device, gui = free_port(32), free_port(16)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host, Emulator(FAR % (device, gui)) as emulator:
            host.bind(("127.0.0.1", gui))
            host.settimeout(20)
            for pause in (0.1, 0.2, 0.3):
                self.ping(host)
                time.sleep(pause)  # of the 0.53 s that the next one is on its way
                emulator.process.send_signal(signal.SIGSTOP)
                time.sleep(1)
                emulator.process.send_signal(signal.SIGCONT)
            log = emulator.stop()[1]
        late, rendering, waking, worst = re.search(
            r"(\d+) late \((\d+) because of rendering, (\d+) because the program was woken late\), "
            r"the worst by ([\d.]+) ms", log).groups()
        self.assertGreaterEqual(int(waking), 1, log)
        self.assertLessEqual(int(rendering) + int(waking), int(late), log)
        self.assertGreater(float(worst), 300, log)

    def ping(self, host):
        while host.recv(65536)[:4] != b"BTH0":
            pass


class Pace(unittest.TestCase):
    def test_a_second_process_measures_the_pace(self):
        done = subprocess.run([sys.executable, str(ROOT / "tools" / "timing"), "--pings", "20", "--json"],
                              env={**os.environ, "ECHOLOOP": PROGRAM}, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(done.stdout)
        for rate, (median, _) in figures["pace_percent"].items():  # a reply at 921600 is over in 13 ms
            self.assertLess(abs(median), 60 if rate == "921600" else 20, f"{rate} bit/s")
        for wire, (median, _, _) in figures["late_ms"].items():
            self.assertLess(median, 200, wire)


if __name__ == "__main__":
    unittest.main()
