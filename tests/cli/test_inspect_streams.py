"""echoloop inspect on captures that hold streams: TCP connections, serial lines, pcapng with several kinds of link."""
import unittest

from captures import COMMANDS, ETHERNET, RAW, REBOOT, RTAC_SERIAL, SEND_DATA, Pcapng, ethernet, ipv4, pcap, rtac, tcp, udp
from program import ProgramTest, run

SYN = 0x02


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

    def test_both_directions_are_apart(self):
        packets = [ethernet(ipv4(tcp(REBOOT[:7], 5, ports=(1, 2)), protocol=6)),
                   ethernet(ipv4(tcp(SEND_DATA[:7], 9, ports=(2, 1)), protocol=6)),
                   ethernet(ipv4(tcp(REBOOT[7:], 12, ports=(1, 2)), protocol=6)),
                   ethernet(ipv4(tcp(SEND_DATA[7:], 16, ports=(2, 1)), protocol=6))]
        messages = self.messages(pcap(packets))
        self.assertEqual([m["name"] for m in messages], ["ReBoot", "SendData"])
        self.assertEqual([m["to"][-2:] for m in messages], [":2", ":1"])

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
