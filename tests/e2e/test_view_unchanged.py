"""Whether somebody looks at a run changes no byte of it."""

import asyncio
import contextlib
import hashlib
import socket
import struct
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import websockets
import websockets.exceptions

from ports import free_port
from program import PROGRAM, ROOT, Emulator
from stepper import Stepper
from view_case import LINK

STEPPED = """
scene: {scenes}/tank.glb
seed: 3
water: {temperature: 15, salinity: 0, ph: 7}
vehicle: {pose: {position: [0, 0, -2]}}
clock: {mode: stepped, input: "tcp-listen://127.0.0.1:%d"}
devices:
  - {name: sounder, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
  - {name: multibeam, model: r2sonic-2024, mount: {rpy_deg: [0, 60, 0]}, options: {ping_rate: 7, range: 12},
     endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d", "udp-listen://127.0.0.1:%d"]}
"""


class Unchanged(unittest.TestCase):
    def test_nobody_looks_and_nothing_changes(self):
        """The bytes of a free run are the same with a page and without."""
        text = """
clock: {mode: free, duration: 3}
seed: 7
scene: %s/config/scenes/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:9999"]}
""" % ROOT
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            (place / "s.yaml").write_text(text)
            captures = []
            for name, more in (("a", []), ("b", ["--view"])):
                file = place / (name + ".pcapng")
                subprocess.run([PROGRAM, "run", str(place / "s.yaml"), "--record", str(file), *more],
                               check=True, stdout=subprocess.DEVNULL, timeout=60)
                captures.append(file.read_bytes())
            self.assertEqual(captures[0], captures[1])

    def stepped(self, viewers):
        """The hash of all that a multibeam and a sounder say in 3 s of a stepped run, looked at by so many."""
        steps, sounder, head, beams = free_port(), free_port(), free_port(16), free_port(8)
        text = STEPPED % (steps, sounder, head, beams, head + 12)
        digest, heard = hashlib.sha256(), 0
        with contextlib.ExitStack() as stack:
            hosts = []
            for port in (sounder, *range(beams, beams + 8)):
                host = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
                host.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
                host.bind(("127.0.0.1", port))
                host.setblocking(False)
                hosts.append(host)
            emulator = stack.enter_context(Emulator(text, *(["--view"] if viewers else [])))
            if viewers:
                link, _, token = LINK.search(emulator.output).groups()

            def look():
                async def take():
                    async with websockets.connect(f"ws://{link}/news", subprotocols=["echoloop.view", token], max_size=None) as viewer:
                        ready.release()
                        async for message in viewer:
                            if isinstance(message, bytes):
                                seen.release()

                with contextlib.suppress(websockets.exceptions.ConnectionClosed):
                    asyncio.run(take())

            ready, seen = threading.Semaphore(0), threading.Semaphore(0)
            threads = [threading.Thread(target=look, daemon=True) for _ in range(viewers)]
            for thread in threads:
                thread.start()
            for _ in threads:
                self.assertTrue(ready.acquire(timeout=30))
            with Stepper(steps) as simulator:
                for n in range(31):
                    simulator.step(n / 10, position=[0, 0, -2 - n / 100])
                    for host in hosts:
                        with contextlib.suppress(BlockingIOError):
                            while True:
                                datagram = host.recv(65536)
                                heard += 1
                                digest.update(struct.pack("<I", len(datagram)) + datagram)
            if viewers:  # the page gives way to the run, so its pictures may come after it
                self.assertTrue(seen.acquire(timeout=30), "the viewers saw pictures")
            status, output = emulator.stop()
            for thread in threads:
                thread.join(30)
        self.assertEqual(status, 0, output)
        self.assertGreater(heard, 30)
        return digest.hexdigest()

    def test_watching_changes_no_byte_of_a_stepped_run(self):
        self.assertEqual(self.stepped(0), self.stepped(2))


if __name__ == "__main__":
    unittest.main()
