"""R2Sonic's water column, snippets and TruePix as Python values; it never opens a socket.

Written from the format's description alone. Readers return (value, faults); offsets are those of the description.
"""

import struct
from dataclasses import dataclass, field
from typing import Dict, List, NamedTuple, Tuple

from r2sonic_wire import Section, read_h0, read_sections


def read_long_h0(section):
    """The H0 of SNI0 and TPX0, 140 bytes, with "more" added."""
    if len(section.data) != 140:
        return None, [f"H0 has {len(section.data)} bytes, not 140"]
    header, faults = read_h0(Section("H0", section.offset, section.data[:116]))
    header["more"] = struct.unpack_from(">6f", section.data, 116)
    return header, faults


class ColumnPart(NamedTuple):
    """One M1 or M2: rows of magnitudes, and of phases or None, from first_beam on."""

    ping: int
    total_samples: int
    first_sample: int
    samples: int
    total_beams: int
    first_beam: int
    magnitudes: List[Tuple[int, ...]]
    phases: List[Tuple[int, ...]]


def read_wcd0(data):
    """("header", H0 fields with "angles") or ("part", ColumnPart)."""
    found, faults = read_sections(data, "WCD0")
    if not found:
        return None, faults or ["no section"]
    names = [s.name for s in found]
    if names == ["H0", "A1"]:
        header, more = read_h0(found[0])
        if header is None or len(found[1].data) != 28 + 4 * header["points"]:
            return None, faults + more + ["A1 does not fit H0"]
        header["angles"] = list(struct.unpack_from(f">{header['points']}f", found[1].data, 28))
        return ("header", header), faults + more
    if names not in (["M1"], ["M2"]):
        return None, faults + [f"sections {' '.join(names)}"]
    body, both = found[0].data, names == ["M2"]
    ping, _, total, first, samples, beams_of_all, first_beam, beams, *_ = struct.unpack_from(">IfIIHHHHII", body, 4)
    cell = 4 if both else 2
    size = 36 + (cell * beams * samples + 3) // 4 * 4
    if len(body) != size:
        return None, faults + [f"{names[0]} has {len(body)} bytes for {beams} x {samples}, not {size}"]
    if first + samples > total or first_beam + beams > beams_of_all or beams % 2 or first_beam % 2:
        faults = faults + [f"{names[0]} lies outside the ping or has odd beams"]
    rows, phases = [], []
    for beam in range(beams):
        at = 36 + cell * samples * beam
        values = struct.unpack_from(">" + ("Hh" if both else "H") * samples, body, at)
        rows.append(values[::2] if both else values)
        phases.append(values[1::2] if both else None)
    return ("part", ColumnPart(ping, total, first, samples, beams_of_all, first_beam, rows, phases)), faults


class Snippet(NamedTuple):
    ping: int
    number: int
    first_sample: int
    angle: float
    scale: Tuple[float, float]
    magnitudes: Tuple[int, ...]


def read_sni0(data):
    """(H0 or None, [Snippet]) of one datagram."""
    found, faults = read_sections(data, "SNI0")
    if not found:
        return None, faults or ["no section"]
    header = None
    if found[0].name == "H0":
        header, more = read_long_h0(found[0])
        faults, found = faults + more, found[1:]
    snippets = []
    for section in found:
        if section.name != "S1" or len(section.data) < 32:
            return None, faults + [f"section {section.name}"]
        ping, number, count, first, angle, begin, end, _ = struct.unpack_from(">IHHIfffI", section.data, 4)
        if len(section.data) != 32 + (count + 1) // 2 * 4:
            return None, faults + [f"S1 has {len(section.data)} bytes for {count} samples"]
        values = struct.unpack_from(f">{count}H", section.data, 32)
        snippets.append(Snippet(ping, number, first, angle, (begin, end), values))
    return (header, snippets), faults + ([] if snippets else ["no S1"])


class SidePart(NamedTuple):
    """One D0 or D1: magnitudes of both sides, and their angles in rad or None."""

    ping: int
    total_samples: int
    first_sample: int
    port: Tuple[int, ...]
    starboard: Tuple[int, ...]
    angles: Tuple[Tuple[float, ...], Tuple[float, ...]]


