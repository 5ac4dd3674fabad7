#!/usr/bin/env python3
"""The Debian packages: lintian finds nothing, and what they depend on is said."""
import pathlib
import subprocess
import tempfile
import unittest

from tools import BUILD, need


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        need("dpkg-shlibdeps")
        folder = tempfile.TemporaryDirectory(prefix="echoloop-debs-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run(["cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder], check=True,
                       stdout=subprocess.DEVNULL)
        cls.debs = sorted(cls.folder.glob("*.deb"))

    def field(self, deb, name):
        return subprocess.run(["dpkg-deb", "-f", deb, name], check=True, capture_output=True, text=True).stdout.strip()

    def the_program(self):
        return next(deb for deb in self.debs if self.field(deb, "Package") == "echoloop")

    def test_lintian_finds_nothing(self):
        need("lintian")
        done = subprocess.run(["lintian", "--allow-root", "--fail-on", "error,warning", *self.debs], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_what_is_loaded_at_run_time_is_a_dependency_too(self):
        depends = self.field(self.the_program(), "Depends")
        for name in ("libc6", "libyaml-cpp", "fonts-dejavu-core"):
            self.assertIn(name, depends)
        self.assertNotIn("mesa", depends, "scenes are drawn without OpenGL")
        self.assertIn("libosmesa6 | libegl1", self.field(self.the_program(), "Recommends"))
        self.assertNotIn("roscpp", depends)
        self.assertNotIn("ignition", depends)

    def test_debug_symbols_are_apart(self):
        for deb in self.debs:
            name = self.field(deb, "Package")
            self.assertEqual(len(list(self.folder.glob(f"{name}-dbgsym_*.ddeb"))), 1, name)
        self.assertLess(self.the_program().stat().st_size, 10e6)

    def test_no_file_names_the_folder_it_was_built_in(self):
        listing = subprocess.run(["dpkg-deb", "-c", self.the_program()], check=True, capture_output=True, text=True).stdout
        self.assertIn("./usr/bin/echoloop\n", listing)
        self.assertNotIn(str(BUILD), listing)


if __name__ == "__main__":
    unittest.main()
