#!/usr/bin/env python3
"""tools/new_sonar, run in a copy of the sources: it writes what it says, in the module graph, and what compiles; it
refuses names that are taken or malformed and then changes nothing."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import include_graph

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILE = ["g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"]


class NewSonar(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for part in ("protocols", "render", "emulator", "config", "tools", "tests"):
            shutil.copytree(ROOT / part, self.root / part, ignore=shutil.ignore_patterns("*.glb", "*.png", "__pycache__"))
        self.before = self.contents()

    def contents(self):
        return {str(file.relative_to(self.root)): file.read_bytes() for file in self.root.rglob("*") if file.is_file()}

    def new_sonar(self, *arguments):
        return subprocess.run([self.root / "tools" / "new_sonar", *arguments], capture_output=True, text=True,
                              timeout=60, check=False)

    def make(self, *arguments):
        """What it wrote and what it changed, both by its own words and in truth."""
        done = self.new_sonar(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        after = self.contents()
        wrote = {name for name in after if name not in self.before}
        changed = {name for name in self.before if after.get(name) != self.before[name]}
        self.assertEqual(set(re.findall(r"^wrote +(\S+)", done.stdout, re.M)), wrote)
        self.assertEqual(set(re.findall(r"^changed +(\S+)", done.stdout, re.M)), changed)
        for name in wrote:
            self.assertNotRegex(after[name].decode(), "@[A-Z_]+@", name)
        self.assertEqual(include_graph.faults(self.root), [])
        return wrote, changed

    def check_syntax(self, names):
        """All sources in one run of the compiler. A fuzz target comes first: it opens the family's namespace, which would
        clash with names that layouts.h opens."""
        sources = sorted((name for name in names if name.endswith(".cpp")), key=lambda name: "/fuzz_" not in name)
        text = "".join(f'#include "{name}"\n' for name in sources)
        done = subprocess.run([*COMPILE, "-I", self.root, "-x", "c++", "-"], input=text, capture_output=True, text=True,
                              timeout=600, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_of_a_known_family_touches_the_table_of_models_only(self):
        wrote, changed = self.make("acme-echo", "--family", "ping", "--ports", "serial,udp:9090")
        self.assertEqual(changed, {"emulator/devices/models.cpp"})
        folder = "emulator/devices/acme-echo"
        self.assertEqual(wrote, {*(f"{folder}/{name}" for name in ("acme_echo.h", "acme_echo.cpp", "settings.h",
                                                                   "settings.cpp", "model.cpp", "README.md")),
                                 "config/devices/acme-echo.yaml", "config/acme-echo.yaml",
                                 "tests/emulator/devices/acme_echo_test.cpp"})
        self.check_syntax(wrote | changed)

    def test_of_a_new_family_touches_the_table_of_families_too(self):
        wrote, changed = self.make("zeta", "--family", "acme", "--ports", "tcp:4001")
        self.assertEqual(changed, {"emulator/devices/models.cpp", "protocols/inspect.cpp"})
        for name in ("protocols/acme/codec.h", "tests/data/acme/made_up.hex", "tests/protocols/acme_test.cpp",
                     "tests/protocols/fuzz_acme.cpp", "tools/echoloop/dissector/families/acme.lua"):
            self.assertIn(name, wrote)
        self.check_syntax(wrote | changed)

    def test_refuses_what_is_taken_or_malformed_and_changes_nothing(self):
        for model, family, ports, said in (("ping360", "ping", "serial", "is there already"),
                                           ("oculus-m750d", "oculus", "serial", "is there already"),
                                           ("norbit", "norbit", "tcp:1", "already|choose another name"),
                                           ("Acme", "ping", "serial", "no name of a model"),
                                           ("acme_echo", "ping", "serial", "no name of a model"),
                                           ("../acme", "ping", "serial", "no name of a model"),
                                           ("acme", "Acme", "serial", "no name of a family"),
                                           ("acme", "wire", "serial", "it is no family"),
                                           ("acme", "inspect", "serial", "it is no family"),
                                           ("acme", "ping", "usb", "is no port"),
                                           ("acme", "ping", "tcp", "is no port"),
                                           ("acme", "ping", "udp:65536", "is no port"),
                                           ("acme", "ping", "udp:1,udp:2", "once each")):
            with self.subTest(f"{model} {family} {ports}"):
                done = self.new_sonar(model, "--family", family, "--ports", ports)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, said)
                self.assertEqual(self.contents(), self.before)


if __name__ == "__main__":
    unittest.main()
