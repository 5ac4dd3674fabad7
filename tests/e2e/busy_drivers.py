"""Drivers of the twelve sonars of config/busy.yaml, each in a thread of its own: they ask as real ones do, count what
comes, and look no further into it than a driver must to know that nothing is missing."""

import json
import re
import socket
import struct
import threading

import program  # noqa: F401: puts tests/hosts where Python looks
from ports import free_port

import imagenex_wire
import norbit_host
import oculus_host
import ping360_host
import seanet_host
from byte_line import open_line
from imagenex_host import Host as ImagenexHost
from seanet_handshakes import HANDSHAKES
from seanet_session import Session
from seanet_styles import Settings


class Driver(threading.Thread):
    """`got` counts pings from the first one on. `fault` says why it ended early."""

    def __init__(self, name):
        super().__init__(name=name, daemon=True)
        self.got, self.fault, self.ended = 0, None, False

    def endpoints(self):
        """For the scenario; {folder} is filled in."""
        return [f"pty:{{folder}}/{self.name}"]

    def line(self):
        return open_line(str(self.folder / self.name))

    def begin(self, folder):
        self.folder = folder
        self.start()

    def run(self):
        try:
            self.work()
        except Exception as error:  # of any kind: the run says what became of each driver
            if not self.ended:
                self.fault = f"{type(error).__name__}: {error}"

    def end(self):
        """The run is about to end: what breaks from here on is no fault."""
        self.ended = True


class R2Sonic(Driver):
    """Listens: numbers of pings must follow each other, and no image may lack a part."""

    PING, PART_SIZE = 48, struct.Struct(">IIIHHHHHH")

    def __init__(self, name, image):
        super().__init__(name)
        self.image, self.sockets = image, []
        self.gui, self.head = free_port(8), free_port(8)

    def endpoints(self):
        return [f"udp-listen://127.0.0.1:{self.head}", f"udp://127.0.0.1:{self.gui}"]

    def begin(self, folder):
        for offset in (0, 2, 3):
            s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
            s.bind(("127.0.0.1", self.gui + offset))
            s.settimeout(10)
            self.sockets.append(s)
        super().begin(folder)

    def work(self):
        if self.image:
            threading.Thread(target=self.drain, args=(self.sockets[2],), daemon=True).start()
        last = None
        while True:
            data = self.sockets[0].recv(65536)
            assert data[:4] == b"BTH0" and struct.unpack_from(">I", data, 4)[0] == len(data)
            (ping,) = struct.unpack_from(">I", data, self.PING)
            assert last in (None, ping - 1), f"ping {ping} after {last}"
            last, self.got = ping, self.got + 1

    def drain(self, port):
        try:
            while True:
                assert port.recv(65536)[:4] == b"AID0"
        except Exception as error:
            self.fault = self.fault or (None if self.ended else f"image: {error}")


class Oculus(Driver):
    def __init__(self, name):
        super().__init__(name)
        self.tcp, self.status = free_port(), free_port(8)

    def endpoints(self):
        return [f"tcp-listen://127.0.0.1:{self.tcp}", f"udp://127.255.255.255:{self.status}"]

    def begin(self, folder):
        self.host = oculus_host.Host(self.status, self.tcp)
        super().begin(folder)

    def work(self):
        self.host.wait_status()
        self.host.connect()
        self.host.fire(mode=1, rate=0, range=20.0, flags=0x4D)  # 10 Hz, metres, gain words, 512 beams
        while True:
            header, data = self.host.message(10)
            if header["id"] == oculus_host.wire.RESULT:
                self.got += 1
                if self.got % 50 == 1:  # whole: Python takes its time over it
                    faults = oculus_host.wire.read_result(data)[1]
                    assert not faults, faults


