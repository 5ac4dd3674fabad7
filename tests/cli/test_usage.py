"""Help, usage errors, exit statuses and colours."""
import subprocess
import unittest

from program import PROGRAM, TANK, ProgramTest, run

VERBS = ["run", "check", "list", "endpoints", "render", "inspect", "convert", "bench", "validate"]


class Usage(ProgramTest):
    def test_help_names_every_verb_and_every_verb_has_examples(self):
        text = self.good("--help")
        for verb in VERBS:
            self.assertRegex(text, rf"(?m)^  {verb} +\S")
            self.assertIn("Examples:\n  ", self.good(verb, "--help"))
            self.assertIn(f"echoloop {verb}", self.good(verb, "--help"))

    def test_version(self):
        self.assertRegex(self.good("--version"), r"^echoloop \d+\.\d+\.\d+\n$")

    def test_wrong_usage_ends_with_64_and_says_what_would_be_right(self):
        self.assertIn("which verb? see echoloop --help", self.bad(64))
        self.assertIn("unknown verb 'chekc'; did you mean 'check'?", self.bad(64, "chekc"))
        self.assertIn("FILE is required; see echoloop check --help", self.bad(64, "check"))
        self.assertIn("unknown option '--durtion' of run; did you mean '--duration'?",
                      self.bad(64, "run", TANK, "--durtion", "3"))
        self.assertIn("unknown option '--rnage' of render; did you mean '--range'?",
                      self.bad(64, "render", TANK, "--rnage=3"))
        self.assertIn("--frobnicate", self.bad(64, "list", "--frobnicate"))
        self.assertIn("ros1", self.bad(64, "endpoints", TANK, "--format", "ros3"))
        self.assertIn("--duration: expected a number, 0 to 1000000000, got 'long'",
                      self.bad(64, "run", TANK, "--duration", "long"))

    def test_a_full_disk_under_standard_output_ends_with_74(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([PROGRAM, "list"], stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 74)
        self.assertIn(b"cannot write to standard output", done.stderr)

    def test_errors_are_red_on_a_terminal_only_and_never_with_NO_COLOR(self):
        self.assertIn("\x1b[1;31merror", self.on_a_terminal("nonsense", status=64, NO_COLOR=""))
        self.assertNotIn("\x1b", self.on_a_terminal("nonsense", status=64, NO_COLOR="1"))
        self.assertNotIn(b"\x1b", run("nonsense").stderr)


if __name__ == "__main__":
    unittest.main()
