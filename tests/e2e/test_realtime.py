"""What `run --realtime` asks of the machine, and that what is too slow is late with it as without. Needs the right to real
time."""

import json
import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, ROOT

FLOOR = str(ROOT / "config" / "bathymetry.yaml")


def permitted():
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
    except PermissionError:
        return False
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    return True


def priorities(pid):
    """Real-time priorities of a process's threads, sets by name; 0 is an ordinary one."""
    found = {}
    for comm in Path(f"/proc/{pid}/task").glob("[0-9]*/comm"):
        found.setdefault(comm.read_text().strip(), set()).add(os.sched_getparam(int(comm.parent.name)).sched_priority)
    return found


def locked_kilobytes(pid):
    return int(re.search(r"VmLck:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1])


class Run:
    """`echoloop run` of a multibeam over UDP with --json; its first line, and by end() its last."""

    def __init__(self, *arguments):
        ports = f'devices.multibeam.endpoints=["udp-listen://127.0.0.1:{free_port(32)}", "udp://127.0.0.1:{free_port(16)}"]'
        self.process = subprocess.Popen([PROGRAM, "run", FLOOR, "--set", ports, *arguments, "--json"],
                                        stdout=subprocess.PIPE, text=True)
        self.started = json.loads(self.process.stdout.readline())

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return json.loads(self.process.communicate(timeout=60)[0])


class RealTime(unittest.TestCase):
    @unittest.skipUnless(permitted() or os.environ.get("CI") == "true", "real time is not permitted to this user")
    def test_wires_go_before_rendering_and_both_before_ordinary_programs(self):
        run = Run("--realtime")
        end, of_threads = time.monotonic() + 60, {}
        while 2 not in of_threads.get("echoloop", ()) and time.monotonic() < end:  # claimed behind the first line
            of_threads = priorities(run.process.pid)
        locked = locked_kilobytes(run.process.pid)
        run.end()
        self.assertIn(1, of_threads["render"])  # Mesa has less urgent ones, which bear that name until they run
        self.assertIn(2, of_threads["echoloop"])
        self.assertGreater(locked, 10_000)

    def test_nothing_is_claimed_without_it(self):
        run = Run()
        of_threads = priorities(run.process.pid)
        ended = run.end()
        self.assertEqual(set().union(*of_threads.values()), {0})
        self.assertGreaterEqual(ended["stolen_s"], 0)

    def test_what_is_too_slow_is_late(self):
        run = Run("--set", "clock={mode: scaled, rate: 1000}", "--duration", "0.5", "--fail-late")  # no machine is that fast
        device = json.loads(run.process.communicate(timeout=60)[0])["devices"][0]
        self.assertEqual(run.process.returncode, 75)
        self.assertGreater(device["late_renderings"], device["pings"] / 2, device)
        self.assertGreaterEqual(device["late_pings"], device["late_renderings"], device)


if __name__ == "__main__":
    unittest.main()
