"""A run without anybody outside, and sweeps of such runs: as fast as the machine renders, the same bytes each time, no
port opened; a run that was killed is made again, and a part of a sweep gives what the whole gives."""
import hashlib
import json
import os
import signal
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = os.environ["ECHOLOOP"]
TANK = Path(__file__).resolve().parents[2] / "config" / "scenes" / "tank.glb"

# A request (message 6) for profile 1300, with the sum of its bytes, as the Ping protocol has it.
REQUEST = bytes.fromhex("4252020006000000") + struct.pack("<H", 1300)
REQUEST += struct.pack("<H", sum(REQUEST))

SCENARIO = f"""
scene: {TANK}
water: {{temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{pose: {{position: [0, 0, -2]}}}}
clock: {{mode: free, duration: 8}}
effects: {{ring_down: off, interference: off}}
devices:
  - name: scanner
    model: ping360
    endpoints: ["udp-listen://127.0.0.1:9092"]
    pings: {{interval: 0.5, count: 8}}
  - name: sounder
    model: ping1d
    mount: {{rpy_deg: [0, 90, 0]}}
    endpoints: ["udp-listen://127.0.0.1:9093"]
    driver:
      - {{at: 1, every: 1, times: 5, hex: "{REQUEST.hex(' ')}"}}
"""
SWEEP = """
sweep:
  runs: 6
  vary:
    vehicle.pose.position.0: {uniform: [-3, 3]}
    water.temperature: {list: [5, 15, 25]}
    devices.scanner.pings.interval: {choice: [0.4, 0.5]}
"""


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)


def frames(capture, source):
    """Ping messages in the UDP payloads of a pcapng file that come from port `source`, read without our reader."""
    data, at, found = capture.read_bytes(), 0, []
    while at < len(data):
        kind, length = struct.unpack_from("<II", data, at)
        if kind == 6:  # enhanced packet block
            packet = data[at + 28: at + 28 + struct.unpack_from("<I", data, at + 20)[0]]
            ip = packet[(packet[0] & 15) * 4:] if packet[0] >> 4 == 4 else b""
            if packet[9] == 17 and struct.unpack_from(">H", ip, 0)[0] == source and ip[8:10] == b"BR":
                found.append(ip[8:])
        at += length
    return found


def sum_of(folder):
    total = hashlib.sha256()
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            total.update(str(file.relative_to(folder)).encode() + file.read_bytes())
    return total.hexdigest()


