"""Debian's tshark on a recording of the running program: a device of every family, each on a port that is not its usual
one. Every field that `echoloop inspect` reads there is a named field in tshark, with the same value, and some are what
Python finds at offsets of the specifications."""
import contextlib
import json
import os
import select
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import tty
import unittest
from pathlib import Path

import tshark
from ports import free_port
from program import PROGRAM, ROOT, Emulator

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
import oculus_wire  # noqa: E402
from reson_host import Host as ResonHost  # noqa: E402

LOOKS_DOWN = "mount: {rpy_deg: [0, 90, 0]}"
SEND_VERSION = bytes.fromhex("40303030380800ff02031780020a")
SCENARIO = """
scene: {scenes}/flat.glb
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - {name: micron, model: tritech-micron, endpoints: ["pty:{folder}/micron"], options: {first_alive: 0.1}}
  - {name: imagenex, model: imagenex-881a, endpoints: ["pty:{folder}/imagenex"]}
  - {name: altimeter, model: micron-echosounder, DOWN, endpoints: ["pty:{folder}/altimeter"]}
  - {name: ping360, model: ping360, endpoints: ["udp-listen://127.0.0.1:PORT0"]}
  - {name: nmea, model: nmea-echosounder, DOWN, endpoints: ["udp://127.0.0.1:PORT1"]}
  - {name: r2sonic, model: r2sonic-2024, DOWN, endpoints: ["udp-listen://127.0.0.1:PORT16", "udp://127.0.0.1:PORT2"]}
  - {name: deltat, model: imagenex-deltat, DOWN, endpoints: ["udp://127.0.0.1:PORT24"]}
  - {name: kmall, model: kongsberg-kmall, DOWN, endpoints: ["udp-listen://127.0.0.1:PORT25", "udp://127.0.0.1:PORT26"]}
  - {name: sonar3d, model: sonar-3d-15, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP0", "udp://127.0.0.1:PORT27"], options: {acoustics: true}}
  - {name: aris, model: aris-1800, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP1", "udp://127.255.255.255:PORT28"]}
  - {name: norbit, model: norbit-wbms, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP2", "tcp-listen://127.0.0.1:TCP3", "tcp-listen://127.0.0.1:TCP4"]}
  - {name: oculus, model: oculus-m750d, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP5", "udp://127.255.255.255:PORT29"]}
  - {name: reson, model: reson-7k, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP6"]}
  - {name: s500, model: s500, DOWN, endpoints: ["tcp-listen://127.0.0.1:TCP7"]}
  - {name: dvl, model: dvl-a50, endpoints: ["tcp-listen://127.0.0.1:TCP8", "pty:{folder}/dvl"]}
""".replace("DOWN", LOOKS_DOWN)
FAMILIES = {"seanet", "imagenex", "altimeter", "ping", "nmea", "r2sonic", "deltat", "kmall", "sonar3d", "aris", "norbit",
            "oculus", "reson7k", "cerulean", "waterlinked"}
LISTENERS = {"nmea": 1, "r2sonic": 2, "deltat": 24, "kmall": 26, "sonar3d": 27, "aris": 28, "oculus": 29}


def golden(name):
    lines = (ROOT / "tests" / "data" / f"{name}.hex").read_text().splitlines()
    return bytes.fromhex("".join(line.split("#")[0] for line in lines if not line.startswith(("message", "field"))))


def read_until(descriptor, wanted, least=1):
    """Bytes of a line or a stream up to those that hold `wanted` and `least` bytes behind it."""
    heard = b""
    while wanted not in heard or len(heard) < heard.index(wanted) + least:
        if not select.select([descriptor], [], [], 30)[0]:
            raise TimeoutError(f"{wanted} has not come; {len(heard)} bytes have: {heard[:40].hex()}")
        heard += os.read(descriptor, 65536)
    return heard


