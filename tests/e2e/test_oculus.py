"""The Oculus sonars end to end over UDP and TCP on loopback, against a host written apart from the C++."""

import math
import socket
import statistics
import sys
import time
import unittest
from pathlib import Path

from ports import free_port
from program import ROOT, Emulator

import oculus_wire as wire
from oculus_host import Host

sys.path.insert(0, str(ROOT / "tools"))
from scenes import manifold, seabed  # noqa: E402

SCENARIO = """
scene: {scenes}/%(scene)s.glb
water: {temperature: 8, salinity: 35, ph: 8, sound_speed: 1482.5}
vehicle: {pose: {position: %(position)s}}
devices:
  - name: oculus
    model: %(model)s
    mount: {rpy_deg: [0, %(tilt)g, 0]}
    endpoints: ["tcp-listen://127.0.0.1:%(data)d", "udp://127.255.255.255:%(status)d"]
    options: {temperature: 8%(options)s}
"""
C = 1482.5
SEA = {"sound_speed": C, "mode": wire.LOW}


CLOCK = 281.25e6  # Hz, which each carrier is a whole fraction of, as in the recording


class OculusCase(unittest.TestCase):
    def start(self, scene, position, tilt=0, model="oculus-m750d", options=""):
        data, status = free_port(), free_port()
        host = Host(status, data)
        self.addCleanup(host.close)
        self.emulator = Emulator(
            SCENARIO
            % {
                "scene": scene,
                "position": position,
                "tilt": tilt,
                "model": model,
                "data": data,
                "status": status,
                "options": options,
            }
        )
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()
        host.wait_status()
        host.connect()
        return host

    def first_message(self, host):
        """Header of what a host that connects gets first, once the sonar has seen that the last one has gone."""
        end = time.monotonic() + 10
        while True:
            host.connect()
            try:
                return host.message(3)[0]
            except ConnectionError:
                self.assertLess(time.monotonic(), end)
                host.stream.close()
                host.wait_status(3)

    def picture(self, host, **settings):
        """The first ping with these settings, without faults."""
        host.fire(**settings)
        wanted = {name: value for name, value in settings.items() if name in ("mode", "range", "flags")}
        ping = host.ping(20, lambda ping: all(ping.settings[name] == value for name, value in wanted.items()))
        self.assertEqual(host.faults, [])
        return ping

    def front(self, ping, degrees, beyond, share=0.3, beside=0):
        """Metres to where the beam at a bearing first has `share` of the strongest that it has `beyond` a range; in the
        mean of so many beams on either side."""
        beams = range(ping.beam(degrees) - beside, ping.beam(degrees) + beside + 1)
        column = [statistics.mean(levels) for levels in zip(*(ping.column(beam) for beam in beams))]
        rows = [row for row in range(ping.ranges) if ping.metres(row) > beyond]
        strongest = max(column[row] for row in rows)
        return next(ping.metres(row) for row in rows if column[row] > share * strongest)


