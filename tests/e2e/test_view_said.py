"""Pictures that the page of a run reads back from what sonars say to drivers of another make: the floor is at its range in
each. The sonars that ask for no driver, or for one request alone, are in test_view_capture.py."""

import asyncio
import contextlib
import re
import socket
import threading
import unittest

import websockets

from ports import free_port
from program import Emulator
from test_view_capture import loudest_range, picture

import cerulean_wire
import norbit_host
import reson_host
import reson_wire
import surveyor_host

DEPTH = 8.0  # m, of the floor below the head
FLAT = """
scene: {scenes}/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - {name: sonar, model: %s, mount: {rpy_deg: [0, 90, 0]}, endpoints: [%s]%s}
"""
LINK = re.compile(r"http://(127\.0\.0\.1:\d+)/#([0-9a-f]{32})")


def drain(*connections):
    """Reads on, as a driver does, until the run ends."""

    def read(one):
        with contextlib.suppress(OSError):
            while one.recv(65536):
                pass

    for one in connections:
        one.settimeout(None)
        threading.Thread(target=read, args=(one,), daemon=True).start()


class Said(unittest.TestCase):
    def start(self, model, ports, options=""):
        places = ", ".join(f'"tcp-listen://127.0.0.1:{port}"' for port in ports)
        self.emulator = Emulator(FLAT % (model, places, f", options: {{{options}}}" if options else ""), "--view")
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def said(self, *names):
        """{name of the message: (head, levels, ranges)}, of the third ping or a later one."""

        async def look():
            host, token = LINK.search(self.emulator.output).groups()
            found = {}
            async with websockets.connect(f"ws://{host}/news", subprotocols=["echoloop.view", token], max_size=None) as viewer:
                while set(names) - set(found):
                    message = await viewer.recv()
                    if not isinstance(message, bytes) or b'"type":"said"' not in message[:60]:
                        continue
                    head, levels, ranges = picture(message)
                    gain_has_settled = head["number"] > 2
                    if gain_has_settled and (any(levels) or any(ranges)):
                        found[head["name"]] = head, levels, ranges
            return found

        return asyncio.run(asyncio.wait_for(look(), 60))

    def check_floor(self, head, levels, ranges, along=1.0):
        """`along`: of the beams' way to the depth."""
        middle = min(range(head["beams"]), key=lambda b: abs(head["bearings"][b] + head["pan"]))
        if ranges:
            self.assertAlmostEqual(ranges[middle], DEPTH * along, delta=0.1)
        if levels and any(levels):
            self.assertAlmostEqual(loudest_range(head, levels, middle), DEPTH * along, delta=0.15)

    def check(self, *names):
        for name, one in self.said(*names).items():
            with self.subTest(name):
                self.check_floor(*one)

    def test_norbits_soundings_and_water_column(self):
        ports = [free_port() for _ in range(3)]
        self.start("norbit-wbms", ports)
        line = norbit_host.Line(ports[0])
        self.addCleanup(line.close)
        streams = [norbit_host.Stream(port, kind + 1) for kind, port in enumerate(ports[1:])]
        for command in ("set_power 1", "set_gate_mode 0", "set_range .5 30", "set_time_source 1"):
            line.set(command)
        for stream in streams:
            self.addCleanup(stream.close)
        drain(*(stream.socket for stream in streams))
        self.check("Bathymetry", "WaterColumn")

    def test_a_7k_sonars_soundings(self):
        ports = [free_port()]
        self.start("reson-7k", ports, "range: 40, max_ping_rate: 10, swath: 130")
        host = reson_host.Host(("127.0.0.1", ports[0]))
        self.addCleanup(host.close)
        self.assertEqual(host.subscribe(reson_wire.SETTINGS, reson_wire.DETECTIONS), 0)
        drain(host.socket)
        self.check("RawDetections")

    def test_a_surveyors_points(self):
        ports = [free_port()]
        self.start("surveyor240", ports, "acknowledge: true")
        host = surveyor_host.Host(ports[0])
        self.addCleanup(host.close)
        host.set()
        drain(host.socket)
        self.check("AtofPointData")

    def test_an_s500s_profile_and_depth(self):
        ports = [free_port()]
        self.start("s500", ports)
        with socket.create_connection(("127.0.0.1", ports[0]), timeout=20) as host:
            host.sendall(cerulean_wire.s500_ping_params(length_mm=20000, msec_per_ping=60))
            drain(host)
            self.check("Profile6")


if __name__ == "__main__":
    unittest.main()
