#!/usr/bin/env python3
"""cmake --install: the program works from its prefix, with its examples, from any folder."""
import pathlib
import subprocess
import tempfile
import unittest

from tools import BUILD, need


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="echoloop-install-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.prefix = pathlib.Path(cls.folder.name) / "opt"
        subprocess.run(["cmake", "--install", BUILD, "--component", "echoloop", "--prefix", cls.prefix],
                       check=True, stdout=subprocess.DEVNULL)

    def run_program(self, *arguments):
        return subprocess.run([self.prefix / "bin" / "echoloop", *arguments], cwd=self.folder.name, capture_output=True,
                              text=True, timeout=120, check=False)

    def test_a_bare_name_is_an_example_of_the_prefix(self):
        done = self.run_program("check", "tank")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"{self.prefix}/share/echoloop/examples/tank.yaml: good", done.stdout)

    def test_every_example_is_good(self):
        names = [line.split()[0] for line in self.run_program("examples").stdout.splitlines()]
        self.assertIn("demo", names)
        for name in names:
            done = self.run_program("endpoints", name)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    def test_a_picture_can_be_drawn(self):
        done = self.run_program("render", "demo", "--step", "0", "--out", "x.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((pathlib.Path(self.folder.name) / "x.png").read_bytes()[1:4], b"PNG")

    def test_a_program_without_its_examples_says_so(self):
        alone = pathlib.Path(self.folder.name) / "alone" / "bin"
        alone.mkdir(parents=True)
        (alone / "echoloop").write_bytes((self.prefix / "bin" / "echoloop").read_bytes())
        (alone / "echoloop").chmod(0o755)
        done = subprocess.run([alone / "echoloop", "examples"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 66)
        self.assertIn(f"no examples in {alone.parent}/share/echoloop/examples; install the program again", done.stderr)

    def test_what_is_where_others_look(self):
        share = self.prefix / "share"
        for path in ("man/man1/echoloop.1.gz", "bash-completion/completions/echoloop", "zsh/vendor-completions/_echoloop",
                     "fish/vendor_completions.d/echoloop.fish", "doc/echoloop/copyright", "doc/echoloop/docs/faults.md",
                     "echoloop/devices/ping1d.yaml", "echoloop/examples/scenes/tank.glb"):
            self.assertTrue((share / path).is_file(), path)
        self.assertTrue((self.prefix / "lib/systemd/system/echoloop@.service").is_file())
        self.assertEqual(len(list(self.prefix.glob("lib/*/wireshark/plugins/echoloop.lua"))), 1)

    def test_mandoc_finds_nothing_in_the_manual_pages(self):
        need("mandoc")
        pages = sorted((self.prefix / "share/man/man1").iterdir())
        self.assertEqual([page.name for page in pages], ["echoloop-pose-rosbridge.1.gz", "echoloop-truth-rosbridge.1.gz", "echoloop.1.gz"])
        for page in pages:
            done = subprocess.run(["mandoc", "-T", "lint", page], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""), page.name)


if __name__ == "__main__":
    unittest.main()
