"""Capture files made by hand, byte by byte from the pcap and IP header layouts."""
import struct

ETHERNET, RAW, SLL, NULL, RTAC_SERIAL = 1, 101, 113, 0, 250


def pcap(packets, link=ETHERNET, snaplen=262144):
    parts = [struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, snaplen, link)]
    for i, packet in enumerate(packets):
        parts += [struct.pack("<IIII", 1000 + i, 500000, len(packet), len(packet)), packet]
    return b"".join(parts)


def udp(payload, length=None):
    return struct.pack(">HHHH", 65500, 4000, length or len(payload) + 8, 0) + payload


def ipv4(body, flags=0, protocol=17, identification=7, length=None):
    return struct.pack(">BBHHHBBH4s4s", 0x45, 0, length or 20 + len(body), identification, flags, 64, protocol, 0,
                       bytes([10, 0, 0, 86]), bytes([10, 0, 1, 102])) + body


def ethernet(packet, tags=0):
    return bytes(12) + struct.pack(">HH", 0x8100, 5) * tags + struct.pack(">H", 0x0800) + packet


def fragments(body, size):
    """IPv4 packets that carry `body` in pieces of `size` (a multiple of 8)."""
    pieces = []
    for at in range(0, len(body), size):
        more = 0x2000 if at + size < len(body) else 0
        pieces.append(ipv4(body[at:at + size], more | at // 8))
    return pieces


def tcp(payload, sequence, flags=0x18, ports=(4000, 65500)):
    return struct.pack(">HHIIBBHHH", *ports, sequence & 0xFFFFFFFF, 0, 5 << 4, flags, 65535, 0, 0) + payload


def rtac(payload, event, seconds=1000):
    """LINKTYPE_RTAC_SERIAL: event 1 is data that the capturing side sent, 2 data that it received."""
    return struct.pack(">IIBBH", seconds, 0, event, 0, 0) + payload


class Pcapng:
    """Blocks of a pcapng file in either byte order."""

    def __init__(self, order="<"):
        self.order = order
        self.data = self.block(0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1))

    def block(self, kind, body):
        body += bytes(-len(body) % 4)
        size = struct.pack(self.order + "I", len(body) + 12)
        return struct.pack(self.order + "I", kind) + size + body + size

    def interface(self, link, name=b"", resolution=9):
        options = struct.pack(self.order + "HH", 2, len(name)) + name + bytes(-len(name) % 4) if name else b""
        options += struct.pack(self.order + "HHB3x", 9, 1, resolution) + bytes(4)
        self.data += self.block(1, struct.pack(self.order + "HHI", link, 0, 0) + options)
        return self

    def packet(self, interface, data, ticks, comment=b""):
        head = struct.pack(self.order + "IIIII", interface, ticks >> 32, ticks & 0xFFFFFFFF, len(data), len(data))
        options = b""
        if comment:
            options = struct.pack(self.order + "HH", 1, len(comment)) + comment + bytes(-len(comment) % 4) + bytes(4)
        self.data += self.block(6, head + data + (bytes(-len(data) % 4) + options if options else b""))
        return self


# R2Sonic commands: "CMD0", then name and value. SeaNet mtReBoot, host to sonar.
COMMANDS = b"CMD0" + b"RNG0" + struct.pack(">f", 25.0) + b"GAN0" + struct.pack(">f", 13.0)
REBOOT = bytes.fromhex("40303030380800ff02031080020a")
SEND_DATA = bytes.fromhex("40303030430c00ff0207198002000000000a")
