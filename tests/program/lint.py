#!/usr/bin/env python3
"""Has the linter no complaint about the sources changed last?   lint.py CLANG_TIDY BUILD_FOLDER [--all]

Reading one source takes it some ten seconds, all of them an hour. So it reads the twenty changed last, according to git, a
header by the source of its name: a test of the preset lint. With --all every one: its target lint_all. It reads
them without precompiled headers, so it also finds a source that does not include what it uses.
"""

import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ("core", "reference", "validation", "benchmarks")
MOST = 20


def changed_last():
    """Sources and headers of the rooms, those changed last first."""
    names = subprocess.run(["git", "-C", ROOT, "log", "-n", "100", "--format=", "--name-only", "--", *ROOMS],
                           stdout=subprocess.PIPE, text=True, check=True).stdout.split("\n")
    return [os.path.splitext(name)[0] + ".cpp" for name in names if name.endswith((".h", ".cpp"))]


def without_precompiled(command):
    """A core_tests build has none of the other rooms' to read."""
    return re.sub(r" -Winvalid-pch| -Xclang -include(-pch)? -Xclang \S*cmake_pch\S*", "", command)


def findings(tool, commands, source):
    # a function that no header declares belongs in the unnamed namespace: another source may define its name
    own = "--extra-arg=-Werror=missing-prototypes"
    run = subprocess.run([tool, "-p", commands, "--quiet", own, os.path.join(ROOT, source)],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(f"{source}: {'nothing' if run.returncode == 0 else 'see below'}", flush=True)
    return "" if run.returncode == 0 else run.stdout


def main(tool, build, *options):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    for entry in entries:
        entry["command"] = without_precompiled(entry["command"])
    compiled = [os.path.relpath(entry["file"], ROOT) for entry in entries]
    compiled = [source for source in compiled if source.startswith(tuple(room + "/" for room in ROOMS))]
    assert compiled, "where are the sources?"
    if "--all" in options:
        sources = compiled
    else:
        sources = [source for source in dict.fromkeys(changed_last()) if source in compiled][:MOST]
    with tempfile.TemporaryDirectory(prefix="dartboard-lint-") as commands:
        with open(os.path.join(commands, "compile_commands.json"), "w", encoding="utf-8") as file:
            json.dump(entries, file)
        with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            found = [text for text in pool.map(lambda source: findings(tool, commands, source), sources) if text]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
