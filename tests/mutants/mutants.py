#!/usr/bin/env python3
"""What share of wrong programs does the suite kill? Wrong programs of one change each, drawn from a seed.

    mutants.py --seed 2 --count 400 --work DIR      draw, build, run, report; continues where it was interrupted
    mutants.py --work DIR --report                  the report of what has been judged so far
    mutants.py --work DIR --budget 3600             run survivors with the tests that were too slow before
    mutants.py --work DIR --since REVISION          some 40 changes in the lines that differ from it, anew each time

The changes are drawn over all sources of core, reference, validation and benchmarks, each place alike (sites.py,
draw.py). A copy of the repository is built once with all of them in it behind one switch (schemata.py, build.py). Every
test is run once as it is, which shows the mutants that it reaches; each mutant is then run with those tests, likeliest
and quickest first, until one fails (judge.py). Nothing outside DIR is written.

With --since, for everyday use (./dartboard test --mutants REVISION), the copy is built as the release
preset is, so that all but the touched objects come from the compiler's cache, and the tests of the quick suite are run.

DIR ends with report.md (shares by room, with intervals), survivors/ROOM.md, sample.jsonl, results.jsonl. Mutants that
are no wrong programs are set aside one by one in equivalent.txt, with the reason.

Needs what the build needs, and Debian's python3-clang-14 for drawing. An hour or two on two processors.
"""

import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time

import build as building
import changed
import draw
import judge
import report

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
ROOMS = ["core", "reference", "validation", "benchmarks"]
# not run: tests that build copies of their own, that count instructions, and those of this tool
LEFT_OUT = r"^(SeededFaults|instructions|Mutants)"
SLOW = r"^(verbs|faults|long|lint)$"  # labels of tests outside the quick suite


def say(text):
    print("mutants: " + text, flush=True)


