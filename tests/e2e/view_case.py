"""A run with a page, and what its viewers are told, for the tests of test_view*.py."""

import asyncio
import http.client
import json
import re
import struct
import unittest

import websockets

from ports import free_port
from program import Emulator

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: micron, model: tritech-micron, endpoints: ["tcp-listen://127.0.0.1:%d"]}
  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp://127.0.0.1:%d"]}
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


class ViewCase(unittest.TestCase):
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
