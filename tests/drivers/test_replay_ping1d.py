"""The Ping1D's Python package hears from a replayed capture of itself what it heard from the sonar."""

import unittest

import public_driver

public_driver.use("ping1d", "brping")

from brping import Ping1D, definitions, pingmessage  # noqa: E402
from ports import free_port  # noqa: E402
from replayed import Recorded, requests_line  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -1]}}
devices:
  - name: ping1d
    model: ping1d
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s"]
"""


class Replayed(unittest.TestCase):
    def connected(self, port):
        sonar = Ping1D()
        sonar.connect_udp("127.0.0.1", port)
        self.addCleanup(lambda: sonar.iodev.close())
        self.assertTrue(sonar.initialize())
        return sonar

    def ask(self, sonar, names):
        self.assertTrue(sonar.set_mode_auto(0))
        self.assertTrue(sonar.set_range(500, 2500))
        heard = {}
        for name in names:
            heard[name] = next(filter(None, (getattr(sonar, f"get_{name}")() for _ in range(5))))
        return heard

    def test_what_it_asks_in_another_order(self):
        port = free_port()
        names = ["range", "distance", "profile", "general_info", "gain_setting", "firmware_version"]
        run = Recorded(TANK % f"udp-listen://127.0.0.1:{port}")
        self.addCleanup(run.remove)
        with run:
            seen = self.ask(self.connected(port), names)
        self.assertEqual(seen["range"], {"scan_start": 500, "scan_length": 2500})
        with run.replay(f"udp-listen://127.0.0.1:{port}", "--answer") as replay:
            sonar = self.connected(port)
            self.assertEqual(self.ask(sonar, names[::-1]), seen)
            self.assertIsNone(sonar.get_pcb_temperature(), "nobody asked for that")
            status, output = replay.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(requests_line(output), r"[1-9]\d* that the capture does not hold: PcbTemperature request \d+;")

    def test_a_stream_that_it_begins_and_ends(self):
        port = free_port()
        run = Recorded(TANK % f"udp-listen://127.0.0.1:{port}")
        self.addCleanup(run.remove)
        with run:
            seen = self.profiles(self.connected(port))
        with run.replay(f"udp-listen://127.0.0.1:{port}", "--answer") as replay:
            self.assertEqual(self.profiles(self.connected(port)), seen)
            self.assertEqual(replay.stop()[0], 0)

    def profiles(self, sonar):
        def stream(kind):
            message = pingmessage.PingMessage(kind)
            message.id = definitions.PING1D_PROFILE
            message.pack_msg_data()
            sonar.write(message.msg_data)

        self.assertIsNone(sonar.wait_message([definitions.PING1D_PROFILE], 0.3), "nothing unasked")
        stream(definitions.PING1D_CONTINUOUS_START)
        found = []
        for _ in range(8):
            profile = sonar.wait_message([definitions.PING1D_PROFILE], 20)
            found.append((profile.ping_number, bytes(profile.profile_data)))
        stream(definitions.PING1D_CONTINUOUS_STOP)
        self.assertIsNotNone(sonar.wait_message([definitions.COMMON_ACK], 5))
        return found


if __name__ == "__main__":
    unittest.main()
