"""Finds the program, starts it and ends it. Knows no scenario."""

import json
import os
import select
import shutil
import signal
import socket
import subprocess
import time


class EcholoopError(Exception):
    """What went wrong, in words for the person who runs the test."""


def find():
    """Path of the program: $ECHOLOOP, or `echoloop` of PATH."""
    named = os.environ.get("ECHOLOOP")
    found = shutil.which(named or "echoloop")
    if found:
        return found
    if named:
        raise EcholoopError(f"ECHOLOOP={named}: this is no program that can be run")
    raise EcholoopError("the program echoloop is not in PATH; install it, or set ECHOLOOP to where it is")


def ask(*arguments):
    """The JSON document that `echoloop VERB ... --json` prints; its own message if it fails."""
    command = [find(), *map(str, arguments), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    if done.returncode != 0:
        raise EcholoopError(f"`{' '.join(command)}` ended with status {done.returncode}:\n{done.stderr.strip()}")
    return json.loads(done.stdout)


class Talk:
    """Lines of JSON and their answers over TCP; `place` is like tcp-listen://127.0.0.1:9600."""

    def __init__(self, place):
        host, _, port = place.rpartition("//")[2].rpartition(":")
        self._socket = socket.create_connection((host, int(port)), timeout=60)
        self._answers = self._socket.makefile("r")

    def say(self, line):
        self._socket.sendall(json.dumps(line).encode() + b"\n")

    def ask(self, line):
        self.say(line)
        answer = json.loads(self._answers.readline() or '{"error": "the program has hung up"}')
        if "error" in answer:
            raise EcholoopError(answer["error"])
        return answer

    def close(self):
        self._answers.close()
        self._socket.close()


class Process:
    """`echoloop run --json`, ready when this is made. `folder`: for what it says on stderr."""

    def __init__(self, arguments, folder, patience=60):
        self._command = [find(), "run", *map(str, arguments), "--json"]
        self._said = folder / "stderr.txt"
        with open(self._said, "wb") as errors:
            self._process = subprocess.Popen(self._command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                             stderr=errors, env={**os.environ, "NO_COLOR": "1"})
        self._stopped = False
        try:
            self.started = self._first_line(patience)
        except BaseException:
            self._process.kill()
            self._process.communicate()
            raise

    def _first_line(self, patience):
        """RuntimeError texts hold what the program says itself."""
        line, end = b"", time.monotonic() + patience
        while not line.endswith(b"\n"):
            if not select.select([self._process.stdout], [], [], max(0, end - time.monotonic()))[0]:
                raise EcholoopError(f"{self._name()} was not ready within {patience} s{self._quoted()}")
            byte = os.read(self._process.stdout.fileno(), 1)
            if not byte:
                raise EcholoopError(f"{self._name()} ended with status {self._process.wait()} at its start{self._quoted()}")
            line += byte
        try:
            started = json.loads(line)
        except ValueError:
            started = {}
        if not started.get("ready"):
            raise EcholoopError(f"{self._command[0]} is too old for this fixture: `run --json` does not say when it is "
                                "ready and where it listens; install a newer one")
        return started

    def _name(self):
        return f"`{' '.join(self._command)}`"

    def _quoted(self):
        said = self.said()
        return f":\n{said}" if said else ""

    def said(self):
        """Its warnings and errors."""
        return self._said.read_text(errors="replace").strip()

    def stop(self, patience=30):
        """Ends it as Ctrl-C does, so that what it records is whole. EcholoopError if it had ended by itself, or fails."""
        if self._stopped:
            return
        self._stopped = True
        early = self._process.poll() is not None
        if not early:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.communicate()
            raise EcholoopError(f"{self._name()} did not end within {patience} s{self._quoted()}") from None
        if early or self._process.returncode != 0:
            when = "during the test" if early else "at its end"
            raise EcholoopError(f"{self._name()} ended with status {self._process.returncode} {when}{self._quoted()}")
