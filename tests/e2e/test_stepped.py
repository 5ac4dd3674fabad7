"""A run in lockstep with a simulator: the same bytes every time, as fast as the machine allows, and nothing that a
simulator says or leaves out breaks it."""

import contextlib
import hashlib
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, ROOT, Emulator

import ping360_host
from stepper import Circle, Refused, Stepper, UdpStepper

SCENARIO = """
scene: {scenes}/tank.glb
seed: 3
water: {temperature: 15, salinity: 0, ph: 7}
vehicle: {pose: {position: [0, 0, -2]}%(vehicle)s}
clock: {mode: stepped%(clock)s}
devices: [%(devices)s]
"""
SOUNDER = "{name: sounder, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ['udp://127.0.0.1:%d']}"
MULTIBEAM = (
    "{name: multibeam, model: r2sonic-2024, mount: {rpy_deg: [0, 60, 0]}, options: {ping_rate: 7, range: 12}, "
    "endpoints: ['udp-listen://127.0.0.1:%d', 'udp://127.0.0.1:%d', 'udp-listen://127.0.0.1:%d']}"
)
SCANNER = "{name: scanner, model: ping360, endpoints: ['pty:{folder}/line']}"
HOST_PORTS = 8  # a multibeam sends to so many from its base


class Datagrams:
    """Everything that a device sends to some neighbouring ports."""

    def __init__(self, at_end, ports=1):
        self.port, self.sockets, self.heard, self.total = free_port(ports), [], [], 0
        for i in range(ports):
            s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            at_end(s.close)
            s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
            s.bind(("127.0.0.1", self.port + i))
            s.setblocking(False)
            self.sockets.append(s)

    def take(self):
        for i, s in enumerate(self.sockets):
            try:
                while True:
                    data = s.recv(65536)
                    self.total += len(data)
                    self.heard.append(struct.pack("<BI", i, len(data)) + data)
            except BlockingIOError:
                pass


class ScanningHost:
    """Asks a Ping360 on a serial line for one angle after the other, each when the one before is there."""

    def __init__(self, at_end, path):
        self.line = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        at_end(os.close, self.line)
        self.heard, self.total, self.waiting, self.pings = [], 0, b"", []
        self.ask()

    def ask(self):
        settings = (1, 0, 7 * len(self.pings) % 400, 11, 88, 750, 300, 1, 0)
        os.write(self.line, ping360_host.frame(ping360_host.TRANSDUCER, struct.pack("<BBHHHHHBB", *settings)))

    def take(self):
        try:
            while True:
                data = os.read(self.line, 4096)
                self.total += len(data)
                self.heard.append(data)
                self.waiting += data
        except BlockingIOError:
            pass
        if len(self.waiting) >= 10 and len(self.waiting) >= 10 + struct.unpack_from("<H", self.waiting, 2)[0]:
            self.pings.append(ping360_host.ping_of(ping360_host.parse(self.waiting)))
            self.waiting = b""
            self.ask()


class SteppedCase(unittest.TestCase):
    def emulator(self, devices, clock="", vehicle="", *arguments, scenario=SCENARIO):
        text = scenario % {"devices": ", ".join(devices), "clock": clock, "vehicle": vehicle}
        emulator = Emulator(text, *arguments)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def simulator(self, port, kind=Stepper):
        simulator = kind(port)
        self.addCleanup(simulator.close)
        return simulator

    def sounder_run(self, *arguments):
        """A run with one echosounder: (emulator, port of the steps, what it says)."""
        said, port = Datagrams(self.addCleanup), free_port()
        emulator = self.emulator([SOUNDER % said.port], ", input: 'tcp-listen://127.0.0.1:%d'" % port, "", *arguments)
        return emulator, port, said


