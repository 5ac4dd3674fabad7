"""The TypeScript of the page that shows a run holds what its types promise."""

import os
import shutil
import subprocess
import unittest
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "tools" / "view" / "page"


class Types(unittest.TestCase):
    def test_every_file_of_the_page(self):
        if shutil.which("tsc") is None:
            self.assertNotEqual(os.environ.get("CI"), "true", "tsc is missing: tools/install test")
            self.skipTest("tsc is missing: tools/install test")
        done = subprocess.run(["tsc", "--noEmit", "-p", str(PAGE)], capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
