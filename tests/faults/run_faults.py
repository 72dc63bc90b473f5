#!/usr/bin/env python3
"""Run a test suite once as it is, then once with each seeded fault on, and demand that every fault is killed.

    run_faults.py SUITE FAULT_LIST            all of them
    run_faults.py SUITE FAULT_LIST WORD...    only the faults whose name contains a word

A fault is killed by the first failure, by a crash, by running out of memory or by not ending: all are seen by whoever
runs the suite. The suite stops at its first failed expectation, and the test it was in is the killer.

Standard library only, and of it only what Debian's python3-minimal has.
"""

import os
import re
import signal
import subprocess
import sys
import threading
import time

from make_faulty_tree import Mistake, read_faults

MEMORY_KIB = 4 << 20  # of address space: a fault may ask for all there is


class Result:
    def __init__(self, killer, how, seconds):
        self.killer, self.how, self.seconds = killer, how, seconds


def run(suite, number, limit):
    """One run of the suite with fault `number` on (0: none). `killer` is None when every test passed."""
    environment = dict(os.environ, DARTBOARD_FAULT=str(number), GTEST_FAIL_FAST="1", GTEST_BREAK_ON_FAILURE="1",
                       GTEST_COLOR="no", RC_PARAMS="seed=1")  # random properties draw the same every time
    limits = "ulimit -c 0; ulimit -v %d; exec \"$0\"" % MEMORY_KIB
    start = time.monotonic()
    process = subprocess.Popen(["/bin/sh", "-c", limits, suite], env=environment, stdout=subprocess.PIPE,
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
    results, waiting, lock = {}, list(reversed(faults)), threading.Lock()

    def work():
        while True:
            with lock:
                if not waiting:
                    return
                fault = waiting.pop()
            result = run(suite, fault.number, limit)
            with lock:
                results[fault.number] = result

    workers = [threading.Thread(target=work) for _ in range(len(os.sched_getaffinity(0)))]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return [results.get(fault.number) or Result(None, "could not be run", 0) for fault in faults]


def main(suite, fault_list, *words):
    faults = [f for f in read_faults(fault_list) if not words or any(word in f.name for word in words)]
    start = time.monotonic()
    sound = run(suite, 0, 300)
    if sound.killer is not None:
        sys.exit("without any fault %s %s: faults tell nothing until it passes" % (sound.killer, sound.how))
    limit = 10 + 10 * sound.seconds  # several run at once, and the machine may be busy
    results = run_all(suite, faults, limit)
    survivors = []
    for fault, result in zip(faults, results):
        if result.killer is None:
            survivors.append(fault)
        else:
            print("%3d  %s\n     %s %s (%.1f s)" %
                  (fault.number, fault.name, result.killer, result.how, result.seconds))
    for fault in survivors:
        print("SURVIVED: %d, %s\n     %s: every test passes with\n     %s\n     in place of\n     %s" %
              (fault.number, fault.name, fault.file, fault.wrong or "(nothing)", fault.right))
    print("%d of %d seeded faults killed in %.0f s (%.1f s without a fault)" %
          (len(faults) - len(survivors), len(faults), time.monotonic() - start, sound.seconds))
    return 1 if survivors or not faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Mistake as mistake:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), mistake))
