"""What Doppler logs say, read back from the wire: the range of each beam over a flat floor."""

import math
import socket
import unittest

from ports import free_port
from said_case import DEPTH, LEVEL, SaidCase, drain
from test_view_capture import loudest_range

ACROSS = "0, 0, -45"  # beam 3 ahead, as these logs are mounted
WITHIN = 0.02  # of the depth: a log takes the range where a long pulse is loudest
TILT = math.radians(22.5)  # of a Water Linked log's beams


class Logs(SaidCase):
    def check_beams(self, name, beams, metres):
        head, levels, ranges = self.said(name)[name]
        self.assertEqual((head["beams"], head["numbered"], head["bins"]), (beams, True, 0))
        self.assertEqual(len(ranges), beams)
        for one in ranges:
            self.assertAlmostEqual(one, metres, delta=WITHIN * metres)

    def connect(self, port):
        line = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(line.close)
        return line

    def test_a_water_linked_log_tells_the_way_along_each_beam(self):
        port = free_port()
        self.start("dvl-a50", [port, free_port()], "speed_of_sound: 1500", LEVEL)
        drain(self.connect(port))
        self.check_beams("velocity", 4, DEPTH / math.cos(TILT))

    def test_pd0_tells_the_depth_below_each_beam(self):
        port = free_port()
        self.start("dvl-pathfinder", [port], "speed_of_sound: 1500, baud: 0", ACROSS)
        drain(self.connect(port))
        self.check_beams("Ensemble", 4, DEPTH)

    def test_pd0_tells_how_strong_the_echo_of_each_cell_of_the_water_is(self):
        """The bottom's is the strongest."""
        port = free_port()
        options = "speed_of_sound: 1500, baud: 0, profile_pings: 1, profile_cells: 20, cell_size: 50"
        self.start("dvl-pathfinder", [port], options, ACROSS)
        drain(self.connect(port))
        head, levels, ranges = self.said("Ensemble intensity")["Ensemble intensity"]
        self.assertEqual((head["beams"], head["numbered"], head["bins"], head["unit"]), (4, True, 20, "counts"))
        self.assertAlmostEqual(head["bin_size"], 0.5, places=6)
        self.assertEqual(len(ranges), 0)
        for beam in range(4):
            self.assertAlmostEqual(loudest_range(head, levels, beam), DEPTH, delta=0.5)

    def test_pd5(self):
        port = free_port()
        self.start("dvl-navigator", [port], "speed_of_sound: 1500, baud: 0, format: pd5", ACROSS)
        drain(self.connect(port))
        self.check_beams("PD5", 4, DEPTH)

    def test_a_wayfinder_tells_the_depth_below_each_beam(self):
        port = free_port()
        self.start("dvl-wayfinder", [port], "speed_of_sound: 1500, baud: 0", ACROSS)
        drain(self.connect(port))
        self.check_beams("Data", 4, DEPTH)

    def test_a_nortek_dvl_by_frames_and_by_lines(self):
        for form, name in (("df21", "DvlBottomTrack"), ("bt7", "PNORBT7")):
            with self.subTest(form):
                command, data = free_port(), free_port()
                self.start("nortek-dvl1000", [command, data], f"speed_of_sound: 1500, bottom_format: {form}", LEVEL)
                drain(self.connect(data))
                self.check_beams(name, 4, DEPTH)

    def test_a_nucleus_has_three_beams_and_an_altimeter(self):
        command, data = free_port(), free_port()
        self.start("nortek-nucleus", [command, data], "speed_of_sound: 1500, starts_at_once: true", LEVEL)
        drain(self.connect(data))
        found = self.said("BottomTrack", "Altimeter")
        self.assertNotIn("Ahrs", self.names, "the vehicle's own depth is no picture")
        for name, beams in (("BottomTrack", 3), ("Altimeter", 1)):
            head, _, ranges = found[name]
            self.assertEqual((head["beams"], head["numbered"], len(ranges)), (beams, beams > 1, beams))
            for one in ranges:
                self.assertAlmostEqual(one, DEPTH, delta=WITHIN * DEPTH)


if __name__ == "__main__":
    unittest.main()
