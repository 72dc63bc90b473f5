#!/usr/bin/env python3
"""The cost of the headers of the hot rooms for their users, in seconds of processor, compared with their budgets.

    header_costs.py BUILD [--all]       BUILD is a configured folder, build/release

Each header of budgets.txt is compiled alone, as a source of core is (its flags, its precompiled header), without code
being generated; the time of an empty source is subtracted. The least of three runs counts. Budgets are seconds on the
machine on which the yardstick, Eigen/Dense without a precompiled header, took the seconds in the first line of
budgets.txt, and are scaled by the seconds that it takes here.

--all lists every header of core by its cost, without budgets: to see which ones deserve one.

Exit status: 0 all within their budgets, 1 some are not, 2 the command line."""

import json
import os
import re
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
YARDSTICK = "Eigen/Dense"


def command_of_core(build):
    """The command that compiles a source of core, without file names."""
    commands = os.path.join(build, "compile_commands.json")
    if not os.path.exists(commands):
        print("header_costs: %s is not there; expected the folder of a configured build" % commands, file=sys.stderr)
        sys.exit(2)
    with open(commands, encoding="utf-8") as file:
        entries = json.load(file)
    entry = next(e for e in entries if e["file"].endswith("/core/mechanics/adapt.cpp"))
    words = entry["command"].split()
    compiler = next(k for k, word in enumerate(words) if re.search(r"(\+\+|g\+\+|clang\+\+)[-\d.]*$", word))
    kept, skip = [], False
    for word in words[compiler:]:
        if skip or word in ("-c", "-MD", "-o", "-MT", "-MF") or word == entry["file"]:
            skip = word in ("-o", "-MT", "-MF")
            continue
        kept.append(word)
    return kept + ["-fsyntax-only", "-x", "c++"], entry["directory"]


def seconds(command, folder, text):
    best = None
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
        source.write(text)
        source.flush()
        for _ in range(3):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            run = subprocess.run(command + [source.name], cwd=folder, capture_output=True, text=True)
            if run.returncode:
                sys.exit("header_costs: %s does not compile alone:\n%s" % (text.strip(), run.stderr))
            spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            best = spent if best is None else min(best, spent)
    return best


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-") or sys.argv[2:] not in ([], ["--all"]):
        print(__doc__, file=sys.stderr)
        return 2
    command, folder = command_of_core(sys.argv[1])
    empty = seconds(command, folder, "\n")
    cost = lambda header: max(0.0, seconds(command, folder, '#include "%s"\n' % header) - empty)
    if sys.argv[2:]:
        headers = [os.path.relpath(os.path.join(at, name), ROOT)
                   for at, _, names in os.walk(os.path.join(ROOT, "core")) for name in names if name.endswith(".h")]
        for spent, header in sorted(((cost(h), h) for h in headers), reverse=True):
            print("%5.2f  %s" % (spent, header))
        return 0
    with open(os.path.join(HERE, "budgets.txt"), encoding="utf-8") as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    bare = [w for k, w in enumerate(command) if w not in ("-Winvalid-pch", "-include") and command[k - 1] != "-include"]
    here = seconds(bare, folder, "#include <%s>\n" % YARDSTICK)
    scale = here / float(rows[0][1])
    print("%s takes %.2f s here, budgets are times %.2f\n" % (YARDSTICK, here, scale))
    over = 0
    print("seconds  budget  header")
    for header, budget in rows[1:]:
        spent, allowed = cost(header), float(budget) * scale
        over += spent > allowed
        print("%7.2f  %6.2f  %s%s" % (spent, allowed, header, "  over its budget" if spent > allowed else ""))
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
