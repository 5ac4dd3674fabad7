"""What the program prints: help, lists, checks of scenarios, endpoints, frames that it reads, mistakes that it finds."""

import json
import shlex
import shutil
import subprocess

from place import ROOT, environment
from talkers import golden

VERBS = ("run", "check", "list", "endpoints", "fault", "render", "inspect", "convert", "diff", "dissector", "record", "replay",
         "bench", "validate", "doctor")  # fmt: skip
FORMATS = ("ros1", "ros2", "moos", "rock", "dune", "sitl")
FAMILIES = sorted(folder.name for folder in (ROOT / "protocols").iterdir() if folder.is_dir())
TANK = "config/tank.yaml"


class Shell:
    """Runs the program in the folder and writes down what it says."""

    def __init__(self, program, folder):
        self.program, self.folder, self.text = program, folder, b""

    def run(self, *arguments, stdin=b""):
        done = subprocess.run(["echoloop", *map(str, arguments)], executable=self.program, cwd=self.folder.path,
                              env=environment(), input=stdin, capture_output=True, timeout=600)  # fmt: skip
        self.text += b"$ echoloop %s\n%s%s(status %d)\n\n" % (
            shlex.join(map(str, arguments)).encode(), done.stdout, done.stderr, done.returncode)  # fmt: skip
        return done.stdout


def help_texts(shell):
    shell.run("--help")
    shell.run("--version")
    for verb in VERBS:
        shell.run(verb, "--help")


def lists(shell):
    for arguments in ((), ("--all",), ("--json",), ("--faults",), ("--faults", "--json")):
        shell.run("list", *arguments)


def scenario(name):
    def texts(shell):
        file = f"config/{name}.yaml"
        for more in ((), ("--json",)):
            shell.run("check", file, *more)
            shell.run("endpoints", file, *more)
            for form in FORMATS:
                shell.run("endpoints", file, "--format", form, *more)

    return texts


def frames(family):
    """Every file of a folder of tests/data, as text and as JSON."""

    def texts(shell):
        for file in sorted((ROOT / "tests" / "data" / family).glob("*.hex")):
            data = golden(f"{family}/{file.stem}")
            shell.text += f"## {file.name}\n".encode()
            for arguments in ((), ("--json",), ("--summary",)):
                shell.run("inspect", "-", *arguments, stdin=data)
            shell.run("inspect", "-", stdin=b"noise" + data + data[:-3])

    return texts


def tables(shell):
    for family in FAMILIES:
        shell.run("inspect", "--tables", family)
    shell.run("dissector")


def scenario_mistakes(shell):
    """The cases of tests/emulator/scenario/faults.txt."""
    text = (ROOT / "tests" / "emulator" / "scenario" / "faults.txt").read_text()
    shutil.copy(ROOT / "config" / "scenes" / "tank.glb", shell.folder.path / "s.glb")
    for case in text.split("\n=== ")[1:]:
        name, *lines = case.split("\n")
        shell.text += f"## {name}\n".encode()
        body = [line for line in lines if not line.startswith((">>> ", "+++ "))]
        (shell.folder.path / "t.yaml").write_text("\n".join(body))
        sets = [word for line in lines if line.startswith("+++ ") for word in ("--set", line[4:])]
        shell.run("check", "t.yaml", *sets)