class Free(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="free-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "free.yaml"
        self.write(SCENARIO)

    def write(self, text):
        self.file.write_text(text)

    def record(self, name, *more):
        capture, truth = self.folder / f"{name}.pcapng", self.folder / f"{name}.jsonl"
        done = run("run", str(self.file), "--json", "--record", str(capture), "--truth", str(truth), *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return capture, truth, [json.loads(line) for line in done.stdout.splitlines()]

    def test_the_scenarios_own_drivers_get_their_pings_and_no_time_is_waited_for(self):
        began = time.monotonic()
        capture, truth, _ = self.record("one", "--duration", "400")
        self.assertLess(time.monotonic() - began, 200, "400 s of the run take much less than that")
        answers = frames(capture, 9092)
        # 2300 device_data: angle at byte 12 of the payload (after mode and gain)
        angles = [struct.unpack_from("<H", a, 8 + 2)[0] for a in answers if a[4:6] == struct.pack("<H", 2300)]
        self.assertEqual(angles, list(range(8)))
        pings = [json.loads(line) for line in truth.read_text().splitlines()[1:]]
        self.assertEqual(sum(p["device"] == "scanner" for p in pings), 8)
        profiles = [a for a in frames(capture, 9093) if a[4:6] == struct.pack("<H", 1300)]
        self.assertEqual(len(profiles), 5)

    def test_what_goes_over_tcp_is_recorded_too(self):
        self.write(SCENARIO[:SCENARIO.index("  - name: scanner")] +
                   "  - {name: sidescan, model: edgetech-2205, options: {start: high}}\n")
        capture, _, lines = self.record("tcp", "--duration", "1")
        sides = capture.read_bytes().count(b"\x01\x16\x0D\0\x50\0")  # headers of its data, one for each side of a ping
        self.assertGreater(sides, 20)
        self.assertEqual(sides, 2 * lines[-1]["devices"][0]["pings"])

    def test_the_same_bytes_each_time_and_beside_a_twin(self):
        one, truth, _ = self.record("one")
        # A twin at the same time: both name the port 9092, and neither opens it.
        twin = subprocess.Popen([PROGRAM, "run", str(self.file), "--json", "--record", str(self.folder / "two.pcapng")],
                                stdout=subprocess.DEVNULL)
        third, _, _ = self.record("three")
        self.assertEqual(twin.wait(timeout=300), 0)
        self.assertEqual(one.read_bytes(), third.read_bytes())
        self.assertEqual(one.read_bytes(), (self.folder / "two.pcapng").read_bytes())

    def test_a_run_that_cannot_end_and_drivers_where_somebody_is_outside(self):
        self.write(SCENARIO.replace(", duration: 8", ""))
        done = run("run", str(self.file))
        self.assertEqual(done.returncode, 64)
        self.assertIn("clock.duration", done.stderr)
        self.write(SCENARIO.replace("mode: free, duration: 8", "mode: real"))
        done = run("check", str(self.file))
        self.assertEqual(done.returncode, 78)
        self.assertIn("devices.scanner.pings: only a free run", done.stderr)
        self.write(SCENARIO.replace('hex: "42', 'hex: "4'))
        done = run("check", str(self.file))
        self.assertIn("free.yaml:17:42: devices.sounder.driver.0.hex", done.stderr)
        self.assertIn("pairs of hexadecimal digits", done.stderr)

    def sweep(self, out, *arguments, status=0):
        done = run("sweep", str(self.file), "--out", str(self.folder / out), *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return self.folder / out

    def test_a_sweep_in_parts_is_the_sweep_as_a_whole(self):
        self.write(SCENARIO + SWEEP)
        whole = self.sweep("whole")
        self.assertEqual(sorted(f.name for f in whole.iterdir()), [f"{i:06}" for i in range(6)])
        for shard in ("1/2", "0/2"):
            parts = self.sweep("parts", "--shard", shard)
        self.assertEqual(sum_of(whole), sum_of(parts))
        alone = self.sweep("alone", "--index", "4")
        self.assertEqual(sum_of(whole / "000004"), sum_of(alone / "000004"))
        task = self.folder / "task"
        done = run("sweep", str(self.file), "--out", str(task), "--shard", "task/6",
                   env=os.environ | {"SLURM_ARRAY_TASK_ID": "3"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sum_of(whole / "000003"), sum_of(task / "000003"))
        values = [json.loads((whole / f"{i:06}" / "values.json").read_text())["values"] for i in range(6)]
        self.assertEqual([v["water.temperature"] for v in values], [5, 15, 25] * 2)
        places = [v["vehicle.pose.position.0"] for v in values]
        self.assertEqual(len(set(places)), 6)
        self.assertTrue(all(-3 <= p <= 3 for p in places))
        self.assertEqual(len({v["seed"] for v in values}), 6)

    def test_a_killed_part_is_made_again_and_nothing_half_is_taken_for_whole(self):
        self.write(SCENARIO + SWEEP)
        out = self.folder / "runs"
        killed = subprocess.Popen([PROGRAM, "sweep", str(self.file), "--out", str(out)], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        while not (out / ".000002.part" / "capture.pcapng").exists() and killed.poll() is None:
            time.sleep(0.002)  # nothing to wait on: another process makes a file
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        whole = {f.name for f in out.iterdir() if not f.name.startswith(".")}
        self.assertLessEqual(whole, {"000000", "000001", "000002"})
        self.sweep("runs")
        self.assertEqual(sum_of(out), sum_of(self.sweep("again")))

    def test_what_a_sweep_gets_wrong_is_said_with_its_place(self):
        self.write(SCENARIO + SWEEP.replace("water.temperature: {list", "water.temprature: {list"))
        done = run("sweep", str(self.file), "--print")
        self.assertEqual(done.returncode, 78)
        self.assertIn("sweep.vary.water.temprature, run 0", done.stderr)
        self.assertIn("did you mean 'temperature'", done.stderr)
        self.write(SCENARIO + SWEEP.replace("uniform: [-3, 3]", "uniform: [3, -3]"))
        self.assertIn("swap them", run("sweep", str(self.file), "--print").stderr)
        self.write(SCENARIO)
        self.assertIn("has no sweep", run("sweep", str(self.file), "--print").stderr)
        self.write(SCENARIO + SWEEP)
        shown = run("sweep", str(self.file), "--index", "2", "--print").stdout
        again = self.folder / "again.yaml"
        again.write_text(shown)
        self.assertIn("temperature: 25", shown)
        self.assertEqual(run("check", str(again)).returncode, 0, run("check", str(again)).stderr)


if __name__ == "__main__":
    unittest.main()
