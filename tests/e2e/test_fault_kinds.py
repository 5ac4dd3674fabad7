"""Each kind of fault that changes when messages come, or what a sonar shows: what a driver's end sees of it, and that the
label file says exactly that. The readers of bytes here are written apart from the program. Beside busy programs everything
is late now and then, so times are told by medians, and by the kernel's stamps where it gives them."""

import math
import os
import select
import socket
import statistics
import struct
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import Emulator

import blping_host
import ping360_host
import seanet_wire
from test_faults import PROTOCOL_VERSION, VERSION_REPLY, Pty, labels, request, sounder

SET_INTERVAL, START, DISTANCE, PROFILE = 1004, 1400, 1212, 1300
INTERVAL = 0.1  # s between the pings of a sounder
SLACK = 0.05  # s that bytes may be later than the program says they are, usually
WORST = 2  # s, now and then
SO_TIMESTAMPNS = 35  # socket(7): Python has no name for it


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-kinds-")
        self.addCleanup(folder.cleanup)
        self.folder, self.runs = Path(folder.name), 0

    def start(self, scenario, **more):
        self.runs += 1
        self.file = self.folder / f"labels{self.runs}.jsonl"
        emulator = Emulator(scenario, "--labels", self.file, **more)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def told(self, emulator, kind, device="ping1d"):
        """The labels of a run that ends here; all are of that device and kind."""
        status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        events = labels(self.file)[1]
        self.assertEqual({(e["device"], e["kind"]) for e in events}, {(device, kind)})
        return events

    def assert_on_time(self, seconds):
        """How far things were from their times: usually not by more than SLACK."""
        off = [abs(s) for s in seconds]
        self.assertLess(statistics.median(off), SLACK, seconds)
        self.assertLess(max(off), WORST, seconds)


class Datagrams:
    """A Ping1D on UDP that pings by itself: [(s since 1970, datagram)], by the kernel's stamps of when they were sent."""

    def __init__(self, case, *faults, message=DISTANCE, way=None):
        port = free_port()
        scenario = sounder(f"udp-listen://127.0.0.1:{port}", *faults)
        if way is not None:
            scenario = scenario.replace("{pose: {position: [0, 0, -2]}}", "{trajectory: way.csv}")
        self.emulator = case.start(scenario, files={"way.csv": way or ""})
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        case.addCleanup(self.socket.close)
        self.socket.connect(("127.0.0.1", port))
        self.socket.settimeout(20)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.send(blping_host.frame(SET_INTERVAL, struct.pack("<H", round(1000 * INTERVAL))))
        self.socket.send(blping_host.frame(START, struct.pack("<H", message)))
        self.heard = []

    def take(self, count):
        for _ in range(count):
            data, stamps, _, _ = self.socket.recvmsg(65536, socket.CMSG_SPACE(16))
            seconds, nanoseconds = struct.unpack("qq", stamps[0][2])
            self.heard.append((seconds + 1e-9 * nanoseconds, data))


def number_of(datagram):
    """The ping that it tells of; 0: it is no distance and no profile."""
    frame = ping360_host.parse(datagram)
    return struct.unpack_from("<I", frame.payload, 8)[0] if frame.id in (DISTANCE, PROFILE) else 0


def offsets(datagrams):
    """Of each, in all of them in a row."""
    ends = [0]
    for data in datagrams:
        ends.append(ends[-1] + len(data))
    return ends[:-1]


