"""Any web page that is open on the bench can let the browser send bytes of its choice to 127.0.0.1, behind the first
line of HTTP. No place but a sonar's own web interface listens to that."""

import json
import socket
import unittest

from ports import free_port
from program import Emulator

from norbit_host import Line

SCENARIO = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}, input: "tcp-listen://127.0.0.1:%(poses)d"}
devices:
  - {name: norbit, model: norbit-wbms, endpoints: ["tcp-listen://127.0.0.1:%(norbit)d",
     "tcp-listen://127.0.0.1:%(bathymetry)d", "tcp-listen://127.0.0.1:%(water)d"]}
  - {name: sounder, model: ping1d, endpoints: ["tcp-listen://127.0.0.1:%(sounder)d"]}
  - {name: images, model: sonar-3d-15, endpoints: ["tcp-listen://127.0.0.1:%(images)d"]}
control: "tcp-listen://127.0.0.1:%(control)d"
"""
DEVICE_INFORMATION = bytes.fromhex("4252020006000000" "0400a000")  # a request of the Ping protocol


def post(port, body, target="/", headers="Host: 127.0.0.1\r\nOrigin: http://page.example\r\n"):
    """What a form on a page sends; returns all that is answered until the connection ends."""
    head = f"POST {target} HTTP/1.1\r\n{headers}Content-Type: text/plain\r\nContent-Length: {len(body)}\r\n\r\n"
    answer = b""
    with socket.create_connection(("127.0.0.1", port), timeout=20) as page:
        page.sendall(head.encode() + body)
        try:
            while piece := page.recv(4096):
                answer += piece
        except ConnectionResetError:
            pass
    return answer


class WebPages(unittest.TestCase):
    def setUp(self):
        names = ("poses", "norbit", "bathymetry", "water", "sounder", "images", "control")
        self.ports = dict(zip(names, (free_port() for _ in names)))
        self.emulator = Emulator(SCENARIO % self.ports)
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def test_lines_of_json_are_not_obeyed(self):
        fault = {"fault": {"device": "sounder", "kind": "silence"}}
        answer = json.loads(post(self.ports["control"], json.dumps(fault).encode() + b"\n"))
        self.assertFalse(answer["ok"])
        self.assertIn("token", answer["error"])
        self.assertEqual(post(self.ports["poses"], b'{"position": [0, 0, -9]}\n'), b"")
        output = self.emulator.stop()[1]
        self.assertNotIn("1 silence", output)
        self.assertIn("a web browser was turned away", output)
        self.assertNotRegex(output, r"[1-9]\d* poses? ")

    def test_sonars_do_not_answer(self):
        self.assertNotIn(b"OK", post(self.ports["norbit"], b"set_range 5 20\r\n").upper())
        self.assertEqual(post(self.ports["sounder"], DEVICE_INFORMATION), b"")
        line = Line(self.ports["norbit"])  # free again for its driver
        self.addCleanup(line.close)
        self.assertNotIn("5 20", line.ask("set_range"))

    def test_the_web_interface_of_a_sonar_listens_to_its_own_pages_only(self):
        target = "/api/v1/integration/acoustics/enabled"
        self.assertIn(b" 403 ", post(self.ports["images"], b"true", target))
        own = f"Host: 127.0.0.1:{self.ports['images']}\r\nOrigin: http://127.0.0.1:{self.ports['images']}\r\n"
        self.assertIn(b" 204 ", post(self.ports["images"], b"true", target, own))


if __name__ == "__main__":
    unittest.main()
