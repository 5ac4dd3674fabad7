"""Tritech SeaNet frames as Python values: builds commands, cuts and reads replies; it never opens a port.

Written from the protocol's description alone, so that it can disagree with the C++ codecs. Offsets in error
texts count from 0 at the '@'. Angles are in 1/16 gradian (6400 a turn), clockwise, ahead 3200.
"""

import struct
from dataclasses import dataclass, field
from typing import List, NamedTuple, Tuple

VERSION_DATA, HEAD_DATA, ALIVE, BB_USER_DATA, AUX_DATA = 1, 2, 4, 6, 8
REBOOT, HEAD_COMMAND, SEND_VERSION, SEND_BB_USER, SEND_DATA = 16, 19, 23, 24, 25
FPGA_VERSION_DATA, FPGA_CAL_DATA, STOP_ALIVES = 57, 63, 66
NAMES = {
    1: "VersionData",
    2: "HeadData",
    4: "Alive",
    6: "BBUserData",
    8: "AuxData",
    16: "ReBoot",
    19: "HeadCommand",
    23: "SendVersion",
    24: "SendBBUser",
    25: "SendData",
    57: "FpgaVersionData",
    63: "FpgaCalData",
    66: "StopAlives",
}
FIXED_SIZES = {ALIVE: 22, VERSION_DATA: 25, BB_USER_DATA: 264, FPGA_CAL_DATA: 80, FPGA_VERSION_DATA: 28}
HOST_NODE, IMAGING_NODE = 0xFF, 0x02
ADC8ON, CONTINUOUS, SCAN_RIGHT, INVERT, CHAN2 = 0x01, 0x02, 0x04, 0x08, 0x80
USUAL_CONTROL = 0x2300  # raw, has a motor, ReplyASL
IN_CENTRE, CENTRED, MOTORING, NO_PARAMS, SENT_CFG = 0x01, 0x02, 0x04, 0x40, 0x80
MAX_FRAME = 4096


class Frame(NamedTuple):
    """One whole frame; `raw` holds all of its bytes from '@' to LF."""

    raw: bytes

    @property
    def message(self):
        return self.raw[10]

    @property
    def name(self):
        return NAMES.get(self.message, f"message {self.message}")

    @property
    def payload(self):
        return self.raw[13:-1]


def build(message, payload=b"", node=IMAGING_NODE, copy=None):
    """A frame from the host to `node`; `copy` overrides the node copy at offset 12."""
    count = len(payload) + 8
    head = struct.pack(
        "<HBBBBBB", count, HOST_NODE, node, (count - 5) & 0xFF, message, 0x80, node if copy is None else copy
    )
    return b"@%04X" % count + head + payload + b"\n"


class Framer:
    """Cuts frames out of a byte stream. Bytes that start no frame are skipped one by one and counted."""

    def __init__(self):
        self._data = bytearray()
        self.skipped = 0

    def feed(self, data):
        self._data += data

    def next(self):
        """The next frame, or None until more bytes arrive."""
        while self._data:
            size = self._size()
            if size == 0:
                return None
            if size > 0:
                raw = bytes(self._data[:size])
                del self._data[:size]
                return Frame(raw)
            self.skipped += 1
            del self._data[0]
        return None

    def _size(self):
        """Bytes of the frame at the front, 0 when it is not complete yet, -1 when none starts here."""
        data = self._data
        if data[0] != 0x40:
            return -1
        if any(c not in b"0123456789ABCDEF" for c in data[1:5]):
            return -1
        if len(data) < 7:
            return 0
        count = int(data[1:5], 16)
        if count != data[5] | data[6] << 8 or not 8 <= count <= MAX_FRAME - 6:
            return -1
        if len(data) < count + 6:
            return 0
        return count + 6 if data[count + 5] == 0x0A else -1


