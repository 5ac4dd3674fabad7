"""One run of the program, and the sonars of it as a driver's test sees them."""

import json
import time
from dataclasses import dataclass, field
from pathlib import Path

from . import program
from .program import EcholoopError, Process, Talk

_PLACE = "tcp-listen://127.0.0.1:0"  # the program chooses a free port


@dataclass(frozen=True)
class Message:
    """A message on the wire, as the program decodes it."""

    time: float  # s since the first packet
    sent: bool  # by the sonar; else by the driver
    name: str
    fields: dict = field(repr=False)
    size: int = 0  # bytes
    reason: str = ""  # why it is no good message

    def __str__(self):
        who = "sonar " if self.sent else "driver"
        fields = " ".join(f"{k}={_short(v)}" for k, v in self.fields.items())
        return f"{self.time:10.4f} s  {who}  {self.name or 'bytes'} {self.reason or fields} ({self.size} bytes)"


def _short(value):
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    text = json.dumps(value) if isinstance(value, (list, dict)) else str(value)
    return text if len(text) <= 40 else text[:40] + "..."


class Run:
    """A run in a folder of its own, which keeps the scenario, capture.pcapng, truth.jsonl and stderr.txt."""

    def __init__(self, folder, file, settings, stepped):
        self.folder = folder
        self.capture = folder / "capture.pcapng"
        self._talks = {}
        changes = [f"--set={s}" for s in settings]
        if stepped:
            changes.append(f"--set=clock={{mode: stepped, input: '{_PLACE}'}}")
        for device in program.ask("check", file, *changes)["devices"]:
            ends = [self._own(end, device["name"]) for end in device["endpoints"]]
            changes.append(f"--set=devices.{device['name']}.endpoints={json.dumps(ends)}")
        self.process = Process([file, *changes, "--control", _PLACE, "--record", self.capture,
                                "--truth", folder / "truth.jsonl"], folder)
        self.started = self.process.started
        self.devices = {device["name"]: device for device in self.started["devices"]}

    def _own(self, end, name):
        """The same endpoint where no other test has one."""
        if end.startswith("pty:"):
            path, query, settings = end.partition("?")
            return f"pty:{self.folder}/{name}-{Path(path).name}{query}{settings}"
        if end.split(":")[0] in ("tcp-listen", "udp-listen"):
            return end.rpartition(":")[0] + ":0"
        return end

    def talk(self, what):
        place = self.started.get(what, "")
        if what == "control" and what not in self._talks:
            self._talks[what] = Talk(place)
            self._talks[what].ask({"token": self.started["control_token"]})
        if not place.startswith("tcp-listen:"):
            need = {"poses": f'vehicle: {{input: "{_PLACE}"}} in the scenario', "steps": "echoloop(..., stepped=True)"}
            raise EcholoopError(f"this run takes no {what} over TCP; it needs {need[what]}")
        place = self.started[what]
        if place not in self._talks and what != "control":
            self._talks[place] = Talk(place)  # one for poses and steps, if they have one place
        return self._talks[what if what == "control" else place]

    def lines(self, name):
        """Whole lines of JSON of a file that is being written."""
        try:
            text = (self.folder / name).read_text()
        except FileNotFoundError:
            return []
        return [json.loads(line) for line in text[: text.rfind("\n") + 1].splitlines()]

    def close(self):
        for talk in self._talks.values():
            talk.close()
        self._talks.clear()
        self.process.stop()


def _wait_for(count, timeout, what, get):
    """The program's files lie up to a second behind, and one that is just being written may not be read."""
    end = time.monotonic() + timeout
    while True:
        try:
            found, why = get(), None
        except EcholoopError as error:
            found, why = [], error
        if why is None and len(found) >= count:
            return found
        if time.monotonic() > end:
            raise why or EcholoopError(f"{len(found)} {what} after {timeout} s, where {count} were expected")
        time.sleep(0.05)


