"""Range Image Protocol packets as a host reads them: frame, Snappy, protobuf. Written from the specification alone."""

import struct
import zlib


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value, at


def unsnappy(block):
    size, at = varint(block, 0)
    out = bytearray()
    while at < len(block):
        tag, at = block[at], at + 1
        if tag & 3 == 0:
            length = tag >> 2
            if length >= 60:
                count = length - 59
                length, at = int.from_bytes(block[at : at + count], "little"), at + count
            out += block[at : at + length + 1]
            at += length + 1
            continue
        if tag & 3 == 1:
            length, offset, at = (tag >> 2 & 7) + 4, tag >> 5 << 8 | block[at], at + 1
        else:
            count = 2 if tag & 3 == 2 else 4
            length, offset, at = (tag >> 2) + 1, int.from_bytes(block[at : at + count], "little"), at + count
        for _ in range(length):
            out.append(out[-offset])
    assert len(out) == size
    return bytes(out)


def fields(data):
    """{number: value} of a protobuf message: numbers, or the bytes of blocks and of 32-bit words."""
    out, at = {}, 0
    while at < len(data):
        key, at = varint(data, at)
        if key & 7 == 0:
            out[key >> 3], at = varint(data, at)
            continue
        if key & 7 == 5:
            size = 4
        else:
            assert key & 7 == 2
            size, at = varint(data, at)
        out[key >> 3], at = data[at : at + size], at + size
    return out


def real(word):
    return struct.unpack("<f", word)[0]


class Image:
    """A RangeImage (`metres`) or BitmapImageGreyscale8 (`strengths`); the other one is None."""

    def __init__(self, packet):
        length, checksum = struct.unpack("<I", packet[4:8])[0], struct.unpack("<I", packet[-4:])[0]
        assert packet[:4] in (b"RIP1", b"RIP2") and length == len(packet) <= 65507
        assert checksum == zlib.crc32(packet[:-4])
        payload = packet[8:-4] if packet[:4] == b"RIP1" else unsnappy(packet[8:-4])
        message = fields(fields(payload)[1])
        self.type = message[1].decode().rsplit(".", 1)[-1]
        f = fields(message[2])
        header = fields(f[1])
        stamp = fields(header[1])
        self.time = stamp[1] + stamp.get(2, 0) * 1e-9
        self.sequence = header.get(2, 0)
        self.sound_speed, self.range, self.frequency = real(f[2]), real(f[3]), f[4]
        is_range = self.type == "RangeImage"
        first = 5 if is_range else 6
        self.width, self.height = f[first], f[first + 1]
        self.fov = real(f[first + 2]), real(f[first + 3])
        self.metres, self.strengths = None, None
        if is_range:
            scale, packed, at, self.metres = real(f[9]), f[10], 0, []
            while at < len(packed):
                count, at = varint(packed, at)
                self.metres.append(count * scale)
        else:
            self.strengths = f[10]

    def at(self, column, row):
        return (self.metres or self.strengths)[row * self.width + column]