class Order(Case):
    def test_overtaken_datagrams_are_those_of_the_labels(self):
        run = Datagrams(self, "kind: reordering, rate: 0.2")
        run.take(62)  # two acknowledgements, then pings
        events = self.told(run.emulator, "reordering")
        heard = [data for _, data in run.heard]
        numbers = [number_of(data) for data in heard]
        said = sorted(heard, key=number_of)  # in the order in which they were said
        self.assertNotEqual(said, heard)
        held = {e["message"]: e for e in events}
        expected, waiting = [], []
        for message, data in enumerate(said):
            if message in held:
                waiting.append(data)
            else:
                expected += [data, *waiting]
                waiting = []
        count = len(expected)
        self.assertGreater(count, 55)
        self.assertEqual(numbers[:count], [number_of(data) for data in expected])
        seen = {number_of(data): at for data, at in zip(heard, offsets(heard))}
        for message, event in held.items():
            if message < len(said) and said[message] in expected:
                self.assertEqual(event["by"], 1)
                self.assertEqual(event.get("ping", 0), number_of(said[message]))
                self.assertEqual((event["offset"], event["length"]),
                                 (seen[number_of(said[message])], len(said[message])))

    def test_merged_messages_are_one_datagram(self):
        run = Datagrams(self, "kind: merge, messages: 3, from: 1")
        run.take(20)
        merged = [data for _, data in run.heard if data.count(b"BR") == 3]
        self.assertGreater(len(merged), 5)
        for data in merged:
            third = len(data) // 3
            numbers = [number_of(data[i * third:(i + 1) * third]) for i in range(3)]
            self.assertEqual(numbers, list(range(numbers[0], numbers[0] + 3)))
        events = self.told(run.emulator, "merge")
        where = dict(zip(offsets([data for _, data in run.heard]), run.heard))
        events = events[: len(merged)]
        for event in events:
            self.assertEqual((event["messages"], event["length"]), (3, len(where[event["offset"]][1])))
        self.assert_on_time([where[e["offset"]][0] - e["unix"] for e in events])


