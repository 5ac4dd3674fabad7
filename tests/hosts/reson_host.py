#!/usr/bin/env python3
"""A host of a Teledyne Reson 7k sonar over TCP or UDP: subscribes, sets, and logs .s7k files.

    reson_host.py 127.0.0.1:7000 --pings 20 --records 7000,7004,7027 --set 1003=30 --log pings.s7k
"""

import argparse
import json
import math
import socket
import struct
import sys
import time

import reson_wire as wire


class Host:
    """One connection. Every wait has a limit: TimeoutError."""

    def __init__(self, address, udp=False, device=7125):
        self.device, self.ticket, self.waiting, self.parts = device, 0, [], []
        self.udp, self.buffer = udp, b""
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM if udp else socket.SOCK_STREAM)
        if udp:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self.socket.connect(address)

    def close(self):
        self.socket.close()

    def say(self, command, parameters=b"", device=None):
        self.ticket += 1
        content = struct.pack("<II", command, self.ticket) + bytes(range(16)) + (parameters or b"\0")
        whole = wire.record(wire.CONTROL, content, self.device if device is None else device)
        self.socket.sendall(wire.packet(whole, self.ticket & 0xFFFF))
        return self.ticket

    def _packet(self, end):
        """The next packet; ValueError if it is none."""
        while True:
            if len(self.buffer) >= 36:
                head = wire.NETWORK.unpack_from(self.buffer)
                if head[:2] != (5, 36) or head[3] != 1 or head[5] > 60000:
                    raise ValueError(f"no network frame: {self.buffer[:36].hex()}")
                if len(self.buffer) >= head[5]:
                    data, self.buffer = self.buffer[36 : head[5]], self.buffer[head[5] :]
                    return head, data
            self.socket.settimeout(max(0.001, end - time.monotonic()))
            piece = self.socket.recv(65536)
            if not piece:
                raise ConnectionError("the sonar has closed the connection")
            self.buffer += piece

    def record(self, seconds=10):
        """The next record in the order of arrival."""
        if self.waiting:
            return self.waiting.pop(0)
        end = time.monotonic() + seconds
        while True:
            head, data = self._packet(end)
            if head[2] == 1:  # maybe an answer between the packets of a longer record
                return wire.Record(data)
            if head[7] == 0:
                self.parts, self.transmission = [], head[4]
            if head[7] != len(self.parts) or head[4] != self.transmission:
                continue  # a datagram was lost
            self.parts.append(data)
            if len(self.parts) == head[2]:
                whole = b"".join(self.parts)
                if len(whole) != head[6]:
                    raise ValueError("the packets are not as long as they say")
                return wire.Record(whole)

    def wait(self, kind, seconds=10, good=lambda record: True):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            record = self.record(end - time.monotonic())
            if record.kind == kind and good(record):
                return record
        raise TimeoutError(f"no record {kind} within {seconds} s")

    def command(self, command, parameters=b"", device=None):
        """0, or the sonar's reason to refuse. Records that come before the answer are kept."""
        ticket, kept = self.say(command, parameters, device), []
        end = time.monotonic() + 10
        while True:
            record = self.record(end - time.monotonic())
            if record.kind in (wire.ACKNOWLEDGE, wire.REFUSED) and record.get("I", 0) == ticket:
                if record.get("16s", 4) != bytes(range(16)):
                    raise ValueError("another tracking number")
                self.waiting += kept
                return 0 if record.kind == wire.ACKNOWLEDGE else record.get("I", 20)
            kept.append(record)

    def subscribe(self, *kinds):
        return self.command(1051, struct.pack(f"<I{len(kinds)}I", len(kinds), *kinds))

    def set(self, command, value):
        return self.command(command, struct.pack("<f", value))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("address", nargs="?", default="127.0.0.1:7000")
    parser.add_argument("--udp", action="store_true")
    parser.add_argument("--pings", type=int, default=10)
    parser.add_argument("--records", default="7000,7004,7027")
    parser.add_argument("--set", action="append", default=[], metavar="COMMAND=VALUE")
    parser.add_argument("--log", metavar="FILE.s7k")
    options = parser.parse_args()
    ip, port = options.address.split(":")
    host = Host((ip, int(port)), options.udp)
    refused = [row for row in options.set if host.set(int(row.split("=")[0]), float(row.split("=")[1]))]
    kinds = [int(kind) for kind in options.records.split(",")]
    log = [host.wait(wire.CONFIGURATION)] if host.command(1050, struct.pack("<I", wire.CONFIGURATION)) == 0 else []
    refused += ["subscription"] if host.subscribe(*kinds) else []
    pings, speed = set(), 1500.0
    while not refused:
        record = host.record()
        if record.kind == wire.SETTINGS:
            speed = record.get("f", 146)
            pings.add(record.ping)
            if len(pings) > options.pings:
                break
        if pings and record.kind in kinds:
            log.append(record)
        if record.kind == wire.DETECTIONS:
            depths = [speed / 2 * t * math.cos(a) for _, t, a, *_ in record.points() if abs(a) < 0.1]
            depth = sum(depths) / len(depths) if depths else None
            print(json.dumps({"ping": record.ping, "points": record.get("I", 14), "depth": depth}))
    if options.log:
        with open(options.log, "wb") as file:
            file.write(wire.file_of(log))
    print(json.dumps({"pings": len(pings), "refused": refused}))
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