class Manifold(OculusCase):
    """The scene of demo.yaml: the sonar at (-17.5, 0, -3.1) looks 20 deg down at a manifold at the origin."""

    EYE, TILT, YAW = (-17.5, 0.0, -3.1), math.radians(20), 0.5

    def seen(self, x, y, z):
        """(bearing in degrees, range) of a point of the manifold, in its own frame."""
        ground = min(seabed.height(a, b) for a in (-3, 0, 3) for b in (-2, 0, 2))
        c, s = math.cos(self.YAW), math.sin(self.YAW)
        dx, dy, dz = c * x - s * y - self.EYE[0], s * x + c * y - self.EYE[1], ground + z - self.EYE[2]
        ahead = dx * math.cos(self.TILT) - dz * math.sin(self.TILT)
        return math.degrees(math.atan2(-dy, ahead)), math.sqrt(dx * dx + dy * dy + dz * dz)

    def level(self, ping, degrees, near, far):
        """Mean sample between two ranges over five beams."""
        beam = ping.beam(degrees)
        rows = [r for r in range(ping.ranges) if near < ping.metres(r) < far]
        return statistics.mean(s for r in rows for s in ping.row(r)[beam - 2 : beam + 3])

    def test_manifold_its_shadow_and_the_seabed_are_where_they_are(self):
        host = self.start("manifold", list(self.EYE), 20)
        flags = wire.METRES | wire.SIMPLE | wire.BITS16 | wire.BEAMS512
        ping = self.picture(host, **SEA, range=40.0, gain=0.0, gamma=255, flags=flags, version=2)
        # The upper edge of the panel at the near end of the manifold.
        bearing, distance = self.seen(-manifold.LENGTH / 2 - 0.09, 0, 2.15)
        self.assertAlmostEqual(self.front(ping, bearing, 15), distance, delta=0.15)
        far_side = self.seen(manifold.LENGTH / 2, 0, 1)[1]
        on_sand = self.level(ping, -25, 18, 26)
        self.assertGreater(self.level(ping, bearing, distance, far_side), 1.7 * on_sand)
        # Behind its middle no sound reaches the sand.
        shadow = self.level(ping, 0, far_side + 1, far_side + 5)
        self.assertLess(shadow, 0.4 * self.level(ping, 24, far_side + 1, far_side + 5))
        # 7 m above the sand nothing is nearer than that; ahead the fan's lower edge meets it at 14 m.
        self.assertLess(self.level(ping, -25, 0.5, 6.3), on_sand / 5)

    def test_every_form_of_the_image_shows_the_same_picture(self):
        host = self.start("manifold", list(self.EYE), 20)
        bearing, distance = self.seen(-manifold.LENGTH / 2 - 0.09, 0, 2.15)
        forms = [(1, 0, 0, 1), (1, wire.BITS16, 0, 2), (2, wire.GAIN_WORDS, 0, 1), (2, wire.BITS16, wire.BITS32, 4)]
        for version, flag, extra, size in forms:
            flags = wire.METRES | wire.SIMPLE | flag
            same = {"range": 30.0, "gain": 0.0, "gamma": 255, "flags": flags}
            ping = self.picture(host, **SEA, **same, ext_flags=extra, version=version)
            self.assertEqual((ping.version, ping.beams, ping.sample_bytes), (version, 256, size))
            self.assertAlmostEqual(self.front(ping, bearing, 15), distance, delta=0.15)


class Tank(OculusCase):
    """12 x 8 m: walls 6 m ahead and 4 m to either side; a post to starboard."""

    def test_walls_and_post_stand_where_they_stand(self):
        host = self.start("tank", [-1, 0, -2])
        ping = self.picture(host, **SEA, range=9.0, gain=20.0, flags=wire.METRES | wire.SIMPLE | wire.BEAMS512)
        self.assertEqual((ping.bearings[0], ping.bearings[-1]), (-65, 65))
        for degrees in (-62, 62):
            # In a single beam speckle may leave the wall less than what side lobes bring of its nearest part.
            errors = []
            for beam in range(ping.beam(degrees) - 4, ping.beam(degrees) + 5):
                truth = 4 / math.sin(math.radians(abs(ping.bearings[beam])))
                strongest = max(range(ping.ranges), key=ping.column(beam).__getitem__)
                errors.append(ping.metres(strongest) - truth)
            self.assertAlmostEqual(statistics.median(errors), 0, delta=0.06, msg=errors)
        # The post at (1.2, -2.6), 0.15 m thick: 49.8 deg to starboard, that is at a positive bearing.
        bearing, distance = math.degrees(math.atan2(2.6, 2.2)), math.hypot(2.6, 2.2) - 0.15
        before_wall = [r for r in range(ping.ranges) if 2 < ping.metres(r) < 3.9]
        strongest = max(before_wall, key=lambda r: ping.row(r)[ping.beam(bearing)])
        self.assertAlmostEqual(ping.metres(strongest), distance, delta=0.06)
        self.assertGreater(ping.row(strongest)[ping.beam(bearing)], 3 * ping.row(strongest)[ping.beam(-bearing)])

    def test_what_the_host_sets_changes_the_next_ping_and_is_echoed(self):
        host = self.start("tank", [0, 0, -2])
        flags = wire.METRES | wire.SIMPLE | wire.BITS16
        same = {"range": 8.0, "gamma": 255, "flags": flags}
        wall = self.front(self.picture(host, **SEA, **same, gain=0.0), 0, 5)
        self.assertAlmostEqual(wall, 6, delta=0.06)
        # A wrong speed of sound moves the wall.
        host.fire(mode=wire.LOW, sound_speed=1600.0, gain=0.0, **same)
        slow = host.ping(20, lambda ping: ping.sound_speed == 1600.0)
        self.assertEqual(slow.settings["sound_speed"], 1600.0)
        self.assertAlmostEqual(self.front(slow, 0, 5), 6 * 1600 / C, delta=0.07)
        # Without one, temperature and salinity give it: sea water of 8 degC has 1481 m/s and more.
        host.fire(mode=wire.LOW, salinity=35.0, gain=0.0, **same)
        own = host.ping(20, lambda ping: ping.settings["salinity"] == 35.0)
        self.assertAlmostEqual(own.sound_speed, 1482, delta=1.5)
        # High frequency: another sector and carrier; the gain comes back as 40 + 0.6 g.
        high = self.picture(host, sound_speed=C, mode=wire.HIGH, gain=10.0, **same)
        self.assertEqual((high.bearings[0], high.bearings[-1], high.frequency), (-35, 35, CLOCK / 234))
        self.assertAlmostEqual(high.settings["gain"], 46.0, delta=1e-9)
        # Its noise is a quarter of full scale, as in recordings, and the wall is clipped.
        self.assertAlmostEqual(self.front(high, 0, 5, share=0.6, beside=10), 6, delta=0.06)
        # Range in percent, and gain.
        half = self.picture(host, **SEA, range=5.0, gain=10.0, flags=wire.SIMPLE)
        self.assertAlmostEqual(half.ranges * half.resolution, 6.0, delta=0.02)
        host.fire(**SEA, **same, gain=70.0)
        loud = host.ping(20, lambda ping: ping.settings["gain"] == 70.0)
        host.fire(**SEA, **same, gain=0.0)
        quiet = host.ping(20, lambda ping: ping.settings["gain"] == 0.0)
        water = lambda ping: statistics.mean(ping.column(ping.beam(0))[100:400])
        self.assertAlmostEqual(20 * math.log10(water(loud) / water(quiet)), 0.7 * 30, delta=1.5)
        self.assertEqual(host.faults, [])


