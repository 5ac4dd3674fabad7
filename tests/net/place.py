"""Where a run of the net takes place: a network and ptys of its own, so that their numbers are the same every time whatever else
runs on the machine, and a folder whose name is masked in everything that is recorded."""

import ctypes
import fcntl
import os
import re
import shutil
import socket
import struct
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
for folder in ("tests/hosts", "tests/e2e"):
    sys.path.insert(0, str(ROOT / folder))

NEW_PLACE, NEW_USER = 0x40000000 | 0x00020000, 0x10000000  # CLONE_NEWNET and CLONE_NEWNS, CLONE_NEWUSER
PRIVATE = 0x4000 | 0x40000  # MS_REC, MS_PRIVATE
SET_FLAGS, UP = 0x8914, 0x49  # SIOCSIFFLAGS; IFF_UP, IFF_LOOPBACK, IFF_RUNNING
FIRST_EPHEMERAL, LAST_EPHEMERAL = 61000, 61999  # ports of the kernel's choice
EPHEMERAL = re.compile(rb":61\d{3}\b")


def enter_place():
    """Moves this process into an empty network with a loopback, where the first pty is /dev/pts/0. OSError where the system
    allows no such thing."""
    libc = ctypes.CDLL(None, use_errno=True)
    pts = (b"devpts", b"/dev/pts", b"devpts", 0, b"newinstance,ptmxmode=0666,mode=0620")
    if libc.unshare(NEW_PLACE) != 0 and libc.unshare(NEW_USER | NEW_PLACE) != 0:
        raise OSError(ctypes.get_errno(), "cannot make a network and a /dev/pts of its own (unshare)")
    if libc.mount(b"none", b"/", None, PRIVATE, None) != 0 or libc.mount(*pts) != 0:
        raise OSError(ctypes.get_errno(), "cannot mount a /dev/pts of its own")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        fcntl.ioctl(s, SET_FLAGS, struct.pack("16sh14x", b"lo", UP))
    Path("/proc/sys/net/ipv4/ip_local_port_range").write_text(f"{FIRST_EPHEMERAL} {LAST_EPHEMERAL}")


class Folder:
    """A temporary folder with the project's config/ in it. Its name has the same length every time."""

    def __init__(self):
        self.path = Path(tempfile.mkdtemp(prefix="echoloop-net-", dir="/tmp"))
        shutil.copytree(ROOT / "config", self.path / "config")

    def masked(self, data):
        """Bytes in which the folder, and ports that the kernel chose, have names that every run has, as long as before."""
        return EPHEMERAL.sub(b":61___", data.replace(str(self.path).encode(), b"/tmp/echoloop-net-" + b"_" * 8))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)


def environment():
    """That of the program: no colours."""
    return {**os.environ, "NO_COLOR": "1"}
