"""Who may see the page of a run and what a viewer may ask for; and that those who misbehave hold nobody up."""

import json
import os
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

import websockets
import websockets.exceptions

from ports import free_port
from program import PROGRAM
from view_case import ViewCase


class Gate(ViewCase):
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

    def test_options_of_the_page_without_it_are_refused(self):
        for more in (["--view-control"], ["--view-at", "127.0.0.1:0"], ["--view", "--view-at", "here"],
                     ["--view", "--view-record", "/tmp"], ["--view", "--view-control", "--view-record", "/no/folder"]):
            done = subprocess.run([PROGRAM, "run", "tank", *more], capture_output=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 64, more)
            self.assertIn(b"--view", done.stderr)


if __name__ == "__main__":
    unittest.main()
