"""Who may not see the page of a run, in Debian's Chromium: a page of another origin, and a name of another host that leads here."""

import functools
import http.server
import re
import tempfile
import threading
import unittest

from page_case import TANK, PageCase, chromium

from ports import free_port

# What a page can do to reach a run: a WebSocket, and a request for the scene. The token is known to it.
REACH = """async ([place, token]) => {
  const socket = await new Promise((done) => {
    const one = new WebSocket(`ws://${place}/news`, ["echoloop.view", token]);
    one.onmessage = () => { done("a message"); one.close(); };
    one.onclose = one.onerror = () => done("refused");
  });
  const scene = await fetch(`http://${place}/scene`, { headers: { Authorization: `Bearer ${token}` } }).then((one) => one.status, () => "refused");
  return [socket, scene];
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Gate(PageCase):
    def reach(self, page):
        place, token = re.search(r"http://([\d.:]+)/#([0-9a-f]+)", self.emulator.output).groups()
        return page.evaluate(REACH, [place, token])

    def test_a_page_of_another_origin_reaches_nothing_though_it_knows_the_token(self):
        own = self.run_and_open(TANK % (free_port(), free_port()))
        self.assertEqual(self.reach(own), ["a message", 200])
        folder = tempfile.TemporaryDirectory(prefix="echoloop-page-")
        self.addCleanup(folder.cleanup)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder.name))
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        other = self.browser.new_page()
        self.addCleanup(other.close)
        other.goto(f"http://127.0.0.1:{server.server_port}/")
        self.assertEqual(self.reach(other), ["refused", "refused"])

    def test_another_host_s_name_that_leads_here_is_refused(self):
        """As a page does whose name is told to lead to this machine once it is loaded."""
        self.run_and_open(TANK % (free_port(), free_port()))
        port = re.search(r"http://127\.0\.0\.1:(\d+)/#", self.emulator.output)[1]
        browser = self.playwright.chromium.launch(
            executable_path=chromium(), args=["--no-sandbox", "--host-resolver-rules=MAP evil.example 127.0.0.1"])
        self.addCleanup(browser.close)
        page = browser.new_page()
        self.assertEqual(page.goto(f"http://evil.example:{port}/").status, 421)
        self.assertEqual(page.goto(f"http://127.0.0.1:{port}/").status, 200)


if __name__ == "__main__":
    unittest.main()
