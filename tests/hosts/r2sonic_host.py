#!/usr/bin/env python3
"""An R2Sonic control program on the command line: discovers, commands, listens, checks, prints JSON lines.

    r2sonic_host.py --gui 127.0.0.1:65400 --head 127.0.0.1:65500 --pings 20 --set RNG0=30 --set BOS0=1
    r2sonic_host.py --discover --pings 0
    r2sonic_host.py --images 2 --set AIH0=280 --set AIB0=30 --floor 7.5

Exit status: 0 all pings and images came and had no fault, 1 a fault or the time limit, 64 wrong usage,
66 a port cannot be bound.
"""

import argparse
import json
import math
import select
import socket
import sys
import time

import r2sonic_control as control
from r2sonic_reader import Reader, soundings

OFFSETS = (0, 1, 2, 3, 5, 6)


class Host:
    """Sockets of one GUI, at its base port and what R2Sonic counts from it. Every wait has a limit."""

    def __init__(self, gui, head=None, sim=None):
        self.gui, self.head, self.sim, self.reader = gui, head, sim, Reader()
        self._sockets, self._sender = {}, socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._sender.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        for offset in OFFSETS:
            receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self._sockets[receiver] = offset
            receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
            try:
                receiver.bind((gui[0], gui[1] + offset))
            except OSError:
                self.close()
                raise

    def send_commands(self, values, to_sim=False):
        """CMD0 to base + 2 of the head, or of the SIM."""
        address = self.sim if to_sim else self.head
        self._sender.sendto(control.command(values), (address[0], address[1] + 2))

    def discover(self, address, seconds=1.0):
        """Sends R2DD and gathers the R2DI that come back to the sender within `seconds`."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asker:
            asker.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
            asker.sendto(control.discovery(*self.gui), address)
            end, found = time.monotonic() + seconds, []
            while (left := end - time.monotonic()) > 0:
                if select.select([asker], [], [], left)[0]:
                    data, sender = asker.recvfrom(65536)
                    value, faults = control.read_identity(data)
                    found.append({**(value or {}), "from": "%s:%d" % sender, "faults": faults})
            return found

    def configure(self, serial, config_id, address):
        """Broadcasts R2DC for the device of that serial number."""
        self._sender.sendto(
            control.configuration(
                serial,
                config_id,
                self.gui,
                [self.head or ("0.0.0.0", 0)],
                [self.sim or ("0.0.0.0", 0)],
                [self.gui],
            ),
            address,
        )

    def poll(self, seconds):
        """Events of the datagrams that wait, or of the first that comes within `seconds`."""
        events = []
        for receiver in select.select(list(self._sockets), [], [], max(0.0, seconds))[0]:
            data, sender = receiver.recvfrom(65536)
            for event in self.reader.datagram(self._sockets[receiver], data):
                event["from"] = "%s:%d" % sender
                events.append(event)
        return events

    def close(self):
        for item in (*self._sockets, self._sender):
            item.close()


def describe_ping(ping, floor):
    """What one ping event says on a line; with `floor` the worst depth error within 60 deg, in per cent."""
    points, header = soundings(ping), ping.header
    good = [p for p in points if p["quality"] & 0xC]
    centre = min(good, key=lambda p: abs(p["angle"]), default=None)
    text = {
        name: header[name]
        for name in (
            "model",
            "serial",
            "ping",
            "range",
            "frequency",
            "power",
            "pulse",
            "gain",
            "spreading",
            "absorption",
            "sound_speed",
            "sample_rate",
            "period",
        )
    }
    text |= {
        "mode": ping.mode,
        "points": len(points),
        "good": len(good),
        "first_deg": math.degrees(ping.angles[0]),
        "last_deg": math.degrees(ping.angles[-1]),
        "nadir_depth": centre and round(centre["depth"], 4),
        "intensity": ping.intensity is not None,
        "gates": ping.gates is not None,
        "quality": {f"{q:X}": ping.quality.count(q) for q in sorted(set(ping.quality))},
    }
    if floor:
        inner = [p for p in good if abs(p["angle"]) <= math.radians(60)]
        worst = max((abs(p["depth"] - floor) for p in inner), default=math.inf)
        text |= {"within_60deg": len(inner), "worst_percent": round(100 * worst / floor, 3)}
    return text


def describe_image(image):
    """What one image event says on a line, with its strongest cell."""
    beam = max(range(image.shape[0]), key=lambda b: max(image.rows[b]))
    level = max(image.rows[beam])
    at = image.rows[beam].index(level)
    return {
        "ping": image.header["ping"],
        "beams": image.shape[0],
        "bins": image.shape[1],
        "samples": image.samples,
        "datagrams": image.datagrams,
        "bin_m": image.bin_metres(),
        "strongest_beam": beam,
        "strongest_bin": at,
        "strongest_m": round((at + 0.5) * image.bin_metres(), 4),
        "strongest_deg": round(math.degrees(image.header["angles"][beam]), 4),
        "level": level,
    }


def numbers(text):
    """{name: number} of NAME=VALUE,NAME=VALUE. ValueError with the reason."""
    values = {}
    for item in text.split(","):
        name, _, value = item.partition("=")
        if len(name) != 4:
            raise ValueError(f"'{name}' is no command: four characters, as RNG0=30")
        values[name] = float(value) if name in control.FLOAT_COMMANDS else int(value, 0)
    return values


def address(text):
    host, _, port = text.rpartition(":")
    return host, int(port)


def options():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n")[0],
        epilog=__doc__.split("\n\n", 1)[1],
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--gui", type=address, default=("127.0.0.1", 65400), help="own address and base port")
    parser.add_argument(
        "--head", type=address, default=("127.0.0.1", 65500), help="base port; commands go to + 2"
    )
    parser.add_argument("--sim", type=address, help="the SIM's address and base port")
    parser.add_argument("--pings", type=int, default=10)
    parser.add_argument("--images", type=int, default=0)
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="commands at the start"
    )
    parser.add_argument("--sim-set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument(
        "--do", action="append", default=[], metavar="PING:NAME=VALUE,..", help="commands later"
    )
    parser.add_argument("--discover", action="store_true")
    parser.add_argument("--configure", metavar="SERIAL", help="send R2DC to this device, then wait for R2DS")
    parser.add_argument("--broadcast", type=address, default=("127.255.255.255", control.CONFIGURATION_PORT))
    parser.add_argument("--floor", type=float, help="true depth of a flat floor below the array, m")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for everything")
    parser.add_argument("--print-points", action="store_true")
    return parser


def tell(event, started, args):
    """Prints one event; parts of images are counted only."""
    line = {"t": round(time.monotonic() - started, 4), **event}
    if "image" in event:
        line |= describe_image(line.pop("image"))
    elif event["event"] == "ping":
        ping = line.pop("ping")
        line |= describe_ping(ping, args.floor)
        if args.print_points:
            line["soundings"] = [[round(v, 5) for v in point.values()] for point in soundings(ping)]
    elif "gathered" in event:
        gathered = line.pop("gathered")
        if event["event"] == "part" and not event["faults"]:
            return
        line |= {"ping": gathered.header["ping"], "samples": gathered.total, "rows": len(gathered.rows)}
        line |= {"snippets": len(gathered.snippets)}
    elif event["event"] == "part" and not event["faults"]:
        return
    print(json.dumps(line), flush=True)


def run(host, args):
    """Commands and listens until all came or the limit is over. True when all came."""
    started, counts, later = (
        time.monotonic(),
        {"ping": 0, "image": 0, "R2DS": 0},
        [(int(n), numbers(text)) for n, _, text in (item.partition(":") for item in args.do)],
    )
    for text, to_sim in [(t, False) for t in args.set] + [(t, True) for t in args.sim_set]:
        host.send_commands(numbers(text), to_sim)
    if args.discover:
        for found in host.discover(args.broadcast):
            print(json.dumps({"event": "R2DI", **found}), flush=True)
            counts["R2DI"] = counts.get("R2DI", 0) + 1
    if args.configure:
        host.configure(args.configure, 0x5EA, args.broadcast)
    last = 0.0

    def done():
        return (
            counts["ping"] >= args.pings
            and counts["image"] >= args.images
            and (not args.discover or counts.get("R2DI"))
            and (not args.configure or counts["R2DS"])
        )

    while not done() and (left := started + args.limit - time.monotonic()) > 0:
        for event in host.poll(min(left, 1.0)):
            if event["event"] == "ping":
                event["dt_ms"], last = (
                    round((time.monotonic() - last) * 1e3, 2) if last else None,
                    time.monotonic(),
                )
            if event["event"] != "R2DS" or not args.configure or event.get("config_id") == 0x5EA:
                counts[event["event"]] = counts.get(event["event"], 0) + 1
            tell(event, started, args)
        while later and later[0][0] <= counts["ping"]:
            host.send_commands(later.pop(0)[1])
    reader = host.reader
    print(
        json.dumps(
            {
                "event": "summary",
                "complete": bool(done()),
                "counts": counts,
                "datagrams": reader.datagrams,
                "faults": reader.faults,
                "lost_pings": reader.lost,
                "stale_parts": reader.stale,
            }
        ),
        flush=True,
    )
    return bool(done())


def main(arguments=None):
    args = options().parse_args(arguments)
    try:
        host = Host(args.gui, args.head, args.sim)
    except OSError as error:
        print(f"r2sonic_host: {args.gui[0]}:{args.gui[1]}: {error}", file=sys.stderr)
        return 66
    try:
        return 0 if run(host, args) and not host.reader.faults else 1
    except ValueError as error:
        print(f"r2sonic_host: {error}", file=sys.stderr)
        return 64
    finally:
        host.close()


if __name__ == "__main__":
    sys.exit(main())
