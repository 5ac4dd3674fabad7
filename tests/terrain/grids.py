"""A bottom that is made up here, as files of grids that GDAL's own tools write, and read again without GDAL."""

import math
import shutil
import struct
import subprocess
import tempfile
from pathlib import Path

COLUMNS, ROWS = 160, 120
NOTHING = -9999
HOLE = (range(20, 32), range(90, 110))  # rows, columns
LATITUDE, LONGITUDE = 59.4, 10.5  # of the middle
STEP_NORTH, STEP_EAST = 2 / 111_000, 2 / 56_000  # deg: about 2 m


def height(column, row):
    """m, of a sample; rows go from north to south."""
    return -25 + 2 * math.sin(column / 25) + 1.5 * math.cos(row / 20) - 0.01 * column + 0.05 * math.sin(column) * math.cos(row)


def samples(hole=True):
    return [[NOTHING if hole and r in HOLE[0] and c in HOLE[1] else height(c, r) for c in range(COLUMNS)]
            for r in range(ROWS)]


def tools_are_missing():
    return "GDAL's gdal_translate and gdalwarp (gdal-bin)" if shutil.which("gdal_translate") is None else ""


def run(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)


def write_asc(file, rows, left=0.0, bottom=0.0, cell=2.0, nothing=NOTHING):
    """Arc/Info's text: nothing of it is GDAL's."""
    head = f"ncols {len(rows[0])}\nnrows {len(rows)}\nxllcorner {left!r}\nyllcorner {bottom!r}\ncellsize {cell!r}\n"
    if nothing is not None:
        head += f"NODATA_value {nothing}\n"
    file.write_text(head + "\n".join(" ".join(f"{z:.6f}" for z in row) for row in rows) + "\n")


def write_geotiff(folder, rows):
    """In degrees, with the corners of the made-up bottom."""
    write_asc(folder / "plain.asc", rows)
    west, north = LONGITUDE - STEP_EAST * COLUMNS / 2, LATITUDE + STEP_NORTH * ROWS / 2
    run("gdal_translate", "-q", "-of", "GTiff", "-a_srs", "EPSG:4326", "-a_ullr", west, north,
        west + STEP_EAST * COLUMNS, north - STEP_NORTH * ROWS, "-co", "COMPRESS=DEFLATE", folder / "plain.asc",
        folder / "bottom.tif")
    return folder / "bottom.tif"


def write_netcdf(file, variables, latitudes, longitudes):
    """NetCDF's classic format as GEBCO and GMT use it: no projection, but axes in degrees. `variables`: {name: (rows,
    attributes)}; rows from south to north."""
    def text(s):
        return struct.pack(">I", len(s)) + s.encode() + bytes(-len(s) % 4)

    def attributes(pairs):
        out = struct.pack(">II", 12, len(pairs)) if pairs else bytes(8)
        return out + b"".join(text(k) + struct.pack(">I", 2) + text(v) for k, v in pairs.items())

    everything = [("lat", [0], {"units": "degrees_north"}, struct.pack(f">{len(latitudes)}d", *latitudes), 6),
                  ("lon", [1], {"units": "degrees_east"}, struct.pack(f">{len(longitudes)}d", *longitudes), 6)]
    everything += [(name, [0, 1], pairs, b"".join(struct.pack(f">{len(row)}f", *row) for row in rows), 5)
                   for name, (rows, pairs) in variables.items()]
    head = (b"CDF\x01" + bytes(4) + struct.pack(">II", 10, 2) + text("lat") + struct.pack(">I", len(latitudes))
            + text("lon") + struct.pack(">I", len(longitudes)) + attributes({"Conventions": "CF-1.6"})
            + struct.pack(">II", 11, len(everything)))
    entries = [text(name) + struct.pack(f">{1 + len(axes)}I", len(axes), *axes) + attributes(pairs)
               + struct.pack(">II", kind, len(data)) for name, axes, pairs, data, kind in everything]
    at = len(head) + sum(len(entry) + 4 for entry in entries)
    for entry, (_, _, _, data, _) in zip(entries, everything):
        head += entry + struct.pack(">I", at)
        at += len(data)
    file.write_bytes(head + b"".join(data for _, _, _, data, _ in everything))


def height_at(latitude, longitude):
    """Between the samples, evenly; None beyond them."""
    x = (longitude - LONGITUDE) / STEP_EAST + COLUMNS / 2 - 0.5
    y = (LATITUDE - latitude) / STEP_NORTH + ROWS / 2 - 0.5
    c, r = math.floor(x), math.floor(y)
    if not (0 <= c < COLUMNS - 1 and 0 <= r < ROWS - 1):
        return None
    u, v = x - c, y - r
    return ((1 - u) * (1 - v) * height(c, r) + u * (1 - v) * height(c + 1, r)
            + (1 - u) * v * height(c, r + 1) + u * v * height(c + 1, r + 1))


def folder_of(test):
    folder = Path(tempfile.mkdtemp(prefix="echoloop-terrain-"))
    test.addCleanup(shutil.rmtree, folder, ignore_errors=True)
    return folder
