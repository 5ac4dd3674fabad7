"""Talks to a Surveyor 240-16 over TCP or UDP as a host program does; every wait has a limit."""

import select
import socket
import time

import surveyor_wire as wire


class Host:
    """One connection. Questions for the time of day are answered while it waits, unless `utc` is None."""

    def __init__(self, port, datagrams=False, utc=None):
        kind = socket.SOCK_DGRAM if datagrams else socket.SOCK_STREAM
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.connect(("127.0.0.1", port))
        self.datagrams, self.utc = datagrams, utc
        self.reader = wire.Reader()
        self.waiting = []

    def close(self):
        self.socket.close()

    def say(self, data):
        self.socket.sendall(data)

    def set(self, **parameters):
        """Parameters that are acknowledged. The first ping afterwards may have been under way before."""
        self.say(wire.ping_parameters(**parameters))
        self.next(wire.ACK)

    def read(self, seconds):
        if not select.select([self.socket], [], [], max(0, seconds))[0]:
            return
        data = self.socket.recv(65536)
        if not data:
            raise ConnectionError("the device has closed the connection")
        frames = self.reader.feed(data)
        if self.datagrams and (not frames or self.reader.pending):
            raise ValueError("a datagram that is no whole frame")
        for frame in frames:
            if frame.id == wire.UTC_REQUEST and self.utc is not None:
                self.say(wire.utc_response(self.utc, 10))
            self.waiting.append(frame)

    def next(self, *ids, seconds=20):
        """The next frame of one of these ids; what comes before it is dropped. TimeoutError without one."""
        end = time.monotonic() + seconds
        while True:
            while self.waiting:
                frame = self.waiting.pop(0)
                if frame.id in ids:
                    return frame
            if time.monotonic() > end:
                raise TimeoutError(f"no message of {ids} within {seconds} s")
            self.read(end - time.monotonic())

    def atof(self):
        return wire.read_atof(self.next(wire.ATOF_POINTS).payload)

    def first_ping(self, **parameters):
        """The first ping that these parameters have made."""
        self.set(**parameters)
        self.atof()
        return self.atof()

    def pings(self, count):
        return [self.atof() for _ in range(count)]
