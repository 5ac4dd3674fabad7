"""echoloop run: start-up lines, clean ends, and starts that fail whole."""
import json
import os
import pathlib
import re
import resource
import signal
import socket
import struct
import subprocess
import time
import tty
import unittest

from program import PROGRAM, ROOT, TANK, ProgramTest

FLOOR = str(ROOT / "config" / "bathymetry.yaml")
PING360 = str(ROOT / "config" / "ping360.yaml")


class Run(ProgramTest):
    def micron(self, endpoint):
        return ("--set", f"devices.micron.endpoints=['{endpoint}']")

    def test_start_up_lines_can_be_pasted_and_the_link_is_gone_at_the_end(self):
        link = self.folder / "micron"
        text = self.good("run", TANK, "--duration", "0.2", *self.micron(f"pty:{link}"))
        self.assertRegex(text, rf"(?m)^  line +{link}, 115200 bit/s 8N1$")
        self.assertIn("running for 0.2 s; Ctrl-C ends it", text)
        self.assertRegex(text, r"(?m)^micron +0 pings, none late$")
        self.assertRegex(text, r"(?m)^  from the driver: 0 bytes, 0 messages understood, 0 refused")
        self.assertFalse(link.is_symlink())

    def test_a_unit_that_sends_no_pings_is_summed_up_by_its_messages(self):
        ports = ["udp://127.0.0.1:9", *(f"pty:{self.folder}/{name}" for name in ("tss1", "em3000"))]
        unit = ("--set", f"devices.ins.endpoints={ports}")
        text = self.good("run", str(ROOT / "config" / "ins.yaml"), "--duration", "1", *unit)
        self.assertRegex(text, r"(?m)^ins +[1-9][0-9]* messages; it is no sonar and sends no pings$")
        self.assertNotIn("late", text)
        self.assertNotIn("all sonars", text)

    def test_a_signal_ends_it_cleanly(self):
        link = self.folder / "micron"
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([PROGRAM, "run", TANK, "--json", *self.micron(f"pty:{link}")],
                                  stdout=subprocess.PIPE) as process:
                started = json.loads(process.stdout.readline())
                self.assertEqual(started["event"], "started")
                with open(link, "rb", buffering=0) as line:
                    self.assertTrue(line.read(1))  # the head's first sign of life: it runs
                process.send_signal(number)
                ended = json.loads(process.stdout.readline())
                self.assertEqual(process.wait(timeout=60), 0)
            self.assertEqual(ended["event"], "ended")
            self.assertEqual(ended["devices"][0]["name"], "micron")
            self.assertFalse(link.is_symlink())

    def test_a_missed_deadline_fails_a_run_only_on_request(self):
        hasty = ("--set", "clock={mode: scaled, rate: 1000}", "--duration", "0.5")  # no machine is that fast
        self.assertRegex(self.good("run", FLOOR, *hasty), r"\d late \(\d+ because of rendering, \d+ because the program was woken late\), the worst by [\d.]+ ms")
        self.assertRegex(self.bad(75, "run", FLOOR, *hasty, "--fail-late"),
                         r"multibeam: [1-9]\d* late pings?, \d+ dropped messages? and \d+ lost bytes?, and --fail-late allows none")
        ended = json.loads(self.good("run", FLOOR, *hasty, "--json").splitlines()[-1])["devices"][0]
        self.assertGreater(ended["late_renderings"], ended["late_pings"] / 2)

    def test_a_run_that_does_not_keep_up_spares_pings_something_and_says_so(self):
        hasty = ("--set", "clock={mode: scaled, rate: 1000}", "--duration", "4")  # no machine is that fast
        self.assertRegex(self.good("run", FLOOR, *hasty),
                         r"rendering did not keep up: \d+ pings without late echoes of the ping before, [1-9]\d* of them drawn "
                         r"with a quarter of the pixels")
        ended = json.loads(self.good("run", FLOOR, *hasty, "--json").splitlines()[-1])["devices"][0]
        # Five late pings, or two that were very late, make the first step.
        self.assertIn(ended["spared_pings"] - ended["coarse_pings"], range(1, 6), ended)
        self.assertGreater(ended["pings"], ended["coarse_pings"], ended)

    def test_pings_of_a_run_that_was_kept_from_running_did_not_wait_for_their_rendering(self):
        slow = ("--set", "devices.multibeam.options={range: 100, ping_rate: 5}")  # 133 ms for a rendering of few
        with subprocess.Popen([PROGRAM, "run", FLOOR, "--json", *slow], stdout=subprocess.PIPE) as process:
            process.stdout.readline()
            stops = 4
            for _ in range(stops):
                time.sleep(0.3)
                process.send_signal(signal.SIGSTOP)
                time.sleep(0.5)  # longer than from one ping to the next
                process.send_signal(signal.SIGCONT)
            process.send_signal(signal.SIGINT)
            ended = json.loads(process.stdout.readline())["devices"][0]
            self.assertEqual(process.wait(timeout=60), 0)
        self.assertGreaterEqual(ended["late_pings"] - ended["late_renderings"], stops - 1)  # the last may be under way
        self.assertGreaterEqual(ended["late_wakings"], stops - 1)
        self.assertGreater(ended["worst_lateness_s"], 0.2)

    def test_bytes_that_a_driver_does_not_read_are_lost_and_a_run_can_fail_for_it(self):
        """In steps, so that no ping is late."""
        link = self.folder / "ping360"
        scan = (1, 1, 80, 200, 750, 1200, 0, 399, 1, 0)  # mode, gain, duration, period, kHz, samples, start, stop, step, delay
        frame = b"BR" + struct.pack("<HHBB", 16, 2602, 0, 0) + struct.pack("<BBHHHHHHBB", *scan)
        clock = f"clock={{mode: stepped, input: 'pty:{self.folder}/simulator'}}"
        arguments = ("run", PING360, "--fail-late", "--set", clock, "--set", f"devices.ping360.endpoints=['pty:{link}']")
        with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            while "Ctrl-C" not in process.stdout.readline():
                pass
            line, simulator = (os.open(path, os.O_RDWR | os.O_NOCTTY) for path in (link, self.folder / "simulator"))
            tty.setraw(line)
            tty.setraw(simulator)
            os.write(line, frame + struct.pack("<H", sum(frame)))
            for now in (0, 0.4):  # s; the kernel keeps some 13 kB, which are eleven pings of 25
                os.write(simulator, b'{"now": %.1f}\n' % now)
                answer = b""
                while b"\n" not in answer:
                    answer += os.read(simulator, 4096)
                self.assertIn(b'"ack"', answer)
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=60)
            os.close(line)
            os.close(simulator)
        self.assertEqual(process.returncode, 75, errors)
        lost = re.search(r"; (\d+) bytes? lost, because the driver did not read them", output)
        self.assertTrue(lost, output)
        self.assertIn(f"ping360: 0 late pings, 0 dropped messages and {lost[1]} lost byte", errors)

    def test_the_summary_says_how_late_pings_were_and_how_long_the_queue_was(self):
        text = self.good("run", FLOOR, "--duration", "1")
        self.assertRegex(text, r"time after they were due: median [\d.]+ ms, 99th percentile [\d.]+ ms")
        self.assertRegex(text, r"at most [1-9]\d* messages? at once in the queue")
        ended = json.loads(self.good("run", FLOOR, "--duration", "1", "--json").splitlines()[-1])
        for device in ended["devices"]:
            median, p99 = device["median_lateness_s"], device["p99_lateness_s"]
            self.assertTrue(0 <= median <= p99 <= device["worst_lateness_s"], device)
            self.assertGreater(device["most_waiting_bytes"], 0)

    def test_a_vehicle_without_a_pose_from_outside_is_told(self):
        pilot = f"vehicle={{input: 'pty:{self.folder}/pilot'}}"
        text = self.good("run", TANK, "--duration", "0.2", "--set", pilot, *self.micron(f"pty:{self.folder}/line"))
        self.assertRegex(text, r"(?m)^vehicle +0 poses from .*: nobody said where the vehicle is, so it stayed at vehicle\.pose")

    def test_truth_in_a_recording_needs_a_recording(self):
        self.assertIn("--record FILE", self.bad(64, "run", TANK, "--record-truth", "--duration", "0"))

    def test_a_port_in_use_ends_with_69(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            uri = f"tcp-listen://127.0.0.1:{taken.getsockname()[1]}"
            self.assertIn(f"{uri}: already in use", self.bad(69, "run", TANK, "--duration", "0", *self.micron(uri)))

    def test_a_link_name_that_exists_ends_with_73_and_stays(self):
        (self.folder / "mine").write_text("precious")
        text = self.bad(73, "run", TANK, "--duration", "0", *self.micron(f"pty:{self.folder}/mine"))
        self.assertIn("/mine: exists already and is a file; name another link", text)
        self.assertEqual((self.folder / "mine").read_text(), "precious")
        (self.folder / "link").symlink_to(self.folder / "mine")
        text = self.bad(73, "run", TANK, "--duration", "0", *self.micron(f"pty:{self.folder}/link"))
        self.assertIn(f"exists already and leads to {self.folder}/mine; ", text)

    @unittest.skipIf(os.getuid() != 0, "only root can make folders of another user")
    def test_a_folder_that_another_user_made_where_everybody_may_is_refused(self):
        shared = self.folder / "shared"  # as /tmp is
        shared.mkdir()
        shared.chmod(0o1777)
        for name, make in (("folder", lambda f: f.mkdir()), ("link", lambda f: f.symlink_to(self.folder))):
            make(shared / name)
            os.chown(shared / name, 12345, 12345, follow_symlinks=False)
            for arguments in (self.micron(f"pty:{shared}/{name}/micron"),
                              ("--control", f"unix:{shared}/{name}/control", *self.micron(f"pty:{self.folder}/micron"))):
                text = self.bad(77, "run", TANK, "--duration", "0", *arguments)
                self.assertIn(f"{shared}/{name}: directory for the ", text)
                self.assertIn("the user number 12345, who could exchange what is in it; name another", text)

    def test_a_recording_does_not_follow_a_link(self):
        link, target = self.folder / "dive.pcapng", self.folder / "elsewhere"
        link.symlink_to(target)
        for option in ("--record", "--truth", "--labels"):
            text = self.bad(73, "run", TANK, "--duration", "0", option, str(link),
                            *self.micron(f"pty:{self.folder}/micron"))
            self.assertIn("links are not followed", text)
        self.assertFalse(target.exists())

    def test_too_little_memory_is_called_so(self):
        """OpenGL needs more than 700 MiB of addresses, our own rasteriser more than 300, and more where there are many
        processors."""
        steps = (100, 150, 200, 250, 300, 350, 360, 370, 380, 390, 400, 450, 500, 600, 700)
        for sampler, always in (("raster", 700), ("native", 300)):
            for mebibytes in steps:
                done = subprocess.run(
                    [PROGRAM, "run", TANK, "--duration", "0", *self.micron(f"pty:{self.folder}/micron"),
                     "--set", f"render.sampler={sampler}"],
                    capture_output=True, text=True, timeout=60,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (mebibytes << 20,) * 2))
                if mebibytes > always and done.returncode == 0:
                    continue
                self.assertEqual(done.returncode, 71, (sampler, mebibytes, done.stderr))
                self.assertRegex(done.stderr, r"^echoloop: error: not enough memory.*ulimit -v.*\n$")

    def test_what_is_no_serial_port_ends_with_69(self):
        for path in ("/dev/null", TANK):
            text = self.bad(69, "run", TANK, "--duration", "0", *self.micron(f"serial://{path}:9600"))
            self.assertIn(f"{path}: is no serial port; ", text)
            self.assertIn("use a pty: endpoint", text)

    def test_a_folder_without_permission_ends_with_73(self):
        for login, instead in ((self.folder, f"{self.folder}/echoloop"), ("relative", ""), ("/no/such", "")):
            text = self.bad(73, "run", TANK, "--duration", "0", *self.micron("pty:/proc/no/micron"), XDG_RUNTIME_DIR=str(login))
            self.assertIn("/proc/no", text)
            if not instead:  # nobody else's
                home = pathlib.Path(f"/run/user/{os.getuid()}")
                instead = home / "echoloop" if home.is_dir() else f"/tmp/echoloop-{os.getuid()}"
            self.assertIn(f"e.g. pty:{instead}/micron", text)

    def test_nothing_is_half_started(self):
        link = self.folder / "first"
        text = ("scene: TANK\ndevices:\n"
                f"  - {{name: a, model: tritech-micron, endpoints: ['pty:{link}']}}\n"
                "  - {name: b, model: tritech-micron, endpoints: ['pty:/proc/no/micron']}\n")
        self.bad(73, "run", self.scenario(text), "--duration", "0")
        self.assertFalse(link.is_symlink())

    def test_a_hostile_scene_ends_with_65(self):
        (self.folder / "bad.glb").write_bytes(b"glTF" * 50)
        file = self.scenario("scene: bad.glb\ndevices: [{name: a, model: tritech-micron}]\n")
        self.assertIn("bad.glb", self.bad(65, "run", file, "--duration", "0"))

    def test_bathymetry_reaches_a_listener(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.bind(("127.0.0.1", 0))
            listener.settimeout(60)
            port = listener.getsockname()[1]
            ends = f"devices.multibeam.endpoints=[udp-listen://127.0.0.7:45500, udp://127.0.0.1:{min(port, 65528)}]"
            with subprocess.Popen([PROGRAM, "run", FLOOR, "--set", ends], stdout=subprocess.DEVNULL) as process:
                try:
                    datagram = listener.recv(65536)
                finally:
                    process.terminate()
            self.assertEqual(datagram[:4], b"BTH0")


if __name__ == "__main__":
    unittest.main()
