"""echoloop diff: captures that Python made and that differ in exactly known ways, the same said again, real recordings,
and damaged files."""
import json
import random
import resource
import struct
import unittest

from captures import ETHERNET, RAW, REBOOT, RTAC_SERIAL, SEND_DATA, Pcapng, ethernet, ipv4, rtac
from program import ProgramTest, run


def ping_frame(number, payload, source=2):
    frame = b"BR" + struct.pack("<HHBB", len(payload), number, source, 0) + payload
    return frame + struct.pack("<H", sum(frame) & 0xFFFF)


def device_data(angle, gain=1, samples=bytes(range(40))):
    head = struct.pack("<BBHHHHHH", 1, gain, angle, 11, 88, 750, len(samples), len(samples))
    return ping_frame(2300, head + samples)


def transducer(angle):
    return ping_frame(2601, struct.pack("<BBHHHHHBB", 1, 1, angle, 11, 88, 750, 40, 1, 0), 0)


def alive(time_ms, position):
    return bytes.fromhex("40303031301000 02ff0b048002".replace(" ", "")) + struct.pack("<BIHB", 0, time_ms, position, 0x4A) + b"\n"


def line_capture(messages, name=b"ping360 line", step=10):
    """`messages`: (bytes, sent by the device), `step` ms apart."""
    capture = Pcapng().interface(RTAC_SERIAL, name)
    for i, (data, sent) in enumerate(messages):
        capture.packet(0, rtac(data, 1 if sent else 2), 10**9 + i * step * 10**6)
    return capture.data


def scan(angles, **changes):
    return [part for angle in angles for part in ((transducer(angle), False), (device_data(angle, **changes), True))]


RX_RANGE_IN_H0 = 88  # B, of the R2Sonic manual, behind the packet's 12


