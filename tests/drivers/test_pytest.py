"""tools/pytest, as pip installs it: its README's examples, a driver that is broken on purpose, many tests at once, and what
is said if the program cannot be had."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import tomllib
import unittest
from pathlib import Path
from unittest import mock

import public_driver
from program import PROGRAM, ROOT

PACKAGE = ROOT / "tools" / "pytest"
PYTHON = ROOT / "build" / "drivers" / "pytest" / "bin" / "python"
public_driver.use("pytest", "xdist")

import yaml  # noqa: E402

BROKEN = """
import os, tty

def test_a_driver_that_expects_another_version(echoloop):
    sonar = echoloop("ping1d", mount=(0, 90, 0))
    line = os.open(sonar.line, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(line)
    os.write(line, b"BR\\x02\\x00\\x06\\x00\\x00\\x00\\x05\\x00\\xa1\\x00")  # asks for the version of the protocol
    assert os.fdopen(line, "rb").read(14)[8] == 77
"""

EVERYTHING = """
import os, socket, tty
import pytest

ASK = b"BR\\x02\\x00\\x06\\x00\\x00\\x00\\x05\\x00\\xa1\\x00"
ROW = "scene: {scenes}/tank.glb\\ndevices:\\n"
TWO = (ROW + "  - {name: a, model: ping1d, endpoints: ['pty:/tmp/echoloop/x']}\\n"
             "  - {name: b, model: s500, endpoints: ['tcp-listen://127.0.0.1:9090']}\\n")

def open_line(path):
    line = os.open(path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(line)
    return line

def test_fault_and_heal(echoloop):
    sonar = echoloop("ping1d", endpoints=["udp-listen://127.0.0.1:0"])
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as driver:
        driver.connect(sonar.address)
        driver.settimeout(20)
        driver.send(ASK)
        driver.recv(100)
        number = sonar.fault("silence")
        driver.send(ASK)
        driver.settimeout(0.5)
        with pytest.raises(TimeoutError):
            driver.recv(100)
        sonar.heal(number)
        driver.settimeout(20)
        driver.send(ASK)
        driver.recv(100)

def test_unplug_for_a_while(echoloop):
    sonar = echoloop("ping1d", stepped=True)
    sonar.step(0.1)
    line = open_line(sonar.line)
    sonar.fault("unplug", seconds=2)
    sonar.step(1)
    with pytest.raises(OSError):
        os.write(line, ASK)
    os.close(line)
    assert not os.path.exists(sonar.line)
    sonar.step(2)
    assert os.path.exists(sonar.line)

@pytest.mark.parametrize("stepped", [False, True])
def test_the_vehicle_is_put_somewhere(echoloop, stepped):
    sonar = echoloop("s500", mount=(0, 90, 0), size=(20, 20, 6), stepped=stepped)
    if stepped:
        sonar.step(0.1)
    for up, depth in ((-1, 5), (-2, 4), (-4, 2)):
        sonar.pose(position=(0, 0, up))
        if stepped:
            sonar.step(0.1)
        with socket.create_connection(sonar.address, timeout=20) as driver:
            before = len(sonar.truth(count=0))
            ping = bytes(8) + bytes([255, 255, 255, 255]) + bytes(2) + (1223).to_bytes(2, "little") + bytes(4)
            frame = b"BR" + len(ping).to_bytes(2, "little") + (1015).to_bytes(2, "little") + bytes(2) + ping
            driver.sendall(frame + (sum(frame) & 0xFFFF).to_bytes(2, "little"))
            if stepped:
                sonar.step(0.5)
            assert driver.recv(4)[:2] == b"BR"
        assert abs(sonar.truth(count=before + 1)[-1]["axis_range"][0] - depth) < 0.1

def test_two_sonars_of_a_scenario(echoloop):
    a = echoloop(scenario=TWO)
    line = open_line(a.line)
    os.write(line, ASK)
    assert os.read(line, 14)
    with socket.create_connection(a["b"].address, timeout=20) as driver:
        driver.sendall(ASK)
        assert driver.recv(100)
    assert [m.name for m in a.messages(count=2)] == [m.name for m in a["b"].messages(count=2)]
    assert [m.sent for m in a.messages()] == [False, True]
    assert a.messages("ProtocolVersion")[0].fields["major"] == 1
    os.close(line)
    with pytest.raises(KeyError, match="it has a, b"):
        a["c"]
    assert a.ports["line 1"]["transport"] == "pty"
"""


def blocks():
    """The README's two test files."""
    return re.findall(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.S)


class Pytest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = Path(tempfile.mkdtemp(prefix="echoloop-pytest-"))
        cls.addClassCleanup(shutil.rmtree, cls.home)
        shutil.copytree(PACKAGE, cls.home / "source")  # pip writes beside what it installs
        subprocess.run([PYTHON, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-deps", "--no-index",
                        "--no-build-isolation", "--target", cls.home / "site", cls.home / "source"],
                       check=True, timeout=120)

    def pytest(self, *files, arguments=(), echoloop=PROGRAM):
        """(status, output) of pytest over files of these texts."""
        folder = Path(tempfile.mkdtemp(dir=self.home))
        for i, text in enumerate(files):
            (folder / f"test_{i}.py").write_text(text.replace("{scenes}", str(ROOT / "config" / "scenes")))
        environment = {**os.environ, "PYTHONPATH": str(self.home / "site"), "ECHOLOOP": echoloop}
        done = subprocess.run([PYTHON, "-m", "pytest", "-p", "no:cacheprovider", "--basetemp", folder / "tmp", *arguments],
                              cwd=folder, env=environment, capture_output=True, text=True, timeout=250, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_the_readme_works_and_is_short(self):
        self.assertEqual(len(blocks()), 2)
        for block in blocks():
            self.assertLessEqual(len([line for line in block.splitlines() if line]), 20)
        status, output = self.pytest(*blocks())
        self.assertEqual(status, 0, output)
        self.assertIn("2 passed", output)

    def test_all_of_it_many_at_once(self):
        status, output = self.pytest(EVERYTHING, EVERYTHING, *blocks(), arguments=("-n", "2"))
        self.assertEqual(status, 0, output)
        self.assertIn("12 passed", output)

    def test_the_report_of_a_broken_driver_shows_what_was_said(self):
        kept = self.home / "kept"
        for arguments in ((), ("-n", "2")):
            with self.subTest(arguments):
                status, output = self.pytest(BROKEN, arguments=("--echoloop-captures", kept, *arguments))
                self.assertEqual(status, 1, output)
                report = output[output.index(" echoloop "):]
                self.assertRegex(report, r"capture of the wire: /\S+/capture\.pcapng\n")
                self.assertIn("ping1d: 2 messages, the last:\n", report)
                self.assertRegex(report, r"\d s  driver  GeneralRequest .*requested_id=5 \(12 bytes\)\n")
                self.assertRegex(report, r"\d s  sonar   ProtocolVersion .*major=1 minor=0 .*\(14 bytes\)\n")
                (copy,) = kept.iterdir()
                shown = subprocess.run([PROGRAM, "inspect", copy, "--summary"], capture_output=True, text=True, check=True)
                self.assertIn("ProtocolVersion 1", shown.stdout)
                copy.unlink()

    def check_error(self, words, text='def test_it(echoloop):\n    echoloop("ping360")\n', echoloop=PROGRAM):
        """One error with these words, and no trace through the package."""
        status, output = self.pytest(text, echoloop=echoloop)
        self.assertEqual(status, 1, output)
        self.assertIn(words, output)
        self.assertNotIn("Traceback", output)
        self.assertNotIn("plugin.py:", output)

    def program(self, script):
        path = Path(tempfile.mkdtemp(dir=self.home)) / "echoloop"
        path.write_text(textwrap.dedent(script))
        path.chmod(0o755)
        return str(path)

    def test_the_workflow_is_one(self):
        workflow = yaml.safe_load((PACKAGE / "examples" / "workflow.yml").read_text())
        self.assertEqual(workflow[True], ["push", "pull_request"])  # YAML 1.1 reads `on` as true
        (job,) = workflow["jobs"].values()
        for step in job["steps"]:
            self.assertEqual(len({"run", "uses"} & set(step)), 1, step)
            self.assertLessEqual(set(step), {"name", "run", "uses", "with", "if"})
            done = subprocess.run(["bash", "-n", "-c", step.get("run", "")], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        package = tomllib.loads((PACKAGE / "pyproject.toml").read_text())["project"]
        text = "".join(step.get("run", "") for step in job["steps"])
        self.assertIn(f"pytest_echoloop-{package['version']}-py3-none-any.whl", text)
        self.assertIn("--echoloop-captures captures", text)
        self.assertEqual(job["steps"][-1]["with"]["path"], "captures")

    def test_no_program(self):
        self.check_error("ECHOLOOP=/nowhere/echoloop: this is no program that can be run", echoloop="/nowhere/echoloop")
        with mock.patch.dict(os.environ, PATH=str(self.home)):
            self.check_error("the program echoloop is not in PATH; install it, or set ECHOLOOP", echoloop="")

    def test_a_program_that_is_too_old(self):
        old = self.program(f"""\
            #!{sys.executable}
            import subprocess, sys
            if sys.argv[1] != "run":
                sys.exit(subprocess.run(["{PROGRAM}", *sys.argv[1:]]).returncode)
            print('{{"event": "started"}}', flush=True)
            """)
        self.check_error("is too old for this fixture", echoloop=old)

    def test_a_program_that_dies_is_quoted(self):
        self.check_error("unknown model 'ping36'; did you mean 'ping360'?",
                         'def test_it(echoloop):\n    echoloop("ping36", endpoints=["udp-listen://127.0.0.1:0"])\n')
        self.check_error("/proc/none: ", 'def test_it(echoloop):\n    echoloop("ping360", settings=["seed=-1"])\n'
                         .replace('settings=["seed=-1"]', 'settings=["scene=/proc/none"]'))
        text = "import os, signal\ndef test_it(echoloop):\n    s = echoloop('ping360')\n    p = s._run.process._process\n    p.kill()\n    p.wait()\n"
        self.check_error("ended with status -9 during the test", text)

    def test_one_clear_way(self):
        for call, words in (('echoloop()', 'give a model, as in echoloop("ping360")'),
                            ('echoloop("r2sonic-2024")', "r2sonic-2024 sends to its driver: bind a UDP port"),
                            ('echoloop("ping360").address', "ping360 is on no network"),
                            ('echoloop("s500").line', "s500 has no pty"),
                            ('echoloop("s500").step(1)', "echoloop(..., stepped=True)"),
                            ('echoloop("s500").fault("rust")', "kind: unknown")):
            with self.subTest(call):
                status, output = self.pytest(f"def test_it(echoloop):\n    {call}\n")
                self.assertEqual(status, 1, output)
                self.assertIn(words, output)


if __name__ == "__main__":
    unittest.main()
