"""The maker's own Python package drives the Surveyor 240-16 over TCP and UDP, as a library and by its example."""

import contextlib
import io
import json
import math
import re
import signal
import struct
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

import public_driver

public_driver.use("ping360", "brping")

from brping import Surveyor240, definitions  # noqa: E402
from ports import free_port  # noqa: E402
from program import PROGRAM, ROOT, Emulator  # noqa: E402

DEPTH = 4.0  # m below the head
SCENARIO = """
scene: {scenes}/flat.glb
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -16], rpy_deg: [7, -5, 0]}}
effects: {sensor_noise: off}
devices:
  - name: surveyor
    model: surveyor240
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["%s-listen://127.0.0.1:%d"]
    options: {temperature: 11.5}
"""
PARAMETERS = dict(end_mm=8000, ping_enable=True, enable_yz_point_data=True, enable_atof_data=True)
EXAMPLE = ROOT / "build" / "drivers" / "ping360" / "bin" / "surveyor240Example.py"
PYTHON = ROOT / "build" / "drivers" / "ping360" / "bin" / "python3"


class NoEnd:
    """The package spins without end at a silent device: what does not end in time fails instead."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __enter__(self):
        def fail(*_):
            raise TimeoutError(f"the package has not come back within {self.seconds} s")

        self.before = signal.signal(signal.SIGALRM, fail)
        signal.alarm(self.seconds)

    def __exit__(self, *_):
        signal.alarm(0)
        signal.signal(signal.SIGALRM, self.before)


class SurveyorCase(unittest.TestCase):
    def start(self, scheme, **arguments):
        port = free_port() if scheme == "tcp" else free_port()
        self.emulator = Emulator(SCENARIO % (scheme, port))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()
        self.port = port
        sonar = Surveyor240(**arguments)
        sonar._input_buffer.clear()  # all instances of the package share one
        getattr(sonar, f"connect_{scheme}")("127.0.0.1", port)
        self.addCleanup(sonar.iodev.close)
        return sonar

    def check_points(self, points, roll, pitch):
        """(y, z) of the tilted head, turned level: the floor is DEPTH below it."""
        self.assertGreaterEqual(len(points), 10)
        for y, z in points:
            down = -(y * math.sin(roll) + z * math.cos(roll)) * math.cos(pitch)
            spread = math.hypot(y, z) * abs(math.tan(math.atan2(y, -z) + roll)) * math.radians(1.0)
            self.assertLess(abs(down - DEPTH), max(0.005 * DEPTH, spread), f"{y:.2f} m to port")
        self.assertLess(min(y for y, _ in points), -1)
        self.assertGreater(max(y for y, _ in points), 1)


class AsALibrary(SurveyorCase):
    def check_everything(self, sonar):
        with NoEnd(60):
            self.assertTrue(sonar.initialize())
            self.assertEqual(sonar.get_device_information()["device_type"], 198)
            attitude = sonar.wait_message([definitions.SURVEYOR240_ATTITUDE_REPORT], 5)
            pitch = math.asin(attitude.up_vec_x)
            roll = math.atan2(attitude.up_vec_y, attitude.up_vec_z)
            self.assertAlmostEqual(math.degrees(pitch), 5, delta=0.01)
            self.assertAlmostEqual(math.degrees(math.atan(math.tan(roll) * math.cos(pitch))), 7, delta=0.1)
            self.assertAlmostEqual(sonar.get_water_stats()["temperature"], 11.5)
            self.assertEqual(sonar.get_atof_point_data()["num_points"], 0, "nothing is pinged yet")
            sonar.control_set_ping_parameters(**PARAMETERS)
            for _ in range(4):
                data = sonar.wait_message([definitions.SURVEYOR240_ATOF_POINT_DATA], 5)
                points = []
                for point in Surveyor240.create_atof_list(data):
                    d = 0.5 * data.sos_mps * point.tof
                    points.append((d * math.sin(point.angle), -d * math.cos(point.angle)))
                self.check_points(points, roll, pitch)
                data = sonar.wait_message([definitions.SURVEYOR240_YZ_POINT_DATA], 5)
                flat = Surveyor240.create_yz_point_data(data)
                self.check_points(list(zip(flat[::2], flat[1::2])), roll, pitch)
                self.assertAlmostEqual(math.asin(data.up_vec_x), pitch, places=5)
            told = sonar.get_atof_point_data()["utc_msec"] / 1000
            self.assertLess(abs(told - time.time()), 30, "it was told the time")
            self.assertGreater(sonar.get_yz_point_data()["num_points"], 9)
            sonar.control_set_ping_parameters(ping_enable=False)

    def test_over_tcp(self):
        self.check_everything(self.start("tcp"))

    def test_over_udp(self):
        self.check_everything(self.start("udp"))

    def test_waiting_for_points_of_a_stopped_device_ends(self):
        sonar = self.start("tcp")
        with NoEnd(20):
            self.assertTrue(sonar.initialize())
            self.assertIsNone(sonar.wait_message([definitions.SURVEYOR240_ATOF_POINT_DATA], 1))

    def test_its_log_holds_what_it_heard(self):
        with tempfile.TemporaryDirectory() as folder:
            sonar = self.start("tcp", logging=True, log_directory=folder)
            with NoEnd(30):
                self.assertTrue(sonar.initialize())
                sonar.control_set_ping_parameters(**PARAMETERS)
                for _ in range(5):
                    sonar.wait_message([definitions.SURVEYOR240_ATOF_POINT_DATA], 5)
            (log,) = Path(folder).glob("*.svlog")
            # The package cannot unpack the JSON_WRAPPER that it has written itself, and prints so.
            with open(log, "rb") as file, contextlib.redirect_stdout(io.StringIO()):
                packets = [packet.message_id for packet in iter(lambda: Surveyor240.read_packet(file), None)]
            points = definitions.SURVEYOR240_ATOF_POINT_DATA
            self.assertEqual(packets, [definitions.SURVEYOR240_JSON_WRAPPER] + [points] * 5)
            shown = subprocess.run(
                [PROGRAM, "inspect", log, "--json"], capture_output=True, text=True, check=True, timeout=60
            ).stdout
            names = [message["name"] for message in json.loads(shown)["messages"]]
            self.assertEqual(names, ["JsonWrapper"] + ["AtofPointData"] * 5)


class AsAProgram(SurveyorCase):
    def logged_points(self, folder):
        """Messages with points in the log so far, of the kind that is rarer."""
        data = b"".join(log.read_bytes() for log in Path(folder).glob("*.svlog"))
        kinds = (definitions.SURVEYOR240_ATOF_POINT_DATA, definitions.SURVEYOR240_YZ_POINT_DATA)
        return min(len(re.findall(b"BR.." + re.escape(struct.pack("<H", kind)), data, re.S)) for kind in kinds)

    def test_the_example_records_until_it_is_stopped(self):
        sonar = self.start("tcp")
        sonar.iodev.close()
        with tempfile.TemporaryDirectory() as folder:
            program = subprocess.Popen(
                [PYTHON, "-u", EXAMPLE, "--tcp", f"127.0.0.1:{self.port}", "--range", "8000", "--log", folder],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            )  # fmt: skip
            guard = threading.Timer(60, program.kill)
            guard.start()
            try:
                program.stdin.write("\n")
                program.stdin.flush()
                pitches = []
                while len(pitches) < 5 or self.logged_points(folder) < 4:
                    line = program.stdout.readline()
                    self.assertTrue(line, "it has ended by itself")
                    pitches += [float(p) for p in re.findall(r"Pitch: (\S+)", line)]
                program.send_signal(signal.SIGINT)
                rest = program.communicate(timeout=20)[0]
            finally:
                guard.cancel()
                program.kill()
            self.assertEqual(program.returncode, 0, rest)
            for pitch in pitches:
                self.assertAlmostEqual(math.degrees(pitch), 5, delta=0.01)


class Definitions(unittest.TestCase):
    LETTERS = {"u8": "B", "u16": "H", "u32": "I", "u64": "Q", "i16": "h", "i32": "i", "f32": "f"}

    def test_every_message_of_the_package_has_its_table(self):
        text = subprocess.run(
            [PROGRAM, "inspect", "--tables", "cerulean"], capture_output=True, text=True, check=True, timeout=60
        ).stdout
        ids = {name: int(number) for number, name in re.findall(r"(\d+) (\w+)[; ]", re.search(r"`id`.*", text)[0])}
        formats = {}
        for section in text.split("### ")[1:]:
            kinds = re.findall(r"^\| \d* \| (\w+)(?:\[(\d+)\])? \| `\w+` \|", section, re.M)
            letters = "".join(self.LETTERS[k] * int(n or 1) for k, n in kinds if k in self.LETTERS)
            formats[ids.get(section.split("\n")[0].strip())] = letters
        for number, theirs in definitions.payload_dict_surveyor240.items():
            with self.subTest(theirs["name"]):
                self.assertEqual(formats[number], theirs["format"])


if __name__ == "__main__":
    unittest.main()