class SameBytes(SteppedCase):
    def circle(self, seconds, interval=0.1, scenario=SCENARIO):
        """One run of a vehicle on a circle with three sonars: (hash of all bytes, pings of the scanning head)."""
        with contextlib.ExitStack() as stack:
            sounder, multibeam = Datagrams(stack.callback), Datagrams(stack.callback, HOST_PORTS)
            head, port = free_port(16), free_port()
            devices = [SOUNDER % sounder.port, MULTIBEAM % (head, multibeam.port, head + 12), SCANNER]
            emulator = self.emulator(devices, ", input: 'tcp-listen://127.0.0.1:%d'" % port, scenario=scenario)
            simulator = stack.enter_context(Stepper(port))
            host = ScanningHost(stack.callback, emulator.folder / "line")
            drivers = {"sounder": sounder, "multibeam": multibeam, "scanner": host}
            self.drive(simulator, Circle(radius=1.5, depth=2, seconds=10), round(seconds / interval) + 1, interval, drivers)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertNotRegex(output, r"[1-9]\d* late")
        digest = hashlib.sha256()
        for name, driver in drivers.items():
            self.assertGreater(driver.total, 0, name)
            digest.update(name.encode() + b"".join(driver.heard))
        return digest.hexdigest(), host.pings

    def drive(self, simulator, vehicle, steps, interval, drivers):
        for n in range(steps):
            answer = simulator.step(n * interval, **vehicle.pose(n * interval))
            self.assertEqual((answer["now"], answer["ack"]), (n * interval, n + 1))
            for name, driver in drivers.items():  # what the answer says is there, nobody needs to wait for it
                driver.take()
                self.assertEqual(driver.total, answer["sent"][name], f"{name} at {n * interval}")

    def test_twenty_runs_give_one_hash_whatever_else_the_machine_does(self):
        hashes = []
        self.addCleanup(os.environ.pop, "LP_NUM_THREADS", None)
        for run in range(20):
            os.environ["LP_NUM_THREADS"] = str((2, 0, 1, 4)[run % 4])
            if run == 10:
                self.load_both_cores()
            digest, pings = self.circle(2)
            hashes.append(digest)
        self.assertGreater(len(pings), 3)
        self.assertEqual(len(set(hashes)), 1, hashes)

    def load_both_cores(self):
        for _ in range(2):
            busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            self.addCleanup(busy.wait)
            self.addCleanup(busy.kill)

    def test_another_seed_gives_other_bytes(self):
        self.assertNotEqual(self.circle(0.6)[0], self.circle(0.6, scenario=SCENARIO.replace("seed: 3", "seed: 4"))[0])


class Speed(SteppedCase):
    def test_a_minute_goes_as_fast_as_the_machine_allows(self):
        emulator, port, said = self.sounder_run()
        simulator = self.simulator(port)
        start = time.monotonic()
        for n in range(601):
            simulator.step(n / 10, position=[0, 0, -2])
            said.take()
        seconds = time.monotonic() - start
        print(f"stepped: 60 s of the run in {seconds:.2f} s, {60 / seconds:.0f} times as fast as real")
        self.assertGreaterEqual(len(said.heard), 59)
        self.assertLess(seconds, 30)
        self.assertRegex(emulator.stop()[1], r"clock +601 steps to 60 s of the run, 0 refused")

    def test_a_scaled_clock_still_keeps_its_pace(self):
        said = Datagrams(self.addCleanup)
        scenario = (SCENARIO % {"devices": SOUNDER % said.port, "clock": ", rate: 5", "vehicle": ""}).replace(
            "stepped", "scaled")
        with Emulator(scenario) as emulator:
            said.sockets[0].setblocking(True)
            said.sockets[0].settimeout(30)
            said.sockets[0].recv(4096)
            start = time.monotonic()
            for _ in range(20):
                said.sockets[0].recv(4096)
            seconds = time.monotonic() - start
            self.assertIn("5 s of the run in one real second", emulator.output)
        self.assertGreater(seconds, 0.5 * 20 / 5 / 3)  # at most three sentences a second of the run
        self.assertLess(seconds, 3 * 20 / 5)


