"""Publishers on Gazebo's transport, on loopback and in a partition of this process's own."""

import os
import subprocess
from pathlib import Path

from poses_programs import need

ENV = {"IGN_IP": "127.0.0.1", "IGN_PARTITION": f"echoloop-test-{os.getpid()}"}
PUBLISHER = os.environ.get("GZ_PUBLISHER", "")


class Publisher:
    """tests/poses/gz_publisher.cpp: poses under a type's name, to the topic's subscribers."""

    def __init__(self, test, topic, kind, *names):
        need(Path(PUBLISHER).is_file(), "gz_publisher is not built: libignition-transport-dev is missing")
        self.process = subprocess.Popen([PUBLISHER, topic, kind, *names], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True, env={**os.environ, **ENV})
        test.addCleanup(self.stop)
        assert self.process.stdout.readline() == "connected\n"

    def publish(self, stamp, position, orientation=(1, 0, 0, 0)):
        """`stamp` in nanoseconds, orientation w x y z."""
        print(stamp, *position, *orientation, file=self.process.stdin, flush=True)

    def prove_connection(self, helper):
        """What is published before the sockets have found each other is lost: so publishes what is refused until the
        pose program says so."""
        helper.wait_for("a message was refused", publish=lambda: self.publish(1, (0, 0, 0), (0, 0, 0, 0)))

    def next_answer(self):
        """The time in nanoseconds of the next Clock on /answers."""
        word, time = self.process.stdout.readline().split()
        assert word == "answer"
        return int(time)

    def stop(self):
        if self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait(20)
        self.process.stdout.close()
