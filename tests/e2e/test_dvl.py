"""The running program as a Water Linked DVL A50, met by hosts of our own: JSON by TCP, the serial protocol, HTTP."""

import json
import math
import os
import socket
import statistics
import time
import unittest
import urllib.request

from ports import free_port
from program import Emulator

SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1490}
vehicle: {trajectory: way.csv}
clock: {mode: scaled, rate: %g}
devices:
  - name: dvl
    model: dvl-a50
    endpoints: ["tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d", "pty:{folder}/dvl"]
    options: {speed_of_sound: 1490%s}
"""
ALTITUDE = 8  # m, of a vehicle 12 m down


def turned(yaw, pitch=0):
    """w x y z of a body that is yawed to port, then pitched nose down; degrees."""
    y, p = math.radians(yaw) / 2, math.radians(pitch) / 2
    return (math.cos(y) * math.cos(p), -math.sin(y) * math.sin(p), math.cos(y) * math.sin(p), math.sin(y) * math.cos(p))


def way(rows):
    """A trajectory of (t, x, y, orientation) at a depth of 12 m."""
    return "t,x,y,z,qw,qx,qy,qz\n" + "".join(
        ",".join(f"{value:.6f}" for value in (t, x, y, -12, *q)) + "\n" for t, x, y, q in rows)


class Dvl:
    """A host by TCP."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.rest = b""

    def line(self):
        while b"\r\n" not in self.rest:
            piece = self.socket.recv(65536)
            if not piece:
                raise RuntimeError("the DVL has hung up")
            self.rest += piece
        line, self.rest = self.rest.split(b"\r\n", 1)
        return json.loads(line)

    def next(self, kind):
        while (report := self.line())["type"] != kind:
            pass
        return report

    def valid(self, count):
        """The next reports with a velocity."""
        reports = []
        while len(reports) < count:
            report = self.next("velocity")
            if report["velocity_valid"]:
                reports.append(report)
        return reports

    def ask(self, command, **parameters):
        self.socket.sendall(json.dumps({"command": command, "parameters": parameters}).encode())
        return self.next("response")


