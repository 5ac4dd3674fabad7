"""A simulator in lockstep with the emulator, written from the scenario's README alone: it says what time it is and
where the vehicle is, and goes on when it is answered. Also a vehicle that circles, in JSON and in MAVLink."""

import json
import math
import socket
import struct


class Refused(Exception):
    """The emulator answered with an error."""


class Stepper:
    """Steps the clock over TCP."""

    def __init__(self, port, timeout=60):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=timeout)
        self.answers = self.socket.makefile("r")

    def send(self, **line):
        self.socket.sendall(json.dumps(line).encode() + b"\n")

    def answer(self):
        line = self.answers.readline()
        if not line:
            raise EOFError("the emulator has hung up")
        answer = json.loads(line)
        if "error" in answer:
            raise Refused(answer["error"])
        return answer

    def step(self, now, **pose):
        """`pose`: position, and orientation or rpy_deg. Returns when everything up to `now` is on its way."""
        self.send(now=now, **pose)
        return self.answer()

    def close(self):
        self.answers.close()
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class UdpStepper(Stepper):
    """The same in datagrams; an answer that is lost is asked for again."""

    def __init__(self, port, timeout=60):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.socket.settimeout(timeout)

    def send(self, **line):
        self.socket.send(json.dumps(line).encode())

    def answer(self):
        answer = json.loads(self.socket.recv(65536))
        if "error" in answer:
            raise Refused(answer["error"])
        return answer

    def close(self):
        self.socket.close()


def single(x):
    """Rounded as MAVLink carries it."""
    return struct.unpack("f", struct.pack("f", x))[0]


class Circle:
    """A vehicle on a circle around the origin, its bow along the way. Everything is rounded to single precision, so
    that each protocol can say the same to the last bit. World: east, north, up."""

    def __init__(self, radius=2.0, depth=3.0, seconds=40.0):
        self.radius, self.depth, self.seconds = radius, depth, seconds

    def at(self, t):
        """(position [east, north, up], quaternion [w, x, y, z] of the heading, counter-clockwise from east)."""
        turn = 2 * math.pi * t / self.seconds
        heading = turn + math.pi / 2
        position = [single(self.radius * math.cos(turn)), single(self.radius * math.sin(turn)), -single(self.depth)]
        return position, [single(math.cos(heading / 2)), 0.0, 0.0, single(math.sin(heading / 2))]

    def pose(self, t):
        """As keys of a line."""
        position, orientation = self.at(t)
        return {"position": position, "orientation": orientation}
