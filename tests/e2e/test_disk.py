"""What a run writes beside the bytes, when the disk is in the way: recording, ground truth and labels say it once and
end, and the emulation goes on."""

import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from ports import free_port
from program import PROGRAM, READY, ROOT, Emulator

SCENARIO = """scene: {scenes}/tank.glb
devices:
  - {name: sonar, model: r2sonic-2024, endpoints: ['udp-listen://127.0.0.1:%d', 'udp://127.0.0.1:%d']}
faults: [{device: sonar, kind: bit_flips, rate: 1e-3}]
"""
STOPPED = ("the recording has stopped: ", "the ground truth has stopped: ", "the label file has stopped: ")
OUTPUTS = (("--record", "run.pcapng"), ("--truth", "truth.jsonl"), ("--labels", "labels.jsonl"))


def whole_lines(file):
    """What the lines say; each must be whole."""
    text = file.read_text()
    assert text == "" or text.endswith("\n"), text[-200:]
    return [json.loads(line) for line in text.splitlines()]


class Disk(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="echoloop-disk-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.base = free_port(16)
        self.listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.listener.close)
        self.listener.bind(("127.0.0.1", self.base + 8))
        self.listener.settimeout(30)
        self.scenario = SCENARIO % (self.base, self.base + 8)

    def outputs(self, folder=None):
        return [word for option, name in OUTPUTS for word in (option, str((folder or self.folder) / name))]

    def hear_a_new_ping(self):
        self.listener.setblocking(False)
        try:
            while True:
                self.listener.recv(65536)
        except BlockingIOError:
            self.listener.settimeout(30)
        self.assertTrue(self.listener.recv(65536))

    def hear_all_stop(self, emulator):
        for words in STOPPED:
            emulator.read_until(words, 30)
        self.hear_a_new_ping()
        status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        for words in STOPPED:
            self.assertEqual(output.count(words), 1, output)
        self.assertEqual(output.count("the emulation goes on. Make room and start again"), 3, output)
        self.assertEqual(output.count("stopped early, see above"), 3, output)
        return output

    def test_a_disk_that_fills_up(self):
        """A disk of its own, in a mount namespace: 256 MiB are left to others, the rest is soon full."""
        namespace = ["unshare", "--map-root-user", "--mount"]
        if subprocess.run([*namespace, "true"], capture_output=True, check=False).returncode != 0:
            if os.environ.get("CI") == "true":
                self.fail("no mount namespaces here, and CI must have them")
            self.skipTest("no mount namespaces here, so there is no small disk to fill")
        disk = f"mount -t tmpfs -o mode=700,size=256m tmpfs {self.folder} && head -c 99k /dev/zero >{self.folder}/other"
        script = self.folder.with_name(self.folder.name + ".sh")
        self.addCleanup(script.unlink)
        script.write_text(f'#!/bin/sh\n{disk} && exec {PROGRAM} "$@"\n')
        script.chmod(0o700)
        with Emulator(self.scenario, *self.outputs(), program=[*namespace, str(script)]) as emulator:
            output = self.hear_all_stop(emulator)
        self.assertEqual(output.count("the disk is nearly full"), 3, output)

    def test_a_limit_on_the_size_of_files_is_such_a_disk_and_what_was_written_stays_whole(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))  # noqa: E731
        with Emulator(self.scenario, *self.outputs(), limits=limit) as emulator:
            output = self.hear_all_stop(emulator)
        self.assertEqual(output.count("File too large"), 3, output)
        for name in ("truth.jsonl", "labels.jsonl"):
            whole_lines(self.folder / name)
        done = subprocess.run(["capinfos", "-c", str(self.folder / "run.pcapng")], capture_output=True, check=False)
        self.assertNotIn(b"cut short", done.stderr)

    def test_killed_the_labels_keep_all_but_the_last_second_in_whole_lines(self):
        file = self.folder / "labels.jsonl"
        with Emulator(self.scenario, "--labels", str(file)) as emulator:
            end = time.monotonic() + 30
            while (not file.exists() or file.read_text().count("\n") < 3) and time.monotonic() < end:
                self.hear_a_new_ping()
            began = time.time()
            while time.time() < began + 1.2:
                self.hear_a_new_ping()
            killed = time.time()
            emulator.process.send_signal(signal.SIGKILL)
            emulator.process.communicate()
        header, *faults = whole_lines(file)
        self.assertEqual(header["format"], "echoloop fault labels")
        self.assertGreater(faults[-1]["unix"], killed - 1)

    def test_what_is_there_is_overwritten(self):
        (self.folder / "labels.jsonl").write_text('{"yesterday\'s": "labels, many of them"}\n' * 10_000)
        with Emulator(self.scenario, *self.outputs()) as emulator:
            self.hear_a_new_ping()
            self.assertEqual(emulator.stop()[0], 0)
        self.assertEqual(whole_lines(self.folder / "labels.jsonl")[0]["format"], "echoloop fault labels")

    def refused(self, *arguments):
        """The one message of a run that cannot begin."""
        scenario = self.folder / "scenario.yaml"
        scenario.write_text(self.scenario.replace("{scenes}", str(ROOT / "config" / "scenes")))
        done = subprocess.run([PROGRAM, "run", str(scenario), "--duration", "0", *map(str, arguments)],
                              capture_output=True, text=True, check=False, env={**os.environ, "NO_COLOR": "1"})
        self.assertEqual(done.returncode, 73, done.stderr)
        self.assertNotIn(READY, done.stdout)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_where_nothing_can_be_written_no_run_begins(self):
        for option, name in OUTPUTS:
            for place in (Path("/proc") / name, self.folder, self.folder / "no such folder" / name):
                message = self.refused(option, place)
                self.assertIn(f"{place}: cannot be written: ", message)
                self.assertIn("name a file in a folder that you may write to", message)

    def test_a_file_of_another_kind_is_not_overwritten(self):
        other = self.folder / "my.yaml"
        other.write_text("a day's work")
        for option, _ in OUTPUTS:
            self.assertIn(f"{other}: exists and holds something else, which would be lost", self.refused(option, other))
            self.assertEqual(other.read_text(), "a day's work")

    def test_a_file_that_a_run_writes_is_not_another_runs(self):
        """Started twice by mistake, the second one must not spoil what the first one records."""
        with Emulator(self.scenario, *self.outputs()) as emulator:
            self.hear_a_new_ping()
            for option, name in OUTPUTS:
                message = self.refused(option, self.folder / name)
                self.assertIn(f"{self.folder / name}: is being written already, perhaps by another run", message)
                self.assertIn("name another file", message)
            self.hear_a_new_ping()
            self.assertEqual(emulator.stop()[0], 0)
        self.assertGreater(len(whole_lines(self.folder / "labels.jsonl")), 1)
        subprocess.run(["capinfos", "-c", str(self.folder / "run.pcapng")], capture_output=True, check=True)
        self.assertIn("is being written already",
                      self.refused("--labels", self.folder / "twice", "--truth", self.folder / "twice"))

    def test_a_pipe_whose_reader_goes_ends_the_labels_and_not_the_run(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        with subprocess.Popen(["head", "-n", "2", str(pipe)], stdout=subprocess.PIPE) as reader:
            with Emulator(self.scenario, "--labels", str(pipe)) as emulator:
                reader.wait(timeout=30)
                emulator.read_until("the label file has stopped: Broken pipe", 30)
                self.hear_a_new_ping()
                self.assertEqual(emulator.stop()[0], 0)


if __name__ == "__main__":
    unittest.main()
