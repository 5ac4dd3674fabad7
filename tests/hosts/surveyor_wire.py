"""Frames of a Cerulean Surveyor 240-16 as Python values; it never opens a socket.

Written from the description of the protocol alone, so that it can disagree with the C++ codecs. All numbers are
little-endian; angles are in rad from straight down, positive to port; times of flight are two-way seconds.
"""

import math
import struct
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Tuple

ACK, NACK, DEVICE_INFORMATION, GENERAL_REQUEST = 1, 2, 4, 6
UTC_REQUEST, UTC_RESPONSE, WATER_STATS, ATTITUDE = 14, 15, 118, 504
YZ_POINTS, ATOF_POINTS, PING_PARAMETERS = 3011, 3012, 3023

PARAMETERS = "<iifhhHB?????iHHf"
DEFAULTS = {
    "start_mm": 0, "end_mm": 15000, "sos_mps": 1500.0, "gain_index": -1, "msec_per_ping": 100, "reserved_1": 0,
    "injected_signal": 0, "ping_enable": True, "enable_channel_data": False, "raw_data": False,
    "enable_yz_point_data": True, "enable_atof_data": True, "target_ping_hz": 240000, "n_range_steps": 400,
    "reserved_2": 0, "pulse_len_steps": 1.5,
}  # fmt: skip


class Frame(NamedTuple):
    id: int
    source: int
    payload: bytes


def frame(message_id, payload=b""):
    """A frame from host 0 to device 0."""
    data = b"BR" + struct.pack("<HHBB", len(payload), message_id, 0, 0) + payload
    return data + struct.pack("<H", sum(data) & 0xFFFF)


def request(message_id):
    return frame(GENERAL_REQUEST, struct.pack("<H", message_id))


def ping_parameters(**changes):
    unknown = changes.keys() - DEFAULTS.keys()
    if unknown:
        raise ValueError(f"no such parameters: {unknown}")
    return frame(PING_PARAMETERS, struct.pack(PARAMETERS, *{**DEFAULTS, **changes}.values()))


def utc_response(utc_msec, accuracy_msec):
    return frame(UTC_RESPONSE, struct.pack("<QI", utc_msec, accuracy_msec))


class Reader:
    """Bytes to frames. A host that is given nothing but frames has no need to resynchronise: noise is a fault."""

    def __init__(self):
        self.pending = b""

    def feed(self, data):
        """The frames that are whole by now; ValueError if the bytes are no frames."""
        self.pending += data
        frames = []
        while len(self.pending) >= 8:
            start, length, message_id, source, _ = struct.unpack_from("<2sHHBB", self.pending)
            if start != b"BR":
                raise ValueError(f"{self.pending[:8].hex()} where a frame should begin")
            if len(self.pending) < length + 10:
                break
            whole, self.pending = self.pending[: length + 10], self.pending[length + 10 :]
            if sum(whole[:-2]) & 0xFFFF != struct.unpack("<H", whole[-2:])[0]:
                raise ValueError(f"checksum of message {message_id}")
            frames.append(Frame(message_id, source, whole[8:-2]))
        return frames


@dataclass
class Ping:
    """The points of one ping as (y, z): m to port and upwards."""

    number: int
    sound_speed: float
    header: Dict[str, float]
    points: List[Tuple[float, float]]


ATOF_HEADER = "pwr_up_msec utc_msec listening sound_speed number hz pulse flags count reserved".split()
YZ_HEADER = ["timestamp", "number", "sound_speed", "up_x", "up_y", "up_z"]


def read_atof(payload):
    header = dict(zip(ATOF_HEADER, struct.unpack_from("<IQffIIfIHH", payload)))
    if len(payload) != 40 + 16 * header["count"]:
        raise ValueError(f"{header['count']} points in {len(payload)} bytes")
    points = []
    for n in range(header["count"]):
        angle, time, _, _ = struct.unpack_from("<ffII", payload, 40 + 16 * n)
        d = header["sound_speed"] * time / 2
        points.append((d * math.sin(angle), -d * math.cos(angle)))
    return Ping(header["number"], header["sound_speed"], header, points)


def read_yz(payload):
    header = dict(zip(YZ_HEADER, struct.unpack_from("<IIffff", payload)))
    names = ["degC", "bar", "heave", "start", "end"]
    header.update(zip(names, struct.unpack_from("<fffff", payload, 76)))
    (count,) = struct.unpack_from("<H", payload, 98)
    if len(payload) != 100 + 8 * count:
        raise ValueError(f"{count} points in {len(payload)} bytes")
    points = [struct.unpack_from("<ff", payload, 100 + 8 * n) for n in range(count)]
    return Ping(header["number"], header["sound_speed"], header, points)


def read_attitude(payload):
    """(roll, pitch) in rad, positive with port and with the bow up, and the times."""
    x, y, z, _, _, _, utc_msec, pwr_up_msec = struct.unpack("<ffffffQI", payload)
    return math.atan2(y, z), math.asin(x), utc_msec, pwr_up_msec


def levelled(point, roll):
    """A point of a rolled head as (to port, upwards) of the level world."""
    y, z = point
    return y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
