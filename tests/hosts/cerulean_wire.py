"""Messages of an Omniscan 450 and an S500 as Python values; it never opens a socket.

Written from the description of the protocol alone, so that it can disagree with the C++ codecs. Frames are those of
surveyor_wire. Ranges are in m by the speed of sound that the device was told, levels in dB of its full scale.
"""

import struct
from typing import List, NamedTuple

from surveyor_wire import frame

OS_PING_PARAMS, OS_MONO_PROFILE, SPEED_OF_SOUND = 2197, 2198, 1002
S500_PING_PARAMS, DISTANCE2, PROFILE6 = 1015, 1223, 1308

OMNISCAN = {
    "start_mm": 0, "length_mm": 15000, "msec_per_ping": 0, "reserved_1": 0.0, "reserved_2": 0.0,
    "pulse_len_percent": 0.002, "filter_duration_percent": 0.0015, "gain_index": -1, "num_results": 600, "enable": 1,
    "reserved_3": 0, "reserved_4": 0, "reserved_5": 0,
}  # fmt: skip
S500 = {
    "start_mm": 0, "length_mm": 5000, "gain_index": -1, "msec_per_ping": 100, "pulse_len_usec": 0, "report_id": PROFILE6,
    "reserved": 0, "chirp": 0, "decimation": 0,
}  # fmt: skip


def _values(defaults, changes):
    unknown = changes.keys() - defaults.keys()
    if unknown:
        raise ValueError(f"no such parameters: {unknown}")
    return {**defaults, **changes}.values()


def os_ping_params(**changes):
    return frame(OS_PING_PARAMS, struct.pack("<IIIffffhHBBBB", *_values(OMNISCAN, changes)))


def s500_ping_params(**changes):
    return frame(S500_PING_PARAMS, struct.pack("<IIhhHHHBB", *_values(S500, changes)))


def speed_of_sound(metres_per_second):
    return frame(SPEED_OF_SOUND, struct.pack("<I", round(metres_per_second * 1000)))


class Profile(NamedTuple):
    number: int
    start: float
    length: float
    timestamp_ms: int
    gain: int
    analog_gain: float
    pulse: float
    highest: float
    lowest: float
    raw: List[int]

    def levels(self):
        """dB per bin."""
        step = (self.highest - self.lowest) / 65535
        return [self.lowest + value * step for value in self.raw]

    def range_of(self, index):
        """m, the middle of a bin."""
        return self.start + (index + 0.5) * self.length / len(self.raw)

    def edge(self, below, beyond=0.0):
        """m of the first bin no more than `below` dB under the strongest one, both beyond so many m."""
        levels = [(self.range_of(i), level) for i, level in enumerate(self.levels()) if self.range_of(i) >= beyond]
        least = max(level for _, level in levels) - below
        return next(distance for distance, level in levels if level >= least)


def _results(payload, at, count):
    if len(payload) != at + 2 * count:
        raise ValueError(f"{len(payload)} bytes for {count} results")
    return list(struct.unpack_from(f"<{count}H", payload, at))


def read_omniscan(payload):
    number, start, length, timestamp, _, gain, count, _, _, _ = struct.unpack_from("<IIIIIHHHBB", payload)
    pulse, analog, highest, lowest, _, _ = struct.unpack_from("<ffffff", payload, 28)
    raw = _results(payload, 52, count)
    return Profile(number, start / 1e3, length / 1e3, timestamp, gain, analog, pulse, highest, lowest, raw)


class Sounding(NamedTuple):
    profile: Profile
    depth: float
    smooth_depth: float
    confidence: int
    smooth_confidence: int
    hertz: tuple
    decimation: int


def read_s500(payload):
    number, start, length, low, high, _, timestamp, _ = struct.unpack_from("<8I", payload)
    pulse, analog, highest, lowest, depth, smooth, _ = struct.unpack_from("<7f", payload, 32)
    confidence, gain, decimation, smooth_confidence, count = struct.unpack_from("<4BH", payload, 60)
    raw = _results(payload, 66, count)
    profile = Profile(number, start / 1e3, length / 1e3, timestamp, gain, analog, pulse, highest, lowest, raw)
    return Sounding(profile, depth, smooth, confidence, smooth_confidence, (low, high), decimation)


class Distance(NamedTuple):
    metres: float
    mean: float
    confidence: int
    mean_confidence: int
    timestamp_ms: int


def read_distance2(payload):
    metres, mean, _, confidence, mean_confidence, timestamp = struct.unpack("<IIHBBI", payload)
    return Distance(metres / 1e3, mean / 1e3, confidence, mean_confidence, timestamp)
