"""The wire of a Sound Metrics ARIS, written from the specification notes alone: protobuf by hand, the frame header by
its offsets, the order of samples. Knows no sockets."""

import struct

HEADER_BYTES = 744
BEAMS = {1: 48, 3: 96, 6: 64, 9: 128}
PINGS = {1: 3, 3: 6, 6: 4, 9: 8}
CHANNEL_MAP = (10, 2, 14, 6, 8, 0, 12, 4, 11, 3, 15, 7, 9, 1, 13, 5)
# (beam, degrees): some of the centre angles of the maker's tables; negative is to the right.
ANGLES = {
    48: ((0, -13.57), (12, -7.50), (24, 0.35), (36, 8.09), (47, 13.57)),
    96: ((0, -13.75), (12, -10.97), (24, -7.68), (36, -3.90), (48, 0.17), (60, 4.24), (72, 8.02), (84, 11.31), (95, 13.88)),
    64: ((0, -14.89), (16, -7.37), (32, 0.24), (48, 7.85), (63, 14.89)),
    128: ((0, -15.01), (32, -7.49), (64, 0.12), (96, 7.73), (127, 15.02)),
}
(SET_DATETIME, SET_RECEIVER, SET_STREAM, SET_ACOUSTICS, SET_SALINITY, SET_TELEPHOTO, SET_FOCUS) = range(7)
ATMOSPHERE, METRES_PER_PSI = 14.6959, 0.702398
DENSITY = {0: 1.000, 15: 1.011, 35: 1.027}  # of the maker's table, by salinity at 10 degC
PING = 14
HEADER = {
    "index": (0, "I"), "frame_time": (4, "Q"), "version": (12, "I"), "sonar_time": (20, "Q"), "window_start": (52, "f"),
    "window_length": (56, "f"), "gain": (68, "I"), "focus": (84, "I"), "heading": (160, "f"), "pitch": (164, "f"),
    "roll": (168, "f"), "water_temperature": (224, "f"), "sample_rate": (420, "f"), "accel_x": (424, "f"),
    "accel_y": (428, "f"), "accel_z": (432, "f"),
    "ping_mode": (436, "I"), "frequency": (440, "I"), "pulse": (444, "I"), "cycle": (448, "I"), "period": (452, "I"),
    "transmit": (456, "I"), "frame_rate": (460, "f"), "sound_speed": (464, "f"), "samples": (468, "I"),
    "volts_150": (472, "I"), "delay": (476, "I"), "large_lens": (480, "I"), "system_type": (484, "I"),
    "serial": (488, "I"), "app_version": (508, "I"), "reordered": (516, "I"), "salinity": (520, "I"),
    "pressure": (524, "f"), "focus_moving": (540, "I"), "focus_position": (604, "I"),
    "applied": (680, "I"), "constrained": (684, "I"), "invalid": (688, "I"), "uptime": (700, "I"),
    "go_time": (708, "Q"),
}  # fmt: skip


def varint(value):
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    return bytes(out) + bytes([value])


def field(number, value):
    """One field: int, bool, float, str or bytes."""
    if isinstance(value, float):
        return varint(number << 3 | 5) + struct.pack("<f", value)
    if isinstance(value, int):
        return varint(number << 3) + varint(int(value))
    value = value.encode() if isinstance(value, str) else value
    return varint(number << 3 | 2) + varint(len(value)) + value


def message(*values):
    """Fields 1, 2, ... of these values; None and 0 are absent."""
    return b"".join(field(i + 1, v) for i, v in enumerate(values) if v is not None and v != 0)


def command(kind, part_number, part):
    body = (field(1, kind) if kind else b"") + field(part_number, part)
    return struct.pack(">I", len(body)) + body


def fields(data):
    """{number: [values]} of a protobuf message; ValueError if it is none."""
    out, at = {}, 0

    def number():
        nonlocal at
        value = shift = 0
        while True:
            if at >= len(data) or shift > 63:
                raise ValueError("varint")
            byte = data[at]
            at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    while at < len(data):
        key = number()
        if key & 7 == 0:
            value = number()
        elif key & 7 == 5:
            value = struct.unpack_from("<f", data, at)[0]
            at += 4
        elif key & 7 == 2:
            size = number()
            value = data[at : at + size]
            at += size
            if len(value) != size:
                raise ValueError("cut")
        else:
            raise ValueError("wire type")
        out.setdefault(key >> 3, []).append(value)
    return out


def beacon(data):
    seen = fields(data)
    return {"serial": seen[1][0], "type": seen[2][0], "version": fields(seen[3][0]), "state": seen[4][0]}


def reorder(header, data):
    """Image rows of all beams, from bytes in the sonar's order."""
    beams, pings = BEAMS[header["ping_mode"]], PINGS[header["ping_mode"]]
    if header["reordered"]:
        return data
    image = bytearray(len(data))
    samples = len(data) // beams
    for ping in range(pings):
        for channel in range(16):
            first = ping * samples * 16 + channel
            image[ping + CHANNEL_MAP[channel] * pings :: beams] = data[first : first + samples * 16 : 16]
    return bytes(image)


class Frame:
    """A whole frame: header by name, samples by beam and sample. Bearings are clockwise, as beam 0 is the right-most."""

    def __init__(self, number, header, data):
        self.number = number
        self.header = {name: struct.unpack_from("<" + code, header, at)[0] for name, (at, code) in HEADER.items()}
        self.beams = BEAMS[self.header["ping_mode"]]
        self.samples = len(data) // self.beams
        self.image = reorder(self.header, data)

    @property
    def cookie(self):
        """Of the settings of this frame: taken as they were, or made to fit. One of the two is the later one."""
        return max(self.header["applied"], self.header["constrained"])

    @property
    def depth(self):
        """m, as the maker's hosts reckon it."""
        return (self.header["pressure"] - ATMOSPHERE) * METRES_PER_PSI / DENSITY[self.header["salinity"]]

    def column(self, beam):
        return self.image[beam :: self.beams]

    def metres(self, sample):
        """Of its middle."""
        h = self.header
        return h["sound_speed"] / 2e6 * (h["delay"] + (sample + 0.5) * h["period"])

    def beam(self, clockwise):
        """That looks so many degrees to starboard."""
        table = ANGLES[self.beams]
        for (left, a), (right, b) in zip(table, table[1:]):
            if -clockwise <= b or right == table[-1][0]:
                return min(max(round(left + (-clockwise - a) / (b - a) * (right - left)), 0), self.beams - 1)


class Assembler:
    """Parts to frames as the reference receiver does: in order, from the first on."""

    def __init__(self):
        self.faults, self.number, self.header, self.data, self.total = [], 0, None, b"", 0

    def take(self, datagram):
        """A frame when its last part has come."""
        part = fields(datagram)
        number, offset, data = part[1][0], part.get(5, [0])[0], part[4][0]
        if len(datagram) > 1500:
            self.faults.append("long datagram")
        if offset == 0:
            if len(part[3][0]) != HEADER_BYTES:
                self.faults.append("header")
            self.number, self.header, self.data, self.total = number, part[3][0], b"", part[2][0]
        if self.header is None or number != self.number or offset != len(self.data) or part[2][0] != self.total:
            self.faults.append(f"part at {offset} of frame {number} does not follow")
            self.header = None
            return None
        self.data += data
        if len(self.data) < self.total:
            return None
        frame = Frame(number, self.header, self.data)
        if len(self.data) != frame.beams * frame.header["samples"]:
            self.faults.append("size")
        self.header = None
        return frame
