#!/usr/bin/env python3
"""Are all sources formatted?   format_test.py CLANG_FORMAT"""

import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
files = [os.path.join(place, name) for room in ("core", "reference", "validation", "benchmarks", "tests")
         for place, _, names in os.walk(os.path.join(ROOT, room)) for name in names if name.endswith((".h", ".cpp"))]
assert len(files) > 500, "where are the sources?"
sys.exit(subprocess.run([sys.argv[1], "--dry-run", "--Werror"] + files).returncode)
