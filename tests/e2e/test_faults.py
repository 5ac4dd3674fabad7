"""Faults on real lines: what the driver's end sees, and that the label file says exactly that."""

import json
import os
import select
import socket
import struct
import subprocess
import tempfile
import termios
import time
import tty
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import blping_host

SOUNDER = """
scene: {scenes}/tank.glb
seed: %d
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: ping1d
    model: ping1d
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s"]
faults:
%s
"""
PROTOCOL_VERSION, GENERAL_REQUEST = 5, 6


def sounder(endpoint, *faults, seed=1):
    return SOUNDER % (seed, endpoint, "".join(f"  - {{device: ping1d, {fault}}}\n" for fault in faults))


def request(number):
    """general_request for message `number`."""
    return blping_host.frame(GENERAL_REQUEST, struct.pack("<H", number))


def labels(file):
    """The first line, and the others."""
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    return lines[0], lines[1:]


class Pty:
    """A driver's end of a pseudo-terminal."""

    def __init__(self, path):
        self.line = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.line, termios.TCSANOW)

    def write(self, data):
        os.write(self.line, data)

    def read(self, count, seconds=20):
        """`count` bytes, or what has come when the time is over."""
        data = b""
        end = time.monotonic() + seconds
        while len(data) < count and select.select([self.line], [], [], max(0, end - time.monotonic()))[0]:
            data += os.read(self.line, count - len(data))
        return data

    def close(self):
        os.close(self.line)


