"""Several pictures of one sonar in Debian's Chromium: of two frequencies, or of several messages, each with its own lines."""

import re
import socket
import struct
import threading
import unittest

from page_case import PageCase

from ports import free_port

FLAT = """
scene: {scenes}/flat.glb
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -12]}}
devices:
  - {name: sonar, model: %s, endpoints: [%s], options: {%s}}
"""
SET, RANGE, LOW, HIGH = 0, 128, 20, 21
LIT = """() => { const dots = [...document.querySelectorAll('.kinds:not([hidden]) canvas:not([hidden])')][0].getContext('2d');
  const lit = []; for (let y = 0; y < 360; y++) { const row = dots.getImageData(100, y, 100, 1).data;
  lit.push(row.some((value, i) => i % 4 === 0 && value > 60)); } return lit.filter(Boolean).length; }"""


def edgetech_range(subsystem, metres):
    return struct.pack("<HBBHBBBBHII", 0x1601, 13, 0, RANGE, SET, subsystem, 0, 0, 0, 4, 1000 * metres)


def drain(one):
    def read():
        try:
            while one.recv(65536):
                pass
        except OSError:
            pass

    threading.Thread(target=read, daemon=True).start()


class Kinds(PageCase):
    def options(self, page):
        return page.locator("[data-device=sonar] h2 select option").all_inner_texts()

    def test_two_frequencies_of_different_ranges_each_have_their_waterfall(self):
        commands, data = free_port(), free_port()
        page = self.run_and_open(FLAT % ("edgetech-2205", f'"tcp-listen://127.0.0.1:{commands}", "tcp-listen://127.0.0.1:{data}"', "start: both"))
        host = socket.create_connection(("127.0.0.1", commands), timeout=20)
        reader = socket.create_connection(("127.0.0.1", data), timeout=20)
        self.addCleanup(host.close)
        self.addCleanup(reader.close)
        host.sendall(edgetech_range(LOW, 60) + edgetech_range(HIGH, 25))
        drain(reader)
        page.locator("[data-device=sonar] option", has_text=re.compile(r"heard: \d+ kHz")).nth(1).wait_for(state="attached")
        page.locator("[data-device=sonar] option", has_text="said: SonarData low").wait_for(state="attached")
        options = self.options(page)
        heard = [one for one in options if one.startswith("heard: ")]
        self.assertEqual(len(heard), 2, options)
        self.assertIn("said: SonarData high", options)
        layer = page.locator("[data-device=sonar] h2 select")
        facts = page.locator("[data-device=sonar] .facts")
        for label, far in [*zip(sorted(heard, key=lambda one: int(re.search(r"\d+", one)[0])), (60, 25)),
                           ("said: SonarData low", 60), ("said: SonarData high", 25)]:
            with self.subTest(label):
                layer.select_option(label=label)
                facts.filter(has_text=re.compile(rf"0 to {far}(.\d+)? m|0 to {far - 1}.\d+ m")).wait_for()
                self.assertEqual(layer.locator("option:checked").inner_text(), label)
                page.wait_for_function("() => (" + LIT + ")() > 12")  # lines of earlier pings, at their level
                for _ in range(20):  # it stays with the one that was chosen
                    self.assertRegex(facts.inner_text(), rf"0 to ({far}(.\d+)?|{far - 1}.\d+) m")
        self.assertEqual(self.faults, [])

    def test_a_driver_that_leaves_one_message_for_another_is_followed(self):
        """A Ping360 that is asked for pings, and then scans by itself, says its echoes in another message."""
        page = self.start()
        self.ping()
        self.ping(angle=201)
        layer = page.locator("[data-device=head] h2 select")
        layer.select_option("said")
        page.locator("[data-device=head] .facts", has_text="DeviceData").wait_for()
        import ping360_host
        with ping360_host.Host("127.0.0.1", self.udp) as host:
            host.scan(ping360_host.Settings().for_range(4, 1500))
            page.locator("[data-device=head] .facts", has_text="AutoDeviceData").wait_for()
        self.assertEqual(layer.locator("option:checked").inner_text(), "said: AutoDeviceData")

    def test_another_frequency_takes_the_place_of_the_one_before(self):
        page = self.start()
        facts = page.locator("[data-device=head] .facts")
        self.ping()
        facts.filter(has_text="750 kHz").wait_for()
        import ping360_host
        with ping360_host.Host("127.0.0.1", self.udp) as host:
            host.ping(200, ping360_host.Settings(frequency=800).for_range(8, 1500))
        facts.filter(has_text="800 kHz").wait_for()
        self.assertIn("heard: 750 kHz", page.locator("[data-device=head] h2 select option").all_inner_texts())

    def test_an_r2sonics_image_water_column_truepix_and_snippets(self):
        head, data = free_port(16), free_port(8)
        receivers = []
        for port in range(data, data + 8):
            one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            one.bind(("127.0.0.1", port))
            self.addCleanup(one.close)
            receivers.append(one)
        for one in receivers:
            drain(one)
        scenario = FLAT.replace("model: %s,", "model: %s, mount: {rpy_deg: [0, 90, 0]},")
        page = self.run_and_open(scenario % ("r2sonic-2024", f'"udp-listen://127.0.0.1:{head}", "udp://127.0.0.1:{data}"',
                                             "ping_rate: 5, range: 20, image_height: 400, water_column: magnitude, truepix: direction, snippets: true"))
        layer = page.locator("[data-device=sonar] h2 select")
        facts = page.locator("[data-device=sonar] .facts")
        for name, kind in (("BTH0", "profile"), ("AID0", "fan"), ("WCD0", "fan"), ("TPX0", "sidescan"), ("SNI0", "fan")):
            with self.subTest(name):
                page.locator("[data-device=sonar] option", has_text="said: " + name).wait_for(state="attached")
                layer.select_option(label="said: " + name)
                facts.filter(has_text=re.compile(rf"{kind} . {name} ")).wait_for()
        self.assertEqual(self.faults, [])

    def test_the_cells_of_a_doppler_log_stand_side_by_side(self):
        """The bottom is in one cell of each beam, and says so under the pointer."""
        port = free_port()
        page = self.run_and_open(FLAT % ("dvl-pathfinder", f'"tcp-listen://127.0.0.1:{port}"',
                                         "speed_of_sound: 1500, baud: 0, profile_pings: 1, profile_cells: 20, cell_size: 50"))
        reader = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(reader.close)
        drain(reader)
        page.locator("[data-device=sonar] option", has_text="said: Ensemble intensity").wait_for(state="attached")
        page.locator("[data-device=sonar] h2 select").select_option(label="said: Ensemble intensity")
        page.locator("[data-device=sonar] .facts", has_text=re.compile("echogram . Ensemble intensity .* 4 beams")).wait_for()
        page.locator("#pause").click()
        for beam in range(4):
            newest = (beam + 1) * 120 - 1
            levels = [re.match(r"([\d.]+) m, beam (\d), (\d+) counts", self.read_at(page, newest, row, "sonar")) for row in range(9, 360, 18)]
            self.assertEqual({one[2] for one in levels}, {str(beam + 1)})
            self.assertAlmostEqual(float(max(levels, key=lambda one: int(one[3]))[1]), 8, delta=0.5)
        self.assertEqual(self.faults, [])


if __name__ == "__main__":
    unittest.main()
