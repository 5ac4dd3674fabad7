"""Takes out of a recording what no two runs have in common: ports that the kernel chose, and which of several devices was
heard first at one moment."""

import struct

from place import FIRST_EPHEMERAL, LAST_EPHEMERAL

INTERFACE, PACKET = 1, 6
IPV4_LINKS = {101: 0, 228: 0, 1: 14}  # link type: bytes before the IP header
TCP, UDP = 6, 17


def blocks(data):
    at = 0
    while at + 12 <= len(data):
        kind, size = struct.unpack_from("<II", data, at)
        yield kind, at, size
        at += max(size, 12)


def sorted_by_interface(data):
    """The recording with the packets of each interface behind those of the one before, in their order."""
    ranked = [(struct.unpack_from("<I", data, at + 8)[0] + 1 if kind == PACKET else 0, at, size) for kind, at, size in blocks(data)]
    return b"".join(data[at : at + size] for _, at, size in sorted(ranked))


def masked_ports(data):
    """The recording with those ports and the checksums over them set to 0."""
    out, links = bytearray(data), []
    for kind, at, _ in blocks(data):
        if kind == INTERFACE:
            links.append(struct.unpack_from("<H", data, at + 8)[0])
        if kind == PACKET:
            interface, _, _, size = struct.unpack_from("<4I", data, at + 8)
            skip = IPV4_LINKS.get(links[interface])
            if skip is not None and size >= skip + 28:
                mask_packet(out, at + 28 + skip)
    return bytes(out)


def mask_packet(out, ip):
    protocol, head = out[ip + 9], ip + 4 * (out[ip] & 15)
    if out[ip] >> 4 != 4 or protocol not in (TCP, UDP):
        return
    for port in (head, head + 2):
        if FIRST_EPHEMERAL <= struct.unpack_from(">H", out, port)[0] <= LAST_EPHEMERAL:
            out[port : port + 2] = b"\0\0"
            checksum = head + (6 if protocol == UDP else 16)
            out[checksum : checksum + 2] = b"\0\0"
