"""R2Sonic datagrams as Python values: reads BTH0 and AID0; it never opens a socket.

Written from the format's description alone, so that it can disagree with the C++ codecs. All numbers are
big-endian; angles are in rad, port negative, relative to the array's centre line; times are two-way seconds.
Readers return (value, faults): value is None where nothing can be read, faults are sentences.
"""

import struct
from dataclasses import dataclass, field
from itertools import accumulate
from typing import Dict, List, NamedTuple, Optional, Tuple

H0_FIELDS = (
    "model serial seconds nanoseconds ping period sound_speed frequency power pulse beam_vertical "
    "beam_horizontal steer_vertical steer_horizontal temperature vtx bandwidth sample_rate range gain "
    "spreading absorption tilt reserved108 reserved112 points"
).split()
H0_FORMAT = ">12s12sIIIfffffffffHhfffffffIHH"
BTH0_ORDER = ("H0", "R0", "A0", "A2", "I1", "G0", "G1", "Q0")


class Section(NamedTuple):
    name: str
    offset: int
    data: bytes  # with the 4-byte section header, so that offsets are those of the description


def read_sections(data, packet):
    """The sections of a datagram of the given packet name, in the order sent."""
    if len(data) < 12 or data[:4] != packet.encode():
        return None, [f"not a {packet} datagram"]
    size, stream = struct.unpack_from(">II", data, 4)
    faults = [] if size == len(data) else [f"PacketSize {size} in a datagram of {len(data)} bytes"]
    faults += [] if stream == 0 else [f"DataStreamID {stream}"]
    sections, at = [], 12
    while at < len(data):
        if len(data) - at < 4:
            return sections, faults + [f"{len(data) - at} bytes after the last section"]
        name, length = data[at : at + 2].decode("latin-1"), struct.unpack_from(">H", data, at + 2)[0]
        if length < 4 or length % 4 or at + length > len(data):
            return sections, faults + [f"section {name} at {at} says {length} bytes"]
        sections.append(Section(name, at, data[at : at + length]))
        at += length
    return sections, faults


def read_h0(section):
    """The H0 fields as a dictionary; model and serial as text."""
    if len(section.data) != 116:
        return None, [f"H0 has {len(section.data)} bytes, not 116"]
    values = dict(zip(H0_FIELDS, struct.unpack_from(H0_FORMAT, section.data, 4)))
    faults = []
    for name in ("model", "serial"):
        text, _, rest = values[name].partition(b"\0")
        if not text or not text.isascii() or rest.strip(b"\0"):
            faults.append(f"{name} {values[name]!r}")
        values[name] = text.decode("latin-1")
    values["time"] = values["seconds"] + values["nanoseconds"] * 1e-9
    if values["nanoseconds"] >= 1_000_000_000:
        faults.append(f"{values['nanoseconds']} nanoseconds")
    return values, faults


@dataclass
class Bathymetry:
    """One BTH0 ping. Lists have one entry a point, port to starboard."""

    header: Dict
    mode: str  # equi-angle or equi-distant
    angles: List[float]
    times: List[float]
    quality: List[int]
    more: Tuple[float, ...]
    intensity: Optional[List[float]]
    gate: Tuple[float, float, float]  # two-way s, two-way s, rad
    gates: Optional[List[Tuple[float, float]]]
    order: List[str]
    scales: Dict[str, float] = field(default_factory=dict)


def read_bth0(data):
    """A Bathymetry from one datagram."""
    found, faults = read_sections(data, "BTH0")
    if found is None:
        return None, faults
    sections = {s.name: s for s in found}
    order = [s.name for s in found]
    if order != [name for name in BTH0_ORDER if name in sections] or ("A0" in sections) == ("A2" in sections):
        faults.append(f"sections {' '.join(order)}")
    if not {"H0", "R0", "G0", "Q0"} <= set(sections) or not {"A0", "A2"} & set(sections):
        return None, faults + ["a mandatory section is missing"]
    header, more_faults = read_h0(sections["H0"])
    faults += more_faults
    if header is None:
        return None, faults
    faults += _wrong_sizes(sections, header["points"])
    if any("bytes for" in fault for fault in faults):
        return None, faults
    ping, more_faults = _points(sections, header, order)
    return ping, faults + more_faults


