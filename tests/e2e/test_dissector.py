"""`echoloop dissector`: Debian's tshark reads every family down to named fields, with values that were not read by the
program's own codecs: those that the golden files state, and what Python finds at offsets of the specifications."""
import json
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path
from random import Random

import tshark
from program import PROGRAM, ROOT
from tshark import number

DATA = ROOT / "tests" / "data"
SCRIPT = subprocess.run([PROGRAM, "dissector"], capture_output=True, text=True, check=True).stdout
PLACES = dict(re.findall(r'^sonar\.add_family\("(\w+)", ".*", \{(.*)\}\)$', SCRIPT, re.M))
FAMILIES = sorted(PLACES)
SERIAL = tuple(family for family in FAMILIES if "serial=true" in PLACES[family])


def first_ports(transport):
    """Of each family that has some."""
    ports = {family: re.search(rf'\b{transport}="(\d+)', PLACES[family]) for family in FAMILIES}
    return {family: int(match[1]) for family, match in ports.items() if match}


UDP_PORTS, TCP_PORTS = first_ports("udp"), first_ports("tcp")

TEXT_ENDPOINTS = ("tcp-listen://127.0.0.1:2209", "tcp-listen://127.0.0.1:8080")  # text commands; HTTP
PROTOBUF = ("aris", "sonar3d")  # fields that are 0 are not sent
# What has no table has a place of its own in the dissector.
OTHER_NAMES = {("kmall", "bytes"): "part",
               ("r2sonic", "XYZ0"): "Command.raw", ("r2sonic", "QQQ2"): "unknown"}
OTHER_WORDS = {(family, "checksum"): lambda digits: digits if digits.startswith("0x") else "0x" + digits
               for family in ("nmea", "waterlinked", "nortek")}


class Golden:
    """A golden file: bytes with the message's name and the fields that its author read in the specification."""

    def __init__(self, path):
        self.name, self.family = path.stem, path.parent.name
        self.message, self.fields, data = "", [], ""
        for line in path.read_text().splitlines():
            line = line.split("#")[0].rstrip()
            if line.startswith("message "):
                self.message = line[8:]
            elif line.startswith("field "):
                self.fields.append(line[6:].split(" ", 1))
            else:
                data += line
        self.bytes = bytes.fromhex(data)


def golden(family):
    return [Golden(path) for path in sorted((DATA / family).glob("*.hex"))]


def is_same(expected, got):
    a, b = number(expected), number(got)
    if a is None or b is None:
        return expected.strip() == got.strip()
    return tshark.is_near(a, b)


def holds(packet, leaf, wanted):
    """Whether the elements of an array, or its bytes, are among the packet's."""
    got = [number(one) for one in packet.all(leaf)]
    blocks = [list(block) for block in packet.bytes(leaf)]
    for block in packet.bytes(leaf):  # which numbers the bytes are the golden file's author knew
        for size, order, letter in ((1, "<", "b"), (2, "<", "h"), (4, ">", "I")):
            if len(block) % size == 0:
                blocks.append(list(struct.unpack(f"{order}{len(block) // size}{letter}", block)))
    runs = [got[at:at + len(wanted)] for at in range(len(got))] + [block[:len(wanted)] for block in blocks]
    return any(run == wanted for run in runs)


def add_golden(capture, item, number):
    """Adds the message as it travels, to its usual port or on a serial line, apart from all other messages."""
    if item.family in SERIAL:
        capture.serial(item.bytes, number)
    elif item.family not in UDP_PORTS or (item.family == "aris" and item.bytes[:2] == b"\0\0"):
        capture.tcp(item.bytes, (20000 + number, TCP_PORTS[item.family]))
    else:
        capture.udp(item.bytes, (20000 + number, UDP_PORTS[item.family]))