class Norbit(Driver):
    START = ("set_tp_rate 60", "set_power 1", "set_gate_mode 0", "set_range 0.5 25", "set_rate 10")  # an image every ping

    def __init__(self, name):
        super().__init__(name)
        self.ports = [free_port() for _ in range(3)]

    def endpoints(self):
        return [f"tcp-listen://127.0.0.1:{port}" for port in self.ports]

    def work(self):
        line = norbit_host.Line(self.ports[0])
        streams = [norbit_host.Stream(port, kind) for port, kind in zip(self.ports[1:], (1, 2))]
        for command in self.START:
            line.set(command)
        threading.Thread(target=self.drain, args=(streams[1],), daemon=True).start()
        last = None
        while True:
            ping = streams[0].next()
            assert last in (None, ping.ping - 1), f"ping {ping.ping} after {last}"
            last, self.got = ping.ping, self.got + 1

    def drain(self, stream):
        last = None
        try:
            while True:
                number = int.from_bytes(stream.packet()[108:112], "little")
                assert last in (None, number - 1), f"image of ping {number} after {last}"
                last = number
        except Exception as error:
            self.fault = self.fault or (None if self.ended else f"water column: {error}")


class SeaNet(Driver):
    def __init__(self, name, style, profile="dst", **settings):
        super().__init__(name)
        self.style, self.profile, self.settings = style, profile, Settings(**settings)

    def work(self):
        session = Session(self.line(), self.style, self.settings, self.profile, limit=1e9)
        HANDSHAKES[self.style](session)
        while True:
            for _ in seanet_host.read_requested(session):
                self.got += 1
            assert session.faults == 0


class Ping360(Driver):
    """Ping by ping over its serial line, 1 gradian on each time; `period` is a sample's, 25 ns."""

    def __init__(self, name, period):
        super().__init__(name)
        self.settings = ping360_host.Settings(samples=600, period=period)

    def work(self):
        line, settings, angle = self.line(), self.settings, 0
        line.write(ping360_host.frame(ping360_host.GENERAL_REQUEST, struct.pack("<H", 4)))
        self.frame(line)
        while True:
            fields = struct.pack("<BBHHHHHBB", 0, settings.gain, angle, *settings[1:], 1, 0)
            line.write(ping360_host.frame(ping360_host.TRANSDUCER, fields))
            ping = ping360_host.ping_of(ping360_host.parse(self.frame(line)))
            assert ping.angle == angle, f"{ping.angle} for {angle}"
            angle, self.got = (angle + 1) % 400, self.got + 1

    @staticmethod
    def frame(line):
        """The next one's bytes."""
        data = b""
        while len(data) < 10 or len(data) < 10 + struct.unpack_from("<H", data, 2)[0]:
            piece = line.read(5)
            assert piece, f"silence after {len(data)} bytes"
            data += piece
        return data


class Imagenex(Driver):
    def __init__(self, name, **settings):
        super().__init__(name)
        self.command = imagenex_wire.command(**settings)

    def work(self):
        host = ImagenexHost(self.line())
        while True:
            host.ask(self.command)
            self.got += 1


def with_endpoints(text, drivers):
    """config/busy.yaml with the drivers' own ports and lines, so that it can run beside other programs."""
    for driver in drivers:
        pattern = rf"(name: {driver.name}\n.*\n.*\n.*endpoints: )\[.*\]"
        text, found = re.subn(pattern, lambda m: m.group(1) + json.dumps(driver.endpoints()), text)
        assert found == 1, f"{driver.name} in config/busy.yaml"
    return text.replace("scenes/", "{scenes}/")


def fleet():
    """By the names of config/busy.yaml."""
    return [
        R2Sonic("bathymetry", image=False),
        R2Sonic("forward", image=True),
        Oculus("oculus"),
        Norbit("norbit"),
        SeaNet("micron", "mcgill", range=20.0, bins=400),
        SeaNet("micron2", "hostB", range=30.0, bins=300),
        SeaNet("micron3", "mcgill", range=10.0, bins=200, step=16),
        SeaNet("seaking", "hostC", "miniking", range=20.0, bins=400),
        Ping360("ping360", period=444),
        Ping360("ping360b", period=1777),
        Imagenex("imagenex", range=10, points=25),
        Imagenex("imagenex2", range=20, step=8),
    ]
