#!/usr/bin/env python3
"""A controller of a Sound Metrics ARIS: finds it by its beacon, connects, sets it and puts its frames together.

    aris_host.py [--model 0] [--frames 20]
"""

import argparse
import select
import socket
import time

import aris_wire as wire

EXAMPLES = {  # of the specification notes, by system type
    0: {"mode": 3, "rate": 15.0, "samples": 1014, "delay": 2028, "cycle": 10500, "period": 8, "pulse": 11, "gain": 18.0},
    1: {"mode": 9, "rate": 15.0, "samples": 946, "delay": 2028, "cycle": 7118, "period": 5, "pulse": 10, "gain": 12.0},
    2: {"mode": 1, "rate": 10.0, "samples": 1082, "delay": 5408, "cycle": 32818, "period": 25, "pulse": 24, "gain": 20.0},
}


class Host:
    """One controller; `faults` collects what no sonar should do."""

    def __init__(self, beacon_port=56124, command_port=56888):
        self.command_port, self.cookie, self.assembler = command_port, 0, wire.Assembler()
        self.beacons = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.beacons.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.beacons.bind(("", beacon_port))
        self.frames = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.frames.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.frames.bind(("127.0.0.1", 0))
        self.stream, self.address, self.last_ping = None, None, 0.0

    def close(self):
        for s in (self.beacons, self.frames, self.stream):
            if s:
                s.close()

    @property
    def faults(self):
        return self.assembler.faults

    def wait_beacon(self, seconds=10, wanted=lambda beacon: True):
        end = time.monotonic() + seconds
        while select.select([self.beacons], [], [], max(0, end - time.monotonic()))[0]:
            data, (address, _) = self.beacons.recvfrom(2048)
            beacon = wire.beacon(data)
            if wanted(beacon):
                self.address = address
                return beacon
        raise TimeoutError("no such beacon")

    def connect(self):
        self.stream = socket.create_connection((self.address, self.command_port), timeout=5)

    def say(self, kind, number, *values):
        self.stream.sendall(wire.command(kind, number, wire.message(*values)))

    def start(self, salinity=35):
        """The usual order up to the acoustics."""
        self.say(wire.SET_RECEIVER, 3, self.frames.getsockname()[1])
        self.say(wire.SET_DATETIME, 2, time.strftime("%Y-%b-%d %H:%M:%S", time.gmtime()))
        self.say(wire.SET_SALINITY, 6, salinity)
        self.say(wire.SET_FOCUS, 8, None, 5.0)

    def acoustics(self, mode, rate, samples, delay, cycle, period, pulse, gain, transmit=True, high=True, power=True):
        """The cookie, which the header of the first frame with these settings has."""
        self.cookie += 1
        values = (self.cookie, rate, samples, delay, cycle, period, pulse, mode, transmit, int(high), power, gain)
        self.say(wire.SET_ACOUSTICS, 5, *values)
        return self.cookie

    def frame(self, seconds=10, wanted=lambda frame: True):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if time.monotonic() - self.last_ping > 1:
                self.say(wire.PING, 16)
                self.last_ping = time.monotonic()
            if not select.select([self.frames], [], [], 0.2)[0]:
                continue
            data, (address, _) = self.frames.recvfrom(65536)
            if address != self.address:
                self.faults.append(f"a part comes from {address}")
            frame = self.assembler.take(data)
            if frame and wanted(frame):
                return frame
        raise TimeoutError("no such frame")

    def next_with(self, cookie, seconds=10):
        return self.frame(seconds, lambda frame: frame.cookie == cookie)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--model", type=int, default=0, help="system type: 0 ARIS 1800, 1 ARIS 3000, 2 ARIS 1200")
    parser.add_argument("--frames", type=int, default=20)
    args = parser.parse_args()
    host = Host()
    print(host.wait_beacon(10, lambda beacon: beacon["type"] == args.model), "from", host.address)
    host.connect()
    host.start()
    cookie = host.acoustics(**EXAMPLES[args.model])
    for _ in range(args.frames):
        frame = host.next_with(cookie)
        print(frame.number, frame.beams, frame.samples, frame.header["sound_speed"], max(frame.image))
    print("faults:", host.faults)


if __name__ == "__main__":
    main()