class Parts(Case):
    def test_a_message_comes_in_parts_with_pauses(self):
        gap = 0.4  # s: longer than this process may be kept from reading, or two parts would look like one
        emulator = self.start(sounder("pty:{folder}/ping1d", f"kind: split, parts: 3, gap: {gap}"))
        driver = Pty(emulator.folder / "ping1d")
        self.addCleanup(driver.close)
        begins, said = [], b""
        for _ in range(5):
            driver.write(request(PROTOCOL_VERSION))
            end = len(said) + VERSION_REPLY
            while len(said) < end:
                self.assertTrue(select.select([driver.line], [], [], 20)[0], said)
                begins.append((len(said), time.time()))
                said += os.read(driver.line, 100)
        events = self.told(emulator, "split")
        self.assertEqual(said[:VERSION_REPLY] * 5, said)
        parts = [(at, when) for at, when in begins if at % VERSION_REPLY]
        self.assertEqual([e["offset"] for e in events], [at for at, _ in parts])
        for event, (at, _) in zip(events, parts):
            self.assertEqual((event["message"], event["direction"]), (at // VERSION_REPLY, "to_driver"))
        self.assert_on_time([when - event["unix"] for event, (_, when) in zip(events, parts)])
        pauses = [when - before for (_, before), (at, when) in zip(begins, begins[1:]) if at % VERSION_REPLY]
        self.assertAlmostEqual(statistics.median(pauses), gap, delta=SLACK)


class Time(Case):
    def test_jitter_is_the_delays_of_the_labels(self):
        run = Datagrams(self, "kind: jitter, delay: 0.08")
        run.take(42)
        events = self.told(run.emulator, "jitter")
        arrivals = [when for when, _ in run.heard]
        delays = [e["delay"] for e in events[: len(arrivals)]]
        self.assertEqual([e["offset"] for e in events[: len(arrivals)]], offsets([data for _, data in run.heard]))
        self.assertTrue(all(0 <= delay <= 0.08 for delay in delays))
        self.assertGreater(max(delays) - min(delays), 0.04)
        self.assert_on_time([when - event["unix"] for event, when in zip(events, arrivals)])

        def off(times):  # s from the regular pace, of the pings
            return statistics.median(abs(b - a - INTERVAL) for a, b in zip(times[2:], times[3:]))

        regular = [when - delay for when, delay in zip(arrivals, delays)]
        self.assertGreater(off(arrivals), 0.01)
        self.assertLess(off(regular), off(arrivals) / 3, "without the delays of the labels they are regular again")

    def test_a_stale_burst_is_old_pings_all_at_once(self):
        run = Datagrams(self, "kind: stale_burst, from: 2, for: 1.5")
        run.take(50)
        events = self.told(run.emulator, "stale_burst")
        times = [when for when, _ in run.heard]
        numbers = [number_of(data) for _, data in run.heard]
        pings = numbers[2:]
        self.assertEqual(pings, list(range(pings[0], pings[0] + len(pings))), "none is lost, in their order")
        where = {at: i for i, at in enumerate(offsets([data for _, data in run.heard]))}
        burst = [where[e["offset"]] for e in events]
        self.assertEqual(burst, list(range(burst[0], burst[-1] + 1)))
        self.assertGreater(len(burst), 10)
        self.assertGreater(times[burst[0]] - times[burst[0] - 1], 1.3, "silence before it")
        self.assert_on_time([times[i] - times[burst[0]] for i in burst])
        self.assert_on_time([times[i] - event["unix"] for event, i in zip(events, burst)])
        self.assert_on_time([event["t"] - 3.5 for event in events])
        delays = [e["delay"] for e in events]
        self.assertAlmostEqual(statistics.median(a - b for a, b in zip(delays, delays[1:])), INTERVAL, delta=0.02)
        after = times[burst[-1] + 2:]  # the first one may have come while the burst did
        self.assertAlmostEqual(statistics.median(b - a for a, b in zip(after, after[1:])), INTERVAL, delta=0.02)

    def test_a_narrow_line_carries_so_many_bytes_in_a_second(self):
        rate = 5000  # bit/s
        emulator = self.start(PING360 % ("pty:{folder}/line", "{device: head, kind: bandwidth, bits_per_second: %d}" % rate))
        driver = Pty(emulator.folder / "line")
        self.addCleanup(driver.close)
        driver.write(transducer(angle=0, samples=1000))
        size, times = 1000 + 14 + 10, []
        data = b""
        while len(data) < size and select.select([driver.line], [], [], 20)[0]:
            data += os.read(driver.line, 4096)
            times.append((time.time(), len(data)))
        self.assertEqual(len(ping360_host.ping_of(ping360_host.parse(data)).data), 1000)
        (begin, first), (end, _) = times[0], times[-1]
        self.assertGreater(len(times), 10, "it trickles")
        self.assertAlmostEqual((size - first) / (end - begin), rate / 8, delta=0.1 * rate / 8)
        events = self.told(emulator, "bandwidth", "head")
        self.assertEqual([(e["message"], e["offset"], e["length"]) for e in events], [(0, 0, size)])
        self.assertAlmostEqual(events[0]["delay"], size * 8 / rate, delta=1e-6)
        self.assertAlmostEqual(events[0]["unix"], begin, delta=WORST)


PING360 = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
effects: {noise: off, speckle: off, multipath: off, second_time_around: off}
render: {pixels: 16}    # so that two pings at one bearing differ by less than a count
vehicle: {pose: {position: [0.5, 0.7, -2]}}
devices:
  - {name: head, model: ping360, endpoints: ["%s"]}
faults:
  - %s
"""


def transducer(angle, samples):
    """A ping at that angle, gradians, with `samples` of 30 us."""
    return ping360_host.frame(ping360_host.TRANSDUCER, struct.pack("<BBHHHHHBB", 1, 0, angle, 11, 1200, 750, samples, 1, 0))


def difference(one, other):
    """Of two pings' samples, of 255."""
    return statistics.mean(abs(a - b) for a, b in zip(one.data, other.data))


class Sonar(Case):
    def test_a_stuck_motor_shows_one_bearing_whatever_the_head_says(self):
        port = free_port()
        emulator = self.start(PING360 % (f"udp-listen://127.0.0.1:{port}", "{device: head, kind: stuck_motor, from: 2, for: 2}"))
        pings = []
        with ping360_host.Host("127.0.0.1", port) as host:
            begin = time.time()
            while time.time() < begin + 6:
                host.say(transducer(angle=20 * len(pings) % 400, samples=300))
                pings += host.pings(1, 5)
        events = self.told(emulator, "stuck_motor", "head")
        first, last = events[0]["ping"], events[-1]["ping"]  # from 1
        self.assertEqual([e["ping"] for e in events], list(range(first, last + 1)))
        self.assertGreater(len(events), 5)
        self.assertGreater(len(pings), last + 3)
        self.assertEqual([p.angle for p in pings], [20 * i % 400 for i in range(len(pings))], "it says that it turns")
        for ping in pings[first - 1:last]:  # but for what no two pings have in common
            self.assertLess(difference(ping, pings[first - 2]), 3, "where it was last")
        turned = [p for p in pings[:first - 2] + pings[last:] if p.angle != pings[first - 2].angle]
        self.assertGreater(len(turned), 5)
        self.assertGreater(statistics.median(difference(p, pings[first - 2]) for p in turned), 10)
        for event in events:
            for bearing, ping in ((event["said"], event["ping"]), (event["is"], first - 1)):
                self.assertAlmostEqual(math.remainder(bearing - 18 * (ping - 1) + 180, 360), 0, places=6)
        self.assertGreaterEqual(events[0]["t"], 2)
        self.assertLess(events[-1]["t"], 4)

    def test_a_frozen_image_stays_while_time_goes_on(self):
        way = "t,x,y,z,qw,qx,qy,qz\n0,0,0,-2,1,0,0,0\n30,4,0,-3,1,0,0,0\n"
        run = Datagrams(self, "kind: frozen_image, from: 2, for: 2", message=PROFILE, way=way)
        run.take(57)
        events = self.told(run.emulator, "frozen_image")
        pings = {number_of(data): data for _, data in run.heard[2:]}
        numbers = list(pings)
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))), "its count goes on")
        frozen = [e["ping"] for e in events]
        self.assertEqual(frozen, list(range(frozen[0], frozen[-1] + 1)))
        self.assertAlmostEqual(len(frozen), 2 / INTERVAL, delta=3)
        images = {n: data[-202:-2] for n, data in pings.items()}
        self.assertEqual({images[n] for n in frozen}, {images[frozen[0] - 1]}, "the last one before")
        others = [n for n in numbers if n not in frozen]
        self.assertGreater(len({images[n] for n in others}), 0.9 * len(others))
        self.assertGreaterEqual(events[0]["t"], 2)
        self.assertLess(events[-1]["t"], 4)


