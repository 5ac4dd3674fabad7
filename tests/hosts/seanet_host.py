#!/usr/bin/env python3
"""A SeaNet host on the command line: shakes hands in a known host's style, scans, checks, prints JSON lines.

    seanet_host.py /tmp/echoloop/micron --style mcgill --range 10 --bins 400 -n 200
    seanet_host.py tcp://127.0.0.1:9090 --style hostB -n 100 --do 30:reverse --do 60:range=5,bins=100

Exit status: 0 all lines came and had no fault, 1 a fault or a time limit, 64 wrong usage, 66 cannot open.
"""

import argparse
import json
import sys
import time
from dataclasses import dataclass, fields, replace

import seanet_wire as wire
from byte_line import LineClosed, LineStalled, open_line
from seanet_handshakes import HANDSHAKES
from seanet_session import HostConfused, HostTimeout, OutOfTime, Session
from seanet_styles import Settings


@dataclass(frozen=True)
class Pace:
    """How a style asks for lines: seconds it waits, misses before it gives up, lines it takes per request."""

    seconds: float
    misses: int = 0
    lines: int = 1
    configure_after: int = 0
    sends_time: bool = False


PACES = {
    "rock": Pace(1.5),
    "rock-main": Pace(1.0),
    "hostB": Pace(4.0),
    "mcgill": Pace(1.0, misses=20, configure_after=5, sends_time=True),
    "hostA": Pace(1.6, misses=10),
    "hostC": Pace(10.0, lines=2, sends_time=True),
    "delphin": Pace(2.0, misses=5),
}


def request(session):
    """Sends mtSendData with the time of day where the style fills it in."""
    midnight = int(time.time() * 1000) % 86_400_000 if PACES[session.style].sends_time else 0
    session.send(wire.send_data(midnight))


def read_requested(session):
    """Yields what one request gives (two lines for hostC). HostTimeout when the style gives up."""
    pace = PACES[session.style]
    for missed in range(pace.misses + 1):
        request(session)
        try:
            yield session.read_line(pace.seconds)
            break
        except HostTimeout:
            session.tell("missed", in_a_row=missed + 1)
            if missed == pace.misses:
                raise
            if pace.configure_after and (missed + 1) % pace.configure_after == 0:
                session.configure()
    for _ in range(pace.lines - 1):
        yield session.read_line(pace.seconds)


def scan(session, count, actions=(), report=None):
    """Reads `count` lines and performs the actions ([(line number, text)]) on the way."""
    waiting, number = sorted(actions, key=lambda action: action[0]), 0
    while number < count:
        while waiting and waiting[0][0] <= number:
            perform(session, waiting.pop(0)[1])
        for line, faults, jumped in read_requested(session):
            if report:
                report(number, line, faults, jumped)
            number += 1


def perform(session, text):
    """reverse, reboot, stop-alives, pause=S, noise=HEX, level=SPAN,LOW,GAIN, or settings k=v,k=v"""
    session.tell("action", text=text)
    name, _, value = text.partition("=")
    if name == "reverse":
        session.reverse()
    elif name == "stop-alives":
        session.send(wire.build(wire.STOP_ALIVES))
    elif name == "noise":
        session.send(bytes.fromhex(value))
    elif name == "pause":
        session.pass_time(float(value))
    elif name == "level":
        session.change_gain(*(int(v, 0) for v in value.split(",")))
    elif name == "reboot":
        session.send(wire.build(wire.REBOOT))
        session.pass_time(1.0)
        HANDSHAKES[session.style](session)
    else:
        session.configure(changed(session.settings, text))


def changed(settings, text):
    """Settings with `k=v,k=v` applied. ValueError for an unknown key or a value of the wrong type."""
    types = {f.name: f.type for f in fields(Settings)}
    values = {}
    for item in text.split(","):
        key, _, value = item.partition("=")
        if key not in types:
            raise ValueError(f"unknown action or setting '{key}'; settings: {', '.join(types)}")
        values[key] = value.lower() in ("1", "true", "yes") if types[key] is bool else types[key](value)
    return replace(settings, **values)


