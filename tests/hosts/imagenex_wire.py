"""Imagenex 881A, 852 and 831L: commands, replies and files, written from the serial interface specification and apart from
the C++. Checks everything that a reply says of itself."""

import struct
from dataclasses import dataclass

COMMAND_BYTES = 27
OFFSETS = {
    "head_id": 2, "range": 3, "motion": 5, "mode": 6, "gain": 8, "logf": 9, "absorption": 10, "train": 11,
    "sector": 12, "step": 13, "pulse": 14, "least": 15, "trigger": 18, "points": 19, "bits": 20, "baud": 21,
    "profile": 22, "calibrate": 23, "delay": 24, "frequency": 25,
}  # fmt: skip
# Reply letter and bits: echo data bytes
DATA_BYTES = {"M": {4: 128, 8: 252, 16: 500}, "G": {4: 252, 8: 500, 16: 500}, "P": {4: 0, 8: 0, 16: 0}}


def command(**settings):
    """27 bytes; 881A by default: id 10, 10 m, all around, 0.9 deg, 60 us, 500 points, 8 bits, 675 kHz."""
    values = {"head_id": 0x10, "range": 10, "mode": 0x43, "gain": 20, "logf": 1, "absorption": 20, "train": 60,
              "sector": 120, "step": 3, "pulse": 6, "points": 50, "bits": 8, "baud": 6, "frequency": 100}  # fmt: skip
    values.update(settings)
    data = bytearray(COMMAND_BYTES)
    data[0], data[1], data[26] = 0xFE, 0x44, 0xFD
    for name, value in values.items():
        data[OFFSETS[name]] = value
    if 0xFD in data[:26]:
        raise ValueError("253 may stand nowhere in a command but at its end")
    return bytes(data)


def sounder_command(**settings):
    """The same for an 852: id 11, 10 m, 12 dB, 100 us, 500 points."""
    values = {"head_id": 0x11, "gain": 12, "logf": 0, "train": 0, "sector": 0, "step": 0, "pulse": 100, "bits": 0,
              "baud": 0, "frequency": 0}  # fmt: skip
    return command(**{**values, **settings})


def side_scan_command(packet, metres=30, frequency=2):
    """An 872's for port (packet 0) or starboard (2), as DUNE asks: frequency 0 low to 2 high, data gain 40 %, balance gain 30."""
    data = bytearray(COMMAND_BYTES)
    data[0], data[1], data[26] = 0xFE, 0x44, 0xFD
    data[3], data[7], data[8], data[10], data[18] = metres, frequency, 40, 30, packet
    return bytes(data)


PIPE_RANGES = {2: 0.125, 4: 0.25, 6: 0.5, 8: 0.75, 10: 1, 20: 2, 30: 3, 40: 4, 50: 5, 60: 6}  # code: m


def pipe_command(**settings):
    """An 831L's, as a public driver's parameters have it: 1 m, 20 dB, 0.1 dB/m, all around by 0.9 deg, 10 us, 2250 kHz."""
    values = {"head_id": 0, "range": 10, "mode": 0, "logf": 0, "absorption": 10, "train": 120, "pulse": 10, "least": 1,
              "points": 25, "baud": 1}  # fmt: skip
    return command(**{**values, **settings})


@dataclass
class PipeReply:
    status: int
    degrees: float  # of the head
    clockwise: bool
    range: float  # m
    profile: float | None  # m
    roll: float  # deg, and g below
    pitch: float
    roll_g: float
    pitch_g: float
    is_new: bool
    data: bytes


