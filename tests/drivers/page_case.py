"""A run in a tank whose page is open in Debian's Chromium, driven by playwright, for the tests of test_page*.py."""

import os
import re
import shutil
import sys
import time
import unittest

import public_driver

public_driver.use("page", "playwright")

from playwright.sync_api import sync_playwright  # noqa: E402
from ports import free_port  # noqa: E402
from program import ROOT, Emulator  # noqa: E402

sys.path.insert(0, str(ROOT / "tests" / "hosts"))
import ping360_host  # noqa: E402

TANK = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: head, model: ping360, endpoints: ["udp-listen://127.0.0.1:%d"]}
  - {name: down, model: ping1d, mount: {rpy_deg: [0, 90, 0]}, endpoints: ["udp-listen://127.0.0.1:%d"]}
"""
LINK = re.compile(r"http://127\.0\.0\.1:\d+/#[0-9a-f]{32}")
NEWEST = 409  # dot of an echogram where its last line stands


def chromium():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            return path
    reason = "there is no Chromium: apt install chromium"
    if os.environ.get("CI"):
        raise RuntimeError(reason)
    raise unittest.SkipTest(reason)


class PageCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.playwright = sync_playwright().start()
        cls.addClassCleanup(cls.playwright.stop)
        cls.browser = cls.playwright.chromium.launch(
            executable_path=chromium(),
            args=["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
        )
        cls.addClassCleanup(cls.browser.close)

    def start(self, *arguments, width=1280, control=True):
        """The page of a run of TANK whose head has booted."""
        self.udp, self.down = free_port(), free_port()
        page = self.run_and_open(TANK % (self.udp, self.down), *(["--view-control"] if control else []), *arguments, width=width)
        self.awake()
        return page

    def run_and_open(self, scenario, *arguments, width=1280, files=()):
        emulator = Emulator(scenario, "--view", *arguments, files=files)
        emulator.__enter__()
        self.addCleanup(emulator.__exit__, None, None, None)
        self.emulator = emulator
        return self.open(LINK.search(emulator.output).group(), width)

    def open(self, link, width=1280):
        page = self.browser.new_page(viewport={"width": width, "height": 900})
        self.addCleanup(page.close)
        page.set_default_timeout(90_000)  # ms; on a busy machine the browser shows a ping half a minute after it has come
        self.faults = []
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.on("console", lambda said: said.type == "error" and self.faults.append(said.text))
        page.goto(link)
        page.locator("#state.live").wait_for()
        return page

    def ping(self, metres=8, angle=200):
        """Asks as a driver does; 200 gradians look ahead."""
        with ping360_host.Host("127.0.0.1", self.udp) as host:
            settings = ping360_host.Settings().for_range(metres, 1500)
            return host.ping(angle, settings)

    def awake(self):
        """Waits for the head, which is silent while it boots."""
        with ping360_host.Host("127.0.0.1", self.udp) as host:
            end = time.monotonic() + 30
            while host.ask(ping360_host.DEVICE_INFORMATION, 0.5) is None and time.monotonic() < end:
                pass

    def read_at(self, page, x, y, card="head"):
        """What a card says of a dot of its 480 x 360."""
        box = page.locator(f"[data-device='{card}'] .kinds:not([hidden]) canvas:not([hidden])").bounding_box()
        scale = box["width"] / 480
        page.mouse.move(box["x"] + (x + 0.5) * scale, box["y"] + (y + 0.5) * scale)
        return page.locator(f"[data-device='{card}'] .read").inner_text()

    def drag(self, page, card, a, b):
        """m, that the ruler tells from one dot of a card's 480 x 360 to another."""
        box = page.locator(f"[data-device='{card}'] .kinds:not([hidden]) canvas:not([hidden])").bounding_box()
        scale = box["width"] / 480
        page.mouse.move(box["x"] + a[0] * scale, box["y"] + a[1] * scale)
        page.mouse.down()
        page.mouse.move(box["x"] + b[0] * scale, box["y"] + b[1] * scale, steps=4)
        text = page.locator(f"[data-device='{card}'] .read").inner_text()
        page.mouse.up()
        return float(re.search(r"ruler ([\d.]+) m", text)[1])
