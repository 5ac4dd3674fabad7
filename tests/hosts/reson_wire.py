"""Teledyne Reson 7k records in Python, from the specification alone: offsets, no code of the emulator."""

import datetime
import struct

NETWORK = struct.Struct("<HHIHHIIIIHHI")  # 36 bytes
SYNC = 0x0000FFFF
MOTION, SETTINGS, CONFIGURATION, GEOMETRY, IMAGE, BEAMFORMED, DETECTIONS = 1012, 7000, 7001, 7004, 7011, 7018, 7027
CONTROL, ACKNOWLEDGE, REFUSED, REMOTE_SETTINGS, FILE_HEADER, FILE_CATALOG = 7500, 7501, 7502, 7503, 7200, 7300


def record(kind, content, device=7125, optional=0, when=(2026, 1, 0.0, 0, 0)):
    """A whole record: frame, content, checksum. `optional`: offset of optional data from the record's start."""
    frame = struct.pack("<HHIIII", 5, 60, SYNC, 64 + len(content) + 4, optional, 0)
    frame += struct.pack("<HHfBB", *when)
    frame += struct.pack("<HIIHHIH", 1, kind, device, 0, 0, 0, 1) + bytes(14)
    assert len(frame) == 64
    whole = frame + content
    return whole + struct.pack("<I", sum(whole) & 0xFFFFFFFF)


def packet(whole, transmission):
    return NETWORK.pack(5, 36, 1, 1, transmission, 36 + len(whole), len(whole), 0, 0, 0, 0, 0) + whole


class Record:
    """What came, with typed access by offsets behind the frame. ValueError where it contradicts itself."""

    def __init__(self, data):
        self.data = data
        version, offset, sync, size = struct.unpack_from("<HHII", data)
        if (version, offset, sync) != (5, 60, SYNC) or size != len(data):
            raise ValueError(f"no record frame: {data[:16].hex()}")
        self.kind, self.device = struct.unpack_from("<II", data, 32)
        (flags,) = struct.unpack_from("<H", data, 48)
        (checksum,) = struct.unpack_from("<I", data, size - 4)
        if flags & 1 and checksum != sum(data[:-4]) & 0xFFFFFFFF:
            raise ValueError(f"{self.kind}: wrong checksum")
        year, day, seconds, hours, minutes = struct.unpack_from("<HHfBB", data, 20)
        self.time = datetime.datetime(year, 1, 1, tzinfo=datetime.timezone.utc) + datetime.timedelta(
            days=day - 1, hours=hours, minutes=minutes, seconds=seconds
        )

    def get(self, form, offset):
        values = struct.unpack_from("<" + form, self.data, 64 + offset)
        return values[0] if len(values) == 1 else values

    @property
    def ping(self):
        return self.get("I", 0 if self.kind == IMAGE else 8)

    def points(self):
        """7027: (beam, two-way time in s, angle in rad, flags, quality)."""
        count, size, rate = self.get("I", 14), self.get("I", 18), self.get("f", 27)
        for i in range(count):
            beam, sample, angle, flags, quality = self.get("HffII", 99 + size * i)
            yield beam, sample / rate, angle, flags, quality

    def column(self, beam):
        """7018: amplitudes of one beam."""
        beams, samples = self.get("HI", 14)
        return [self.get("H", 52 + 4 * (s * beams + beam)) for s in range(samples)]

    def picture(self):
        """7011: rows of bytes."""
        width, height = self.get("II", 6)
        pixels = self.data[-4 - width * height : -4]
        return [pixels[width * row : width * (row + 1)] for row in range(height)]


def file_of(records, device=7125):
    """The bytes of an .s7k file as a logger writes it: header, records, catalog."""
    records = list(records)
    header_size = 64 + 16 + 2 + 2 + 16 + 4 + 4 + 64 + 16 + 64 + 128 + 6 + 12 + 4
    catalog_at = header_size + sum(len(r.data) for r in records)
    head = bytes(16) + struct.pack("<HH", 1, 0) + bytes(16) + struct.pack("<II", 0, 1)
    head += b"test".ljust(64, b"\0") + b"1".ljust(16, b"\0") + bytes(64 + 128) + struct.pack("<IH", device, 0)
    head += struct.pack("<IQ", 48 * (len(records) + 1), catalog_at)
    header = record(FILE_HEADER, head, 7000, optional=header_size - 4 - 12)
    entries, at = b"", 0
    for data in [header] + [r.data for r in records]:
        kind, owner = struct.unpack_from("<II", data, 32)
        entries += struct.pack("<IQHHH", len(data), at, kind, owner, 0) + data[20:30] + struct.pack("<I", 1) + bytes(16)
        at += len(data)
    catalog = record(FILE_CATALOG, struct.pack("<IHII", 14, 1, len(records) + 1, 0) + entries, 7000)
    return header + b"".join(r.data for r in records) + catalog
