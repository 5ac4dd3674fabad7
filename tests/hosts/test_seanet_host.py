"""Self-test of the SeaNet host: its bytes against published frames, its talk against a scripted head."""

import json
import struct
import sys
import unittest
from dataclasses import replace
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import seanet_checks as checks
import seanet_host
import seanet_styles as styles
import seanet_wire as wire
from scripted_head import ScriptedHead, ScriptedLine
from seanet_handshakes import HANDSHAKES
from seanet_session import HostConfused, HostTimeout, OutOfTime, Session
from seanet_styles import Settings
from shared_data import needs_data


def vector(name):
    vectors = json.loads(needs_data("tritech/vectors.json").read_text())["vectors"]
    return next(bytes.fromhex(v["hex"]) for v in vectors if v["name"] == name)


MCGILL = Settings(range=10, bins=400, left=2400, right=3999, gain=0.5)
ROCK = Settings(range=10, bins=200, step=31, gain=0.4)
MINIKING = Settings(range=30, bins=300, step=16, low_db=13, span_db=12, gain=0.4)
COMMANDS = {
    "mtHeadCommand 0x1D Rock continuous 8-bit": ("rock", ROCK),
    "mtHeadCommand 0x1D Rock 4-bit": ("rock", replace(ROCK, adc8on=False)),
    "mtHeadCommand 0x1D Rock sector +-45": ("rock", replace(ROCK, continuous=False, left=2399, right=3999)),
    "mtHeadCommand 0x01 McGill 10 m/400 bins/step 32/2400..3999 cont right": ("mcgill", MCGILL),
    "mtHeadCommand 0x01 McGill same, inverted (dynamic_reconfigure default)": (
        "mcgill",
        replace(MCGILL, invert=True),
    ),
    "mtHeadCommand 0x01 McGill sector": ("mcgill", replace(MCGILL, continuous=False)),
    "mtHeadCommand 0x01 McGill 4-bit sector 20 m/201 bins/step 16 (ADSpan=15!)": (
        "mcgill",
        replace(MCGILL, range=20, bins=201, step=16, continuous=False, adc8on=False),
    ),
    "mtHeadCommand 0x1D 5 m/200 bins/step 32/1..6399, V3B filled": (
        "hostA",
        Settings(range=5, bins=200, left=1, right=6399, low_db=2.6, span_db=25.5),
    ),
    "mtHeadCommand 0x01 10 m/200/3.6 deg/cont/left, DST": (
        "hostB",
        Settings(step=64, scan_right=False, low_db=3, span_db=25, gain=0.1),
    ),
    "mtHeadCommand 0x01 30 m/300/step 16/cont right, HdType 2 (MiniKing)": ("hostC", MINIKING),
    "mtHeadCommand 0x01 sector 2400..4000 10 m, HdType 2 (MiniKing)": (
        "hostC",
        replace(MINIKING, range=10, bins=200, continuous=False),
    ),
}


class Commands(unittest.TestCase):
    def test_head_commands_equal_those_of_known_hosts(self):
        for name, (style, settings) in COMMANDS.items():
            with self.subTest(name):
                self.assertEqual(styles.HEAD_COMMANDS[style](settings).encode().hex(), vector(name).hex())

    def test_short_commands_equal_the_published_frames(self):
        frames = {
            "mtReBoot": wire.build(wire.REBOOT),
            "mtSendVersion": wire.build(wire.SEND_VERSION),
            "mtSendBBUser": wire.build(wire.SEND_BB_USER),
            "mtStopAlives": wire.build(wire.STOP_ALIVES),
            "mtSendData t=0": wire.send_data(),
            "mtSendData t=0x03B064CA": wire.send_data(0x03B064CA),
            "mtHeadCommand 0x0F scan reverse": wire.reverse_scan(),
            "mtHeadCommand 0x1E gain (50 %, low 10 dB, span 30 dB)": wire.gain_block(95, 31, 105),
        }
        for name, frame in frames.items():
            with self.subTest(name):
                self.assertEqual(frame.hex(), vector(name).hex())

    def test_delphin_puts_255_into_the_node_copy(self):
        frame = styles.HEAD_COMMANDS["delphin"](Settings(range=60)).encode()
        self.assertEqual((len(frame), frame[12], frame[16], frame[35]), (66, 255, 0x0B, 60))


