"""tools/soak: it serves twelve sonars, kills and brings back their drivers, and calls growth by its name."""

import importlib.machinery
import importlib.util
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

from program import ROOT

SCRIPT = ROOT / "tools" / "soak"


def script():
    loader = importlib.machinery.SourceFileLoader("soak", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("soak", loader))
    loader.exec_module(module)
    return module


class Soak(unittest.TestCase):
    def test_half_a_minute(self):
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, SCRIPT, "0.008", "--out", folder], capture_output=True, text=True,
                                    stdin=subprocess.DEVNULL, timeout=120)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn("No trend.", result.stdout)
            lines = (Path(folder) / "samples.csv").read_text().splitlines()
            self.assertEqual(lines[0], "hours,memory,descriptors,threads,load,pings,late")
            self.assertGreaterEqual(len(lines), 3)
            picture = ElementTree.parse(Path(folder) / "soak.svg")
            self.assertEqual(len(picture.findall("{*}polyline")), 6)

    def test_what_grows_is_named(self):
        soak = script()

        def rows(growth):
            """Two hours, a row a minute; the memory also rises quickly at first, as that of every program does."""
            return [(m / 60, 200 - 50 / (1 + m) + growth * m / 60, 60, 14, 1.0, 120.0, 0.0) for m in range(120)]

        self.assertEqual(soak.table(rows(0))[1], [])
        self.assertEqual(soak.table(rows(20))[1], ["memory"])
        leaky = [(h, memory, 60 + round(10 * h), *rest) for h, memory, _, *rest in rows(0)]
        self.assertEqual(soak.table(leaky)[1], ["descriptors"])


if __name__ == "__main__":
    unittest.main()
