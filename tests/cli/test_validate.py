"""echoloop validate: its table, its exit status, and that the committed report is about the same quantities and tells of the same
misses."""
import json
import os
import re
import subprocess
import unittest

from program import PROGRAM, ROOT, ProgramTest, run

IDS = [f"V{n}" for n in (*range(1, 33), *range(34, 41))] + [f"R{n}" for n in range(1, 8)]
HEADINGS = ("id", "quantity", "unit", "published", "ours", "tolerance", "pass", "kind", "source")
DATA = ROOT.parent / "shared" / "data"


def rows_of(report):
    """The rows of all tables of a Markdown report."""
    cells = [[cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
             for line in report.splitlines() if re.match(r"\| [VR]\d+ \|", line)]
    return [dict(zip(HEADINGS, row)) for row in cells]


class Whole(ProgramTest):
    """One run of all checks, looked at from several sides."""

    @classmethod
    def setUpClass(cls):
        done = run("validate", "--json")
        cls.status, cls.errors = done.returncode, done.stderr.decode()
        cls.document = json.loads(done.stdout)
        cls.quantities = cls.document["quantities"]

    def test_every_quantity_is_within_its_tolerance(self):
        self.assertEqual([q for q in self.quantities if q["required"] and not q["pass"]], [])
        self.assertEqual((self.status, self.document["ok"], self.document["failed"], self.errors), (0, True, 0, ""))

    def test_all_are_there_in_order_each_quantity_once(self):
        self.assertEqual(list(dict.fromkeys(q["id"] for q in self.quantities)), IDS)
        names = [(q["id"], q["quantity"]) for q in self.quantities]
        self.assertEqual(len(set(names)), len(names))

    def test_verdicts_follow_the_figures(self):
        for q in self.quantities:
            passed = {"within": abs(q["ours"] - q["published"]) <= q["tolerance"],
                      "at_most": q["ours"] <= q["published"], "at_least": q["ours"] >= q["published"]}[q["bound"]]
            self.assertEqual(q["pass"], passed, q)
            self.assertTrue(q["source"], q)
            self.assertTrue(q["bound"] != "within" or q["tolerance"] > 0, q)
            self.assertEqual(q["required"], q["kind"] != "recording", q)

    def test_one_thread_of_mesa_on_one_processor_gives_the_same_figures(self):
        done = subprocess.run([PROGRAM, "validate", "--json"], capture_output=True, check=True,
                              env={**os.environ, "LP_NUM_THREADS": "0"},
                              preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
        self.assertEqual(json.loads(done.stdout)["quantities"], self.quantities)

    def test_the_committed_report_is_about_the_same_quantities(self):
        text = (ROOT / "docs" / "validation.md").read_text()
        keys = ("id", "quantity", "unit", "published", "tolerance", "kind", "source")
        signs = {"within": "", "at_most": "<= ", "at_least": ">= "}
        ours = [{"id": q["id"], "quantity": q["quantity"], "unit": q["unit"], "source": q["source"],
                 "kind": q["kind"],
                 "published": f"{signs[q['bound']]}{q['published']:.8g}",
                 "tolerance": f"+-{q['tolerance']:.8g}" if q["bound"] == "within" else ""} for q in self.quantities]
        committed = [{key: row[key] for key in keys} for row in rows_of(text)]
        self.assertEqual(committed, ours, "run echoloop validate --report docs/validation.md and commit what it writes")
        self.assertNotIn("**no**", text)
        met = {(row["id"], row["quantity"]): row["pass"] for row in rows_of(text)}
        worse = [q for q in self.quantities if not q["pass"] and met[q["id"], q["quantity"]] == "yes"]
        self.assertEqual(worse, [], "aims that docs/validation.md calls met are missed now")
        for picture in re.findall(r"\]\((pictures/[^)]+)\)", text):
            self.assertTrue((ROOT / "docs" / picture).is_file(), picture)


class Validate(ProgramTest):
    def test_chosen_checks_as_text(self):
        text = self.good("validate", "--only", "V2,V14")
        self.assertRegex(text, r"(?m)^V2 Absorption$")
        self.assertRegex(text, r"(?m)^  200 kHz, pH 7.8 +54.411284 +54.411284 .*pass$")
        self.assertNotIn("V5", text)
        self.assertRegex(text, r"(?m)^(\d+) of \1 quantities are within their tolerance$")
        self.assertNotIn("\033", text)

    def test_report_with_its_pictures(self):
        file = self.folder / "report.md"
        self.good("validate", "--only", "V1,V14", "--report", file)
        rows = rows_of(file.read_text())
        self.assertEqual({row["id"] for row in rows}, {"V1", "V14"})
        (picture,) = re.findall(r"\]\(([^)]+)\)", file.read_text())
        self.assertEqual((self.folder / picture).read_bytes()[:4], b"\x89PNG")

    def test_recordings_add_rows_that_read_them(self):
        if not DATA.is_dir():
            if os.environ.get("CI") == "true":
                self.fail(f"{DATA} is missing and CI is true")
            self.skipTest(f"{DATA} is missing: no recordings to compare with")
        quantities = json.loads(self.good("validate", "--only", "R1,R2,R3,R6", "--recordings", DATA, "--json"))["quantities"]
        for name in ("three_pings_8bit.raw", "hydroball.852", "r2sonic_bth0_20.pcap", "ship_short.sonar"):
            self.assertTrue([q for q in quantities if name in q["source"]], name)
        found = {q["quantity"]: q for q in quantities}
        # The figure of the specification for 100 pings and the same of the 20 that are here.
        for angle, figure in ((5, 0.087), (15, 0.075), (25, 0.071), (45, 0.023)):
            self.assertAlmostEqual(found[f"noise beside the file, {angle} deg"]["published"] / figure, 1, delta=0.15)
        self.assertAlmostEqual(found["noise of the file, neighbouring beams"]["published"], 0.53, delta=0.03)
        self.assertAlmostEqual(found["flips of the file"]["published"], 0.23, delta=0.01)
        self.assertAlmostEqual(found["isolated returns of the file"]["published"], 0.038, delta=0.002)
        self.assertAlmostEqual(found["variation behind the bottom's edge of the file"]["published"], 0.55, delta=0.02)

    def test_wrong_usage(self):
        self.assertIn("--recordings: there is no folder", self.bad(66, "validate", "--recordings", "/nowhere"))
        self.assertIn("--only: there is no check 'V99'", self.bad(64, "validate", "--only", "V99"))
        self.assertIn("cannot create", self.bad(73, "validate", "--report", "/proc/x.md"))

    def test_colours_are_for_terminals(self):
        check = ("validate", "--only", "V14")
        self.assertIn("\x1b[32mpass", self.on_a_terminal(*check, streams=("stdout", "stderr"), NO_COLOR=""))
        self.assertNotIn("\x1b[32m", self.on_a_terminal(*check, streams=("stdout", "stderr"), NO_COLOR="1"))


if __name__ == "__main__":
    unittest.main()
