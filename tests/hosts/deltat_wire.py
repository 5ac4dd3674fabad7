"""83P and EC of an Imagenex Delta T as Python values; it never opens a socket.

Written from the byte tables of the format's description alone, so that it can disagree with the C++ codecs. Everything
is big-endian; angles are in deg from the axis, positive to starboard.
"""

import math
import struct
from dataclasses import dataclass, field
from typing import List, Optional

RANGES = [5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 250, 300]
SECTORS = [30, 60, 90, 120]
BEAMS = [480, 240, 120]
MONTHS = "JAN FEB MAR APR MAY JUN JUL AUG SEP OCT NOV DEC".split()


@dataclass
class Profile:
    number: int
    beams: int
    sector: int
    start: float
    increment: float
    range: int
    frequency: int
    sound_speed: Optional[float]
    resolution: float
    interval: float
    averaged: int
    high_resolution: bool
    pitch: Optional[float]
    roll: Optional[float]
    heading: Optional[float]
    tilt: int
    time: str
    ranges: List[float]  #: m at 1500 m/s, 0 where there is no bottom
    intensities: List[int] = field(default_factory=list)

    def angle(self, beam):
        return self.start + beam * self.increment

    def points(self):
        """(to starboard, down) in m of the beams that have a bottom."""
        out = []
        for beam, r in enumerate(self.ranges):
            if r > 0:
                a = math.radians(self.angle(beam))
                out.append((r * math.sin(a), r * math.cos(a)))
        return out


def u(data, at, count=2):
    return int.from_bytes(data[at : at + count], "big")


def valid(value):
    return value & 0x7FFF if value & 0x8000 else None


def tilt_of(value):
    return None if valid(value) is None else (valid(value) - 900) / 10


def timestamp(data):
    day, month, year = data[8:19].decode().split("-")
    if month not in MONTHS:
        raise ValueError(f"month {month}")
    if data[19] or data[28] or data[32] or data[116]:
        raise ValueError("a text without its end")
    if not data[112:116].decode().startswith(data[29:32].decode()):
        raise ValueError("hundredths and milliseconds disagree")
    return f"{year}-{MONTHS.index(month) + 1:02}-{day}T{data[20:28].decode()}{data[112:116].decode()}"


def read_83p(data):
    """ValueError if the bytes are no 83P of version 1.10."""
    if data[:3] != b"83P" or data[3] != 10:
        raise ValueError(f"starts with {data[:4].hex()}")
    beams, has_intensity = u(data, 70), data[117]
    size = 256 + (4 if has_intensity else 2) * beams
    if not len(data) == u(data, 4) == size:
        raise ValueError(f"{len(data)} bytes, {u(data, 4)} in the header, {size} by the beams")
    if any(data[155:256]) or any(data[97:100]) or any(data[6:8]) or data[87] or data[88]:
        raise ValueError("bytes that should be zero are not")
    resolution = u(data, 85) / 1000
    speed = valid(u(data, 83))
    heading = valid(u(data, 68))
    return Profile(
        number=u(data, 93, 4), beams=beams, sector=u(data, 74), start=u(data, 76) / 100 - 180,
        increment=data[78] / 100, range=u(data, 79), frequency=u(data, 81),
        sound_speed=None if speed is None else speed / 10, resolution=resolution, interval=u(data, 91) / 1000,
        averaged=data[125], high_resolution=bool(data[122]), pitch=tilt_of(u(data, 64)), roll=tilt_of(u(data, 66)),
        heading=None if heading is None else heading / 10, tilt=u(data, 89) - 180, time=timestamp(data),
        ranges=[r * resolution for r in struct.unpack_from(f">{beams}H", data, 256)],
        intensities=list(struct.unpack_from(f">{beams}H", data, 256 + 2 * beams)) if has_intensity else [],
    )  # fmt: skip


def control(range=20, gain=3, sector=120, beam_width=1, beams=240, averaging=1, sound_speed=1500.0, mode=0,
            minimum_range=0, tilt=0, receive_only=0, external=1, roll_compensation=0, little=False):  # fmt: skip
    """An EC; `little`: the sound speed in the order of a PC."""
    data = bytearray(256)
    data[0:2] = b"EC"
    data[3], data[4] = external, receive_only
    data[7], data[8] = RANGES.index(range) + 2, gain
    data[9] = 50
    data[11], data[12], data[13], data[14] = SECTORS.index(sector), beam_width, BEAMS.index(beams), averaging
    data[17:19] = round(sound_speed * 10).to_bytes(2, "little" if little else "big")
    data[19], data[21], data[22], data[25], data[26] = mode, 1, minimum_range, tilt + 180, roll_compensation
    return bytes(data)
