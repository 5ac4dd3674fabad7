#!/usr/bin/env python3
"""Every source of the program compiles by itself. The build compiles a folder at a time, where one source may lean on what
another includes. Only in CI, since it takes about ten CPU-minutes."""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = pathlib.Path(os.environ.get("COMPILE_COMMANDS", ROOT / "build" / "release" / "compile_commands.json"))


def checks():
    """(source, words, folder) of a check for each source that the build reads behind another."""
    for entry in json.loads(COMMANDS.read_text()):
        unit = pathlib.Path(entry["file"])
        if "/Unity/" not in entry["file"] or not unit.exists():
            continue
        words = shlex.split(entry["command"])
        words = words[next(i for i, word in enumerate(words) if word.endswith("++")):]
        output = words.index("-o")
        words = [word for i, word in enumerate(words) if i not in (output, output + 1) and word not in ("-c", str(unit))]
        for source in re.findall(r'#include "(.+\.cpp)"', unit.read_text())[1:]:
            yield source, [*words, "-O0", "-w", "-fsyntax-only", source], entry["directory"]


def complaint(check):
    _, words, folder = check
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False).stderr


@unittest.skipUnless(os.environ.get("CI") == "true", "takes ten CPU-minutes: set CI=true to run it")
class Includes(unittest.TestCase):
    def test_every_source_compiles_by_itself(self):
        os.nice(19)  # other tests run beside it and measure time
        found = list(checks())
        self.assertTrue(found, f"{COMMANDS} compiles no folder at a time")
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for (source, _, _), text in zip(found, pool.map(complaint, found)):
                with self.subTest(source=source):
                    self.assertEqual(text, "")


if __name__ == "__main__":
    unittest.main()
