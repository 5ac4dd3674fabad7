#!/usr/bin/env python3
"""shellcheck finds nothing in the project's shell scripts."""
import subprocess
import unittest

from tools import ROOT, need

FOLDERS = (".ci", "packaging", "tests", "tools")
SHELLS = (b"#!/bin/sh", b"#!/bin/bash", b"#!/usr/bin/env bash", b"# shellcheck shell=")


def scripts():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.is_file() and path.suffix not in (".glb", ".pcap"):
                with open(path, "rb") as file:
                    if file.readline().startswith(SHELLS):
                        yield str(path.relative_to(ROOT))


class Scripts(unittest.TestCase):
    def test_shellcheck_finds_nothing(self):
        need("shellcheck")
        found = list(scripts())
        self.assertIn("tools/install", found)
        self.assertIn("packaging/debian/postinst", found)
        done = subprocess.run(["shellcheck", "-x", *found], cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
