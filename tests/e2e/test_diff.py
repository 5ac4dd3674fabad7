"""`echoloop diff` on what the running program said: two runs under the same commands, under one other command, and runs
against recordings of real sonars."""
import json
import os
import shutil
import socket
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, ROOT, Emulator

import oculus_wire
from ping360_host import TRANSDUCER, frame

PING360 = """
scene: {scenes}/tank.glb
devices:
  - {name: head, model: ping360, endpoints: ["udp-listen://127.0.0.1:%d"]}
"""
SONIC = """
scene: {scenes}/flat.glb
water: {sound_speed: 1514.962}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - {name: sonar, model: r2sonic-2026, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]}
"""
OCULUS = """
scene: {scenes}/tank.glb
devices:
  - {name: sonar, model: oculus-m750d, endpoints: ["tcp-listen://127.0.0.1:%d", "udp://127.255.255.255:%d"]}
"""


def transducer(angle, gain, samples=200, period=1333):
    """Asks for 5 m."""
    return frame(TRANSDUCER, struct.pack("<BBHHHHHBB", 1, gain, angle, 40, period, 750, samples, 1, 0))


class Diff(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-diff-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def diff(self, a, b, *arguments):
        done = subprocess.run([PROGRAM, "diff", str(a), str(b), "--json", *arguments], capture_output=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(done.returncode == 0, report["equal"])
        types = {one["name"]: one for direction in report["directions"] for one in direction["types"]}
        return report, types

    @staticmethod
    def different(type_):
        return {field["name"] for field in type_["fields"] if field["verdict"] == "different"}

    def shared(self, *parts):
        path = ROOT.parent / "shared" / "data" / Path(*parts)
        if path.exists():
            return path
        if os.environ.get("CI") == "true":
            self.fail(f"{path} is missing")
        self.skipTest(f"{path} is not part of the repository")
        return None

    def scan(self, name, gains, port=None):
        """A run that is asked for a ping at each of some angles, with these gains."""
        port = port or free_port()
        file = self.folder / name
        with Emulator(PING360 % port, "--record", str(file)) as emulator, \
                socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.settimeout(20)
            for step, gain in enumerate(gains):
                host.sendto(transducer(200 + step, gain), ("127.0.0.1", port))
                host.recv(65536)
            self.assertEqual(emulator.stop()[0], 0)
        return file

    def test_two_runs_under_the_same_commands_are_equal_to_the_last_sample(self):
        a, b = self.scan("a.pcapng", [1] * 12), self.scan("b.pcapng", [1] * 12)
        report, types = self.diff(a, b, "--tolerance", "data=0")
        self.assertTrue(report["equal"], report)
        self.assertEqual((types["DeviceData"]["pairs"], types["Transducer"]["pairs"]), (12, 12))
        data = next(field for field in types["DeviceData"]["fields"] if field["name"] == "data")
        self.assertEqual((data["compared"], data["different"]), (12, 0))
        self.assertGreater(types["Transducer"]["answer"]["a"]["median"], 0.001)

    def test_another_command_is_found_and_so_is_what_it_changed(self):
        gains = [1] * 12
        gains[5] = 0
        _, types = self.diff(self.scan("a.pcapng", [1] * 12), self.scan("b.pcapng", gains), "--tolerance", "data=0")
        for name in ("Transducer", "DeviceData"):
            self.assertIn("gain_setting", self.different(types[name]), name)
            gain = next(field for field in types[name]["fields"] if field["name"] == "gain_setting")
            self.assertEqual((gain["different"], gain["first"]["a"]["value"], gain["first"]["b"]["value"]), (1, "1", "0"))
        data = next(field for field in types["DeviceData"]["fields"] if field["name"] == "data")
        self.assertEqual(data["different"], 1)

    def test_a_run_against_the_recording_of_a_real_sonic_2026(self):
        base, file = free_port(16), self.folder / "sonic.pcapng"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.bind(("127.0.0.1", base + 8))
            listener.settimeout(20)
            with Emulator(SONIC % (base, base + 8), "--record", str(file)) as emulator:
                for _ in range(5):
                    listener.recv(65536)
                self.assertEqual(emulator.stop()[0], 0)
        report, types = self.diff(self.shared("r2sonic", "r2sonic_bth0_20.pcap"), file, "--port-b", str(base + 8))
        bth0 = types["BTH0"]
        self.assertEqual(bth0["a"], 20)
        self.assertGreaterEqual(bth0["pairs"], 5)
        fields = {field["name"]: field for field in bth0["fields"]}
        self.assertEqual(fields["h0.model"]["verdict"], "equal")
        self.assertEqual(fields["h0.ping_number"]["verdict"], "not compared")
        self.assertNotIn("equal", {fields["h0.rx_range"]["verdict"], fields["h0.serial"]["verdict"]})
        self.assertIn("rms_a", fields["r0.r"])
        self.assertFalse(report["equal"])

    def test_a_run_against_the_bytes_of_a_real_oculus(self):
        port, status, file = free_port(), free_port(), self.folder / "oculus.pcapng"
        with Emulator(OCULUS % (port, status), "--record", str(file)) as emulator, \
                socket.create_connection(("127.0.0.1", port), timeout=20) as host:
            host.sendall(oculus_wire.fire())
            heard = 0
            while heard < 400000:
                heard += len(host.recv(65536))
            self.assertEqual(emulator.stop()[0], 0)
        _, types = self.diff(self.shared("oculus", "three_pings_8bit.raw"), file)
        result = types["Result"]
        self.assertEqual(result["a"], 3)
        self.assertGreaterEqual(result["pairs"], 2)
        self.assertIsNone(result["gap"]["a"])
        fields = {field["name"]: field for field in result["fields"]}
        self.assertEqual(fields["data_size"]["verdict"], "equal")
        self.assertEqual({name for name, field in fields.items() if field["different"] and name == "ping_id"}, {"ping_id"})


if __name__ == "__main__":
    unittest.main()
