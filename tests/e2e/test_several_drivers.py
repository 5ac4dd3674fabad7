"""Several drivers at one TCP port, as a Norbit WBMS and a 7k sonar serve them: over real sockets, recorded, replayed, faulty."""

import json
import select
import shutil
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

from ports import free_port
from program import PROGRAM, Emulator
from test_record import packets, payload

import norbit_host
import reson_wire
from reson_host import Host
from stepper import Stepper

SCENARIO = """
scene: {scenes}/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - name: multibeam
    mount: {rpy_deg: [0, 90, 0]}
    %s
"""
NORBIT = """model: norbit-wbms
    endpoints: ["tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d", "tcp-listen://127.0.0.1:%d"]
    options: {power: true, sample: f32}
"""
RESON = 'model: reson-7k\n    endpoints: ["tcp-listen://127.0.0.1:%d"]\n    options: {range: 40, max_ping_rate: 10}\n'


class SeveralDrivers(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-drivers-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def opened(self, connection):
        self.addCleanup(connection.close)
        return connection

    def run_scenario(self, device, *arguments, more=""):
        emulator = Emulator(SCENARIO % device + more, *arguments)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def norbit(self, *arguments, more=""):
        self.ports = [free_port() for _ in range(3)]
        return self.run_scenario(NORBIT % tuple(self.ports), *arguments, more=more)

    def bathymetry(self):
        return self.opened(norbit_host.Stream(self.ports[1], 1))

    def reson(self, *arguments):
        self.ports = [free_port()]
        return self.run_scenario(RESON % self.ports[0], *arguments)

    def host(self):
        return self.opened(Host(("127.0.0.1", self.ports[0])))


class Norbit(SeveralDrivers):
    def test_every_host_gets_the_same_pings_and_its_own_answers(self):
        self.norbit()
        one, other = self.bathymetry(), self.bathymetry()
        first = {ping.ping: data for data in (one.packet() for _ in range(8)) for ping in [norbit_host.Bathymetry(data)]}
        second = {ping.ping: data for data in (other.packet() for _ in range(8)) for ping in [norbit_host.Bathymetry(data)]}
        common = sorted(first.keys() & second.keys())
        self.assertGreater(len(common), 4)
        self.assertEqual([first[n] for n in common], [second[n] for n in common])
        lines = [self.opened(norbit_host.Line(self.ports[0])) for _ in range(2)]
        for number, line in enumerate(lines):
            line.socket.sendall(b"set_rate %d" % (number + 3))
        for number, line in enumerate(lines):
            self.assertTrue(line.answer().startswith(f"set_rate {number + 3} "))
        other.close()
        before = one.next().ping
        self.assertEqual([one.next().ping for _ in range(3)], [before + 1, before + 2, before + 3])

    def test_one_that_does_not_read_stalls_the_others(self):
        self.norbit()
        line = self.opened(norbit_host.Line(self.ports[0]))
        line.ask("set_resolution 2048 512")
        slow, reader = self.opened(norbit_host.Stream(self.ports[2], 2)), self.bathymetry()
        reader.packet()
        reader.socket.settimeout(1.5)
        with self.assertRaises(TimeoutError):
            for _ in range(500):
                reader.packet()
        slow.close()
        reader.socket.settimeout(20)
        while reader.next().ping < 10:
            pass


class Reson(SeveralDrivers):
    def test_each_host_gets_what_it_subscribed_to_until_it_leaves(self):
        self.reson()
        one, other = self.host(), self.host()
        self.assertEqual(one.subscribe(reson_wire.SETTINGS), 0)
        self.assertEqual(other.subscribe(reson_wire.DETECTIONS, reson_wire.GEOMETRY), 0)
        self.assertEqual({one.record().kind for _ in range(8)}, {reson_wire.SETTINGS})
        self.assertEqual({other.record().kind for _ in range(8)}, {reson_wire.DETECTIONS, reson_wire.GEOMETRY})
        self.assertEqual(other.set(1003, 25), 0)
        one.wait(reson_wire.SETTINGS, 10, lambda r: abs(r.get("f", 54) - 25) < 1e-4)
        other.close()
        before = one.wait(reson_wire.SETTINGS).ping
        self.assertEqual([one.record().ping for _ in range(5)], [before + n for n in range(1, 6)])

    def test_one_that_never_reads_costs_bounded_memory_and_holds_nobody_up(self):
        emulator = self.reson()

        def memory():
            status = Path(f"/proc/{emulator.process.pid}/status").read_text()
            return int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1]) << 10

        slow, reader = self.host(), self.host()
        self.assertEqual(slow.subscribe(reson_wire.BEAMFORMED), 0)
        self.assertEqual(reader.subscribe(reson_wire.SETTINGS), 0)
        first = reader.wait(reson_wire.SETTINGS)
        early = reader.wait(reson_wire.SETTINGS, 30, lambda r: r.ping >= first.ping + 25)
        before = memory()  # 25 records of 1.9 MB are more than is kept
        late = reader.wait(reson_wire.SETTINGS, 30, lambda r: r.ping >= early.ping + 40)
        self.assertLess(memory() - before, 10e6, "40 records are 75 MB")
        self.assertLess((late.time - early.time).total_seconds(), 40 * 0.1 * 1.5)
        output = emulator.stop()[1]
        self.assertRegex(output, r"does not read; messages for it are lost")


