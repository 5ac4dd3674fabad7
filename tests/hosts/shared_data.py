"""Finds the recorded and published data that lie beside the repository, and says so when they do not."""

import os
import struct
import unittest
from pathlib import Path

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


def needs_data(name):
    """The path of a file in the shared data; skips where it is missing, except when CI is true."""
    path = DATA / name
    if not path.exists():
        if os.environ.get("CI") == "true":
            raise AssertionError(f"{path} is missing and CI is true")
        raise unittest.SkipTest(f"{path} is missing: nothing published to compare with")
    return path


def udp_payloads(path):
    """[(seconds, payload)] of a classic little-endian pcap file of Ethernet, IPv4, unfragmented UDP."""
    data, at, found = path.read_bytes(), 24, []
    while at + 16 <= len(data):
        seconds, micros, size, _ = struct.unpack_from("<IIII", data, at)
        packet = data[at + 16 : at + 16 + size]
        header = 14 + (packet[14] & 15) * 4
        length = struct.unpack_from(">H", packet, header + 4)[0]
        found.append((seconds + micros * 1e-6, packet[header + 8 : header + length]))
        at += 16 + size
    return found
