"""echoloop inspect: real and hand-made captures, byte files, and hostile input."""
import json
import random
import resource
import struct
import unittest

import captures
from captures import COMMANDS, REBOOT, SEND_DATA, ethernet, ipv4, pcap, udp
from program import ProgramTest, run


class Inspect(ProgramTest):
    def file(self, data, name="capture"):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def names(self, data, *arguments):
        return [m["name"] for m in self.json("inspect", self.file(data), *arguments)["messages"]]

    def test_the_real_bathymetry_of_a_sonic_2026(self):
        capture = self.shared("r2sonic", "r2sonic_bth0_20.pcap")
        report = self.json("inspect", capture)
        self.assertEqual(report["summary"]["messages"], {"BTH0": 20})
        self.assertEqual(report["summary"]["undecoded_bytes"], 0)
        first = {f["name"]: f["value"] for f in report["messages"][0]["fields"]}
        self.assertEqual(first["h0.points"], 256)
        self.assertAlmostEqual(first["h0.sound_speed"], 1514.962, places=3)
        self.assertAlmostEqual(first["h0.rx_range"], 31.948, places=3)
        self.assertEqual(first["h0.frequency"], 400000)
        self.assertEqual(report["messages"][0]["from"], "10.0.0.86:65500")
        text = self.good("inspect", capture)
        self.assertRegex(text, r"56 +h0\.sound_speed +1514\.962 m/s")
        self.assertRegex(text, r"messages: BTH0 20; broken 0; not decoded 0 bytes; packets 20")

    def test_comments_on_packets_are_shown(self):
        capture = captures.Pcapng().interface(captures.RTAC_SERIAL, b"micron line")
        capture.packet(0, captures.rtac(REBOOT, 1), 10**9)
        capture.packet(0, captures.rtac(REBOOT, 1), 2 * 10**9, comment=b"fault: bit 3 of byte 7")
        file = self.file(capture.data)
        report = self.json("inspect", file)
        self.assertEqual(report["comments"], [{"packet": 2, "time": 1.0, "comment": "fault: bit 3 of byte 7"}])
        self.assertEqual([message["packet"] for message in report["messages"]], [1, 2])
        text = self.good("inspect", file)
        self.assertIn("comment on packet 2  t=1 s: fault: bit 3 of byte 7", text)
        self.assertIn("; comments 1", text)

    def test_real_seanet_frames_with_noise_around_them(self):
        vectors = json.loads(self.shared("tritech", "vectors.json").read_text())["vectors"]
        frames = [bytes.fromhex(v["hex"]) for v in vectors]
        data = b"noise" + b"".join(frames) + b"@0008"
        report = self.json("inspect", self.file(data))
        self.assertEqual(sum(report["summary"]["messages"].values()), len(frames))
        self.assertEqual(report["summary"]["undecoded_bytes"], 10)
        self.assertEqual(report["messages"][0], {"family": "seanet", "name": "", "offset": 0, "size": 5,
                                                 "reason": "no complete frame", "fields": []})

    def test_a_byte_file_from_standard_input(self):
        done = run("inspect", "-", "--summary", stdin=REBOOT + SEND_DATA)
        self.assertEqual(done.stdout.decode(), "messages: ReBoot 1, SendData 1; broken 0; not decoded 0 bytes\n")
        done = run("inspect", "-", "--summary", stdin=pcap([ethernet(ipv4(udp(COMMANDS)))]))
        self.assertIn(b"CMD0 1", done.stdout)

    def test_every_link_type(self):
        packet = ipv4(udp(COMMANDS))
        for link, data in ((captures.ETHERNET, ethernet(packet)), (captures.ETHERNET, ethernet(packet, tags=2)),
                           (captures.RAW, packet), (captures.NULL, struct.pack("<I", 2) + packet),
                           (captures.SLL, bytes(14) + b"\x08\x00" + packet)):
            self.assertEqual(self.names(pcap([data], link)), ["CMD0"], link)
        self.assertIn("link type", self.bad(65, "inspect", self.file(pcap([packet], 105))))

    def test_fragments_are_put_together_in_any_order(self):
        body = udp(COMMANDS + (b"ABS0" + struct.pack(">f", 80.0)) * 30)
        pieces = [ethernet(p) for p in captures.fragments(body, 64)]
        self.assertGreater(len(pieces), 2)
        for order in (pieces, pieces[::-1], pieces[1:] + pieces[:1], pieces + pieces):
            self.assertIn("CMD0", self.names(pcap(order)))
        lost = self.file(pcap([ethernet(ipv4(udp(COMMANDS)))] + pieces[1:]))
        self.assertEqual(self.json("inspect", lost)["summary"]["incomplete_datagrams"], 1)

    def test_what_is_not_understood_is_counted(self):
        packets = [ethernet(ipv4(udp(COMMANDS))), ethernet(ipv4(b"icmp" * 10, protocol=1)), b"short",
                   bytes(12) + b"\x86\xdd" + bytes(60)]
        self.assertEqual(self.json("inspect", self.file(pcap(packets)))["summary"]["skipped_packets"], 3)

    def test_a_datagram_that_the_capture_cut_short_says_so(self):
        packets = [ethernet(ipv4(udp(COMMANDS))), ethernet(ipv4(udp(COMMANDS, length=2000), length=2020))]
        messages = self.json("inspect", self.file(pcap(packets)))["messages"]
        self.assertEqual(messages[1]["reason"], "cut short by the capture")

    def test_a_capture_that_ends_early_gives_what_there_is_and_a_warning(self):
        data = pcap([ethernet(ipv4(udp(COMMANDS)))] * 2)
        done = run("inspect", self.file(data[:-5]), "--summary")
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"CMD0 1", done.stdout)
        self.assertIn(b"echoloop: warning: the capture ends early", done.stderr)

    def test_the_family_can_be_forced(self):
        self.assertEqual(self.names(COMMANDS, "--family", "r2sonic"), ["CMD0"])
        self.assertIn("did you mean 'seanet'?", self.bad(64, "inspect", self.file(b""), "--family", "saenet"))

    def test_message_tables(self):
        for family in ("seanet", "r2sonic"):
            text = self.good("inspect", "--tables", family)
            self.assertIn("| offset | type | field |", text)

    def test_nothing_decoded_ends_with_65(self):
        self.assertIn("no message of a known protocol", self.bad(65, "inspect", self.file(b"hello" * 100)))
        self.bad(65, "inspect", self.file(b""))
        self.bad(65, "inspect", self.file(pcap([])))
        self.bad(65, "inspect", self.file(b"\xd4\xc3\xb2\xa1"))
        self.bad(66, "inspect", self.folder / "none")
        self.bad(66, "inspect", self.folder)
        self.assertIn("CAPTURE is missing", self.bad(64, "inspect"))

    def test_a_long_stream_is_read_in_pieces_with_the_same_result(self):
        # Frames of odd sizes, so that they lie across every border of a piece; AuxData of n bytes has n + 16.
        def aux(n):
            body = struct.pack("<BBBBBBH", 2, 255, (n + 5) & 255, 8, 0x80, 2, n) + b"@" * n
            return b"@%04X" % (n + 10) + struct.pack("<H", n + 10) + body + b"\n"

        count = 2200
        data = b"xx".join(aux(400 + i % 997) for i in range(count))
        self.assertGreater(len(data), 1_900_000)
        summary = self.json("inspect", self.file(data), "--summary")["summary"]
        self.assertEqual(summary["messages"], {"AuxData": count})
        self.assertEqual(summary["undecoded_bytes"], 2 * (count - 1))

    def test_memory_stays_bounded(self):
        self.assertEqual(run("inspect", self.file(REBOOT * 1_000_000), "--summary").returncode, 0)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss  # KiB
        self.assertLess(peak, 1_000_000)

    def test_text_of_a_capture_cannot_steer_the_terminal(self):
        payload = b"CMD0" + b"\x1b[2J" + struct.pack(">f", 1.0) + b"RNG0" + struct.pack(">f", 1.0)
        self.assertNotIn(b"\x1b", run("inspect", self.file(pcap([ethernet(ipv4(udp(payload)))]))).stdout)
        named = captures.Pcapng().interface(captures.RTAC_SERIAL, b"micron \x1b[2J line")
        named.packet(0, captures.rtac(REBOOT, 1), 10**9, comment=b"\x1b[2J")
        for arguments in ((), ("--summary",)):
            result = run("inspect", self.file(named.data), *arguments)
            self.assertNotIn(b"\x1b", result.stdout + result.stderr, arguments)

    def test_hostile_captures_do_no_harm(self):
        generator = random.Random(1)
        good = pcap([ethernet(ipv4(udp(COMMANDS)))] + [ethernet(p) for p in captures.fragments(udp(bytes(900)), 200)]
                    + [ethernet(ipv4(udp(REBOOT + SEND_DATA)))])
        for _ in range(150):
            data = bytearray(good)
            for _ in range(generator.randint(1, 12)):
                data[generator.randrange(4, len(data))] = generator.randrange(256)
            done = run("inspect", "-", stdin=bytes(data[:generator.randint(1, len(data))]))
            self.assertIn(done.returncode, (0, 65), done.stderr)


if __name__ == "__main__":
    unittest.main()
