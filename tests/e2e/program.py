"""Runs the program under test with a scenario in a folder of its own, and ends it by its process id."""

import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "hosts"))

PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))
READY = "Ctrl-C"  # the last start-up line names the way to end the run


class Emulator:
    """`echoloop run` on a scenario text; {folder} and {scenes} in it are filled in, `files` lie beside it. `program`:
    what runs it instead, `limits`: called in the new process first. Use as a context manager."""

    def __init__(self, scenario, *arguments, files=(), program=(PROGRAM,), limits=None,
                 stdin=subprocess.DEVNULL):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-e2e-"))
        self.file = self.folder / "scenario.yaml"
        self.file.write_text(
            scenario.replace("{folder}", str(self.folder)).replace("{scenes}", str(ROOT / "config" / "scenes"))
        )
        for name, text in dict(files).items():
            (self.folder / name).write_text(text)
        self.output = ""
        self.process = subprocess.Popen(
            [*program, "run", str(self.file), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=stdin,
            env={**os.environ, "NO_COLOR": "1"},
            preexec_fn=limits,
        )

    def __enter__(self):
        try:
            self.read_until(READY, 30)
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def read_until(self, text, seconds):
        """Output up to a line that holds `text`. RuntimeError if the program ends or the time is over."""
        end = time.monotonic() + seconds
        while text not in self.output:
            left = end - time.monotonic()
            ready = select.select([self.process.stdout], [], [], max(0, left))[0]
            piece = os.read(self.process.stdout.fileno(), 65536).decode() if ready else ""
            if not piece:
                raise RuntimeError(f"no '{text}' within {seconds} s; output:\n{self.output}")
            self.output += piece

    def stop(self):
        """Ends the run as Ctrl-C does; returns (exit status, all output)."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        rest = self.process.communicate(timeout=20)[0].decode()
        self.output += rest
        return self.process.returncode, self.output

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()  # so that it takes its links away
            try:
                self.process.communicate(timeout=5)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.communicate()
        shutil.rmtree(self.folder, ignore_errors=True)
