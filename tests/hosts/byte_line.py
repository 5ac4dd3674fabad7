"""A byte pipe to a device (tty, pty or TCP) whose every read has a time limit; it knows no protocol."""

import errno
import os
import select
import socket
import termios
import time
import tty


class LineClosed(Exception):
    """The other end is gone."""


class LineStalled(Exception):
    """The other end takes no bytes."""


class ByteLine:
    """Reads and writes an open, non-blocking file descriptor. `owner` is closed with it."""

    WRITE_SECONDS = 5.0

    def __init__(self, fd, owner=None, is_tty=False):
        self._fd = fd
        self._owner = owner
        self._is_tty = is_tty

    def now(self):
        """Seconds of the monotonic clock that the time limits refer to."""
        return time.monotonic()

    def read(self, seconds):
        """Bytes that arrive within `seconds` (the first read that gives any), or b"" when none do."""
        ready, _, _ = select.select([self._fd], [], [], max(0.0, seconds))
        if not ready:
            return b""
        try:
            data = os.read(self._fd, 65536)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise LineClosed(os.strerror(error.errno)) from error
        if not data:
            raise LineClosed("end of file")
        return data

    def write(self, data):
        """Writes all of `data`; LineStalled after WRITE_SECONDS, LineClosed when the end is gone."""
        end = self.now() + self.WRITE_SECONDS
        while data:
            _, ready, _ = select.select([], [self._fd], [], max(0.0, end - self.now()))
            if not ready:
                raise LineStalled(f"{len(data)} bytes not taken in {self.WRITE_SECONDS} s")
            try:
                data = data[os.write(self._fd, data) :]
            except BlockingIOError:
                continue
            except OSError as error:
                raise LineClosed(os.strerror(error.errno)) from error

    def flush_input(self):
        """Throws away what was received and not read yet."""
        if self._is_tty:
            termios.tcflush(self._fd, termios.TCIFLUSH)
            return
        while self.read(0):
            pass

    def set_baud(self, baud):
        """The rate of a terminal from now on."""
        attributes = termios.tcgetattr(self._fd)
        attributes[4] = attributes[5] = getattr(termios, f"B{baud}")
        termios.tcsetattr(self._fd, termios.TCSANOW, attributes)

    def close(self):
        if self._owner is not None:
            self._owner.close()
        elif self._fd is not None:
            os.close(self._fd)
        self._fd = None


def open_tty(path, baud=115200):
    """Opens a serial port or pty slave: raw, 8N1, no flow control. OSError when it cannot be opened."""
    speed = getattr(termios, f"B{baud}", None)
    if speed is None:
        raise ValueError(f"{baud} baud has no termios constant")
    fd = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        tty.setraw(fd)
        attributes = termios.tcgetattr(fd)
        attributes[2] |= termios.CLOCAL | termios.CREAD
        attributes[4] = attributes[5] = speed
        termios.tcsetattr(fd, termios.TCSANOW, attributes)
    except termios.error as error:
        os.close(fd)
        raise OSError(errno.ENOTTY, f"{path} is not a terminal") from error
    return ByteLine(fd, is_tty=True)


def open_line(uri, baud=115200, seconds=5.0):
    """Opens /path, serial:///path[:baud] or tcp://host:port. OSError or ValueError when it cannot."""
    if uri.startswith("tcp://"):
        host, _, port = uri[len("tcp://") :].rpartition(":")
        connection = socket.create_connection((host, int(port)), timeout=seconds)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.setblocking(False)
        return ByteLine(connection.fileno(), owner=connection)
    if uri.startswith("serial://"):
        uri = uri[len("serial://") :]
        path, _, tail = uri.rpartition(":")
        if path and tail.isdigit():
            return open_tty(path, int(tail))
    return open_tty(uri, baud)