VERSION_REPLY = 4 + 10  # B: protocol_version with its frame


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-faults-")
        self.addCleanup(folder.cleanup)
        self.labels = Path(folder.name) / "labels.jsonl"

    def replies(self, count, *faults, seed=1, quiet=0.5):
        """All bytes that `count` requests for the version bring, one after the other, and the labels."""
        with Emulator(sounder("pty:{folder}/ping1d", *faults, seed=seed), "--labels", self.labels) as emulator:
            driver = Pty(emulator.folder / "ping1d")
            data = b""
            for _ in range(count):
                driver.write(request(PROTOCOL_VERSION))
                data += driver.read(VERSION_REPLY, quiet)
            data += driver.read(1000, quiet)
            driver.close()
            status, self.output = emulator.stop()
        self.assertEqual(status, 0, self.output)
        return data, labels(self.labels)[1]

    def test_flipped_bits_are_where_the_labels_say(self):
        clean, none = self.replies(30)
        self.assertEqual(none, [])
        self.assertEqual(len(clean), 30 * VERSION_REPLY)
        damaged, events = self.replies(30, "kind: bit_flips, rate: 0.005")
        seen = [(i, (a ^ b).bit_length() - 1) for i, (a, b) in enumerate(zip(clean, damaged)) if a != b]
        self.assertGreater(len(seen), 3)
        self.assertEqual([(e["offset"], e["bit"]) for e in events], seen)
        self.assertEqual([e["message"] for e in events], [i // VERSION_REPLY for i, _ in seen])
        self.assertIn(f"on ping1d: {len(seen)} bit_flips", self.output)
        again, same = self.replies(30, "kind: bit_flips, rate: 0.005")
        self.assertEqual(again, damaged)
        when = ("t", "unix", "ping")
        timeless = [{k: v for k, v in e.items() if k not in when} for e in events]
        self.assertEqual([{k: v for k, v in e.items() if k not in when} for e in same], timeless)
        other, _ = self.replies(30, "kind: bit_flips, rate: 0.005", seed=2)
        self.assertNotEqual(other, damaged)

    def test_lost_cut_and_doubled_messages_add_up(self):
        clean = self.replies(1)[0]
        data, events = self.replies(40, "kind: loss, rate: 0.1", "kind: truncation, rate: 0.2", "kind: duplication, rate: 0.2",
                                    quiet=0.2)
        kinds = [e["kind"] for e in events]
        for kind in ("loss", "truncation", "duplication"):
            self.assertIn(kind, kinds)
        expected, position = b"", 0
        of_message = {}
        for e in events:
            of_message.setdefault(e["message"], []).append(e)
        for message in range(40):
            mine = of_message.get(message, [])
            if any(e["kind"] == "loss" for e in mine):
                continue
            copies = 1 + sum(e["kind"] == "duplication" for e in mine)
            cuts = {e["offset"]: e["length"] for e in mine if e["kind"] == "truncation"}
            for _ in range(copies):
                size = next((at - position for at in cuts if position < at < position + VERSION_REPLY), VERSION_REPLY)
                expected += clean[:size]
                position += size
        self.assertEqual(data, expected)

    def test_a_wrong_checksum_is_the_only_wrong_byte(self):
        clean = self.replies(1)[0]
        data, events = self.replies(20, "kind: wrong_checksum, rate: 0.5")
        wrong = [i for i in range(len(data)) if data[i] != clean[i % VERSION_REPLY]]
        self.assertEqual([e["offset"] for e in events], wrong)
        self.assertGreater(len(wrong), 3)
        self.assertTrue(all(i % VERSION_REPLY >= VERSION_REPLY - 2 for i in wrong))

    def test_what_the_driver_says_may_be_lost_too(self):
        data, events = self.replies(2, "kind: loss, rate: 1, direction: from_driver", quiet=0.3)
        self.assertEqual(data, b"")
        self.assertEqual({(e["kind"], e["direction"]) for e in events}, {("loss", "from_driver")})
        self.assertEqual(sum(e["length"] for e in events), 2 * len(request(PROTOCOL_VERSION)))

    def test_the_labels_say_what_they_are(self):
        self.replies(1, "kind: silence")
        head, events = labels(self.labels)
        self.assertEqual((head["format"], head["version"], head["seed"]), ("echoloop fault labels", 1, 1))
        self.assertTrue(head["scenario"].endswith("scenario.yaml"))
        self.assertEqual([(e["kind"], e["device"], e["port"], e["message"], e["offset"], e["length"]) for e in events],
                         [("silence", "ping1d", "line 1", 0, 0, VERSION_REPLY)])
        self.assertAlmostEqual(events[0]["unix"], time.time(), delta=60)

    def test_a_recording_says_which_packets_were_touched(self):
        capture = self.labels.with_name("run.pcapng")
        with Emulator(sounder("pty:{folder}/ping1d", "kind: bit_flips, rate: 0.02"), "--labels", self.labels, "--record",
                      capture) as emulator:
            driver = Pty(emulator.folder / "ping1d")
            for _ in range(20):
                driver.write(request(PROTOCOL_VERSION))
                driver.read(VERSION_REPLY, 0.5)
            driver.close()
            emulator.stop()
        done = subprocess.run(["tshark", "-r", str(capture), "-T", "fields", "-e", "frame.comment", "-Y", "frame.comment"],
                              capture_output=True, text=True, check=True)
        comments = done.stdout.replace("\\n", "\n").split()
        flips = labels(self.labels)[1]
        self.assertGreater(len(flips), 10)
        self.assertEqual(comments.count("bit_flips:"), len(flips))

    def test_late_messages_are_late(self):
        with Emulator(sounder("pty:{folder}/ping1d", "kind: latency, delay: 0.4"), "--labels", self.labels) as emulator:
            driver = Pty(emulator.folder / "ping1d")
            begin = time.monotonic()
            driver.write(request(PROTOCOL_VERSION))
            self.assertEqual(len(driver.read(VERSION_REPLY)), VERSION_REPLY)
            self.assertGreater(time.monotonic() - begin, 0.4)
            driver.close()
            emulator.stop()
        self.assertEqual([e["delay"] for e in labels(self.labels)[1]], [0.4])

    def test_a_pulled_adapter_hangs_up_and_comes_back(self):
        with Emulator(sounder("pty:{folder}/ping1d", "kind: unplug, at: 2, for: 1"), "--labels", self.labels) as emulator:
            link = emulator.folder / "ping1d"
            driver = Pty(link)
            driver.write(request(PROTOCOL_VERSION))
            self.assertEqual(len(driver.read(VERSION_REPLY)), VERSION_REPLY)
            self.assertTrue(select.select([driver.line], [], [], 20)[0])
            try:
                self.assertEqual(os.read(driver.line, 10), b"", "the terminal has hung up")
            except OSError:
                pass
            with self.assertRaises(OSError):
                os.write(driver.line, b"x")
            driver.close()
            self.assertFalse(link.is_symlink())
            end = time.monotonic() + 20
            while not link.is_symlink() and time.monotonic() < end:
                time.sleep(0.01)
            driver = Pty(link)
            driver.write(request(PROTOCOL_VERSION))
            self.assertEqual(len(driver.read(VERSION_REPLY)), VERSION_REPLY)
            driver.close()
            status, output = emulator.stop()
        self.assertEqual(status, 0)
        self.assertIn("on ping1d: 1 unplug", output)
        begin, end = labels(self.labels)[1]
        self.assertEqual((begin["phase"], end["phase"]), ("begin", "end"))
        self.assertAlmostEqual(begin["t"], 2, delta=0.5)
        self.assertAlmostEqual(end["t"] - begin["t"], 1, delta=0.5)


MICRON = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -3]}}
devices:
  - name: head
    model: tritech-micron
    endpoints: ["tcp-listen://127.0.0.1:%d"]
