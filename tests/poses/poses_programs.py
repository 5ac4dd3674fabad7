"""A pose program as a process of its own, and an echosounder over a floor whose depth tells where the vehicle is."""

import os
import re
import select
import signal
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))

from program import PROGRAM, Emulator  # noqa: E402

FLOOR_Z = -20.0  # of the scene flat.glb
TOLERANCE = 0.15  # m: a pulse, and what the vehicle does during a tenth of a second
SOUNDER = """
scene: {scenes}/flat.glb
seed: 1
origin: {latitude: 59.4, longitude: 10.5, height: 0}
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500, depth: 12}
vehicle: {input: "%s"}
devices:
  - name: sounder
    model: nmea-echosounder
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp://127.0.0.1:%d"]
    options: {rate: 10, sentences: DBT}
"""


def need(condition, what):
    """Skips the test, or fails it in CI, if what it needs is not there."""
    if condition:
        return
    if os.environ.get("CI") == "true":
        raise AssertionError(what)
    raise unittest.SkipTest(what)


def program(name):
    """The path of a pose program, which lies beside echoloop."""
    path = Path(PROGRAM).with_name(name)
    need(path.exists(), f"{name} is not built: its Debian packages are missing (tools/install test)")
    return str(path)


class Process:
    """A program whose lines on standard error and output can be waited for; ended by its process id."""

    def __init__(self, test, *command, env=()):
        self.output = ""
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        stdin=subprocess.DEVNULL, env={**os.environ, **dict(env)})
        test.addCleanup(self.kill)

    def wait_for(self, text, seconds=30, publish=None):
        """`publish` is called ten times a second, until the text is there."""
        end = time.monotonic() + seconds
        while text not in self.output:
            if publish:
                publish()
            left = max(0, end - time.monotonic())
            ready = select.select([self.process.stdout], [], [], min(left, 0.1) if publish else left)[0]
            piece = os.read(self.process.stdout.fileno(), 65536).decode() if ready else ""
            if not piece and (ready or not publish or time.monotonic() > end):
                raise AssertionError(f"no '{text}' within {seconds} s; output:\n{self.output}")
            self.output += piece

    def stop(self):
        """Ends it as Ctrl-C does; returns (exit status, all output)."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.output += self.process.communicate(timeout=20)[0].decode()
        return self.process.returncode, self.output

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


class Depths:
    """The depths in metres that the emulated echosounder sends."""

    def __init__(self, test):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(30)
        test.addCleanup(self.socket.close)
        self.port = self.socket.getsockname()[1]

    def next(self):
        while True:
            match = re.search(rb"DBT,[\d.]*,f,([\d.]+),M", self.socket.recv(4096))
            if match:
                return float(match[1])

    def wait_for(self, depth, publish=lambda: None, seconds=20):
        """Waits for that depth; `publish` is called before each look."""
        end, last = time.monotonic() + seconds, None
        while time.monotonic() < end:
            publish()
            last = self.next()
            if abs(last - depth) < TOLERANCE:
                return last
        raise AssertionError(f"depth {depth} did not come, the last was {last}")


class PosesCase(unittest.TestCase):
    def emulator(self, scenario, *arguments):
        emulator = Emulator(scenario, *arguments)
        self.addCleanup(emulator.__exit__, None, None, None)
        return emulator.__enter__()

    def sounder(self, endpoint):
        """(emulator, its depths) with poses from that endpoint."""
        depths = Depths(self)
        return self.emulator(SOUNDER % (endpoint, depths.port)), depths
