#!/usr/bin/env python3
"""Makes the 3D scenes of config/scenes (.glb) and the bench scenes. Standard library only.

    tools/make_scenes.py                 writes config/scenes/{manifold,tank,flat,basin,harbour,deep,pipe}.glb
    tools/make_scenes.py --check         writes nothing; exit status 1 if a committed file differs
    tools/make_scenes.py --bench DIR     writes DIR/{simple,big100k,big2m,one1m,one2m}.glb
"""
import argparse
import os
import pathlib
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from scenes import auv, basin, bench, deep, flat, harbour, manifold, pipe, seabed, tank  # noqa: E402
from scenes.glb import Node, glb  # noqa: E402
from scenes.materials import SONAR  # noqa: E402

SCENES = pathlib.Path(__file__).resolve().parent.parent / "config" / "scenes"


def manifold_scene():
    """Seabed about z = -10 m, the manifold at the origin, an AUV in mid water to the south of it."""
    ground = min(seabed.height(x, y) for x in (-3, 0, 3) for y in (-2, 0, 2))
    vehicle = Node("auv", [("aluminium", auv.auv())], position=(0.5, -6.5, -7.9), yaw=1.1, pitch=0.08)
    return seabed.nodes() + manifold.nodes((0.0, 0.0, ground), yaw=0.5) + [vehicle]


COMMITTED = {"manifold": manifold_scene, "tank": tank.nodes, "flat": flat.nodes, "basin": basin.nodes,
             "harbour": harbour.nodes, "deep": deep.nodes, "pipe": pipe.nodes}


def write(folder, name, nodes):
    data = glb(nodes, SONAR)
    path = folder / f"{name}.glb"
    path.write_bytes(data)
    print(f"{path}: {triangles(nodes):,} triangles, {len(data):,} bytes")


def triangles(nodes):
    return sum(sum(len(mesh.triangles) for _, mesh in node.parts) + triangles(node.children) for node in nodes)


def differing():
    """Names of the committed scenes that this script would write differently."""
    return [name for name, make in COMMITTED.items()
            if not (SCENES / f"{name}.glb").is_file() or (SCENES / f"{name}.glb").read_bytes() != glb(make(), SONAR)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=SCENES, help="folder for the scenes")
    parser.add_argument("--check", action="store_true", help="compare with the committed files, write nothing")
    parser.add_argument("--bench", type=pathlib.Path, metavar="DIR", help="write the bench scenes there instead")
    options = parser.parse_args()
    if options.check:
        names = differing()
        for name in names:
            print(f"{SCENES / name}.glb differs: run tools/make_scenes.py and commit the file", file=sys.stderr)
        return 1 if names else 0
    folder = options.bench or options.out
    folder.mkdir(parents=True, exist_ok=True)
    makers = {name: (lambda n=name: bench.nodes(n)) for name in bench.CELLS} if options.bench else COMMITTED
    for name, make in makers.items():
        write(folder, name, make())
    return 0


if __name__ == "__main__":
    sys.exit(main())
