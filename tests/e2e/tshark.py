"""Debian's tshark with the dissector that the program makes: what it shows of a capture, as Python values."""
import os
import re
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from program import PROGRAM

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from captures import ETHERNET, RTAC_SERIAL, Pcapng, ethernet, ipv4, rtac, tcp  # noqa: E402,F401

# The kernel picks a driver's own port, and may pick one that tshark takes for another protocol's.
BY_BYTES_FIRST = ("-o", "tcp.try_heuristic_first:TRUE", "-o", "udp.try_heuristic_first:TRUE")


# From Wireshark 4.4 on, root's scripts are not run.
UNPRIVILEGED = {"user": "nobody", "group": "nogroup", "extra_groups": [],
                "env": {**os.environ, "HOME": "/nonexistent"}} if os.geteuid() == 0 else {}


def write_dissector(folder):
    os.chmod(folder, 0o755)
    script = Path(folder) / "echoloop.lua"
    subprocess.run([PROGRAM, "dissector", "--out", str(script)], check=True)
    return script


def run_tshark(script, capture, *arguments):
    """Standard output; fails with what Lua says, if it says anything."""
    os.chmod(capture, 0o644)
    done = subprocess.run(["tshark", "-n", "-X", f"lua_script:{script}", "-r", str(capture), *arguments],
                          capture_output=True, check=True, timeout=300, **UNPRIVILEGED)
    said = done.stderr.decode().strip()
    if said:
        raise AssertionError(said)
    return done.stdout.decode()


def registered(script, what):
    """Rows of a report of tshark about itself, "fields" or "decodes"."""
    done = subprocess.run(["tshark", "-G", what, "-X", f"lua_script:{script}"], capture_output=True, check=True, timeout=300,
                          **UNPRIVILEGED)
    return [line.split("\t") for line in done.stdout.decode().splitlines()]


def assigned_ports():
    """UDP and TCP ports of which tshark believes by itself to know what goes over them."""
    done = subprocess.run(["tshark", "-G", "decodes"], capture_output=True, check=True, timeout=300)
    rows = [line.split("\t") for line in done.stdout.decode().splitlines()]
    return {int(row[1]) for row in rows if row[0] in ("udp.port", "tcp.port")}


def leaf_of(name):
    """The last word of a field's name, without the number of an element."""
    return re.sub(r"\[\d+\]", "", name).split(".")[-1]


def number(text):
    """The number that a text begins with; None if it is none."""
    word = text.split(" ")[0]
    if re.fullmatch(r"0x[0-9a-fA-F]+", word):
        return int(word, 16)
    try:
        return float(word)
    except ValueError:
        return None


def is_near(a, b):
    """tshark prints six digits of a 32-bit float."""
    return a == b or abs(a - b) <= 1e-5 * max(abs(a), abs(b)) or (a != a and b != b)


def holds_number(packet, leaf, wanted):
    return any(got is not None and is_near(wanted, got) for got in map(number, packet.all(leaf)))


class Shown:
    """One packet: `fields` are (name without "sonar.", value as text) in order, `faults` what the dissector objects to."""

    def __init__(self, packet):
        self.fields, self.faults, self.by_leaf = [], [], {}
        self.protocols = [proto.get("name") for proto in packet.iter("proto")]
        for field in packet.iter("field"):
            name = field.get("name")
            if name == "_ws.expert" and any(sub.get("name") == "sonar.fault" for sub in field):
                self.faults.append(field.get("showname"))
            elif "Lua Error" in (field.get("showname") or "") + (field.get("show") or ""):
                self.faults.append(field.get("show"))
            elif name.startswith("sonar."):
                self.fields.append((name[len("sonar."):], field.get("show"), field.get("value")))
        self.faults += [name for name in self.protocols if name == "_ws.malformed"]

    @classmethod
    def joined(cls, packets):
        """All packets as one."""
        out = cls(ElementTree.Element("packet"))
        for packet in packets:
            out.fields += packet.fields
            out.faults += packet.faults
        return out

    def all(self, name):
        """Values of a field, named in full ("seanet.HeadData.bearing") or by its last word ("bearing")."""
        return [show for full, show, _ in self._named(name)]

    def bytes(self, name):
        return [bytes.fromhex(value) for _, _, value in self._named(name) if value]

    def _named(self, name):
        if not self.by_leaf:
            for field in self.fields:
                self.by_leaf.setdefault(field[0].split(".")[-1], []).append(field)
        found = self.by_leaf.get(name.split(".")[-1], [])
        return [field for field in found if field[0] == name or field[0].endswith("." + name)]



def shown(script, capture, *arguments):
    text = run_tshark(script, capture, "-T", "pdml", *arguments)
    text = re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f]", "?", text)
    return [Shown(packet) for packet in ElementTree.fromstring(text).iter("packet")]


def has_tshark():
    return shutil.which("tshark") is not None


def udp(payload, ports):
    return struct.pack(">HHHH", *ports, len(payload) + 8, 0) + payload


class Capture(Pcapng):
    """A capture of packets of all kinds, each a millisecond after the one before; `count` of them so far."""

    def __init__(self):
        super().__init__()
        self.interface(ETHERNET, b"eth")
        self.count, self.lines, self.sequences = 0, {}, {}

    def add(self, interface, data):
        self.count += 1
        self.packet(interface, data, self.count * 10**6)
        return self

    def udp(self, payload, ports):
        return self.add(0, ethernet(ipv4(udp(payload, ports))))

    def tcp(self, payload, ports):
        """What comes next from the first port to the second; a connection begins by itself."""
        if ports not in self.sequences:
            self.sequences[ports] = 1001
            self.add(0, ethernet(ipv4(tcp(b"", 1000, 0x02, ports), protocol=6)))
        sequence = self.sequences[ports]
        self.sequences[ports] += len(payload)
        return self.add(0, ethernet(ipv4(tcp(payload, sequence, 0x18, ports), protocol=6)))

    def serial(self, payload, line=0, sent=True):
        if line not in self.lines:
            self.interface(RTAC_SERIAL, b"line %d" % line)
            self.lines[line] = len(self.lines) + 1
        return self.add(self.lines[line], rtac(payload, 1 if sent else 2, 1000 + self.count))
