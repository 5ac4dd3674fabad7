"""What side-scans say, read back from the wire: over a flat floor both sides are water up to where the fan meets it, and the floor
beyond, as they have heard it."""

import socket
import struct
import threading
import unittest

from ports import free_port
from said_case import DEPTH, LEVEL, SaidCase, begins, drain

import cerulean_wire
import imagenex_wire

EDGETECH_SET, EDGETECH_RANGE, HIGH = 0, 128, 21


def edgetech(kind, subsystem, value):
    """A set of 32 bits, as a host sends it."""
    return struct.pack("<HBBHBBBBHI", 0x1601, 13, 0, kind, EDGETECH_SET, subsystem, 0, 0, 0, 4) + struct.pack("<I", value)


class Sides(SaidCase):
    def check_sides(self, head, levels, *, beams=2):
        """The floor begins where it does in what was heard, at the depth or, in a tilted fan, beyond it."""
        heard, heard_levels, _ = self.heard
        self.assertTrue(head["waterfall"])
        self.assertEqual((head["beams"], heard["beams"]), (beams, beams))
        far = [one["first_range"] + one["bins"] * one["bin_size"] for one in (head, heard)]
        self.assertAlmostEqual(*far, delta=0.01 * far[1])
        counts = head["unit"] == "counts"
        for side in range(beams):
            said = begins(head, levels, side, below=80 if counts else 25)
            true = begins(heard, heard_levels, side, below=25)
            self.assertGreater(true, 0.98 * DEPTH)
            self.assertAlmostEqual(said, true, delta=0.5)

    def test_an_edgetech_2205(self):
        commands, data = free_port(), free_port()
        self.start("edgetech-2205", [commands, data], "start: high", LEVEL)
        host = socket.create_connection(("127.0.0.1", commands), timeout=20)
        reader = socket.create_connection(("127.0.0.1", data), timeout=20)
        self.addCleanup(host.close)
        self.addCleanup(reader.close)
        host.sendall(edgetech(EDGETECH_RANGE, HIGH, 30000))
        drain(reader)
        head, levels, _ = self.said("SonarData high")["SonarData high"]
        self.check_sides(head, levels)

    def test_two_frequencies_of_an_edgetech_are_two_pictures(self):
        commands, data = free_port(), free_port()
        self.start("edgetech-2205", [commands, data], "start: both", LEVEL)
        reader = socket.create_connection(("127.0.0.1", data), timeout=20)
        self.addCleanup(reader.close)
        drain(reader)
        self.assertEqual(set(self.said("SonarData low", "SonarData high")), {"SonarData low", "SonarData high"})

    def test_an_imagenex_872(self):
        port = free_port()
        self.start("imagenex-872", [port], "", LEVEL)
        line = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(line.close)

        def ask():
            """Port, then starboard of the same ping, over 30 m; the low frequency has the highest fan."""
            try:
                while True:
                    for side in (0, 2):
                        line.sendall(imagenex_wire.side_scan_command(side, frequency=0))
                        left = 1013
                        while left > 0:
                            piece = line.recv(left)
                            if not piece:
                                return
                            left -= len(piece)
            except OSError:
                pass

        threading.Thread(target=ask, daemon=True).start()
        head, levels, _ = self.said("IGX")["IGX"]
        self.check_sides(head, levels)

    def test_an_omniscan_of_one_side(self):
        port = free_port()
        self.start("omniscan450", [port], "", "0, 30, -90")  # 30 deg down, to starboard
        line = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(line.close)
        line.sendall(cerulean_wire.os_ping_params(length_mm=30000, num_results=1200, msec_per_ping=60))
        drain(line)
        head, levels, _ = self.said("OsMonoProfile")["OsMonoProfile"]
        self.check_sides(head, levels, beams=1)


if __name__ == "__main__":
    unittest.main()
