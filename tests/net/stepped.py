"""A stepped run of some devices with scripted drivers and a vehicle that moves, and everything that came of it: the words
on each wire by step, the recording, the truth and the program's own text."""

import json
import math
import re
import signal
import subprocess
from typing import NamedTuple

from lines import Datagrams, Ends, Pty, Tcp
from pcapng import masked_ports, sorted_by_interface
from place import environment
from stepper import Refused, Stepper

STEPS_PORT = 9501
LONG = 3_000_000  # bytes of a recording of which only the summary is inspected
SCENARIO = """scene: config/scenes/{scene}.glb
seed: {seed}
water: {{temperature: 10, salinity: 35, ph: 8}}
vehicle: {{{vehicle}}}
clock: {{mode: stepped, input: "tcp-listen://127.0.0.1:9501"}}
devices:
{devices}
{more}
"""
# What a run says of the machine and not of the sonars.
MACHINE = re.compile(
    r"(?m)/dev/pts/\d+|^(renderer|  (time )?after they were due).*$|; \d+ held up.*$|at most \d+ messages? at once|"
    r'"(renderer|late_\w+|held_up\w*|longest_held_up_s|\w+_lateness_s|most_waiting\w*)":("[^"]*"|[^,}]*),'
)


class Device(NamedTuple):
    """`ports`: {name: ("tcp", port), ("pty", link), ("udp", own port, device's port or None) or ("broadcast", port)};
    `words`: [(port, bytes) or None], one for each step; an empty list of bytes says nothing."""

    name: str
    model: str
    endpoints: list
    ports: dict
    words: list
    pitch: float = 0
    options: str = ""

    def text(self):
        return (f"  - {{name: {self.name}, model: {self.model}, mount: {{rpy_deg: [0, {self.pitch}, 0]}}, "
                f"endpoints: {json.dumps(self.endpoints)}, options: {{{self.options}}}}}")


class Run(NamedTuple):
    devices: list
    scene: str = "tank"
    at: tuple = (0, 0, -2)
    steps: int = 0  # 0: until all words are said, and three more
    interval: float = 0.25
    seed: int = 3
    vehicle: str = ""  # instead of poses by the steps
    more: str = ""  # of the scenario
    files: dict = {}

    def scenario(self):
        vehicle = self.vehicle or f"pose: {{position: {list(self.at)}}}"
        return SCENARIO.format(scene=self.scene, seed=self.seed, vehicle=vehicle, more=self.more,
                               devices="\n".join(d.text() for d in self.devices))

    def pose(self, n):
        """A vehicle that creeps about and rolls, so that no two pictures are the same."""
        if self.vehicle:
            return {}
        x, y, z = self.at
        return {"position": [x + 0.05 * math.sin(n), y + 0.04 * n % 0.5, z - 0.03 * math.cos(0.7 * n)],
                "rpy_deg": [3 * math.sin(0.9 * n), 2 * math.cos(1.1 * n), 4 * math.sin(0.3 * n)]}


def line_of(kind, *numbers, folder):
    if kind == "tcp":
        return Tcp(*numbers)
    if kind == "pty":
        return Pty(folder.path / numbers[0])
    if kind == "broadcast":
        return Datagrams(numbers[0], address="127.255.255.255")
    return Datagrams(*numbers)


class Log:
    """Lines of JSON: who said what in which step."""

    def __init__(self):
        self.lines, self.heard = [], {}

    def add(self, step, what, name, data):
        self.lines.append(json.dumps({"step": step, what: name, "hex": data.hex()}))
        if what == "heard":
            self.heard[name] = self.heard.get(name, 0) + len(data)

    def note(self, **values):
        self.lines.append(json.dumps(values))


def drive(run, folder, log):
    """Says and hears everything; closes the ends."""
    ends = Ends({f"{d.name}/{p}": line_of(*spec, folder=folder) for d in run.devices for p, spec in d.ports.items()})
    steps = run.steps or max(len(d.words) for d in run.devices) + 3
    try:
        with Stepper(STEPS_PORT) as simulator:
            for n in range(steps):
                simulator.send(now=round(n * run.interval, 6), **run.pose(n))
                ends.read_until(simulator.socket)
                answer = simulator.answer()
                for name, pieces in ends.take(answer["sent"]).items():
                    for piece in pieces:
                        log.add(n, "heard", name, piece)
                log.note(step=n, sent=answer["sent"], **({"unheard": ends.unheard} if any(ends.unheard.values()) else {}))
                for device in run.devices if n + 1 < steps else []:  # who knows whether the end comes before the last word
                    if n < len(device.words) and device.words[n] is not None:
                        port, data = device.words[n]
                        ends.lines[f"{device.name}/{port}"].write(data)
                        log.add(n, "said", f"{device.name}/{port}", data)
    except TimeoutError:
        raise  # a step that never ends is no record
    except (Refused, EOFError, OSError) as error:
        log.note(error=str(error))
    finally:
        ends.close()


def started(process):
    """Output up to the line that says how to end it, or all of it where the program has ended."""
    text = b""
    while not is_ready(text) and (line := process.stdout.readline()):
        text += line
    return text


def is_ready(text):
    return b"Ctrl-C" in text or text[:1] == b"{"


def recorded(program, run, folder, is_brief=False):
    """{name: bytes} of all that came of a run; a brief one is not recorded by the program itself."""
    scenario = run.scenario().replace("{folder}", str(folder.path))
    (folder.path / "run.yaml").write_text(scenario)
    for name, text in run.files.items():
        (folder.path / name).write_text(text)
    names = {} if is_brief else {"recording.pcapng": "--record", "truth.jsonl": "--truth", "labels.jsonl": "--labels"}
    arguments = ["--json"] if is_brief else ["--record-truth"]
    arguments += [word for name, option in names.items() for word in (option, name)]
    process = subprocess.Popen(["echoloop", "run", "run.yaml", *arguments], executable=program, cwd=folder.path, env=environment(),
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    log = Log()
    try:
        output = started(process)
        if is_ready(output):
            drive(run, folder, log)
            process.send_signal(signal.SIGINT)
        output += process.communicate(timeout=60)[0]
    finally:
        process.kill()
    out = {"scenario.yaml": scenario.encode(), "wire.jsonl": ("\n".join(log.lines) + "\n").encode()}
    out["output.txt"] = MACHINE.sub("", output.decode()).encode() + b"status %d\n" % process.returncode
    for name in names:
        if (folder.path / name).exists():
            out[name] = (folder.path / name).read_bytes()
    if "recording.pcapng" in out:
        recording = out["recording.pcapng"] if len(run.devices) == 1 else sorted_by_interface(out["recording.pcapng"])
        out["recording.pcapng"] = masked_ports(recording)
        (folder.path / "recording.pcapng").write_bytes(recording)
        more = ["--summary"] if len(out["recording.pcapng"]) > LONG else []
        out["inspected.txt"] = subprocess.run(["echoloop", "inspect", "recording.pcapng", *more], executable=program, cwd=folder.path,
                                              env=environment(), capture_output=True).stdout
    out["heard.json"] = json.dumps(log.heard, indent=1).encode()
    return {name: folder.masked(data) for name, data in out.items()}