class Report:
    """Prints one JSON line a scan line and keeps what the summary says."""

    def __init__(self, session, skip_metres, print_bins):
        self.session, self.skip, self.print_bins = session, skip_metres, print_bins
        self.times, self.jumps, self.lines, self.directions = [], 0, 0, {1: 0, -1: 0}
        self.last_time = self.last_bearing = None

    def __call__(self, number, line, faults, jumped):
        now, metres = (
            self.session.line.now(),
            line.ad_interval * 640e-9 * self.session.settings.sound_speed / 2,
        )
        first = min(int(self.skip / metres) if metres else 0, max(0, len(line.levels) - 1))
        best = max(range(first, len(line.levels)), key=line.levels.__getitem__, default=0)
        waited = None if self.last_time is None else round((now - self.last_time) * 1e3, 2)
        if waited is not None:
            self.times.append(waited)
        if self.last_bearing is not None:
            self.directions[1 if (line.bearing - self.last_bearing) % 6400 < 3200 else -1] += 1
        self.last_time, self.last_bearing = now, line.bearing
        self.jumps, self.lines = self.jumps + jumped, self.lines + 1
        extra = {"levels": line.levels} if self.print_bins else {}
        self.session.tell(
            "line",
            i=number,
            dt_ms=waited,
            bearing=line.bearing,
            sweep=line.sweep,
            bins=len(line.levels),
            bin_m=round(metres, 6),
            strongest_bin=best,
            strongest_m=round((best + 0.5) * metres, 4),
            level=max(line.levels[first:], default=0),
            mean=round(sum(line.levels) / max(1, len(line.levels)), 3),
            jump=jumped,
            faults=faults,
            **extra,
        )

    def summary(self, error):
        ordered = sorted(self.times)
        self.session.tell(
            "summary",
            lines=self.lines,
            faults=self.session.faults,
            jumps=self.jumps,
            skipped_bytes=self.session.framer.skipped,
            counts=self.session.counts,
            median_ms=ordered[len(ordered) // 2] if ordered else None,
            least_ms=ordered[0] if ordered else None,
            most_ms=ordered[-1] if ordered else None,
            clockwise=self.directions[1],
            anticlockwise=self.directions[-1],
            error=error,
        )


def options():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n")[0],
        epilog=__doc__.split("\n\n", 1)[1],
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("uri", help="/path/of/pty, serial:///dev/ttyUSB0:115200 or tcp://host:port")
    parser.add_argument("--style", choices=sorted(HANDSHAKES), default="rock")
    parser.add_argument("--profile", choices=("dst", "miniking"), default="dst")
    parser.add_argument("-n", "--lines", type=int, default=50)
    for item in fields(Settings):
        name = "--" + item.name.replace("_", "-")
        if item.type is bool:
            parser.add_argument(name, action=argparse.BooleanOptionalAction, default=item.default)
        else:
            parser.add_argument(name, type=item.type, default=item.default)
    parser.add_argument("--nibble", choices=("high", "low"), default="high", help="nibble of the nearer bin")
    parser.add_argument("--do", action="append", default=[], metavar="N:ACTION", help=perform.__doc__)
    parser.add_argument("--skip", type=float, default=0.75, help="metres left out of the search for an echo")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for everything")
    parser.add_argument("--print-bins", action="store_true")
    return parser


def main(arguments=None):
    args = options().parse_args(arguments)
    settings = Settings(**{f.name: getattr(args, f.name) for f in fields(Settings)})
    try:
        actions = [(int(n), text) for n, _, text in (item.partition(":") for item in args.do)]
        line = open_line(args.uri)
    except (OSError, ValueError) as error:
        print(f"seanet_host: {error}", file=sys.stderr)
        return 66 if isinstance(error, OSError) else 64
    session = Session(
        line,
        args.style,
        settings,
        args.profile,
        args.nibble == "high",
        lambda event: print(json.dumps(event), flush=True),
        args.limit,
    )
    report, error = Report(session, args.skip, args.print_bins), None
    try:
        HANDSHAKES[args.style](session)
        session.tell("ready")
        scan(session, args.lines, actions, report)
        if args.style == "mcgill":
            session.send(wire.build(wire.REBOOT))
    except (HostTimeout, HostConfused, OutOfTime, LineClosed, LineStalled, ValueError) as reason:
        error = f"{type(reason).__name__}: {reason}"
    report.summary(error)
    line.close()
    return 1 if error or session.faults else 0


if __name__ == "__main__":
    sys.exit(main())
