"""Self-test of the R2Sonic host's commands, discovery and status, and of its sockets."""

import socket
import struct
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import r2sonic_control as control
import r2sonic_host
from r2sonic_reader import Reader
from test_r2sonic_host import equi_angle


class Control(unittest.TestCase):
    def test_commands_are_floats_or_integers_by_name(self):
        self.assertEqual(
            control.command({"RNG0": 30, "BOS0": 1}),
            b"CMD0" + b"RNG0\x41\xf0\x00\x00" + b"BOS0\x00\x00\x00\x01",
        )
        self.assertEqual(r2sonic_host.numbers("AIH0=0x118,AIB0=30"), {"AIH0": 280, "AIB0": 30.0})
        with self.assertRaises(ValueError):
            r2sonic_host.numbers("RANGE=30")

    def test_discovery_and_configuration_layout(self):
        asked = control.discovery("10.0.1.102", 65400)
        self.assertEqual((len(asked), asked[:12].hex()), (44, "523244440a000166ff780000"))
        sent = control.configuration(
            "100017",
            9,
            ("10.0.1.102", 65400),
            [("10.0.0.86", 65500)],
            [("10.0.0.99", 65501)],
            [("10.0.1.102", 4100)],
        )
        self.assertEqual(len(sent), 164)
        found = {
            at: struct.unpack_from(">I" if at in (16, 20, 28, 36, 60, 84) else ">H", sent, at)[0]
            for at in (16, 20, 28, 32, 36, 52, 60, 76, 84, 116)
        }
        self.assertEqual(
            found,
            {
                16: 9,
                20: 0xFF000000,
                28: 0x0A000166,
                32: 65400,
                36: 0x0A000056,
                52: 65500,
                60: 0x0A000063,
                76: 65501,
                84: 0x0A000166,
                116: 4100,
            },
        )

    def test_status_sections_have_as_many_words_as_their_last_character_says(self):
        body = b"SER3" + b"100117".ljust(12, b"\0") + b"SENa" + bytes(40) + b"ADC3" + bytes(12)
        (event,) = Reader().datagram(2, b"STH0" + struct.pack(">II", len(body) + 12, 0) + body)
        self.assertEqual(
            (event["SER3"], event["sections"], event["faults"]), ("100117", ["ADC3", "SENa", "SER3"], [])
        )
        self.assertTrue(control.read_status(b"STH0" + struct.pack(">II", 20, 0) + b"SER3\0\0\0\0")[1])

    def test_a_host_on_real_sockets(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as device:
            device.bind(("127.0.0.1", 0))
            port = device.getsockname()[1]
            base = next(b for b in range(42000, 60000, 10) if self.free(b))
            host = r2sonic_host.Host(("127.0.0.1", base), ("127.0.0.1", port - 2))
            host.send_commands({"RNG0": 30})
            self.assertEqual(device.recv(100), control.command({"RNG0": 30}))
            device.sendto(equi_angle(), ("127.0.0.1", base))
            device.sendto(
                b"R2DS" + b"100017".ljust(12, b"\0") + struct.pack(">II", 5, 0), ("127.0.0.1", base + 2)
            )
            events = []
            while len(events) < 2:
                events += host.poll(5) or [{"event": "none"}] * 2
            self.assertEqual(sorted(e["event"] for e in events), ["R2DS", "ping"])
            host.close()

    @staticmethod
    def free(base):
        try:
            r2sonic_host.Host(("127.0.0.1", base)).close()
            return True
        except OSError:
            return False
