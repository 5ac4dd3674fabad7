"""A sonar that loses its power: what the drivers of a Micron, a Ping360 and a multibeam see. Nothing is said while it is
off; then it starts as it came from its maker, and owes no answer to what it was asked before."""

import json
import os
import select
import socket
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import ping360_host
import r2sonic_host
import seanet_wire
from test_control import Client
from test_faults import Pty

SCENARIO = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
control: unix:{folder}/control
devices:
  - {name: sonar, %s}
%s
"""
MICRON = "model: tritech-micron, endpoints: ['%s'], options: {first_alive: 0.5, recentring_alives: 1}"
MULTIBEAM = (
    "model: r2sonic-2024, mount: {rpy_deg: [0, 90, 0]}, options: {ping_rate: 5, range: 10}, "
    "endpoints: ['udp-listen://127.0.0.1:%d', 'udp://127.0.0.1:%d', 'udp-listen://127.0.0.1:%d']"
)
OFF = 1.5  # s without power
SLACK = 1  # s, of a busy machine


class Case(unittest.TestCase):
    def start(self, device, faults=""):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-reboot-")
        self.addCleanup(folder.cleanup)
        self.labels = Path(folder.name) / "labels.jsonl"
        emulator = Emulator(SCENARIO % (device, faults), "--labels", self.labels)
        self.addCleanup(emulator.__exit__, None, None, None)
        self.emulator = emulator.__enter__()
        self.control = Client(emulator.folder / "control")
        self.addCleanup(self.control.close)

    def pull_power(self):
        """Returns when it is off."""
        self.asked_at = time.monotonic()
        answer = self.control.ask({"fault": {"device": "sonar", "kind": "reboot", "off": OFF}})
        self.assertTrue(answer["ok"], answer)
        self.control.ask({"status": True})  # behind whatever the fault has begun
        self.off_at = time.monotonic()

    def assert_was_off(self, first_word_after):
        """`first_word_after`: s that the sonar needs from its power to its first word."""
        now = time.monotonic()
        self.assertGreater(now - self.asked_at, OFF + first_word_after)
        self.assertLess(now - self.off_at, OFF + first_word_after + SLACK)

    def check_label(self):
        status, output = self.emulator.stop()
        self.assertEqual(status, 0, output)
        lines = [json.loads(line) for line in self.labels.read_text().splitlines()[1:]]
        self.assertEqual([(e["device"], e["kind"]) for e in lines if e["kind"] == "reboot"], [("sonar", "reboot")])


class Head:
    """A driver of the Micron; `read(seconds)` gives bytes, b"" when none come."""

    def __init__(self, read, write):
        self.read, self.write, self.framer = read, write, seanet_wire.Framer()

    def wait(self, message, where=lambda frame: True, seconds=20):
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            while frame := self.framer.next():
                if frame.message == message and where(frame):
                    return frame
            self.framer.feed(self.read(left))
        raise AssertionError(f"no {seanet_wire.NAMES[message]} in {seconds} s")

    def alive(self, *flags):
        return seanet_wire.read_alive(self.wait(seanet_wire.ALIVE, lambda f: seanet_wire.read_alive(f).has(*flags)))

    def scan(self, lines):
        """Configures a head that is centred, and reads so many lines."""
        self.alive(seanet_wire.CENTRED)
        self.write(seanet_wire.HeadCommand(bins=150).encode())
        self.alive(seanet_wire.SENT_CFG)
        for _ in range(lines):
            self.write(seanet_wire.send_data())
            line = seanet_wire.read_head_data(self.wait(seanet_wire.HEAD_DATA))
        return line


def reader_of(line):
    def read(seconds):
        return os.read(line, 4096) if select.select([line], [], [], max(0, seconds))[0] else b""

    return read


class Micron(Case):
    def test_is_silent_and_starts_with_its_first_alive_and_no_parameters(self):
        self.start(MICRON % "pty:{folder}/line", "faults: [{device: sonar, kind: latency, delay: 0.3}]")
        driver = Pty(self.emulator.folder / "line")
        self.addCleanup(driver.close)
        head = Head(reader_of(driver.line), driver.write)
        before = head.scan(5)
        driver.write(seanet_wire.send_data())  # its answer is on the way when the power goes
        self.pull_power()
        driver.read(4096, 0.05)
        self.assertEqual(driver.read(1, OFF - 0.2), b"", "without power nothing is said, and no old answer comes")
        driver.write(seanet_wire.send_data())  # nobody hears it
        frame = seanet_wire.read_alive(head.wait(seanet_wire.ALIVE))
        self.assert_was_off(first_word_after=0.5 + 0.3)
        self.assertTrue(frame.has(seanet_wire.NO_PARAMS), "what it was told is forgotten")
        self.assertTrue(frame.lacks(seanet_wire.SENT_CFG, seanet_wire.CENTRED))
        self.assertLess(frame.head_ms, 1000, "its clock starts anew")
        self.assertEqual(head.framer.skipped, 0)
        after = head.scan(1)
        self.assertNotEqual(after.bearing, before.bearing, "the head has been re-centred")
        self.check_label()

    def test_takes_no_connection_while_it_is_off_and_resets_the_old_one(self):
        port = free_port()
        self.start(MICRON % f"tcp-listen://127.0.0.1:{port}")
        with socket.create_connection(("127.0.0.1", port), timeout=20) as old:
            Head(lambda _: old.recv(4096), old.sendall).scan(2)
            self.pull_power()
            with self.assertRaises(ConnectionRefusedError):
                socket.create_connection(("127.0.0.1", port), timeout=20)
            with self.assertRaises(ConnectionResetError):
                while old.recv(4096):
                    pass
            self.assert_was_off(first_word_after=0)
        with socket.create_connection(("127.0.0.1", port), timeout=20) as driver:
            head = Head(lambda _: driver.recv(4096), driver.sendall)
            self.assertTrue(seanet_wire.read_alive(head.wait(seanet_wire.ALIVE)).has(seanet_wire.NO_PARAMS))
            head.scan(1)
        self.check_label()


class Ping360(Case):
    def test_forgets_that_it_was_scanning(self):
        port = free_port()
        self.start(f"model: ping360, endpoints: ['udp-listen://127.0.0.1:{port}']")
        with ping360_host.Host("127.0.0.1", port) as host:
            host.scan(ping360_host.Settings(samples=200), 100, 300)
            self.assertEqual(len(host.pings(5, 20)), 5)
            self.pull_power()
            host.silence(0.1)
            self.assertIsNone(host.hear(self.off_at + OFF - 0.3 - time.monotonic()))
            self.assertIsNone(host.ask(ping360_host.DEVICE_INFORMATION, 0.1), "nobody there")
            while host.ask(ping360_host.DEVICE_INFORMATION, 0.1) is None:
                self.assertLess(time.monotonic() - self.off_at, 20)
            self.assert_was_off(first_word_after=0)
            self.assertEqual(host.silence(1), [], "it does not go on scanning")
        self.check_label()


class Multibeam(Case):
    def test_announces_itself_again_and_has_its_first_settings(self):
        gui = free_port(16)
        host = r2sonic_host.Host(("127.0.0.1", gui))
        self.addCleanup(host.close)
        base = free_port(32)
        self.start(MULTIBEAM % (base, gui, base + 16))
        host.head = ("127.0.0.1", base)
        self.events = []
        self.until(host, lambda e: e["event"] == "R2DS")
        host.send_commands({"RNG0": 16.0})
        told = self.until(host, lambda e: self.has_range(e, 16))["ping"]
        for _ in range(5):
            told = self.until(host, lambda e: self.has_range(e, 16))["ping"]
        self.pull_power()
        while host.poll(0.1):  # what the kernel holds
            pass
        self.assertEqual(host.poll(self.off_at + OFF - 0.2 - time.monotonic()), [], "nothing of it, no status either")
        self.events = []
        ping = self.until(host, lambda e: e["event"] == "ping")["ping"]
        self.assertAlmostEqual(ping.header["range"], 10, places=3)
        self.assertLess(ping.header["ping"], told.header["ping"], "it counts anew")
        self.assertLess(time.monotonic() - self.off_at, OFF + 1 + SLACK)
        self.until(host, lambda e: e["event"] == "R2DS")
        faults = [fault for e in self.events for fault in e["faults"]]
        self.assertEqual(len(faults), 1, faults)
        self.assertRegex(faults[0], "ping 1 after ", "a host that counts pings notices")
        self.check_label()

    def test_loses_its_power_again_and_again_while_it_hears(self):
        """Its echograms are large enough to be heard on a thread of their own."""
        gui = free_port(16)
        host = r2sonic_host.Host(("127.0.0.1", gui))
        self.addCleanup(host.close)
        base = free_port(32)
        self.start((MULTIBEAM % (base, gui, base + 16)).replace("ping_rate: 5", "ping_rate: 25"),
                   "faults: [{device: sonar, kind: reboot, at: 0.5, every: 0.13}, {device: sonar, kind: frozen_image}]")
        self.events, pings = [], 0
        end = time.monotonic() + 6
        while time.monotonic() < end:
            pings += sum(e["event"] == "ping" for e in host.poll(0.1))
            self.assertTrue(self.control.ask({"status": True})["ok"])
        self.assertGreater(pings, 10)
        status, output = self.emulator.stop()
        self.assertEqual(status, 0, output)
        reboots = [line for line in self.labels.read_text().splitlines() if '"reboot"' in line]
        self.assertGreater(len(reboots), 20)

    def has_range(self, event, metres):
        return event["event"] == "ping" and abs(event["ping"].header["range"] - metres) < 1e-3

    def until(self, host, found, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for event in host.poll(end - time.monotonic()):
                self.events.append(event)
                if found(event):
                    return event
        raise AssertionError([e["event"] for e in self.events][-20:])


if __name__ == "__main__":
    unittest.main()
