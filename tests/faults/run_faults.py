#!/usr/bin/env python3
"""Run tests once as they are, then with each seeded fault on, and demand that every fault is noticed.

    run_faults.py SUITE FAULT_LIST            all of them
    run_faults.py SUITE FAULT_LIST WORD...    only the faults whose name contains a word

A fault with a `killer` is run with that test and no other. It is killed by a failure, by a crash, by running out of
memory or by not ending: each is visible to a user of the suite. A fault that accesses foreign memory may pass by
luck: if the test passes, the fault is run twice more, and the report says so if that made a difference. A fault with a `run` is given to the whole program,
`dartboard_seeded` next to the suite: the arguments must end with 0 while no fault is on, and with the fault on print what
the block `says` and end with its `status`, nothing else. A fault that `hides` another is run with that one: it is noticed
when the other one's run does not end so.

make_faulty_tree.py describes the keys of a block.

Standard library only.
"""

import collections
import concurrent.futures
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time

from make_faulty_tree import Mistake, read_faults

MEMORY_KIB = 4 << 20  # of address space: a fault may request without limit
TRIES = 3


class Result:
    """The result of one run. `killer` is the one that noticed something, or None: then `how` may say why that is not enough."""

    def __init__(self, killer, how, seconds):
        self.killer, self.how, self.seconds = killer, how, seconds


class Ended:
    """A process that has ended: `status` is None if it had to be ended."""

    def __init__(self, status, output, seconds):
        self.status, self.output, self.seconds = status, output, seconds


def execute(command, number, limit, folder=None):
    """One process with fault `number` on (0: none; or "one,other"), in `folder`, for at most `limit` seconds."""
    environment = dict(os.environ, DARTBOARD_FAULT=str(number), GTEST_FAIL_FAST="1", GTEST_BREAK_ON_FAILURE="1",
                       GTEST_COLOR="no", RC_PARAMS="seed=1")  # random properties draw the same every time
    limits = "ulimit -c 0; ulimit -v %d; exec \"$0\" \"$@\"" % MEMORY_KIB
    start = time.monotonic()
    # a session of its own: its child processes end with it
    process = subprocess.Popen(["/bin/sh", "-c", limits, *command], env=environment, cwd=folder, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=limit)
        status = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        status = None
    return Ended(status, output.decode(errors="replace"), time.monotonic() - start)


def how_it_ended(ended):
    if ended.status is None:
        return "does not end within %.0f s" % ended.seconds
    if ended.status < 0:
        return "crashes (%s)" % signal.Signals(-ended.status).name
    return "ends with exit status %d" % ended.status


def run_tests(suite, number, limit, tests="*"):
    """Some tests of the suite with fault `number` on. `killer` is None when every test passed."""
    ended = execute([os.path.abspath(suite), "--gtest_filter=" + tests], number, limit)
    if re.search(r"^\[==========\] Running 0 tests", ended.output, re.M):
        return Result(None, "there is no test " + tests, ended.seconds)
    if ended.status == 0 and re.search(r"^\[  PASSED  \]", ended.output, re.M):
        return Result(None, "", ended.seconds)
    how = "fails" if ended.status is not None and ": Failure" in ended.output else how_it_ended(ended)
    begun = re.findall(r"^\[ RUN      \] (\S+)", ended.output, re.M)
    return Result(begun[-1] if begun else "(no test begun)", how, ended.seconds)


class Program:
    """The whole program, seeded."""

    def __init__(self, path, scenes):
        self.path, self.scenes = os.path.abspath(path), os.path.abspath(scenes)

    def run(self, arguments, number, limit):
        with tempfile.TemporaryDirectory(prefix="dartboard-fault-") as folder:
            places = {"{scenes}": self.scenes, "{out}": os.path.join(folder, "out")}
            words = [re.sub(r"\{\w+\}", lambda m: places[m[0]], word) for word in shlex.split(arguments)]
            return execute([self.path, *words], number, limit, folder)

    def result(self, fault, sound, others=""):
        """Does the run of a fault notice it, with others on too?"""
        ended = self.run(fault.run, "%d%s" % (fault.number, others), limit_for(sound.seconds))
        if ended.status != fault.status:
            return Result(None, "'%s' %s" % (fault.run, how_it_ended(ended)), ended.seconds)
        if fault.says not in ended.output:
            return Result(None, "'%s' does not say '%s'" % (fault.run, fault.says), ended.seconds)
        return Result(fault.run, "says '%s'" % fault.says, ended.seconds)

    def result_of_hiding(self, fault, hidden, sound):
        """Is it noticed that with `fault` on the run of another one no longer says no?"""
        result = self.result(hidden, sound, ",%d" % fault.number)
        if result.killer is not None:
            return Result(None, "it does not hide '%s': %s" % (hidden.name, result.how), result.seconds)
        return Result("fault '%s'" % hidden.name, "survives: %s" % result.how, result.seconds)


