"""What the page offers beside its pictures, in Debian's Chromium: palette and scale, the scene in 3D, times and loads, and what it
keeps to itself where the run does not let it ask."""

import os
import re
import struct
import tempfile
import time
import tty
import unittest
import zlib
from pathlib import Path

from page_case import TANK, PageCase

import ping360_host
from ports import free_port

MOVING = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {trajectory: way.csv}
devices:
  - {name: fan, model: r2sonic-2024, endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"], options: {range: 10, ping_rate: 5}}
  - {name: bottom, model: nmea-echosounder, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["pty://{folder}/bottom"]}
"""
WAY = "t,x,y,z,qw,qx,qy,qz\n0,-2,0,-2,1,0,0,0\n30,2,0,-2,1,0,0,0\n"
LATE = """
scene: {scenes}/manifold.glb
seed: 1
water: {temperature: 8, salinity: 35, ph: 8}
vehicle: {pose: {position: [-8, 0, -5]}}
devices:
  - {name: busy, model: sonar-3d-15, mount: {rpy_deg: [0, 20, 0]}, endpoints: ["tcp-listen://127.0.0.1:%d"], options: {acoustics: true}}
"""


def dots(png):
    """Rows of (red, green, blue) of a PNG of 8 bits without interlacing, as browsers write them."""
    width, height, depth, kind = struct.unpack_from(">IIBB", png, 16)
    assert depth == 8 and kind in (2, 6), (depth, kind)
    size = 3 if kind == 2 else 4
    packed, at = b"", 8
    while at < len(png):
        length, name = struct.unpack_from(">I4s", png, at)
        packed += png[at + 8: at + 8 + length] if name == b"IDAT" else b""
        at += length + 12
    raw, before, rows = zlib.decompress(packed), bytearray(width * size), []
    for y in range(height):
        start = y * (width * size + 1)
        rule, line = raw[start], bytearray(raw[start + 1: start + 1 + width * size])
        for i in range(len(line)):
            left, up, corner = (line[i - size] if i >= size else 0), before[i], (before[i - size] if i >= size else 0)
            if rule == 4:
                p = left + up - corner
                guess = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            else:
                guess = (0, left, up, (left + up) // 2)[rule]
            line[i] = (line[i] + guess) & 255
        rows.append([tuple(line[x: x + 3]) for x in range(0, len(line), size)])
        before = line
    return rows


def near(dot, colour):
    return all(abs(a - b) < 12 for a, b in zip(dot, colour))


class Tools(PageCase):
    def colour_at(self, page, metres):
        """Of the head's picture, straight ahead, once it is drawn anew."""
        return page.evaluate(
            """(y) => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() =>
                 done([...document.querySelector('[data-device=head] canvas').getContext('2d').getImageData(240, y, 1, 1).data].slice(0, 3)))))""",
            180 - metres / 8 * 172)

    def test_palette_and_range_of_levels_change_colours_and_no_level(self):
        page = self.start()
        self.ping()
        self.ping(angle=201)
        page.locator("[data-device=head] .facts", has_text="circle").wait_for()
        page.locator("#pause").click()
        levels = {}
        for metres in [5.75 + 0.05 * i for i in range(10)]:
            text = self.read_at(page, 240, 180 - metres / 8 * 172)
            if found := re.search(r"([\d.-]+) dB re 1 uPa", text):
                levels[metres] = float(found[1])
        wall = max(levels, key=levels.get)
        read = self.read_at(page, 240, 180 - wall / 8 * 172)
        copper = self.colour_at(page, wall)
        self.assertGreater(copper[0], copper[2] + 20, "copper is brighter in red than in blue, or white")
        page.locator("#palette").select_option("grey")
        grey = self.colour_at(page, wall)
        self.assertEqual(len(set(grey)), 1, grey)
        page.locator("#palette").select_option("viridis")
        self.assertNotIn(self.colour_at(page, wall), (grey, copper))
        page.locator("#palette").select_option("grey")
        page.locator("#span").fill("120")
        page.locator("#span-value", has_text="120 dB").wait_for()
        self.assertGreater(self.colour_at(page, wall)[0], grey[0], "the same level is higher in a wider range")
        page.locator("[data-device=head] .facts", has_text="120 dB shown").wait_for()
        self.assertEqual(self.read_at(page, 240, 180 - wall / 8 * 172), read)
        self.assertEqual(self.faults, [])

    def scene(self, page):
        return dots(page.locator("#scene").screenshot())

    def test_the_scene_has_trail_beams_and_footprints_and_is_seen_from_three_sides(self):
        head, data = free_port(16), free_port(8)
        page = self.run_and_open(MOVING % (head, data), files={"way.csv": WAY})
        page.locator("[data-device=fan] .facts", has_text="ping").wait_for()
        page.locator("#scene").scroll_into_view_if_needed()
        page.locator("#camera").select_option("top")
        own, beams = (250, 158, 51), (150, 95, 31)  # of the first sonar: place, trail and footprints; outline of what it sees

        def found(rows):
            return {colour: {(x, y) for y, row in enumerate(rows) for x, dot in enumerate(row) if near(dot, colour)} for colour in (own, beams)}


        def until(what, wanted):
            """The dots of the first picture of which that holds; one is drawn when something has changed."""
            end = time.monotonic() + 30
            while not wanted(seen := found(self.scene(page))):
                self.assertLess(time.monotonic(), end, what)
            return seen

        first = until("beams and the sonar", lambda one: len(one[beams]) > 20 and len(one[own]) > 20)
        left = min(x for x, _ in first[beams])
        until("the beams move to the east, which is to the right",
              lambda one: one[beams] and min(x for x, _ in one[beams]) > left + 3)  # by 0.13 m each second
        page.locator("#pause").click()  # now nothing moves by itself
        before = found(self.scene(page))[beams]
        for view in ("orbit", "follow", "orbit"):
            page.locator("#camera").select_option(view)
            before = until(view, lambda one: len(one[beams]) > 15 and len(one[beams] ^ before) > 30)[beams]
        box = page.locator("#scene").bounding_box()
        page.mouse.move(box["x"] + 200, box["y"] + 200)
        page.mouse.down()
        page.mouse.move(box["x"] + 320, box["y"] + 200, steps=4)
        page.mouse.up()
        before = until("a drag turns it", lambda one: len(one[beams] ^ before) > 30)[beams]
        page.mouse.wheel(0, 600)
        until("the wheel brings it nearer or farther", lambda one: len(one[beams] ^ before) > 30)
        with page.expect_download() as download:
            page.locator("#save-scene").click()
        saved = dots(Path(download.value.path()).read_bytes())
        self.assertGreater(sum(near(dot, beams) for row in saved for dot in row), 15)
        self.assertEqual(self.faults, [])

    def test_the_load_of_a_serial_line_is_told(self):
        head, data = free_port(16), free_port(8)
        page = self.run_and_open(MOVING % (head, data), files={"way.csv": WAY})
        line = os.open(self.emulator.folder / "bottom", os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        row = page.locator("#lines tr", has_text=re.compile(r"[1-9]\d* % of 4800 bit/s"))
        row.wait_for()
        self.assertIn("bottom", row.inner_text())
        fan = page.locator("#lines tr", has_text="fan").filter(has_text=re.compile(r"[1-9]\d*(\.\d+)? (k|M)?B/s")).first
        fan.wait_for()
        self.assertEqual(self.faults, [])

    def test_late_pings_are_counted_in_red_and_the_time_that_there_was_is_told(self):
        port = free_port()
        page = self.run_and_open(LATE % port)
        row = page.locator("#devices tbody tr", has_text="busy")
        late = row.locator("td").nth(3)
        page.locator("#devices td.bad", has_text=re.compile(r"^[1-9]\d*$")).first.wait_for()
        self.assertIn("bad", late.get_attribute("class"))
        row.locator("td", has_text=re.compile(r"^\d+ of \d+ ms$")).wait_for()
        page.locator("#rendering", has_text=re.compile(r"\d+ of \d+ render threads draw, \d+ pings wait for one")).wait_for()
        page.locator("[data-device=busy] .facts", has_text=re.compile(r"\d+ ms late")).wait_for()

    def test_what_waits_for_a_driver_that_does_not_read_is_told(self):
        text = TANK % (free_port(), free_port()) + '  - {name: line, model: ping360, endpoints: ["pty://{folder}/line"]}\n'
        page = self.run_and_open(text)
        line = os.open(self.emulator.folder / "line", os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        tty.setraw(line)
        settings = ping360_host.Settings().for_range(2, 1500)
        scan = struct.pack("<BBHHHH", 1, *settings) + struct.pack("<HHBB", 0, 399, 1, 0)
        waiting = page.locator("#devices tbody tr", has_text="line").locator("td").nth(7)
        end = time.monotonic() + 30
        while not (told := re.fullmatch(r"([1-9]\d*), (\d+) (k?B)", waiting.inner_text() or "")) and time.monotonic() < end:
            os.write(line, ping360_host.frame(ping360_host.AUTO_TRANSMIT, scan))  # until it has booted
            page.wait_for_timeout(500)
        self.assertTrue(told, waiting.inner_text())

    def test_a_page_that_may_only_look_has_no_buttons_for_faults(self):
        page = self.start(control=False)
        self.ping()
        page.locator("[data-device=head] .facts", has_text="ping 1").wait_for()
        self.assertFalse(page.locator("#fault-panel").is_visible())
        self.assertFalse(page.locator("#record").is_visible())

    def test_the_picture_of_a_card_is_a_file_with_its_words(self):
        page = self.start()
        self.ping()
        self.ping(angle=201)
        page.locator("[data-device=head] .facts", has_text="circle").wait_for()
        page.locator("[data-device=head] h2 select").select_option("said")
        page.locator("[data-device=head] .facts", has_text=re.compile("circle . DeviceData")).wait_for()
        page.locator("[data-device=head] h2 select").select_option("both")
        with tempfile.TemporaryDirectory() as folder:
            with page.expect_download() as download:
                page.locator("[data-device=head] button", has_text="PNG").click()
            file = Path(folder) / "card.png"
            download.value.save_as(file)
            rows = dots(file.read_bytes())
        self.assertEqual((len(rows[0]), len(rows)), (2 * 480, 360 + 44))
        self.assertGreater(sum(min(dot) > 150 for row in rows[:44] for dot in row), 200, "words in the head")
        for left in (0, 480):
            self.assertGreater(sum(max(dot) > 60 for row in rows[44:] for dot in row[left: left + 480]), 300)


if __name__ == "__main__":
    unittest.main()