def _wrong_sizes(sections, n):
    even = n + n % 2
    sizes = {
        "R0": 8 + 2 * even,
        "A0": 36,
        "A2": 36 + 2 * even,
        "I1": 8 + 2 * even,
        "G0": 16,
        "G1": 8 + 2 * even,
        "Q0": 4 + 4 * ((n + 7) // 8),
    }
    return [
        f"section {name} has {len(sections[name].data)} bytes for {n} points, not {size}"
        for name, size in sizes.items()
        if name in sections and len(sections[name].data) != size
    ]


def _points(sections, header, order):
    n, scales, faults = header["points"], {}, []

    def numbers(name, at):
        values = struct.unpack_from(f">{n}H", sections[name].data, at)
        if any(sections[name].data[at + 2 * n :]):
            faults.append(f"padding of {name} is not zero")
        return values

    def scale(name, at=4):
        scales[name] = struct.unpack_from(">f", sections[name].data, at)[0]
        return scales[name]

    times = [value * scale("R0") for value in numbers("R0", 8)]
    if "A2" in sections:
        first, factor, *more = struct.unpack_from(">8f", sections["A2"].data, 4)
        scales["A2"] = factor
        angles = [first + factor * total for total in accumulate(numbers("A2", 36))]
    else:
        first, last, *more = struct.unpack_from(">8f", sections["A0"].data, 4)
        angles = [first + (last - first) * i / max(1, n - 1) for i in range(n)]
    intensity = [v * scale("I1") for v in numbers("I1", 8)] if "I1" in sections else None
    gates = None
    if "G1" in sections:
        pairs = struct.iter_unpack("BB", sections["G1"].data[8 : 8 + 2 * n])
        gates = [(low * scale("G1"), high * scale("G1")) for low, high in pairs]
    words = struct.unpack_from(f">{(n + 7) // 8}I", sections["Q0"].data, 4)
    nibbles = [word >> shift & 15 for word in words for shift in range(28, -4, -4)]
    if any(nibbles[n:]):
        faults.append("flags of Q0 after the last point are not zero")
    if any(later < earlier for earlier, later in zip(angles, angles[1:])):
        faults.append("angles do not ascend from port to starboard")
    gate = struct.unpack_from(">3f", sections["G0"].data, 4)
    mode = "equi-distant" if "A2" in sections else "equi-angle"
    return Bathymetry(
        header, mode, angles, times, nibbles[:n], tuple(more), intensity, gate, gates, order, scales
    ), faults


class ImagePart(NamedTuple):
    """One M0: `data` holds beam after beam, each with `bins` bytes."""

    ping: int
    total_samples: int
    total_bins: int
    first_bin: int
    bins: int
    total_beams: int
    first_beam: int
    beams: int
    data: bytes


def read_aid0(data):
    """("header", H0 fields with "angles" added) or ("part", ImagePart) from one datagram."""
    found, faults = read_sections(data, "AID0")
    if not found:
        return None, faults or ["no section"]
    names = [s.name for s in found]
    if names == ["H0", "A1"]:
        header, more_faults = read_h0(found[0])
        if header is None or len(found[1].data) != 28 + 4 * header["points"]:
            return None, faults + more_faults + [f"A1 has {len(found[1].data)} bytes"]
        header["angles"] = list(struct.unpack_from(f">{header['points']}f", found[1].data, 28))
        if any(later <= earlier for earlier, later in zip(header["angles"], header["angles"][1:])):
            more_faults.append("angles do not ascend")
        return ("header", header), faults + more_faults
    if names != ["M0"] or len(found[0].data) < 36:
        return None, faults + [f"sections {' '.join(names)}"]
    body = found[0].data
    values = struct.unpack_from(">IfIIIHHHHI", body, 4)
    ping, _, samples, total_bins, first_bin, bins, total_beams, first_beam, beams, _ = values
    size = 36 + (bins * beams + 3) // 4 * 4
    if len(body) != size:
        return None, faults + [f"M0 has {len(body)} bytes for {beams} x {bins}, not {size}"]
    part = ImagePart(
        ping,
        samples,
        total_bins,
        first_bin,
        bins,
        total_beams,
        first_beam,
        beams,
        body[36 : 36 + bins * beams],
    )
    return ("part", part), faults + _part_faults(part)


def _part_faults(part):
    faults = [
        f"M0 {name} {value} is no multiple of 4"
        for name, value in (
            ("TotalBeams", part.total_beams),
            ("FirstBeam", part.first_beam),
            ("Beams", part.beams),
        )
        if value % 4
    ]
    if part.first_bin + part.bins > part.total_bins or part.first_beam + part.beams > part.total_beams:
        faults.append("M0 lies outside the image")
    if part.total_bins > part.total_samples:
        faults.append(f"{part.total_bins} bins of {part.total_samples} samples")
    return faults
