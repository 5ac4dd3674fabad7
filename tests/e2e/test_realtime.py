"""What `run --realtime` claims of the machine, and what it tells about standstills. Needs the right to real time."""

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
DEMO = str(ROOT / "config" / "demo.yaml")
TANK = str(ROOT / "config" / "tank.yaml")


def workers():
    """The kernel's that carry the bytes of pseudo-terminals: scheduling policy by process id."""
    found = {}
    for comm in Path("/proc").glob("[0-9]*/comm"):
        try:
            if re.match(r"kworker/u\d+:\d+(?!\d*H)", comm.read_text()):
                found[int(comm.parent.name)] = os.sched_getscheduler(int(comm.parent.name))
        except (FileNotFoundError, ProcessLookupError):
            pass  # it ended meanwhile
    return found


def turns(pid):
    """Real-time priorities of a process's threads, (name, priority) by thread id."""
    found = {}
    for comm in Path(f"/proc/{pid}/task").glob("[0-9]*/comm"):
        try:
            found[int(comm.parent.name)] = (comm.read_text().strip(), os.sched_getparam(int(comm.parent.name)).sched_priority)
        except (FileNotFoundError, ProcessLookupError):
            pass  # it ended meanwhile
    return found


def permitted():
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
    except PermissionError:
        return False
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    return True


class Run:
    """`echoloop run ARGUMENTS --json`; its first line, and by end() its last."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "run", *arguments, "--json"], stdout=subprocess.PIPE, text=True)
        self.started = json.loads(self.process.stdout.readline())

    def end(self, *statuses):
        self.process.send_signal(signal.SIGINT)
        ended = json.loads(self.process.stdout.readline())
        self.process.stdout.close()
        assert self.process.wait(timeout=60) in (statuses or (0,))
        return ended


def over_udp():
    return ("--set", f'devices.multibeam.endpoints=["udp-listen://127.0.0.1:{free_port(32)}", "udp://127.0.0.1:{free_port(16)}"]')


@unittest.skipUnless(permitted() or os.environ.get("CI") == "true", "real time is not permitted to this user")
class RealTime(unittest.TestCase):
    def over_a_line(self):
        return "--set", f'devices.micron.endpoints=["pty:/tmp/echoloop-realtime-{os.getpid()}"]'

    def test_the_kernels_workers_go_first_while_it_runs_and_then_are_as_they_were(self):
        run = Run(TANK, *self.over_a_line(), "--realtime")
        during = workers()
        run.end()
        self.assertGreaterEqual(run.started["real_time"]["kernel_workers"], 1)
        self.assertGreaterEqual(list(during.values()).count(os.SCHED_FIFO), 1)
        raised = [pid for pid, policy in during.items() if policy == os.SCHED_FIFO]
        after = workers()
        self.assertEqual([after[pid] for pid in raised if pid in after if after[pid] != os.SCHED_OTHER], [])

    def test_those_that_a_killed_run_left_are_put_back_by_the_next(self):
        killed = Run(TANK, *self.over_a_line(), "--realtime")
        raised = [pid for pid, policy in workers().items() if policy == os.SCHED_FIFO]
        killed.process.kill()
        killed.process.communicate()
        self.assertTrue(raised)
        Run(TANK, *self.over_a_line(), "--realtime").end()
        after = workers()
        self.assertEqual([pid for pid in raised if after.get(pid) == os.SCHED_FIFO], [])

    def test_they_go_before_the_rendering_of_fans_and_behind_the_wires(self):
        """Else the bytes of a line would wait for as long as multibeams render, in no summary."""
        ports = f'devices.sonar.endpoints=["udp-listen://127.0.0.1:{free_port(32)}", "udp://127.0.0.1:{free_port(16)}"]'
        run = Run(DEMO, *self.over_a_line(), "--set", ports, "--realtime")
        end, fans, wires = time.monotonic() + 60, [], 0
        while not (fans and wires) and time.monotonic() < end:  # the wires' thread claims its turn after its first line
            of_threads = turns(run.process.pid)
            fans = [priority for name, priority in of_threads.values() if name == "render" and priority > 0]
            wires = of_threads[run.process.pid][1]
        carriers = [os.sched_getparam(pid).sched_priority for pid, policy in workers().items() if policy == os.SCHED_FIFO]
        run.end()
        self.assertTrue(fans and carriers)
        self.assertLess(max(fans), min(carriers))
        self.assertLess(max(carriers), wires)

    def test_a_run_without_lines_or_real_time_leaves_them_alone(self):
        for arguments in ((FLOOR, *over_udp(), "--realtime"), (TANK, *self.over_a_line())):
            before = workers()
            run = Run(*arguments)
            during = workers()
            run.end()
            self.assertEqual([pid for pid, policy in during.items() if policy != before.get(pid, os.SCHED_OTHER)], [], arguments)

    def stopped_run(self, *arguments):
        """The end of a run that was stopped for half a second, twice."""
        run = Run(FLOOR, *over_udp(), *arguments)
        for _ in range(2):
            time.sleep(0.5)
            run.process.send_signal(signal.SIGSTOP)
            time.sleep(0.5)
            run.process.send_signal(signal.SIGCONT)
        time.sleep(0.3)
        ended = run.end(0, 75)
        return ended, run.process.returncode

    def test_pings_that_were_held_up_since_nothing_ran_are_not_late(self):
        ended, status = self.stopped_run("--realtime", "--fail-late")
        device = ended["devices"][0]
        self.assertGreaterEqual(device["held_up_pings"], 1, device)
        self.assertGreaterEqual(device["held_up_by_all"], 1, "its threads were stopped on all processors")
        self.assertTrue(0.2 < device["longest_held_up_s"] <= device["worst_lateness_s"], device)
        self.assertGreater(ended["standstills"]["count"], 0)
        self.assertTrue(0.3 < ended["standstills"]["longest_s"] < 5, ended)
        bad = device["late_pings"] + device["dropped"] + device["bytes_lost"]  # none but on a busy machine
        self.assertEqual(status, 75 if bad else 0, "those that were held up fail no run")

    def test_what_is_too_slow_is_late_all_the_same(self):
        """Else a slow program could put its pings down to the machine."""
        hasty = ("--set", "clock={mode: scaled, rate: 1000}", "--duration", "0.5")  # no machine is that fast
        run = Run(FLOOR, *over_udp(), *hasty, "--realtime", "--fail-late")
        ended = json.loads(run.process.communicate(timeout=60)[0])
        device = ended["devices"][0]
        self.assertEqual(run.process.returncode, 75)
        self.assertGreater(device["late_renderings"], device["pings"] / 2, device)
        self.assertGreaterEqual(device["late_pings"], device["late_renderings"], device)
        self.assertLess(device["held_up_pings"], device["pings"] / 10, "but for a standstill of a busy machine")

    def test_nobody_watches_without_it(self):
        ended, status = self.stopped_run("--fail-late")
        self.assertNotIn("standstills", ended)
        self.assertEqual(ended["devices"][0]["held_up_pings"], 0)
        self.assertEqual(ended["devices"][0]["held_up_by_all"], 0)
        self.assertGreaterEqual(ended["devices"][0]["late_pings"], 1)
        self.assertEqual(status, 75)


if __name__ == "__main__":
    unittest.main()
