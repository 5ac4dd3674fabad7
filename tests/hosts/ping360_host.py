"""A host of the Ping360 over UDP, as Ping Viewer and discovery programs are; it knows no scene.

Written from the published message definitions alone, so that it can disagree with the C++ codecs.
"""

import re
import socket
import struct
import time
from typing import NamedTuple

ACK, NACK, DEVICE_INFORMATION, PROTOCOL_VERSION, GENERAL_REQUEST = 1, 2, 4, 5, 6
DEVICE_DATA, AUTO_DEVICE_DATA, TRANSDUCER, AUTO_TRANSMIT, MOTOR_OFF = 2300, 2301, 2601, 2602, 2903
DISCOVERY_PORT = 30303
TICK = 25e-9  # s
FOUND = re.compile(
    rb"\ASONAR PING360  \r\nBlue Robotics\r\nMAC Address:- ((?:[0-9A-F]{2}-){5}[0-9A-F]{2})\r\n"
    rb"IP Address:- (\d{3})\.(\d{3})\.(\d{3})\.(\d{3})\r\n\Z"
)


class Frame(NamedTuple):
    id: int
    source: int
    payload: bytes


class Ping(NamedTuple):
    """What 2300 and 2301 have in common."""

    mode: int
    gain: int
    angle: int
    duration: int
    period: int
    frequency: int
    samples: int
    data: bytes


class Settings(NamedTuple):
    gain: int = 0
    duration: int = 11
    period: int = 88
    frequency: int = 750
    samples: int = 1200

    def for_range(self, metres, sound_speed):
        """1200 samples over the range, as hosts compute the period."""
        return self._replace(period=int(2 * metres / (1200 * sound_speed * TICK)))

    def bin_length(self, sound_speed):
        return self.period * TICK * sound_speed / 2


def frame(message_id, payload=b""):
    data = b"BR" + struct.pack("<HHBB", len(payload), message_id, 0, 0) + payload
    return data + struct.pack("<H", sum(data) & 0xFFFF)


def parse(datagram):
    """The one frame that a datagram is; ValueError if it is none."""
    if len(datagram) < 10 or datagram[:2] != b"BR":
        raise ValueError(f"no frame: {datagram[:16].hex()}")
    length, message_id, source, _ = struct.unpack_from("<HHBB", datagram, 2)
    if len(datagram) != length + 10:
        raise ValueError(f"{len(datagram)} bytes with a length of {length}")
    if struct.unpack_from("<H", datagram, len(datagram) - 2)[0] != sum(datagram[:-2]) & 0xFFFF:
        raise ValueError("the checksum is wrong")
    return Frame(message_id, source, datagram[8:-2])


def ping_of(message):
    """A 2300 or 2301 as a Ping; ValueError if its counts do not fit."""
    p = message.payload
    if message.id == DEVICE_DATA:
        fields, head = struct.unpack_from("<BBHHHHHH", p), 14
    elif message.id == AUTO_DEVICE_DATA:
        fields, head = struct.unpack_from("<BBHHHH6xHH", p), 20
    else:
        raise ValueError(f"message {message.id} is no ping")
    if len(p) != head + fields[-1]:
        raise ValueError(f"{len(p) - head} samples with a count of {fields[-1]}")
    return Ping(*fields[:-1], p[head:])


class Host:
    """Use as a context manager."""

    def __init__(self, ip, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.there = (ip, port)
        self.stale = lambda message: False

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def say(self, data):
        self.socket.sendto(data, self.there)

    def hear(self, seconds):
        """The next frame, or None."""
        self.socket.settimeout(max(seconds, 1e-3))
        try:
            return parse(self.socket.recv(65536))
        except socket.timeout:
            return None

    def ask(self, message_id, seconds=2):
        self.say(frame(GENERAL_REQUEST, struct.pack("<H", message_id)))
        return self.hear(seconds)

    def line_break(self):
        self.say(b"")

    def scan(self, settings, start=0, stop=399, step=1, delay=0):
        """The strategy of Ping Viewer above firmware 3.3.0: an empty datagram, 200 ms, auto_transmit. What the sonar said
        before it heard that is dropped."""
        self.line_break()
        self.pings(1 << 20, 0.2)
        head = struct.pack("<BBHHHH", 1, *settings)
        sector = struct.pack("<HHB", start, stop, step)
        self.say(frame(AUTO_TRANSMIT, head + sector + bytes([delay])))
        self.stale = lambda message: message.id == AUTO_DEVICE_DATA and message.payload[10:15] != sector

    def silence(self, seconds=0.2):
        """Frames that are still on their way, until there are none for so long."""
        frames = []
        while message := self.hear(seconds):
            frames.append(message)
        return frames

    def pings(self, count, seconds):
        """So many pings; fewer if the time is over before."""
        found, end = [], time.monotonic() + seconds
        while len(found) < count and (left := end - time.monotonic()) > 0:
            message = self.hear(left)
            if message and not self.stale(message):
                found.append(ping_of(message))
        return found

    def ping(self, angle, settings, seconds=5):
        """Request and response, as with older firmware."""
        head = struct.pack("<BBH", 0, settings.gain, angle) + struct.pack("<HHHH", *settings[1:])
        self.say(frame(TRANSDUCER, head + b"\x01\x00"))
        return self.pings(1, seconds)[0]


def discover(broadcast, seconds=2):
    """(address of the hardware, IP address) of every Ping360 that answers."""
    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        s.sendto(b"Discovery", (broadcast, DISCOVERY_PORT))
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            s.settimeout(left)
            try:
                text = s.recv(2048)
            except socket.timeout:
                break
            if match := FOUND.match(text):
                octets = [str(int(part)) for part in match.groups()[1:]]
                found.append((match.group(1).decode(), ".".join(octets)))
    return found
