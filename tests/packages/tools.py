"""What the tests of packages share. Standard library only."""
import os
import pathlib
import shutil
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("ECHOLOOP_BUILD", str(ROOT / "build" / "release")))


def need(tool):
    """The test is skipped where the tool is missing; in CI it fails."""
    if shutil.which(tool):
        return
    if os.environ.get("CI") == "true":
        raise AssertionError(f"{tool} is missing; tools/install test installs it")
    raise unittest.SkipTest(f"{tool} is not installed")
