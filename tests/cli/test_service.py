"""What a service manager is told, and the group of a pseudo-terminal."""
import grp
import os
import signal
import socket
import stat
import subprocess
import time
import unittest

from program import PROGRAM, TANK, ProgramTest


class Service(ProgramTest):
    def start(self, name, *arguments, **environment):
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(listener.close)
        listener.bind(name.replace("@", "\0", 1))
        listener.settimeout(60)
        line = self.folder / "micron"
        run = subprocess.Popen([PROGRAM, "run", TANK, "--set", f"devices.0.endpoints=[\"pty:{line}{''.join(arguments)}\"]"],
                               env={**os.environ, "NOTIFY_SOCKET": name, **environment}, stdout=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        return run, listener, line

    def test_it_says_when_it_is_up_and_when_it_ends(self):
        for name in (str(self.folder / "notify"), f"@echoloop-test-{os.getpid()}"):
            run, listener, line = self.start(name)
            self.assertEqual(listener.recv(100), b"READY=1")
            self.assertTrue(line.is_symlink())
            run.send_signal(signal.SIGTERM)
            self.assertEqual(listener.recv(100), b"STOPPING=1")
            self.assertEqual(run.wait(60), 0)

    def test_it_says_that_it_is_alive_twice_as_often_as_it_must(self):
        _, listener, _ = self.start(str(self.folder / "notify"), WATCHDOG_USEC="200000")
        self.assertEqual(listener.recv(100), b"READY=1")
        begin = time.monotonic()
        for _ in range(11):
            self.assertEqual(listener.recv(100), b"WATCHDOG=1")
        self.assertGreater(time.monotonic() - begin, 0.9)

    def test_a_watchdog_of_another_process_is_not_meant(self):
        run, listener, _ = self.start(str(self.folder / "notify"), WATCHDOG_USEC="1000", WATCHDOG_PID="1")
        self.assertEqual(listener.recv(100), b"READY=1")
        run.send_signal(signal.SIGTERM)
        self.assertEqual(listener.recv(100), b"STOPPING=1")

    def test_a_group_may_open_the_line(self):
        group = grp.getgrgid(os.getgroups()[-1] if os.getgroups() else os.getgid())
        _, listener, line = self.start(str(self.folder / "notify"), f"?group={group.gr_name}")
        self.assertEqual(listener.recv(100), b"READY=1")
        found = line.stat()
        self.assertEqual((found.st_gid, stat.S_IMODE(found.st_mode)), (group.gr_gid, 0o660))

    def test_a_group_that_nobody_knows(self):
        text = self.bad(78, "run", TANK, "--set", f"devices.0.endpoints=[\"pty:{self.folder}/x?group=nobodys\"]")
        self.assertIn("there is no group nobodys; name one that `getent group` shows", text)


if __name__ == "__main__":
    unittest.main()