class Work:
    """The folder that holds everything, step by step, so that a step that is done is not done again."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        self.tree, self.build = self.path("tree"), self.path("build")
        os.makedirs(self.folder, exist_ok=True)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def has(self, name):
        return os.path.exists(self.path(name))

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return [json.loads(line) for line in file] if name.endswith("l") else json.load(file)

    def write(self, name, what):
        with open(self.path(name + ".new"), "w", encoding="utf-8") as file:
            if name.endswith("l"):
                file.writelines(json.dumps(item) + "\n" for item in what)
            else:
                json.dump(what, file, indent=1)
        os.replace(self.path(name + ".new"), self.path(name))


def commit_of(source):
    text = lambda *words: subprocess.run(["git", "-C", source, *words], capture_output=True, text=True).stdout.strip()
    changed = text("status", "--porcelain", "--", *ROOMS, "tests")
    return text("rev-parse", "HEAD") + (" with changes" if changed else "")


def reader_of_sites():
    try:
        import sites
    except ImportError:
        sys.exit("mutants: drawing reads the syntax tree: apt-get install python3-clang-14 (and run Debian's /usr/bin/python3)")
    return sites


def drawn(work, source, seed, count, jobs):
    """The sample, and the sources that it was drawn from."""
    if not work.has("sample.jsonl"):
        sites = reader_of_sites()
        building.copy_of_repository(source, work.tree)
        building.configure(work.tree, work.build)
        if not work.has("sites.jsonl"):
            work.write("sites.jsonl", sites.find_sites(work.tree, ROOMS, os.path.join(work.build, "compile_commands.json"), jobs, say))
        all_sites = work.read("sites.jsonl")
        texts = {}
        for file in {site["file"] for site in all_sites}:
            with open(os.path.join(work.tree, file), "rb") as text:
                texts[file] = text.read()
        sample = draw.draw(all_sites, texts, count, seed)
        rooms = {}
        for site in all_sites:
            for room in {draw.room_of(site["file"]), draw.sub_room_of(site["file"])}:
                rooms[room] = rooms.get(room, 0) + 1
        work.write("about.json", {"commit": commit_of(source), "seed": seed, "count": count, "sites": rooms,
                                  "shares": draw.shares(all_sites, count)})
        work.write("texts.json", {file: text.decode() for file, text in texts.items()})
        work.write("sample.jsonl", sample)
    about = work.read("about.json")
    if seed is not None and (about["seed"], about["count"]) != (seed, count):
        sys.exit("mutants: %s holds seed %d, count %d: take another folder" % (work.folder, about["seed"], about["count"]))
    return work.read("sample.jsonl"), {file: text.encode() for file, text in work.read("texts.json").items()}


def drawn_since(work, source, revision, count, seed, jobs):
    """The same for the lines that differ from a revision."""
    for name in ("sample.jsonl", "tests.json", "dropped.json", "results.jsonl"):
        if work.has(name):
            os.remove(work.path(name))
    lines = changed.changed_lines(source, revision, ROOMS)
    say("%d lines of %d sources differ from %s" % (sum(map(len, lines.values())), len(lines), revision))
    if not lines:
        return [], {}
    sites = reader_of_sites()
    changed.refresh(source, work.tree)
    work.build = changed.configure(work.tree)
    found = sites.find_sites(work.tree, ROOMS, os.path.join(work.build, "compile_commands.json"), jobs, lambda text: None,
                             changed.units_of(work.tree, lines))
    found = [site for site in found if site["line"] in lines.get(site["file"], ())]
    texts = {}
    for file in {site["file"] for site in found}:
        with open(os.path.join(work.tree, file), "rb") as text:
            texts[file] = text.read()
    of_room = {}
    for site in found:
        of_room[draw.room_of(site["file"])] = of_room.get(draw.room_of(site["file"]), 0) + 1
    sample = draw.draw(found, texts, count, seed) if found else []
    work.write("about.json", {"commit": commit_of(source), "seed": seed, "count": count, "since": revision, "sites": of_room,
                              "shares": draw.shares(found, count) if found else {}})
    work.write("sample.jsonl", sample)
    return sample, texts


def built(work, sample, texts):
    """{id: why} of the mutants that do not compile."""
    if not work.has("dropped.json"):
        work.write("dropped.json", building.build_all(work.build, work.tree, texts, sample, say))
    return {int(number): why for number, why in work.read("dropped.json").items()}


def first_of_each_room(sample, dropped, shares):
    """The first that compile, as many as the room's share; those that do not compile before the last of them count as drawn."""
    taken, compiled = [], {}
    for mutant in sample:
        room = mutant["room"]
        if compiled.get(room, 0) < shares[room]:
            taken.append(mutant)
            compiled[room] = compiled.get(room, 0) + (mutant["id"] not in dropped)
    return taken


def judged(work, sample, tests, sound, jobs, budget):
    """Judges the mutants not judged yet, or stopped by a smaller budget; results are appended one by one."""
    done = {result["id"]: result for result in (work.read("results.jsonl") if work.has("results.jsonl") else [])}
    todo = [m for m in sample if m["id"] not in done or done[m["id"]]["not_run"] and done[m["id"]]["budget"] < budget]
    lock, start = threading.Lock(), time.monotonic()
    counter = [0]

    def one(mutant):
        result = judge.judge(mutant, tests, sound, budget, done.get(mutant["id"]))
        result["budget"] = budget
        with lock:
            done[mutant["id"]] = result
            with open(work.path("results.jsonl"), "a", encoding="utf-8") as file:
                file.write(json.dumps(result) + "\n")
            counter[0] += 1
            if counter[0] % 10 == 0 or counter[0] == len(todo):
                killed = sum(bool(done[m["id"]]["killer"]) for m in sample if m["id"] in done)
                say("%d of %d judged in %.0f min; %d killed so far" % (counter[0], len(todo), (time.monotonic() - start) / 60, killed))
                write_report(work, sample, sound)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, todo))


