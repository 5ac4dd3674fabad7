"""The maker's own Python package drives the Ping360, over a pty and over UDP, and finds the walls of the tank."""

import math
import time
import unittest

import public_driver

public_driver.use("ping360", "brping")

from brping import Ping360, definitions  # noqa: E402
from ports import free_port  # noqa: E402
from program import Emulator  # noqa: E402

SOUND_SPEED = 1500.0
HALF_LENGTH, HALF_WIDTH = 6.0, 4.0  # m, the tank's walls as seen from its middle
SAMPLES, PERIOD = 1200, 444  # 10 m
BIN = PERIOD * 25e-9 * SOUND_SPEED / 2
HALF_BEAM = 1.0  # deg

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: ping360
    model: ping360
    endpoints: ["%s"]
    options: {ring_down: true%s}
"""
# Edges to a bin need a beam with edges, steady levels and direct echoes only; noise, pulse and gain stay on.
SHARP = "effects: {beam_pattern: off, side_lobes: off, speckle: off, multipath: off, second_time_around: off}\n"
PTY = "pty:{folder}/ping360"


def bearing_of(angle):
    """Degrees clockwise from ahead: gradian 200 is the arrow."""
    return ((angle - 200) * 0.9) % 360


def nearest_wall(degrees, half_beam):
    ranges = []
    for i in range(-20, 21):
        b = math.radians(degrees + half_beam * i / 20)
        ranges.append(min(HALF_LENGTH / max(abs(math.cos(b)), 1e-9), HALF_WIDTH / max(abs(math.sin(b)), 1e-9)))
    return min(ranges)


def sees_only_walls(degrees):
    """Neither the grid, the ball nor the post."""
    return 110 <= degrees <= 200 or 240 <= degrees <= 290


class Walls(unittest.TestCase):
    def check(self, pings):
        """`pings`: (angle, samples). Leading edges: one bin, plus what half a beam changes in range."""
        checked = 0
        for angle, data in pings:
            degrees = bearing_of(angle)
            if not sees_only_walls(degrees):
                continue
            beyond_ring_down = int(1.0 / BIN)
            edge = next((i for i in range(beyond_ring_down, len(data)) if data[i] >= 80), None)
            self.assertIsNotNone(edge, f"no wall at {angle} gradians")
            self.assertGreaterEqual((edge + 1) * BIN, nearest_wall(degrees, HALF_BEAM) - BIN, f"angle {angle}")
            self.assertLessEqual(edge * BIN, nearest_wall(degrees, 0) + BIN, f"angle {angle}")
            checked += 1
        self.assertGreater(checked, 10)

    def set_up(self, sonar):
        self.assertTrue(sonar.initialize())
        for result in (
            sonar.set_transmit_frequency(750),
            sonar.set_sample_period(PERIOD),
            sonar.set_number_of_samples(SAMPLES),
            sonar.set_transmit_duration(53),
            sonar.set_gain_setting(0),
        ):
            self.assertEqual(result.message_id, definitions.PING360_DEVICE_DATA)
            self.assertEqual(len(result.data), 0, "nothing is transmitted yet")


    def transmit(self, sonar, angle):
        """The answer to a transducer message; the package gives up after a few seconds, a busy machine may need more."""
        for _ in range(5):
            if reply := sonar.transmitAngle(angle):
                return reply
        self.fail(f"no answer at {angle} gradians")


class OverPty(Walls):
    def test_request_and_response_takes_as_long_as_the_wire(self):
        with Emulator(TANK % (PTY, ", baud: 115200") + SHARP) as emulator:
            sonar = Ping360()
            sonar.connect_serial(str(emulator.folder / "ping360"), 115200)
            self.set_up(sonar)
            sonar.transmitAngle(340)
            pings, begin = [], time.monotonic()
            for angle in range(341, 381):
                reply = self.transmit(sonar, angle)
                self.assertEqual(reply.message_id, definitions.PING360_DEVICE_DATA)
                self.assertEqual((reply.angle, reply.number_of_samples, len(reply.data)), (angle, SAMPLES, SAMPLES))
                pings.append((angle, bytes(reply.data)))
            each = (time.monotonic() - begin) / 40
            # 1224 bytes at 115200 are 106 ms; 2R/c is 13 ms, the motor 6 ms, and the host looks every 5 ms.
            self.assertGreaterEqual(each, 0.106 + 0.013 + 0.006)
            self.assertLess(each, 0.180)
            print(f"request/response at 115200: {1000 * each:.1f} ms a ping")
            sonar.iodev.close()

    def test_walls_unpaced_all_round(self):
        with Emulator(TANK % (PTY, "") + SHARP) as emulator:
            sonar = Ping360()
            sonar.connect_serial(str(emulator.folder / "ping360"), 115200)
            self.set_up(sonar)
            self.check([(a, bytes(self.transmit(sonar, a).data)) for a in range(0, 400, 5)])
            sonar.iodev.close()


class OverUdp(Walls):
    def test_a_full_turn_by_auto_transmit(self):
        port = free_port()
        with Emulator(TANK % (f"udp-listen://127.0.0.1:{port}", "") + SHARP):
            sonar = Ping360()
            sonar.connect_udp("127.0.0.1", port)
            self.addCleanup(lambda: sonar.iodev.close())
            self.set_up(sonar)
            sonar.control_auto_transmit(1, 0, 53, PERIOD, 750, SAMPLES, 0, 399, 1, 0)
            pings, begin = [], time.monotonic()
            for _ in range(400):
                frame = sonar.wait_message([definitions.PING360_AUTO_DEVICE_DATA], 5)
                self.assertIsNotNone(frame, f"after {len(pings)} frames")
                pings.append((frame.angle, bytes(frame.data)))
            print(f"a full turn by auto_transmit: {time.monotonic() - begin:.2f} s")
            self.assertEqual([angle for angle, _ in pings], list(range(400)))
            self.check(pings)
            sonar.control_motor_off()
            ack = sonar.wait_message([definitions.COMMON_ACK], 1)
            self.assertEqual(ack.acked_id, definitions.PING360_MOTOR_OFF)
            self.assertIsNone(sonar.wait_message([definitions.PING360_AUTO_DEVICE_DATA], 0.5), "it has stopped")

    def test_refusals_come_with_a_text(self):
        port = free_port()
        with Emulator(TANK % (f"udp-listen://127.0.0.1:{port}", "") + SHARP):
            sonar = Ping360()
            sonar.connect_udp("127.0.0.1", port)
            self.addCleanup(lambda: sonar.iodev.close())
            self.assertTrue(sonar.initialize())
            reply = sonar.set_sample_period(7)
            self.assertEqual(reply.message_id, definitions.COMMON_NACK)
            self.assertEqual(reply.nacked_id, definitions.PING360_TRANSDUCER)
            self.assertIn("sample period", str(reply.nack_message))


if __name__ == "__main__":
    unittest.main()
