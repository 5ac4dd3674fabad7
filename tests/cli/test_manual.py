"""The manual page and the shells' completions."""
import os
import pathlib
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest


class Manual(ProgramTest):
    def need(self, tool):
        if shutil.which(tool) is None:
            if os.environ.get("CI") == "true":
                self.fail(f"{tool} is missing")
            self.skipTest(f"{tool} is not installed")

    def made(self, what):
        path = self.folder / what
        path.write_text(self.good("manual", what))
        return str(path)

    def shell(self, *command):
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        return subprocess.run(command, capture_output=True, text=True, timeout=60, env={**os.environ, "PATH": path},
                              cwd=self.folder, check=False)

    def test_mandoc_finds_nothing(self):
        self.need("mandoc")
        done = self.shell("mandoc", "-T", "lint", self.made("man"))
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_the_page_has_every_verb_and_option(self):
        self.need("mandoc")
        page = self.shell("mandoc", "-T", "ascii", "-O", "width=1000", self.made("man")).stdout
        page = "".join(c for i, c in enumerate(page) if c != "\b" and page[i + 1:i + 2] != "\b")
        for word in ("check", "examples", "--duration SECONDS", "--set PATH=VALUE", "CAPTURE", "EXIT STATUS"):
            self.assertIn(word, page)
        self.assertNotIn("echoloop manual", page)
        self.assertNotIn("manual", self.good("--help"))

    def complete_in_bash(self, *words):
        quoted = " ".join(f"'{word}'" for word in words)
        script = (f". {self.made('bash')}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
                  f"_echoloop echoloop '{words[-1]}' '{words[-2]}' 2>/dev/null; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        return self.shell("bash", "-c", script).stdout.split()

    def test_bash(self):
        self.assertEqual(self.complete_in_bash("echoloop", "exa"), ["examples"])
        self.assertEqual(self.complete_in_bash("echoloop", "run", "dem"), ["demo"])
        self.assertEqual(self.complete_in_bash("echoloop", "run", "--dur"), ["--duration"])
        self.assertEqual(self.complete_in_bash("echoloop", "list", "tritech-m"), ["tritech-micron"])
        self.assertEqual(self.complete_in_bash("echoloop", "endpoints", "demo", "--format", "ros"), ["ros1", "ros2"])
        (self.folder / "dive.pcapng").touch()
        self.assertEqual(self.complete_in_bash("echoloop", "inspect", "div"), ["dive.pcapng"])

    def test_fish(self):
        self.need("fish")

        def complete(line):
            done = self.shell("fish", "--no-config", "-c", f"source {self.made('fish')}; complete -C '{line}'")
            self.assertEqual(done.stderr, "")
            return [row.split("\t")[0] for row in done.stdout.splitlines()]

        self.assertEqual(complete("echoloop exa"), ["examples"])
        self.assertEqual(complete("echoloop run dem"), ["demo"])
        self.assertEqual(complete("echoloop run --dur"), ["--duration"])
        self.assertEqual(complete("echoloop endpoints demo --format ros"), ["ros1", "ros2"])

    def test_zsh(self):
        self.need("zsh")
        # The completion in a real line editor, on a pseudo-terminal of zsh's own.
        script = (f"zmodload zsh/zpty; zpty z zsh -f -i; "
                  f"zpty -w z \"autoload compinit; compinit -u -D; . {self.made('zsh')}; print re''ady\"; "
                  "zpty -r z text '*ready*' && zpty -n -w z $'echoloop run dem\\t--dur\\t' && "
                  "zpty -r z text '*demo*--duration*' && print good")
        self.assertEqual(self.shell("timeout", "20", "zsh", "-f", "-c", script).stdout.split()[-1:], ["good"])


if __name__ == "__main__":
    unittest.main()