class Lockstep(SteppedCase):
    def test_nothing_happens_without_a_step_and_time_waits_for_one(self):
        emulator, port, said = self.sounder_run()
        self.assertIn("clock           stepped", emulator.output)
        simulator = self.simulator(port)
        self.assertEqual(simulator.step(0)["sent"], {"sounder": 0})
        simulator.step(5)
        said.take()
        count = len(said.heard)
        self.assertGreater(count, 0)
        self.assertEqual(simulator.step(5)["ack"], 2)  # again: no effect
        said.take()
        self.assertEqual(len(said.heard), count)
        simulator.step(10)
        said.take()
        self.assertEqual(len(said.heard), 2 * count)

    def test_a_burst_is_served_in_turn_and_bad_lines_are_answered(self):
        emulator, port, _ = self.sounder_run()
        simulator = self.simulator(port)
        simulator.socket.sendall(b"".join(json.dumps({"now": n}).encode() + b"\n" for n in range(1, 6)))
        self.assertEqual([simulator.answer()["now"] for _ in range(5)], [1, 2, 3, 4, 5])
        bad = [b'{"now": 4}', b'{"now": 1e9}', b'{"now": 1e999}', b'{"now": "6"}', b'{"now": 6, "position": [1]}',
               b'{"now": NaN}', b"\xff\xfe{", b"[" * 60000, b'{"position": [1, 2, "x"]}', b"{}"]
        for line in bad:
            simulator.socket.sendall(line + b"\n")
            with self.assertRaises(Refused):
                simulator.answer()
        self.assertEqual(simulator.step(6)["ack"], 6)
        self.assertRegex(emulator.stop()[1], r"clock +6 steps to 6 s of the run, 10 refused \(the last: [^)]+\)")

    def test_a_simulator_that_goes_away_is_waited_for(self):
        emulator, port, said = self.sounder_run()
        with Stepper(port) as simulator:
            simulator.step(1)
            simulator.send(now=2)  # and is gone before the answer
        simulator = self.next_simulator(port)
        with self.assertRaisesRegex(Refused, "before"):
            simulator.step(0.5)
        self.assertEqual(simulator.step(3)["ack"], 3)
        simulator.close()
        emulator.process.send_signal(signal.SIGINT)
        self.assertEqual(emulator.stop()[0], 0)

    def next_simulator(self, port):
        """A port serves one at a time, and turns others away until it has seen the one before leave."""
        for _ in range(1000):
            simulator = self.simulator(port)
            try:
                simulator.step(2)
                return simulator
            except (ConnectionError, EOFError):
                continue
        raise AssertionError("never let in")

    def test_ctrl_c_ends_a_long_step(self):
        emulator, port, _ = self.sounder_run()
        self.simulator(port).send(now=14000)
        self.assertEqual(emulator.stop()[0], 0)

    def test_the_duration_is_that_of_the_run(self):
        emulator, port, _ = self.sounder_run("--duration", "2.5")
        simulator = self.simulator(port)
        self.assertNotIn("end", simulator.step(2))
        self.assertTrue(simulator.step(4)["end"])
        emulator.process.wait(20)
        self.assertRegex(emulator.stop()[1], r"clock +2 steps to 2.5 s of the run")

    def test_datagrams_whose_answer_was_lost(self):
        said, port = Datagrams(self.addCleanup), free_port(8)
        self.emulator([SOUNDER % said.port], "", ", input: 'udp-listen://127.0.0.1:%d'" % port)
        simulator = self.simulator(port, UdpStepper)
        for _ in range(3):
            self.assertEqual(simulator.step(1.5, position=[0, 0, -2])["ack"], 1)
        simulator.socket.send(b'{"now": 2}\n{"now": 3}\n')  # two in one datagram
        self.assertEqual([simulator.answer()["now"] for _ in range(2)], [2, 3])
        with self.assertRaisesRegex(Refused, "before"):
            simulator.step(1)

    def test_a_clock_that_is_not_stepped_says_so(self):
        said, port = Datagrams(self.addCleanup), free_port()
        scenario = (SCENARIO % {"devices": SOUNDER % said.port, "clock": "",
                                "vehicle": ", input: 'tcp-listen://127.0.0.1:%d'" % port}).replace("stepped", "real")
        with Emulator(scenario):
            with self.assertRaisesRegex(Refused, "not stepped"):
                self.simulator(port).step(1)

    def test_recordings_tell_the_time_of_the_run(self):
        recordings = []
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.pcapng", "b.pcapng"):
                emulator, port, _ = self.sounder_run("--record", f"{folder}/{name}")
                self.simulator(port).step(3)
                self.assertEqual(emulator.stop()[0], 0)
                recordings.append(Path(folder, name).read_bytes())
        stamps = [self.stamps(recording) for recording in recordings]
        self.assertEqual(stamps[0], stamps[1])
        self.assertGreater(len(stamps[0]), 2)
        start = 1767225600  # 2026-01-01T00:00:00Z
        self.assertTrue(all(0 <= stamp - start * 10**9 <= 3 * 10**9 for stamp in stamps[0]), stamps[0])

    def stamps(self, pcapng):
        """Times of the enhanced packet blocks, ns."""
        found, at = [], 0
        while at < len(pcapng):
            kind, length = struct.unpack_from("<II", pcapng, at)
            if kind == 6:
                high, low = struct.unpack_from("<II", pcapng, at + 12)
                found.append(high << 32 | low)
            at += length
        return found


class Documentation(SteppedCase):
    def test_the_simulator_of_the_readme_runs(self):
        readme = (ROOT / "emulator" / "scenario" / "README.md").read_text()
        code = re.search(r"```python\n(.*?now.*?)```", readme, re.S)[1]
        port = free_port()
        self.assertIn("9501", code)
        code = code.replace("9501", str(port))
        arguments = ["--set", f"clock.input=tcp-listen://127.0.0.1:{port}",
                     "--set", f"devices.sounder.endpoints=['udp://127.0.0.1:{Datagrams(self.addCleanup).port}']",
                     "--set", f"devices.scanner.endpoints=['udp-listen://127.0.0.1:{free_port(8)}']"]
        run = subprocess.Popen([PROGRAM, "run", str(ROOT / "config" / "stepped.yaml"), *arguments],
                               stdout=subprocess.PIPE, text=True)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.kill)
        while "Ctrl-C" not in run.stdout.readline():
            pass
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'ack': 100", done.stdout)
        run.send_signal(signal.SIGINT)
        self.assertRegex(run.communicate(timeout=20)[0], r"clock +100 steps to 9.9 s")


if __name__ == "__main__":
    unittest.main()
