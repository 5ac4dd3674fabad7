"""The running program as a Sonar 3D-15, met by a host of our own over HTTP and UDP."""

import http.client
import json
import math
import socket
import statistics
import struct
import sys
import time
import unittest

from ports import free_port
from program import ROOT, Emulator

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
from sonar3d_wire import Image  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: sonar
    model: sonar-3d-15
    mount: {rpy_deg: [0, %s, 0]}
    endpoints: ["tcp-listen://127.0.0.1:%d"%s]
    options: {acoustics: true, speed_of_sound: 1500, range_min: 1, range_max: 9%s}
"""

INSIDE = rb"\r\n\r\n(19|2[0-3])\.\d+$"  # an answer that ends with 21 degC, give or take its drift


class Host(unittest.TestCase):
    def start(self, pitch=0, options="", unicast=True):
        self.port = free_port()
        self.images = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.images.close)
        self.images.bind(("127.0.0.1", free_port()))
        self.images.settimeout(30)
        second = ', "udp://127.0.0.1:%d"' % self.images.getsockname()[1] if unicast else ""
        emulator = Emulator(TANK % (pitch, self.port, second, options))
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)

    def ask(self, path, body=None):
        """(status, JSON or None)."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        method = "GET" if body is None else "POST"
        connection.request(method, "/api/v1/integration" + path, body=None if body is None else json.dumps(body))
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        return answer.status, json.loads(text) if text else None

    def shot(self, sock=None):
        while True:
            ranges = Image((sock or self.images).recv(65507))
            if ranges.metres:
                strengths = Image((sock or self.images).recv(65507))
                self.assertEqual((ranges.sequence, ranges.time), (strengths.sequence, strengths.time))
                self.assertEqual([m == 0 for m in ranges.metres], [s == 0 for s in strengths.strengths])
                return ranges

    def floor(self, rows, image):
        """Median of the heights that these rows' pixels of the starboard columns see below the sonar."""
        seen = []
        for row in rows:
            for column in range(136, 200, 4):
                pitch = math.radians(row / 63 * image.fov[1] - image.fov[1] / 2)
                seen.append(-image.at(column, row) * math.sin(pitch))
        return sorted(seen)[len(seen) // 2]

    def test_row_0_looks_down_to_the_floor_and_columns_run_to_starboard(self):
        self.start()
        image = self.shot()
        self.assertEqual((image.width, image.height, *image.fov, image.range), (256, 64, 90, 40, 9))
        self.assertAlmostEqual(self.floor((0, 1), image), 2, delta=0.1)
        # The wall to starboard, 4 m away: the last columns look 43 to 45 deg to the right.
        side = sorted(image.at(column, 31) for column in range(250, 256))[3]
        self.assertAlmostEqual(side * math.sin(math.radians(44)), 4, delta=0.1)

    def test_first_row_up_turns_the_image_over(self):
        self.start(options=", first_row: up")
        image = self.shot()
        self.assertAlmostEqual(self.floor((62, 63), image), -2, delta=0.1)

    def test_a_sonar_that_looks_down_sees_the_floor_flat(self):
        self.start(pitch=90)
        image = self.shot()
        errors, beyond = [], []
        pixels = [(column, row) for column in range(0, 256, 4) for row in range(0, 64, 2)]
        returns = [pixel for pixel in pixels if image.at(*pixel)]
        self.assertGreater(len(returns) / len(pixels), 0.75)  # the others faded
        for column, row in returns:
            yaw = math.radians(column / 255 * 90 - 45)
            pitch = math.radians(row / 63 * 40 - 20)
            truth = 2 / (math.cos(pitch) * math.cos(yaw))
            spread = truth * math.radians(1.05) * math.tan(math.acos(2 / truth))
            errors.append(image.at(column, row) - truth)
            beyond.append(abs(errors[-1]) - spread)
        # A speckled echo's strongest bin wanders within its pulse, so a few in a hundred lie farther off.
        self.assertAlmostEqual(statistics.median(errors), 0, delta=0.01)
        self.assertLess(sum(metres > 0.04 for metres in beyond) / len(returns), 0.05)
        self.assertLess(sum(metres > 0.08 for metres in beyond) / len(returns), 0.01)

    def test_settings_by_http_reach_the_images(self):
        self.start()
        self.shot()
        self.assertEqual(self.ask("/acoustics/range", {"min": 4.5, "max": 6.5}), (204, None))
        self.assertEqual(self.ask("/acoustics/range"), (200, {"min": 4.5, "max": 6.5}))
        image = self.shot()
        while image.range != 6.5:
            image = self.shot()
        # No range lies outside the window, but for its step of 1.6 mm; walls go through both ends of it.
        self.assertEqual([m for m in image.metres if m and not 4.498 < m < 6.502], [])
        self.assertEqual(self.ask("/acoustics/range", {"min": 6.5, "max": 4.5}), (400, None))
        self.assertEqual(self.ask("/nothing"), (404, None))
        self.assertEqual(self.ask("/acoustics/mode", "high-frequency"), (204, None))
        while image.fov[0] != 40:
            image = self.shot()
        self.assertEqual(self.ask("/acoustics/enabled", False), (204, None))

    def test_images_leave_from_the_address_of_the_http_interface_and_by_multicast(self):
        self.start(unicast=False)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            sock.bind(("224.0.0.96", 4747))
            group = struct.pack("=4s4s", socket.inet_aton("224.0.0.96"), socket.inet_aton("127.0.0.1"))
            sock.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
            sock.settimeout(30)
            self.assertEqual(sock.recvfrom(65507)[1][0], "127.0.0.1")
            first, second = self.shot(sock), self.shot(sock)
            self.assertEqual(second.sequence - first.sequence, 1)
            self.assertGreater(second.time - first.time, 0.15, "6 Hz, or less on a busy machine; the first may have been late")

    def test_a_raw_request_in_pieces_is_answered_once_it_is_whole(self):
        self.start()
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as sock:
            for piece in (b"GET /api/v1/inte", b"gration/temperature HT", b"TP/1.1\r\nHost: localhost\r\n\r", b"\n"):
                sock.sendall(piece)
            answer = self.rest(sock)
        self.assertTrue(answer.startswith(b"HTTP/1.1 200 OK\r\n"))
        self.assertRegex(answer, INSIDE)

    def connected(self):
        sock = socket.create_connection(("127.0.0.1", self.port), timeout=20)
        self.addCleanup(sock.close)
        return sock

    @staticmethod
    def rest(sock):
        """All bytes until the sonar closes."""
        return b"".join(iter(lambda: sock.recv(4096), b""))

    REQUEST = b"GET /api/v1/integration/temperature HTTP/1.1\r\n\r\n"

    def test_hosts_that_ask_nothing_keep_nobody_out(self):
        self.start()
        idle = [self.connected() for _ in range(3)]
        begin = time.monotonic()
        for _ in range(5):
            self.assertEqual(self.ask("/temperature")[0], 200)
        self.assertLess(time.monotonic() - begin, 3, "idle ones are closed after 5 s")
        idle[1].sendall(self.REQUEST)
        self.assertRegex(self.rest(idle[1]), INSIDE)

    def test_a_request_in_chunks_is_obeyed(self):
        self.start()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        body = iter([b'{"min": 0.3,', b' "max": 16.0}'])  # the defaults of the maker's ROS 2 driver
        connection.request("POST", "/api/v1/integration/acoustics/range", body=body, encode_chunked=True,
                           headers={"Transfer-Encoding": "chunked"})
        self.assertEqual(connection.getresponse().status, 204)
        connection.close()
        self.assertEqual(self.ask("/acoustics/range"), (200, {"min": 0.3, "max": 16.0}))

    def test_a_host_that_closes_its_direction_behind_its_request_is_answered(self):
        self.start(options=", mode: high-frequency")
        self.shot()
        for _ in range(30):  # some while the sonar is busy with an image
            sock = self.connected()
            sock.sendall(self.REQUEST)
            sock.shutdown(socket.SHUT_WR)
            self.assertRegex(self.rest(sock), INSIDE)


if __name__ == "__main__":
    unittest.main()
