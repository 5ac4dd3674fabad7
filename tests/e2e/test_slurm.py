"""A sweep as an array of Slurm's, on one node that this test brings up for itself: a shard is thrown out in the middle and
requeued, and recordings and data sets are the same bytes as those of one process."""
import contextlib
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import unittest

from ports import free_port
from test_free import PROGRAM, SCENARIO, SWEEP, run, sum_of

CONFIGURATION = """
ClusterName=echoloop
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldPort={control}
SlurmdPort={node}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes={host} Default=YES
"""
JOB = """#!/bin/bash
#SBATCH --array=0-2
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output={folder}/%a.log --open-mode=append
srun {program} sweep {file} --shard task/3 --out {folder}/runs --dataset
"""


def missing():
    """Why the test cannot run here, or None. Never in CI."""
    if os.environ.get("CI"):
        return None
    if shutil.which("slurmctld") is None or shutil.which("slurmd") is None:
        return "Slurm is not installed: apt-get install slurm-wlm"
    return None if os.geteuid() == 0 else "slurmd wants to be root"


@unittest.skipIf(missing(), missing())
class Slurm(unittest.TestCase):
    def setUp(self):
        stack = contextlib.ExitStack()
        self.addCleanup(stack.close)
        self.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="slurm-")))
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        configuration = self.folder / "slurm.conf"
        port = free_port(2)
        configuration.write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.folder,
                                                      control=port, node=port + 1))
        self.environment = os.environ | {"SLURM_CONF": str(configuration)}
        for daemon in ("slurmctld", "slurmd"):
            log = stack.enter_context(open(self.folder / f"{daemon}.log", "w"))
            process = subprocess.Popen([daemon, "-D"], env=self.environment, stdout=log, stderr=subprocess.STDOUT)
            stack.callback(process.wait)
            stack.callback(process.terminate)
        self.until(lambda: "idle" in self.slurm("sinfo", "--noheader", "--format=%t", check=False))

    def logs(self):
        return "".join(f"== {f.name}\n{f.read_text()[-2000:]}" for f in sorted(self.folder.glob("*.log")))

    def slurm(self, *words, check=True):
        done = subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False)
        if check and done.returncode != 0:
            self.fail(done.stderr + self.logs())
        return done.stdout

    def until(self, holds, most=3000):
        """Asks again and again; each time starts a program of Slurm's, so that this takes a minute at most."""
        for _ in range(most):
            if holds():
                return
            self.slurm("sinfo", check=False)
        self.fail(self.logs())

    def test_a_shard_that_is_thrown_out_in_the_middle_is_made_again(self):
        file = self.folder / "dive.yaml"
        # Long runs, so that there is a middle.
        file.write_text((SCENARIO + SWEEP).replace("duration: 8", "duration: 16").replace("count: 8", "count: 30"))
        job = self.folder / "job.sh"
        job.write_text(JOB.format(folder=self.folder, program=PROGRAM, file=file))
        number = self.slurm("sbatch", "--parsable", str(job)).strip()
        # Shard 1 makes the runs 1 and 4.
        runs = self.folder / "runs"
        self.until(lambda: (runs / ".000001.part").exists() or (runs / ".000004.part").exists())
        self.slurm("scontrol", "requeue", f"{number}_1")
        self.slurm("sbatch", "--wait", f"--dependency=afterany:{number}", "--output=/dev/null", "--wrap=true")
        self.assertEqual(sorted(f.name for f in runs.iterdir()), [f"{i:06}" for i in range(6)], self.logs())
        alone = self.folder / "alone"
        self.assertEqual(run("sweep", str(file), "--out", str(alone), "--dataset").returncode, 0)
        self.assertEqual(sum_of(runs), sum_of(alone))
        states = self.slurm("scontrol", "show", "job", number)
        self.assertIn("Restarts=1", states)


if __name__ == "__main__":
    unittest.main()