class Live(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.closing = contextlib.ExitStack()
        cls.addClassCleanup(cls.closing.close)
        taken = tshark.assigned_ports()
        base, tcp = free_port(32, taken), [free_port(1, taken) for _ in range(9)]
        text = SCENARIO
        for number in range(31, -1, -1):
            text = text.replace(f"PORT{number}", str(base + number))
        for number, port in enumerate(tcp):
            text = text.replace(f"TCP{number}", str(port))
        listeners = {name: cls.listener(base + offset) for name, offset in LISTENERS.items()}
        cls.record(text, base, tcp, listeners)
        cls.script = tshark.write_dissector(cls.folder)
        cls.packets = tshark.shown(cls.script, cls.file, "-o", "sonar.elements:10000", *tshark.BY_BYTES_FIRST)
        done = subprocess.run([PROGRAM, "inspect", str(cls.file), "--json"], capture_output=True, check=True)
        cls.messages = json.loads(done.stdout)["messages"]

    @classmethod
    def listener(cls, port):
        one = cls.closing.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        one.bind(("", port))
        one.settimeout(15)
        return one

    @classmethod
    def record(cls, text, base, tcp, listeners):
        """Says a word to each device and waits until it has answered."""
        cls.folder = Path(cls.closing.enter_context(tempfile.TemporaryDirectory(prefix="echoloop-live-")))
        cls.file = cls.folder / "capture.pcapng"
        with Emulator(text, "--record", str(cls.file)) as emulator, contextlib.ExitStack() as lines:
            def line(name, words, wanted, least=1):
                descriptor = os.open(emulator.folder / name, os.O_RDWR | os.O_NOCTTY)
                lines.callback(os.close, descriptor)
                tty.setraw(descriptor, termios.TCSANOW)
                os.write(descriptor, words)
                read_until(descriptor, wanted, least)

            def stream(port, words, wanted=b"", least=1):
                connection = lines.enter_context(socket.create_connection(("127.0.0.1", port), timeout=20))
                connection.sendall(words)
                if wanted:
                    read_until(connection.fileno(), wanted, least)

            line("micron", SEND_VERSION, b"\n", 40)
            line("imagenex", golden("imagenex/switch_command"), b"IGX", 513)
            line("altimeter", b"", b"m\r\n")
            ping360 = cls.listener(0)
            ping360.sendto(golden("ping/transducer"), ("127.0.0.1", base))
            while struct.unpack("<H", ping360.recv(65536)[4:6])[0] != 2300:
                pass
            for command in ("set_power 1",):
                stream(tcp[2], command.encode())
            stream(tcp[3], b"", b"\xef\xbe\xad\xde", 1000)
            stream(tcp[5], oculus_wire.fire(), b"SO", 60000)
            stream(tcp[1], golden("aris/ping"))
            stream(tcp[7], golden("cerulean/s500_ping_params"), b"BR", 200)
            stream(tcp[8], golden("waterlinked/command"), b'"type":"velocity"', 200)
            host = ResonHost(("127.0.0.1", tcp[6]))
            lines.callback(host.close)
            host.subscribe(7000, 7004, 7027)
            host.wait(7027, 30)
            for name, one in listeners.items():
                try:
                    one.recv(65536)
                except TimeoutError as error:
                    raise TimeoutError(f"nothing from {name}") from error
            # Last: it talks on, and a line that nobody reads is full after some seconds and loses bytes.
            line("dvl", b"wcv*fe\r\n", b"wru,3", 20)
            status, output = emulator.stop()
        assert status == 0, output

    def test_every_family_is_there_and_nothing_is_at_fault(self):
        seen = {name.split(".")[0] for packet in self.packets for name, _, _ in packet.fields}
        self.assertEqual(seen, FAMILIES)
        for number, packet in enumerate(self.packets, 1):
            self.assertEqual(packet.faults, [], f"packet {number}: {packet.protocols}")

    def test_tshark_and_inspect_read_the_same_numbers(self):
        compared = {}
        for message in self.messages:
            if not message["name"]:
                continue
            fields = self.packets[message["packet"] - 1]
            for field in message["fields"]:
                leaf = tshark.leaf_of(field["name"])
                value = field["value"]
                is_absent = value == 0 and message["family"] in ("aris", "sonar3d")  # protobuf sends no zeros
                if is_absent or not isinstance(value, (int, float)):
                    continue
                place = f"{message['family']} {message['name']} {field['name']} in packet {message['packet']}"
                if not tshark.holds_number(fields, leaf, value):
                    self.fail(f"{place}: {value} is not in {fields.all(leaf)[:8]}")
                compared[message["family"]] = compared.get(message["family"], 0) + 1
        self.assertEqual(set(compared), FAMILIES)

    def test_values_at_offsets_of_the_specifications(self):
        """Each read from the packet's own bytes, as the makers' documents place them."""
        checks = (("BTH0", "udp.payload", "r2sonic.H0.sound_speed", ">f", 12 + 44), ("83P", "udp.payload", "deltat.83P.samples", ">H", 72),
                  ("#MRZ", "udp.payload", "kmall.Header.sounder", "<H", 10))
        for sign, _, field, form, at in checks:
            with self.subTest(field):
                payload = next(p for p in self.payloads() if sign.encode() in p[:8])
                packets = [packet for packet in self.packets if packet.all(field)]
                wanted = struct.unpack(form, payload[at:at + struct.calcsize(form)])[0]
                self.assertAlmostEqual(float(packets[0].all(field)[0]), wanted, delta=1e-5 * abs(wanted))

    def payloads(self):
        text = tshark.run_tshark(self.script, self.file, "-Y", "udp", "-T", "fields", "-e", "udp.payload")
        return [bytes.fromhex(line) for line in text.split()]


if __name__ == "__main__":
    unittest.main()
