"""Run tests with mutants on: which test reaches which mutant, and which mutant is killed by which test."""

import concurrent.futures
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

MEMORY = 4 << 30  # of address space: a mutant may request without limit
FILE = 256 << 20  # of one file, for the same reason


class Test:
    """One ctest. Those of GoogleTest share an executable and can be run several at a time."""

    def __init__(self, entry):
        self.name, self.command = entry["name"], entry["command"]
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.folder = properties.get("WORKING_DIRECTORY", ".")
        self.skip_status = properties.get("SKIP_RETURN_CODE")
        self.labels = properties.get("LABELS", [])
        self.environment = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
        self.filter = next((a.split("=", 1)[1] for a in self.command if a.startswith("--gtest_filter=")), None)
        self.suite = self.command[0] if self.filter else None


def tests_of(build, left_out):
    answer = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True)
    tests = [Test(entry) for entry in json.loads(answer.stdout)["tests"] if entry.get("command")]
    return [test for test in tests if not re.search(left_out, test.name)]


def limited():
    os.setsid()  # so that its children end with it
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE, FILE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(tests, limit, mutant=0, reached=None):
    """Runs one test, or several of one suite. Returns (how it failed or None, the test that was running, seconds)."""
    scratch = tempfile.mkdtemp(prefix="mutant-")
    environment = dict(os.environ, DARTBOARD_MUTANT=str(mutant), GTEST_FAIL_FAST="1", GTEST_COLOR="no", TMPDIR=scratch,
                       HOME=scratch, RC_PARAMS="seed=1", **tests[0].environment)  # random properties draw the same
    environment.pop("DARTBOARD_REACHED", None)
    if reached:
        environment["DARTBOARD_REACHED"] = reached
    command = tests[0].command
    if tests[0].suite:
        command = [tests[0].suite, "--gtest_filter=" + ":".join(t.filter for t in tests), "--gtest_also_run_disabled_tests"]
    start = time.monotonic()
    with open(os.path.join(scratch, "output"), "wb") as out:
        process = subprocess.Popen(command, cwd=tests[0].folder, env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT, preexec_fn=limited)
        how = None
        try:
            process.wait(timeout=limit)
        except subprocess.TimeoutExpired:
            how = "does not end within %.0f s" % limit
        try:
            os.killpg(process.pid, signal.SIGKILL)  # and its remaining processes
        except ProcessLookupError:
            pass
        process.wait()
    seconds = time.monotonic() - start
    with open(os.path.join(scratch, "output"), "rb") as file:
        output = file.read(64 << 20).decode(errors="replace")
    shutil.rmtree(scratch, ignore_errors=True)
    status = process.returncode
    if how is None and status != 0 and str(status) != tests[0].skip_status:
        how = "fails" if ": Failure" in output or not tests[0].suite else \
            "crashes (%s)" % signal.Signals(-status).name if status < 0 else "ends with exit status %d" % status
    if how is None and tests[0].suite and not re.search(r"^\[  (PASSED|SKIPPED) ", output, re.M):
        how = "ends before its tests do"
    begun = re.findall(r"^\[ RUN      \] (\S+)", output, re.M)
    return how, begun[-1] if begun else tests[0].name, seconds


def sound_runs(tests, workers, say):
    """Each test once without a mutant: {name: {"seconds", "reached": [ids], "fails"}}."""
    def one(test):
        with tempfile.NamedTemporaryFile(prefix="reached-") as table:
            how, _, seconds = run([test], 1800, reached=table.name)
            with open(table.name, "rb") as file:
                reached = [number for number, byte in enumerate(file.read()) if byte]
        return test.name, {"seconds": round(seconds, 3), "reached": reached, "fails": how}

    found = {}
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        for done, (name, result) in enumerate(pool.map(one, tests), 1):
            found[name] = result
            if result["fails"]:
                say("without a mutant %s %s: left out" % (name, result["fails"]))
            if done % 100 == 0:
                say("%d of %d tests without a mutant" % (done, len(tests)))
    return found


def affinity(test_name, mutant):
    """Tests are named after the code that they test: how much of the file's name is in the test's."""
    words = os.path.splitext(os.path.basename(mutant["file"]))[0].split("_")
    name = test_name.lower()
    return sum(word in name for word in words) / len(words)


def batches(tests, sound, mutant):
    """The tests in the order in which they are run: the likeliest, then the quickest, in ever larger bites."""
    seconds = lambda test: sound[test.name]["seconds"]
    near = [t for t in tests if affinity(t.name, mutant) > 0.5 and seconds(t) < 5]
    far = [t for t in tests if t not in near]
    order = []
    for group, steps in ((near, (0.3, 5)), (far, (0.05, 0.2, 1, 4))):
        below = 0
        for step in steps:
            by_suite = {}
            for test in group:
                if below <= seconds(test) < step:
                    by_suite.setdefault(test.suite or test.name, []).append(test)
            below = step
            for suite in sorted(by_suite.values(), key=lambda some: sum(map(seconds, some))):
                suite.sort(key=seconds)
                for k in range(0, len(suite), 200):
                    order.append(suite[k:k + 200])
        order += [[t] for t in sorted(group, key=seconds) if seconds(t) >= steps[-1]]
    return order


def judge(mutant, tests, sound, budget, known=None):
    """Whether a test that reaches the mutant fails with it on. Ends when `budget` seconds of (sound) test time are spent.

    `known` is an earlier result that ran out of its budget: the tests that passed then are not run again."""
    passed = set(known["passed"]) if known else set()
    able = [t for t in tests if not sound[t.name]["fails"] and mutant["id"] in sound[t.name]["reached_set"]]
    todo = [t for t in able if t.name not in passed]
    result = {"id": mutant["id"], "key": mutant["key"], "reached_by": len(able), "killer": None, "how": None,
              "seconds": known["seconds"] if known else 0.0}
    spent, unrun = 0.0, []
    for batch in batches(todo, sound, mutant):
        cost = sum(sound[t.name]["seconds"] for t in batch)
        if unrun or spent + cost > budget and spent > 0:
            unrun += [t.name for t in batch]
            continue
        how, name, seconds = run(batch, 20 + 6 * cost, mutant["id"])
        spent += cost
        result["seconds"] = round(result["seconds"] + seconds, 1)
        if how:
            result["killer"], result["how"] = name, how
            break
        passed.update(t.name for t in batch)
    result["passed"] = [] if result["killer"] else sorted(passed)
    result["not_run"] = [] if result["killer"] else unrun
    return result
