#!/usr/bin/env python3
"""Run a part of the ctest suite, and list the failures last.   Called by ./dartboard.

    suite.py --red FILE --again COMMAND CTEST_OPTIONS...     run ctest
    suite.py --red FILE --again COMMAND --build LOG          the build failed: say where

FILE gets a line for each failure, and exists only if there is one. COMMAND repeats all of it.
"""

import os
import subprocess
import sys
import tempfile

import red


def report(lines, file):
    if lines:
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")
    print("\n".join(lines), flush=True)


def main(words):
    red_file, again = words[words.index("--red") + 1], words[words.index("--again") + 1]
    rest = words[4:]
    if os.path.exists(red_file):
        os.remove(red_file)
    if rest[:1] == ["--build"]:
        with open(rest[1], encoding="utf-8", errors="replace") as log:
            report(red.of_build(log.read(), again), red_file)
        return 1
    with tempfile.TemporaryDirectory(prefix="dartboard-suite-") as folder:
        junit = os.path.join(folder, "junit.xml")
        status = subprocess.run(["ctest", *rest, "--no-tests=error", "--output-junit", junit], cwd=red.ROOT).returncode
        lines, passed = red.of_junit(junit, again) if os.path.exists(junit) else ([], 0)
    if status and not lines:
        lines = [red.line_of("ctest", "", "ended with status %d" % status, again)]
    if lines:
        print("\nWhat is red:")
    report(lines, red_file)
    print("%d passed, %d failed" % (passed, len(lines)), flush=True)
    return 1 if lines or status else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