def write_report(work, sample, sound):
    about = work.read("about.json")
    dropped = {int(number): why for number, why in work.read("dropped.json").items()}
    results = {result["id"]: result for result in (work.read("results.jsonl") if work.has("results.jsonl") else [])}
    equivalents = report.read_equivalents(os.path.join(HERE, "equivalent.txt"))
    text = "Mutants of %s, seed %d, %d wanted.\n\n" % (about["commit"], about["seed"], about["count"])
    text += report.table(sample, results, dropped, equivalents, about["sites"])
    kinds = report.counts(sample, results, dropped, equivalents, lambda file: "all")
    text += "\nBy outcome: " + ", ".join("%s %d" % item for item in sorted(kinds["all"].items())) + "\n"
    with open(work.path("report.md"), "w", encoding="utf-8") as file:
        file.write(text)

    def reached_by(mutant):
        names = [name for name, run in sound.items() if mutant["id"] in run["reached_set"]]
        return sorted(names, key=lambda name: (-judge.affinity(name, mutant), sound[name]["seconds"]))[:3]

    shutil.rmtree(work.path("survivors"), ignore_errors=True)
    os.makedirs(work.path("survivors"))
    for room, blocks in report.survivors(sample, results, dropped, equivalents, reached_by).items():
        with open(work.path("survivors", room.replace("/", "_") + ".md"), "w", encoding="utf-8") as file:
            file.write("# %s: %d survivors\n\n%s" % (room, len(blocks), "".join(blocks)))
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", required=True, help="folder for the copy, its build, and the results")
    parser.add_argument("--seed", type=int)
    parser.add_argument("--since", metavar="REVISION", help="draw from the lines that differ from it")
    parser.add_argument("--count", type=int, help="how many (400; 40 of changed lines)")
    parser.add_argument("--budget", type=float, help="seconds of tests run per mutant, as they take without one (60; 10 of changed lines)")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--source", default=ROOT, help="the repository (this one)")
    parser.add_argument("--leave-out", default=LEFT_OUT, help="tests that are not run, as a regular expression (%(default)s)")
    parser.add_argument("--report", action="store_true", help="only report")
    arguments = parser.parse_args()
    work = Work(arguments.work)
    of_all, budget = arguments.since is None, arguments.budget
    count = arguments.count or (400 if of_all else 40)
    if budget is None:
        budget = 60 if of_all else 10
    if of_all:
        if arguments.seed is None and not work.has("sample.jsonl"):
            parser.error("--seed is needed to draw")
        sample, texts = drawn(work, arguments.source, arguments.seed, count, arguments.jobs)
    else:
        sample, texts = drawn_since(work, arguments.source, arguments.since, count, arguments.seed or 1, arguments.jobs)
        if not sample:
            print("nothing drawn: no line that differs from %s can be changed" % arguments.since)
            return 0
    dropped = built(work, sample, texts)
    tests = judge.tests_of(work.build, arguments.leave_out)
    if not of_all:
        tests = [test for test in tests if not any(re.match(SLOW, label) for label in test.labels)]
    if not work.has("tests.json"):
        say("%d tests without a mutant" % len(tests))
        work.write("tests.json", judge.sound_runs(tests, arguments.jobs, say))
    sound = work.read("tests.json")
    for run in sound.values():
        run["reached_set"] = set(run["reached"])
    tests = [test for test in tests if test.name in sound]
    taken = first_of_each_room(sample, dropped, work.read("about.json")["shares"])
    compiled = [mutant for mutant in taken if mutant["id"] not in dropped]
    if not arguments.report:
        judged(work, compiled, tests, sound, arguments.jobs, budget)
    print(write_report(work, taken, sound))
    if not of_all:
        for name in sorted(os.listdir(work.path("survivors"))):
            with open(work.path("survivors", name), encoding="utf-8") as file:
                print(file.read())
        killed = sum(bool(result["killer"]) for result in work.read("results.jsonl")) if work.has("results.jsonl") else 0
        print("%d of %d changes that compile are noticed; %d do not compile" % (killed, len(compiled), len(taken) - len(compiled)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
