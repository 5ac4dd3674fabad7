"""The Sonar 3D-15's maker's package sets a replayed capture by HTTP and gets the same images by UDP."""

import unittest

import public_driver

public_driver.use("wlsonar", "wlsonar")

import wlsonar  # noqa: E402
import wlsonar.range_image_protocol as rip  # noqa: E402
from ports import free_port  # noqa: E402
from replayed import Recorded, requests_line  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: sonar
    model: sonar-3d-15
    endpoints: ["tcp-listen://127.0.0.1:%d"]
"""


class Replayed(unittest.TestCase):
    def images(self, sonar, sock):
        self.assertEqual(sonar.about().product_name, "Sonar 3D-15")
        sonar.set_udp_unicast("127.0.0.1", sock.getsockname()[1])
        sonar.set_speed_of_sound(1500)
        self.assertEqual(sonar.get_speed_of_sound(), 1500)
        sonar.set_acoustics_enabled(True)
        images = [rip.unpackb(sock.recv(65507)) for _ in range(6)]
        sonar.set_acoustics_enabled(False)
        return images

    def socket(self, port=0):
        sock = wlsonar.open_sonar_udp_unicast_socket(udp_port=port, iface_ip="127.0.0.1")
        self.addCleanup(sock.close)
        sock.settimeout(30)
        return sock

    def test_images_after_settings(self):
        port, sock = free_port(), self.socket()
        run = Recorded(TANK % port)
        self.addCleanup(run.remove)
        with run:
            seen = self.images(wlsonar.Sonar3D("127.0.0.1", port=port), sock)
        images_port = sock.getsockname()[1]
        sock.close()
        places = ("--play", f"sonar http=tcp-listen://127.0.0.1:{port}",
                  "--play", f"sonar images=udp://127.0.0.1:{images_port}")
        with run.replay("--answer", *places) as replay:
            again = self.images(wlsonar.Sonar3D("127.0.0.1", port=port), self.socket(images_port))
            status, output = replay.stop()
        self.assertEqual(status, 0, output)
        self.assertIn("0 that the capture does not hold", requests_line(output))
        self.assertEqual(again, seen)


if __name__ == "__main__":
    unittest.main()
