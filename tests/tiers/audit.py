#!/usr/bin/env python3
"""The audit: checks that find less per minute than the quick suite, for a release and for changes that touch their parts.

    audit.py --list                     the parts, the minutes each takes, and what each sees
    audit.py [PART...]                  run these, or all but mutants, in the order of the list
    audit.py drawn [--seed S] [--count N]
                                        that many scenes
    audit.py --since SECONDS --begin-before MINUTES --end-before MINUTES PART...
                                        run these in this order within a budget, counted from SECONDS (of `date +%s`):
                                        a part that has not begun, or has not ended, by then is left out and no failure

Called by ./dartboard test --audit. Exit status 1 if something that ran is red, else 0; 2 for a part that does not exist.
"""

import argparse
import dataclasses
import os
import signal
import subprocess
import sys
import time

import red

WRAPPER = os.path.join(red.ROOT, "dartboard")
RED = os.path.join(red.ROOT, "build", "red")


@dataclasses.dataclass
class Part:
    name: str
    minutes: float  # about, building from nothing and running, alone on two cores
    command: list
    sees: str


def suite(name, minutes, options, sees):
    return Part(name, minutes, [WRAPPER, "test", *options], sees)


PARTS = [
    suite("sanitizers-core", 18, ["--preset", "asan", "--only", "core"],
          "core and the witnesses, by Clang, under its address and undefined-behaviour sanitizers"),
    suite("verbs", 3, ["--only", "verbs"], "every verb once, every mesh format and hostile names through those that take them"),
    suite("browser", 1, ["--only", "browser"], "the page of a run, in a headless Chromium"),
    suite("long", 1, ["--only", "long"], "tests that take more than a few seconds each"),
    suite("lint", 4, ["--preset", "lint", "--only", "lint"], "clang-tidy over the twenty sources changed last"),
    suite("faults", 7, ["--only", "faults"], "seeded faults: each claim and each verb that judges has one that it must see"),
    suite("sanitizers-verbs", 15, ["--preset", "asan", "--only", "verbs"], "every verb under the sanitizers"),
    suite("sanitizers-all", 60, ["--preset", "asan"], "the quick suite, validation and reports included, under the sanitizers"),
    Part("drawn", 20, [WRAPPER, "validate", "drawn", "--count", "8000", "--seed", time.strftime("%Y%m%d"),
                       "--smallest", os.path.join(red.ROOT, "build", "drawn")],
         "scenes drawn over all keys, held to relations that need no truth (other ones every day; --seed and --count)"),
    Part("mutants", 150, [sys.executable, "-B", os.path.join(red.ROOT, "tests", "mutants", "mutants.py"),
                          "--count", "400", "--seed", time.strftime("%Y%m%d"),
                          "--work", os.path.join(red.ROOT, "build", "mutants")],
         "single changes drawn over all sources: the share that the suite kills (goes on where it was interrupted)"),
]
BY_NAME = {part.name: part for part in PARTS}


def say(text):
    print("audit: " + text, file=sys.stderr, flush=True)


def listed():
    print("part              minutes  what it sees")
    for part in PARTS:
        print("%-17s %7g  %s" % (part.name, part.minutes, part.sees))


def with_options(part, options):
    """The part `drawn` with the seed and the count that are given, in place of its own; any other part as it is."""
    if part.name != "drawn":
        return part
    command = list(part.command)
    for name in ("seed", "count"):
        if getattr(options, name):
            command[command.index("--" + name) + 1] = getattr(options, name)
    return dataclasses.replace(part, command=command)


def run(part, seconds, spawn=subprocess.Popen):
    """(exit status, or None if it had to be stopped; seconds taken). Child processes of a part end with it."""
    start = time.monotonic()
    environment = dict(os.environ, DARTBOARD_PART=part.name)
    process = spawn(part.command, env=environment, start_new_session=True)
    try:
        status = process.wait(seconds)
    except subprocess.TimeoutExpired:
        status = None
    except KeyboardInterrupt:
        os.killpg(process.pid, signal.SIGTERM)
        raise
    if status is None:
        os.killpg(process.pid, signal.SIGTERM)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    return status, time.monotonic() - start


def main(words):
    parser = argparse.ArgumentParser(prog="./dartboard test --audit", description="Run the audit, or parts of it.")
    parser.add_argument("parts", nargs="*", metavar="PART")
    parser.add_argument("--list", action="store_true", help="name the parts, and the minutes each takes")
    parser.add_argument("--since", type=float, default=time.time(), metavar="SECONDS", help="when the budget began (date +%%s)")
    parser.add_argument("--begin-before", type=float, metavar="MINUTES", help="begin no part after that")
    parser.add_argument("--end-before", type=float, metavar="MINUTES", help="stop a part that still runs then")
    parser.add_argument("--seed", help="of the scenes of the part 'drawn'")
    parser.add_argument("--count", help="of the scenes of the part 'drawn'")
    options = parser.parse_args(words)
    if options.list:
        return listed()
    unknown = [name for name in options.parts if name not in BY_NAME]
    if unknown:
        say("there is no part '%s'; the parts are %s" % (unknown[0], ", ".join(BY_NAME)))
        return 2
    names = options.parts or [part.name for part in PARTS if part.name != "mutants"]
    ended = []
    for name in names:
        gone = time.time() - options.since
        if options.begin_before is not None and gone >= 60 * options.begin_before:
            ended.append((name, "left out: no time", 0.0))
            continue
        say("%s: %s" % (name, BY_NAME[name].sees))
        left = None if options.end_before is None else max(1.0, 60 * options.end_before - gone)
        status, seconds = run(with_options(BY_NAME[name], options), left)
        outcome = "left out: no time to end" if status is None else "passed" if status == 0 else "RED"
        ended.append((name, outcome, seconds))
        red_file = os.path.join(RED, name)
        if outcome == "RED" and not os.path.exists(red_file):
            os.makedirs(RED, exist_ok=True)
            with open(red_file, "w", encoding="utf-8") as file:
                file.write(red.line_of(name, "", "ended with status %d" % status, "./dartboard test --audit " + name) + "\n")
        say("%s: %s after %.1f min" % (name, outcome, seconds / 60))
    say("what the parts came to:")
    for name, outcome, seconds in ended:
        say("  %-17s %5.1f min  %s" % (name, seconds / 60, outcome))
    return 1 if any(outcome == "RED" for _, outcome, _ in ended) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
