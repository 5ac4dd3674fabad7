"""Shows the first difference of each file of two folders of records."""

import difflib
import fnmatch
import json

WIRE = "wire.jsonl"
CONTEXT = 16  # bytes before and behind a difference


def first_difference(a, b):
    """Offset of the first byte that is not the same."""
    for at in range(0, min(len(a), len(b)), 4096):
        if a[at : at + 4096] != b[at : at + 4096]:
            return next(i for i in range(at, at + 4096) if a[i : i + 1] != b[i : i + 1])
    return min(len(a), len(b))


def bytes_report(a, b):
    at = first_difference(a, b)
    begin, end = max(0, at - CONTEXT) // 8 * 8, at + CONTEXT
    count = sum(x != y for x, y in zip(a, b)) if len(a) == len(b) else None
    sizes = f"{count} of {len(a)} bytes" if count else f"{len(a)} and {len(b)} bytes"
    show = lambda data: data[begin:end].hex(" ")  # noqa: E731
    return f"    at byte {at}, {sizes} differ; from byte {begin} on\n      - {show(a)}\n      + {show(b)}"


def wire_report(a, b):
    """Of two logs of a run: step, end and bytes of the first word that is another one."""
    before, after = ([json.loads(line) for line in data.splitlines() if line] for data in (a, b))
    for one, two in zip(before, after):
        if one == two:
            continue
        if "hex" in one and "hex" in two and {k: v for k, v in one.items() if k != "hex"} == {k: v for k, v in two.items() if k != "hex"}:
            who = ", ".join(f"{k} {v}" for k, v in one.items() if k != "hex")
            return f"    {who}\n" + bytes_report(bytes.fromhex(one["hex"]), bytes.fromhex(two["hex"]))
        return f"      - {short(one)}\n      + {short(two)}"
    return f"    one ends early, {len(before)} and {len(after)} lines"


def short(line):
    text = json.dumps(line)
    return text if len(text) < 200 else text[:200] + f"... ({len(text)} characters)"


def text_report(a, b, most=24):
    lines = [data.decode("utf-8", "replace").splitlines() for data in (a, b)]
    same = next((i for i, (x, y) in enumerate(zip(*lines)) if x != y), min(map(len, lines)))
    windows = [part[max(0, same - 3) : same + 400] for part in lines]
    diff = list(difflib.unified_diff(*windows, lineterm="", n=2))[2:]
    return "\n".join([f"    from line {same + 1} on"] + ["    " + line[:220] for line in diff[:most]])


def report(name, a, b):
    if name.endswith(WIRE):
        return wire_report(a, b)
    if name.endswith((".txt", ".json", ".jsonl", ".yaml", ".csv")):
        return text_report(a, b)
    return bytes_report(a, b)


def files_of(folder, pattern):
    """{record: {file: path}}"""
    found = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        record = str(path.parent.relative_to(folder))
        if fnmatch.fnmatch(record, pattern):
            found.setdefault(record, {})[path.name] = path
    return found


def compare(before, after, pattern, verbose):
    """Prints what differs; 1 if anything does. A record that is only in `before` counts as missing: --only says which to
    compare."""
    old, new = files_of(before, pattern), files_of(after, pattern)
    different = 0
    for record in sorted(old.keys() | new.keys()):
        reports = []
        for name in sorted(old.get(record, {}).keys() | new.get(record, {}).keys()):
            a, b = (side.get(record, {}).get(name) for side in (old, new))
            if a is None or b is None:
                reports.append(f"  {name}: only in {before if b is None else after}")
            elif a.read_bytes() != b.read_bytes():
                reports.append(f"  {name}:\n" + report(name, a.read_bytes(), b.read_bytes()))
        different += bool(reports)
        if reports or verbose:
            print(f"{record}: {'differs' if reports else 'equal'}", *reports, sep="\n")
    print(f"{len(old.keys() | new.keys())} records, {different} differ")
    return 1 if different or not old else 0
