"""Pictures that the page of a run reads back from what sonars say to drivers of another make: the floor is at its range in
each. The sonars that ask for no driver, or for one request alone, are in test_view_capture.py."""

import math
import socket
import unittest

from ports import free_port
from said_case import DEPTH, SaidCase, begins, drain
from test_view_capture import loudest_range

import aris_host
import cerulean_wire
import norbit_host
import reson_host
import reson_wire
import surveyor_host


class Said(SaidCase):
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

    def test_an_aris_frame(self):
        """In each beam the floor, slanting away to both sides, where the echogram has it."""
        commands, beacon = free_port(), free_port()
        self.start("aris-1800", [commands, f"udp://127.255.255.255:{beacon}"], "temperature: 10")
        host = aris_host.Host(beacon, commands)
        self.addCleanup(host.close)
        host.wait_beacon()
        host.connect()
        host.start()
        settings = {"mode": 3, "rate": 5.0, "samples": 1250, "delay": 2024, "cycle": 20000, "period": 14, "pulse": 20, "gain": 18.0}
        host.next_with(host.acoustics(**settings))  # 1.5 to 14.5 m
        drain(host.frames)
        head, levels, _ = self.said("frame")["frame"]
        heard, heard_levels, _ = self.heard
        self.assertEqual((head["beams"], heard["beams"]), (96, 96))
        self.check_floor(head, levels, ())
        for beam in (5, 30, 65, 90):
            slant = DEPTH / math.cos(head["bearings"][beam])
            self.assertAlmostEqual(head["bearings"][beam], heard["bearings"][beam], delta=math.radians(0.5))
            self.assertAlmostEqual(loudest_range(head, levels, beam), slant, delta=0.2)
            self.assertAlmostEqual(loudest_range(heard, heard_levels, beam), slant, delta=0.2)

    def r2sonic(self, options):
        head = free_port(16)
        data = free_port(8)
        receivers = []
        for port in range(data, data + 8):
            one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            one.bind(("127.0.0.1", port))
            self.addCleanup(one.close)
            receivers.append(one)
        self.start("r2sonic-2024", [f"udp-listen://127.0.0.1:{head}", f"udp://127.0.0.1:{data}"], "ping_rate: 5, range: 20, " + options)
        drain(*receivers)

    def test_an_r2sonics_image_water_column_and_snippets(self):
        """The floor is flat in each: its range grows as 1 / cos of the beam's angle, to either side alike."""
        self.r2sonic("image_height: 400, water_column: magnitude, snippets: true")
        for name, (head, levels, ranges) in self.said("AID0", "WCD0", "SNI0").items():
            with self.subTest(name):
                self.check_floor(head, levels, ranges)
                for bearing in (-40, 40):
                    beam = min(range(head["beams"]), key=lambda b: abs(math.degrees(head["bearings"][b]) - bearing))
                    slant = DEPTH / math.cos(head["bearings"][beam])
                    self.assertAlmostEqual(loudest_range(head, levels, beam), slant, delta=0.25)

    def test_an_r2sonics_truepix_is_water_to_the_depth_on_both_sides(self):
        self.r2sonic("truepix: direction")
        head, levels, _ = self.said("TPX0")["TPX0"]
        self.assertEqual((head["waterfall"], head["beams"]), (True, 2))
        for side in (0, 1):
            self.assertAlmostEqual(begins(head, levels, side, below=15), DEPTH, delta=0.15)


if __name__ == "__main__":
    unittest.main()
