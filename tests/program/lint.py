#!/usr/bin/env python3
"""Does the linter say nothing of what was changed last?   lint.py CLANG_TIDY BUILD_FOLDER [--all]

Reading one source takes it some ten seconds, all of them an hour. So it reads the twenty changed last, as git tells, a
header by the source of its name; with --all every one. Targets lint and lint_all of the sanitizers' build.
"""

import concurrent.futures
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ("core", "reference", "validation", "benchmarks")
MOST = 20


def changed_last():
    """Sources and headers of the rooms, those changed last first."""
    names = subprocess.run(["git", "-C", ROOT, "log", "-n", "100", "--format=", "--name-only", "--", *ROOMS],
                           stdout=subprocess.PIPE, text=True, check=True).stdout.split("\n")
    return [os.path.splitext(name)[0] + ".cpp" for name in names if name.endswith((".h", ".cpp"))]


def findings(tool, build, source):
    run = subprocess.run([tool, "-p", build, "--quiet", os.path.join(ROOT, source)],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(f"{source}: {'nothing' if run.returncode == 0 else 'see below'}", flush=True)
    return "" if run.returncode == 0 else run.stdout


def main(tool, build, *options):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        compiled = [os.path.relpath(entry["file"], ROOT) for entry in json.load(file)]
    compiled = [source for source in compiled if source.startswith(tuple(room + "/" for room in ROOMS))]
    assert compiled, "where are the sources?"
    if "--all" in options:
        sources = compiled
    else:
        sources = [source for source in dict.fromkeys(changed_last()) if source in compiled][:MOST]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [text for text in pool.map(lambda source: findings(tool, build, source), sources) if text]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
