#!/usr/bin/env python3
"""The module graph holds in this tree, and the checker finds each kind of include that would break it."""
import pathlib
import tempfile
import unittest

import include_graph

ROOT = pathlib.Path(__file__).resolve().parents[2]

GOOD = {
    "protocols/wire/reader.h": "#include <cstdint>\n",
    "protocols/seanet/framer.h": '#include <vector>\n\n#include "protocols/wire/reader.h"\n',
    "render/pose.h": "#include <cmath>\n",
    "render/echogram.h": '#include <vector>\n#include "render/pose.h"\n',
    "render/water.h": '#include "render/pose.h"\n',
    "render/workers.cpp": '#include <sched.h>\n',
    "render/scene/scene.h": '#include <tiny_gltf.h>\n#include <glm/glm.hpp>\n#include "render/pose.h"\n',
    "render/gl/drawer.h": '#include <GL/glcorearb.h>\n#include "render/scene/scene.h"\n',
    "render/acoustics/chain.h": '#include "render/echogram.h"\n#include "render/scene/scene.h"\n',
    "render/paths/paths.h": '#include <embree3/rtcore.h>\n#include "render/acoustics/chain.h"\n',
    "render/fan/plan.h": '#include "render/paths/paths.h"\n#include "render/acoustics/chain.h"\n',
    "render/grid/plan.h": '#include "render/fan/plan.h"\n',
    "render/renderer.h": '#include "render/echogram.h"\n',
    "render/renderer.cpp": '#include "render/renderer.h"\n#include "render/gl/drawer.h"\n#include "render/grid/plan.h"\n',
    "emulator/contract/device.h": '#include "render/echogram.h"\n',
    "emulator/clock/clock.h": '#include "emulator/contract/device.h"\n',
    "emulator/clock/asio.h": "#include <boost/asio.hpp>\n",
    "emulator/devices/models.cpp": '#include "emulator/devices/ping360/ping360.h"\n',
    "emulator/devices/ping360/ping360.h": '#include "emulator/contract/device.h"\n#include "protocols/seanet/framer.h"\n',
    "emulator/devices/s500/s500.h": '#include "emulator/contract/device.h"\n',
    "emulator/transport/pty.cpp": '#include <unistd.h>\n#include "emulator/clock/asio.h"\n',
    "emulator/scenario/scenario.h": '#include "render/pose.h"\n',
    "emulator/run/session.cpp": '#include "emulator/clock/asio.h"\n#include "render/echogram.h"\n',
    "tools/echoloop/main.cpp": '#include <CLI/CLI.hpp>\n#include "emulator/clock/clock.h"\n#include "render/pose.h"\n',
    "tests/e2e/test.cpp": '#include "tools/echoloop/main.cpp"\n#include "tests/e2e/host.h"\n',
    "tests/e2e/host.h": "// nothing\n",
}

ILLEGAL = [
    ("protocols/seanet/framer.h", "#include <boost/asio.hpp>"),
    ("protocols/seanet/framer.h", '#include "render/echogram.h"'),
    ("protocols/seanet/framer.h", '#include "emulator/contract/device.h"'),
    ("protocols/seanet/framer.h", "#include <unistd.h>"),
    ("render/renderer.cpp", '#include "protocols/wire/reader.h"'),
    ("render/renderer.cpp", "#include <protocols/wire/reader.h>"),
    ("render/renderer.cpp", '#include "emulator/contract/device.h"'),
    ("render/renderer.cpp", "#include <boost/asio.hpp>"),
    ("render/renderer.cpp", "#include <GL/glcorearb.h>"),
    ("render/echogram.h", "#include <GL/glcorearb.h>"),
    ("render/water.h", '#include "render/scene/scene.h"'),
    ("render/water.h", "#include <glm/glm.hpp>"),
    ("render/scene/scene.h", '#include "render/acoustics/chain.h"'),
    ("render/scene/scene.h", "#include <GL/glcorearb.h>"),
    ("render/gl/drawer.h", '#include "render/fan/plan.h"'),
    ("render/gl/drawer.h", '#include "render/acoustics/chain.h"'),
    ("render/acoustics/chain.h", '#include "render/paths/paths.h"'),
    ("render/acoustics/chain.h", '#include "render/gl/drawer.h"'),
    ("render/paths/paths.h", '#include "render/fan/plan.h"'),
    ("render/paths/paths.h", '#include "render/gl/drawer.h"'),
    ("render/fan/plan.h", '#include "render/grid/plan.h"'),
    ("render/fan/plan.h", '#include "render/gl/drawer.h"'),
    ("render/grid/plan.h", '#include "render/renderer.h"'),
    ("render/grid/plan.h", '#include "render/gl/drawer.h"'),
    ("render/fan/plan.h", "#include <embree3/rtcore.h>"),
    ("emulator/contract/device.h", '#include "emulator/clock/clock.h"'),
    ("emulator/contract/device.h", "#  include <boost/asio.hpp>"),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/clock/clock.h"'),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/clock/asio.h"'),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/scenario/scenario.h"'),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/devices/ping360/ping360.h", '#include <GL/glcorearb.h>'),
    ("emulator/transport/pty.cpp", '#include "protocols/seanet/framer.h"'),
    ("emulator/transport/pty.cpp", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/scenario/scenario.h", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/run/session.cpp", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/run/session.cpp", '#include "tools/echoloop/main.cpp"'),
    ("emulator/run/session.cpp", "#include <GL/glcorearb.h>"),
    ("tools/echoloop/main.cpp", '#include "tests/e2e/host.h"'),
    ("tools/echoloop/main.cpp", '#include "main.h"'),
    ("emulator/clock/clock.h", '#include "emulator/no_such_file.h"'),
]


def faults_of(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return include_graph.faults(folder)


class ThisTree(unittest.TestCase):
    def test_keeps_to_the_module_graph(self):
        self.assertEqual(include_graph.faults(ROOT), [])

    def test_was_read(self):
        files = include_graph.sources(ROOT)
        for name in ("render/echogram.h", "emulator/contract/device.h", "tools/draw/draw.h"):
            self.assertIn(name, files)
        self.assertIn(("render/echogram.h", True), list(include_graph.includes(ROOT, "emulator/contract/device.h")))


class Checker(unittest.TestCase):
    def test_accepts_a_tree_that_keeps_to_the_graph(self):
        self.assertEqual(faults_of(GOOD), [])

    def test_finds_every_illegal_include(self):
        for name, line in ILLEGAL:
            with self.subTest(file=name, line=line):
                found = faults_of({**GOOD, name: GOOD[name] + line + "\n"})
                self.assertTrue(any(name in fault for fault in found), found)

    def test_finds_a_cycle_of_headers(self):
        found = faults_of({**GOOD, "emulator/a.h": '#include "emulator/b.h"\n',
                           "emulator/b.h": '#include "emulator/a.h"\n'})
        self.assertEqual(found, ["headers include each other: emulator/a.h -> emulator/b.h -> emulator/a.h"])

    def test_overlooks_comments(self):
        text = '// #include "emulator/contract/device.h"\n/*\n#include "emulator/contract/device.h"\n*/\n'
        self.assertEqual(faults_of({**GOOD, "protocols/wire/reader.h": text}), [])

    def test_wants_a_rule_for_every_file(self):
        self.assertEqual([m for m in include_graph.MODULES
                          if not any(rule.files.startswith(f"{m}/") for rule in include_graph.RULES)], [])


if __name__ == "__main__":
    unittest.main()
