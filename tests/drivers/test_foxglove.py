"""Foxglove's protocol on the port of the page: its makers' own client, then connections that are to be refused."""

import base64
import json
import re
import socket
import subprocess
import sys
import unittest

import public_driver

public_driver.use("bag", "mcap_ros2")
MODULES = public_driver.node("@foxglove/ws-protocol")

from mcap.records import Schema  # noqa: E402
from mcap_ros2.decoder import DecoderFactory  # noqa: E402
from ports import free_port  # noqa: E402
from program import ROOT, Emulator  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
"""
PLACE = re.compile(r"ws://(127\.0\.0\.1):(\d+)/\?token=([0-9a-f]{32})")


class Foxglove(unittest.TestCase):
    def setUp(self):
        self.emulator = Emulator(TANK % free_port(), "--view")
        self.emulator.__enter__()
        self.addCleanup(self.emulator.__exit__, None, None, None)
        place = PLACE.search(self.emulator.output)
        self.url, self.port, self.token = place[0], int(place[2]), place[3]

    def see(self, *topics):
        script = ROOT / "tests" / "drivers" / "node" / "foxglove.mjs"
        done = subprocess.run(["node", str(script), str(MODULES), self.url, *topics], capture_output=True, text=True,
                              timeout=40)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_a_client_of_its_makers_sees_the_topics_of_the_bag(self):
        lines = self.see("/bottom/raw", "/bottom/picture", "/odom", "/bottom/wire")
        self.assertEqual(lines[0], {"server": "echoloop", "capabilities": []})
        types = {line["channel"]: line for line in lines if "channel" in line}
        self.assertEqual(types["/tf"]["type"], "tf2_msgs/msg/TFMessage")
        found = {}
        for line in lines:
            if "topic" in line:
                of = types[line["topic"]]
                schema = Schema(data=of["schema"].encode(), encoding="ros2msg", id=1, name=of["type"])
                decode = DecoderFactory().decoder_for(of["encoding"], schema)
                found[line["topic"]] = decode(base64.b64decode(line["data"]))
        self.assertEqual(found["/odom"].pose.pose.position.z, -2)
        raw = found["/bottom/raw"]
        self.assertEqual(raw.image.beam_count, 1)
        self.assertEqual(found["/bottom/picture"].width, 480)
        self.assertEqual(found["/bottom/wire"].status[0].hardware_id, "bottom")

    def ask(self, target, host=None, protocol="foxglove.websocket.v1", origin=None):
        """The status line of an upgrade."""
        with socket.create_connection(("127.0.0.1", self.port), 20) as client:
            lines = [f"GET {target} HTTP/1.1", f"Host: {host or f'127.0.0.1:{self.port}'}", "Connection: Upgrade",
                     "Upgrade: websocket", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
                     f"Sec-WebSocket-Protocol: {protocol}"] + ([f"Origin: {origin}"] if origin else [])
            client.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
            return client.recv(4096).decode("latin-1")

    def test_who_has_the_token_may_look_and_nobody_else(self):
        good = f"/?token={self.token}"
        for protocol in ("foxglove.websocket.v1", "foxglove.sdk.v1"):
            answer = self.ask(good, protocol=protocol, origin="https://app.foxglove.dev")
            self.assertIn(" 101 ", answer.splitlines()[0])
            self.assertIn(f"Sec-WebSocket-Protocol: {protocol}", answer)
        for answer in (self.ask("/"), self.ask("/?token=" + "0" * 32), self.ask(good + "0"),
                       self.ask(good, host="evil.example"), self.ask(good, protocol="other")):
            self.assertNotIn(" 101 ", answer.splitlines()[0])

    def test_a_client_that_never_reads_takes_nothing_from_the_others(self):
        with socket.create_connection(("127.0.0.1", self.port), 20) as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.sendall((f"GET /?token={self.token} HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\nConnection: Upgrade\r\n"
                          "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                          "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n").encode())
            wanted = json.dumps({"op": "subscribe", "subscriptions": [{"id": n, "channelId": n} for n in range(1, 40)]}).encode()
            deaf.sendall(bytes([0x81, 0xFE]) + len(wanted).to_bytes(2, "big") + bytes(4) + wanted)  # masked by zeros
            import websockets.sync.client as websockets
            with websockets.connect(self.url, subprotocols=["foxglove.websocket.v1"], max_size=None) as viewer:
                channels = {}
                while "/bottom/picture" not in channels:
                    message = viewer.recv(20)
                    if isinstance(message, str) and json.loads(message)["op"] == "advertise":
                        channels.update((one["topic"], one["id"]) for one in json.loads(message)["channels"])
                viewer.send(json.dumps({"op": "subscribe", "subscriptions": [{"id": 7, "channelId": channels["/bottom/picture"]}]}))
                pictures = 0
                while pictures < 3:
                    pictures += isinstance(viewer.recv(20), bytes)
        self.assertEqual(self.emulator.stop()[0], 0, self.emulator.output)

    def test_bytes_that_are_no_requests_harm_nothing(self):
        import websockets.sync.client as websockets
        with websockets.connect(self.url, subprotocols=["foxglove.websocket.v1"], max_size=None) as viewer:
            for text in ("", "{", "[]", '{"op": "subscribe"}', '{"op": "subscribe", "subscriptions": [1, {"id": -1}]}',
                         '{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 99999999999}]}',
                         '{"op": "unsubscribe", "subscriptionIds": ["x", {}]}', '{"op": {"a": 1}, "subscriptions": 3}'):
                viewer.send(text)
            self.assertEqual(json.loads(viewer.recv(20))["op"], "serverInfo")
        self.assertEqual(self.see("/odom")[0]["server"], "echoloop")


if __name__ == "__main__":
    unittest.main(verbosity=2)