def parse_pipe(data):
    """The reply of an 831L; AssertionError where it contradicts itself."""
    assert data[0:1] == b"I" and data[1:2] in (b"M", b"P") and data[2:4] == b"X\0", data[:12].hex()
    count = number14(data[10], data[11])
    assert count == (250 if data[1:2] == b"M" else 0) and len(data) == 33 + count and data[-1] == 0xFC, "size"
    assert not any(data[12:16]) and not any(data[24:32]), "reserved"

    def signed(at):
        value = (data[at + 1] & 0x3F) << 8 | data[at]
        return value - 0x4000 if value & 0x2000 else value

    position = ((data[6] & 0x3E) >> 1) << 8 | (data[6] & 1) << 7 | (data[5] & 0x7F)
    point = number14(data[8], data[9])
    return PipeReply(data[4], 0.3 * (position - 600), bool(data[6] & 0x40), PIPE_RANGES[data[7]],
                     point * 0.5e-3 if point else None, 0.025 * signed(16), 0.025 * signed(18), 0.24414e-3 * signed(20),
                     0.24414e-3 * signed(22), bool(data[17] & 0x80), data[32:-1])  # fmt: skip


def number14(low, high):
    """In the words of the specification."""
    return ((high & 0x7E) >> 1) << 8 | (high & 0x01) << 7 | (low & 0x7F)


@dataclass
class Reply:
    letter: str
    head_id: int
    status: int
    position: int  # 0.3 deg, 600 is 0 deg
    clockwise: bool
    range: int
    profile: int  # units of the head
    data: bytes

    @property
    def degrees(self):
        return 0.3 * (self.position - 600)


def parse(data, bits=8):
    """The reply that `data` is; AssertionError where it contradicts itself."""
    assert data[0:1] == b"I" and data[2:3] == b"X" and data[1:2] in (b"M", b"G", b"P"), data[:12].hex()
    letter = chr(data[1])
    count = number14(data[10], data[11])
    assert count == DATA_BYTES[letter][bits], f"I{letter}X says {count} bytes"
    assert len(data) == 13 + count and data[-1] == 0xFC, "end"
    assert not any(byte & 0x80 for byte in (data[5], data[6], data[8], data[9], data[10], data[11])), "bit 7"
    position = ((data[6] & 0x3E) >> 1) << 8 | (data[6] & 1) << 7 | (data[5] & 0x7F)
    profile = number14(data[8], data[9])
    return Reply(letter, data[3], data[4], position, bool(data[6] & 0x40), data[7], profile, data[12:-1])


def reply_size(first):
    """Bytes of the reply that begins with these twelve."""
    return 13 + number14(first[10], first[11])


def levels(data, bits):
    """Points, nearest first."""
    if bits == 4:
        return [half for byte in data for half in (byte & 15, byte >> 4)]
    if bits == 16:
        return [low | high << 8 for low, high in zip(data[::2], data[1::2])]
    return list(data)


@dataclass
class Shot:
    """One shot of a .852 or .81A file: some of its header, and its reply."""

    date: str
    time: str
    gain: int
    pulse: int
    sound_speed: float
    reply: bytes
    header: bytes


def read_file(data):
    """The shots of a whole file; AssertionError where sizes, fill or pointers are wrong."""
    shots, at, previous = [], 0, 0
    while at < len(data):
        magic, index, total, size = struct.unpack_from(">3sBHH", data, at)
        assert magic in (b"852", b"81A"), f"no shot at {at}"
        base = {0: 128, 1: 256, 2: 384, 3: 640}[index]
        extended = 128 * data[at + 34] if magic == b"81A" else 0
        assert total == base + extended and at + total <= len(data), "total"
        end = at + total
        if magic == b"81A":
            assert struct.unpack_from(">H", data, end - 2)[0] == total + previous, "pointer back"
            end -= 2
        assert not any(data[at + 100 + size : end - extended]), "fill"
        text = lambda a, n: data[at + a : at + a + n].split(b"\0")[0].decode("ascii")  # noqa: E731
        speed = struct.unpack_from(">H", data, at + 46)[0]
        shots.append(
            Shot(text(8, 12), text(20, 9) + text(29, 4), data[at + 38], data[at + 44],
                 (speed & 0x7FFF) / 10 if speed & 0x8000 else 0.0, data[at + 100 : at + 100 + size],
                 data[at : at + 100])
        )  # fmt: skip
        previous, at = total, at + total
    return shots
