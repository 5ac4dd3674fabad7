"""The page of a run in Debian's Chromium, driven by playwright: what a person sees and can do there."""

import math
import re
import socket
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from page_case import NEWEST, TANK, PageCase

import blping_host
from ports import free_port
from program import PROGRAM, Emulator

WALL = "wall"


class Page(PageCase):
    def test_the_wall_is_at_its_place_in_all_three_layers(self):
        page = self.start()
        card = page.locator("[data-device=head]")
        self.ping()
        self.ping(angle=201)  # a head that turns has a full circle
        card.locator(".facts", has_text="circle").wait_for()

        def heard(metres):
            text = self.read_at(page, 240, 180 - metres / 8 * 172)
            self.assertAlmostEqual(float(re.match(r"([\d.]+) m", text)[1]), metres, delta=0.1)
            return float(re.search(r"([\d.-]+) dB", text)[1]), text

        wall = max((heard(metres / 20) for metres in range(115, 126)), key=lambda found: found[0])
        self.assertGreater(wall[0], heard(4.5)[0] + 10)
        self.assertIn(WALL, wall[1].lower())
        card.locator("select").select_option("said")
        card.locator(".facts", has_text=re.compile("circle . DeviceData 2 ")).wait_for()  # both lines

        def said(metres):
            return int(re.search(r"(\d+) counts", self.read_at(page, 240, 180 - metres / 8 * 172))[1])

        # where a message tells no speed of sound, ranges are those at 1500 m/s, as the water is here
        self.assertGreater(max(said(metres / 20) for metres in range(115, 126)), said(4.5) + 30)
        card.locator("select").select_option("true")
        colours = page.evaluate(
            """() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
                 const dot = document.querySelector('[data-device=head] canvas').getContext('2d');
                 done([6.05, 1.2].map((metres) => dot.getImageData(240, 180 - metres / 8 * 172, 1, 1).data[0])); })))"""
        )
        self.assertGreater(colours[0], 0, "the wall has an object's colour")
        self.assertEqual(colours[1], 0, "the water before wall and floor has none")
        self.assertEqual(self.faults, [])

    def test_the_ruler_tells_how_far_the_walls_are_apart(self):
        """Walls are 6 m ahead and astern and 4 m to either side; each is found by its level under the pointer."""
        page = self.start()
        for angle in (0, 100, 200, 300):  # astern, port, ahead, starboard
            self.ping(angle=angle)
        page.locator("[data-device=head] .facts", has_text="ping 4 ").wait_for()
        dot = 8 / 172  # m; a bin is shorter

        def wall(right, ahead, metres):
            """Dots of the loudest level within 0.3 m of a wall."""
            places = [(240 + right * r / dot, 180 - ahead * r / dot) for r in (metres + 0.02 * i for i in range(-15, 16))]
            levels = [re.search(r"([\d.-]+) dB", self.read_at(page, x - 0.5, y - 0.5)) for x, y in places]
            return max(zip(places, levels), key=lambda one: float(one[1][1]) if one[1] else -math.inf)[0]

        ahead, astern, port, starboard = wall(0, 1, 6), wall(0, -1, 6), wall(-1, 0, 4), wall(1, 0, 4)
        self.assertAlmostEqual(self.drag(page, "head", ahead, astern), 12, delta=2 * dot)
        self.assertAlmostEqual(self.drag(page, "head", port, starboard), 8, delta=2 * dot)
        self.assertAlmostEqual(self.drag(page, "head", ahead, starboard), math.hypot(6, 4), delta=2 * dot)

    def test_the_ruler_of_an_echogram_begins_where_its_ranges_do(self):
        """From its first range, 1.5 m, to the floor at 2 m."""
        page = self.start()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            for number, payload in ((1003, b"\0"), (1001, struct.pack("<II", 1500, 2000)), (1400, struct.pack("<H", 1300))):
                host.sendto(blping_host.frame(number, payload), ("127.0.0.1", self.down))  # by hand, 1.5 to 3.5 m, profiles
            page.locator("[data-device=down] .facts", has_text="1.5 to 3.5 m").wait_for()
            self.read_at(page, NEWEST, 90, "down")
            page.locator("[data-device=down] .read", has_text=" dB").wait_for()  # a line is drawn there
        page.locator("#pause").click()  # the picture stands

        def read(row):
            """Range and level that the last line has in a row; nothing lies lower."""
            found = re.match(r"([\d.]+) m.*?, ([\d.-]+) dB", self.read_at(page, NEWEST, row, "down"))
            return [float(word) for word in found.groups()] if found else [0, -math.inf]

        row = max(range(60, 121, 2), key=lambda row: read(row)[1])
        metres = read(row)[0]
        self.assertAlmostEqual(metres, 2, delta=0.05)
        self.assertAlmostEqual(self.drag(page, "down", (100, 0), (100, row + 0.5)), metres - 1.5, delta=0.02)

    def test_a_drivers_range_changes_the_card(self):
        page = self.start()
        card = page.locator("[data-device=head] .facts")
        self.ping(metres=8)
        page.locator("[data-device=head] .facts", has_text=re.compile(r"to (7\.9\d*|8(\.\d+)?) m")).wait_for()
        self.ping(metres=4)
        page.locator("[data-device=head] .facts", has_text=re.compile(r"to (3\.9\d*|4(\.\d+)?) m")).wait_for()
        self.assertIn("1 beam", card.inner_text())

    def test_a_button_makes_a_fault_and_the_counters_tell(self):
        page = self.start()
        page.locator("[data-fault=silence]").click()
        page.locator("#fault-answer", has_text="is on").wait_for()
        with self.assertRaises(IndexError):  # the head says nothing
            self.ping()
        page.locator("#devices td", has_text="silence").wait_for()
        page.locator("#fault-clear").click()
        page.locator("#fault-answer", has_text="ended").wait_for()
        self.ping()

    def test_the_page_goes_on_with_the_next_run_at_its_port(self):
        place = f"127.0.0.1:{free_port()}"
        page = self.start("--view-at", place)
        self.ping()
        page.locator("[data-device=head] .facts", has_text="ping 1").wait_for()
        self.emulator.stop()
        page.locator("#state", has_text="has ended").wait_for()
        ins = f'  - {{name: ins, model: nmea-ins, endpoints: ["udp://127.0.0.1:{free_port()}"]}}\n'
        with Emulator(TANK % (self.udp, free_port()) + ins, "--view", "--view-at", place):
            page.locator("#state.live").wait_for()
            page.locator("[data-device=head] .read", has_text="no ping yet").wait_for()
            page.locator("[data-device=ins] .read", has_text="no sonar").wait_for()
            self.awake()
            self.ping(metres=4)
            page.locator("[data-device=head] .facts", has_text=re.compile(r"to (3\.9\d*|4(\.\d+)?) m")).wait_for()

    def test_the_page_of_a_run_that_is_gone_says_that_another_is_there(self):
        place = f"127.0.0.1:{free_port()}"
        with Emulator(TANK % (free_port(), free_port()), "--view", "--view-at", place):
            other = self.browser.new_page()
            self.addCleanup(other.close)
            other.goto(f"http://{place}/#{'0' * 32}")
            other.locator("#state", has_text="open the link that it has printed").wait_for()

    def test_the_last_minute_can_be_seen_again(self):
        page = self.start()
        facts = page.locator("[data-device=head] .facts")
        self.ping(metres=8)
        page.locator("[data-device=head] .facts", has_text="ping 1 ").wait_for()
        self.ping(metres=4)
        page.locator("[data-device=head] .facts", has_text="ping 2 ").wait_for()
        page.locator("#pause").click()
        self.ping(metres=2)  # is not shown
        page.evaluate("""() => { const time = document.getElementById('time'); const [a, b] = [Number(time.min), Number(time.max)];
                         for (let i = 0; i <= 100; i++) { time.value = String(a + (b - a) * i / 100);
                           time.dispatchEvent(new Event('input')); if (document.querySelector('#wire').textContent.includes('DeviceData')) break; } }""")
        page.locator("[data-device=head] .facts", has_text="ping 1 ").wait_for()
        page.locator("#pause").click()
        self.ping(metres=4)
        page.locator("[data-device=head] .facts", has_text="ping 4 ").wait_for()
        self.assertIn("1 beam", facts.inner_text())
        self.assertEqual(self.faults, [])

    def test_what_the_driver_has_set_is_told_and_pictures_and_recordings_are_files(self):
        with tempfile.TemporaryDirectory() as folder:
            page = self.start("--view-record", folder)
            page.locator("#record").click()
            page.locator("#recorded", has_text=folder).wait_for()
            self.ping(metres=8)
            self.ping(metres=4)
            page.locator("#settings td b", has_text="sample_period").wait_for()  # what changed
            page.locator("#record").click()
            page.locator("#recorded", has_text="packets in").wait_for()
            captured = subprocess.run([PROGRAM, "inspect", *map(str, Path(folder).glob("*.pcapng"))], capture_output=True,
                                      text=True, check=True).stdout
            self.assertIn("DeviceData", captured)
            with page.expect_download() as download:
                page.locator("[data-device=head] button", has_text="PNG").click()
            self.assertEqual(Path(download.value.path()).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_a_narrow_page_has_no_scroll_bar_across(self):
        page = self.start(width=390)
        self.ping()
        page.locator("[data-device=head] .facts", has_text="ping 1").wait_for()
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)


if __name__ == "__main__":
    unittest.main()