def limit_for(seconds):
    """For a run that took so long: several run at once, and the machine may be busy."""
    return 60 + 4 * seconds


def in_parallel(function, items):
    """As many at a time as there are processors; the results in the order of the items."""
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as workers:
        return list(workers.map(function, items))


def sound_runs(program, faults):
    """Every run of the list without a fault, by its arguments. They must end with 0 and print nothing that the blocks seek."""
    arguments = sorted({f.run for f in faults if f.run})
    runs = dict(zip(arguments, in_parallel(lambda a: program.run(a, 0, 600), arguments)))
    for a in arguments:
        if runs[a].status != 0:
            sys.exit("without any fault '%s' %s:\n%s" % (a, how_it_ended(runs[a]), runs[a].output))
    for f in faults:
        if f.run and f.says in runs[f.run].output:
            sys.exit("fault '%s': '%s' says '%s' without any fault" % (f.name, f.run, f.says))
    return runs


def table_of_rooms(faults):
    """How many faults lie in each room, in one line."""
    rooms = collections.Counter(os.path.dirname(fault.file) for fault in faults)
    return ", ".join("%s %d" % room for room in sorted(rooms.items()))


def main(suite, fault_list, *words):
    every = read_faults(fault_list)
    faults = [f for f in every if not words or any(word in f.name for word in words)]
    start = time.monotonic()
    tested = sorted({f.killer for f in faults if f.killer})
    sound = run_tests(suite, 0, 300, ":".join(tested)) if tested else Result(None, "", 0.0)
    if sound.killer is not None or sound.how:
        sys.exit("without any fault %s %s: faults tell nothing until it passes" % (sound.killer, sound.how))
    program = Program(os.path.join(os.path.dirname(suite), "dartboard_seeded"),
                      os.path.join(os.path.dirname(os.path.abspath(fault_list)), "scenes"))
    by_name = {f.name: f for f in every}
    runs = sound_runs(program, faults + [by_name[f.hides] for f in faults if f.hides])

    def outcome_of(fault):
        if fault.run:
            return program.result(fault, runs[fault.run])
        if fault.hides:
            hidden = by_name[fault.hides]
            return program.result_of_hiding(fault, hidden, runs[hidden.run])
        result = run_tests(suite, fault.number, limit_for(sound.seconds), fault.killer)
        for run in range(2, TRIES + 1):
            if result.killer is not None or result.how:
                break
            result = run_tests(suite, fault.number, limit_for(sound.seconds), fault.killer)
            result.how += " in run %d only" % run if result.killer is not None else ""
        return result

    results = in_parallel(outcome_of, faults)
    survivors = []
    for fault, result in zip(faults, results):
        if result.killer is None:
            survivors.append((fault, result.how))
        else:
            print("%10d  %s\n     %s %s (%.1f s)" %
                  (fault.number, fault.name, result.killer, result.how, result.seconds))
    alone = sound.seconds + sum(ended.seconds for ended in runs.values())
    print("%d of %d seeded faults killed in %.0f s (%.1f s without a fault): %s" %
          (len(faults) - len(survivors), len(faults), time.monotonic() - start, alone, table_of_rooms(faults)))
    # last, where a reader of the log's end finds them
    for fault, how in survivors:
        print("SURVIVED: %d, %s\n     %s: %s with\n     %s\n     in place of\n     %s" %
              (fault.number, fault.name, fault.file, how or "%s passes" % fault.killer,
               fault.wrong or "(nothing)", fault.right))
    return 1 if survivors or not faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Mistake as mistake:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), mistake))
