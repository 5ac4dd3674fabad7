#!/usr/bin/env python3
"""C++ looks as .clang-format says, by the clang-format of Debian 12."""
import os
import pathlib
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLANG_FORMAT = shutil.which("clang-format-14")
TO_DO = "run: git ls-files '*.cpp' '*.h' | xargs clang-format-14 -i"


class Format(unittest.TestCase):
    def test_every_source_is_formatted(self):
        if CLANG_FORMAT is None and os.environ.get("CI") != "true":
            self.skipTest("clang-format is not installed: run tools/install test")
        files = [str(f) for folder in ("emulator", "protocols", "render", "tests", "tools")
                 for f in sorted((ROOT / folder).rglob("*")) if f.suffix in (".cpp", ".h")]
        result = subprocess.run([CLANG_FORMAT, "--dry-run", "-Werror", *files], capture_output=True, text=True,
                                check=False)
        wrong = sorted({line.split(":")[0] for line in result.stderr.splitlines() if "error:" in line})
        self.assertEqual((result.returncode, wrong), (0, []), TO_DO)


if __name__ == "__main__":
    unittest.main()
