"""`echoloop record` between a device and its driver, both played by this test; Wireshark's tools read what it wrote."""

import os
import select
import signal
import socket
import subprocess
import time
import unittest

from ports import free_port
from program import PROGRAM
from replaying import Folder, Replay, open_line, read_line
from test_record import packets, payload

ASK, ANSWER = b"\x01ask\xff\x00", bytes(range(256)) * 20


class Recorder:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "record", *map(str, arguments)], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def __enter__(self):
        output, end = b"", time.monotonic() + 20
        while b"Ctrl-C" not in output:
            if not select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))[0]:
                raise RuntimeError(output)
            output += os.read(self.process.stdout.fileno(), 4096)
        return self

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        output = self.process.communicate(timeout=20)[0].decode()
        assert self.process.returncode == 0, output
        return output

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()


def receive(stream, size):
    data = b""
    while len(data) < size and (piece := stream.recv(size - len(data))):
        data += piece
    return data


class Record(unittest.TestCase):
    def setUp(self):
        folder = Folder()
        self.addCleanup(folder.remove)
        self.folder = folder.path
        self.capture = folder.path / "lake.pcapng"

    def test_a_connection_between_both(self):
        listener = socket.create_server(("127.0.0.1", 0))
        listener.settimeout(20)
        port, driver_port = listener.getsockname()[1], free_port()
        with listener, Recorder(f"tcp://127.0.0.1:{port}", f"tcp-listen://127.0.0.1:{driver_port}", "--out",
                                self.capture, "--name", "head") as recorder:
            device, _ = listener.accept()
            driver = socket.create_connection(("127.0.0.1", driver_port), timeout=20)
            with device, driver:
                device.settimeout(20)
                for _ in range(3):
                    driver.sendall(ASK)
                    self.assertEqual(receive(device, len(ASK)), ASK)
                    device.sendall(ANSWER)
                    self.assertEqual(receive(driver, len(ANSWER)), ANSWER)
                output = recorder.stop()
        self.assertRegex(output, rf"from the device +{3 * len(ANSWER)} bytes\nfrom the driver +{3 * len(ASK)} bytes\n")
        rows = packets(self.capture, "tcp.payload", "tcp.srcport", "tcp.stream", "frame.interface_name",
                       "frame.packet_flags_direction")
        self.assertEqual({row["frame.interface_name"][0] for row in rows}, {"head line"})
        said = [row for row in rows if row["tcp.srcport"][0] == str(port)]
        self.assertEqual(payload(said, "tcp.payload"), 3 * ANSWER)
        self.assertEqual({int(row["frame.packet_flags_direction"][0], 0) for row in said}, {2})
        self.assertEqual(payload([row for row in rows if row not in said], "tcp.payload"), 3 * ASK)
        self.assertEqual(packets(self.capture, "frame.number", only="tcp.analysis.lost_segment"), [])

    def test_when_the_driver_leaves_the_device_is_left_too(self):
        listener = socket.create_server(("127.0.0.1", 0))
        listener.settimeout(20)
        driver_port = free_port()
        with listener, Recorder(f"tcp://127.0.0.1:{listener.getsockname()[1]}", f"tcp-listen://127.0.0.1:{driver_port}",
                                "--out", self.capture):
            device, _ = listener.accept()
            with device:
                socket.create_connection(("127.0.0.1", driver_port), timeout=20).close()
                device.settimeout(20)
                self.assertEqual(device.recv(1), b"")

    def test_datagrams_keep_their_bounds_and_what_was_recorded_can_be_replayed(self):
        base = free_port(2)
        device = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        driver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        device.bind(("127.0.0.1", base))
        driver.connect(("127.0.0.1", base + 1))
        said = [bytes([i]) * (100 * i + 1) for i in range(5)]
        with device, driver:
            for end in (device, driver):
                end.settimeout(20)
            with Recorder(f"udp://127.0.0.1:{base}", f"udp-listen://127.0.0.1:{base + 1}", "--out",
                          self.capture) as recorder:
                driver.send(ASK)
                asked, relay = device.recvfrom(65536)
                self.assertEqual(asked, ASK)
                for data in said:
                    device.sendto(data, relay)
                    self.assertEqual(driver.recv(65536), data)
                recorder.stop()
            with Replay(self.capture, f"udp-listen://127.0.0.1:{base + 1}", "--answer"):
                driver.send(ASK)
                self.assertEqual([driver.recv(65536) for _ in said], said)

    def test_a_pty_for_the_driver_and_no_time_lost(self):
        listener = socket.create_server(("127.0.0.1", 0))
        listener.settimeout(20)
        with listener, Recorder(f"tcp://127.0.0.1:{listener.getsockname()[1]}", f"pty:{self.folder}/head", "--out",
                                self.capture):
            device, _ = listener.accept()
            line = open_line(self.folder / "head")
            with device:
                device.settimeout(20)
                times = []
                for _ in range(20):
                    begin = time.monotonic()
                    os.write(line, ASK)
                    self.assertEqual(receive(device, len(ASK)), ASK)
                    device.sendall(b"answer")
                    self.assertEqual(b"".join(data for _, data in read_line(line, 6)), b"answer")
                    times.append(time.monotonic() - begin)
            os.close(line)
        self.assertLess(sorted(times)[10], 0.01, "there and back")

    def test_what_cannot_be_opened_is_refused(self):
        for arguments, status in ((("nonsense", "pty:/tmp/x", "--out", self.capture), 64),
                                  (("tcp://127.0.0.1:1", f"pty:{self.folder}/x"), 64),
                                  (("serial:///dev/none", f"pty:{self.folder}/x", "--out", self.capture), 69),
                                  (("tcp://127.0.0.1:1", f"pty:{self.folder}/x", "--out", "/no/such/a.pcapng"), 73)):
            done = subprocess.run([PROGRAM, "record", *map(str, arguments)], capture_output=True, check=False,
                                  timeout=20)
            self.assertEqual(done.returncode, status, done.stderr)


if __name__ == "__main__":
    unittest.main()
