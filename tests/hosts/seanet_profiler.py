"""A host of a SeaNet profiler (node 20): builds its commands and reads its passes. It never opens a port.

Written from the protocol's description alone. Angles are in 1/16 gradian (6400 a turn), clockwise, ahead 3200.
"""

import math
import struct
from dataclasses import dataclass
from typing import List, NamedTuple

import seanet_wire as wire

NODE = 20
ALTERNATE, SCAN_RIGHT, CHAN2, FIRST, HAS_MOTOR, MASTER = 0x02, 0x04, 0x80, 0x100, 0x200, 0x2000


@dataclass(frozen=True)
class Command:
    """mtHeadCommand of type 0x1D with a profiler's meanings; `mode` is first, max or normal."""

    left: int = 2400
    right: int = 4000
    step: int = 32
    range: float = 15.0
    nearest: float = 0.3
    mode: str = "max"
    threshold: int = 50
    gain: int = 107
    alternate: bool = True
    motor_time: int = 25

    def scan_time(self):
        """How long a ping listens, in units of 100 us: 13.56 a metre."""
        return int(13.56 * self.range)

    def encode(self):
        control = HAS_MOTOR | MASTER | CHAN2 | (ALTERNATE if self.alternate else 0)
        control |= FIRST if self.mode == "first" else 0
        number = [round(f * 2**32 / 32e6) for f in (600e3, 1200e3, 1055e3, 1655e3)]
        main = struct.pack(
            "<BHB4IHHHH4BHHBB", 0x1D, control, 5, *number, int(25 + 2.5 * self.range), int(10 * self.range),
            self.left, self.right, self.threshold, 20, self.gain, 100, 114, 150, self.motor_time, self.step,
        )
        rest = struct.pack(
            "<4HHBBH", self.scan_time(), 0, 1 if self.mode == "max" else 0, int(1356 * self.nearest), 1600, 1, 0, 0
        )
        block = bytes([self.threshold] * 2 + [1, 20] + [self.gain] * 2 + [100] * 2) + struct.pack("<4H", 110, 150, 0, 0)
        return wire.build(wire.HEAD_COMMAND, main + rest + block, node=NODE)


class Pass(NamedTuple):
    """One reply. `times` in us, in the order of the pings."""

    clockwise: bool
    left: int
    right: int
    step: int
    scan_time: int
    times: List[int]

    def echoes(self, sound_speed=1500.0):
        """(bearing in rad clockwise from ahead, range in m) of each ping; range 0 where nothing was heard."""
        width = (self.right - self.left) % 6400
        for i, time in enumerate(self.times):
            way = min(i * self.step, width)
            units = self.left + way if self.clockwise else self.right - way
            yield (units - 3200) * math.tau / 6400, time * 1e-6 * sound_speed / 2


def send_data():
    return wire.build(wire.SEND_DATA, bytes(4), node=NODE)


def read_pass(frame):
    """The Pass of an mtHeadData of node 20. ValueError where its sizes or nodes disagree."""
    raw = frame.raw
    if (raw[7], raw[8], raw[12]) != (NODE, wire.HOST_NODE, NODE) or frame.message != wire.HEAD_DATA:
        raise ValueError("not a reply of a profiler")
    total, control, count = (struct.unpack_from("<H", raw, at)[0] for at in (13, 18, 38))
    if len(raw) != 2 * count + 51 or len(raw) != total + 14:
        raise ValueError(f"{len(raw)} bytes, total count {total}, {count} times")
    left, right, step, scan_time = struct.unpack_from("<HHBH", raw, 31)
    times = list(struct.unpack_from(f"<{count}H", raw, 40))
    return Pass(bool(control & SCAN_RIGHT), left, right, step, scan_time, times)


class Host:
    """Asks a profiler on a byte line. TimeoutError where it does not answer in time."""

    def __init__(self, line):
        self.line, self.framer = line, wire.Framer()

    def wait(self, message, seconds, where=lambda frame: True):
        end = self.line.now() + seconds
        while (left := end - self.line.now()) > 0:
            frame = self.framer.next()
            if frame is None:
                self.framer.feed(self.line.read(left))
            elif frame.message == message and frame.raw[7] == NODE and where(frame):
                return frame
        raise TimeoutError(f"no {wire.NAMES[message]} within {seconds} s")

    def configure(self, command):
        """Sends the parameters and waits until the head is centred and has them."""
        self.wait(wire.ALIVE, 20, lambda f: wire.read_alive(f).has(wire.CENTRED))
        self.line.write(command.encode())
        self.wait(wire.ALIVE, 5, lambda f: wire.read_alive(f).lacks(wire.NO_PARAMS))

    def scan(self, seconds=20.0):
        """(Pass, s that it took)"""
        begin = self.line.now()
        self.line.write(send_data())
        reply = read_pass(self.wait(wire.HEAD_DATA, seconds))
        return reply, self.line.now() - begin
