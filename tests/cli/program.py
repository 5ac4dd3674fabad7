"""The built program under test, and what all tests of it share. Standard library only."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "data"
PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))
TANK = str(ROOT / "config" / "tank.yaml")
DEMO = str(ROOT / "config" / "demo.yaml")


def run(*arguments, stdin=b"", **environment):
    """Runs the program; stdout and stderr as text."""
    # A build with the leak sanitizer would name the leaks of libOSMesa, which it is told to ignore, on stderr.
    settings = {**os.environ, "LSAN_OPTIONS": "print_suppressions=0", **environment}
    return subprocess.run([PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, timeout=120,
                          env=settings, check=False)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def good(self, *arguments, **options):
        """stdout of a run that must succeed and say nothing on stderr."""
        done = run(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ""), arguments)
        return done.stdout.decode()

    def json(self, *arguments, **options):
        return json.loads(self.good(*arguments, "--json", **options))

    def bad(self, status, *arguments, **options):
        """stderr of a run that must end with `status`; every line is marked as an error."""
        done = run(*arguments, **options)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, status, text)
        for line in text.splitlines():
            self.assertTrue(line.startswith("echoloop: "), line)
        self.assertIn("echoloop: error: ", text)
        return text

    def scenario(self, text, name="scene.yaml"):
        path = self.folder / name
        path.write_text(text.replace("TANK", str(ROOT / "config" / "scenes" / "tank.glb")))
        return path

    def on_a_terminal(self, *arguments, streams=("stderr",), status=0, **environment):
        """What a run writes to its `streams`, which are one terminal. It must end with `status`."""
        master, slave = os.openpty()
        outputs = {"stdout": subprocess.PIPE, **dict.fromkeys(streams, slave)}
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, **outputs,
                                   env={**os.environ, **environment})
        os.close(slave)
        shown = b""
        try:
            while piece := os.read(master, 65536):  # a terminal hands over what is written piece by piece
                shown += piece
        except OSError:  # the other end is closed
            pass
        os.close(master)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, status, shown)
        return shown.decode()

    def shared(self, *parts):
        """A real recording that is not part of the repository."""
        path = SHARED.joinpath(*parts)
        if path.exists():
            return path
        if os.environ.get("CI") == "true":
            self.fail(f"{path} is missing")
        raise self.skipTest(f"{path} is not here")
