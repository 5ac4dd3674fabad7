"""Hosts of Imagenex heads in the manners of known ones: they ask, and wait for what they expect. None of them knows the
C++."""

import time

import imagenex_wire as wire


class NoReply(Exception):
    """Nothing, or not enough, within the host's time."""


class Host:
    """Reads by the count in the reply, as the serial interface specification says."""

    def __init__(self, line, seconds=2.0):
        self.line, self.seconds, self.kept = line, seconds, b""

    def ask(self, command, bits=8):
        self.line.write(command)
        data = self.read(12)
        data += self.read(wire.reply_size(data) - 12)
        reply = wire.parse(data, bits)
        assert reply.head_id == command[2], "another head"
        return reply

    def read(self, count):
        """Exactly `count` bytes; NoReply after the host's time."""
        data, end = b"", time.monotonic() + self.seconds
        while len(data) < count:
            left = end - time.monotonic()
            if left <= 0:
                raise NoReply(f"{len(data)} of {count} bytes")
            data += self.read_some(count - len(data), left)
        return data

    def read_some(self, most, seconds):
        if not self.kept:
            self.kept = self.line.read(seconds)
        taken, self.kept = self.kept[:most], self.kept[most:]
        return taken

    def silence(self, seconds):
        """What comes unasked."""
        end, data = time.monotonic() + seconds, b""
        while (left := end - time.monotonic()) > 0:
            data += self.line.read(left)
        return data


class ReadsUntilFC(Host):
    """A known Python host of the 881A: flushes its input, sends, reads until the first FC; 1 s, five tries 0.25 s
    apart. Ends a turn when the angle is back within half a step of the first one for the second time."""

    def __init__(self, line):
        super().__init__(line, seconds=1.0)

    def ask(self, command, bits=8):
        for _ in range(5):
            self.line.flush_input()
            self.kept = b""
            self.line.write(command)
            data, end = b"", time.monotonic() + self.seconds
            while not data.endswith(b"\xfc") and time.monotonic() < end:
                data += self.read_some(1, end - time.monotonic())
            if data.endswith(b"\xfc"):
                return wire.parse(data, bits)
            time.sleep(0.25)
        raise NoReply("five tries")

    def turn(self, **settings):
        """All shots of a turn, the one that ends it included."""
        half_step, shots, seen = 0.15 * settings["step"], [], 0
        while seen < 2:
            shots.append(self.ask(wire.command(**settings), settings.get("bits", 8)))
            away = (shots[-1].degrees - shots[0].degrees + 180) % 360 - 180
            seen += abs(away) < half_step
        return shots


class Reads513(Host):
    """A known ROS1 host of the 852: always wants 513 bytes and waits a second for them, then pauses 50 ms."""

    SIZE, PAUSE = 513, 0.05

    def __init__(self, line):
        super().__init__(line, seconds=1.0)

    def shot(self, **settings):
        """(altitude in m or None if it is lost, seconds)"""
        start = time.monotonic()
        self.line.write(wire.sounder_command(**{"range": 5, "gain": 14, "pulse": 100, "delay": 1, **settings}))
        try:
            reply = wire.parse(self.read(self.SIZE))
            altitude = reply.profile / 100 or None
        except NoReply:
            altitude = None
            self.kept = b""
            self.line.flush_input()
        seconds = time.monotonic() - start
        time.sleep(self.PAUSE)
        return altitude, seconds
