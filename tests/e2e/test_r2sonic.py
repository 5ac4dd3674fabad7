"""The Sonic 2024 end to end over UDP on loopback, against a reader written apart from the C++."""

import math
import time
import unittest

from ports import free_port
from program import Emulator

from r2sonic_host import Host
from r2sonic_reader import soundings

FLOOR = """
scene: %s
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, %g], rpy_deg: [%g, 0, 0]}}
devices:
  - name: multibeam
    model: %s
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d", "udp-listen://127.0.0.1:%d"]
    options: {ping_rate: 5%s}
"""
FLAT_Z = -20.0


class R2SonicCase(unittest.TestCase):
    def start(self, z=-12.0, options="", model="r2sonic-2024", scene="{scenes}/flat.glb", roll=0.0):
        gui, head, sim = free_port(8), None, None
        host = Host(("127.0.0.1", gui), None, None)
        self.addCleanup(host.close)
        head = free_port(8)
        sim = head + 16
        emulator = Emulator(FLOOR % (scene, z, roll, model, head, gui, sim, options))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()
        host.head, host.sim = ("127.0.0.1", head), ("127.0.0.1", sim)
        self.serial = 0
        return host, emulator

    def collect(self, host, done, seconds=30):
        """Events until `done(events)`; every one must be free of faults."""
        events, end = [], time.monotonic() + seconds
        while not done(events):
            self.assertLess(time.monotonic(), end, f"only {[e['event'] for e in events][-20:]}")
            for event in host.poll(0.5):
                self.assertEqual(event["faults"], [], event["event"])
                events.append(event)
        return events

    def pings(self, host, count, where=lambda ping: True):
        found = lambda events: [e["ping"] for e in events if e["event"] == "ping" and where(e["ping"])]
        return found(self.collect(host, lambda events: len(found(events)) >= count))


class Bathymetry(R2SonicCase):
    def check_depths(self, ping, depth):
        inner = [p for p in soundings(ping) if abs(p["angle"]) <= math.radians(60)]
        self.assertGreater(len(inner), 150)
        errors = [(p["depth"] - depth) / depth for p in inner]
        for p, error in zip(inner, errors):
            self.assertTrue(p["quality"] & 0xC, f"no bottom at {math.degrees(p['angle']):.1f} deg")
            # Patches of the bottom and speckle move a single sounding, and stay where they are: one of 256 by 0.6 %.
            self.assertLess(abs(error), 0.007, f"at {math.degrees(p['angle']):.1f} deg")
        self.assertLess(sum(e * e for e in errors) / len(errors), 0.0015 ** 2)
        self.assertLess(abs(sum(errors)) / len(errors), 0.0005, "no bias")

    def test_flat_floor_within_half_a_per_cent(self):
        host, _ = self.start(z=-12.0, options=", range: 40")
        for ping in self.pings(host, 4):
            self.check_depths(ping, 8.0)
        host.send_commands({"BOS0": 1, "BIE0": 1})
        for ping in self.pings(host, 3, lambda ping: ping.mode == "equi-distant"):
            self.check_depths(ping, 8.0)
            self.assertIsNotNone(ping.intensity)

    def test_a_long_pulse_does_not_shift_the_bottom(self):
        host, _ = self.start(z=-12.0, options=", range: 40, pulse: 0.00038")
        for ping in self.pings(host, 4):
            depths = [p["depth"] for p in soundings(ping) if abs(p["angle"]) <= math.radians(60)]
            self.assertLess(abs(sum(depths) / len(depths) - 8.0) / 8.0, 0.005)

    def test_commands_change_the_next_ping(self):
        host, _ = self.start(options=", range: 40")
        self.pings(host, 1)
        host.send_commands({"RNG0": 25.0, "SEW0": math.radians(60), "FRQ0": 200e3, "SVL0": 1480.0, "SVU0": 1})
        ping = self.pings(host, 1, lambda ping: abs(ping.header["range"] - 25.0) < 1e-3)[0]
        self.assertAlmostEqual(ping.angles[0], -math.radians(30 * 255 / 256), places=4)  # its 256 cells' middles
        self.assertAlmostEqual(ping.angles[-1], math.radians(30 * 255 / 256), places=4)
        self.assertAlmostEqual(ping.header["sound_speed"], 1480.0, places=3)
        # the host's sound speed scales the depth that it shows: 8 m * 1480 / 1500
        middle = min(soundings(ping), key=lambda p: abs(p["angle"]))
        self.assertAlmostEqual(middle["depth"], 8.0 * 1480 / 1500, delta=0.04)

    def test_a_wrong_sound_speed_makes_the_bottom_smile_or_frown(self):
        """By its manual, and by Snell's law: a flat array that believes in c' looks where sin x = sin(told) c / c'."""
        host, _ = self.start(options=", range: 40")
        self.pings(host, 1)
        for believed in (1560.0, 1440.0):
            host.send_commands({"SEW0": math.radians(110), "SVL0": believed, "SVU0": 1})
            ping = self.pings(host, 1, lambda ping: abs(ping.header["sound_speed"] - believed) < 1e-3)[0]
            self.assertAlmostEqual(ping.angles[-1], math.radians(55 * 255 / 256), places=4)
            for p in soundings(ping):
                looks = math.asin(math.sin(p["angle"]) * 1500 / believed)
                depth = 8.0 * believed / 1500 * math.cos(p["angle"]) / math.cos(looks)
                self.assertLess(abs(p["depth"] - depth) / depth, 0.005, f"{believed} m/s at {math.degrees(p['angle']):.1f}")

    def test_gates_hide_the_bottom(self):
        host, _ = self.start(options=", range: 40")
        self.pings(host, 1)
        host.send_commands({"DGA0": 12.0, "DGB0": 18.0, "DGO0": 1})
        self.pings(host, 1, lambda ping: not any(p["quality"] & 0xC for p in soundings(ping)))


class Image(R2SonicCase):
    def test_image_shows_the_floor_at_its_range(self):
        host, _ = self.start(options=", range: 30, image_height: 280")
        events = self.collect(host, lambda events: sum(e["event"] == "image" for e in events) >= 2)
        image = [e["image"] for e in events if e["event"] == "image"][-1]
        beams, bins = image.shape
        self.assertEqual(beams, 256)
        metres = image.bin_metres()
        angles = image.header["angles"]
        middle = min(range(beams), key=lambda b: abs(angles[b]))
        strongest = max(range(bins), key=image.rows[middle].__getitem__)
        self.assertAlmostEqual((strongest + 0.5) * metres, 8.0, delta=1.5 * metres)
        above = max(image.rows[middle][: strongest - 2])
        self.assertLess(above, image.rows[middle][strongest] / 5, "above the floor there is noise only")


class Discovery(R2SonicCase):
    def test_status_discovery_and_configuration(self):
        host, _ = self.start()
        events = self.collect(
            host, lambda events: {"R2DS", "STH0", "STS0"} <= {e["event"] for e in events}
        )
        serials = {e["serial"] for e in events if e["event"] == "R2DS"}
        self.assertEqual(serials, {"100017", "100117"})
        found = {i["serial"]: i for i in host.discover(("127.255.255.255", 53810), 2.0)}
        self.assertEqual(set(found), {"100017", "100117"})
        host.configure("100017", 4711, ("127.255.255.255", 53810))
        self.collect(host, lambda events: any(e.get("config_id") == 4711 for e in events))


if __name__ == "__main__":
    unittest.main()
