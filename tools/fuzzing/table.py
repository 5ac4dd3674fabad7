#!/usr/bin/env python3
"""Reads lines "TARGET EDGES RUNS" and writes the rows of these targets in the table of a page anew. What stood in a row as
edges becomes its edges before.
    table.py SECONDS PAGE"""
import pathlib
import subprocess
import sys

HEADING = "| target | edges | measured | runs | edges before | measured |"


def rows_of(page):
    """{target: cells} of the table under HEADING; and what stands before and behind it."""
    before, _, rest = page.partition(HEADING + "\n")
    lines = rest.splitlines()
    end = next((n for n, line in enumerate(lines) if not line.startswith("|")), len(lines))
    rows = {cells[0]: cells for cells in ([cell.strip() for cell in line.strip("|").split("|")] for line in lines[1:end])}
    return before, rows, "\n".join(lines[end:])


def renewed(page, results, measured):
    """The page with new rows for `results`, {target: (edges, runs)}; `measured` says when and how long."""
    before, rows, behind = rows_of(page)
    for target, (edges, runs) in results.items():
        old = rows.get(target, ["", "", "", "", "", ""])
        rows[target] = [target, edges, measured, runs, old[1], old[2]]
    table = ["|" + "|".join(f" {cell} " if cell else " " for cell in rows[target]) + "|" for target in sorted(rows)]
    return before + "\n".join([HEADING, "|---|---:|---|---:|---:|---|", *table]) + "\n" + (behind + "\n" if behind else "")


def main(seconds, path):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    results = {target: (edges, runs) for target, edges, runs in (line.split() for line in sys.stdin)}
    path.write_text(renewed(path.read_text(), results, f"{commit}, {seconds} s"))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