class DvlTest(unittest.TestCase):
    def start(self, rows, rate=1, options=""):
        self.port, self.web = free_port(), free_port()
        emulator = Emulator(SCENARIO % (rate, self.port, self.web, options), files={"way.csv": way(rows)})
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        self.line = emulator.folder / "dvl"
        host = Dvl(self.port)
        self.addCleanup(host.socket.close)
        return host

    def check_velocity(self, reports, expected):
        """Means within three of their own standard deviations and what a bias and a scale may do."""
        for key, value in zip(("vx", "vy", "vz"), expected):
            mean = statistics.mean(report[key] for report in reports)
            noise = max(report["fom"] for report in reports) / math.sqrt(len(reports))
            self.assertAlmostEqual(mean, value, delta=3 * noise + 0.005 * abs(value) + 0.004, msg=key)

    def test_a_vehicle_over_a_flat_floor(self):
        dvl = self.start([(0, 0, 0, turned(30)), (200, 200 * math.cos(math.radians(30)) * 0.9,
                                                   200 * math.sin(math.radians(30)) * 0.9, turned(30))], rate=4)
        dvl.valid(5)
        reports = dvl.valid(40)
        self.check_velocity(reports, (0.9, 0, 0))
        scatter = statistics.stdev(report["vx"] for report in reports)
        self.assertAlmostEqual(scatter / statistics.mean(report["fom"] for report in reports), 1, delta=0.5,
                               msg="the figure of merit tells how far readings scatter")
        altitude = statistics.mean(report["altitude"] for report in reports)
        self.assertAlmostEqual(altitude + 0.015, ALTITUDE, delta=0.005 * ALTITUDE)
        for beam in range(4):
            distance = statistics.mean(report["transducers"][beam]["distance"] for report in reports)
            self.assertAlmostEqual(distance, ALTITUDE / math.cos(math.radians(22.5)), delta=0.08)

    def test_a_pitched_vehicle_is_one_over_a_slope(self):
        pitch = math.radians(10)
        dvl = self.start([(0, 0, 0, turned(0, 10)), (400, 200, 0, turned(0, 10))], rate=4)
        dvl.valid(5)
        reports = dvl.valid(40)
        self.check_velocity(reports, (0.5 * math.cos(pitch), 0, -0.5 * math.sin(pitch)))
        t = math.radians(22.5)
        for ids, sign in (((0, 1), -1), ((2, 3), 1)):  # aft, forward
            down = math.cos(t) * math.cos(pitch) + sign * math.sin(t) * math.sin(math.radians(45)) * math.sin(pitch)
            for beam in ids:
                distance = statistics.mean(report["transducers"][beam]["distance"] for report in reports)
                self.assertAlmostEqual(distance, ALTITUDE / down, delta=0.012 * ALTITUDE / down, msg=f"beam {beam}")

    def test_dead_reckoning_comes_home_from_a_square(self):
        rows, t, x, y = [], 20.0, 0.0, 0.0  # at rest until its host is there
        rows.append((0, x, y, turned(0)))
        rows.append((t, x, y, turned(0)))
        for side in range(4):
            yaw = math.radians(90 * side)
            x, y, t = x + 10 * math.cos(yaw), y + 10 * math.sin(yaw), t + 10
            rows.append((t, x, y, turned(90 * side)))
            t += 5
            rows.append((t, x, y, turned(90 * side + 90)))
        dvl = self.start(rows, rate=8)
        self.assertTrue(dvl.ask("reset_dead_reckoning")["success"])
        begin, farthest = dvl.next("position_local"), 0
        while True:
            report = dvl.next("position_local")
            farthest = max(farthest, math.hypot(report["x"], report["y"]))
            if report["ts"] - begin["ts"] > t:
                break
        self.assertAlmostEqual(farthest, math.hypot(10, 10), delta=0.5)
        self.assertLess(math.hypot(report["x"], report["y"]), 0.4, "1 % of 40 m")
        self.assertAlmostEqual((report["yaw"] + 180) % 360 - 180, 0, delta=1)

    def test_serial_line_and_http(self):
        self.start([(0, 0, 0, turned(0))], options=", range_mode: '=2'")
        line = os.open(self.line, os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        os.write(line, b"wcv*fe\r\n")
        heard, end = b"", time.monotonic() + 60
        while not (b"wrv,2.8.0*b2\r\n" in heard and b"wru,3," in heard and b"wrp," in heard) and time.monotonic() < end:
            heard += os.read(line, 4096)
        self.assertIn(b"wrv,2.8.0*b2\r\n", heard)
        with urllib.request.urlopen(f"http://127.0.0.1:{self.web}/api/v1/about", timeout=30) as answer:
            self.assertEqual(json.load(answer)["product_name"], "DVL A50")

    def test_by_tcp_a_report_comes_in_one_piece(self):
        """A real one has Ethernet, which the rate of its serial line does not slow; DUNE's reader throws at pieces."""
        dvl = self.start([(0, 0, 0, turned(0))], options=", baud: 1200")
        for _ in range(10):
            self.assertRegex(dvl.socket.recv(65536), rb'(?s)\A\{.*\}\r\n\Z')


class NucleusTest(unittest.TestCase):
    def test_by_tcp_a_frame_comes_in_one_piece(self):
        port = free_port()
        scenario = SCENARIO % (1, free_port(), port, ", baud: 1200, starts_at_once: true")
        with Emulator(scenario.replace("dvl-a50", "nortek-nucleus"), files={"way.csv": way([(0, 0, 0, turned(0))])}):
            with socket.create_connection(("127.0.0.1", port), timeout=60) as host:
                for _ in range(10):
                    piece = host.recv(65536)
                    while piece:
                        self.assertEqual(piece[:2], b"\xa5\x0a")
                        size = 10 + int.from_bytes(piece[4:6], "little")
                        self.assertGreaterEqual(len(piece), size)
                        piece = piece[size:]


if __name__ == "__main__":
    unittest.main()
