"""Finds the public driver packages that tests/drivers/install has put under build/drivers. Imports nothing of them."""

import os
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))


def use(folder, module):
    """Makes `module` of build/drivers/<folder> importable; skips the tests where it is missing, and fails in CI."""
    for path in (ROOT / "build" / "drivers" / folder).glob("lib/python3*/site-packages"):
        if (path / module).exists():
            sys.path.insert(0, str(path))
            return
    refuse(module)


def node(module):
    """The folder that holds `module` of npm and others; skips and fails as use() does."""
    folder = ROOT / "build" / "drivers" / "node"
    if not (folder / "node_modules" / module).exists():
        refuse(module)
    return folder


def refuse(module):
    reason = f"{module} is not installed: run tests/drivers/install, which needs a network"
    if os.environ.get("CI"):
        raise RuntimeError(reason)
    raise unittest.SkipTest(reason)
