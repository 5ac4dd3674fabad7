"""Public drivers count errors by themselves, and their counters say what the label file says."""

import json
import os
import select
import socket
import tempfile
import termios
import time
import tty
import unittest
from pathlib import Path

import public_driver
from ports import free_port
from program import Emulator

LABELS = "labels.jsonl"
FAULTS_END = 4  # s of run time; what comes later is clean and shows that all before it has come


REQUESTS = 30


def fault_lines(device, faults):
    return "faults:\n" + "".join(f"  - {{device: {device}, {fault}}}\n" for fault in faults)


class Counted(unittest.TestCase):
    def start(self, scenario, device, *faults):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-counters-")
        self.addCleanup(folder.cleanup)
        self.labels = Path(folder.name) / LABELS
        self.emulator = Emulator(scenario + fault_lines(device, faults), "--labels", self.labels)
        self.emulator.__enter__()
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.begin = time.monotonic()
        return self.emulator.folder

    def faults_are_over(self):
        return time.monotonic() > self.begin + FAULTS_END + 1

    def events(self):
        """The lines of the label file, once the run has ended."""
        status, output = self.emulator.stop()
        self.assertEqual(status, 0, output)
        return [json.loads(line) for line in self.labels.read_text().splitlines()[1:]]


SOUNDER = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: ping1d
    model: ping1d
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d"]
"""


class Brping(Counted):
    """bluerobotics-ping: PingParser.errors, and requests that nothing answers."""

    def connected(self, *faults):
        public_driver.use("ping1d", "brping")
        from brping import Ping1D, definitions

        self.definitions = definitions
        port = free_port()
        self.start(SOUNDER % port, "ping1d", *faults)
        sonar = Ping1D()
        sonar.connect_udp("127.0.0.1", port)
        self.addCleanup(sonar.iodev.close)
        return sonar

    def ask(self, sonar):
        """One request; None if no good answer comes."""
        return sonar.request(self.definitions.COMMON_PROTOCOL_VERSION, 1)

    def test_wrong_checksums_are_its_errors(self):
        sonar = self.connected("kind: wrong_checksum, rate: 0.3")
        unanswered = sum(self.ask(sonar) is None for _ in range(REQUESTS))
        events = self.events()
        self.assertGreater(len(events), 3)
        self.assertEqual({e["kind"] for e in events}, {"wrong_checksum"})
        self.assertEqual(sonar.parser.errors, len(events))
        self.assertEqual(unanswered, len(events))

    def test_lost_messages_are_its_unanswered_requests(self):
        sonar = self.connected("kind: loss, rate: 0.3")
        unanswered = sum(self.ask(sonar) is None for _ in range(REQUESTS))
        events = self.events()
        self.assertGreater(len(events), 3)
        self.assertEqual(unanswered, len(events))
        self.assertEqual((sonar.parser.parsed, sonar.parser.errors), (REQUESTS - unanswered, 0))


NMEA = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: depth
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["pty:{folder}/depth"]
    options: {rate: 15, baud: 38400, sentences: DPT, range: 10}
"""


class Pynmea2(Counted):
    """Debian's pynmea2: the ParseErrors of its stream reader."""

    def errors(self, *faults):
        try:
            import pynmea2
        except ImportError:
            if os.environ.get("CI"):
                raise
            self.skipTest("python3-nmea2 is not installed: run tools/install test")
        folder = self.start(NMEA, "depth", *faults)
        line = os.open(folder / "depth", os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        tty.setraw(line, termios.TCSANOW)
        reader = pynmea2.NMEAStreamReader(errors="yield")
        found = []
        while not self.faults_are_over():
            if select.select([line], [], [], 0.1)[0]:
                found += reader.next(os.read(line, 4096).decode("latin-1"))
        return [f for f in found if isinstance(f, pynmea2.ParseError)], [f for f in found if isinstance(f, pynmea2.NMEASentence)]

    def test_wrong_checksums_are_its_checksum_errors(self):
        import pynmea2

        errors, good = self.errors(f"until: {FAULTS_END}, kind: wrong_checksum, rate: 0.4")
        events = self.events()
        self.assertGreater(len(events), 5)
        self.assertGreater(len(good), 20)
        self.assertTrue(all(isinstance(e, pynmea2.ChecksumError) for e in errors))
        self.assertEqual(len(errors), len(events))

    def test_sentences_with_flipped_bits_are_its_errors(self):
        errors, good = self.errors(f"until: {FAULTS_END}, kind: bit_flips, rate: 0.001")
        events = self.events()
        self.assertGreater(len({e["message"] for e in events}), 3)
        self.assertGreater(len(good), 20)
        self.assertEqual(len(errors), len({e["message"] for e in events}))


SONAR_3D = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - name: sonar
    model: sonar-3d-15
    endpoints: ["tcp-listen://127.0.0.1:%d"]
    options: {acoustics: true, speed_of_sound: 1500}
"""


class Wlsonar(Counted):
    """Water Linked's wlsonar refuses each damaged image by itself."""

    def refused(self, *faults):
        public_driver.use("wlsonar", "wlsonar")
        import wlsonar
        import wlsonar.range_image_protocol as rip

        port = free_port()
        self.start(SONAR_3D % port, "sonar", *faults)
        sock = wlsonar.open_sonar_udp_unicast_socket(udp_port=0, iface_ip="127.0.0.1")
        self.addCleanup(sock.close)
        sock.settimeout(30)
        wlsonar.Sonar3D("127.0.0.1", port=port).set_udp_unicast("127.0.0.1", sock.getsockname()[1])
        errors, good = [], 0
        while not self.faults_are_over() or good == 0:
            try:
                rip.unpackb(sock.recv(65507))
                good += 1
            except ValueError as error:
                errors.append(error)
            except socket.timeout:
                break
        return errors

    def test_truncated_images_are_refused(self):
        errors = self.refused(f"until: {FAULTS_END}, port: images, kind: truncation, rate: 0.3")
        events = self.events()
        self.assertGreater(len(events), 1)
        self.assertEqual(len(errors), len(events))


if __name__ == "__main__":
    unittest.main()
