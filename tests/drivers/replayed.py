"""A driver's run against the emulator, recorded, and the same again against a replay of that recording."""

import shutil
import tempfile
from pathlib import Path

from program import Emulator
from replaying import Replay


class Recorded:
    """An emulator whose capture outlives it; use as a context manager, then `capture` is whole."""

    def __init__(self, scenario):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-recorded-"))
        self.capture = self.folder / "run.pcapng"
        self.emulator = Emulator(scenario, "--record", self.capture)

    def __enter__(self):
        return self.emulator.__enter__()

    def __exit__(self, *exception):
        try:
            if exception[0] is None:
                status, output = self.emulator.stop()
                assert status == 0, output
        finally:
            self.emulator.__exit__(*exception)

    def replay(self, *arguments):
        return Replay(self.capture, *arguments)

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)


def requests_line(output):
    return next(line for line in output.splitlines() if line.startswith("requests"))