class Framing(unittest.TestCase):
    ALIVE = bytes.fromhex("403030313010000 2FF0B0480028088130000800C4A0A".replace(" ", ""))

    def test_the_alive_of_the_description(self):
        framer = wire.Framer()
        framer.feed(self.ALIVE)
        frame = framer.next()
        self.assertEqual(wire.read_alive(frame), wire.Alive(0x80, 5000, 3200, 0x4A))
        self.assertEqual(checks.frame_faults(frame), [])

    def test_noise_is_skipped_and_counted(self):
        noise = b"\x00@0010@0010\x11\x00\n@"
        framer = wire.Framer()
        for byte in noise + self.ALIVE + noise + self.ALIVE:
            framer.feed(bytes([byte]))
        self.assertEqual(
            [framer.next().raw, framer.next().raw, framer.next()], [self.ALIVE, self.ALIVE, None]
        )
        self.assertEqual(framer.skipped, 2 * len(noise))

    def test_every_flipped_header_byte_is_a_fault_or_no_frame(self):
        for at in [*range(0, 10), 11, 12, 21]:
            framer, wrong = wire.Framer(), bytearray(self.ALIVE)
            wrong[at] ^= 0x01
            framer.feed(bytes(wrong) + bytes(64))
            frame = framer.next()
            with self.subTest(at):
                self.assertTrue(frame is None or checks.frame_faults(frame))


class Lines(unittest.TestCase):
    def line(self, **changes):
        """A HeadData of the size example: 8-bit, 4 bins, 49 bytes, with fields replaced."""
        values = dict(
            total=35,
            device_type=0x11,
            head_status=0x10,
            sweep=0,
            control=0x2307,
            range_scale=100,
            tx_number=0,
            gain=84,
            slope=0,
            ad_span=255,
            ad_low=0,
            heading_offset=0,
            ad_interval=5209,
            left=2400,
            right=4000,
            step=32,
            bearing=3200,
            data_bytes=4,
        )
        body = struct.pack("<HBBBHHIBHBBHHHHBHH", *{**values, **changes}.values()) + bytes([1, 2, 3, 0x45])
        raw = b"@002B" + struct.pack("<HBBBBBB", 0x2B, 2, 255, 0, 2, 0x80, 2) + body + b"\n"
        return wire.read_head_data(wire.Frame(raw))

    def setUp(self):
        self.command = styles.HEAD_COMMANDS["mcgill"](Settings(bins=4))

    def test_a_right_line_has_no_fault(self):
        self.assertEqual(checks.line_faults(self.line(), self.command), [])
        self.assertEqual(self.line().levels, [1, 2, 3, 0x45])

    def test_every_wrong_field_is_named(self):
        for name, value in {
            "control": 0x2303,
            "range_scale": 101,
            "tx_number": 1,
            "gain": 85,
            "ad_span": 254,
            "ad_low": 1,
            "heading_offset": 1,
            "ad_interval": 5208,
            "left": 2401,
            "right": 3999,
            "step": 31,
            "device_type": 2,
            "sweep": 3,
            "bearing": 6400,
        }.items():
            with self.subTest(name):
                faults = checks.line_faults(self.line(**{name: value}), self.command)
                self.assertEqual(len(faults), 1)
                self.assertIn(name.split("_")[0], faults[0].replace("device type", "device"))

    def test_lengths_that_disagree_are_no_line(self):
        self.assertIsNone(self.line(total=36))
        self.assertIsNone(self.line(data_bytes=3))

    def test_four_bit_levels_come_high_nibble_first(self):
        self.assertEqual(self.line(control=0x2306).levels, [0, 1, 0, 2, 0, 3, 4, 5])

    def test_jumps(self):
        sector = replace(self.command, control=0x2305)
        for command, before, now, jump in [
            (self.command, 6390, 22, False),
            (self.command, 3200, 3168, False),
            (self.command, 3200, 3264, True),
            (sector, 3990, 4000, False),
            (sector, 3968, 4001, True),
            (sector, 3200, 3210, True),
        ]:
            with self.subTest((command.control, before, now)):
                got = checks.is_jump(self.line(bearing=now), self.line(bearing=before), command)
                self.assertEqual(got, jump)


