"""Faults in lockstep with a simulator: the same bytes, the same ends of connections and the same labels every time,
however fast the machine is; and time goes on while a cable is pulled."""

import contextlib
import errno
import hashlib
import json
import os
import re
import select
import socket
import struct
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import ping360_host
import seanet_wire
from stepper import Circle, Stepper
from test_stepped import SOUNDER, Datagrams

SCENARIO = """
scene: {scenes}/tank.glb
seed: 5
water: {temperature: 15, salinity: 0, ph: 7}
vehicle: {pose: {position: [0, 0, -2]}}
clock: {mode: stepped, input: 'tcp-listen://127.0.0.1:%(steps)d'}
devices:
  - %(sounder)s
  - {name: scanner, model: ping360, endpoints: ['pty:{folder}/line']}
  - {name: head, model: tritech-micron, endpoints: ['tcp-listen://127.0.0.1:%(head)d'],
     options: {first_alive: 0.1, recentring_alives: 0}}
faults:
  - {device: sounder, kind: loss, rate: 0.1}
  - {device: sounder, kind: duplication, rate: 0.1}
  - {device: sounder, kind: wrong_checksum, rate: 0.2}
  - {device: sounder, kind: bit_flips, rate: 0.002}
  - {device: sounder, kind: reordering, rate: 0.1}
  - {device: sounder, kind: jitter, delay: 0.3}
  - {device: sounder, kind: silence, from: 4, until: 5}
  - {device: sounder, kind: unplug, at: 6.05, for: 1}
  - {device: scanner, kind: bit_flips, rate: 1e-4, direction: both}
  - {device: scanner, kind: latency, delay: 0.13, from: 2}
  - {device: scanner, kind: split, rate: 0.5, gap: 0.03}
  - {device: scanner, kind: unplug, at: 3.05, for: 1.1}
  - {device: scanner, kind: stale_burst, from: 5, for: 0.75}
  - {device: scanner, kind: reboot, at: 7.5, off: 0.35}
  - {device: scanner, kind: stuck_motor, from: 9}
  - {device: head, kind: loss, rate: 0.05}
  - {device: head, kind: bandwidth, bits_per_second: 30000}
  - {device: head, kind: reset, at: 2.55}
  - {device: head, kind: half_open, at: 4.05, for: 0.8}
  - {device: head, kind: unplug, at: 6, for: 1.15}
  - {device: head, kind: reboot, at: 9, off: 0.5}
  - {device: head, kind: frozen_image, from: 10}
"""
SECONDS, INTERVAL = 12, 0.1


