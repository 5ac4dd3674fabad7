"""Loopback ports for tests that run side by side. A port given out belongs to the asking process until it ends: the kernel
keeps a name for each, so that no two tests get the same between asking and binding. All lie below those that the kernel
picks by itself for whoever connects or binds to port 0, and none is one whose bytes tshark takes for another protocol's."""

import atexit
import random
import socket

FIRST, END = 20001, 30000
KNOWN_TO_TSHARK = {
    20256, 20561, 21064, 22222, 23272, 24576, 24577, 24800, 25826, 26000, 27017, 27036, 27500, 27910,
    27950, 27951, 27952, 27953, 27960, 27961, 27962, 27963, 29418,
}
_owned = []  # sockets that hold the names


@atexit.register
def _give_back():
    while _owned:
        _owned.pop().close()


def _own(port):
    """Whether this process is now the port's only owner (of its network namespace's, as ports are)."""
    name = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        name.bind(f"\0echoloop-tests-port-{port}")
    except OSError:
        name.close()
        return False
    _owned.append(name)
    return True


def _is_free(port):
    """Neither a UDP nor a TCP socket of another program is bound to it."""
    for kind in (socket.SOCK_DGRAM, socket.SOCK_STREAM):
        with socket.socket(socket.AF_INET, kind) as s:
            try:
                s.bind(("127.0.0.1", port))
            except OSError:
                return False
    return True


def _take(base, count):
    owned_before = len(_owned)
    if all(_own(port) and _is_free(port) for port in range(base, base + count)):
        return True
    while len(_owned) > owned_before:
        _owned.pop().close()
    return False


def free_port(count=1, avoid=()):
    """A port that is free together with the `count` - 1 above it, for UDP and TCP; none of them is in `avoid`."""
    bases = range(FIRST, END - count, count)
    for base in random.sample(bases, len(bases)):
        if any(port in KNOWN_TO_TSHARK or port in avoid for port in range(base, base + count)):
            continue
        if _take(base, count):
            return base
    raise RuntimeError(f"no {count} ports in a row are free between {FIRST} and {END}")