faults:
%s
"""


class Connections(unittest.TestCase):
    def head(self, port, fault):
        return Emulator(MICRON % (port, f"  - {{device: head, {fault}}}\n"))

    def heard(self, driver):
        """mtAlive comes about every second."""
        self.assertTrue(driver.recv(4096).startswith(b"@"))

    def connected(self, port):
        driver = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(driver.close)
        return driver

    def test_a_reset_is_one_and_the_next_driver_is_served(self):
        port = free_port()
        with self.head(port, "kind: reset, at: 2"):
            driver = self.connected(port)
            with self.assertRaises(ConnectionResetError):
                while driver.recv(4096):
                    pass
            self.heard(self.connected(port))

    def test_half_open_is_silence_without_an_end_and_then_a_reset(self):
        port = free_port()
        with self.head(port, "kind: half_open, at: 2, for: 3"):
            driver = self.connected(port)
            self.heard(driver)
            begin = last = time.monotonic()
            with self.assertRaises(ConnectionResetError):
                while driver.recv(4096):
                    last = time.monotonic()
            self.assertGreater(time.monotonic() - last, 2, "nothing came for most of the three seconds")
            self.assertLess(time.monotonic() - begin, 15)
            self.heard(self.connected(port))

    def test_unplugged_tcp_is_closed_and_refused(self):
        port = free_port()
        with self.head(port, "kind: unplug, at: 2, for: 2"):
            driver = self.connected(port)
            while driver.recv(4096):
                pass
            with self.assertRaises(ConnectionRefusedError):
                socket.create_connection(("127.0.0.1", port), timeout=20)
            end = time.monotonic() + 20
            while time.monotonic() < end:
                try:
                    driver = self.connected(port)
                    break
                except ConnectionRefusedError:
                    time.sleep(0.05)
            self.heard(driver)


class Udp(unittest.TestCase):
    def test_unplugged_udp_is_silent(self):
        port = free_port()
        with Emulator(sounder(f"udp-listen://127.0.0.1:{port}", "kind: unplug, at: 0, for: 3"), ) as emulator:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as driver:
                driver.connect(("127.0.0.1", port))
                driver.settimeout(0.2)
                answered = 0
                begin = time.monotonic()
                while answered == 0 and time.monotonic() < begin + 20:
                    driver.send(request(PROTOCOL_VERSION))
                    try:
                        answered = len(driver.recv(4096))
                    except TimeoutError:
                        pass
                self.assertEqual(answered, VERSION_REPLY)
                self.assertGreater(time.monotonic() - begin, 2)
            self.assertEqual(emulator.stop()[0], 0)


if __name__ == "__main__":
    unittest.main()
