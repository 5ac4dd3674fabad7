"""The message tables of the codec are those of the maker's own Python package: ids, order, types and names of fields."""

import re
import subprocess
import unittest

import public_driver

public_driver.use("ping360", "brping")

from brping import definitions  # noqa: E402
from program import PROGRAM  # noqa: E402

LETTERS = {"u8": "B", "u16": "H", "u32": "I"}
SHORTER = {  # name in the package: name in the tables
    "nack_message": "text",
    "ascii_message": "text",
    "version_major": "major",
    "version_minor": "minor",
    "version_patch": "patch",
    "firmware_version_major": "firmware_major",
    "firmware_version_minor": "firmware_minor",
    "firmware_version_patch": "firmware_patch",
}


def tables():
    """{id: [(type, name)]} of every message that `echoloop inspect --tables ping` shows."""
    text = subprocess.run(
        [PROGRAM, "inspect", "--tables", "ping"], capture_output=True, text=True, check=True, timeout=60
    ).stdout
    ids = {name: int(number) for number, name in re.findall(r"(\d+) (\w+)[; ]", re.search(r"`id`.*", text)[0])}
    found = {}
    for section in text.split("### ")[1:]:
        name = section.split("\n")[0].strip()
        if name in ids:
            found[ids[name]] = re.findall(r"^\| \d* \| (\S+) \| `(\w+)` \|", section, re.M)
    return found


class Messages(unittest.TestCase):
    def test_every_message_of_the_package_stands_in_the_tables(self):
        ours = tables()
        checked = 0
        for group in ("common", "ping1d", "ping360"):
            for number, theirs in getattr(definitions, f"payload_dict_{group}").items():
                with self.subTest(theirs["name"]):
                    fields = ours[number]
                    numbers = "".join(LETTERS[kind] for kind, _ in fields if kind in LETTERS)
                    self.assertEqual(numbers, theirs["format"])
                    names = tuple(SHORTER.get(name, name) for name in theirs["field_names"])
                    self.assertEqual(tuple(name for _, name in fields), names)
                    checked += 1
        self.assertGreaterEqual(checked, 40)


if __name__ == "__main__":
    unittest.main()
