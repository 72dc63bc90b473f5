#!/usr/bin/env python3
"""Run tests once as they are, then with each seeded fault on, and demand that every fault is killed by its test.

    run_faults.py SUITE FAULT_LIST            all of them
    run_faults.py SUITE FAULT_LIST WORD...    only the faults whose name contains a word
    run_faults.py SUITE FAULT_LIST --name     run the whole suite with faults that name no killer, and name what kills

Each fault is run with the test that its `killer` line names, and no other. It is killed by a failure, by a crash, by
running out of memory or by not ending: all are seen by whoever runs the suite.

Standard library only, and of it only what Debian's python3-minimal has.
"""

import collections
import concurrent.futures
import os
import re
import signal
import subprocess
import sys
import time

from make_faulty_tree import Mistake, read_faults

MEMORY_KIB = 4 << 20  # of address space: a fault may ask for all there is


class Result:
    def __init__(self, killer, how, seconds):
        self.killer, self.how, self.seconds = killer, how, seconds


def run(suite, number, limit, tests="*"):
    """One run of some tests with fault `number` on (0: none). `killer` is None when every test passed."""
    environment = dict(os.environ, DARTBOARD_FAULT=str(number), GTEST_FAIL_FAST="1", GTEST_BREAK_ON_FAILURE="1",
                       GTEST_COLOR="no", RC_PARAMS="seed=1")  # random properties draw the same every time
    limits = "ulimit -c 0; ulimit -v %d; exec \"$0\" \"$@\"" % MEMORY_KIB
    start = time.monotonic()
    process = subprocess.Popen(["/bin/sh", "-c", limits, suite, "--gtest_filter=" + tests], env=environment, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT)
    try:
        output, _ = process.communicate(timeout=limit)
        how = None
    except subprocess.TimeoutExpired:
        process.kill()
        output, _ = process.communicate()
        how = "does not end within %.0f s" % limit
    seconds = time.monotonic() - start
    output = output.decode(errors="replace")
    if how is None:
        if re.search(r"^\[==========\] Running 0 tests", output, re.M):
            return Result(None, "there is no test " + tests, seconds)
        if process.returncode == 0 and re.search(r"^\[  PASSED  \]", output, re.M):
            return Result(None, "", seconds)
        if ": Failure" in output:
            how = "fails"
        elif process.returncode < 0:
            how = "crashes (%s)" % signal.Signals(-process.returncode).name
        else:
            how = "ends with exit status %d" % process.returncode
    tests = re.findall(r"^\[ RUN      \] (\S+)", output, re.M)
    return Result(tests[-1] if tests else "(no test begun)", how, seconds)


def run_all(suite, faults, limit):
    """The result of each fault, in their order; as many at a time as there are processors."""
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as workers:
        return list(workers.map(lambda fault: run(suite, fault.number, limit, fault.killer or "*"), faults))


def name_killers(path, killers):
    """Adds a `killer` line to the blocks of these faults: {name: test}."""
    with open(path, encoding="utf-8") as file:
        blocks = file.read().split("\n\n")
    for k, block in enumerate(blocks):
        match = re.search(r"^fault: *(.*)$", block, re.M)
        if match and match[1].rstrip() in killers:
            blocks[k] = block.rstrip("\n") + "\nkiller: " + killers[match[1].rstrip()] + block[len(block.rstrip("\n")):]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(blocks))


def table_of_rooms(faults):
    """How many faults lie in each room, in one line."""
    rooms = collections.Counter(os.path.dirname(fault.file) for fault in faults)
    return ", ".join("%s %d" % room for room in sorted(rooms.items()))


def main(suite, fault_list, *words):
    naming = "--name" in words
    words = [word for word in words if word != "--name"]
    faults = [f for f in read_faults(fault_list) if not words or any(word in f.name for word in words)]
    if naming:
        faults = [f for f in faults if not f.killer]
    nameless = [f for f in faults if not f.killer]
    if nameless and not naming:
        sys.exit("%s: fault '%s' names no killer; run with --name to find one" % (fault_list, nameless[0].name))
    start = time.monotonic()
    sound = run(suite, 0, 300, "*" if naming else ":".join(sorted({f.killer for f in faults})))
    if sound.killer is not None or sound.how:
        sys.exit("without any fault %s %s: faults tell nothing until it passes" % (sound.killer, sound.how))
    limit = 10 + 10 * sound.seconds  # several run at once, and the machine may be busy
    results = run_all(suite, faults, limit)
    survivors = []
    for fault, result in zip(faults, results):
        if result.killer is None:
            survivors.append((fault, result.how))
        else:
            print("%3d  %s\n     %s %s (%.1f s)" %
                  (fault.number, fault.name, result.killer, result.how, result.seconds))
    for fault, how in survivors:
        print("SURVIVED: %d, %s\n     %s: %s with\n     %s\n     in place of\n     %s" %
              (fault.number, fault.name, fault.file, how or "%s passes" % (fault.killer or "every test"),
               fault.wrong or "(nothing)", fault.right))
    if naming:
        name_killers(fault_list, {f.name: r.killer for f, r in zip(faults, results) if r.killer})
    print("%d of %d seeded faults killed in %.0f s (%.1f s without a fault): %s" %
          (len(faults) - len(survivors), len(faults), time.monotonic() - start, sound.seconds, table_of_rooms(faults)))
    return 1 if survivors or not faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Mistake as mistake:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), mistake))