class Timing(OculusCase):
    def period(self, host, pings=8, **settings):
        """Seconds per ping, by the sonar's own clock in the results; one that a busy machine delays does not count. Each time
        another range: the rate in the echo is useless, as a real one's.
        """
        host.fire(version=2, flags=wire.METRES | wire.SIMPLE, **settings)
        same = lambda ping: ping.settings["range"] == settings["range"]
        host.ping(20, same)
        begin, first = time.monotonic(), host.ping(20, same)
        seen = [first] + [host.ping(20, same) for _ in range(pings)]
        own = [after.start - before.start for before, after in zip(seen, seen[1:])]
        self.assertAlmostEqual(time.monotonic() - begin, sum(own), delta=0.3 * sum(own) + 0.1)
        return statistics.median(own)

    def test_rate_and_range_set_the_period(self):
        host = self.start("flat", [0, 0, -12])
        self.assertAlmostEqual(self.period(host, **SEA, range=5.0, rate=wire.RATES[10]), 0.1, delta=0.01)
        self.assertAlmostEqual(self.period(host, **SEA, range=6.0, rate=wire.RATES[5]), 0.2, delta=0.02)
        self.assertAlmostEqual(self.period(host, **SEA, range=120.0, rate=wire.RATES[40]), 240 / C, delta=0.02)
        self.assertEqual(host.faults, [])

    def test_a_fire_message_that_does_not_tell_its_size_is_obeyed(self):
        host = self.start("flat", [0, 0, -12])
        for version, reach in ((1, 5.0), (2, 7.0)):
            host.fire(**SEA, version=version, range=reach, sized=False)
            ping = host.ping(10, lambda ping: ping.settings["range"] == reach)
            self.assertEqual(ping.version, version)
        self.assertEqual(host.faults, [])

    def test_standby_sends_dummies_until_the_next_fire(self):
        host = self.start("flat", [0, 0, -12])
        host.dummy(1.5)
        host.fire(**SEA, range=5.0)
        host.ping(5)
        host.fire(**SEA, range=5.0, rate=wire.RATES[0])
        host.dummy(5)
        begin = time.monotonic()
        host.dummy(5)
        self.assertAlmostEqual(time.monotonic() - begin, 1.0, delta=0.3)
        self.assertEqual(host.wait_status(5, lambda status: status["client"] != "0.0.0.0")["client"], "127.0.0.1")

    def test_a_second_host_is_turned_away_and_the_next_one_finds_standby(self):
        host = self.start("flat", [0, 0, -12])
        host.fire(**SEA, range=5.0)
        host.ping(5)
        with socket.create_connection(("127.0.0.1", host.data_port), timeout=5) as second:
            self.assertEqual(second.recv(100), b"", "closed at once")
        host.ping(5)
        host.stream.close()
        self.assertEqual(self.first_message(host)["id"], wire.DUMMY)