def wrong_commands(shell):
    file = shell.folder.path / "bad.glb"
    file.write_bytes(b"glTF" + bytes(range(200)))
    for line in (
        "", "chekc", "check", "run config/tank.yaml --durtion 3", "render config/tank.yaml --rnage=3", "list --frobnicate",
        "endpoints config/tank.yaml --format ros3", "run config/tank.yaml --duration long", "check none.yaml", "check config",
        "check config/tank.yaml --set water.ph=70", "check config/tank.yaml --set water", "list r2sonic-2204", "list r2sonic",
        "check config/tank.yaml --set scene=../bad.glb", "check config/tank.yaml --set devices.nobody.options.gain=1",
        "check config/tank.yaml --set devices.micron.model=tritech-micro", "check config/tank.yaml --set devices.micron.endpoints=[]",
        "check config/tank.yaml --set devices.micron.endpoints=[tcp://1:2]", "check config/demo.yaml --set devices.sonar.endpoints=[pty:/a]",
        "check config/tank.yaml --set devices.micron.endpoints=[udp-listen://127.0.0.1:1]", "check config/tank.yaml --json --set sede=1",
        "check config/tank.yaml --set devices.micron.endpoints=[pty:/tmp/x?usb=3]",
        "render config/demo.yaml --device nobody --out x.png", "render config/tank.yaml --out x.gif", "render config/tank.yaml",
        "render config/tank.yaml --out x.npy --range -3", "render config/tank.yaml --out x.npy --step 5000", "inspect none.pcap",
        "inspect bad.glb", "inspect --tables nothing", "inspect - --family nothing", "convert bad.glb x.852", "convert none x.txt",
        "diff bad.glb", "diff bad.glb none", "replay bad.glb --list", "replay none", "validate --only V99", "run config/tank.yaml --json x",
        "run config/tank.yaml --record-truth", "run config/tank.yaml --record-size 3", "run config/tank.yaml --control pty:x",
        "fault nowhere list", "fault unix:/tmp/none/none list", "fault", "run config/tank.yaml --record none/x.pcapng",
        "check config/aris.yaml --set devices.aris.endpoints.1=udp://10.0.0.1:5", "check config/tank.yaml --set control=udp://1",
        "check config/kmall.yaml --set devices.multibeam.endpoints.1=udp://10.0.0.1:6020", "check config/tank.yaml --set clock.mode=fast",
        "check config/reson7k.yaml --set devices.multibeam.endpoints=[udp://127.0.0.1:7000]", "check config/demo.yaml --set scene=flat",
        "check config/demo.yaml --set devices.1.endpoints=[udp-listen://127.0.0.1:65500,udp://10.0.0.1:65400]",
        "check config/deltat.yaml --set devices.0.endpoints=[udp://10.0.0.1:4040]", "check config/tank.yaml --set effects.wind=on",
        "check config/norbit.yaml --set devices.0.endpoints=[tcp-listen://127.0.0.1:2209]", "check config/tank.yaml --set faults=[{}]",
        "check config/tank.yaml --set 'faults=[{device: micron, kind: los}, {device: x, kind: loss}, {device: micron, kind: loss, rate: 2}]'",
    ):  # fmt: skip
        shell.run(*shlex.split(line))


def below(option):
    return option["minimum"] - 1 if "minimum" in option else "x"


def above(option):
    return option["maximum"] + 1 if "maximum" in option else "x"


def bounds(model):
    """All options of a model at both ends of what is allowed, beyond them, of a wrong type; all figures beyond theirs."""

    def texts(shell):
        entry = json.loads(shell.run("list", model, "--json"))["models"][0]
        shell.text = b""
        shell.run("list", model)
        options, figures = entry["options"], entry["profile"]
        numbers = [o for o in options if o["type"] in ("integer", "number")]
        for values in (
            {o["name"]: o.get("minimum", o["default"]) for o in numbers}, {o["name"]: o.get("maximum", o["default"]) for o in numbers},
            {o["name"]: below(o) for o in numbers}, {o["name"]: above(o) for o in numbers}, {o["name"]: 0.5 for o in numbers},
            {o["name"]: [1] for o in options}, {o["name"]: "no such" for o in options}, {o["name"] + "x": 1 for o in options},
            {o["name"]: o["choices"][-1] for o in options if "choices" in o},
            {o["name"]: not o["default"] for o in options if o["type"] == "boolean"},
        ):  # fmt: skip
            check(shell, model, f"options: {json.dumps(values)}")
        for number in (-1e30, 1e30, 0, "x"):
            check(shell, model, f"profile: {json.dumps({f['name']: number for f in figures})}")
        check(shell, model, f"profile: {json.dumps({f['name']: f['value'] for f in figures if not isinstance(f['value'], list)})}", "--json")

    return texts


def check(shell, model, line, *arguments):
    (shell.folder.path / "m.yaml").write_text(
        f"scene: config/scenes/tank.glb\ndevices:\n  - name: sonar\n    model: {model}\n    {line}\n")
    shell.run("check", "m.yaml", *arguments)
