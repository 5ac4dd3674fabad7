"""R2Sonic commands, discovery, configuration and status as bytes and back; it never opens a socket.

Big-endian throughout; addresses are dotted text, ports are base ports. Readers return (value, faults),
value None where nothing can be read.
"""

import ipaddress
import struct

CONFIGURATION_PORT = 53810
FLOAT_COMMANDS = set(
    "AIB0 RNG0 FRQ0 GAN0 SPR0 ABS0 SVL0 PRL0 TXP0 TXL0 SEW0 SER0 RET0 DGA0 DGB0 DGS0 RGA0 RGB0 "
    "PRX0 PRY0 PRZ0 TXS0 TXF0".split()
)


def command(values):
    """CMD0 from {name: number}; floats and integers by name."""
    body = b"".join(
        name.encode()
        + (struct.pack(">f", value) if name in FLOAT_COMMANDS else struct.pack(">I", int(value)))
        for name, value in values.items()
    )
    return b"CMD0" + body


def ip_number(text):
    return int(ipaddress.IPv4Address(text))


def discovery(gui_ip, gui_base):
    """R2DD, 44 bytes."""
    return b"R2DD" + struct.pack(">IHH32x", ip_number(gui_ip), gui_base, 0)


def configuration(serial, config_id, gui, heads, sims, daqs=(), mask="255.0.0.0", gateway="0.0.0.0", index=0):
    """R2DC, 164 bytes; gui, heads, sims and daqs are (ip, base port) or lists of them."""

    def addresses(pairs, count):
        padded = list(pairs) + [("0.0.0.0", 0)] * (count - len(pairs))
        return struct.pack(
            f">{count}I{count}H", *(ip_number(ip) for ip, _ in padded), *(p for _, p in padded)
        )

    return (
        b"R2DC"
        + struct.pack(
            ">12sIIIIHH",
            serial.encode(),
            config_id,
            ip_number(mask),
            ip_number(gateway),
            ip_number(gui[0]),
            gui[1],
            index,
        )
        + addresses(heads, 4)
        + addresses(sims, 4)
        + addresses(daqs, 8)
        + bytes(32)
    )


def read_identity(data):
    """R2DI: {serial, part, model}."""
    if len(data) != 72 or data[:4] != b"R2DI":
        return None, [f"R2DI of {len(data)} bytes"]
    texts = [data[at : at + 12].partition(b"\0")[0].decode("latin-1") for at in (4, 16, 28)]
    return dict(zip(("serial", "part", "model"), texts)), [] if not any(data[40:]) else ["spare is not zero"]


def read_r2ds(data):
    """R2DS: {serial, config_id}."""
    if len(data) != 24 or data[:4] != b"R2DS":
        return None, [f"R2DS of {len(data)} bytes"]
    serial, config_id, spare = struct.unpack(">12sII", data[4:])
    return (
        {"serial": serial.partition(b"\0")[0].decode("latin-1"), "config_id": config_id},
        [] if spare == 0 else ["spare is not zero"],
    )


def read_status(data):
    """STH0 or STS0: {section name: its 32-bit words as bytes}; the fourth character counts the words."""
    if len(data) < 12 or data[:4] not in (b"STH0", b"STS0"):
        return None, ["no status"]
    faults = [] if struct.unpack_from(">I", data, 4)[0] == len(data) else ["PacketSize differs"]
    sections, at = {}, 12
    while at < len(data):
        name = data[at : at + 4].decode("latin-1")
        words = int(name[3], 36) if len(name) == 4 and name[3].isalnum() and name.isascii() else 0
        if words == 0 or at + 4 + 4 * words > len(data):
            return sections, faults + [f"section {name!r} at {at}"]
        sections[name] = data[at + 4 : at + 4 + 4 * words]
        at += 4 + 4 * words
    return sections, faults
