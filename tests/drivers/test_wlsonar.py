"""The maker's own Python package sets the Sonar 3D-15 by HTTP, and finds the tank's walls and floor in its images."""

import datetime
import json
import math
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

import public_driver

public_driver.use("wlsonar", "wlsonar")

import wlsonar  # noqa: E402
import wlsonar.range_image_protocol as rip  # noqa: E402
from ports import free_port  # noqa: E402
from program import PROGRAM, Emulator  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
effects: {multipath: %s, sensor_noise: off}
devices:
  - name: sonar
    model: sonar-3d-15
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {%s}
"""
AHEAD, BESIDE, BELOW = 6.0, 4.0, 2.0  # m, to the tank's front wall, side walls and floor
BEAM_ACROSS, BEAM_ALONG = math.radians(0.9), math.radians(0.6)


class Wlsonar(unittest.TestCase):
    def start(self, options="", multipath="on"):
        port = free_port()
        emulator = Emulator(TANK % (multipath, port, options))
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        return wlsonar.Sonar3D("127.0.0.1", port=port)

    def unicast(self, sonar):
        sock = wlsonar.open_sonar_udp_unicast_socket(udp_port=0, iface_ip="127.0.0.1")
        self.addCleanup(sock.close)
        sock.settimeout(30)
        sonar.set_udp_unicast("127.0.0.1", sock.getsockname()[1])
        return sock

    def shot(self, sock):
        """A range image and the strengths of the same shot."""
        while True:
            ranges = rip.unpackb(sock.recv(65507))
            if isinstance(ranges, rip.RangeImage):
                strengths = rip.unpackb(sock.recv(65507))
                self.assertEqual(ranges.header, strengths.header)
                return ranges, strengths

    def check_geometry(self, ranges, most):
        """Distances of the voxels to the nearest of floor, front and starboard wall, where the beam is no excuse."""
        seen = wrong = 0
        for pixel, voxel in enumerate(wlsonar.range_image_to_xyz(ranges)[: 32 * 256]):  # rows that look down
            if voxel is None or pixel % 256 < 170:
                continue  # lattice, ball and post are further to port
            r = math.hypot(*voxel)
            x, y, z = (v / r for v in voxel)
            walls = [(d / u, u) for d, u in ((AHEAD, x), (BESIDE, y), (BELOW, z)) if u > 0.01]
            truth, cosine = min(walls)
            if sum(d - truth < 0.5 for d, _ in walls) > 1:
                continue  # in the corner between two of them
            spread = truth * max(BEAM_ACROSS, BEAM_ALONG) * math.tan(math.acos(cosine))
            seen += 1
            wrong += abs(r - truth) > 0.04 + spread
        self.assertGreater(seen, 1500)
        self.assertLess(wrong / seen, most)

    def test_time_of_release_1_7_1(self):
        sonar = self.start("release: 1.7.1, ntp: unreachable")
        status = sonar.get_time_status()
        self.assertEqual((status.system_time.year, status.ntp_synced, status.ntp_seconds_since_last_sync), (2025, False, None))
        told = datetime.datetime(2026, 8, 17, 10, 0, tzinfo=datetime.timezone.utc)
        sonar.set_time_manual(told)
        self.assertLess(abs((sonar.get_time_status().system_time - told).total_seconds()), 30)
        self.assertEqual(sonar.get_time_ntp().to_json(), {"ntp_address": "auto"})
        self.assertFalse(sonar.force_sync_ntp(0.2).success)
        synchronised = self.start("release: 1.7.1")
        self.assertTrue(synchronised.force_sync_ntp(1).success)
        with self.assertRaises(Exception) as refused:
            synchronised.set_time_manual(told)
        self.assertIn("already synchronized", str(refused.exception))
        with self.assertRaises(Exception):
            synchronised.get_output_imu_batch_enabled()  # needs 1.8.0

    def test_imu_of_release_1_8_0(self):
        sonar = self.start("release: 1.8.0")
        sock = self.unicast(sonar)
        self.assertFalse(sonar.get_output_imu_batch_enabled())
        sonar.set_output_imu_batch_enabled(True)
        batches = [rip.unpackb(sock.recv(65507)) for _ in range(3)]
        for batch, following in zip(batches, batches[1:]):
            self.assertIsInstance(batch, rip.ImuBatch)
            self.assertEqual(following.batch_sequence_id, batch.batch_sequence_id + 1)
            self.assertEqual(len(batch.timestamp), batch.samples)
            self.assertEqual((len(batch.specific_force), len(batch.rate_of_turn)), (3 * batch.samples, 3 * batch.samples))
            self.assertAlmostEqual(batch.specific_force[2], -9.81, places=2)

    def test_walls_and_floor_are_where_they_are(self):
        sonar = self.start("acoustics: true, speed_of_sound: 1500", multipath="off")
        ranges, strengths = self.shot(self.unicast(sonar))
        self.assertEqual((ranges.width, ranges.height, ranges.fov_horizontal, ranges.fov_vertical), (256, 64, 90, 40))
        self.check_geometry(ranges, most=0.003)
        for distance, strength in zip(ranges.image_pixel_data, strengths.image_pixel_data):
            self.assertEqual(distance == 0, strength == 0)
        linear = wlsonar.bitmap_image_to_strength_linear(strengths)
        self.assertGreater(max(linear), 300)

    def test_the_tanks_smooth_walls_show_a_few_pixels_farther_away(self):
        """The transmitter lights the whole view: floor that the beam sees at a grazing angle answers by the wall too."""
        ranges, _ = self.shot(self.unicast(self.start("acoustics: true, speed_of_sound: 1500")))
        self.check_geometry(ranges, most=0.06)

    def test_range_mode_and_speed_of_sound_change_the_images(self):
        sonar = self.start()
        sock = self.unicast(sonar)
        sock.settimeout(0.5)
        with self.assertRaises(socket.timeout):
            sock.recv(65507)  # acoustics are off
        sock.settimeout(30)
        sonar.set_speed_of_sound(1500)
        sonar.set_range(4.5, 6.2)
        sonar.set_acoustics_enabled(True)
        ranges, _ = self.shot(sock)
        far = [d for d in wlsonar.range_image_to_distance(ranges) if d > 0]
        self.assertTrue(all(4.4 < d < 6.3 for d in far))
        middle = sorted(wlsonar.range_image_to_distance(ranges)[31 * 256 + 120 : 31 * 256 + 136])[8]
        self.assertAlmostEqual(middle, AHEAD, delta=0.05)
        sonar.set_speed_of_sound(1200)
        while ranges.speed_of_sound != 1200:
            ranges, _ = self.shot(sock)
        middle = sorted(wlsonar.range_image_to_distance(ranges)[31 * 256 + 120 : 31 * 256 + 136])[8]
        self.assertAlmostEqual(middle, AHEAD * 1200 / 1500, delta=0.05)
        sonar.set_mode("high-frequency")
        while ranges.fov_horizontal != 40:
            ranges, _ = self.shot(sock)

    def test_multicast_of_every_release_is_read(self):
        for options in ("acoustics: true", "acoustics: true, packets: RIP1, release: 1.5.1"):
            with self.subTest(options):
                sonar = self.start(options)
                sock = wlsonar.open_sonar_udp_multicast_socket(iface_ip="127.0.0.1")
                self.addCleanup(sock.close)
                sock.settimeout(30)
                self.shot(sock)
                if "RIP1" in options:
                    self.assertEqual(sonar.sonar_version, "1.5.1")
                    self.assertRaises(wlsonar.VersionException, sonar.get_mode)
                sonar.set_udp_disabled()

    def test_other_messages_are_told_from_damaged_ones(self):
        sock = self.unicast(self.start("acoustics: true, other_messages: true"))
        self.shot(sock)
        with self.assertRaises(rip.UnknownProtobufTypeError):
            rip.unpackb(sock.recv(65507))

    def test_inspect_reads_a_recording(self):
        sock = self.unicast(self.start("acoustics: true"))
        self.shot(sock)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "shots.sonar"
            file.write_bytes(b"".join(sock.recv(65507) for _ in range(4)))
            shown = subprocess.check_output([PROGRAM, "inspect", file, "--json"], text=True, timeout=60)
        names = [message["name"] for message in json.loads(shown)["messages"]]
        self.assertEqual(names, ["RangeImage", "BitmapImageGreyscale8"] * 2)

    def test_everything_that_the_makers_test_of_a_real_sonar_toggles(self):
        sonar = self.start()
        self.assertEqual(sonar.about().product_name, "Sonar 3D-15")
        self.assertTrue(sonar.get_status().systems_check.operational)
        self.assertEqual(sonar.get_temperature(), 21.0)
        for name, values in {
            "acoustics_enabled": (True, False),
            "speed_of_sound": (1442.0, 1491.0),
            "mode": ("high-frequency", "low-frequency"),
            "salinity": ("fresh", "salt"),
            "udp_config": (wlsonar.UdpConfig("unicast", "192.168.99.42", 4748), wlsonar.UdpConfig("multicast", "", 0)),
        }.items():
            for value in values:
                getattr(sonar, f"set_{name}")(value)
                self.assertEqual(getattr(sonar, f"get_{name}")(), value)
        sonar.set_range(2, 3)
        self.assertEqual(sonar.get_range(), (2, 3))


if __name__ == "__main__":
    unittest.main()