class Conversations(unittest.TestCase):
    """Virtual time: a wait of 30 s costs nothing."""

    def talk(
        self, style, lines=6, actions=(), head=None, settings=Settings(), spoil=lambda d: d, warm=True, **kw
    ):
        """Runs a host against a scripted head; returns (session, [(line, faults, jumped)], events)."""
        self.head = head or ScriptedHead()
        line, seen, events = ScriptedLine(self.head, spoil), [], []
        if warm:
            while line.now() < 6.0:
                line.read(1.0)
        session = Session(line, style, settings, emit=events.append, **kw)
        HANDSHAKES[style](session)
        seanet_host.scan(session, lines, actions, lambda n, *what: seen.append(what))
        return session, seen, events

    def test_every_style_gets_its_lines(self):
        for style in HANDSHAKES:
            for bits in (8, 4):
                with self.subTest(style=style, bits=bits):
                    miniking = style == "hostC"
                    settings = Settings(adc8on=bits == 8, bins=201, low_db=0, span_db=80)
                    session, seen, _ = self.talk(
                        style,
                        head=ScriptedHead(dst=not miniking),
                        settings=settings,
                        profile="miniking" if miniking else "dst",
                    )
                    self.assertEqual([(f, j) for _, f, j in seen], [([], False)] * 6)
                    self.assertEqual(session.faults, 0)
                    wall = int(4.0 / session.command.bin_metres())
                    self.assertTrue(all(x.levels.index(max(x.levels)) == wall for x, _, _ in seen))

    def test_host_c_fails_on_a_dst_head(self):
        with self.assertRaises(HostConfused):
            self.talk("hostC")

    def test_host_c_fails_on_one_line_per_request(self):
        with self.assertRaises(HostTimeout):
            self.talk("hostC", head=ScriptedHead(dst=False, replies=1), profile="miniking")

    def test_mcgill_needs_re_centring_alives(self):
        head = ScriptedHead()
        head._boot = lambda now: ScriptedHead._boot(head, now) or setattr(head, "alives", 3)
        with self.assertRaises(HostTimeout):
            self.talk("mcgill", head=head)

    def test_mcgill_reboots_configures_and_asks(self):
        self.talk("mcgill")
        self.assertEqual(
            [f.message for f in self.head.heard][:3], [wire.REBOOT, wire.HEAD_COMMAND, wire.SEND_DATA]
        )

    def test_changes_on_the_way_reach_the_lines(self):
        actions = [(3, "reverse"), (9, "level=95,31,105"), (15, "range=5,bins=100")]
        head = ScriptedHead()
        head._configure = self.follow(head, head._configure)
        _, seen, events = self.talk("hostB", 24, actions, head)
        self.assertEqual([f for _, f, _ in seen], [[]] * 24)
        last = seen[-1][0]
        self.assertEqual((last.range_scale, len(last.levels)), (50, 100))
        self.assertEqual([e["text"] for e in events if e["event"] == "action"], [a for _, a in actions])

    @staticmethod
    def follow(head, configure):
        """Makes the scripted head echo what types 0x0F and 0x1E change."""

        def handler(got, now):
            configure(got, now)
            if got.payload[0] in (0x0F, 0x1E):
                raw = bytearray(head.command)
                if got.payload[0] == 0x0F:
                    raw[14] ^= wire.SCAN_RIGHT
                else:
                    raw[41], raw[42], raw[43] = got.payload[1], got.payload[3], got.payload[5]
                head.command = bytes(raw)

        return handler

    def test_a_wrong_echo_is_seen(self):
        def spoil(data):
            return data[:39] + b"\x21" + data[40:] if data[10] == wire.HEAD_DATA else data

        session, seen, _ = self.talk("rock", 3, spoil=spoil)
        self.assertEqual([f for _, f, _ in seen], [["step is 33, sent 32"]] * 3)
        self.assertEqual(session.faults, 3)

    def test_noise_between_frames_is_survived(self):
        session, seen, _ = self.talk("rock", 10, spoil=lambda data: b"@0@00FF\x0a\x80" + data)
        self.assertEqual([f for _, f, _ in seen], [[]] * 10)
        self.assertGreater(session.framer.skipped, 90)

    def test_a_dead_head_ends_in_a_time_limit(self):
        for style in HANDSHAKES:
            with self.subTest(style), self.assertRaises(HostTimeout):
                self.talk(style, spoil=lambda data: b"", warm=False)

    def test_the_overall_limit_ends_even_what_would_be_retried(self):
        with self.assertRaises(OutOfTime):
            self.talk("mcgill", spoil=lambda data: b"", warm=False, limit=3.0)

    def test_unknown_action_is_refused(self):
        with self.assertRaises(ValueError):
            self.talk("rock", 3, [(1, "ragne=5")])
