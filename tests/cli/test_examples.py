"""Examples by their bare names, and copies of them."""
import subprocess
import unittest

from program import PROGRAM, ROOT, ProgramTest


class Examples(ProgramTest):
    def here(self, *arguments):
        """Runs the program in a folder that knows nothing of it."""
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120, check=False)

    def test_the_list_has_every_scenario_of_config(self):
        expected = sorted(path.stem for path in (ROOT / "config").glob("*.yaml"))
        self.assertEqual([e["name"] for e in self.json("examples")["examples"]], expected)
        self.assertRegex(self.good("examples"), r"(?m)^tank +A scanning sonar in a tank of 12 x 8 m")

    def test_a_bare_name_works_from_any_folder(self):
        for verb in ("check", "endpoints"):
            done = self.here(verb, "tank")
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_file_of_that_name_goes_first_and_a_folder_does_not(self):
        (self.folder / "demo").mkdir()
        self.assertEqual(self.here("check", "demo").returncode, 0)
        (self.folder / "tank").write_text("nonsense: 1\n")
        self.assertIn("tank:1:1: unknown key 'nonsense'", self.here("check", "tank").stderr)

    def test_a_name_that_nothing_has(self):
        done = self.here("check", "tnak")
        self.assertEqual(done.returncode, 66)
        self.assertIn("tnak: no such file, and no example is called so; did you mean 'tank'?", done.stderr)
        self.assertIn("no such file", self.bad(66, "check", "tank.yml"))

    def test_a_copy_is_whole_and_can_be_edited(self):
        done = self.here("examples", "copy", "moving", "dive")
        self.assertEqual(done.stdout.splitlines(), ["dive/moving.yaml", "dive/moving_auv.csv", "dive/scenes/manifold.glb"])
        self.assertEqual(self.here("check", "dive/moving.yaml").returncode, 0)
        copy = self.folder / "dive" / "moving.yaml"
        copy.write_text(copy.read_text().replace("range: 40", "rnage: 40"))
        wrong = self.here("check", "dive/moving.yaml")
        self.assertEqual(wrong.returncode, 78)
        self.assertRegex(wrong.stderr, r"dive/moving.yaml:\d+:\d+: .*rnage.*did you mean 'range'")
        # Another example with the same scene; a file that is there is nobody's to overwrite.
        self.assertEqual(self.here("examples", "copy", "demo", "dive").stdout, "dive/demo.yaml\n")
        again = self.here("examples", "copy", "moving", "dive")
        self.assertEqual(again.returncode, 73)
        self.assertIn("'dive/moving.yaml' exists already", again.stderr)

    def test_an_edited_scene_is_not_taken_for_the_example_s(self):
        (self.folder / "scenes").mkdir()
        (self.folder / "scenes" / "tank.glb").write_bytes(b"mine")
        done = self.here("examples", "copy", "tank")
        self.assertEqual(done.returncode, 73)
        self.assertEqual((self.folder / "scenes" / "tank.glb").read_bytes(), b"mine")
        self.assertFalse((self.folder / "tank.yaml").exists())

    def test_wrong_usage(self):
        self.assertIn("echoloop examples lists them", self.bad(64, "examples", "copy"))
        self.assertIn("did you mean 'demo'?", self.bad(64, "examples", "copy", "dmeo"))
        self.assertIn("copy", self.bad(64, "examples", "remove"))
        self.assertIn("cannot create", self.bad(73, "examples", "copy", "tank", "/proc/x"))


if __name__ == "__main__":
    unittest.main()
