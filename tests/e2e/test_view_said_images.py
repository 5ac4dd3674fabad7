"""What a sonar of rows of beams says, read back from the wire: the range in each direction, and how strong that echo is."""

import socket
import statistics
import unittest

from ports import free_port
from said_case import DEPTH, DOWN, SaidCase


class Images(SaidCase):
    def test_a_3d_sonar_tells_ranges_and_strengths(self):
        sink = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sink.bind(("127.0.0.1", 0))
        self.addCleanup(sink.close)
        places = [f"tcp-listen://127.0.0.1:{free_port()}", f"udp://127.0.0.1:{sink.getsockname()[1]}"]
        self.start("sonar-3d-15", places, "acoustics: true, speed_of_sound: 1500, range_min: 1, range_max: 12", DOWN)
        found = self.said("RangeImage", "BitmapImageGreyscale8")
        ranges, strengths = found["RangeImage"], found["BitmapImageGreyscale8"]
        for name in ("rows", "beams", "bearings", "elevations"):
            self.assertEqual(ranges[0][name], strengths[0][name])
        head = strengths[0]
        self.assertEqual((head["bins"], head["unit"]), (1, "counts"))
        # The middle one alone may have no return in this image: a third of them have none.
        rows, columns = (range(head[name] // 2 - 3, head[name] // 2 + 3) for name in ("rows", "beams"))
        middle = [ranges[2][row * head["beams"] + column] for row in rows for column in columns]
        self.assertAlmostEqual(statistics.median(filter(None, middle)), DEPTH, delta=0.05)
        told = [bool(one) for one in ranges[2]]
        strong = [bool(one) for one in strengths[1]]
        alike = sum(a == b for a, b in zip(told, strong)) / len(told)
        self.assertGreater(alike, 0.99, "a direction has both or neither")
        self.assertGreater(sum(told) / len(told), 0.3)


if __name__ == "__main__":
    unittest.main()
