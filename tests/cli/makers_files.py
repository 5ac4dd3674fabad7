"""Recordings as makers' programs write them, made here byte by byte from descriptions of their formats."""
import struct
import zlib


def kmall(type_, body, seconds=1700000000, nanoseconds=250000000, version=0):
    """One datagram: header, body, size again. Bodies have an even length."""
    body += bytes(len(body) % 2)
    size = struct.pack("<I", 24 + len(body))
    return size + type_ + struct.pack("<BBHII", version, 40, 2040, seconds, nanoseconds) + body + size


def installation(type_=b"#IIP", text=b"OSCV:Empty,EMXV:EM2040P,\n"):
    return kmall(type_, struct.pack("<HHH", 6 + len(text), 0, 0) + text)


def profile():
    """#SVP of two points with the one behind them that real systems add."""
    point = struct.pack("<ffIff", 0, 1500, 0, 0, 0)
    return kmall(b"#SVP", struct.pack("<HH4sIdd", 28, 2, b"S00\0", 1700000000, 0, 0) + 2 * point + bytes(20), version=1)


def oculus(items, encryption=0):
    """`items`: (type, Unix time, payload, compressed)."""
    out = struct.pack("<II16sHHIqd", 0x11223344, 48, b"Oculus", 1, encryption, 0, 0, 1700000000.25)
    for type_, time, payload, compressed in items:
        stored = struct.pack(">I", len(payload)) + zlib.compress(payload) if compressed else payload
        out += struct.pack("<IIHHIdHHIII", 0xAABBCCDD, 40, type_, 0, 0, time, compressed, 0, len(payload), len(stored), 0)
        out += stored
    return out


def aris_frame(index, time_us, samples=200, mode=1, reordered=1):
    """48 beams; each sample is its number in the frame, modulo 251."""
    header = bytearray(1024)
    for at, value in ((0, index), (436, mode), (452, 10), (468, samples), (516, reordered)):
        struct.pack_into("<I", header, at, value)
    struct.pack_into("<QIIQ", header, 4, time_us, 0x05464444, 0, time_us)
    return bytes(header) + bytes(i % 251 for i in range(48 * samples))


def aris(frames, beams=48, samples=200):
    header = struct.pack("<IIIIIfI", 0x05464444, len(frames), 10, 1, beams, 1e5, samples)
    return header.ljust(1024, b"\0") + b"".join(frames)


def xtf_packet(type_, body):
    size = 14 + len(body)
    size += -size % 64
    return (struct.pack("<HBBHHHI", 0xFACE, type_, 0, 1, 0, 0, size) + body).ljust(size, b"\0")


def xtf_ping(type_, payload, second=15, hundredths=0):
    when = struct.pack("<HBBBBBBH", 2015, 7, 8, 23, 52, second, hundredths, 189)
    return xtf_packet(type_, when.ljust(256 - 14, b"\0") + payload)


def xtf(packets, channels=1):
    header = bytearray(1024)
    header[:2] = b"\x7B\xCA"
    header[2:10] = b"QINSy".ljust(8, b"\0")
    header[34:36] = struct.pack("<H", 53)
    header[166:170] = struct.pack("<HH", 0, channels)
    return bytes(header) + b"".join(packets)


def attitude():
    return xtf_packet(3, bytes(50))
