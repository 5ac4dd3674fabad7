"""The page of a run, met by clients of another make: http.client and websockets."""

import asyncio
import contextlib
import hashlib
import http.client
import json
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import websockets

from ports import free_port
from program import PROGRAM, ROOT, Emulator
from stepper import Stepper

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
import seanet_wire  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: micron, model: tritech-micron, endpoints: ["tcp-listen://127.0.0.1:%d"]}
  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
"""
IMAGING = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: imaging, model: sonar-3d-15, endpoints: ["tcp-listen://127.0.0.1:%d"]}
"""
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
LINK = re.compile(r"http://(127\.0\.0\.1:(\d+))/#([0-9a-f]{32})")


def picture(message):
    """(head, levels in dB or None, objects) of a ping's message; no levels of what was said, not always objects."""
    length = struct.unpack_from("<I", message)[0]
    head = json.loads(message[4 : 4 + length])
    if head["type"] == "said":
        return head, [], []
    count = head["rows"] * head["beams"] * head["bins"]
    levels = [None if b == 0 else head["floor"] + (b - 1) * head["step"] for b in message[4 + length :][:count]]
    objects = struct.unpack_from(f"<{count}H", message, 4 + length + count) if head["objects"] else ()
    return head, levels, objects


class View(unittest.TestCase):
    def start(self, *arguments, scenario=None):
        text = scenario or TANK % (free_port(), free_port())
        self.emulator = Emulator(text, "--view", *arguments)
        self.emulator.__enter__()
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.host, port, self.token = LINK.search(self.emulator.output).groups()
        self.port = int(port)

    def get(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        self.addCleanup(connection.close)
        connection.request(method, path, headers={name.replace("_", "-"): text for name, text in headers.items()})
        answer = connection.getresponse()
        return answer.status, answer.read(), dict(answer.getheaders())

    def connect(self, token=None, **options):
        return websockets.connect(
            f"ws://{self.host}/news", subprotocols=["echoloop.view", token or self.token], max_size=None, **options
        )

    def see(self, look, **options):
        """What `look(socket)` makes of a viewer's connection."""

        async def run():
            async with self.connect(**options) as viewer:
                return await asyncio.wait_for(look(viewer), 30)

        return asyncio.run(run())

    @staticmethod
    async def until(viewer, wanted):
        """The first message that `wanted(message, JSON or None)` makes something of."""
        while True:
            message = await viewer.recv()
            found = wanted(message, json.loads(message) if isinstance(message, str) else None)
            if found:
                return found

    def test_an_echosounders_line_shows_the_floor_at_its_depth_and_names_it(self):
        self.start()

        async def look(viewer):
            def floor(message, text):
                if text is None:
                    head, levels, objects = picture(message)
                    wanted = head["type"] == "ping" and head["device"] == "bottom" and objects
                    return wanted and (head, levels, objects)

            return await self.until(viewer, floor)

        head, levels, objects = self.see(look)
        loudest = max((b for b, level in enumerate(levels) if level), key=lambda b: levels[b])
        self.assertAlmostEqual(head["first_range"] + (loudest + 0.5) * head["bin_size"], 2, delta=0.1)
        scene = self.get("/scene", Authorization="Bearer " + self.token)[1]
        names = json.loads(scene[4 : 4 + struct.unpack_from("<I", scene)[0]])["objects"]
        self.assertIn("floor", names[objects[loudest] - 1].lower())

    def test_what_a_driver_says_is_told_with_its_fields_and_what_is_refused_with_the_reason(self):
        micron = free_port()
        self.start(scenario=TANK % (micron, free_port()))

        async def look(viewer):
            await viewer.recv()  # hello
            with socket.create_connection(("127.0.0.1", micron)) as driver:
                driver.sendall(b"\x00\x01garbage")  # no message of the sonar's
                driver.sendall(seanet_wire.build(seanet_wire.SEND_VERSION))

                def told(_, text):
                    if text and text["type"] == "messages":
                        for one in text["messages"]:
                            if one["device"] == "micron" and not one["sent"]:
                                seen.append(one)
                        return any(one["reason"] for one in seen) and any(one["name"] for one in seen)

                seen = []
                await self.until(viewer, told)
                return seen

        seen = self.see(look)
        self.assertTrue(any(one["fields"] for one in seen if one["name"]), seen)

    def test_what_a_driver_has_set_before_anybody_looked_is_told(self):
        micron = free_port()
        self.start(scenario=TANK % (micron, free_port()))
        with socket.create_connection(("127.0.0.1", micron)) as driver:
            driver.sendall(seanet_wire.build(seanet_wire.SEND_VERSION))
            driver.recv(100)  # the head has heard it

            async def look(viewer):
                def told(_, text):
                    set_ = [one["name"] for one in text.get("set", [])] if text else []
                    return "SendVersion" in set_

                return await self.until(viewer, told)

            self.assertTrue(self.see(look))

    def test_a_fault_stands_on_the_message_that_it_was_made_on(self):
        self.start("--view-control")

        async def look(viewer):
            fault = {"device": "bottom", "kind": "bit_flips", "rate": 0.02, "for": 60}
            await viewer.send(json.dumps({"ask": {"fault": fault}, "id": 1}))

            def told(_, text):
                rows = text["messages"] if text and text["type"] == "messages" else []
                return [one for one in rows if "bit_flips" in one.get("fault", "")]

            marked = await self.until(viewer, told)
            await viewer.send(json.dumps({"ask": {"clear": "all"}, "id": 2}))
            await viewer.send(json.dumps({"ask": {"fault": {**fault, "kind": "loss", "rate": 1}}, "id": 3}))

            def lost(_, text):
                rows = text["messages"] if text and text["type"] == "messages" else []
                return [one for one in rows if "loss" in one.get("fault", "")]

            return marked[0], (await self.until(viewer, lost))[0]

        marked, lost = self.see(look)
        self.assertEqual((marked["device"], marked["sent"]), ("bottom", True))
        self.assertGreater(marked["size"], 20)
        self.assertNotEqual(marked["name"], "fault")
        self.assertEqual((lost["device"], lost["name"], lost["size"]), ("bottom", "fault", 0), "what is lost is on no message")

    def test_what_is_asked_by_http_is_told_with_its_values(self):
        port = free_port()
        self.start(scenario=IMAGING % port)

        async def look(viewer):
            await viewer.recv()  # hello
            body = json.dumps({"min": 0.5, "max": 4.5})

            def ask():
                sonar = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
                sonar.request("POST", "/api/v1/integration/acoustics/range", body, {"Content-Type": "application/json"})
                return sonar.getresponse().status

            self.assertEqual(await asyncio.get_running_loop().run_in_executor(None, ask), 204)

            def told(_, text):
                rows = text["set"] if text and text["type"] == "messages" else []
                return next((one for one in rows if one["name"].endswith("/acoustics/range")), None)

            return await self.until(viewer, told)

        setting = self.see(look)
        self.assertEqual(setting["name"], "POST /api/v1/integration/acoustics/range")
        self.assertEqual([field[:2] for field in setting["fields"]], [["min", "0.5"], ["max", "4.5"]])

    def test_the_queue_of_the_render_threads_is_told(self):
        self.start()

        async def look(viewer):
            return await self.until(viewer, lambda _, text: text and text["type"] == "status" and text["status"])

        rendering = self.see(look)["rendering"]
        self.assertGreaterEqual(rendering["threads"], 1)
        self.assertLessEqual(rendering["drawing"], rendering["threads"])

    def test_a_page_records_only_into_the_folder_that_the_run_names(self):
        async def look(viewer):
            await viewer.send(json.dumps({"ask": {"record": True}, "id": 1}))
            await viewer.send(json.dumps({"ask": {"record": "/tmp/elsewhere.pcapng"}, "id": 2}))  # ends it: it is not true
            first = await self.until(viewer, lambda _, text: text and text["type"] == "answer" and text["id"] == 1 and text)
            second = await self.until(viewer, lambda _, text: text and text["type"] == "answer" and text["id"] == 2 and text)
            return first["answer"], second["answer"]

        with tempfile.TemporaryDirectory() as folder:
            self.start("--view-control", "--view-record", folder)
            began, ended = self.see(look)
            self.assertEqual(Path(began["recording"]).parent, Path(folder))
            self.assertEqual(began["recording"], ended["recorded"])
            self.assertFalse(Path("/tmp/elsewhere.pcapng").exists())
        self.start("--view-control")
        self.assertIn("error", self.see(look)[0])

    def test_a_link_at_a_named_port_stays_the_same_for_the_user_alone(self):
        port = free_port()
        tokens = set()
        for _ in range(2):
            self.start("--view-at", f"127.0.0.1:{port}")
            tokens.add(self.token)
            self.emulator.stop()
        self.assertEqual(len(tokens), 1)
        user = os.getuid()
        places = (os.environ.get("XDG_RUNTIME_DIR", ""), f"/run/user/{user}", f"/tmp/echoloop-{user}")
        files = {file for place in places if place for file in Path(place).rglob(f"view-{port}")}
        self.assertEqual([file.stat().st_mode & 0o777 for file in files], [0o600])
        files.pop().unlink()

    def test_the_scene_is_the_one_that_is_run(self):
        self.start()
        self.assertEqual(self.get("/scene")[0], 401)
        status, body, _ = self.get("/scene", Authorization="Bearer " + self.token)
        self.assertEqual(status, 200)
        length = struct.unpack_from("<I", body)[0]
        head = json.loads(body[4 : 4 + length])
        corners = sum(part["corners"] for part in head["parts"])
        self.assertEqual(corners, 3 * head["triangles"])
        numbers = struct.unpack(f"<{3 * corners}f", body[4 + length :])
        for axis in range(3):
            self.assertAlmostEqual(min(numbers[axis::3]), head["bounds"][0][axis], places=4)
            self.assertAlmostEqual(max(numbers[axis::3]), head["bounds"][1][axis], places=4)

    def test_the_page_loads_from_itself_only(self):
        self.start()
        for path, kind in (("/", "text/html"), ("/style.css", "text/css"), ("/app.js", "text/javascript")):
            status, body, headers = self.get(path)
            self.assertEqual((status, headers["Content-Type"].split(";")[0]), (200, kind))
            self.assertGreater(len(body), 500)
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            self.assertNotIn("Access-Control-Allow-Origin", headers)
        self.assertEqual(self.get("/../etc/passwd")[0], 404)

    def test_another_host_origin_method_or_token_is_refused(self):
        self.start()
        self.assertEqual(self.get("/", Host="evil.example")[0], 421)
        self.assertEqual(self.get("/", Origin="http://evil.example")[0], 403)
        self.assertEqual(self.get("/", method="POST")[0], 405)
        for options in ({"token": "0" * 32}, {"origin": "http://evil.example"}):
            with self.assertRaises(websockets.exceptions.InvalidStatusCode):
                self.see(lambda viewer: viewer.recv(), **options)

    def test_a_page_asks_for_faults_only_where_the_run_lets_it(self):
        ask = json.dumps({"ask": {"fault": {"device": "micron", "kind": "loss", "rate": 0.5, "for": 5}}, "id": 7})

        async def look(viewer):
            await viewer.send(ask)
            return await self.until(viewer, lambda _, text: text and text["type"] == "answer" and text)

        self.start()
        refused = self.see(look)
        self.assertEqual((refused["id"], refused["answer"]["ok"]), (7, False))
        self.assertIn("--view-control", refused["answer"]["error"])
        self.start("--view-control")
        self.assertEqual(self.see(look)["answer"]["ok"], True)

    def test_a_hundred_connections_and_a_viewer_that_never_reads_hold_nobody_up(self):
        self.start()
        silent = [socket.create_connection(("127.0.0.1", self.port)) for _ in range(100)]
        for one in silent:
            self.addCleanup(one.close)
        for one in silent[40:]:  # beyond what is served they are hung up on at once
            one.settimeout(20)
            self.assertEqual(one.recv(1), b"")
        for one in silent:
            one.close()

        deaf = socket.create_connection(("127.0.0.1", self.port))  # a viewer that never reads
        self.addCleanup(deaf.close)
        deaf.sendall(
            (
                f"GET /news HTTP/1.1\r\nHost: {self.host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                f"Sec-WebSocket-Protocol: echoloop.view, {self.token}\r\n\r\n"
            ).encode()
        )

        async def look(viewer):
            for _ in range(20):
                await self.until(viewer, lambda message, _: isinstance(message, bytes))
            return True

        self.assertTrue(self.see(look))
        status, output = self.emulator.stop()
        self.assertEqual(status, 0, output)

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
            seen = []
            if viewers:
                link, _, token = LINK.search(emulator.output).groups()

            def look():
                async def take():
                    async with websockets.connect(f"ws://{link}/news", subprotocols=["echoloop.view", token], max_size=None) as viewer:
                        ready.release()
                        async for message in viewer:
                            seen.append(isinstance(message, bytes))

                with contextlib.suppress(websockets.exceptions.ConnectionClosed):
                    asyncio.run(take())

            ready = threading.Semaphore(0)
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
            status, output = emulator.stop()
            for thread in threads:
                thread.join(30)
        self.assertEqual(status, 0, output)
        self.assertGreater(heard, 30)
        if viewers:
            self.assertTrue(any(seen), "the viewers saw pictures")
        return digest.hexdigest()

    def test_watching_changes_no_byte_of_a_stepped_run(self):
        self.assertEqual(self.stepped(0), self.stepped(2))

    def test_options_of_the_page_without_it_are_refused(self):
        for more in (["--view-control"], ["--view-at", "127.0.0.1:0"], ["--view", "--view-at", "here"],
                     ["--view", "--view-record", "/tmp"], ["--view", "--view-control", "--view-record", "/no/folder"]):
            done = subprocess.run([PROGRAM, "run", "tank", *more], capture_output=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 64, more)
            self.assertIn(b"--view", done.stderr)


if __name__ == "__main__":
    unittest.main()
