"""The documentation says what the program does: message tables, models, scenarios."""

import json
import re
import subprocess
import unittest

from program import PROGRAM, ROOT


def output(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True, timeout=60).stdout


FAMILIES = re.findall(r'^sonar\.add_family\("(\w+)"', output("dissector"), re.M)


class Documentation(unittest.TestCase):
    def test_message_tables_are_those_of_the_codecs(self):
        for family in FAMILIES:
            with self.subTest(family):
                text = (ROOT / "docs" / f"messages-{family}.md").read_text()
                tables = text[text.index("## ") :]
                self.assertEqual(
                    tables.strip(),
                    output("inspect", "--tables", family).strip(),
                    f"run echoloop inspect --tables {family} again",
                )

    def test_readme_lists_every_model_and_each_has_its_papers(self):
        models = json.loads(output("list", "--json"))["models"]
        readme = (ROOT / "README.md").read_text()
        rows = re.findall(r"^\| ((?:`[a-z0-9-]+`(?:, )?)+) \|", readme, re.M)  # a series has one row
        listed = {name for row in rows for name in re.findall(r"`([a-z0-9-]+)`", row)}
        self.assertEqual(listed, {m["name"] for m in models})
        scenarios = "".join(p.read_text() for p in (ROOT / "config").glob("*.yaml"))
        for model in models:
            self.assertIn(f"model: {model['name']}", scenarios, "no scenario in config")
        for link in re.findall(r"\]\(([^)]+)\)", readme):
            self.assertTrue((ROOT / link).exists(), f"README links to {link}")

    def test_every_device_folder_has_a_readme_and_golden_bytes(self):
        shared = ROOT / "emulator" / "devices" / "family"  # what devices of one protocol share
        for folder in {path for path in (ROOT / "emulator" / "devices").iterdir() if path.is_dir()} - {shared}:
            self.assertTrue((folder / "README.md").exists(), folder.name)
        for family in FAMILIES:
            self.assertTrue(list((ROOT / "tests" / "data" / family).glob("*")), family)

    def test_every_model_has_a_profile_whose_figures_are_shown(self):
        for model in json.loads(output("list", "--json"))["models"]:
            text = (ROOT / "config" / "devices" / f"{model['name']}.yaml").read_text()
            written = set(re.findall(r"^(\w+):", text, re.M)) - {"model"}
            self.assertEqual(written, {figure["name"] for figure in model["profile"]})
            for figure in model["profile"]:
                self.assertTrue(figure["source"], figure["name"])

    def test_effects_are_listed_as_the_program_knows_them(self):
        text = (ROOT / "emulator" / "scenario" / "README.md").read_text()
        table = text[text.index("| effect |") : text.index("Each device:")]
        known = json.loads(output("check", str(ROOT / "config" / "tank.yaml"), "--json"))["effects"]
        self.assertEqual(re.findall(r"^\| `(\w+)` \|", table, re.M), list(known))

    def test_faults_are_listed_as_the_program_knows_them(self):
        text = (ROOT / "docs" / "faults.md").read_text()
        rows = re.findall(r"^\| `(\w+)` \|[^|]+\|([^|]*)\|$", text[text.index("| kind |") : text.index("Faults of one")], re.M)
        known = json.loads(output("list", "--faults", "--json"))["faults"]
        self.assertEqual([name for name, _ in rows], [fault["name"] for fault in known])
        for fault, (_, parameters) in zip(known, rows):
            self.assertEqual(re.findall(r"`(\w+)`", parameters), [p["name"] for p in fault["parameters"]], fault["name"])

    def test_the_example_of_a_drivers_test_is_the_one_that_is_tested(self):
        text = (ROOT / "docs" / "testing-drivers.md").read_text()
        for kind, file in (("cpp", "ping1d_test.cpp"), ("yaml", "ping1d.yaml")):
            (shown,) = re.findall(rf"```{kind}\n(.*?)```", text, re.S)
            tested = (ROOT / "tests" / "drivers" / "cpp" / file).read_text()
            self.assertEqual(shown, tested)
            self.assertLessEqual(len(tested.splitlines()), 40)

    def test_links_of_the_documentation_lead_somewhere(self):
        for page in (*(ROOT / "docs").glob("*.md"), ROOT / "tools" / "pytest" / "README.md"):
            for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text()):
                self.assertTrue((page.parent / link).exists(), f"{page.name} links to {link}")

    def test_every_scenario_of_config_is_good(self):
        for file in (ROOT / "config").glob("*.yaml"):
            with self.subTest(file.name):
                self.assertIn("good", output("check", str(file)))


if __name__ == "__main__":
    unittest.main()
