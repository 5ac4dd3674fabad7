#!/usr/bin/env python3
"""A host of a Blueprint Oculus sonar: finds it by its status, connects, fires, and reads its pings.

    tests/hosts/oculus_host.py --pings 20 --mode 1 --range 20 --flags 0x4d --version 2
"""

import argparse
import json
import socket
import time

import oculus_wire as wire


class Host:
    """Every wait has a limit and ends in TimeoutError. `faults` collects what was wrong with what came."""

    def __init__(self, status_port=52102, data_port=52100):
        self.data_port, self.stream, self.buffer, self.faults = data_port, None, b"", []
        self.status, self.last_ping, self.dummies = None, None, 0
        self.udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.udp.bind(("", status_port))

    def close(self):
        for s in (self.udp, self.stream):
            if s is not None:
                s.close()

    def wait_status(self, seconds=5, where=lambda status: True):
        end = time.monotonic() + seconds
        while True:
            self.udp.settimeout(max(0.001, end - time.monotonic()))
            value, faults = wire.read_status(self.udp.recvfrom(2048)[0])
            self.faults += faults
            if value is not None and where(value):
                self.status = value
                return value

    def connect(self):
        """To the address in the status, as known drivers do: the datagram's sender does not count."""
        self.stream = socket.create_connection((self.status["ip"], self.data_port), timeout=5)
        self.buffer, self.last_ping = b"", None

    def fire(self, **settings):
        self.stream.sendall(wire.fire(**settings))

    def message(self, seconds=5):
        """The next message: (header, all its bytes). The stream must stay aligned to messages."""
        end = time.monotonic() + seconds
        header = wire.read_header(self._bytes(16, end))
        if header is None or header["source"] != self.status["id"]:
            raise ValueError(f"no header of this sonar: {self.buffer[:16].hex()}")
        data = self._bytes(16 + header["size"], end)
        self.buffer = self.buffer[len(data) :]
        return header, data

    def _bytes(self, count, end):
        pieces, have = [self.buffer], len(self.buffer)
        while have < count:
            self.stream.settimeout(max(0.001, end - time.monotonic()))
            piece = self.stream.recv(1 << 20)
            if not piece:
                raise ConnectionError("the sonar closed the connection")
            pieces.append(piece)
            have += len(piece)
        self.buffer = b"".join(pieces)
        return self.buffer[:count]

    def ping(self, seconds=5, where=lambda ping: True):
        """The next ping that is like this; its arrival is in `ping.arrived`."""
        end = time.monotonic() + seconds
        while True:
            header, data = self.message(end - time.monotonic())
            if header["id"] == wire.DUMMY:
                self.dummies += 1
            elif header["id"] != wire.RESULT:
                self.faults.append(f"message {header['id']:#x}")
            else:
                ping, faults = wire.read_result(data)
                self.faults += faults
                if ping is None:
                    continue
                ping.arrived = time.monotonic()
                if self.last_ping is not None and ping.ping != self.last_ping.ping + 1:
                    self.faults.append(f"ping {ping.ping} after {self.last_ping.ping}")
                self.last_ping = ping
                if where(ping):
                    return ping

    def dummy(self, seconds=5):
        """The next dummy; pings before it are let through."""
        end = time.monotonic() + seconds
        while self.message(end - time.monotonic())[0]["id"] != wire.DUMMY:
            self.last_ping = None


def main():
    number = lambda text: int(text, 0)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pings", type=int, default=10)
    parser.add_argument("--status-port", type=int, default=52102)
    parser.add_argument("--data-port", type=int, default=52100)
    for name in ("version", "mode", "rate", "speed", "gamma", "flags"):
        parser.add_argument(f"--{name}", type=number)
    for name in ("range", "gain", "sound-speed", "salinity"):
        parser.add_argument(f"--{name}", type=float)
    options = vars(parser.parse_args())
    host = Host(options.pop("status_port"), options.pop("data_port"))
    count = options.pop("pings")
    print(json.dumps({"event": "status", **host.wait_status()}))
    host.connect()
    host.fire(**{name: value for name, value in options.items() if value is not None})
    first = None
    for _ in range(count):
        ping = host.ping(10)
        first = first or ping.arrived
        fields = {k: getattr(ping, k) for k in ("ping", "sound_speed", "resolution", "ranges", "beams", "data_size")}
        print(json.dumps({"event": "ping", "t": round(ping.arrived - first, 4), **fields}))
    print(json.dumps({"event": "end", "faults": host.faults}))
    return 1 if host.faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
