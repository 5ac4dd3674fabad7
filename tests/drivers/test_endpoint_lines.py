"""What `echoloop endpoints --format python` prints for a device runs as it is, in the package that it names, against the
running program."""

import subprocess
import unittest

import public_driver
from ports import free_port
from program import PROGRAM, Emulator

CONFIG = public_driver.ROOT / "config"


def lines_for(scenario, device, endpoint, format):
    change = f"devices.{device}.endpoints=[{endpoint}]"
    return subprocess.run([PROGRAM, "endpoints", scenario, "--format", format, "--set", change],
                          capture_output=True, text=True, check=True).stdout


class Python(unittest.TestCase):
    def says(self, package, folder, scenario, device, endpoint, word):
        """The printed lines, run by the Python that has the package, print `word`."""
        public_driver.use(folder, package)
        file = CONFIG / scenario
        lines = lines_for(file, device, endpoint, "python")
        python = public_driver.ROOT / "build" / "drivers" / folder / "bin" / "python"
        text = file.read_text().replace("scenes/", str(CONFIG / "scenes") + "/")
        with Emulator(text, "--set", f"devices.{device}.endpoints=[{endpoint}]"):
            ran = subprocess.run([python, "-c", lines], capture_output=True, text=True, timeout=60)
        self.assertEqual(ran.returncode, 0, lines + ran.stderr)
        self.assertIn(word, ran.stdout, lines)

    def test_ping1d_on_a_pty(self):
        self.says("brping", "ping1d", "ping1d.yaml", "ping1d", "pty:/tmp/echoloop/lines-ping1d", "'distance'")

    def test_ping1d_by_udp(self):
        self.says("brping", "ping1d", "ping1d.yaml", "ping1d", f"udp-listen://127.0.0.1:{free_port()}", "'distance'")

    def test_ping360(self):
        self.says("brping", "ping360", "ping360.yaml", "ping360", f"udp-listen://127.0.0.1:{free_port()}", "angle")

    def test_s500(self):
        for scheme in "tcp-listen", "udp-listen":
            self.says("brping", "ping360", "s500.yaml", "s500", f"{scheme}://127.0.0.1:{free_port()}", "length_mm")

    def test_omniscan(self):
        self.says("brping", "ping360", "omniscan450.yaml", "port", f"tcp-listen://127.0.0.1:{free_port()}", "device_type")

    def test_surveyor(self):
        self.says("brping", "ping360", "surveyor240.yaml", "surveyor", f"tcp-listen://127.0.0.1:{free_port()}",
                  "device_type")

    def test_sonar_3d_15(self):
        self.says("wlsonar", "wlsonar", "sonar-3d-15.yaml", "sonar", f"tcp-listen://127.0.0.1:{free_port()}", "StatusEntry")


if __name__ == "__main__":
    unittest.main()
