"""From a running head to the maker's .852 and .81A files, read back by a reader written apart from the C++."""

import subprocess
import time
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

from ports import free_port
from program import PROGRAM, Emulator

import imagenex_wire as wire
from byte_line import open_line
from imagenex_host import Host
from shared_data import needs_data

SCENE = """
scene: {scenes}/flat.glb
water: {sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
"""
SOUNDER = "  - {name: down, model: imagenex-852, mount: {rpy_deg: [0, 90, 0]}, endpoints: ['%s']}\n"
SONAR = "  - {name: ahead, model: imagenex-881a, endpoints: ['%s']}\n"
PTY = "pty:{folder}/%s"


class Files(unittest.TestCase):
    def setUp(self):
        folder = TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.capture = self.folder / "run.pcapng"

    def convert(self, *arguments, status=0):
        done = subprocess.run([PROGRAM, "convert", *map(str, arguments)], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout if status == 0 else done.stderr

    def record(self, devices, lines):
        """Runs the devices and their hosts; [[reply, ...], ...]."""
        said = []
        with Emulator(SCENE + devices, "--record", str(self.capture)) as emulator:
            for uri, commands in lines:
                line = open_line(uri if "://" in uri else str(emulator.folder / uri))
                host = Host(line)
                said.append([host.ask(command) for command in commands])
                line.close()
            self.assertEqual(emulator.stop()[0], 0)
        return said

    def test_an_852_from_a_recorded_run(self):
        commands = [wire.sounder_command(points=p, gain=g) for p, g in ((50, 12), (25, 13), (50, 14))]
        commands.append(wire.sounder_command(profile=1))
        replies = self.record(SOUNDER % PTY % "line", [("line", commands)])[0]
        out = self.folder / "dive.852"
        self.assertIn("4 shots", self.convert(self.capture, out))
        shots = wire.read_file(out.read_bytes())
        self.assertEqual([wire.parse(shot.reply) for shot in shots], replies)
        self.assertEqual([shot.gain for shot in shots], [12, 13, 14, 12])
        self.assertEqual({shot.pulse for shot in shots}, {100})
        self.assertEqual({shot.sound_speed for shot in shots}, {1500.0})
        today = {time.strftime("%d-%b-%Y", time.gmtime(time.time() - age)) for age in (0, 120)}
        self.assertIn(shots[0].date, today)
        self.assertEqual([shot.time for shot in shots], sorted(shot.time for shot in shots))

    def test_an_81a_over_tcp(self):
        port = free_port()
        commands = [wire.command(points=25, step=8)] * 3 + [wire.command(profile=1)]
        replies = self.record(
            SONAR % f"tcp-listen://127.0.0.1:{port}", [(f"tcp://127.0.0.1:{port}", commands)]
        )[0]
        out = self.folder / "scan.81a"
        self.assertIn("4 shots", self.convert(self.capture, out))
        shots = wire.read_file(out.read_bytes())
        self.assertEqual([wire.parse(shot.reply) for shot in shots], replies)
        self.assertEqual([shot.header[37] for shot in shots], [0x80 | 1 << 3 | 4] * 3 + [0x80 | 1 << 3 | 2])

    def test_of_two_lines_one_is_chosen(self):
        self.record(
            SOUNDER % PTY % "down" + SONAR % PTY % "ahead",
            [("down", [wire.sounder_command()]), ("ahead", [wire.command()] * 2)],
        )
        out = self.folder / "dive.852"
        complaint = self.convert(self.capture, out, status=64)
        self.assertIn("choose one with --line: 'ahead line', 'down line'", complaint)
        self.assertFalse(out.exists())
        self.assertIn("1 shot", self.convert(self.capture, out, "--line", "down line"))
        self.assertIn("it holds", self.convert(self.capture, out, "--line", "nobody", status=64))

    def test_raw_bytes_of_both_directions(self):
        reply = bytes.fromhex("49505811 45780A05 2C010000 FC")
        raw = self.folder / "line.bin"
        raw.write_bytes(b"noise" + wire.sounder_command(gain=7, profile=1) + reply + b"\0" + reply)
        out = self.folder / "raw.852"
        self.assertIn("2 shots", self.convert(raw, out))
        shots = wire.read_file(out.read_bytes())
        self.assertEqual([(shot.gain, shot.reply) for shot in shots], [(7, reply)] * 2)

    def test_what_cannot_be_converted_is_refused_with_a_reason(self):
        raw = self.folder / "line.bin"
        raw.write_bytes(wire.command())
        self.assertIn("no reply", self.convert(raw, self.folder / "a.852", status=65))
        raw.write_bytes(bytes.fromhex("49475810400002 1E 0000 6807") + bytes(1000) + b"\xfc")
        self.assertIn("no reply", self.convert(raw, self.folder / "a.81a", status=65), "an 872's has 1000 samples")
        self.assertIn(".852, .81A, .31l", self.convert(raw, self.folder / "a.gsf", status=64))
        self.assertEqual([p.name for p in self.folder.iterdir()], ["line.bin"], "nothing half made is left")

    def test_inspect_reads_a_recorded_file_to_its_end(self):
        path = needs_data("imagenex852/hydroball.852")
        done = subprocess.run([PROGRAM, "inspect", "--summary", path], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout, "messages: Shot852 177; broken 0; not decoded 0 bytes\n")


if __name__ == "__main__":
    unittest.main()
