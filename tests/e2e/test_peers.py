"""Sonars on an address that other machines reach send to peers only. In a network namespace of its own, whose interface
`bench` has 10.9.0.1/24 and the way to everywhere else."""

import http.client
import json
import os
import select
import socket
import subprocess
import sys
import tempfile
import unittest

if os.environ.get("ECHOLOOP_TEST_NAMESPACE") is None:
    command = " && ".join((
        "ip link set lo up", "ip link add bench type veth peer name other", "ip link set other up",
        "ip link set bench arp off", "ip address add 10.9.0.1/24 dev bench",
        "ip link set bench up", "ip route add default dev bench", f'exec "{sys.executable}" "$@"'))
    rights = [] if os.geteuid() == 0 else ["--map-root-user"]
    os.environ["ECHOLOOP_TEST_NAMESPACE"] = "1"
    os.execvp("unshare", ["unshare", "--net", *rights, "sh", "-c", command, "sh", *sys.argv])

from ports import free_port  # noqa: E402
from program import PROGRAM, Emulator  # noqa: E402

OWN, NEIGHBOUR, STRANGER = "10.9.0.1", "10.9.0.7", "192.0.2.7"
SCENARIO = """
scene: {scenes}/tank.glb
vehicle: {pose: {position: [0, 0, -2]}}
%s
devices:
  - name: sonar
    %s
"""
IMAGES = 'model: sonar-3d-15\n    endpoints: ["tcp-listen://%s:%d"]\n'
SOUNDER = 'model: ping1d\n    endpoints: ["udp-listen://%s:%d"]\n'
DEVICE_INFORMATION = bytes.fromhex("4252020006000000" "0400a000")  # a request of the Ping protocol


class Wire:
    """All that leaves by the interface `bench`."""

    def __init__(self):
        everything = 3  # ETH_P_ALL
        self.socket = socket.socket(socket.AF_PACKET, socket.SOCK_DGRAM, socket.htons(everything))
        self.socket.bind(("bench", everything))

    def has_packet_to(self, address, seconds):
        """Whether one comes before the wire is silent for so many seconds."""
        while select.select([self.socket], [], [], seconds)[0]:
            packet, (_, protocol, *_) = self.socket.recvfrom(65536)
            if protocol == 0x0800 and packet[16:20] == socket.inet_aton(address):
                return True
        return False


class Peers(unittest.TestCase):
    def start(self, device, peers=""):
        self.emulator = Emulator(SCENARIO % (peers, device))
        self.addCleanup(self.emulator.__exit__, None, None, None)
        self.emulator.__enter__()

    def send_images_to(self, address):
        connection = http.client.HTTPConnection(OWN, self.port, timeout=20)
        body = json.dumps({"mode": "unicast", "unicast_destination_ip": address, "unicast_destination_port": 4747})
        connection.request("POST", "/api/v1/integration/udp", body=body)
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        self.assertLess(answer.status, 300, text)
        connection = http.client.HTTPConnection(OWN, self.port, timeout=20)
        connection.request("POST", "/api/v1/integration/acoustics/enabled", body="true")
        answer = connection.getresponse()
        answer.read()
        connection.close()
        self.assertLess(answer.status, 300)

    def images(self, address, peers=""):
        """Starts a Sonar 3D-15 and has it send its images there; returns whether one leaves."""
        self.port = free_port()
        self.start(IMAGES % (OWN, self.port), peers)
        wire = Wire()
        self.addCleanup(wire.socket.close)
        self.send_images_to(address)
        return wire.has_packet_to(address, 1.5)

    def test_a_neighbour_is_sent_to(self):
        self.assertTrue(self.images(NEIGHBOUR))
        self.assertIn("is open to 10.9.0.0/24", self.emulator.output)

    def test_a_stranger_is_not_whoever_asks_for_it(self):
        self.assertFalse(self.images(STRANGER))
        output = self.emulator.stop()[1]
        self.assertIn(f"nothing is sent to {STRANGER}:4747", output)
        self.assertRegex(output, r"not sent: \d+ datagrams to addresses that are none of the peers")

    def test_the_scenario_names_others(self):
        self.assertTrue(self.images(STRANGER, "peers: [192.0.2.0/24]"))
        self.assertNotIn("10.9.0.0/24", self.emulator.output)

    def test_a_sender_that_gives_a_false_address_starts_nothing(self):
        port = free_port()
        self.start(SOUNDER % (OWN, port))
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            subprocess.run(["ip", "address", "add", f"{STRANGER}/32", "dev", "lo"], check=True)
            self.addCleanup(subprocess.run, ["ip", "address", "del", f"{STRANGER}/32", "dev", "lo"])
            stranger.bind((STRANGER, 0))
            stranger.settimeout(1.5)
            stranger.sendto(DEVICE_INFORMATION, (OWN, port))
            with self.assertRaises(TimeoutError):
                stranger.recv(100)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as neighbour:
            neighbour.settimeout(20)
            neighbour.sendto(DEVICE_INFORMATION, (OWN, port))
            self.assertTrue(neighbour.recv(100).startswith(b"BR"))

    def test_a_stranger_does_not_get_in_by_tcp(self):
        port = free_port()
        self.start(SOUNDER.replace("udp", "tcp") % ("0.0.0.0", port))
        subprocess.run(["ip", "address", "add", f"{STRANGER}/32", "dev", "lo"], check=True)
        self.addCleanup(subprocess.run, ["ip", "address", "del", f"{STRANGER}/32", "dev", "lo"])
        for source, served in ((STRANGER, False), (OWN, True), ("127.0.0.1", True)):
            with socket.create_connection((OWN if source != "127.0.0.1" else source, port), timeout=20,
                                          source_address=(source, 0)) as driver:
                try:
                    driver.sendall(DEVICE_INFORMATION)
                    answer = driver.recv(100)
                except (ConnectionResetError, BrokenPipeError):
                    answer = b""
            self.assertEqual(answer.startswith(b"BR"), served, source)

    def test_what_is_no_network_is_named(self):
        for text, word in (("[300.1.1.1/8]", "peers.0: no network of IPv4"), ("[10.0.0.0/33]", "peers.0"),
                           ("10.0.0.0/8", "peers: expected a list"), ("[]", "peers: expected a list")):
            file = self.write(SCENARIO.replace("{scenes}", "x") % (f"peers: {text}", SOUNDER % ("127.0.0.1", 0)))
            result = subprocess.run([PROGRAM, "check", file], capture_output=True, text=True)
            self.assertEqual(result.returncode, 78, result)
            self.assertIn(word, result.stderr + result.stdout)

    def write(self, text):
        file = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(file.close)
        file.write(text)
        file.flush()
        return file.name


if __name__ == "__main__":
    unittest.main()
