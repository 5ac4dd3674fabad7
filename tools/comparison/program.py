"""What echoloop itself renders and measures, as plain lists."""
import array
import json
import math
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))


def run(*arguments):
    """Standard output of the program; RuntimeError with what it says if it fails."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"echoloop {' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def read_npy(path):
    """Shape and values of a little-endian float32 array, row-major."""
    data = path.read_bytes()
    header = data[10:10 + int.from_bytes(data[8:10], "little")].decode()
    shape = tuple(int(n) for n in re.search(r"'shape': \(([\d, ]+)\)", header)[1].split(",") if n.strip())
    values = array.array("f", data[10 + len(header):])
    if sys.byteorder == "big":
        values.byteswap()
    assert len(values) == math.prod(shape), path
    return shape, values


def pixels(folder, scenario, *arguments):
    """(range in m, bearing in rad, cos of the incidence) of every pixel that shows something."""
    out = folder / "channels.npy"
    run("render", scenario, "--channels", "--out", out, *arguments)
    (_, height, width), values = read_npy(out)
    size = height * width
    return [(values[size + i], values[2 * size + i], values[i]) for i in range(size) if values[size + i] > 0]


def turn(folder, scenario, *arguments):
    """Ranges in m of the bins, and bearing in deg -> levels (uPa^2) of a head's turn, or of one ping."""
    out = folder / "turn.csv"
    run("render", scenario, "--out", out, *arguments)
    rows = [line.split(",") for line in out.read_text().splitlines()]
    return [float(r) for r in rows[0][1:]], {float(row[0]): [float(v) for v in row[1:]] for row in rows[1:]}


def measured(group):
    """quantity -> (figure of the recording, echoloop's) of a group of `echoloop validate`."""
    found = json.loads(run("validate", "--only", group, "--json"))["quantities"]
    return {row["quantity"]: (row["published"], row["ours"]) for row in found}