class Line:
    """A driver's end of the Ping360's pty. It asks for the next angle with every third step, and opens the line anew when
    that has hung up."""

    def __init__(self, path):
        self.path, self.line, self.steps = path, None, 0
        self.heard = []

    def close(self):
        if self.line is not None:
            os.close(self.line)
        self.line = None

    def take(self):
        self.heard.append(b"step")
        if self.line is None:
            if not self.path.is_symlink():
                return self.heard.append(b"no line")
            self.line = os.open(self.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            while data := os.read(self.line, 4096):
                self.heard.append(data)
            raise OSError(errno.EIO, "hung up")
        except BlockingIOError:
            self.ask()
        except OSError:
            self.heard.append(b"hung up")
            self.close()

    def ask(self):
        self.steps += 1
        if self.steps % 3 == 0:
            settings = (1, 0, 7 * self.steps % 400, 11, 88, 750, 200, 1, 0)
            os.write(self.line, ping360_host.frame(ping360_host.TRANSDUCER, struct.pack("<BBHHHHHBB", *settings)))


class Head:
    """A driver of the Micron over TCP: it configures a head that is centred, asks for one line after the other, and
    connects anew when the connection has ended."""

    def __init__(self, port):
        self.port, self.socket, self.heard, self.total = port, None, [], 0

    def close(self):
        if self.socket is not None:
            self.socket.close()
        self.socket = None

    def take(self, sent):
        """`sent`: bytes that the emulator has sent so far, by its answer. A busy kernel brings them a moment later."""
        self.heard.append(b"step")
        if self.socket is None and not self.connect():
            return
        try:
            while self.total < sent or select.select([self.socket], [], [], 0)[0]:
                data = self.socket.recv(65536)
                if not data:
                    self.heard.append(b"end")
                    return self.close()
                self.heard.append(data)
                self.total += len(data)
                self.framer.feed(data)
            self.answer()
        except ConnectionResetError:
            self.heard.append(b"reset")
            self.close()

    def connect(self):
        try:
            self.socket = socket.create_connection(("127.0.0.1", self.port), timeout=20)
        except ConnectionRefusedError:
            self.heard.append(b"refused")
            return False
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # said before the step, not whenever
        self.framer, self.configured = seanet_wire.Framer(), False
        return True

    def answer(self):
        while frame := self.framer.next():
            if frame.message == seanet_wire.ALIVE and seanet_wire.read_alive(frame).has(seanet_wire.NO_PARAMS):
                self.socket.sendall(seanet_wire.HeadCommand().encode())
            if frame.message in (seanet_wire.ALIVE, seanet_wire.HEAD_DATA):
                self.socket.sendall(seanet_wire.send_data())


class Case(unittest.TestCase):
    def run_once(self, seconds=SECONDS, interval=INTERVAL):
        """One run: (what each driver heard between two steps, the lines of the label file)."""
        with contextlib.ExitStack() as stack:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="echoloop-stepped-")))
            said, port, steps = Datagrams(stack.callback), free_port(), free_port()
            text = SCENARIO % {"sounder": SOUNDER % said.port, "head": port, "steps": steps}
            emulator = stack.enter_context(Emulator(text, "--labels", folder / "labels"))
            simulator = stack.enter_context(Stepper(steps, timeout=20))
            line, head = Line(emulator.folder / "line"), Head(port)
            stack.callback(line.close)
            stack.callback(head.close)
            vehicle = Circle(radius=1.5, depth=2, seconds=10)
            for n in range(round(seconds / interval) + 1):
                answer = simulator.step(n * interval, **vehicle.pose(n * interval))
                self.assertEqual(answer["ack"], n + 1)
                said.take()
                self.assertEqual(said.total, answer["sent"]["sounder"])
                said.heard.append(b"step")
                line.take()
                head.take(answer["sent"]["head"])
            status, self.output = emulator.stop()
            labels = (folder / "labels").read_text().splitlines()[1:]
        self.assertEqual(status, 0, self.output)
        return {"sounder": said.heard, "scanner": line.heard, "head": head.heard}, labels


class SameFaults(Case):
    def test_every_run_makes_the_same_of_them(self):
        self.addCleanup(os.environ.pop, "LP_NUM_THREADS", None)
        heard, labels = self.run_once()
        self.check(heard, [json.loads(line) for line in labels])
        for run in range(5):
            os.environ["LP_NUM_THREADS"] = str((2, 0, 1, 4)[run % 4])
            again, labels_again = self.run_once()
            for device, pieces in heard.items():
                self.assertEqual(digests(again[device]), digests(pieces), device)
            self.assertEqual(labels_again, labels)

    def check(self, heard, labels):
        """Everything that was asked for has happened, and was seen at the drivers' ends."""
        asked = re.findall(r"device: (\w+), kind: (\w+)", SCENARIO)
        made = {(event["device"], event["kind"]) for event in labels}
        self.assertEqual(set(asked) - made, set())
        self.assertEqual(heard["scanner"].count(b"hung up"), 1)
        self.assertIn(b"no line", heard["scanner"])
        self.assertEqual(heard["head"].count(b"reset"), 3)  # by the fault, by half_open's end and by the reboot's
        self.assertEqual(heard["head"].count(b"end"), 1)
        self.assertIn(b"refused", heard["head"])


def digests(pieces):
    """Of what was heard in each step, and of the ends of lines."""
    return [hashlib.sha256(step).hexdigest() for step in b"".join(pieces).split(b"step")]


if __name__ == "__main__":
    unittest.main()
