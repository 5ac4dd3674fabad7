"""echoloop inspect on captures that hold streams: TCP connections, serial lines, pcapng with several kinds of link."""
import resource
import struct
import unittest

from captures import COMMANDS, ETHERNET, RAW, REBOOT, RTAC_SERIAL, SEND_DATA, Pcapng, ethernet, ipv4, pcap, rtac, tcp, udp
from program import ProgramTest, run

SYN = 0x02
PIECE = 1472  # what fits one datagram


def ping_frame(number, payload):
    frame = b"BR" + struct.pack("<HHBB", len(payload), number, 0, 0) + payload
    return frame + struct.pack("<H", sum(frame) & 0xFFFF)


def profile(number):
    """os_mono_profile of an Omniscan 450 with 1200 results: 2462 bytes, two datagrams."""
    head = struct.pack("<5I3HBB6f", number, 0, 5000, 0, 450000, 4, 1200, 15000, 0, 0, 1e-4, 1, 0, -90, 0, 0)
    return ping_frame(2198, head + struct.pack("<1200H", *((number + i) % 65536 for i in range(1200))))


ACK = ping_frame(1, struct.pack("<H", 2197))


def pieces(frame):
    return [frame[at:at + PIECE] for at in range(0, len(frame), PIECE)]


def damaged(data, at=700):
    return data[:at] + bytes([data[at] ^ 0x10]) + data[at + 1:]


