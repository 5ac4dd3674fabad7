"""A scene with known geometry, runs of it that write data sets, and a data set as a user reads it: zarr, Pillow and
pycocotools from PyPI."""

import functools
import hashlib
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import public_driver

public_driver.use("dataset", "pycocotools")
sys.path.insert(0, str(public_driver.ROOT / "tools"))

import numpy as np  # noqa: E402
import zarr  # noqa: E402
from PIL import Image  # noqa: E402
from program import PROGRAM  # noqa: E402
from pycocotools.coco import COCO  # noqa: E402
from scenes.glb import Node, glb  # noqa: E402
from scenes.materials import SONAR  # noqa: E402
from scenes.mesh import Mesh  # noqa: E402

ROOT = public_driver.ROOT
WALL = 12.0                                    # m ahead
BALL, RADIUS = (5.0, 1.5, 0.0), 0.8            # to port, seen from the sonar
BOARD, SCREEN = (8.0, -3.0, -2.0), (6.0, -1.875, -1.2)  # x, y, y: the screen hides the board from y = -2.5 on
TALL, FACETS = 20.0, 128
RUN = """
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
vehicle: {pose: {position: [1, 2, -30]}}
clock: {mode: free, duration: %s}
devices:
"""
FAN = """  - name: fan
    model: r2sonic-2024
    endpoints: ["udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400"]
    options: {range: 20, ping_rate: 2, image_height: 400, water_column: magnitude}
"""
HEAD = """  - name: head
    model: ping360
    mount: {position: [10.6, 0, 0]}
    endpoints: ["udp-listen://127.0.0.1:9092"]
    pings: {interval: 0.1, count: 430}
"""
SOUNDER = """  - name: sounder
    model: ping1d
    endpoints: ["udp-listen://127.0.0.1:9093"]
    pings: {interval: 0.5, count: 4}
"""
ROWS = """  - name: rows
    model: sonar-3d-15
    endpoints: ["tcp-listen://127.0.0.1:8080"]
    options: {acoustics: true}
"""


def plate(x, left, right):
    """Faces the sonar, from y `left` to `right`."""
    mesh = Mesh()
    mesh.quad((x, right, -TALL), (x, left, -TALL), (x, left, TALL), (x, right, TALL))
    return mesh


def scene():
    ball = Mesh()
    ball.sphere((0, 0, 0), RADIUS, FACETS, FACETS // 2)
    nodes = [Node("wall", [("concrete", plate(WALL, -40, 40))]), Node("ball", [("steel", ball)], position=BALL),
             Node("board", [("rock", plate(*BOARD))]), Node("screen", [("steel", plate(*SCREEN))])]
    for node in nodes:  # about the vehicle
        node.position = tuple(a + b for a, b in zip(node.position, (1, 2, -30), strict=True))
    return glb(nodes, SONAR)


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)


def sum_of(folder):
    total = hashlib.sha256()
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            total.update(str(file.relative_to(folder)).encode() + file.read_bytes())
    return total.hexdigest()


class Data:
    """A data set as a user reads it."""

    def __init__(self, folder):
        self.folder = folder
        self.index = [json.loads(line) for line in (folder / "index.jsonl").read_text().splitlines()]
        self.truth = [json.loads(line) for line in (folder / "truth.jsonl").read_text().splitlines()]
        self.coco = COCO(folder / "coco.json")
        self.numbers = {c["name"]: c["id"] for c in self.coco.cats.values()}

    def array(self, line, name):
        array = zarr.open(self.folder / line[name], mode="r")
        return array[line["at"]], dict(array.attrs)

    def picture(self, line, kind):
        file = line["pictures"][kind]["file"]
        image = Image.open(self.folder / file)
        assert image.mode == "I;16", image.mode
        return np.array(image).astype(int), file

    def masks(self, file):
        """Name -> (pixels, annotation) of a picture."""
        [image] = [i for i in self.coco.imgs.values() if i["file_name"] == file]
        labels = self.coco.loadAnns(self.coco.getAnnIds(imgIds=image["id"]))
        return {self.coco.cats[a["category_id"]]["name"]: (self.coco.annToMask(a).astype(bool), a) for a in labels}


class DatasetCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="dataset-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "scene.glb").write_bytes(scene())

    @classmethod
    def scenario(cls, name, *devices, seconds=2, more=""):
        file = cls.folder / f"{name}.yaml"
        file.write_text(f"scene: {cls.folder}/scene.glb" + RUN % seconds + "".join(devices) + more)
        return file

    @classmethod
    @functools.cache
    def made(cls, name, *devices, seconds=2):
        file = cls.scenario(name, *devices, seconds=seconds)
        done = run("run", str(file), "--dataset", str(cls.folder / name))
        assert done.returncode == 0, done.stderr
        assert "data set" in done.stdout, done.stdout
        return Data(cls.folder / name)
