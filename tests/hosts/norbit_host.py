"""A host of a Norbit WBMS, written from the maker's TN-180196 (WBMS DFD External) and the pictures in TN-180197 alone: commands
as text, packets read by their byte offsets. Everything that a packet must be is asserted."""

import socket
import struct
import time
import zlib

HEADER = struct.Struct("<IIIIII")
FORMATS = {0: "B", 1: "b", 2: "H", 3: "h", 4: "I", 5: "i", 6: "Q", 7: "q", 0x15: "f", 0x17: "d"}


class Line:
    """The command port. Like a known driver it sends no line end unless told to, and like another it reads the greeting
    before it says a word."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.buffer = b""
        self.greeting = [self.answer()]
        while not self.greeting[-1].startswith(" Compiled:"):
            self.greeting.append(self.answer())

    def ask(self, command, end="", seconds=10):
        self.socket.sendall((command + end).encode())
        return self.answer(seconds)

    def answer(self, seconds=10):
        limit = time.monotonic() + seconds
        while b"\r\n" not in self.buffer:
            self.socket.settimeout(max(0.01, limit - time.monotonic()))
            piece = self.socket.recv(4096)
            assert piece, "the command port was closed"
            self.buffer += piece
        line, self.buffer = self.buffer.split(b"\r\n", 1)
        return line.decode("ascii")

    def set(self, command):
        """Words of the answer without name and comment. Some answers leave "set_" out."""
        asked = command.split()[0]
        name, *values = self.ask(command).split("#")[0].split()
        assert name in (asked, asked.removeprefix("set_")), name
        return values

    def close(self):
        self.socket.close()


class Stream:
    """A data port."""

    def __init__(self, port, kind):
        self.kind = kind
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)

    def exactly(self, count):
        data = b""
        while len(data) < count:
            piece = self.socket.recv(count - len(data))
            assert piece, "the data port was closed"
            data += piece
        return data

    def packet(self):
        header = self.exactly(24)
        preamble, kind, size, version, reserved, crc = HEADER.unpack(header)
        assert preamble == 0xDEADBEEF and kind == self.kind and version == 4 and reserved == 0, header.hex()
        payload = self.exactly(size - 24)
        assert zlib.crc32(payload) == crc
        return header + payload

    def next(self):
        return (Bathymetry if self.kind == 1 else WaterColumn)(self.packet())

    def first(self, matches, seconds=20):
        """The first packet from now on that `matches`."""
        limit = time.monotonic() + seconds
        while time.monotonic() < limit:
            found = self.next()
            if matches(found):
                return found
        raise AssertionError("no such packet")

    def close(self):
        self.socket.close()


class Bathymetry:
    def __init__(self, data):
        self.c, self.rate, count, self.ping = struct.unpack_from("<ffII", data, 24)
        self.time, self.sent, self.ping_rate, self.type, self.beam_mode, self.mode = struct.unpack_from("<ddfHBB", data, 40)
        self.newer = struct.unpack_from("<fHH", data, 64)
        self.tx_angle, self.gain, self.frequency, self.bandwidth, self.pulse = struct.unpack_from("<5f", data, 72)
        self.raw_c, self.voltage, self.direction, self.opening, self.tilt = struct.unpack_from("<5f", data, 92)
        assert len(data) == 112 + 20 * count and self.type == 4
        self.points = [Point(self, *struct.unpack_from("<IfHHfHBB", data, 112 + 20 * n)) for n in range(count)]

    def good(self):
        return [p for p in self.points if p.quality == 3]


class Point:
    def __init__(self, ping, sample, angle, upper, lower, intensity, flags, quality, snr):
        self.range = sample * ping.c / (2 * ping.rate)
        self.gates = tuple(g * ping.c / (2 * ping.rate) for g in (upper, lower))
        self.sample, self.angle, self.intensity = sample, angle, intensity
        self.flags, self.quality, self.snr = flags, quality, snr


class WaterColumn:
    def __init__(self, data):
        self.c, self.rate, self.beams, self.samples = struct.unpack_from("<ffII", data, 24)
        self.time, self.dtype, self.t0, self.gain = struct.unpack_from("<dIif", data, 40)
        self.direction, self.opening, self.frequency, self.bandwidth, self.pulse = struct.unpack_from("<5f", data, 64)
        (self.amplitude,) = struct.unpack_from("<I", data, 84)
        (self.ping_rate,) = struct.unpack_from("<f", data, 100)
        self.ping, self.sent, self.beamformer = struct.unpack_from("<IdI", data, 108)
        self.vga = struct.unpack_from("<ifif", data, 124)
        self.mode = data[153]
        reserved = data[60:64] + data[88:100] + data[104:108] + data[140:144] + data[154:156] + data[160:192]
        assert not any(reserved)
        form = FORMATS[self.dtype]
        count = self.beams * self.samples
        size = struct.calcsize(form)
        assert len(data) == 192 + count * size + 4 * self.beams and len(data) - 24 <= 1048576
        self.image = struct.unpack_from(f"<{count}{form}", data, 192)
        self.angles = struct.unpack_from(f"<{self.beams}f", data, 192 + count * size)

    def range(self, row):
        return (self.t0 + row) * self.c / (2 * self.rate)

    def column(self, n):
        return self.image[n :: self.beams]

    def brightest(self, n):
        column = self.column(n)
        return self.range(max(range(self.samples), key=column.__getitem__))
