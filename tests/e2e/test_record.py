"""`echoloop run --record`: Wireshark's own tools read the capture, and it holds what a driver said and heard."""

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import termios
import time
import tty
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, Emulator

REBOOT = bytes.fromhex("40303030380800ff02031080020a")
SEND_VERSION = bytes.fromhex("40303030380800ff02031780020a")
PROTOCOL_VERSION = bytes.fromhex("42520200060000000500a100")  # general_request for message 5
HEAD = "{name: head, model: tritech-micron, endpoints: ['%s'], options: {first_alive: 0.1}}"
SONAR = "{name: sonar, model: r2sonic-2024, endpoints: ['udp-listen://127.0.0.1:%d', 'udp://127.0.0.1:%d']}"


def scenario(*devices):
    return "scene: {scenes}/tank.glb\ndevices:\n" + "".join(f"  - {device}\n" for device in devices)


def packets(file, *fields, only=""):
    """Rows of the named fields, as tshark reads them; each field is a list of texts."""
    command = ["tshark", "-r", str(file), "-T", "json", "--no-duplicate-keys"]
    command += ["-Y", only] if only else []
    for field in fields:
        command += ["-e", field]
    done = subprocess.run(command, capture_output=True, check=True)
    return [packet["_source"]["layers"] for packet in json.loads(done.stdout or "[]")]


def payload(rows, field):
    return b"".join(bytes.fromhex(row[field][0].replace(":", "")) for row in rows if field in row)


