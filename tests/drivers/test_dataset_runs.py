"""Runs that write data sets: the same bytes with any number of threads and shards, nothing half on a full disk or after a
kill, no ping lost that is not counted."""

import json
import re
import resource
import signal
import subprocess
import unittest

from datasets import FAN, HEAD, ROOT, Data, DatasetCase, run, sum_of

from program import PROGRAM, Emulator


class Runs(DatasetCase):
    def test_the_same_run_gives_the_same_bytes_whatever_the_threads(self):
        self.made("fan", FAN)
        one = self.folder / "one"
        done = subprocess.run(["taskset", "1", PROGRAM, "run", str(self.folder / "fan.yaml"), "--dataset", str(one)],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sum_of(one), sum_of(self.folder / "fan"))

    def test_a_sweep_in_parts_is_the_sweep_as_a_whole(self):
        vary = "sweep: {runs: 4, vary: {vehicle.pose.position.0: {uniform: [0, 2]}}}\n"
        file = self.scenario("swept", HEAD.replace("430", "5"), more=vary)
        whole, parts = self.folder / "whole", self.folder / "parts"
        for out, part in ((whole, "0/1"), *((parts, f"{i}/4") for i in (2, 0, 3, 1))):
            done = run("sweep", str(file), "--out", str(out), "--dataset", "--shard", part)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sum_of(whole), sum_of(parts))
        self.assertEqual(len(Data(whole / "000003" / "dataset").index), 5)
        plain = self.folder / "plain"
        self.assertEqual(run("sweep", str(file), "--out", str(plain)).returncode, 0)
        done = run("sweep", str(file), "--out", str(plain), "--dataset")
        self.assertEqual(done.returncode, 73)
        self.assertIn("was made without --dataset", done.stderr)

    def test_a_full_disk_leaves_nothing_that_looks_whole(self):
        file, out = self.scenario("full", FAN), self.folder / "full"
        done = run("run", str(file), "--dataset", str(out),
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000)))
        self.assertEqual(done.returncode, 74, done.stderr)
        self.assertRegex(done.stderr, r"\.full\.part/\S+: File too large; make room on that disk and start again")
        self.assertEqual([f.name for f in self.folder.iterdir() if "full" in f.name], ["full.yaml"])
        there = self.folder / "there"
        there.mkdir()
        done = run("run", str(file), "--dataset", str(there))
        self.assertEqual(done.returncode, 73)
        self.assertIn("exists already", done.stderr)

    def test_a_killed_run_leaves_none_and_can_be_started_again(self):
        file, out = self.scenario("killed", FAN, seconds=600), self.folder / "killed"
        process = subprocess.Popen([PROGRAM, "run", str(file), "--dataset", str(out)], stdout=subprocess.DEVNULL)
        while not (self.folder / ".killed.part" / "polar").exists() and process.poll() is None:
            pass  # nothing to wait on: another process makes a folder
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse(out.exists())
        file = self.scenario("killed", FAN, seconds=1)
        self.assertEqual(run("run", str(file), "--dataset", str(out)).returncode, 0)
        self.assertGreater(len(Data(out).index), 0)
        self.assertFalse((self.folder / ".killed.part").exists())

    def test_in_real_time_every_ping_is_there_or_counted(self):
        out = self.folder / "real"
        scenario = self.scenario("real", FAN).read_text().replace("mode: free, duration: 2", "mode: real")
        with Emulator(scenario, "--dataset", str(out), "--duration", "3") as emulator:
            emulator.process.wait(timeout=60)
            status, output = emulator.stop()
        self.assertEqual(status, 0, output)
        data = Data(out)
        about = json.loads((out / "dataset.json").read_text())
        heard = int(re.search(r"fan +(\d+) ping", output)[1])
        self.assertEqual(heard, about["pings"] + about["lost"])
        self.assertEqual(len(data.index), about["pings"])
        self.assertGreater(len(data.index), 2)

    def test_a_sweep_on_a_full_disk_leaves_no_run_and_is_made_whole_later(self):
        vary = "sweep: {runs: 2, vary: {vehicle.pose.position.0: {uniform: [0, 2]}}}\n"
        file, out = self.scenario("swept_full", HEAD.replace("430", "5"), more=vary), self.folder / "swept_full"
        done = run("sweep", str(file), "--out", str(out), "--dataset",
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (8_000, 8_000)))
        self.assertEqual(done.returncode, 74, done.stderr)
        self.assertRegex(done.stderr, r"File too large; make room on that disk and start again")
        self.assertEqual([f.name for f in out.iterdir() if not f.name.startswith(".")], [])
        for folder in (out, self.folder / "swept_whole"):
            self.assertEqual(run("sweep", str(file), "--out", str(folder), "--dataset").returncode, 0)
        self.assertEqual(sum_of(out), sum_of(self.folder / "swept_whole"))

    def test_the_example_has_labels_as_it_is_written_and_in_its_runs(self):
        example, out = ROOT / "config" / "sweep.yaml", self.folder / "example"
        self.assertEqual(run("run", str(example), "--dataset", str(out)).returncode, 0)
        swept = self.folder / "examples"
        self.assertEqual(run("sweep", str(example), "--set", "sweep.runs=2", "--out", str(swept), "--dataset").returncode, 0)
        for folder in (out, swept / "000000" / "dataset", swept / "000001" / "dataset"):
            data = Data(folder)
            names = {data.coco.cats[a["category_id"]]["name"] for a in data.coco.anns.values()}
            self.assertIn("post", names, folder)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # numpy warns of pycocotools
