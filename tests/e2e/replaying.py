"""`echoloop replay` as a process, drivers that note when bytes came, and captures made by hand."""

import os
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import termios
import time
import tty
from pathlib import Path

from program import PROGRAM, ROOT

sys.path.insert(0, str(ROOT / "tests" / "cli"))

READY = "Ctrl-C"


class Replay:
    """`echoloop replay` with these arguments; use as a context manager."""

    def __init__(self, *arguments, stdin=subprocess.DEVNULL):
        self.output = ""
        self.process = subprocess.Popen(
            [PROGRAM, "replay", *map(str, arguments)],
            stdin=stdin,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, "NO_COLOR": "1"},
        )

    def __enter__(self):
        self.read_until(READY)
        return self

    def read_until(self, text, seconds=20):
        end = time.monotonic() + seconds
        while text not in self.output:
            ready = select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))[0]
            piece = os.read(self.process.stdout.fileno(), 65536).decode() if ready else ""
            if not piece:
                raise RuntimeError(f"no '{text}' within {seconds} s; output:\n{self.output}")
            self.output += piece

    def end(self, seconds=20):
        """Waits until it ends by itself; (exit status, all output)."""
        self.output += self.process.communicate(timeout=seconds)[0].decode()
        return self.process.returncode, self.output

    def stop(self):
        self.process.terminate()
        return self.end()

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()


def udp_listener():
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.bind(("127.0.0.1", 0))
    listener.settimeout(20)
    return listener


def open_line(path):
    line = os.open(path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(line, termios.TCSANOW)  # without the usual flush: what a replay says at once is to be seen
    return line


def read_line(line, size, seconds=20):
    """[(when, bytes)] until `size` bytes have come."""
    pieces, got, end = [], 0, time.monotonic() + seconds
    while got < size:
        if not select.select([line], [], [], max(0, end - time.monotonic()))[0]:
            raise RuntimeError(f"{got} of {size} bytes within {seconds} s")
        data = os.read(line, 4096)
        if not data:
            raise RuntimeError(f"the line has ended after {got} of {size} bytes")
        pieces.append((time.monotonic(), data))
        got += len(data)
    return pieces


class Folder:
    def __init__(self):
        self.path = Path(tempfile.mkdtemp(prefix="echoloop-replay-"))

    def file(self, name, data):
        path = self.path / name
        path.write_bytes(data)
        return path

    def remove(self):
        shutil.rmtree(self.path, ignore_errors=True)