MICRON = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -3]}}
devices:
  - {name: head, model: tritech-micron, endpoints: ["pty:{folder}/line"], options: {first_alive: 0.2}}
faults:
  - {device: head, kind: baud_mismatch, baud: 57600, until: 4}
"""


class Rates(Case):
    def test_two_uarts_that_disagree_hear_nothing_of_one_another(self):
        emulator = self.start(MICRON)
        driver = Pty(emulator.folder / "line")
        self.addCleanup(driver.close)
        garbage = b""
        end = time.monotonic() + 20
        while b"@0010" not in garbage and time.monotonic() < end:
            garbage += driver.read(1, 2)
        garbage, _, alive = garbage.partition(b"@0010")
        alive += driver.read(22 - len(b"@0010"))
        framer = seanet_wire.Framer()
        framer.feed(garbage)
        self.assertIsNone(framer.next())
        events = self.told(emulator, "baud_mismatch", "head")
        self.assertGreater(len(events), 2)
        self.assertEqual({(e["baud"], e["was"]) for e in events}, {(57600, len(b"@0010" + alive))})
        self.assertEqual([e["offset"] for e in events], [sum(e["length"] for e in events[:i]) for i in range(len(events))])
        self.assertEqual(sum(e["length"] for e in events), len(garbage))


if __name__ == "__main__":
    unittest.main()