def read_tpx0(data):
    """(H0 or None, SidePart) of one datagram."""
    found, faults = read_sections(data, "TPX0")
    if not found:
        return None, faults or ["no section"]
    header = None
    if found[0].name == "H0":
        header, more = read_long_h0(found[0])
        faults, found = faults + more, found[1:]
    if [s.name for s in found] not in (["D0"], ["D1"]):
        return None, faults + ["neither D0 nor D1"]
    body, directed = found[0].data, found[0].name == "D1"
    if len(body) < 52:
        return None, faults + ["D0 or D1 is cut"]
    ping, total, first, count = struct.unpack_from(">IIIH", body, 4)
    if len(body) != (56 + 8 * count if directed else 52 + 4 * count):
        return None, faults + [f"{found[0].name} has {len(body)} bytes for {count} samples"]
    if first + count > total:
        faults = faults + [f"{found[0].name} lies outside the ping"]
    if not directed:
        values = struct.unpack_from(f">{2 * count}H", body, 52)
        return (header, SidePart(ping, total, first, values[::2], values[1::2], None)), faults
    scale = struct.unpack_from(">f", body, 52)[0]
    values = struct.unpack_from(">" + "HhHh" * count, body, 56)
    angles = tuple(tuple(v * scale for v in values[k::4]) for k in (1, 3))
    return (header, SidePart(ping, total, first, values[::4], values[2::4], angles)), faults


@dataclass
class Gathered:
    """One ping under way, put together of its parts."""

    header: Dict
    total: int = 0
    seen: int = 0
    rows: List[List[int]] = field(default_factory=list)  # WCD0: beams; TPX0: port, starboard
    angles: List[List[float]] = field(default_factory=list)  # TPX0 with directions
    phases: List[List[int]] = field(default_factory=list)  # WCD0 with phase
    snippets: Dict[int, Snippet] = field(default_factory=dict)

    def metres(self, sample):
        """Slant range of the middle of a sample."""
        return (sample + 0.5) / self.header["sample_rate"] * self.header["sound_speed"] / 2


class WaterReader:
    """Events of WCD0, SNI0 and TPX0 datagrams: "column", "snippets" and "truepix" carry a Gathered ping."""

    def __init__(self):
        self._column = self._sides = self._snippets = None

    def column(self, data):
        got, faults = read_wcd0(data)
        if got is None:
            return [{"event": "bad", "name": "WCD0", "bytes": len(data), "faults": faults}]
        kind, value = got
        if kind == "header":
            if self._column is not None and self._column.seen < self._column.total:
                faults.append(f"water column {self._column.header['ping']} is not whole")
            self._column = Gathered(value)
            return [{"event": "column_header", "ping": value["ping"], "faults": faults}]
        ping = self._column
        if ping is None or value.ping != ping.header["ping"]:
            return [{"event": "stale", "ping": value.ping, "faults": faults}]
        if not ping.rows:
            ping.total, ping.rows = value.total_samples, [[] for _ in range(value.total_beams)]
            ping.phases = [[] for _ in range(value.total_beams)]
        if value.first_sample != ping.seen or value.total_samples != ping.total:
            faults.append(f"sample {value.first_sample} after {ping.seen}")
        for n, row in enumerate(value.magnitudes):
            ping.rows[value.first_beam + n] += row
            ping.phases[value.first_beam + n] += value.phases[n] or ()
        ping.seen += value.samples
        done = ping.seen == ping.total
        return [{"event": "column" if done else "part", "gathered": ping, "faults": faults}]

    def snippets(self, data):
        """A ping's snippets are told when the next ping begins: nothing says that one was the last."""
        got, faults = read_sni0(data)
        if got is None:
            return [{"event": "bad", "name": "SNI0", "bytes": len(data), "faults": faults}]
        header, snippets = got
        events = []
        if header is not None:
            if self._snippets is not None:
                events.append({"event": "snippets", "gathered": self._snippets, "faults": []})
            self._snippets = Gathered(header)
        ping = self._snippets
        for snippet in snippets:
            if ping is None or snippet.ping != ping.header["ping"]:
                continue
            if snippet.number in ping.snippets or snippet.number >= ping.header["points"]:
                faults.append(f"snippet {snippet.number} of {ping.header['points']}")
            ping.snippets[snippet.number] = snippet
        return events + [{"event": "part", "faults": faults}]

    def truepix(self, data):
        got, faults = read_tpx0(data)
        if got is None:
            return [{"event": "bad", "name": "TPX0", "bytes": len(data), "faults": faults}]
        header, part = got
        if header is not None:
            self._sides = Gathered(header, part.total_samples, part.first_sample, [[], []], [[], []])
        ping = self._sides
        if ping is None or part.ping != ping.header["ping"]:
            return [{"event": "stale", "ping": part.ping, "faults": faults}]
        if part.first_sample != ping.seen:
            faults.append(f"sample {part.first_sample} after {ping.seen}")
        for side, values in enumerate((part.port, part.starboard)):
            ping.rows[side] += values
            ping.angles[side] += part.angles[side] if part.angles else ()
        ping.seen += len(part.port)
        done = ping.seen == ping.total
        return [{"event": "truepix" if done else "part", "gathered": ping, "faults": faults}]
