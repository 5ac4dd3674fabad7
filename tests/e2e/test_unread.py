"""Drivers that ask without end and never read: they cost a bounded amount of memory, and the next driver is not handed what
they asked for."""

import os
import select
import socket
import time
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator
from test_faults import Pty, request

SCENARIO = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: sounder, model: ping1d, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["%s"]}
"""
PROFILE, DEVICE_INFORMATION = 1300, 4
BYTES_PER_SECOND = 11520
OF_THE_KERNEL = 24 << 10  # what a pseudo-terminal holds: who is quicker than a busy program may read it
MEBIBYTE = 1 << 20


def resident(process):
    """Bytes of memory that the process has."""
    return int(Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Unread(unittest.TestCase):
    def start(self, endpoint):
        emulator = Emulator(SCENARIO % endpoint)
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        return emulator

    def flood(self, descriptor, process, seconds):
        """Asks as fast as it is taken; returns the most memory that the program had meanwhile."""
        asked, most = request(DEVICE_INFORMATION) * 200, 0
        os.set_blocking(descriptor, False)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if select.select([], [descriptor], [], 0.1)[1]:
                try:
                    os.write(descriptor, asked)
                except BlockingIOError:
                    pass
            most = max(most, resident(process))
        return most

    def test_memory_is_bounded_and_comes_back(self):
        for endpoint in ("pty:{folder}/line", f"tcp-listen://127.0.0.1:{(port := free_port())}"):
            with self.subTest(endpoint=endpoint):
                emulator = self.start(endpoint)
                before = resident(emulator.process)
                if endpoint.startswith("pty"):
                    driver = Pty(emulator.folder / "line")
                    descriptor = driver.line
                else:
                    driver = socket.create_connection(("127.0.0.1", port))
                    descriptor = driver.fileno()
                self.assertLess(self.flood(descriptor, emulator.process, 5) - before, 64 * MEBIBYTE)
                driver.close()
                end = time.monotonic() + 20
                while resident(emulator.process) - before > 24 * MEBIBYTE and time.monotonic() < end:
                    select.select([], [], [], 0.1)
                self.assertLess(resident(emulator.process) - before, 24 * MEBIBYTE)
                self.assertRegex(emulator.stop()[1], "dropped")

    def test_who_opens_the_line_next_hears_no_more_than_a_real_line_would_carry(self):
        emulator = self.start("pty:{folder}/line")
        rude = Pty(emulator.folder / "line")
        asked = request(PROFILE) * 100
        os.set_blocking(rude.line, False)
        end = time.monotonic() + 2
        while time.monotonic() < end and select.select([], [rude.line], [], 0.1):
            try:
                os.write(rude.line, asked)
            except BlockingIOError:
                pass
        rude.close()
        driver = Pty(emulator.folder / "line")
        self.addCleanup(driver.close)
        stale = driver.read(10**6, 4)
        self.assertLess(len(stale), 2.5 * BYTES_PER_SECOND + OF_THE_KERNEL)
        self.assertEqual(driver.read(1, 1), b"", "silence follows")
        driver.write(request(DEVICE_INFORMATION))
        answer = driver.read(16, 5)
        self.assertEqual(answer[:6], b"BR\x06\x00\x04\x00")


if __name__ == "__main__":
    unittest.main()
