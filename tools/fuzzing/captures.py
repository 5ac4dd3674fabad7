"""Messages as captured traffic holds them: IP packets behind each kind of link, pcap and pcapng files as others and echoloop's
recorder write them, text logs of serial lines, logs of Ping Viewer."""
import gzip
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "cli"))
import makers_files as makers  # noqa: E402

HOST, DEVICE = bytes((127, 0, 0, 1)), bytes((127, 0, 0, 2))


def ipv4(protocol, body, source=DEVICE, target=HOST, fragment=0):
    return struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(body), 7, fragment, 64, protocol, 0, source, target) + body


def udp(payload, port=65400):
    return ipv4(17, struct.pack(">HHHH", 4000, port, 8 + len(payload), 0) + payload)


def tcp(payload, sequence, flags=0x18, port=52100):
    return ipv4(6, struct.pack(">HHIIBBHHH", port, 40000, sequence, 1, 0x50, flags, 512, 0, 0) + payload)


def fragments(payload):
    whole = struct.pack(">HHHH", 4000, 65400, 8 + len(payload), 0) + payload
    cut = len(whole) // 2 // 8 * 8
    return [ipv4(17, whole[cut:], fragment=cut // 8), ipv4(17, whole[:cut], fragment=0x2000)]


def rtac(payload, event):
    return struct.pack(">IIBBH", 12, 500000, event, 0, 0) + payload


# Number of the link, what stands before IP in its packets.
LINKS = {
    "ethernet": (1, bytes(12) + b"\x08\x00"), "vlan": (1, bytes(12) + b"\x81\x00\x00\x05\x08\x00"), "raw": (101, b""),
    "sll": (113, bytes(14) + b"\x08\x00"), "sll2": (276, b"\x08\x00" + bytes(18)), "null": (0, b"\x02\x00\x00\x00"),
}


def pcap(link, packets, order="<", magic=0xA1B2C3D4):
    data = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 65535, link)
    for number, packet in enumerate(packets):
        data += struct.pack(order + "IIII", 10 + number, 1000, len(packet), len(packet)) + packet
    return data


def block(kind, body, order="<"):
    body += bytes(-len(body) % 4)
    size = len(body) + 12
    return struct.pack(order + "II", kind, size) + body + struct.pack(order + "I", size)


def option(code, value, order="<"):
    return struct.pack(order + "HH", code, len(value)) + value + bytes(-len(value) % 4)


def pcapng(link, packets, order="<"):
    """As the recorder writes them: names, nanoseconds, directions and remarks."""
    data = block(0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1) + option(4, b"echoloop", order), order)
    data += block(1, struct.pack(order + "HHI", link, 0, 0) + option(2, b"micron/line", order) + option(9, b"\x09", order), order)
    for number, packet in enumerate(packets):
        head = struct.pack(order + "IIIII", 0, 0, 1000 + number, len(packet), len(packet))
        extra = option(2, struct.pack(order + "I", 1 + number % 2), order) + option(1, b"bit_flips", order) + option(0, b"", order)
        data += block(6, head + packet + bytes(-len(packet) % 4) + extra, order)
    return data


def text_log(message):
    digits = message.hex()
    return f"12.5 > {digits}\n12.6 < {digits}\n12.9 < {digits} # again\n".encode()


def ping_viewer_log(messages):
    """QDataStream, big-endian; tools/capture/ping_viewer_log.cpp says what stands where."""
    def text(words):
        return struct.pack(">I", 2 * len(words)) + words.encode("utf-16-be")
    head = text("PingViewer sensor log file") + struct.pack(">I", 1) + 5 * text("v2") + struct.pack(">II", 1, 2)
    return head, b"".join(text(f"00:00:0{number % 10}.500") + struct.pack(">I", len(message)) + message
                          for number, message in enumerate(messages))


def recordings_of_makers(messages):
    """{target: what the kind is known by, and what stands behind it}."""
    image, bathymetry = messages["oculus-result_v1"], messages["r2sonic-bth0_equi_angle"]
    oculus = makers.oculus([(10, 1700000000.5, image, compressed) for compressed in (0, 1, 0)] + [(3, 1, b"x", 1)])
    aris = makers.aris([makers.aris_frame(n, 1700000000000000 + n, samples=20) for n in range(2)], samples=20)
    xtf = makers.xtf([makers.attitude(), makers.xtf_ping(65, bathymetry), makers.xtf_ping(68, bathymetry, 16)])
    packed = gzip.compress(makers.profile() + makers.installation(), mtime=0)
    return {"oculus_file": (oculus[:48], oculus[48:]), "aris_file": (aris[:1024], aris[1024:]),
            "xtf_file": (xtf[:1088], xtf[1088:]), "gzip_file": (packed[:10], packed[10:]),
            "kmall_file": (makers.installation(), makers.profile() + messages["kmall-mwc"] + b"lost" + makers.profile()),
            "ping_viewer_log": ping_viewer_log([message for name, message in messages.items() if name.startswith("ping-")])}


def captures(messages):
    """One file of each kind with each message that is not long; all kinds of links with a few."""
    for name, message in messages.items():
        yield f"{name}-log", text_log(message)
        yield f"{name}-file", message
        packets = [udp(message)] if len(message) < 60000 else fragments(message[:60000])
        yield f"{name}-pcapng", pcapng(101, packets)
        stream = [tcp(b"", 99, 2), tcp(message[:9], 100), tcp(message[9:], 109), tcp(message, 100 + len(message))]
        yield f"{name}-tcp", pcapng(101, stream)
        yield f"{name}-serial", pcapng(250, [rtac(message, 2), rtac(message, 1)])
    some = [message for name, message in messages.items() if name in ("ping-profile", "r2sonic-sth0", "kmall-svp")]
    for name, (link, before) in LINKS.items():
        packets = [before + packet for message in some for packet in [udp(message), *fragments(message), tcp(message, 5)]]
        yield f"link-{name}-big", pcap(link, packets, ">", 0xA1B23C4D)
        yield f"link-{name}-little", pcap(link, packets)
        yield f"link-{name}-pcapng", pcapng(link, packets, ">")
    for kind, (head, rest) in recordings_of_makers(messages).items():
        yield f"makers-{kind}", head + rest


def packet_inputs(messages):
    """{link, {length, packet}}, as tests/cli/packet_fuzz.cpp cuts them."""
    order = ["ethernet", "raw", "sll", "sll2", "null"]
    for name, message in messages.items():
        if len(message) > 180:
            continue
        for number, link in enumerate(order):
            packets = [udp(message), *fragments(message), tcp(message, 5)]
            yield f"{name}-{link}", bytes([number]) + b"".join(
                bytes([len(LINKS[link][1] + packet)]) + LINKS[link][1] + packet for packet in packets)
        yield f"{name}-serial", bytes([5, 12 + len(message)]) + rtac(message, 1)
