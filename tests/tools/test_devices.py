#!/usr/bin/env python3
"""Every model of the program has what a stranger and the next developer look for: README, profile, scenario, golden
bytes, a device test, a fuzz target of its protocol, a row in the main README."""
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))
SECTIONS = (r"^## What is (emulated|different)", r"^## What is not", r"^## Options")


def load(name):
    """A script of tools/ as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "tools" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


device_table = load("device_table")
MODELS = device_table.models()
FOLDERS = [(model["name"], device_table.folder_of(model["name"])) for model in MODELS]


def families(folder):
    """The protocols whose headers a device's folder includes, also by way of other folders of devices."""
    found, waiting, seen = set(), list(folder.glob("*.*")), set()
    while waiting:
        file = waiting.pop()
        if file in seen:
            continue
        seen.add(file)
        text = file.read_text()
        found |= set(re.findall(r'#include "protocols/(\w+)/', text)) - {"wire"}
        for header in re.findall(r'#include "(emulator/devices/[^"]+)\.h"', text):
            waiting += (ROOT / header).parent.glob(f"{pathlib.Path(header).name}.*")
    return found


def reads_bytes(family):
    return any(re.search(r"\b(parse|decode|read)\w*\(|\bFramer\b", header.read_text())
               for header in (ROOT / "protocols" / family).glob("*.h"))


def absorption(kilohertz):
    """dB/m by Francois & Garrison, JASA 72 (1982) 1879, at 10 degC, salinity 35, pH 8 and the surface; apart from the
    program's own."""
    f, t, s, ph = kilohertz, 10, 35, 8
    c = 1412 + 3.21 * t + 1.19 * s
    f1, f2 = 2.8 * 10 ** (4 - 1245 / (t + 273)), 8.17 * 10 ** (8 - 1990 / (t + 273))
    boric = 8.86 / c * 10 ** (0.78 * ph - 5) * f1 * f ** 2 / (f ** 2 + f1 ** 2)
    magnesium = 21.44 * s / c * (1 + 0.025 * t) * f2 * f ** 2 / (f ** 2 + f2 ** 2)
    return (boric + magnesium + (4.937e-4 - 2.59e-5 * t + 9.11e-7 * t ** 2 - 1.5e-8 * t ** 3) * f ** 2) / 1000


class EveryModel(unittest.TestCase):
    def test_has_a_readme_that_says_what_is_emulated_what_not_and_from_where(self):
        for name, folder in FOLDERS:
            with self.subTest(name):
                text = (folder / "README.md").read_text()
                for section in SECTIONS:
                    self.assertRegex(text, re.compile(section, re.M))
                self.assertRegex(text, r"(?i)\bsource", f"{name}: where do the numbers come from?")
                self.assertLess(len(device_table.few_words(folder / "README.md")), 160, "few words for the main README")

    def test_says_how_long_it_takes_between_echo_and_answer(self):
        """Nothing is published of most: then it is an option, and the README says so."""
        for model, (name, folder) in zip(MODELS, FOLDERS):
            if any(option["name"] == "processing_time" for option in model["options"]):
                with self.subTest(name):
                    shared = (ROOT / "emulator" / "devices" / "nmea-echosounder" / "README.md").read_text()
                    text = (folder / "README.md").read_text()
                    if "as in the `nmea-echosounder`" in text:
                        text += shared
                    self.assertIn("`processing_time`", text)

    def test_has_a_profile_with_a_source_for_every_figure(self):
        for model in MODELS:
            with self.subTest(model["name"]):
                self.assertTrue((ROOT / "config" / "devices" / f"{model['name']}.yaml").exists())
                self.assertTrue(model["profile"])
                for figure in model["profile"]:
                    self.assertGreater(len(figure["source"]), 8, figure["name"])

    def test_has_the_absorption_that_its_source_says(self):
        claim, units = re.compile(r"Francois & Garrison 1982 at ([\d.]+) ([kM])Hz, 10 degC, salinity 35"), {"k": 1, "M": 1000}
        checked = 0
        for model in MODELS:
            for figure in model["profile"]:
                if said := claim.search(figure["source"]):
                    with self.subTest(f"{model['name']} {figure['name']}"):
                        exact = absorption(float(said[1]) * units[said[2]])
                        self.assertAlmostEqual(figure["value"] / exact, 1, delta=0.025)
                        checked += 1
        self.assertGreater(checked, 20)

    def test_has_a_scenario_that_check_accepts(self):
        for name, _ in FOLDERS:
            with self.subTest(name):
                used = [f for f in sorted((ROOT / "config").glob("*.yaml"))
                        if re.search(rf"model: *{re.escape(name)}\b(?!-)", f.read_text())]
                self.assertTrue(used, "no scenario in config has it")
                done = subprocess.run([PROGRAM, "check", used[0], "--json"], capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(name, [d["model"] for d in json.loads(done.stdout)["devices"]])

    def test_has_golden_bytes_of_its_protocol(self):
        for name, folder in FOLDERS:
            with self.subTest(name):
                spoken = families(folder)
                self.assertTrue(spoken, "it includes no protocol")
                for family in spoken:
                    files = list((ROOT / "tests" / "data" / family).glob("*.hex"))
                    self.assertTrue(files, f"no tests/data/{family}/*.hex")
                    for file in files:
                        self.assertIn("#", file.read_text(), f"{file.name}: what is it, and from where?")

    def test_has_a_device_test(self):
        tests = {f.name: f.read_text() for f in (ROOT / "tests" / "emulator" / "devices").glob("*")
                 if f.suffix in (".cpp", ".h") and f.name not in ("devices_fuzz.cpp", "profile_test.cpp")}
        for name, _ in FOLDERS:
            with self.subTest(name):
                self.assertTrue([f for f, text in tests.items() if f'"{name}"' in text], "no test makes one")

    def test_has_a_fuzz_target_of_its_protocol(self):
        targets = [f.read_text() for f in (ROOT / "tests" / "protocols").glob("fuzz_*.cpp")]
        for name, folder in FOLDERS:
            with self.subTest(name):
                for family in filter(reads_bytes, families(folder)):
                    own = [text for text in targets if f'"protocols/{family}/' in text]
                    self.assertTrue(own, f"no fuzz target includes protocols/{family}")

    def test_has_a_row_in_the_main_readme(self):
        text = (ROOT / "README.md").read_text()
        begin, end = device_table.in_text(text)
        self.assertEqual(text[begin:end], device_table.table(MODELS), "run tools/device_table --write")


if __name__ == "__main__":
    unittest.main()
