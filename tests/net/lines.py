"""A driver's ends of a device's wires. Each writes bytes, and takes what has come as [bytes]: datagrams one by one, all that
has come on a stream as one piece."""

import os
import select
import socket
import time


def socket_of(kind, address):
    s = socket.socket(socket.AF_INET, kind)
    s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    if kind == socket.SOCK_DGRAM:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8 << 20)
        s.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
    s.bind(address)
    return s


class Datagrams:
    """Bound to `port`; sends to `to`, or where None to whoever was heard last."""

    def __init__(self, port, to=None, address="127.0.0.1", to_address="127.0.0.1"):
        self.socket = socket_of(socket.SOCK_DGRAM, (address, port))
        self.socket.setblocking(False)
        self.to = (to_address, to) if to else None
        self.last = None

    def write(self, data):
        to = self.to or self.last
        if to:
            self.socket.sendto(data, to)

    def take(self):
        heard = []
        try:
            while True:
                data, self.last = self.socket.recvfrom(65536)
                heard.append(data)
        except BlockingIOError:
            return heard

    def close(self):
        self.socket.close()


class Tcp:
    """A connection to `port` from a port of its own, made anew by a write when it has ended."""

    def __init__(self, port):
        self.port, self.own, self.socket = port, 30000 + port % 30000, None
        self.heard = b""
        self.connect()

    def connect(self):
        self.own += 1
        try:
            self.socket = socket_of(socket.SOCK_STREAM, ("127.0.0.1", self.own))
            self.socket.connect(("127.0.0.1", self.port))
            self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # said before the step, not whenever
            self.socket.setblocking(False)
        except ConnectionRefusedError:
            self.close()

    def write(self, data):
        if self.socket is None:
            self.connect()
        if self.socket is not None:
            self.socket.setblocking(True)
            self.socket.sendall(data)
            self.socket.setblocking(False)

    def read(self):
        while self.socket is not None:
            try:
                piece = self.socket.recv(1 << 20)
            except BlockingIOError:
                break
            except ConnectionResetError:
                piece = b""
            self.heard += piece
            if not piece:
                self.close()

    def take(self):
        self.read()
        heard, self.heard = self.heard, b""
        return [heard] if heard else []

    def close(self):
        if self.socket is not None:
            self.socket.close()
        self.socket = None


class Pty:
    """The driver's end of a pty; opened anew when it has hung up."""

    def __init__(self, path):
        self.path, self.line = str(path), None
        self.open()

    def open(self):
        if self.line is None and os.path.exists(self.path):
            self.line = os.open(self.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)

    def write(self, data):
        self.open()
        if self.line is not None:
            os.write(self.line, data)

    def take(self):
        heard = b""
        self.open()
        try:
            while self.line is not None and (data := os.read(self.line, 65536)):
                heard += data
        except BlockingIOError:
            pass
        except OSError:
            self.close()
        return [heard] if heard else []

    def close(self):
        if self.line is not None:
            os.close(self.line)
        self.line = None


class Ends:
    """All ends of all devices, {"device/port": line}. `unheard`: bytes of a device that never came, {device: count}."""

    def __init__(self, lines):
        self.lines = lines
        self.total, self.unheard = {}, {}

    def take(self, sent, seconds=2.0):
        """{name: [bytes]} of what has come, when as much is there as was `sent` since the start of the run ({device: bytes});
        a busy kernel brings it a moment later."""
        heard = {name: [] for name in self.lines}
        end = time.monotonic() + seconds
        while True:
            for name, line in self.lines.items():
                pieces = line.take()
                heard[name] += pieces
                device = name.split("/")[0]
                self.total[device] = self.total.get(device, 0) + sum(map(len, pieces))
            missing = {d: n - self.total.get(d, 0) - self.unheard.get(d, 0) for d, n in sent.items()}
            if all(count <= 0 for count in missing.values()):
                return self.joined(heard)
            if time.monotonic() > end:
                self.unheard = {d: self.unheard.get(d, 0) + max(0, n) for d, n in missing.items()}
                return self.joined(heard)
            select.select([], [], [], 0.001)

    def read_until(self, answered, seconds=60.0):
        """Reads streams until the socket has something: the program waits with a message longer than the kernel's buffers for
        somebody who reads, and with its answer for the message."""
        end = time.monotonic() + seconds
        while not select.select([answered], [], [], 0.005)[0] and time.monotonic() < end:
            for line in self.lines.values():
                if isinstance(line, Tcp):
                    line.read()

    def joined(self, heard):
        """Of a stream, the pieces as one."""
        is_one = lambda name: not isinstance(self.lines[name], Datagrams)  # noqa: E731
        return {n: [b"".join(p)] if is_one(n) and p else p for n, p in heard.items()}

    def close(self):
        for line in self.lines.values():
            line.close()
