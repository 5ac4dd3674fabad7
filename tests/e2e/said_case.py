"""A run over a flat floor with a page, and the pictures that it reads back from the wire, for the tests of test_view_said*.py."""

import asyncio
import contextlib
import re
import threading
import unittest

import websockets

from program import Emulator
from test_view_capture import loudest_range, picture

DEPTH = 8.0  # m, of the floor below the head
FLAT = """
scene: {scenes}/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - {name: sonar, model: %s, mount: {rpy_deg: [%s]}, endpoints: [%s]%s}
"""
DOWN, LEVEL = "0, 90, 0", "0, 0, 0"
LINK = re.compile(r"http://(127\.0\.0\.1:\d+)/#([0-9a-f]{32})")


def drain(*connections):
    """Reads on, as a driver does, until the run ends."""

    def read(one):
        with contextlib.suppress(OSError):
            while one.recv(65536):
                pass

    for one in connections:
        one.settimeout(None)
        threading.Thread(target=read, args=(one,), daemon=True).start()


class SaidCase(unittest.TestCase):
    def start(self, model, ports, options="", mount=DOWN):
        """`ports`: of TCP, where the sonar listens; or endpoints as a scenario has them."""
        places = ", ".join(f'"tcp-listen://127.0.0.1:{one}"' if isinstance(one, int) else f'"{one}"' for one in ports)
        self.emulator = Emulator(FLAT % (model, mount, places, f", options: {{{options}}}" if options else ""), "--view")
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def said(self, *names):
        """{name of the message: (head, levels, ranges)}, of the third picture or a later one; self.heard: the last ping,
        self.names: of all pictures."""

        async def look():
            host, token = LINK.search(self.emulator.output).groups()
            found, self.heard, self.names = {}, None, set()
            async with websockets.connect(f"ws://{host}/news", subprotocols=["echoloop.view", token], max_size=None) as viewer:
                while set(names) - set(found) or self.heard is None:
                    message = await viewer.recv()
                    if not isinstance(message, bytes):
                        continue
                    if b'"type":"ping"' in message[:60]:
                        self.heard = picture(message)
                        continue
                    head, levels, ranges = picture(message)
                    self.names.add(head["name"])
                    gain_has_settled = head["number"] > 2
                    if head["name"] in names and gain_has_settled and (any(levels) or any(ranges)):
                        found[head["name"]] = head, levels, ranges
            return found

        return asyncio.run(asyncio.wait_for(look(), 60))

    def check_floor(self, head, levels, ranges):
        middle = min(range(head["beams"]), key=lambda b: abs(head["bearings"][b] + head["pan"]))
        if ranges:
            self.assertAlmostEqual(ranges[middle], DEPTH, delta=0.1)
        if levels and any(levels):
            self.assertAlmostEqual(loudest_range(head, levels, middle), DEPTH, delta=0.15)

    def check(self, *names):
        for name, one in self.said(*names).items():
            with self.subTest(name):
                self.check_floor(*one)


def begins(head, levels, beam, below):
    """m, where a beam comes within `below` of its loudest, in what the head's levels are counted in; beyond the water near by,
    which sends back, too."""
    line = levels[beam * head["bins"]:][: head["bins"]]
    ranges = [head["first_range"] + (b + 0.5) * head["bin_size"] for b in range(head["bins"])]
    near = 4
    loudest = max(byte for byte, at in zip(line, ranges) if at > near)
    return next(at for byte, at in zip(line, ranges) if at > near and byte and byte > loudest - below / head["step"])
