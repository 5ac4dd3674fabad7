"""What `echoloop diff` says of a field over all messages: constant or not, ranges, distributions, intervals. Captures
made here, so that every figure is known."""
import functools
import json
import math
import random
import re
import statistics
import struct
import unittest

from captures import ETHERNET, Pcapng, ethernet, ipv4, udp
from program import ProgramTest, run
from test_clock_steps import svlog
from test_diff import device_data, line_capture

H0_RX_RANGE = 12 + 88  # B, of the R2Sonic manual


def scan_of(gains, samples=None):
    return [(device_data(i, gain=gain, samples=samples[i] if samples else bytes(range(40))), True)
            for i, gain in enumerate(gains)]


class Spread(ProgramTest):
    def run_on(self, a, b, *arguments):
        for name, data in (("a", a), ("b", b)):
            (self.folder / name).write_bytes(data)
        done = run("diff", self.folder / "a", self.folder / "b", *arguments)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.stdout.decode()

    def type_(self, a, b, *arguments):
        report = json.loads(self.run_on(a, b, "--json", *arguments))
        type_ = max(report["directions"][0]["types"], key=lambda one: one["a"])
        return type_, {field["name"]: field for field in type_["fields"]}

    def test_constant_here_and_79_values_there(self):
        gains = [index % 79 + 100 for index in range(120)]
        text = self.run_on(line_capture(scan_of([25] * 120)), line_capture(scan_of(gains)))
        self.assertRegex(text, r"gain_setting +DIFFERENT in 120 of 120\n +A constant 25; B 79 values, 100 to 178, median 129; ")
        self.assertRegex(text, r"constant on one side only:\n  ping DeviceData.gain_setting: A constant 25; B 79 values")

    def test_what_differs_by_nature_is_named_too_if_it_stands_still_on_one_side(self):
        def alive(time_ms):
            body = struct.pack("<BIHB", 0, time_ms, 3200, 0x4A)
            return bytes.fromhex("4030303130100002ff0b048002") + body + b"\n"
        moving = line_capture([(alive(1000 + 10 * i), True) for i in range(30)], b"head line")
        still = line_capture([(alive(1000), True) for _ in range(30)], b"head line")
        text = self.run_on(moving, still)
        self.assertIn("equal, but for what differs by nature", text)
        self.assertRegex(text, r"one side only:\n  seanet Alive.time_ms: A 30 values, 1000 to 1290, median 1140; B constant 1000")

    def test_ranges_and_moments(self):
        source = random.Random(7)
        gains = [source.randrange(50, 200) for _ in range(200)]
        _, fields = self.type_(line_capture(scan_of(gains)), line_capture(scan_of([3] * 200)))
        found = fields["gain_setting"]
        self.assertEqual((found["a"]["count"], found["a"]["distinct"]), (200, len(set(gains))))
        self.assertEqual((found["a"]["min"], found["a"]["max"]), (min(gains), max(gains)))
        self.assertEqual(found["a"]["median"], statistics.median_low(gains))
        self.assertAlmostEqual(found["a"]["mean"], statistics.fmean(gains), places=6)
        self.assertAlmostEqual(found["a"]["deviation"], statistics.pstdev(gains), places=6)
        self.assertEqual((found["b"]["constant"], found["b"]["distinct"]), (3, 1))

    def test_the_distance_of_two_distributions(self):
        """0 for the same, 1 for nothing in common; for half in common the closed form of the Jensen-Shannon distance."""
        def made(low, high, seed):
            source = random.Random(seed)
            return line_capture(scan_of([1] * 50, [bytes(source.randrange(low, high) for _ in range(400)) for _ in range(50)]))
        base = made(0, 100, 1)
        for other, distance, delta in ((base, 0, 1e-9), (made(0, 100, 2), 0.03, 0.03), (made(100, 200, 3), 1, 0.02),
                                       (made(50, 150, 4), math.sqrt(0.5), 0.03)):
            _, fields = self.type_(base, other)
            self.assertAlmostEqual(fields["data"]["distance"], distance, delta=delta)
        few = line_capture(scan_of([1, 2, 3]))
        self.assertNotIn("distance", self.type_(few, few)[1]["gain_setting"])

    def test_intervals_are_told_as_a_distribution(self):
        steps = [20_000_000 + 1_000_000 * (i % 5) for i in range(50)]
        capture = Pcapng().interface(ETHERNET, b"eth")
        for i in range(51):
            capture.packet(0, ethernet(ipv4(udp(device_data(7)))), 10**9 + sum(steps[:i]))
        even = Pcapng().interface(ETHERNET, b"eth")
        for i in range(51):
            even.packet(0, ethernet(ipv4(udp(device_data(7)))), 10**9 + 22_000_000 * i)
        text = self.run_on(capture.data, even.data)
        self.assertRegex(text, r"from one to the next, ms:\n +A 5 values, 20 to 24, median 22, 95 % up to 24, deviation 1\.41421\n"
                               r" +B constant 22\n")

    def test_a_file_without_packets_is_timed_by_its_own_clock(self):
        type_, _ = self.type_(svlog([10 + 0.2 * i for i in range(20)]), svlog([10 + 0.25 * i for i in range(20)]))
        self.assertEqual((type_["own_gap"]["a"]["constant"], type_["own_gap"]["b"]["constant"]), (0.2, 0.25))
        self.assertEqual(type_["gap"], {"a": None, "b": None})

    def test_texts_and_numbers_of_many_digits(self):
        """A float of 3e60 as it stands in the damaged frame of a real log would take 61 digits."""
        sentence = "$SDDBT,%s,f,%s,M,%s,F*%02X\r\n"

        def line(depth):
            body = sentence[1:].split("*")[0] % (depth, depth, depth)
            return f"${body}*{__import__('functools').reduce(lambda x, c: x ^ ord(c), body, 0):02X}\r\n".encode()
        a = line_capture([(line("9.5"), True) for _ in range(5)], b"line")
        b = line_capture([(line("3" + "0" * 60), True) for _ in range(5)], b"line")
        text = self.run_on(a, b, "--all")
        self.assertIn("DIFFERENT", text)
        self.assertIsNone(re.search(r"\d{17}", text), text)

    def test_one_unit_in_the_last_place_is_equal(self):
        real = bytearray(self.shared("r2sonic", "r2sonic_bth0_20.pcap").read_bytes())
        for units, verdict in ((1, "equal"), (-1, "equal"), (2, "different"), (-3, "different")):
            changed = bytearray(real)
            for found in re.finditer(b"BTH0", real):
                at = found.start() + H0_RX_RANGE
                changed[at:at + 4] = struct.pack(">i", struct.unpack(">i", real[at:at + 4])[0] + units)
            _, fields = self.type_(bytes(real), bytes(changed))
            self.assertEqual(fields["h0.rx_range"]["verdict"], verdict, units)
        _, fields = self.type_(bytes(real), bytes(changed), "--everything")
        self.assertEqual(fields["h0.rx_range"]["verdict"], "different")

    def test_whole_numbers_are_no_floats(self):
        a, b = line_capture(scan_of([100] * 5)), line_capture(scan_of([101] * 5))
        self.assertEqual(self.type_(a, b)[1]["gain_setting"]["verdict"], "different")


if __name__ == "__main__":
    unittest.main()
