"""Port 0: the program chooses a free port, says which at the start, and tells drivers the same number on the wire."""

import contextlib
import errno
import json
import re
import select
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, ROOT, Emulator
from stepper import Stepper

DEVICE = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: sonar, model: %s, endpoints: %s, options: %s}
"""
PING360 = DEVICE % ("ping360", '["udp-listen://127.0.0.1:0"]', "{}")
STEPPED = PING360 + """
clock: {mode: stepped, input: "tcp-listen://127.0.0.1:0"}
"""
VERSION = b"BR\x02\x00\x06\x00\x00\x00\x05\x00\xa1\x00"  # asks for protocol_version: id 5, answered by id 5


class Run(Emulator):
    """Waits for the line of JSON at the start."""

    def __init__(self, scenario, *arguments):
        super().__init__(scenario, *arguments, "--json")

    def __enter__(self):
        self.read_until("\n", 30)
        self.started = json.loads(self.output.splitlines()[0])
        (self.device,) = self.started["devices"]
        return self

    def port(self, name):
        (found,) = (p["port"] for p in self.device["ports"] if p["name"] == name)
        return found


def number(place):
    return int(place.rpartition(":")[2])


class FreePorts(unittest.TestCase):
    def run_of(self, scenario, *arguments):
        run = Run(scenario, *arguments)
        self.addCleanup(run.__exit__, None, None, None)
        return run.__enter__()

    def device(self, model, *endpoints, options="{}"):
        return self.run_of(DEVICE % (model, json.dumps(endpoints), options))

    def udp(self, address=("127.0.0.1", 0)):
        s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(s.close)
        s.bind(address)
        s.settimeout(20)
        return s

    def test_a_ready_run_tells_every_place_and_answers_there(self):
        run = self.run_of(PING360)
        self.assertEqual((run.started["event"], run.started["ready"]), ("started", True))
        self.assertRegex(run.started["version"], r"^\d+\.\d+\.\d+$")
        (port,) = run.device["ports"]
        self.assertEqual((port["name"], port["transport"], port["host"]), ("line 1", "udp-listen", "127.0.0.1"))
        self.assertEqual(run.device["endpoints"], [f"udp-listen://127.0.0.1:{port['port']}"])
        driver = self.udp()
        driver.sendto(VERSION, ("127.0.0.1", port["port"]))
        self.assertEqual(driver.recv(100)[4:6], b"\x05\x00")

    def test_a_pty_is_told_by_its_path(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.device("ping1d", f"pty:{folder}/line")
            self.assertEqual(run.device["ports"], [{"name": "line 1", "transport": "pty", "path": f"{folder}/line"}])
            self.assertTrue(Path(folder, "line").is_char_device())

    def test_the_text_at_the_start_says_the_number(self):
        with Emulator(DEVICE % ("tritech-micron", '["tcp-listen://127.0.0.1:0"]', "{}")) as run:
            (port,) = re.findall(r"line +TCP, connect to 127\.0\.0\.1:([1-9]\d*)\n", run.output)
            with socket.create_connection(("127.0.0.1", int(port)), timeout=20) as driver:
                self.assertEqual(driver.recv(1), b"@")

    def test_discovery_tells_the_number(self):
        run = self.device("omniscan450", "tcp-listen://127.0.0.31:0", options="{discovery: 127.0.0.31}")
        driver = self.udp()
        driver.sendto(b"Discovery", ("127.0.0.31", 30303))
        self.assertIn(f"\r\nPort:- {run.port('line 1')}\r\n".encode(), driver.recv(1000))

    def test_ports_that_are_counted_from_one_another(self):
        reson = self.device("reson-7k", "tcp-listen://127.0.0.1:0")
        self.assertEqual(reson.port("stream"), reson.port("datagrams"))
        head = self.device("r2sonic-2024", "udp-listen://127.0.0.32:0", "udp://127.0.0.1:65400")
        self.assertEqual(head.port("commands"), number(head.device["endpoints"][0]) + 2)

    def test_three_ports_of_one_sonar_are_three(self):
        norbit = self.device("norbit-wbms", *["tcp-listen://127.0.0.1:0"] * 3)
        ports = [norbit.port(name) for name in ("commands", "bathymetry", "water column")]
        self.assertEqual(len(set(ports)), 3)
        for port in ports:
            socket.create_connection(("127.0.0.1", port), timeout=20).close()

    def test_control_poses_and_steps(self):
        run = self.run_of(STEPPED, "--control", "tcp-listen://127.0.0.1:0")
        self.assertEqual(run.started["poses"], run.started["steps"])
        self.assertIn(run.started["steps"], run.started["clock"])
        with Stepper(number(run.started["steps"])) as simulator:
            self.assertEqual(simulator.step(0.5, position=[0, 0, -2])["now"], 0.5)
        done = subprocess.run([PROGRAM, "fault", run.started["control"], "--token", run.started["control_token"], "list"],
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_poses_by_udp(self):
        run = self.run_of(PING360.replace("pose: {position: [0, 0, -2]}", 'input: "udp-listen://127.0.0.1:0"'))
        self.assertNotIn("steps", run.started)
        self.udp().sendto(b'{"position": [0, 0, -2]}\n{"position": [0, 0]}\n', ("127.0.0.1", number(run.started["poses"])))
        run.read_until("a pose was refused", 30)
        ended = json.loads(run.stop()[1].splitlines()[-1])
        self.assertEqual((ended["vehicle"]["poses"], ended["vehicle"]["refused"]), (1, 1))
        self.assertEqual(ended["vehicle"]["place"], run.started["poses"])

    def test_each_object_that_moves_is_told_where(self):
        with subprocess.Popen([PROGRAM, "run", str(ROOT / "config" / "moving.yaml"), "--json", "--set",
                               "objects=[{node: auv, input: 'udp-listen://127.0.0.1:0'}]"],
                              stdout=subprocess.PIPE) as run:
            started = json.loads(run.stdout.readline())
            run.send_signal(signal.SIGINT)
            self.assertEqual(json.loads(run.stdout.readline())["event"], "ended")
        self.assertRegex(started["objects"]["auv"], r"^udp-listen://127\.0\.0\.1:[1-9]\d*$")

    def test_equal_stepped_runs_have_equal_ports_and_runs_beside_each_other_have_others(self):
        first = self.run_of(STEPPED)
        beside = self.run_of(STEPPED)
        self.assertNotEqual(first.port("line 1"), beside.port("line 1"))
        first.stop()
        self.assertEqual(self.run_of(STEPPED).port("line 1"), first.port("line 1"))

    def test_many_runs_at_once_have_ports_of_their_own(self):
        with contextlib.ExitStack() as stack:
            scenario = DEVICE % ("reson-7k", '["tcp-listen://127.0.0.1:0"]', "{}")
            runs = [Run(scenario) for _ in range(12)]
            for run in runs:
                stack.callback(run.__exit__, None, None, None)
            for run in runs:
                run.__enter__()
            self.assertEqual(len({run.port("stream") for run in runs}), len(runs))

    def test_what_opens_nothing_says_that_the_number_comes_later(self):
        file = str(ROOT / "config" / "bathymetry.yaml")
        open_number = ("--set", "devices.multibeam.endpoints=[udp-listen://127.0.0.1:0, udp://127.0.0.1:65400]")
        for verb in (("check",), ("endpoints",), ("endpoints", "--format", "ros2")):
            done = subprocess.run([PROGRAM, verb[0], file, *verb[1:], *open_number], capture_output=True, text=True,
                                  timeout=60, check=True)
            self.assertIn("127.0.0.1, the port is chosen at the start", done.stdout)
            self.assertNotRegex(done.stdout, r":[02]\b|ports/bathy")
        self.assertIn("sends bathymetry to             127.0.0.1:65400", done.stdout)


def hold(sock, port):
    """Binds the socket as soon as tests beside this one have given the port back."""
    deadline = time.monotonic() + 120
    while True:
        try:
            return sock.bind(("127.0.0.1", port))
        except OSError as error:
            if error.errno != errno.EADDRINUSE or time.monotonic() > deadline:
                raise
            select.select([], [], [], 0.05)


class TakenDiscovery(unittest.TestCase):
    """Another program that holds a port of discovery for itself costs the discovery, not the run."""

    def test_the_sonar_works_without(self):
        cerulean, r2sonic = 30303, 53810
        for model, port, option in (("omniscan450", cerulean, '{discovery: "127.0.0.1"}'), ("s500", cerulean, '{discovery: "127.0.0.1"}'),
                                    ("surveyor240", cerulean, '{discovery: "127.0.0.1"}'), ("r2sonic-2024", r2sonic, "{}")):
            ends = ('["udp-listen://127.0.0.1:0", "udp://127.0.0.1:65400"]' if port == r2sonic
                    else '["tcp-listen://127.0.0.1:0"]')
            with self.subTest(model=model), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
                hold(other, port)
                with Emulator(DEVICE % (model, ends, option)) as run:  # starts all the same
                    self.assertRegex(run.output, rf"127\.0\.0\.1:{port}: another program has it for itself.*discovery")


if __name__ == "__main__":
    unittest.main()