class Diff(ProgramTest):
    def file(self, data, name):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def diff(self, a, b, *arguments, status=None):
        done = run("diff", self.file(a, "a"), self.file(b, "b"), "--json", *arguments)
        report = json.loads(done.stdout)
        self.assertEqual(done.returncode, 0 if report["equal"] else 1)
        if status is not None:
            self.assertEqual(done.returncode, status, done.stdout)
        return report

    @staticmethod
    def types(report):
        return {type_["name"]: type_ for direction in report["directions"] for type_ in direction["types"]}

    @staticmethod
    def verdicts(type_):
        return {field["name"]: field["verdict"] for field in type_["fields"]}

    def test_the_same_is_equal(self):
        data = line_capture(scan(range(0, 40)))
        types = self.types(self.diff(data, data, status=0))
        self.assertEqual({name: (t["a"], t["b"], t["pairs"]) for name, t in types.items()},
                         {"Transducer": (40, 40, 40), "DeviceData": (40, 40, 40)})
        self.assertEqual(set(self.verdicts(types["DeviceData"]).values()), {"equal"})

    def test_one_field_that_differs_is_named_with_its_first_place(self):
        a = scan(range(20))
        b = list(a)
        b[2 * 7 + 1] = (device_data(7, gain=2), True)
        b[2 * 9 + 1] = (device_data(9, gain=0), True)
        types = self.types(self.diff(line_capture(a), line_capture(b), status=1))
        fields = {field["name"]: field for field in types["DeviceData"]["fields"]}
        self.assertEqual([name for name, f in fields.items() if f["verdict"] == "different"], ["gain_setting"])
        gain = fields["gain_setting"]
        self.assertEqual((gain["compared"], gain["different"], gain["largest"]), (20, 2, 1))
        self.assertEqual(gain["first"], {"a": {"message": 16, "packet": 16, "time": 0.15, "value": "1"},
                                         "b": {"message": 16, "packet": 16, "time": 0.15, "value": "2"}})
        self.assertEqual(types["Transducer"]["only_a"], [])

    def test_a_missing_and_an_extra_message_shift_nothing(self):
        whole = scan(range(30))
        missing = whole[:2 * 11 + 1] + whole[2 * 11 + 2:]
        extra = whole[:9] + [(device_data(350), True)] + whole[9:]
        types = self.types(self.diff(line_capture(missing), line_capture(extra), status=1))
        data = types["DeviceData"]
        self.assertEqual((data["a"], data["b"], data["pairs"]), (29, 31, 29))
        self.assertEqual([place["packet"] for place in data["only_b"]], [10, 2 * 11 + 3])
        self.assertEqual(data["only_a"], [])
        self.assertEqual(set(self.verdicts(data).values()), {"equal"})
        self.assertEqual((types["Transducer"]["pairs"], types["Transducer"]["only_a"]), (30, []))

    def test_a_later_start_is_found(self):
        types = self.types(self.diff(line_capture(scan(range(0, 60))), line_capture(scan(range(20, 60))), status=1))
        self.assertEqual(types["DeviceData"]["pairs"], 40)
        self.assertEqual(len(types["DeviceData"]["only_a"]), 20)
        self.assertEqual(set(self.verdicts(types["DeviceData"]).values()), {"equal"})

    def test_times_differ_by_nature_unless_the_user_wants_them(self):
        a = line_capture([(alive(1000 * i, 3200), True) for i in range(5)], b"head line")
        b = line_capture([(alive(1000 * i + 37, 3200), True) for i in range(5)], b"head line")
        self.assertEqual(self.verdicts(self.types(self.diff(a, b, status=0))["Alive"])["time_ms"], "not compared")
        for arguments, status in ((("--tolerance", "time_ms=0"), 1), (("--tolerance", "Alive.time_ms=36"), 1),
                                  (("--tolerance", "time_ms=37"), 0), (("--everything",), 1),
                                  (("--everything", "--ignore", "time_ms"), 0)):
            with self.subTest(arguments):
                self.diff(a, b, *arguments, status=status)

    def test_samples_are_compared_by_their_rms(self):
        a = line_capture(scan(range(10), samples=bytes([100, 90] * 20)))
        b = line_capture(scan(range(10), samples=bytes([96, 95] * 20)))
        loud = line_capture(scan(range(10), samples=bytes([200, 180] * 20)))
        data = next(f for f in self.types(self.diff(a, b, status=0))["DeviceData"]["fields"] if f["name"] == "data")
        self.assertEqual(data["verdict"], "alike")
        self.assertAlmostEqual(data["rms_a"], ((100**2 + 90**2) / 2)**0.5, places=6)
        self.assertAlmostEqual(data["rms_b"], ((96**2 + 95**2) / 2)**0.5, places=6)
        self.diff(a, loud, status=1)
        self.diff(a, loud, "--tolerance", "data=0.6", status=0)
        self.diff(a, b, "--tolerance", "data=0", status=1)
        self.diff(a, b, "--tolerance", "DeviceData.data=0.001", status=1)
        shorter = line_capture(scan(range(10), samples=bytes([100, 90] * 19)))
        self.diff(a, shorter, "--ignore", "number_of_samples", "--ignore", "data_length", status=1)

    def test_gaps_and_answers_are_statistics(self):
        quick, slow = line_capture(scan(range(30)), step=10), line_capture(scan(range(30)), step=25)
        types = self.types(self.diff(quick, slow, status=0))
        self.assertAlmostEqual(types["DeviceData"]["gap"]["a"]["median"], 0.020, places=6)
        self.assertAlmostEqual(types["DeviceData"]["gap"]["b"]["median"], 0.050, places=6)
        self.assertAlmostEqual(types["Transducer"]["answer"]["a"]["median"], 0.010, places=6)
        self.assertAlmostEqual(types["Transducer"]["answer"]["b"]["median"], 0.025, places=6)

    def test_directions_are_matched_by_what_is_said(self):
        """The host recorded its own side of the line: what it sent is what the emulator received."""
        emulator = line_capture(scan(range(10)))
        host = line_capture([(data, not sent) for data, sent in scan(range(10))], b"ttyUSB0")
        report = self.diff(host, emulator, status=0)
        self.assertEqual({(d["a"], d["b"]) for d in report["directions"]},
                         {("ttyUSB0, sent", "ping360 line, received"), ("ttyUSB0, received", "ping360 line, sent")})

    def test_datagrams_on_other_ports_and_a_port_that_is_chosen(self):
        def datagrams(*pairs):
            capture = Pcapng().interface(ETHERNET, b"eth")
            for i, (data, ports) in enumerate(pairs):
                packet = struct.pack(">HHHH", *ports, len(data) + 8, 0) + data
                capture.packet(0, ethernet(ipv4(packet)), 10**9 * i)
            return capture.data

        a = datagrams((device_data(1), (1234, 5000)), (device_data(2), (1234, 5000)))
        b = datagrams((device_data(1), (9999, 6000)), (device_data(2), (9999, 6001)), (alive(5, 5), (7000, 6000)))
        report = self.diff(a, b, status=1)
        self.assertEqual(self.types(report)["DeviceData"]["pairs"], 2)
        self.assertEqual([t["name"] for d in report["directions"] if not d["a"] for t in d["types"]], ["Alive"])
        self.diff(a, b, "--port-b", "9999", status=0)

    def test_bytes_that_nobody_understands_are_a_difference(self):
        a = line_capture([(SEND_DATA, False), (REBOOT, False)], b"head line")
        b = line_capture([(SEND_DATA, False), (b"\x01\x02\x03" + REBOOT, False)], b"head line")
        report = self.diff(a, b, status=1)
        self.assertEqual([(d["undecoded_a"], d["undecoded_b"]) for d in report["directions"]], [(0, 3)])

    def test_raw_bytes_of_a_line(self):
        self.diff(REBOOT + SEND_DATA, REBOOT + SEND_DATA, status=0)
        types = self.types(self.diff(REBOOT + SEND_DATA, SEND_DATA, status=1))
        self.assertEqual(types["ReBoot"]["only_a"], [{"message": 1}])

    def test_a_serial_log_against_a_capture(self):
        messages = scan(range(6))
        log = "".join(f"{0.01 * i:.3f} {'<' if sent else '>'} {data.hex(' ')}\n" for i, (data, sent) in enumerate(messages))
        types = self.types(self.diff(log.encode(), line_capture(messages), status=0))
        self.assertEqual((types["DeviceData"]["pairs"], types["Transducer"]["pairs"]), (6, 6))
        self.assertEqual(types["DeviceData"]["gap"]["a"], types["DeviceData"]["gap"]["b"])

    def test_the_text_says_what_differs(self):
        a, b = scan(range(5)), scan(range(5), gain=2)
        done = run("diff", self.file(line_capture(a), "a"), self.file(line_capture(b), "b"))
        self.assertEqual(done.returncode, 1)
        text = done.stdout.decode()
        self.assertRegex(text, r"DeviceData: 5 in A, 5 in B; fields equal \d+, different 1, alike 0, not compared \d")
        self.assertRegex(text, r"gain_setting +DIFFERENT in 5 of 5")
        self.assertIn("A 1 (message 2, packet 2, t=0.01 s)", text)
        self.assertRegex(text, r"different:\n  ping DeviceData: gain_setting\n$")
        same = run("diff", self.file(line_capture(a), "a"), self.file(line_capture(a), "b"), "--all")
        self.assertEqual(same.returncode, 0)
        self.assertIn("equal, but for what differs by nature", same.stdout.decode())

    def test_the_real_bathymetry_against_itself_and_with_one_byte_changed(self):
        real = self.shared("r2sonic", "r2sonic_bth0_20.pcap").read_bytes()
        report = self.diff(real, real, "--everything", status=0)
        self.assertEqual(self.types(report)["BTH0"]["pairs"], 20)
        at = real.rindex(b"BTH0") + 12 + RX_RANGE_IN_H0
        self.assertAlmostEqual(struct.unpack(">f", real[at:at + 4])[0], 31.948, places=3)
        changed = real[:at] + struct.pack(">f", 33) + real[at + 4:]
        fields = {f["name"]: f for f in self.types(self.diff(real, changed, status=1))["BTH0"]["fields"]}
        self.assertEqual([name for name, f in fields.items() if f["verdict"] == "different"], ["h0.rx_range"])
        self.assertEqual(fields["h0.rx_range"]["first"]["a"]["message"], 20)

    def test_wrong_words_are_refused(self):
        a = self.file(line_capture(scan(range(3))), "a")
        for arguments, word in ((("--tolerance", "gain"), "FIELD=NUMBER"), (("--tolerance", "x=-1"), "FIELD=NUMBER"),
                                (("--family", "seant"), "did you mean"), (("--port", "4711"), "4711")):
            done = run("diff", a, a, *arguments)
            self.assertNotIn(done.returncode, (0, 1))
            self.assertIn(word, done.stderr.decode())
        done = run("diff", a, a, "--ignore", "no_such_field")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no_such_field", done.stderr.decode())

    def test_damaged_captures_end_with_a_word_and_in_bounded_memory(self):
        source = random.Random(5)
        whole = line_capture(scan(range(200)))
        for _ in range(25):
            data = bytearray(whole[:source.randrange(30, len(whole))])
            for _ in range(source.randrange(8)):
                data[source.randrange(28, len(data))] = source.randrange(256)
            done = run("diff", self.file(whole, "a"), self.file(bytes(data), "b"))
            self.assertIn(done.returncode, (0, 1, 65), done.stderr)
            self.assertTrue(done.stdout or done.stderr)
        turn = line_capture(scan(range(400)))
        head = len(Pcapng().interface(RTAC_SERIAL, b"ping360 line").data)
        many = self.file(turn + 100 * turn[head:], "many")
        done = run("diff", many, many)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 1200 * 1024)

    def test_a_capture_of_very_many_addresses_takes_no_time(self):
        """Each speaks once: from one to another, from everywhere to one, and from ever other ports."""
        frame = ping_frame(5, b"")
        talks = {"pairs": lambda i: ((10 << 24) + i, (11 << 24) + i, 4000, 5000), "ports": lambda i: (9, 8, 4000, i),
                 "many to one": lambda i: ((10 << 24) + i, 11 << 24, 4000, 5000)}
        for name, ends in talks.items():
            capture = Pcapng().interface(RAW, b"")
            for i in range(20_000):
                source, target, from_port, to_port = ends(i)
                packet = struct.pack(">BBHHHBBHII", 0x45, 0, 28 + len(frame), 0, 0, 64, 17, 0, source, target)
                capture.packet(0, packet + struct.pack(">HHHH", from_port, to_port, 8 + len(frame), 0) + frame, 10**9 + i)
            file = self.file(capture.data, name)
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            done = run("diff", file, file, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 15, name)
            if name == "pairs":
                self.assertIn(b"only its first 500 messages are compared; --port picks a device", done.stdout)


if __name__ == "__main__":
    unittest.main()
