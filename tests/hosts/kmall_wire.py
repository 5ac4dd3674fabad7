"""KMALL datagrams as a reader on the network sees them, from the tables of the specification notes: parts are joined, and
structs are stepped over by their size fields. Written apart from the C++ codecs."""

import struct

HEADER = struct.Struct("<I4sBBHII")
COMMON = 24  # header and partition


class Fault(ValueError):
    """What a reader would reject."""


def header(datagram):
    if len(datagram) < COMMON + 4:
        raise Fault(f"{len(datagram)} bytes are no datagram")
    size, kind, version, system, sounder, s, ns = HEADER.unpack_from(datagram)
    if size != len(datagram) or struct.unpack_from("<I", datagram, size - 4)[0] != size:
        raise Fault(f"size {size} of {len(datagram)} bytes")
    parts, part = struct.unpack_from("<HH", datagram, 20)
    return {
        "kind": kind.decode(), "version": version, "system": system, "sounder": sounder,
        "time": s + ns * 1e-9, "parts": parts, "part": part,
    }


class Joiner:
    """Datagrams in, whole ones out; a new first part drops what is incomplete."""

    def __init__(self):
        self.waiting = {}

    def take(self, datagram):
        """(header, bytes behind the partition), or None while parts are missing."""
        head = header(datagram)
        body = datagram[COMMON:-4]
        if head["parts"] == 1:
            return head, body
        pieces = self.waiting.setdefault(head["kind"], [])
        if head["part"] == 1:
            pieces.clear()
        pieces.append(body)
        if head["part"] != len(pieces):
            pieces.clear()
            return None
        return (head, b"".join(pieces)) if len(pieces) == head["parts"] else None


def parameters(datagram):
    """The text of #IIP or #IOP."""
    size, = struct.unpack_from("<H", datagram, 20)
    if 20 + size + 4 != len(datagram):
        raise Fault(f"{size} bytes of parameters in {len(datagram)}")
    return datagram[26 : 20 + size].rstrip(b"\0").decode("ascii")


def sound_profile(datagram):
    """[(depth, sound speed)] of #SVP. Real systems send one point more than they count."""
    size, points = struct.unpack_from("<HH", datagram, 20)
    if len(datagram) - (20 + size + 20 * points + 4) not in (0, 20):
        raise Fault(f"{points} points in {len(datagram)} bytes")
    return [struct.unpack_from("<ff", datagram, 20 + size + 20 * n) for n in range(points)]


def whole(head, body):
    """As one datagram of a .kmall file."""
    size = COMMON + len(body) + 4
    first = HEADER.pack(size, head["kind"].encode(), head["version"], head["system"], head["sounder"],
                        int(head["time"]), round(head["time"] % 1 * 1e9) % 10**9)
    return first + struct.pack("<HH", 1, 1) + body + struct.pack("<I", size)


def read_body(body):
    size, ping = struct.unpack_from("<HH", body)
    return size, {"ping": ping}


def read_mrz(body):
    at, out = read_body(body)
    info = at
    size, = struct.unpack_from("<H", body, info)
    for name, form, offset in (
        ("rate", "f", 4), ("spacing", "B", 8), ("frequency", "f", 16), ("pulse", "f", 28), ("heading", "f", 96),
        ("sound_speed", "f", 100), ("depth", "f", 104), ("water_level", "f", 108), ("latitude", "d", 124),
        ("longitude", "d", 132),
    ):
        out[name], = struct.unpack_from("<" + form, body, info + offset)
    sectors, sector_size = struct.unpack_from("<HH", body, info + 92)
    at += size + sectors * sector_size
    size, count, valid, sounding_size = struct.unpack_from("<4H", body, at)
    extra, classes, class_size = struct.unpack_from("<3H", body, at + 26)
    at += size + classes * class_size
    out["valid"], out["soundings"], samples = valid, [], 0
    for _ in range(count + extra):
        one = {"type": body[at + 3], "method": body[at + 4]}
        one["angle"], = struct.unpack_from("<f", body, at + 72)
        one["time"], = struct.unpack_from("<f", body, at + 80)
        one["dlat"], one["dlon"], one["z"], one["y"], one["x"] = struct.unpack_from("<5f", body, at + 88)
        samples += struct.unpack_from("<H", body, at + 118)[0]
        out["soundings"].append(one)
        at += sounding_size
    if at + 2 * samples != len(body):
        raise Fault(f"#MRZ ends at {at + 2 * samples} of {len(body)}")
    return out


def read_mwc(body):
    at, out = read_body(body)
    size, sectors, sector_size = struct.unpack_from("<3H", body, at)
    at += size + sectors * sector_size
    size, beams, beam_size, phase = struct.unpack_from("<HHBB", body, at)
    out["rate"], out["sound_speed"] = struct.unpack_from("<ff", body, at + 8)
    at += size
    out["beams"] = []
    for _ in range(beams):
        angle, start, detected, _, count, fine = struct.unpack_from("<f4Hf", body, at)
        at += beam_size
        samples = struct.unpack_from(f"<{count}b", body, at)
        at += count * (1 + phase)
        out["beams"].append({"angle": angle, "start": start, "detected": detected, "fine": fine, "samples": samples})
    if at != len(body):
        raise Fault(f"#MWC ends at {at} of {len(body)}")
    return out