class Record(unittest.TestCase):
    def test_a_serial_line_both_ways(self):
        with Emulator(scenario(HEAD % "pty:{folder}/head"), "--record", self.file) as emulator:
            line = os.open(emulator.folder / "head", os.O_RDWR | os.O_NOCTTY)
            tty.setraw(line, termios.TCSANOW)
            os.write(line, SEND_VERSION)
            heard = b""
            while heard.count(b"\n") < 4:
                heard += os.read(line, 4096)
            os.close(line)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"recorded +\S+: \d+ packets, \d+ bytes in 1 file\n")
        rows = packets(self.file, "rtacser.eventtype", "data.data", "frame.interface_name", "frame.packet_flags_direction")
        self.assertEqual({row["frame.interface_name"][0] for row in rows}, {"head line"})
        received = [row for row in rows if int(row["rtacser.eventtype"][0], 0) == 2]
        sent = [row for row in rows if int(row["rtacser.eventtype"][0], 0) == 1]
        self.assertEqual(payload(received, "data.data"), SEND_VERSION)
        self.assertTrue(payload(sent, "data.data").startswith(heard))
        self.assertEqual({int(row["frame.packet_flags_direction"][0], 0) for row in sent}, {2})

    def test_what_befalls_a_drivers_words_is_remarked_on_them(self):
        kinds = ("loss, rate: 0.3", "bit_flips, rate: 0.003", "latency, delay: 0.2", "reordering, rate: 0.2")
        faults = "".join(f"  - {{device: sounder, direction: from_driver, kind: {kind}}}\n" for kind in kinds)
        labels, port = self.file.with_name("labels"), free_port()
        sounder = "{name: sounder, model: ping1d, endpoints: ['udp-listen://127.0.0.1:%d']}" % port
        with Emulator(scenario(sounder) + "faults:\n" + faults, "--record", self.file, "--labels", labels) as emulator:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as driver:
                driver.connect(("127.0.0.1", port))
                driver.settimeout(20)
                for _ in range(40):
                    driver.send(PROTOCOL_VERSION)
                with contextlib.suppress(TimeoutError):  # all that will be answered is, when no more comes
                    while driver.recv(4096):
                        driver.settimeout(1.5)
            emulator.stop()
        events = [json.loads(line) for line in labels.read_text().splitlines()[1:]]
        self.assertEqual({e["kind"] for e in events}, {"loss", "bit_flips", "latency", "reordering"})
        rows = packets(self.file, "udp.payload", "frame.comment", only=f"udp.dstport == {port}")
        self.assertEqual(payload(rows, "udp.payload"), 40 * PROTOCOL_VERSION, "as it was said")
        remarks = {(number, text.split(",")[0]) for number, row in enumerate(rows)
                   for comment in row.get("frame.comment", []) for text in comment.split("\n")}  # 4.4 names some twice
        self.assertEqual(sorted(remarks), sorted({(e["message"], f"{e['kind']}: message {e['message']}") for e in events}))

    def test_datagrams_as_they_were_on_the_wire(self):
        base = free_port(16)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.bind(("127.0.0.1", base + 8))
            with Emulator(scenario(SONAR % (base, base + 8)), "--record", self.file) as emulator:
                heard = [listener.recv(65536) for _ in range(3)]
                self.assertEqual(emulator.stop()[0], 0)
        rows = packets(self.file, "udp.payload", "udp.srcport", "ip.dst", "ip.checksum.status", "frame.time_epoch",
                       only=f"udp.dstport == {base + 8}")
        self.assertEqual([payload([row], "udp.payload") for row in rows[:3]], heard)
        self.assertEqual({row["ip.dst"][0] for row in rows}, {"127.0.0.1"})
        self.assertLess(abs(float(rows[0]["frame.time_epoch"][0]) - time.time()), 60)
        self.assertEqual(packets(self.file, "frame.number", only="_ws.malformed"), [])

    def test_a_tcp_connection_is_one_stream(self):
        port = free_port()
        with Emulator(scenario(HEAD % f"tcp-listen://127.0.0.1:{port}"), "--record", self.file) as emulator:
            with socket.create_connection(("127.0.0.1", port), timeout=20) as driver:
                driver.sendall(SEND_VERSION)
                heard = b""
                while heard.count(b"\n") < 4:
                    heard += driver.recv(4096)
            self.assertEqual(emulator.stop()[0], 0)
        rows = packets(self.file, "tcp.payload", "tcp.stream", "tcp.dstport", "tcp.flags.syn")
        self.assertEqual({row["tcp.stream"][0] for row in rows}, {"0"})
        asked = [row for row in rows if row["tcp.dstport"][0] == str(port)]
        self.assertEqual(payload(asked, "tcp.payload"), SEND_VERSION)
        answers = payload([row for row in rows if row["tcp.dstport"][0] != str(port)], "tcp.payload")
        self.assertTrue(answers.startswith(heard))
        lost = packets(self.file, "frame.number", only="tcp.analysis.lost_segment || tcp.analysis.retransmission")
        self.assertEqual(lost, [])

    def test_killed_it_keeps_all_but_the_last_second_and_inspect_reads_it(self):
        with Emulator(scenario(HEAD % "pty:{folder}/head"), "--record", self.file) as emulator:
            line = os.open(emulator.folder / "head", os.O_RDWR | os.O_NOCTTY)
            tty.setraw(line, termios.TCSANOW)
            os.write(line, SEND_VERSION)
            while b"\n" not in os.read(line, 4096):
                pass
            end = time.monotonic() + 20
            while self.file.stat().st_size < 300 and time.monotonic() < end:  # the next write to the disk
                os.read(line, 4096)
            emulator.process.send_signal(signal.SIGKILL)
            emulator.process.communicate()
            os.close(line)
        done = subprocess.run([PROGRAM, "inspect", str(self.file), "--json"], capture_output=True, check=True)
        messages = json.loads(done.stdout)["messages"]
        self.assertEqual(messages[0]["name"], "SendVersion")
        self.assertEqual(messages[0]["line"], "head line, received")
        self.assertIn("VersionData", [m["name"] for m in messages])

    def test_files_of_limited_size_are_each_whole(self):
        base = free_port(16)
        options = ("--record", self.file, "--record-size", "0.02")
        with Emulator(scenario(SONAR % (base, base + 8)), *options) as emulator:
            end = time.monotonic() + 30
            third = self.folder / "capture-3.pcapng"
            while not third.exists() and time.monotonic() < end:
                time.sleep(0.05)
            status, output = emulator.stop()
        self.assertEqual(status, 0)
        self.assertRegex(output, r" in [3-9] files")
        for name in ("capture.pcapng", "capture-2.pcapng", "capture-3.pcapng"):
            summary = subprocess.run(["capinfos", "-c", str(self.folder / name)], capture_output=True, check=True)
            self.assertIn(b"Number of packets", summary.stdout)

    def test_a_full_disk_ends_the_recording_and_not_the_emulation(self):
        base = free_port(16)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
            listener.bind(("127.0.0.1", base + 8))
            with Emulator(scenario(SONAR % (base, base + 8)), "--record", "/dev/full") as emulator:
                emulator.read_until("the recording has stopped", 30)
                self.drop_what_waits(listener)
                listener.settimeout(20)
                self.assertEqual(listener.recv(65536)[:4], b"BTH0")
                status, output = emulator.stop()
        self.assertEqual(status, 0)
        self.assertEqual(output.count("the recording has stopped"), 1)
        self.assertIn("it stopped early", output)

    def test_a_file_that_cannot_be_made_ends_with_73(self):
        text = scenario(HEAD % "pty:{folder}/head").replace("{folder}", str(self.folder))
        scene = Path(__file__).resolve().parents[2] / "config" / "scenes"
        file = self.folder / "scenario.yaml"
        file.write_text(text.replace("{scenes}", str(scene)))
        done = subprocess.run([PROGRAM, "run", str(file), "--duration", "0", "--record", "/no/such/folder/a.pcapng"],
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 73)
        self.assertIn(b"/no/such/folder/a.pcapng: cannot be written", done.stderr)

    @staticmethod
    def drop_what_waits(listener):
        with contextlib.suppress(BlockingIOError):
            while True:
                listener.recv(65536, socket.MSG_DONTWAIT)

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-record-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.file = self.folder / "capture.pcapng"


if __name__ == "__main__":
    unittest.main()