class Stepped(SeveralDrivers):
    def test_time_waits_until_every_driver_has_been_told(self):
        self.ports, steps = [free_port()], free_port()
        scenario = (SCENARIO % (RESON % self.ports[0]) + "clock: {mode: stepped}\n").replace(
            "vehicle: {", f'vehicle: {{input: "tcp-listen://127.0.0.1:{steps}", ')
        emulator = Emulator(scenario)
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        with Stepper(steps) as stepper:
            stepper.step(0.01)
            one, other = self.host(), self.host()
            self.assertEqual(one.subscribe(reson_wire.SETTINGS, reson_wire.BEAMFORMED), 0)
            self.assertEqual(other.subscribe(reson_wire.SETTINGS), 0)
            for second in range(1, 4):
                stepper.send(now=second)
                early = select.select([stepper.socket], [], [], 0.5)[0]
                self.assertFalse(early, "19 MB fit no socket: the step is not over before they are read")
                pings = [one.wait(reson_wire.BEAMFORMED).ping for _ in range(9)]
                stepper.answer()
                self.assertEqual(pings, [other.record(0.5).ping for _ in range(9)], "on its way when the step has ended")
                more = one.wait(reson_wire.BEAMFORMED, 0.5).ping, other.record(0.5).ping
                self.assertEqual(more[0], more[1])


class Recorded(SeveralDrivers):
    def test_each_driver_is_a_stream_of_its_own_and_a_replay_plays_one(self):
        file = self.folder / "two.pcapng"
        with self.norbit("--record", file) as emulator:
            one, other = self.bathymetry(), self.bathymetry()
            heard = {}
            for stream in (one, other):
                heard[stream.socket.getsockname()[1]] = [stream.packet() for _ in range(6)]
            one.close()
            more = [other.packet() for _ in range(6)]
            emulator.stop()
        rows = packets(file, "tcp.payload", "tcp.stream", "tcp.dstport", "frame.interface_name")
        rows = [row for row in rows if row["frame.interface_name"] == ["multibeam bathymetry"]]
        self.assertEqual(len({row["tcp.stream"][0] for row in rows}), 2)
        for port, messages in heard.items():
            told = payload([row for row in rows if row["tcp.dstport"] == [str(port)]], "tcp.payload")
            self.assertTrue(told.startswith(b"".join(messages)), port)
        odd = "tcp.analysis.lost_segment || tcp.analysis.retransmission || tcp.analysis.out_of_order || _ws.malformed"
        self.assertEqual(packets(file, "frame.number", only=odd), [])
        port = free_port()
        command = [PROGRAM, "replay", file, f"tcp-listen://127.0.0.1:{port}", "--port", "multibeam bathymetry", "--json"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as player:
            self.addCleanup(player.kill)
            player.stdout.readline()
            listener = self.opened(norbit_host.Stream(port, 1))
            first = norbit_host.Bathymetry(heard[min(heard, key=lambda p: heard[p][0][36:40])][0]).ping
            last = norbit_host.Bathymetry(more[-1]).ping
            pings = [listener.next().ping for _ in range(last - first + 1)]
            self.assertEqual(pings, list(range(first, last + 1)), "each once, beyond the first driver's end")


class Faulty(SeveralDrivers):
    def test_labels_say_which_driver_and_where_in_its_stream(self):
        labels = self.folder / "labels.jsonl"
        fault = "faults:\n  - {device: multibeam, port: bathymetry, kind: wrong_checksum, rate: 0.4}\n"
        with self.norbit("--labels", labels, more=fault) as emulator:
            drivers = {}
            for _ in range(2):
                stream = self.bathymetry()
                drivers[stream.socket.getsockname()[1]] = stream, [self.damaged_packet(stream)]
            for stream, heard in drivers.values():
                heard += [self.damaged_packet(stream) for _ in range(12)]
            emulator.stop()
        events = [json.loads(line) for line in labels.read_text().splitlines()[1:]]
        for port, (_, heard) in drivers.items():
            data = b"".join(heard)
            mine = [e for e in events if e["driver"] == f"127.0.0.1:{port}" and e["offset"] < len(data)]
            self.assertEqual([data[e["offset"]] for e in mine], [e["is"] for e in mine])
            wrong = [n for n, packet in enumerate(heard) if zlib.crc32(packet[24:]) != int.from_bytes(packet[20:24], "little")]
            self.assertEqual(len(wrong), len(mine))
            self.assertGreater(len(wrong), 0)

    @staticmethod
    def damaged_packet(stream):
        header = stream.exactly(24)
        return header + stream.exactly(norbit_host.HEADER.unpack(header)[2] - 24)


if __name__ == "__main__":
    unittest.main()
