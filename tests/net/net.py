#!/usr/bin/env python3
"""A net under large changes: writes down everything that a program says, and shows what two programs say differently.

    tests/net/net.py record build/release/bin/echoloop before
    tests/net/net.py record build/release/bin/echoloop after --only 'models/ping*'
    tests/net/net.py compare before after

Exit status of compare: 0 all records are equal, 1 something differs or is missing.
"""

import argparse
import fnmatch
import json
import multiprocessing
import os
import shutil
import subprocess
import sys
import time
import traceback
from pathlib import Path

import texts
from cases import MODELS, TOGETHER
from compare import compare
from place import ROOT, Folder, enter_place
from options import optioned
from pictures import pictures, report
from stepped import recorded


def wires(run):
    return lambda program, folder: recorded(program, run, folder)


def said(write):
    def record(program, folder):
        shell = texts.Shell(program, folder)
        write(shell)
        return {"said.txt": folder.masked(shell.text)}

    return record


def records():
    """{name: what makes it, of a program and a folder: {file: bytes}}"""
    found = {f"models/{name}": wires(run) for name, run in MODELS.items()}
    found |= {f"together/{name}": wires(run) for name, run in TOGETHER.items()}
    found |= {f"pictures/{name}": pictures(run) for name, run in MODELS.items()}
    found |= {f"options/{name}": optioned(run) for name, run in MODELS.items()}
    found |= {"validate": report}
    found |= {f"texts/{f.__name__}": said(f) for f in (texts.help_texts, texts.lists, texts.tables, texts.scenario_mistakes,
                                                        texts.wrong_commands)}  # fmt: skip
    found |= {f"scenarios/{file.stem}": said(texts.scenario(file.stem)) for file in sorted((ROOT / "config").glob("*.yaml"))}
    found |= {f"frames/{file.name}": said(texts.frames(file.name)) for file in sorted((ROOT / "tests" / "data").iterdir())}
    found |= {f"bounds/{name}": said(texts.bounds(name)) for name in MODELS}
    return found


def make(job):
    """Runs in a process of its own: (name, seconds, None or what went wrong)."""
    name, program, out = job
    begin = time.monotonic()
    try:
        enter_place()
        with Folder() as folder:
            files = records()[name](program, folder)
        shutil.rmtree(out / name, ignore_errors=True)
        (out / name).mkdir(parents=True)
        for file, data in files.items():
            (out / name / file).write_bytes(data)
        return name, time.monotonic() - begin, None
    except Exception:
        return name, time.monotonic() - begin, traceback.format_exc()


def record(options):
    program, out = Path(options.program).resolve(), Path(options.out)
    names = [name for name in records() if fnmatch.fnmatch(name, options.only)]
    failed = 0
    with multiprocessing.Pool(options.jobs, maxtasksperchild=1) as pool:
        for name, seconds, fault in pool.imap_unordered(make, [(n, str(program), out) for n in names], chunksize=1):
            if options.verbose or fault:
                print(f"{seconds:6.1f} s  {name}{': ' + fault if fault else ''}", flush=True)
            failed += fault is not None
    listed = json.loads(subprocess.run([program, "list", "--json"], capture_output=True, check=True).stdout)["models"]
    silent = silent_models(out) + [m["name"] for m in listed if m["name"] not in MODELS]
    print(f"{len(names)} records in {out}, {failed} failed" + "".join(f"; {name} says nothing" for name in silent))
    return 1 if failed or silent else 0


def silent_models(out):
    return [file.parent.name for file in out.glob("models/*/heard.json") if sum(json.loads(file.read_text()).values()) == 0]


def options_line(file):
    return next(line.split("options: ")[1] for line in file.read_text().splitlines() if "options: " in line)


def heard(out):
    for file in sorted(out.glob("[mt]o*/*/heard.json")):
        counts = json.loads(file.read_text())
        print(f"{file.parent.relative_to(out)!s:28} " + ", ".join(f"{port.split('/', 1)[-1]} {n}" for port, n in counts.items()))
    for file in sorted(out.glob("options/*/*.heard.json")):
        if json.loads(file.read_text()) == {}:
            print(f"{file.parent.relative_to(out)}: nothing with {options_line(file.with_name(file.name.replace('heard.json', 'scenario.yaml')))}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    one = verbs.add_parser("record", help="write down what a program says")
    one.add_argument("program")
    one.add_argument("out", help="folder")
    one.add_argument("--only", default="*", metavar="PATTERN", help="these records, e.g. 'models/r2sonic*'")
    one.add_argument("--jobs", type=int, default=os.cpu_count())
    one.add_argument("--verbose", action="store_true", help="print the time of each record")
    two = verbs.add_parser("compare", help="two folders")
    two.add_argument("before", type=Path)
    two.add_argument("after", type=Path)
    two.add_argument("--only", default="*", metavar="PATTERN")
    two.add_argument("--verbose", action="store_true", help="print equal records, too")
    three = verbs.add_parser("heard", help="how many bytes each model said")
    three.add_argument("out", type=Path)
    options = parser.parse_args()
    if options.verb == "record":
        return record(options)
    if options.verb == "heard":
        return heard(options.out)
    return compare(options.before, options.after, options.only, options.verbose)


if __name__ == "__main__":
    sys.exit(main())
