"""Every field of a wire table is named like the member it stands for. A table that gives a member another member's name
would print and document the wrong thing while bytes still make their round trip.

Usage: field_names.py PROTOCOLS_FOLDER
"""
import pathlib
import re
import sys

MEMBER = r"\(\s*&\w+::(\w+)\s*,\s*"
COUNT = r'(?:"\w+"|\{[^}]*\})\s*,\s*'
FORMS = [re.compile(r"\b(?:field|section|list|tagged_list)" + MEMBER + r'"(\w+)"'),
         re.compile(r"\brest" + MEMBER + r'(?:\{[^}]*\})\s*,\s*"(\w+)"'),
         re.compile(r"\b(?:count|counted)" + MEMBER + COUNT + r'"(\w+)"'),
         re.compile(r'\bField\{\d+,\s*&\w+::(\w+)\s*,\s*"(\w+)"')]


def main():
    wrong, seen, members = [], 0, 0
    for path in sorted(pathlib.Path(sys.argv[1]).rglob("*layouts.h")):
        text = path.read_text(encoding="utf-8")
        members += len(re.findall(r"&\w+::\w+", text))
        for form in FORMS:
            for match in form.finditer(text):
                seen += 1
                if match.group(1) != match.group(2):
                    line = text.count("\n", 0, match.start()) + 1
                    wrong.append(f"{path}:{line}: member {match.group(1)} is named {match.group(2)}")
    print("\n".join(wrong))
    print(f"{seen} of {members} members looked at, {len(wrong)} wrong")
    return 1 if wrong or seen != members or seen == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
