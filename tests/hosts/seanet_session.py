"""One host's conversation with a SeaNet head: sends, waits with time limits and judges what comes back.

It keeps no thread and never waits without a limit. What happens is told to `emit` as dictionaries.
"""

from dataclasses import replace

import seanet_checks as checks
import seanet_wire as wire
from seanet_styles import HEAD_COMMANDS


class HostTimeout(Exception):
    """The head did not say in time what the host waits for."""


class HostConfused(Exception):
    """The head said something that this host cannot live with."""


class OutOfTime(Exception):
    """The whole conversation took longer than its limit. No retry catches this one."""


class Session:
    """The state that all styles share. `style` picks the HeadCommand, `profile` is dst or miniking."""

    def __init__(
        self,
        line,
        style,
        settings,
        profile="dst",
        high_nibble_first=True,
        emit=lambda event: None,
        limit=300.0,
    ):
        self.line, self.style, self.settings, self.profile, self.emit = line, style, settings, profile, emit
        self.high_nibble_first = high_nibble_first
        self.framer, self.alive, self.faults = wire.Framer(), None, 0
        self.command, self.previous, self.started = None, None, line.now()
        self.outdated, self.late_lines, self.deadline = None, 0, self.started + limit
        self.counts = {}

    def send(self, data):
        self.line.write(data)

    def configure(self, settings=None):
        """Sends the style's mtHeadCommand; the replies are held against it from now on."""
        if settings is not None:
            self.settings = settings
        self.expect(HEAD_COMMANDS[self.style](self.settings))
        self.previous = None
        self.send(self.command.encode())
        self.tell(
            "configured",
            interval=self.command.ad_interval,
            bins=self.command.bins,
            control=self.command.control,
            hex=self.command.encode().hex(),
        )

    def expect(self, command):
        """Holds replies against `command` from now on; a few lines already under way may show the old one."""
        self.outdated, self.late_lines, self.command = self.command, 3, command

    def reverse(self):
        """Sends type 0x0F, which toggles scanright."""
        self.send(wire.reverse_scan())
        self.expect(replace(self.command, control=self.command.control ^ wire.SCAN_RIGHT))

    def change_gain(self, ad_span, ad_low, gain):
        """Sends type 0x1E; values as on the wire (span and low 0..255, gain 0..210)."""
        self.send(wire.gain_block(ad_span, ad_low, gain))
        self.expect(replace(self.command, ad_span=ad_span, ad_low=ad_low, gain=(gain, gain)))

    def wait(self, seconds, *messages, where=lambda frame: True):
        """The next frame of one of `messages` for which `where` holds. HostTimeout after `seconds`."""
        end = min(self.line.now() + seconds, self.deadline)
        while True:
            frame = self.framer.next()
            if frame is not None:
                self._note(frame)
                if frame.message in messages and where(frame):
                    return frame
            elif (left := end - self.line.now()) > 0:
                self.framer.feed(self.line.read(left))
            elif end == self.deadline:
                raise OutOfTime(f"the limit of {self.deadline - self.started:g} s is over")
            else:
                raise HostTimeout(f"no {' or '.join(wire.NAMES[m] for m in messages)} within {seconds} s")

    def wait_alive(self, seconds, where=lambda alive: True, gap=None):
        """The next mtAlive for which `where` holds; with `gap`, no two may lie further apart than that."""
        end = self.line.now() + seconds
        while True:
            left = max(0.0, end - self.line.now())
            self.wait(left if gap is None else min(gap, left), wire.ALIVE)
            if where(self.alive):
                return self.alive

    def pass_time(self, seconds):
        """Reads and notes whatever comes for `seconds`."""
        try:
            self.wait(seconds, wire.ALIVE, where=lambda frame: False)
        except HostTimeout:
            return

    def tell(self, event, **values):
        self.emit({"event": event, "t": round(self.line.now() - self.started, 4), **values})

    def _note(self, frame):
        self.counts[frame.name] = self.counts.get(frame.name, 0) + 1
        faults = checks.frame_faults(frame)
        if frame.message == wire.ALIVE and (alive := wire.read_alive(frame)) is not None:
            self.alive = alive
            faults += checks.alive_faults(alive)
            self.tell(
                "alive",
                head_inf=f"{alive.head_inf:02X}",
                params=f"{alive.params_byte:02X}",
                position=alive.position,
                head_ms=alive.head_ms,
                faults=faults,
            )
        elif frame.message != wire.HEAD_DATA:
            self.tell(frame.name, bytes=len(frame.raw), hex=frame.payload[:16].hex(), faults=faults)
        elif faults:
            self.tell("fault", message=frame.name, faults=faults)
        self.faults += len(faults)

    def device_type(self):
        """Device type byte that HeadData must carry."""
        return 0x11 if self.profile == "dst" else self.command.head_type

    def read_line(self, seconds):
        """The next scan line, checked: (HeadData, faults, jumped). HostTimeout after `seconds`."""
        frame = self.wait(seconds, wire.HEAD_DATA)
        line = wire.read_head_data(frame, self.high_nibble_first)
        if line is None:
            raise HostConfused(f"HeadData of {len(frame.raw)} bytes has lengths that disagree")
        faults = checks.line_faults(line, self.command, self.device_type())
        if faults and self._is_late(line):
            self.late_lines -= 1
            return line, [], False
        self.outdated = None
        jumped = checks.is_jump(line, self.previous, self.command)
        self.faults += len(faults)
        self.previous = line
        return line, faults, jumped

    def _is_late(self, line):
        if self.outdated is None or self.late_lines == 0:
            return False
        return not checks.line_faults(line, self.outdated, self.device_type())
