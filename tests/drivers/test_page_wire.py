"""The page's list of messages in Debian's Chromium: fields on a click, what was refused, faults, filter, pause."""

import re
import socket
import struct
import unittest

from page_case import PageCase

import ping360_host


class Wire(PageCase):
    def rows(self, page, text):
        """Lines that are shown and hold a text."""
        return page.locator("#wire details:not([hidden]) summary", has_text=text)

    def fields(self, row):
        """{name: (value, unit)} of the table that a click on a line opens."""
        row.click()
        table = row.locator("xpath=..").locator("table")
        table.wait_for()
        cells = [line.locator("td").all_inner_texts() for line in table.locator("tr").all()]
        return {name: (value, unit) for name, value, unit in cells}

    def say(self, words, port=None):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as driver:
            driver.sendto(words, ("127.0.0.1", port or self.udp))

    def test_a_click_shows_the_fields_with_values_and_units_and_the_head_of_a_long_list(self):
        page = self.start()
        sent = self.ping(metres=8, angle=123)
        row = self.rows(page, "DeviceData").first
        row.wait_for()
        fields = self.fields(row)
        self.assertEqual(fields["angle"], ("123", "grad"))
        self.assertEqual(fields["sample_period"], (str(sent.period), "25 ns"))
        self.assertEqual(fields["transmit_frequency"], ("750", "kHz"))
        head = re.fullmatch(r"\[1200\] ([\d ]+) \.\.\.", fields["data"][0])
        shown = [int(word) for word in head[1].split()]
        self.assertGreaterEqual(len(shown), 4)
        self.assertEqual(shown, list(sent.data[: len(shown)]))
        self.assertTrue(fields["bytes"][0].startswith("42 52 "), "a message of this family begins with BR")
        asked = self.fields(self.rows(page, "Transducer").first)  # what the driver said
        self.assertEqual(asked["angle"], ("123", "grad"))
        self.assertEqual(asked["transmit"][0], "1")

    def where(self, page, table):
        """The y of a table on the screen, once what came before is drawn."""
        page.evaluate("() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")
        return table.bounding_box()["y"]

    def test_an_open_line_stays_open_and_in_its_place_while_others_come(self):
        page = self.start()
        self.ping(angle=7)
        row = self.rows(page, "Transducer").first
        row.wait_for()
        row.click()
        table = page.locator("#wire table")
        table.wait_for()
        before = self.where(page, table)
        for angle in range(20):
            self.ping(angle=angle)
        page.wait_for_function("() => document.querySelectorAll('#wire details').length > 40")
        self.assertEqual(table.count(), 1)
        self.assertIn("7", table.locator("tr", has_text="angle").first.inner_text())
        self.assertAlmostEqual(self.where(page, table), before, delta=3)

    def test_an_open_line_stays_in_its_place_while_tables_above_it_grow(self):
        page = self.start()
        self.ping(angle=7)
        page.locator("#lines tbody tr", has_text="head").wait_for()
        row = self.rows(page, "Transducer").first
        row.click()
        table = page.locator("#wire table")
        table.wait_for()
        page.mouse.move(1, 1)  # away from the list
        lines = page.locator("#lines")

        def check_stays(what, top):
            """`top`: what the window begins with."""
            with self.subTest(top):
                page.locator(top).evaluate("(one) => { one.scrollIntoView(); scrollBy(0, -20); }")
                before = self.where(page, what)
                lines.evaluate("(one) => { (one.tFoot ?? one.createTFoot()).insertRow().insertCell().append('more'); }")
                self.assertAlmostEqual(self.where(page, what), before, delta=3)

        for top in ("#lines", "#settings", "#wire"):
            check_stays(table, top)
        before = self.where(page, table)
        self.say(ping360_host.frame(ping360_host.GENERAL_REQUEST, struct.pack("<H", ping360_host.DEVICE_INFORMATION)), self.down)
        page.locator("#lines tbody tr", has_text="down").wait_for()
        self.assertAlmostEqual(self.where(page, table), before, delta=3)
        row.click()  # closes it; the mouse stays over the list
        page.locator("#wire [open]").wait_for(state="detached")
        check_stays(page.locator("#wire"), "#settings")

    def test_what_is_refused_is_red_and_says_why(self):
        page = self.start()
        self.say(b"hello, sonar")
        row = self.rows(page, "refused: ").first
        row.wait_for()
        self.assertIn("12 B", row.inner_text())
        self.assertRegex(row.inner_text(), r"refused: \w+")
        colours = {}
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            colours[scheme] = [int(word) for word in re.findall(r"\d+", row.evaluate("(one) => getComputedStyle(one).color"))][:3]
        for red, green, blue in colours.values():
            self.assertGreater(red, max(green, blue) + 60, colours)
        self.assertTrue(self.fields(row)["bytes"][0].startswith("68 65 6c 6c 6f"))

    def test_a_fault_is_marked_on_the_message_that_it_was_made_on(self):
        page = self.start()
        page.locator("[data-fault=bit_flips]").click()
        page.locator("#fault-answer", has_text="is on").wait_for()
        for _ in range(20):  # each answer has 128 bits, of which one in 100 is turned
            self.say(ping360_host.frame(ping360_host.GENERAL_REQUEST, struct.pack("<H", ping360_host.DEVICE_INFORMATION)))
        mark = page.locator("#wire summary .fault", has_text="bit_flips").first
        mark.wait_for()
        self.assertIn("head", mark.locator("xpath=..").inner_text())

    def test_the_filter_shows_what_it_names_and_an_open_line_stays_open(self):
        page = self.start()
        self.ping()
        self.say(b"hello, sonar")
        for text in ("DeviceData", "Transducer", "refused: "):
            self.rows(page, text).first.wait_for()
        page.locator("#pause-wire").click()
        everything = self.rows(page, "").count()
        self.rows(page, "DeviceData").first.click()
        for word, shown, hidden in (("devicedata", "DeviceData", "Transducer"), ("transmit_duration", "Transducer", "refused"),
                                    ("refused", "refused: ", "DeviceData"), ("head", "DeviceData", " down ")):
            page.locator("#filter").fill(word)
            self.assertGreater(self.rows(page, shown).count(), 0, word)
            self.assertEqual(self.rows(page, hidden).count(), 0, word)
        page.locator("#filter").fill("")
        self.assertEqual(self.rows(page, "").count(), everything)
        self.assertTrue(page.locator("#wire details[open] table").is_visible())

    def test_while_it_pauses_the_list_stands_and_the_rest_goes_on(self):
        page = self.start()
        self.ping()
        self.rows(page, "DeviceData").first.wait_for()
        page.locator("#pause-wire").click()
        before = page.locator("#wire").inner_text()
        self.ping(metres=4)
        page.locator("[data-device=head] .facts", has_text="ping 2 ").wait_for()
        self.assertEqual(page.locator("#wire").inner_text(), before)
        page.locator("#pause-wire").click()
        self.ping(metres=4, angle=77)
        self.rows(page, "angle 77 grad").first.wait_for()
        self.assertEqual(self.faults, [])


if __name__ == "__main__":
    unittest.main()