class Sonar:
    """A sonar that a driver can open. `sonar["name"]` is another one of the same scenario."""

    def __init__(self, run, name):
        self._run = run
        self._device = run.devices[name]
        self.name = name

    def __getitem__(self, name):
        if name not in self._run.devices:
            raise KeyError(f"the scenario has no device {name!r}; it has {', '.join(self._run.devices)}")
        return Sonar(self._run, name)

    @property
    def folder(self):
        """Where the run keeps its files: capture.pcapng, truth.jsonl, ..."""
        return self._run.folder

    @property
    def line(self):
        """Path of the serial line that the driver opens."""
        for port in self._device["ports"]:
            if port["transport"] == "pty":
                return port["path"]
        raise EcholoopError(f"{self.name} has no pty; its endpoints are {', '.join(self._device['endpoints'])}")

    @property
    def address(self):
        """(ip, port) of the first endpoint: where the driver connects or sends to, or is to listen."""
        end = self._device["endpoints"][0]
        if "://" not in end or end.startswith("serial:"):
            raise EcholoopError(f"{self.name} is on no network; its endpoint is {end}")
        host, _, port = end.split("?")[0].partition("://")[2].rpartition(":")
        return host, int(port)

    @property
    def ports(self):
        """{name: port} as `run --json` tells them: {"transport", "host" and "port", or "path"}."""
        return {port["name"]: port for port in self._device["ports"]}

    def fault(self, kind, seconds=None, **parameters):
        """Makes something go wrong from now on, for so many seconds of the run; None: for the rest of it. Kinds and
        their parameters: `echoloop list --faults`. Returns a number for heal()."""
        asked = {"device": self.name, "kind": kind, **parameters}
        if seconds is not None:
            asked["for"] = seconds
        return self._run.talk("control").ask({"fault": asked})["id"]

    def heal(self, number="all"):
        """Ends a fault, or all of them."""
        self._run.talk("control").ask({"clear": number})

    def pose(self, position=None, rpy_deg=None):
        """Puts the vehicle somewhere, at rest: [east, north, up] in m; roll, pitch and yaw in degrees. With a stepped
        clock: at the end of the next step."""
        told = {k: list(v) for k, v in (("position", position), ("rpy_deg", rpy_deg)) if v is not None}
        talk = self._run.talk("poses")
        talk.say(told)
        if "steps" not in self._run.started:
            time.sleep(0.01)  # the same pose twice: it does not move on as it came
            talk.say(told)

    def step(self, seconds, **pose):
        """Lets so much time of the run pass (stepped=True). Returns when everything due by then is on its way."""
        talk = self._run.talk("steps")
        if not hasattr(self._run, "now"):
            self._run.now = 0.0
            talk.ask({"now": 0})  # powers the devices up
        self._run.now = round(self._run.now + seconds, 9)
        return talk.ask({"now": self._run.now, **pose})

    def truth(self, count=1, timeout=10):
        """What was really there at each ping so far, as docs/truth.md describes it; waits until there are `count`."""
        return _wait_for(count, timeout, f"pings of {self.name}",
                         lambda: [t for t in self._run.lines("truth.jsonl") if t.get("device") == self.name])

    def messages(self, name=None, count=1, timeout=10):
        """The messages on the wire so far, of one name or of all; waits until there are `count`."""
        return _wait_for(count, timeout, f"messages {name or ''} of {self.name}",
                         lambda: [m for m in self._decoded() if name in (None, m.name)])

    def _decoded(self):
        capture = self._run.capture
        if not capture.exists():
            return []
        try:
            decoded = program.ask("inspect", capture, "--family", self._device["family"])
        except EcholoopError as error:
            if "no message of a known protocol" in str(error):
                return []
            raise
        return [found for m in decoded["messages"] if (found := self._mine(m))]

    def _mine(self, m):
        """None if it is another sonar's."""
        if line := m.get("line"):
            if not line.startswith(f"{self.name} "):
                return None
            sent = line.endswith(", sent")
        elif "from" not in m:
            return None  # the beginning of a capture that is just being written
        else:
            own = {f"{p['host']}:{p['port']}" for p in self._device["ports"] if "host" in p}
            if m["from"] not in own and m["to"] not in own:
                return None
            sent = m["from"] in own
        fields = {f["name"]: f["value"] for f in m["fields"]}
        return Message(m["time"], sent, m["name"], fields, m["size"], m["reason"])