class Stalled(OculusCase):
    """A host that fires, and then does not read."""

    LARGE = wire.METRES | wire.SIMPLE | wire.BITS16 | wire.BEAMS512  # 1 MB each at 10 Hz

    def stall(self, options=""):
        host = self.start("flat", [0, 0, -12], options=options)
        host.fire(**SEA, range=30.0, flags=self.LARGE)
        host.ping(5)
        return host

    def memory(self):
        status = Path(f"/proc/{self.emulator.process.pid}/status").read_text()
        return int(next(line for line in status.splitlines() if line.startswith("RssAnon")).split()[1]) << 10

    def test_the_status_goes_on_and_pings_that_are_not_read_are_dropped(self):
        host = self.stall()
        for _ in range(4):
            host.wait_status(3)
        before = self.memory()
        begin = time.monotonic()
        for _ in range(5):
            host.wait_status(3)
        self.assertAlmostEqual(time.monotonic() - begin, 5, delta=1.2)
        self.assertLess(self.memory() - before, 15e6, "50 pings are 50 MB")
        numbers = [host.last_ping.ping] + [wire.read_result(host.message()[1])[0].ping for _ in range(30)]
        gaps = [after - before for before, after in zip(numbers, numbers[1:])]
        old = gaps.index(max(gaps))
        self.assertGreater(max(gaps), 50, "90 pings were not read")
        self.assertLess(old, 8, "what waited for it in the emulator and in the system's hands")
        self.assertLess(sum(gaps[old + 4 :]), 2 * len(gaps[old + 4 :]), "it reads in time again")
        self.assertRegex(self.emulator.stop()[1], r"[1-9]\d+ messages dropped, because the driver did not read them")

    def test_when_it_leaves_the_next_one_gets_its_own_pings_only(self):
        host = self.stall()
        for _ in range(3):
            host.wait_status(3)
        host.stream.close()
        self.assertEqual(self.first_message(host)["id"], wire.DUMMY)
        host.fire(**SEA, range=5.0)
        pings = [host.ping(5) for _ in range(5)]
        self.assertEqual({ping.settings["range"] for ping in pings}, {5.0})
        self.assertEqual(host.faults, [])

    def test_it_is_hung_up_on_where_silence_is_limited(self):
        host = self.stall(options=", silence_limit: 1.5")
        stalled = host.stream
        self.addCleanup(stalled.close)
        host.wait_status(5, lambda status: status["client"] == "0.0.0.0")
        self.assertEqual(self.first_message(host)["id"], wire.DUMMY)


class Series(OculusCase):
    def test_each_model_pings_in_both_modes(self):
        sectors = {
            "oculus-m370s": ((375e3, 65), (375e3, 65)),
            "oculus-m1200d": ((CLOCK / 234, 65), (CLOCK / 134, 30)),
            "oculus-m3000d": ((CLOCK / 234, 65), (CLOCK / 94, 20)),
        }
        for model, modes in sectors.items():
            host = self.start("tank", [0, 0, -2], model=model)
            for mode, (frequency, edge) in zip((wire.LOW, wire.HIGH), modes):
                with self.subTest(model, mode=mode):
                    ping = self.picture(host, mode=mode, range=4.5, sound_speed=C, flags=wire.METRES | wire.SIMPLE)
                    self.assertEqual((ping.frequency, ping.bearings[0], ping.bearings[-1]), (frequency, -edge, edge))
                    self.assertAlmostEqual(ping.ranges * ping.resolution, 4.5, delta=ping.resolution)


if __name__ == "__main__":
    unittest.main()
