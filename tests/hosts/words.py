#!/usr/bin/env python3
"""Words (samples as they stand on the wire) of a run and of a recording, side by side: how many are zero or pinned, where
they lie, how many different ones there are, and how far the two histograms are apart.

    echoloop run config/bathymetry.yaml --duration 5 --record run.pcapng
    tests/hosts/words.py i1.intensity run.pcapng recording.pcap --message BTH0
    tests/hosts/words.py reply.data run.pcapng recording.852 --items 50:400 --pinned 0:255

FIELD is the name of an array as `echoloop inspect FILE` prints it, FILE anything that `echoloop inspect` reads (ECHOLOOP names
another program). --items takes a part of each array, so that noise and bottom can be told apart. In a test:

    ours, real = words.of_file(run, "i1.intensity"), words.of_file(needs_data("..."), "i1.intensity")
    self.assertLess(words.distance(ours, real), 0.25)
"""

import argparse
import json
import math
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

PROGRAM = os.environ.get("ECHOLOOP", str(Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "echoloop"))
PARTS = (1, 5, 25, 50, 75, 95, 99)  # per cent
BINS = 40


def messages(file, name=None):
    """[{field: value}] of all messages of that name in a capture or recording, as `echoloop inspect` reads them."""
    done = subprocess.run([PROGRAM, "inspect", "--json", str(file)], capture_output=True, text=True)
    if not done.stdout:
        raise ValueError(f"{file}: echoloop inspect: {done.stderr.strip()}")
    found = [m for m in json.loads(done.stdout)["messages"] if m.get("fields") and name in (None, m["name"])]
    return [{field["name"]: field.get("value") for field in m["fields"]} for m in found]


def of_messages(found, field, first=0, last=None):
    """The words [first, last) of each array of that name, in one list. ValueError if there are none."""
    words = [word for m in found if field in m for word in m[field][first:last]]
    if not words:
        names = sorted({name for m in found for name, value in m.items() if isinstance(value, list)})
        raise ValueError(f"no words in {field!r}; arrays here: {', '.join(names) or 'none'}")
    return words


def of_file(file, field, name=None, first=0, last=None):
    return of_messages(messages(file, name), field, first, last)


def percentile(ordered, part):
    """By the nearest rank."""
    return ordered[max(0, math.ceil(part / 100 * len(ordered)) - 1)]


def summary(words, lowest=None, highest=None):
    """Figures by name; fractions are 0 to 1. `lowest`, `highest`: ends of the scale, else those of the words."""
    ordered = sorted(words)
    low = ordered[0] if lowest is None else lowest
    high = ordered[-1] if highest is None else highest
    count = len(ordered)
    return {
        "words": count, "distinct": len(set(ordered)), "zero": ordered.count(0) / count,
        "at lowest": ordered.count(low) / count, "at highest": ordered.count(high) / count,
        "min": ordered[0], "max": ordered[-1], "mean": sum(ordered) / count,
        **{f"{part} %": percentile(ordered, part) for part in PARTS},
    }


def classes(ours, theirs):
    """How to put words into classes that serve both: each by itself where they fit 8 bits, else 40 of equal width on
    log2(1 + |word|) with its sign, since wider ones are linear and span decades."""
    lowest, highest = min(min(ours), min(theirs)), max(max(ours), max(theirs))
    if highest - lowest < 256:
        return lambda word: word
    scale = lambda word: math.copysign(math.log2(1 + abs(word)), word)
    low, high = scale(lowest), scale(highest)
    return lambda word: min(BINS - 1, int((scale(word) - low) / (high - low) * BINS))


def distance(ours, theirs):
    """Jensen-Shannon distance of the histograms: the square root of the divergence in bits; 0 equal, 1 disjoint."""
    put = classes(ours, theirs)
    p, q = Counter(map(put, ours)), Counter(map(put, theirs))

    def divergence(one, count):
        total = 0
        for key, n in one.items():
            share = n / count
            total += share * math.log2(share / ((p[key] / len(ours) + q[key] / len(theirs)) / 2))
        return total

    return math.sqrt(max(0, (divergence(p, len(ours)) + divergence(q, len(theirs))) / 2))


def table(columns):
    """Lines of figures, one column for each {name: figure}."""
    text = lambda value: f"{value:.4g}" if isinstance(value, float) else str(value)
    return [f"{name:<12}" + "".join(f"{text(column[name]):>14}" for column in columns) for name in columns[0]]


def span(text):
    first, _, last = text.partition(":")
    return (float(first) if first else None), (float(last) if last else None)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("field")
    parser.add_argument("files", nargs="+", metavar="FILE", help="a run, and a recording to hold beside it")
    parser.add_argument("--message", help="of messages of this name only")
    parser.add_argument("--items", type=span, default=(None, None), metavar="FIRST:LAST", help="part of each array")
    parser.add_argument("--pinned", type=span, default=(None, None), metavar="LOW:HIGH", help="ends of the scale")
    a = parser.parse_args()
    first, last = (None if end is None else int(end) for end in a.items)
    try:
        found = [of_file(file, a.field, a.message, first, last) for file in a.files]
    except ValueError as fault:
        sys.exit(f"words: {fault}")
    print("\n".join(table([summary(words, *a.pinned) for words in found])))
    for file, words in zip(a.files[1:], found[1:]):
        print(f"distance of the histograms to {file}: {distance(found[0], words):.3f}")


if __name__ == "__main__":
    main()
