"""A minimal SeaNet head in virtual time to try the hosts against; it renders nothing and is no emulator.

It holds one echo, at `wall` metres on every bearing, so that a test knows which bin must be strongest.
"""

import struct

import seanet_wire as wire
from byte_line import LineClosed

ALIVE_SECONDS, LINE_SECONDS, CENTRING_ALIVES = 1.0, 0.04, 3


def frame(message, payload, count_byte=None):
    """A frame from the head to the host."""
    count = len(payload) + 8
    return (
        b"@%04X" % count
        + struct.pack(
            "<HBBBBBB",
            count,
            2,
            0xFF,
            (count - 5) & 0xFF if count_byte is None else count_byte,
            message,
            0x80,
            2,
        )
        + payload
        + b"\n"
    )


class ScriptedHead:
    """`received` takes bytes at a time; `outbox` holds (time, bytes) in the order of sending."""

    def __init__(self, dst=True, wall=4.0, replies=2):
        self.dst, self.wall, self.replies = dst, wall, replies
        self.outbox, self.heard, self._framer, self._quiet_until = [], [], wire.Framer(), 0.0
        self._boot(0.0)

    def _boot(self, now):
        self.command, self.bearing, self.clockwise, self.pending, self.busy_until = (
            None,
            3200,
            True,
            False,
            0.0,
        )
        self.sent_cfg, self.alives, self.next_alive = False, 0, now + ALIVE_SECONDS
        self.outbox = [item for item in self.outbox if item[0] <= now]

    def received(self, data, now):
        self._framer.feed(data)
        while (got := self._framer.next()) is not None:
            self.heard.append(got)
            handler = {
                wire.REBOOT: self._reboot,
                wire.SEND_VERSION: self._version,
                wire.SEND_BB_USER: self._bb,
                wire.HEAD_COMMAND: self._configure,
                wire.SEND_DATA: self._data,
            }.get(got.message)
            if handler:
                handler(got, now)

    def woken(self, now):
        """Sends the alives that are due at `now`."""
        while self.next_alive <= now:
            if self.next_alive >= self._quiet_until:
                self._alive(self.next_alive)
            self.next_alive += ALIVE_SECONDS

    def _alive(self, now):
        self.alives += 1
        centring = self.alives <= CENTRING_ALIVES
        inf = (0x5D if self.alives == 1 else 0x4D) if centring else 0x4A
        ready = self.command is not None and not centring
        inf = (inf | (0x80 if self.sent_cfg else 0)) & ~(0x40 if ready else 0)
        body = struct.pack("<BIHB", 0 if ready else 0x80, int(now * 1000), self.bearing, inf)
        self.outbox.append((now, frame(wire.ALIVE, body)))

    def _reboot(self, _got, now):
        self._boot(now)

    def _version(self, _got, now):
        self.outbox.append(
            (now, frame(wire.VERSION_DATA, struct.pack("<BBHIHB", 5, 1, 777, 0x8000, 0xBEEF, 2)))
        )

    def _bb(self, _got, now):
        self.sent_cfg = True
        body = bytearray(250)
        body[19 - 13] = 0x0F if self.dst else 0
        self.outbox.append((now, frame(wire.BB_USER_DATA, bytes(body))))
        if self.dst:
            self.outbox.append((now, frame(wire.FPGA_CAL_DATA, bytes(66))))
            self.outbox.append((now, frame(wire.FPGA_VERSION_DATA, bytes(14))))

    def _configure(self, got, now):
        kind = got.payload[0]
        if kind == 0x0F:
            self.clockwise = not self.clockwise
        elif kind in (0x01, 0x1D):
            self.command, self.sent_cfg = got.raw, True
            self.clockwise = bool(got.raw[14] & wire.SCAN_RIGHT)
        self._alive(now)

    def _data(self, _got, now):
        if self.command is None or self.alives <= CENTRING_ALIVES:
            return
        self._quiet_until = now + 1.0
        if now < self.busy_until:
            self.pending = True
            return
        start = now
        for _ in range(self.replies * (2 if self.pending else 1)):
            start += LINE_SECONDS
            self.outbox.append((start, self._line()))
        self.pending, self.busy_until = False, start

    def _line(self):
        raw = self.command
        (control,), (left, right) = struct.unpack_from("<H", raw, 14), struct.unpack_from("<HH", raw, 37)
        step, (interval, bins) = raw[50], struct.unpack_from("<HH", raw, 51)
        levels = [0] * bins
        wall = int(self.wall / (interval * 640e-9 * 750))
        if wall < bins:
            levels[wall] = 0xC0 if control & wire.ADC8ON else 0xC
        if not control & wire.ADC8ON:
            levels += [0] * (bins % 2)
            levels = [levels[i] << 4 | levels[i + 1] for i in range(0, len(levels), 2)]
        self.bearing = (self.bearing + (step if self.clockwise else -step)) % 6400
        body = (
            struct.pack(
                "<HBBB",
                len(levels) + 31,
                0x11 if self.dst else raw[16],
                0x10 if control & wire.ADC8ON else 0,
                0,
            )
            + raw[14:16]
            + raw[35:37]
            + raw[17:21]
            + raw[43:44]
            + raw[45:47]
            + raw[41:43]
            + bytes(2)
            + raw[51:53]
            + struct.pack("<HHBHH", left, right, step, self.bearing, len(levels))
        )
        return frame(wire.HEAD_DATA, body + bytes(levels), count_byte=0)


class ScriptedLine:
    """Joins a host to a ScriptedHead. Time passes only while the host waits. `spoil` may alter replies."""

    def __init__(self, head, spoil=lambda data: data, lifetime=1e9):
        self.head, self._spoil, self._now, self._end = head, spoil, 0.0, lifetime

    def now(self):
        return self._now

    def write(self, data):
        self.head.received(data, self._now)

    def read(self, seconds):
        """The next reply due within `seconds`; the clock moves to it, or by `seconds` when there is none."""
        end = self._now + max(0.0, seconds)
        self.head.woken(end if not self.head.outbox else min(end, self.head.outbox[0][0]))
        self.head.outbox.sort(key=lambda item: item[0])
        if end > self._end:
            raise LineClosed("end of the script")
        if not self.head.outbox or self.head.outbox[0][0] > end:
            self._now = end
            return b""
        due, data = self.head.outbox.pop(0)
        self._now = max(self._now, due)
        return self._spoil(data)

    def flush_input(self):
        self.head.outbox = [item for item in self.head.outbox if item[0] > self._now]

    def close(self):
        """Nothing to close."""