class WithDissector(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="echoloop-dissector-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.script = tshark.write_dissector(cls.folder)

    def shown(self, capture, *arguments):
        file = self.folder / "capture.pcapng"
        file.write_bytes(capture.data)
        return tshark.shown(self.script, file, *arguments)

    def check_golden(self, item, packet):
        self.assertEqual(packet.faults, [])
        self.assertTrue(packet.fields, packet.protocols)
        for path, expected in item.fields:
            self.check_stated(item, packet, path, expected)

    def check_stated(self, item, packet, path, expected):
        expected = OTHER_WORDS.get((item.family, path), str)(expected)
        path = OTHER_NAMES.get((item.family, path), path)
        is_absent = item.family in PROTOBUF and number(expected) == 0 or expected == "null"
        if not is_absent:
            self.check_field(packet, path, expected)

    def check_field(self, packet, path, expected):
        leaf = tshark.leaf_of(path)
        leaf = "field" if re.fullmatch(r"field\d+", leaf) else leaf
        if expected.startswith("["):
            wanted = [number(one) for one in expected.split(" ")[1:] if one != "..."]
            self.assertTrue(holds(packet, leaf, wanted), f"{path}: {expected} is not in {packet.all(leaf)}")
        else:
            got = packet.all(leaf)
            self.assertTrue(any(is_same(expected, one) for one in got), f"{path}: {expected} is not in {got}")


class GoldenBytes(WithDissector):
    def test_golden_bytes_of_every_family(self):
        capture, places = tshark.Capture(), {}
        for family in FAMILIES:
            for item in golden(family):
                add_golden(capture, item, len(places))
                places[item] = capture.count - 1
        packets = self.shown(capture)
        for item, place in places.items():
            with self.subTest(f"{item.family} {item.name}"):
                self.check_golden(item, packets[place])


class Streams(WithDissector):
    """How messages are cut out of what travels."""

    def test_a_serial_message_in_many_packets_with_the_other_direction_between(self):
        for family in SERIAL:
            capture = tshark.Capture()
            items = golden(family)
            line = b"".join(item.bytes for item in items)
            for at in range(0, len(line), 7):
                capture.serial(line[at:at + 7], 0, True)
                capture.serial(items[0].bytes[:3] if at == 0 else b"\xff", 0, False)
            with self.subTest(family):
                packets = self.shown(capture)
                self.check_all(packets, items)

    def check_all(self, packets, items):
        everything = tshark.Shown.joined(packets)
        self.assertEqual([one for one in everything.faults if "Lua" in one], [])
        for item in items:
            for path, expected in item.fields:
                self.check_stated(item, everything, path, expected)

    def test_messages_in_pieces_of_a_connection(self):
        for family, port in TCP_PORTS.items():
            items = [item for item in golden(family) if family != "aris" or item.bytes[:2] == b"\0\0"]
            capture = tshark.Capture()
            stream = b"".join(item.bytes for item in items)
            for at in range(0, len(stream), 301):
                capture.tcp(stream[at:at + 301], (port, 40001))
            with self.subTest(family):
                self.check_all(self.shown(capture), items)

    def test_pieces_of_a_message_in_several_datagrams(self):
        item = next(item for item in golden("cerulean") if item.name == "os_mono_profile")
        capture = tshark.Capture()
        for at in range(0, len(item.bytes), 30):
            capture.udp(item.bytes[at:at + 30], (51200, 40001))
        packets = self.shown(capture)
        self.assertEqual(packets[0].all("ping_number"), [])
        self.check_golden(item, packets[-1])

    def test_other_ports_are_recognised_by_the_first_bytes(self):
        capture, places = tshark.Capture(), {}
        for family in FAMILIES:
            for item in golden(family):
                if family == "nmea" and b"*" not in item.bytes:
                    continue  # without a checksum a sentence is no sure sign
                ports = (30000 + len(places), 50000 + len(places))
                over_tcp = family not in UDP_PORTS and family in TCP_PORTS or item.bytes[:2] == b"\0\0"
                (capture.tcp if over_tcp else capture.udp)(item.bytes, ports)
                places[item] = capture.count - 1
        packets = self.shown(capture)
        for item, place in places.items():
            with self.subTest(f"{item.family} {item.name}"):
                self.check_golden(item, packets[place])

    def test_bytes_go_before_a_port_of_another_protocol_where_asked(self):
        """44818 is EtherNet/IP's, and the kernel may give it to a driver that connects."""
        item, ports = next(item for item in golden("oculus") if item.name == "fire_v1"), (44818, 30000)
        capture = tshark.Capture().tcp(item.bytes, ports)
        self.check_golden(item, self.shown(capture, *tshark.BY_BYTES_FIRST)[-1])

    def test_noise_before_and_between_messages(self):
        for family in ("seanet", "ping", "imagenex"):
            items = golden(family)
            capture = tshark.Capture()
            for item in items:
                capture.serial(b"\x01\x02@@BRI" + item.bytes)
            with self.subTest(family):
                self.check_all(self.shown(capture), items)


class Faults(WithDissector):
    """What is not as the protocol has it is said; nothing breaks the dissector."""

    def test_a_wrong_checksum_is_a_fault(self):
        capture = tshark.Capture()
        wrong = []
        for family, name, at in (("norbit", "bathymetry", -1), ("sonar3d", "range_rip1", -1), ("reson7k", "settings", 90)):
            item = next(item for item in golden(family) if item.name == name)
            damaged = bytearray(item.bytes)
            damaged[at] ^= 1
            item.bytes = bytes(damaged)
            add_golden(capture, item, len(wrong))
            wrong.append(capture.count - 1)
        packets = self.shown(capture)
        for place in wrong:
            self.assertTrue(packets[place].faults, place)

    def test_damaged_messages_break_nothing(self):
        random = Random(6)
        capture = tshark.Capture()
        for family in FAMILIES:
            for item in golden(family):
                whole = item.bytes
                for _ in range(4):
                    data = bytearray(whole[:random.randrange(1, len(whole) + 1)])
                    for _ in range(random.randrange(4)):
                        data[random.randrange(len(data))] = random.choice((0, 1, 0x7F, 0x80, 0xFF, random.randrange(256)))
                    item.bytes = bytes(data)
                    add_golden(capture, item, capture.count)
        self.check_quiet(capture)

    def test_random_bytes_break_nothing(self):
        random = Random(7)
        starts = [item.bytes[:random.randrange(1, 40)] for family in FAMILIES for item in golden(family)]
        capture = tshark.Capture()
        for number in range(400):
            data = random.choice(starts) * random.randrange(2) + random.randbytes(random.randrange(1, 200))
            # Of each transport its own: of another one tshark may know the port, and finds faults in what is not its own.
            udp, tcp = (random.choice([*ports.values(), 30000 + number]) for ports in (UDP_PORTS, TCP_PORTS))
            random.choice((lambda: capture.udp(data, (udp, 40001)), lambda: capture.tcp(data, (tcp, 40000 + number % 50)),
                           lambda: capture.serial(data, number % 40, number % 3 == 0)))()
        self.check_quiet(capture)

    def check_quiet(self, capture):
        for passes in ((), ("-2",)):
            packets = self.shown(capture, *passes)
            self.assertEqual(len(packets), capture.count)
            broken = [fault for packet in packets for fault in packet.faults if "Lua" in fault or "_ws" in fault]
            self.assertEqual(broken, [])


class Papers(WithDissector):
    """The fields are those of the tables, and each model is met on its default ports."""

    def test_every_row_of_every_table_is_a_field_with_its_help(self):
        known = {}
        for columns in tshark.registered(self.script, "fields"):
            if columns[0] == "F" and columns[2].startswith("sonar."):
                known[columns[2]] = columns[-1]
        for family in FAMILIES:
            text = (ROOT / "docs" / f"messages-{family}.md").read_text()
            for part in text.split("### ")[1:]:
                table = re.sub(r"[^\w-]", "_", part.splitlines()[0])
                for name, unit, help_text in re.findall(r"^\| \S* \| .* \| `(.+)` \| (.*) \| (.*) \|$", part, re.M):
                    field = f"sonar.{family}.{table}." + re.sub(r"[^\w-]", "_", name)
                    with self.subTest(field):
                        self.assertIn(field, known)
                        words = help_text.split(";")[0].split('"')[0].strip()
                        if not re.match(r"(0x[0-9a-f]+|\d+) ", words):  # names of values are no help
                            self.assertIn(words, known[field])
                        self.assertIn(unit.strip(), known[field])

    def test_every_model_is_met_on_its_default_ports(self):
        decodes = tshark.registered(self.script, "decodes")
        models = json.loads(subprocess.run([PROGRAM, "list", "--json"], capture_output=True, check=True).stdout)["models"]
        for model in models:
            for endpoint in model["default_endpoints"]:
                scheme, _, place = endpoint.partition("://")
                port = place.partition(":")[2]
                if endpoint.startswith("pty:") or endpoint in TEXT_ENDPOINTS:
                    continue
                table = "tcp.port" if scheme.startswith("tcp") else "udp.port"
                owners = [row[2] for row in decodes if row[:2] == [table, port]]
                self.assertTrue(any(owner.startswith("sonar.") for owner in owners), f"{model['name']} {endpoint}: {owners}")

if __name__ == "__main__":
    unittest.main()