@dataclass(frozen=True)
class HeadCommand:
    """mtHeadCommand of type 0x01 (66 bytes) or, when v3b has its 16 bytes, 0x1D (82 bytes)."""

    control: int = USUAL_CONTROL | ADC8ON | CONTINUOUS | SCAN_RIGHT
    head_type: int = 0x11
    tx_number: Tuple[int, int] = (0, 0)
    rx_number: Tuple[int, int] = (0, 0)
    pulse_us: int = 0
    range_scale: int = 100
    left: int = 2400
    right: int = 4000
    ad_span: int = 255
    ad_low: int = 0
    gain: Tuple[int, int] = (105, 105)
    slope: Tuple[int, int] = (0, 0)
    motor_time: int = 25
    step: int = 32
    ad_interval: int = 52
    bins: int = 200
    max_ad_buffer: int = 1000
    lockout_us: int = 100
    v3b: bytes = b""
    node_copy: int = IMAGING_NODE

    def encode(self):
        """The whole frame. struct.error when a value does not fit its field."""
        body = struct.pack(
            "<BHB4IHHHHBBBBHHBBHHHHHBBH",
            0x1D if self.v3b else 0x01,
            self.control,
            self.head_type,
            *self.tx_number,
            *self.rx_number,
            self.pulse_us,
            self.range_scale,
            self.left,
            self.right,
            self.ad_span,
            self.ad_low,
            *self.gain,
            *self.slope,
            self.motor_time,
            self.step,
            self.ad_interval,
            self.bins,
            self.max_ad_buffer,
            self.lockout_us,
            1600,
            1,
            0,
            0,
        )
        return build(HEAD_COMMAND, body + self.v3b, copy=self.node_copy)

    def bin_metres(self, sound_speed=1500.0):
        """Range of one bin, from the AD interval in units of 640 ns (two-way)."""
        return self.ad_interval * 640e-9 * sound_speed / 2

    def data_bytes(self):
        """Dbytes that the reply must have."""
        return self.bins if self.control & ADC8ON else (self.bins + 1) // 2


def reverse_scan():
    """mtHeadCommand of type 0x0F."""
    return build(HEAD_COMMAND, b"\x0f")


def gain_block(ad_span, ad_low, gain):
    """mtHeadCommand of type 0x1E: the V3B layout, both channels alike."""
    return build(
        HEAD_COMMAND,
        struct.pack("<B8B4H", 0x1E, ad_span, ad_span, ad_low, ad_low, gain, gain, 0, 0, 100, 100, 0, 0),
    )


def send_data(milliseconds_of_day=0):
    return build(SEND_DATA, struct.pack("<I", milliseconds_of_day))


class Alive(NamedTuple):
    """mtAlive: parameters byte, head time in ms, motor position, HeadInf flags."""

    params_byte: int
    head_ms: int
    position: int
    head_inf: int

    def has(self, *flags):
        return all(self.head_inf & flag for flag in flags)

    def lacks(self, *flags):
        return not any(self.head_inf & flag for flag in flags)


def read_alive(frame):
    """The Alive of a frame of the right size, else None."""
    return Alive(*struct.unpack("<BIHB", frame.payload)) if len(frame.raw) == 22 else None


@dataclass
class HeadData:
    """One scan line. `levels` holds one number a bin, 0..255 or 0..15, nearest first."""

    total: int
    device_type: int
    head_status: int
    sweep: int
    control: int
    range_scale: int
    tx_number: int
    gain: int
    slope: int
    ad_span: int
    ad_low: int
    heading_offset: int
    ad_interval: int
    left: int
    right: int
    step: int
    bearing: int
    data_bytes: int
    levels: List[int] = field(repr=False)


def read_head_data(frame, high_nibble_first=True):
    """The HeadData of a frame whose three lengths agree, else None."""
    raw = frame.raw
    if len(raw) < 45:
        return None
    fields = struct.unpack("<HBBBHHIBHBBHHHHBHH", raw[13:44])
    if len(raw) != fields[-1] + 45 or fields[0] != fields[-1] + 31:
        return None
    data = raw[44:-1]
    if not fields[4] & ADC8ON:
        pairs = ((b >> 4, b & 15) if high_nibble_first else (b & 15, b >> 4) for b in data)
        data = [nibble for pair in pairs for nibble in pair]
    return HeadData(*fields, list(data))
