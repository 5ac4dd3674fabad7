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
    "emulator/clock/clock.h": '#include <boost/asio.hpp>\n#include "emulator/contract/device.h"\n',
    "emulator/machine/scheduling.h": "#include <sched.h>\n",
    "emulator/scenario/scenario.h": '#include <yaml-cpp/yaml.h>\n#include "render/pose.h"\n',
    "emulator/transport/pty.h": '#include <unistd.h>\n#include "emulator/clock/clock.h"\n',
    "emulator/capture/recorded.h": '#include "emulator/transport/pty.h"\n',
    "emulator/truth/truth.h": '#include <nlohmann/json.hpp>\n#include "emulator/capture/recorded.h"\n',
    "emulator/dataset/dataset.h": '#include <png.h>\n#include "emulator/truth/truth.h"\n',
    "emulator/faults/faults.h": '#include "emulator/capture/recorded.h"\n#include "emulator/scenario/scenario.h"\n',
    "emulator/pose/input.h": '#include "emulator/transport/pty.h"\n#include "emulator/scenario/scenario.h"\n',
    "emulator/replay/player.h": '#include "emulator/capture/recorded.h"\n#include "protocols/seanet/framer.h"\n',
    "emulator/water/crosstalk.h": '#include "emulator/machine/scheduling.h"\n#include "render/echogram.h"\n',
    "emulator/run/session.h": '#include "emulator/faults/faults.h"\n#include "emulator/water/crosstalk.h"\n',
    "emulator/devices/models.cpp": '#include "emulator/devices/ping360/ping360.h"\n',
    "emulator/devices/family/ping/link.h": '#include "emulator/contract/device.h"\n',
    "emulator/devices/ping360/ping360.h": '#include "emulator/devices/family/ping/link.h"\n#include "protocols/seanet/framer.h"\n',
    "emulator/devices/s500/s500.h": '#include "emulator/contract/device.h"\n',
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
    ("emulator/clock/clock.h", '#include "emulator/machine/scheduling.h"'),
    ("emulator/clock/clock.h", '#include "render/echogram.h"'),
    ("emulator/machine/scheduling.h", '#include "emulator/scenario/scenario.h"'),
    ("emulator/machine/scheduling.h", "#include <boost/asio.hpp>"),
    ("emulator/scenario/scenario.h", '#include "emulator/faults/faults.h"'),
    ("emulator/scenario/scenario.h", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/transport/pty.h", '#include "emulator/capture/recorded.h"'),
    ("emulator/transport/pty.h", '#include "emulator/scenario/scenario.h"'),
    ("emulator/transport/pty.h", '#include "protocols/seanet/framer.h"'),
    ("emulator/capture/recorded.h", '#include "emulator/truth/truth.h"'),
    ("emulator/truth/truth.h", '#include "emulator/transport/pty.h"'),
    ("emulator/truth/truth.h", "#include <yaml-cpp/yaml.h>"),
    ("emulator/dataset/dataset.h", '#include "emulator/scenario/scenario.h"'),
    ("emulator/faults/faults.h", '#include "emulator/run/session.h"'),
    ("emulator/pose/input.h", '#include "emulator/run/session.h"'),
    ("emulator/replay/player.h", '#include "emulator/faults/faults.h"'),
    ("emulator/water/crosstalk.h", '#include "emulator/transport/pty.h"'),
    ("emulator/water/crosstalk.h", "#include <GL/glcorearb.h>"),
    ("emulator/run/session.h", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/run/session.h", '#include "tools/echoloop/main.cpp"'),
    ("emulator/run/session.h", '#include "protocols/seanet/framer.h"'),
    ("emulator/run/session.h", "#include <GL/glcorearb.h>"),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/clock/clock.h"'),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/scenario/scenario.h"'),
    ("emulator/devices/ping360/ping360.h", '#include "emulator/devices/s500/s500.h"'),
    ("emulator/devices/ping360/ping360.h", '#include <GL/glcorearb.h>'),
    ("emulator/devices/ping360/ping360.h", "#include <boost/asio.hpp>"),
    ("emulator/devices/family/ping/link.h", '#include "emulator/devices/s500/s500.h"'),
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
        found = faults_of({**GOOD, "emulator/run/a.h": '#include "emulator/run/b.h"\n',
                           "emulator/run/b.h": '#include "emulator/run/a.h"\n'})
        self.assertEqual(found, ["headers include each other: emulator/run/a.h -> emulator/run/b.h -> emulator/run/a.h"])

    def test_overlooks_comments(self):
        text = '// #include "emulator/contract/device.h"\n/*\n#include "emulator/contract/device.h"\n*/\n'
        self.assertEqual(faults_of({**GOOD, "protocols/wire/reader.h": text}), [])

    def test_wants_a_rule_for_every_folder(self):
        self.assertEqual(faults_of({**GOOD, "emulator/attic/box.h": '#include "emulator/attic/lid.h"\n',
                                    "emulator/attic/lid.h": ""}), ["emulator/attic/box.h: no rule for its folder"])

    def test_has_an_illegal_include_for_every_room(self):
        self.assertEqual([room for room in include_graph.ROOMS
                          if not any(name.startswith(f"emulator/{room}/") for name, _ in ILLEGAL)], [])


if __name__ == "__main__":
    unittest.main()
