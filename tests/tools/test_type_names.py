#!/usr/bin/env python3
"""No two headers give their types the same name. The linker would keep one of the two copies of whatever the compiler makes
of a type (its copies, a vector of it), and the other's users would run the wrong code. No compiler says so but by
optimising all sources together (-flto, -Wodr)."""
import collections
import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("protocols", "render", "emulator", "tools")

SPOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
OPENING = re.compile(r"\bnamespace\s*(?P<space>[\w:]*)\s*\{"
                     r"|\b(?:enum\s+(?:class\s+)?|class\s+|struct\s+|union\s+)(?P<type>\w+)\b[^;{}()=<>]*\{|[{}]")


def types_of(text):
    """Names with their namespaces of the types that a header defines, but for those within others."""
    around, found = [], []
    for token in OPENING.finditer(SPOKEN.sub(" ", text)):
        if token["space"] is not None:
            around.append(token["space"] or "(anonymous)")
        elif token["type"]:
            if None not in around:
                found.append("::".join([*around, token["type"]]))
            around.append(None)
        elif token[0] == "{":
            around.append(None)
        elif around:
            around.pop()
    return found


def shared_names(root):
    """{name: headers} of the names that several headers define."""
    headers = collections.defaultdict(list)
    for folder in FOLDERS:
        for header in sorted((root / folder).rglob("*.h")):
            for name in types_of(header.read_text()):
                headers[name].append(str(header.relative_to(root)))
    return {name: where for name, where in headers.items() if len(where) > 1}


class TypeNames(unittest.TestCase):
    def test_every_type_has_a_name_of_its_own(self):
        self.assertEqual(shared_names(ROOT), {})

    def test_it_finds_the_types_of_this_tree(self):
        found = types_of((ROOT / "render" / "view.h").read_text())
        self.assertIn("echoloop::View", found)
        self.assertIn("echoloop::Picture", found)

    def test_it_finds_two_of_a_name(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, text in {"render/a.h": "namespace echoloop {\nstruct View { int x; };  // class Other {\nclass Known;\n}",
                               "tools/b.h": "namespace echoloop {\nclass View final { struct Known {}; };\n}",
                               "tools/c.h": "namespace echoloop::view {\nenum class View { a };\nclass Known {};\n}"}.items():
                (root / path).parent.mkdir(exist_ok=True)
                (root / path).write_text(text)
            self.assertEqual(shared_names(root), {"echoloop::View": ["render/a.h", "tools/b.h"]})


if __name__ == "__main__":
    unittest.main()
