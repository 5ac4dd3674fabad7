#!/usr/bin/env python3
"""An autopilot's rangefinder on a Ping1D, written from the description of ArduPilot's BLPing: it sets the ping interval, starts
the stream of distance_simple and then only listens; it sends no break. Its parser has the quirks that the description names.

    tests/hosts/blping_host.py /tmp/echoloop/ping1d -n 20
    tests/hosts/blping_host.py udp://127.0.0.1:9090 -n 20
"""

import argparse
import json
import socket
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import byte_line

SET_PING_INTERVAL, CONTINUOUS_START, DISTANCE_SIMPLE = 1004, 1400, 1211
KEPT = 20  # payload bytes that the parser keeps; all of them are summed
SILENCE = 1.0  # s without a distance, after which it asks again


def frame(number, payload):
    """From host 0 to device 1."""
    data = b"BR" + struct.pack("<HHBB", len(payload), number, 0, 1) + payload
    return data + struct.pack("<H", sum(data) & 0xFFFF)


class Parser:
    """One byte at a time. `feed` is true while a good message stands: also for a stray byte behind it that is no 'B'."""

    def __init__(self):
        self.number, self.payload, self.good = 0, b"", False
        self._step, self._sum, self._length, self._seen, self._crc = self._start, 0, 0, 0, 0

    def feed(self, byte):
        self._step(byte)
        return self.good

    def _add(self, byte, step):
        self._sum += byte
        self._step = step

    def _start(self, byte):
        if byte == ord("B"):
            self.good, self._sum = False, 0
            self._add(byte, self._second)

    def _second(self, byte):
        self._add(byte, self._length_low) if byte == ord("R") else self._reset()

    def _length_low(self, byte):
        self._length = byte
        self._add(byte, self._length_high)

    def _length_high(self, byte):
        self._length |= byte << 8
        self._add(byte, self._number_low)

    def _number_low(self, byte):
        self.number = byte
        self._add(byte, self._number_high)

    def _number_high(self, byte):
        self.number |= byte << 8
        self._add(byte, self._source)

    def _source(self, byte):
        self._add(byte, self._destination)

    def _destination(self, byte):
        self.payload, self._seen = b"", 0
        self._add(byte, self._content)

    def _content(self, byte):
        """Takes at least one byte: behind an empty payload, half of the checksum, and so the next frame's 'B' is lost."""
        if self._seen < KEPT:
            self.payload += bytes([byte])
        self._seen += 1
        self._add(byte, self._content if self._seen < self._length else self._crc_low)

    def _crc_low(self, byte):
        self._crc, self._step = byte, self._crc_high

    def _crc_high(self, byte):
        self.good = self._crc | byte << 8 == self._sum & 0xFFFF
        self._reset()

    def _reset(self):
        self._step = self._start


class BlPing:
    """The exchange over a ByteLine. Readings are (seconds, metres, percent)."""

    def __init__(self, line, interval_ms=50):
        self.line, self.interval_ms = line, interval_ms
        self.parser, self.starts = Parser(), 0

    def start(self):
        self.starts += 1
        self.line.write(frame(SET_PING_INTERVAL, struct.pack("<H", self.interval_ms)))
        self.line.write(frame(CONTINUOUS_START, struct.pack("<H", DISTANCE_SIMPLE)))

    def readings(self, count, seconds):
        """Up to `count` readings within `seconds`."""
        found, end = [], self.line.now() + seconds
        self.start()
        last = self.line.now()
        while len(found) < count and self.line.now() < end:
            for byte in self.line.read(0.05):
                if self.parser.feed(byte) and self.parser.number == DISTANCE_SIMPLE and len(self.parser.payload) == 5:
                    millimetres, confidence = struct.unpack("<IB", self.parser.payload)
                    last = self.line.now()
                    found.append((last, millimetres / 1000, confidence))
            if self.line.now() - last > SILENCE:
                self.start()
                last = self.line.now()
        return found[:count]


def open_line(uri):
    """As byte_line.open_line, and udp://host:port."""
    if not uri.startswith("udp://"):
        return byte_line.open_line(uri)
    host, _, port = uri[len("udp://") :].rpartition(":")
    connection = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    connection.connect((host, int(port)))
    connection.setblocking(False)
    return byte_line.ByteLine(connection.fileno(), owner=connection)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("line", help="/path, serial:///path:baud, tcp://host:port or udp://host:port")
    parser.add_argument("-n", type=int, default=20, help="readings to wait for")
    parser.add_argument("--seconds", type=float, default=20)
    options = parser.parse_args()
    host = BlPing(open_line(options.line))
    found = host.readings(options.n, options.seconds)
    for _, metres, confidence in found:
        print(json.dumps({"metres": metres, "confidence": confidence}))
    print(json.dumps({"readings": len(found), "starts": host.starts}))
    return 0 if len(found) == options.n else 1


if __name__ == "__main__":
    sys.exit(main())
