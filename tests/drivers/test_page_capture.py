"""The page of what was captured, in Debian's Chromium: `view FILE` and `replay FILE --view`."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from page_case import LINK, NEWEST, PageCase

from ports import free_port
from program import PROGRAM, ROOT

SCENARIO = """
scene: {scenes}/tank.glb
water: {{temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}}
vehicle: {{pose: {{position: [0, 0, -2]}}}}
clock: {{mode: free, duration: 6}}
devices:
  - {{name: down, model: ping1d, mount: {{rpy_deg: [0, 90, 0]}}, pings: {{interval: 0.2, count: 20}}}}
  - {{name: depth, model: nmea-echosounder, mount: {{rpy_deg: [0, 90, 0]}}}}
"""
FLOOR = 2.0  # m below the vehicle


class Capture(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory(prefix="echoloop-page-")
        cls.addClassCleanup(folder.cleanup)
        cls.file = Path(folder.name) / "dive.pcapng"
        scenario = Path(folder.name) / "dive.yaml"
        scenario.write_text(SCENARIO.format(scenes=ROOT / "config" / "scenes"))
        subprocess.run([PROGRAM, "run", str(scenario), "--record", str(cls.file)], capture_output=True, timeout=100, check=True)

    def show(self, *command, width=1280):
        """The page that a command prints the link of."""
        process = subprocess.Popen([PROGRAM, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        output = ""
        while not (link := LINK.search(output)) or "Ctrl-C" not in output:
            line = process.stdout.readline()
            self.assertTrue(line, output)
            output += line
        return self.open(link[0], width)

    def check(self, page, down, depth):
        facts = page.locator(f"[data-device='{down}'] .facts")
        facts.filter(has_text="Profile").wait_for()
        page.locator(f"[data-device='{depth}'] .facts", has_text=re.compile("D[BP]T")).wait_for()
        self.assertEqual(page.locator("#scene-panel").is_visible(), False)
        options = page.locator(f"[data-device='{down}'] h2 select option").all_inner_texts()
        self.assertTrue(all(one.startswith("said") for one in options), options)
        page.locator("#wire summary", has_text="Profile").first.wait_for()
        page.mouse.move(1, 1)
        # a profile that is asked for before the first ping is empty
        page.locator(f"[data-device='{down}'] .read", has_text=re.compile(r"loudest echo: .* [1-9]\d* counts")).wait_for()
        page.locator("#pause").click()
        tells = page.locator(f"[data-device='{depth}'] .read").inner_text()
        self.assertAlmostEqual(float(re.search(r"([\d.]+) m", tells)[1]), FLOOR, delta=0.1)
        metres = {}
        far = float(re.search(r"to ([\d.]+) m", facts.inner_text())[1])
        for row in range(0, 360, 2):
            found = re.match(r"([\d.]+) m.*?, (\d+) counts", self.read_at(page, NEWEST, row, down))
            if found and float(found[1]) > 0.5:
                metres[float(found[1])] = int(found[2])
        self.assertGreater(far, FLOOR)
        self.assertAlmostEqual(max(metres, key=metres.get), FLOOR, delta=0.1)
        self.assertEqual(self.faults, [])

    def test_view_of_a_capture(self):
        page = self.show("view", str(self.file), "--speed", "2", "--loop")
        self.check(page, "down line 1", "depth line")

    def test_a_replay(self):
        page = self.show("replay", str(self.file), f"udp://127.0.0.1:{free_port()}", "--port", "down line 1", "--loop", "--view")
        page.locator("article .facts", has_text="Profile").wait_for()
        page.locator("#wire summary", has_text="Profile").first.click()
        page.locator("#wire table td", has_text="distance").first.wait_for()
        self.assertEqual(self.faults, [])

    def test_a_capture_on_a_narrow_page_has_no_scroll_bar_across(self):
        page = self.show("view", str(self.file), "--loop", width=390)
        page.locator("article .facts", has_text="Profile").wait_for()
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)


if __name__ == "__main__":
    unittest.main()
