"""The Ping360's Python package shows the same pictures of a replayed capture of itself as of the sonar."""

import unittest

import public_driver

public_driver.use("ping360", "brping")

from brping import Ping360, definitions  # noqa: E402
from ports import free_port  # noqa: E402
from replayed import Recorded, requests_line  # noqa: E402

SAMPLES, PERIOD = 400, 444
TANK = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: ping360
    model: ping360
    endpoints: ["%s"]
"""
ANGLES = list(range(100, 160, 5))


class Replayed(unittest.TestCase):
    def recorded(self, endpoint):
        run = Recorded(TANK % endpoint)
        self.addCleanup(run.remove)
        return run

    def set_up(self, sonar):
        self.addCleanup(lambda: sonar.iodev.close())
        self.assertTrue(sonar.initialize())
        for result in (sonar.set_transmit_frequency(750), sonar.set_sample_period(PERIOD),
                       sonar.set_number_of_samples(SAMPLES), sonar.set_transmit_duration(53),
                       sonar.set_gain_setting(0)):
            self.assertEqual(result.message_id, definitions.PING360_DEVICE_DATA)

    def transmit(self, sonar, angle):
        for _ in range(5):
            if reply := sonar.transmitAngle(angle):
                self.assertEqual(reply.angle, angle)
                return bytes(reply.data)
        self.fail(f"no answer at {angle} gradians")

    def pictures(self, sonar, angles):
        self.set_up(sonar)
        return {angle: self.transmit(sonar, angle) for angle in angles}

    def on_line(self, folder):
        sonar = Ping360()
        sonar.connect_serial(str(folder / "ping360"), 115200)
        return sonar

    def on_udp(self, port):
        sonar = Ping360()
        sonar.connect_udp("127.0.0.1", port)
        return sonar

    def test_request_and_response_over_a_pty_in_any_order(self):
        run = self.recorded("pty:{folder}/ping360")
        with run as emulator:
            seen = self.pictures(self.on_line(emulator.folder), ANGLES)
        self.assertEqual({len(data) for data in seen.values()}, {SAMPLES})
        for angles in (ANGLES, ANGLES[::-1] + ANGLES[3:7]):
            with run.replay(f"pty:{run.folder}/ping360", "--answer") as replay:
                self.assertEqual(self.pictures(self.on_line(run.folder), angles), seen)
                status, output = replay.stop()
            self.assertEqual(status, 0, output)
            self.assertIn("0 that the capture does not hold", requests_line(output))

    def test_a_scan_by_itself_over_udp(self):
        port = free_port()
        run = self.recorded(f"udp-listen://127.0.0.1:{port}")
        with run:
            seen = self.scan(self.on_udp(port))
        self.assertEqual([angle for angle, _ in seen], list(range(100, 130)))
        with run.replay(f"udp-listen://127.0.0.1:{port}", "--port", "ping360 line 1", "--answer") as replay:
            self.assertEqual(self.scan(self.on_udp(port)), seen)
            self.assertEqual(replay.stop()[0], 0)

    def scan(self, sonar):
        self.set_up(sonar)
        sonar.control_auto_transmit(1, 0, 53, PERIOD, 750, SAMPLES, 100, 200, 1, 0)
        seen = []
        for _ in range(30):
            frame = sonar.wait_message([definitions.PING360_AUTO_DEVICE_DATA], 10)
            self.assertIsNotNone(frame, f"after {len(seen)} frames")
            seen.append((frame.angle, bytes(frame.data)))
        sonar.control_motor_off()
        self.assertIsNotNone(sonar.wait_message([definitions.COMMON_ACK], 5))
        self.assertIsNone(sonar.wait_message([definitions.PING360_AUTO_DEVICE_DATA], 0.3), "it has stopped")
        return seen


if __name__ == "__main__":
    unittest.main()