class Streams(ProgramTest):
    def file(self, data):
        path = self.folder / "capture"
        path.write_bytes(data)
        return path

    def messages(self, data, *arguments):
        return self.json("inspect", self.file(data), *arguments)["messages"]

    def names(self, data, *arguments):
        return [message.get("name", "") for message in self.messages(data, *arguments)]

    def segments(self, *segments):
        return pcap([ethernet(ipv4(tcp(*s), protocol=6)) for s in segments])

    def test_a_message_in_several_segments_is_one(self):
        line = REBOOT + SEND_DATA
        data = self.segments((b"", 99, SYN), *[(line[i:i + 5], 100 + i) for i in range(0, len(line), 5)])
        self.assertEqual(self.names(data), ["ReBoot", "SendData"])

    def test_segments_out_of_order_and_sent_twice(self):
        a, b, c = REBOOT[:6], REBOOT[6:], SEND_DATA
        at = [100, 106, 114]
        for order in ([1, 0, 2], [0, 2, 1], [0, 0, 1, 2, 1], [2, 1, 0]):
            pieces = [(b"", 99, SYN)] + [((a, b, c)[i], at[i]) for i in order]
            self.assertEqual(self.names(self.segments(*pieces)), ["ReBoot", "SendData"], order)

    def test_sequence_numbers_wrap(self):
        start = 2**32 - 7
        data = self.segments((b"", start - 1, SYN), (REBOOT, start), (SEND_DATA, start + len(REBOOT)))
        self.assertEqual(self.names(data), ["ReBoot", "SendData"])

    def test_bytes_that_the_capture_lacks_spoil_one_message_only(self):
        data = self.segments((b"", 99, SYN), (REBOOT, 100), (SEND_DATA[9:], 123), (REBOOT, 132), (REBOOT, 146))
        self.assertEqual(self.names(data), ["ReBoot", "", "ReBoot", "ReBoot"])

    def test_very_many_bytes_behind_gaps_take_no_time(self):
        start, before = 100 + len(REBOOT), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        data = self.segments((b"", 99, SYN), (REBOOT, 100), *[(b"x", start + 3 * i + 2) for i in range(100_000)])
        messages = self.messages(data, "--family", "seanet")
        self.assertEqual(messages[0]["name"], "ReBoot")
        self.assertEqual(sum(message["size"] for message in messages[1:]), 100_000)
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 10)

    def test_both_directions_are_apart(self):
        packets = [ethernet(ipv4(tcp(REBOOT[:7], 5, ports=(1, 2)), protocol=6)),
                   ethernet(ipv4(tcp(SEND_DATA[:7], 9, ports=(2, 1)), protocol=6)),
                   ethernet(ipv4(tcp(REBOOT[7:], 12, ports=(1, 2)), protocol=6)),
                   ethernet(ipv4(tcp(SEND_DATA[7:], 16, ports=(2, 1)), protocol=6))]
        messages = self.messages(pcap(packets))
        self.assertEqual([m["name"] for m in messages], ["ReBoot", "SendData"])
        self.assertEqual([m["to"][-2:] for m in messages], [":2", ":1"])

    def datagrams(self, *payloads):
        return pcap([ethernet(ipv4(udp(payload))) for payload in payloads])

    def test_a_message_in_two_datagrams_is_one(self):
        messages = self.messages(self.datagrams(ACK, *pieces(profile(1)), *pieces(profile(2))))
        self.assertEqual([m["name"] for m in messages], ["Ack", "OsMonoProfile", "OsMonoProfile"])
        self.assertEqual([m["time"] for m in messages], [0, 2, 4])
        numbers = [f["value"] for m in messages[1:] for f in m["fields"] if f["name"] == "ping_number"]
        self.assertEqual(numbers, [1, 2])

    def test_a_message_in_two_datagrams_of_a_family_that_is_named(self):
        data = self.datagrams(*pieces(profile(1)), ACK)
        self.assertEqual(self.names(data, "--family", "cerulean"), ["OsMonoProfile", "Ack"])

    def test_a_datagram_that_is_damaged_or_lost_spoils_its_own_message_only(self):
        (a, b), (c, d), good = pieces(profile(1)), pieces(profile(2)), ["OsMonoProfile"]
        whole = [ACK, *pieces(profile(3))]
        for spoilt in ([damaged(a), b], [a, damaged(b)], [a], [b], [damaged(a, 2), b], [damaged(a, 3), b]):
            names = self.names(self.datagrams(*spoilt, c, d))
            self.assertEqual([n for n in names if n], good, spoilt[0][:8])
            names = self.names(self.datagrams(c, d, *spoilt, *whole))
            self.assertEqual(names, ["OsMonoProfile", "", "Ack", "OsMonoProfile"], spoilt[0][:8])

    def test_what_a_whole_datagram_ends_has_its_own_time(self):
        messages = self.messages(self.datagrams(ACK, damaged(ACK, 9), ACK))
        self.assertEqual([(m.get("name", ""), m["time"]) for m in messages], [("Ack", 0), ("", 1), ("Ack", 2)])

    def test_datagrams_of_several_senders_are_apart(self):
        def sent(payload, port):
            return ethernet(ipv4(struct.pack(">HHHH", port, 9, len(payload) + 8, 0) + payload))

        (a, b), (c, d) = pieces(profile(1)), pieces(profile(2))
        messages = self.messages(pcap([sent(a, 1), sent(c, 2), sent(b, 1), sent(d, 2)]))
        self.assertEqual([(m["name"], m["from"][-2:]) for m in messages],
                         [("OsMonoProfile", ":1"), ("OsMonoProfile", ":2")])

    def test_a_family_of_datagrams_is_read_one_by_one(self):
        halves = [COMMANDS[:10], COMMANDS[10:]]
        messages = self.messages(self.datagrams(COMMANDS, *halves, COMMANDS), "--family", "r2sonic")
        self.assertEqual([m["name"] for m in messages if not m.get("reason")], ["CMD0", "CMD0"])
        self.assertEqual([m["offset"] for m in messages if not m.get("reason")], [0, 0])

    def test_a_pcapng_with_a_serial_line_and_a_network_in_either_byte_order(self):
        for order in "<>":
            file = Pcapng(order).interface(RTAC_SERIAL, b"micron line").interface(RAW).interface(ETHERNET, b"", 6)
            file.packet(0, rtac(REBOOT[:4], 2), 1_000_000_000).packet(1, ipv4(udp(COMMANDS)), 1_500_000_000)
            file.packet(0, rtac(REBOOT[4:], 2), 2_000_000_000).packet(2, ethernet(ipv4(udp(COMMANDS))), 3_000_000)
            messages = self.messages(file.data)
            self.assertEqual([m["name"] for m in messages], ["CMD0", "ReBoot", "CMD0"])
            self.assertEqual([m["time"] for m in messages], [0.5, 1.0, 2.0])
            self.assertEqual(messages[1]["line"], "micron line, received")

    def test_broken_pcapng_files_end_with_a_reason(self):
        good = Pcapng().interface(RAW).packet(0, ipv4(udp(COMMANDS)), 0)
        self.assertIn("not described", self.bad(65, "inspect", self.file(Pcapng().packet(0, b"x", 0).data)))
        self.assertIn("impossible", self.bad(65, "inspect", self.file(Pcapng().interface(RAW, b"", 99).data)))
        done = run("inspect", self.file(good.data + good.data[-5:]), "--summary")
        self.assertIn(b"ends early: the last block is cut short", done.stderr)
        for length in (4, 13, 2**31):
            block = b"\x06\0\0\0" + length.to_bytes(4, "little") + bytes(40)
            self.assertIn(b"impossible length", run("inspect", self.file(good.data + block)).stderr)


if __name__ == "__main__":
    unittest.main()
