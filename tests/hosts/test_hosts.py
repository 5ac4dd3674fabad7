#!/usr/bin/env python3
"""Runs the self-tests of all hosts: python3 tests/hosts/test_hosts.py [unittest options]."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

MODULES = [
    "test_byte_line",
    "test_words",
    "test_blping_host",
    "test_aris_wire",
    "test_cerulean_wire",
    "test_surveyor_wire",
    "test_deltat_wire",
    "test_seanet_host",
    "test_seanet_profiler",
    "test_r2sonic_host",
    "test_r2sonic_control",
    "test_r2sonic_water",
    "test_imagenex_wire",
    "test_oculus_wire",
    "test_sonar3d_wire",
]


def load_tests(loader, _standard, _pattern):
    """unittest's protocol: the tests of the other modules of this folder."""
    return loader.loadTestsFromNames(MODULES)


if __name__ == "__main__":
    unittest.main(verbosity=1)
