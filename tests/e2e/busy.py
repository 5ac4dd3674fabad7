#!/usr/bin/env python3
"""Runs config/busy.yaml with a driver at every sonar's end of the wire, and says whether a ping was late.

    tests/e2e/busy.py --seconds 600

Ports and lines are its own, so that it can run beside other programs; those make pings late when they want the same
processors, so the load is told with the result. Exit status: 0 every driver got what it asked for and no ping was late
(with --realtime: but for those that the machine held up by running nothing); 75 a ping was late or a message was dropped;
1 a driver missed something.
"""

import argparse
import json
import os
import re
import resource
import time

from program import ROOT, Emulator

from busy_drivers import fleet


class Run:
    """What a run of so many seconds ended with."""

    def __init__(self, seconds, *arguments):
        text = (ROOT / "config" / "busy.yaml").read_text()
        drivers = fleet()
        text = text.replace("scenes/", "{scenes}/")
        for driver in drivers:
            pattern = rf"(name: {driver.name}\n.*\n.*\n.*endpoints: )\[.*\]"
            text, found = re.subn(pattern, lambda m: m.group(1) + json.dumps(driver.endpoints()), text)
            assert found == 1, f"{driver.name} in config/busy.yaml"
            if hasattr(driver, "held"):
                driver.held.close()
        with Emulator(text, "--fail-late", *arguments) as emulator:
            for driver in drivers:
                driver.begin(emulator.folder)
            before = os.times()
            begin = time.monotonic()
            while time.monotonic() < begin + seconds and emulator.process.poll() is None:
                time.sleep(0.2)
            after = os.times()
            self.seconds = time.monotonic() - begin
            self.driver_load = (after.user + after.system - before.user - before.system) / self.seconds
            for driver in drivers:
                driver.end()
            self.status, self.output = emulator.stop()
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.emulator_load = (used.ru_utime + used.ru_stime) / self.seconds
        self.got = {driver.name: driver.got for driver in drivers}
        self.faults = {driver.name: driver.fault for driver in drivers if driver.fault}

    def text(self):
        rates = ", ".join(f"{name} {got / self.seconds:.1f}" for name, got in self.got.items())
        faults = "".join(f"driver of {name}: {fault}\n" for name, fault in self.faults.items())
        return (
            f"{self.output[self.output.find('ends it') + 8:]}"
            f"pings a second at the drivers: {rates}\n{faults}"
            f"processors in use: emulator {self.emulator_load:.2f}, drivers {self.driver_load:.2f}"
            f" of {os.cpu_count()}; load of the machine {' '.join(f'{x:.2f}' for x in os.getloadavg())}\n"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--realtime", action="store_true", help="give echoloop run --realtime, which needs rights")
    options = parser.parse_args()
    run = Run(options.seconds, *(["--realtime"] if options.realtime else []))
    print(run.text(), end="")
    return 1 if run.faults else run.status


if __name__ == "__main__":
    raise SystemExit(main())
