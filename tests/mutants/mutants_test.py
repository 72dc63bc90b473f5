#!/usr/bin/env python3
"""The tool that counts killed mutants, tried on programs of a few lines whose answers are known."""

import json
import os
import subprocess
import sys
import tempfile
import types
import unittest

import build
import changed
import draw
import judge
import report
import schemata

try:
    import sites
except ImportError:
    sites = None

SOURCE = """// a, b and c differ
struct Pair {
  int first = 1, second = 2;
};
constexpr double tolerance = 0.5;
template <int n>
int repeat(int x) { return n * x; }
int largest(int a, int b) {
  int best = a;
  if (b > best) best = b;
  static_assert(sizeof(int) >= 2);
  return best;
}
bool is_near(double x) { return x < tolerance && x > -tolerance; }
int main(int count, char**) {
  Pair pair;
  pair.first += repeat<3>(count);
  return largest(pair.first, pair.second) + (is_near(0.4) ? 10 : 20);
}
"""


def change(source, before, after, number, kind="arithmetic", **more):
    """A mutant of SOURCE, as draw.py makes them."""
    begin = source.index(before)
    return dict({"id": number, "file": "core/one.cpp", "line": source.count("\n", 0, begin) + 1, "kind": kind,
                 "edits": [[begin, begin + len(before), after]], "key": "k%d" % number, "room": "core"}, **more)


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


class Schemata(Folder):
    def compiled(self, mutants):
        text = schemata.with_mutants(SOURCE.encode(), mutants).decode()
        self.assertEqual(text.count("\n"), SOURCE.count("\n"), "lines keep their numbers")
        for name, what in (("one.cpp", text), ("switch.h", schemata.SWITCH_H), ("switch.cpp", schemata.SWITCH_CPP)):
            self.write(name, what)
        subprocess.run(["g++", "-std=c++20", "-w", "-include", "switch.h", "one.cpp", "switch.cpp", "-o", "one"],
                       cwd=self.folder, check=True)

    def status(self, mutant, table=None):
        environment = dict(os.environ, DARTBOARD_MUTANT=str(mutant))
        if table:
            environment["DARTBOARD_REACHED"] = table
        return subprocess.run([os.path.join(self.folder, "one")], env=environment).returncode

    def test_each_change_is_made_by_its_number_alone_and_tells_that_it_was_reached(self):
        # with 1 argument: first is 1 + 3, so 4 is the larger one, and 0.4 is near
        at = SOURCE.index
        self.compiled([
            change(SOURCE, "b > best", "b < best", 1, "comparison"),                 # takes 2
            change(SOURCE, "best = b;", "", 2, "dropped", statement=True),           # is not run
            change(SOURCE, "b > best", "true", 3, "condition"),                      # takes 2
            change(SOURCE, "0.5", "0.1 * 0.5", 4, "constant",
                   constexpr_at=[at("constexpr"), at("constexpr") + 9, "const"]),    # 0.4 is far
            change(SOURCE, "x < tolerance && x > -tolerance", "(x < tolerance) || (x > -tolerance)", 5, "logic"),
            change(SOURCE, "x > -tolerance", "x < -tolerance", 6, "comparison"),     # within the one before
            change(SOURCE, "return best;", "return {};", 7, "return", statement=True),
            dict(change(SOURCE, "pair.first, ", "", 8, "arguments"),
                 edits=[[at("pair.first, "), at("pair.first, ") + 10, "pair.second"],
                        [at("pair.second)"), at("pair.second)") + 11, "pair.first"]]),
        ])
        table = os.path.join(self.folder, "table")
        self.assertEqual(self.status(0, table), 4 + 10)
        with open(table, "rb") as file:
            self.assertEqual([n for n, byte in enumerate(file.read()) if byte], [1, 3, 4, 5, 6, 7, 8])
        for mutant, status in ((1, 12), (2, 14), (3, 12), (4, 24), (5, 14), (6, 24), (7, 10), (8, 14), (9, 14)):
            self.assertEqual(self.status(mutant), status, "mutant %d" % mutant)

    def test_what_does_not_compile_is_traced_to_its_mutant(self):
        mutants = [change(SOURCE, "b > best", "b > worst", 1), change(SOURCE, "return best;", "return {};", 2, statement=True)]
        log = ("FAILED: core/one.o\n/tree/core/one.cpp: In function 'int largest(int, int)':\n"
               "/tree/core/one.cpp:10:46: error: 'worst' was not declared in this scope\n")
        found, unexplained = build.guilty(log, "/tree", {"core/one.cpp": SOURCE.encode()}, mutants)
        self.assertEqual((list(found), unexplained), ([1], []))
        # as a compiler behind a cache names files: from where it ran
        log = log.replace("/tree/", "../../")
        found, unexplained = build.guilty(log, "/tree", {"core/one.cpp": SOURCE.encode()}, mutants, "/tree/build/release")
        self.assertEqual((list(found), unexplained), ([1], []))

    def test_an_error_in_a_library_is_traced_to_the_line_that_led_there(self):
        mutants = [change(SOURCE, "b > best", "f(b)", 1), change(SOURCE, "return best;", "return {};", 2, statement=True)]
        log = ("FAILED: core/one.o\n/usr/include/x: In instantiation of 'f':\n/tree/core/one.cpp:10:7:   required from here\n"
               "/usr/include/x:7:1: error: no match\n")
        found, unexplained = build.guilty(log, "/tree", {"core/one.cpp": SOURCE.encode()}, mutants)
        self.assertEqual((list(found), unexplained), ([1], []))


@unittest.skipUnless(sites, "drawing needs libclang for Python: Debian's python3-clang-14")
class Sites(Folder):
    def found(self, source):
        self.write("core/one.cpp", source)
        unit, errors = sites.parse(os.path.join(self.folder, "core/one.cpp"), "g++ -std=c++20 -c one.cpp")
        self.assertEqual(errors, [])
        finder = sites.Finder(os.path.realpath(self.folder), ["core"])
        finder.walk_unit(unit)
        return {(site["kind"], source[site["edits"][0][0][0]:site["edits"][0][0][1]]) for site in finder.sites}

    def test_are_what_the_program_evaluates(self):
        found = self.found(SOURCE)
        for wanted in (("comparison", "b > best"), ("condition", "b > best"), ("dropped", "best = b;"), ("constant", "0.5"),
                       ("logic", "x < tolerance && x > -tolerance"), ("sign", "-tolerance"), ("return", "return best;"),
                       ("neighbour", "pair.first"), ("assignment", "pair.first += repeat<3>(count)"), ("arithmetic", "n * x"),
                       ("arguments", "pair.first"), ("constant", "10"), ("neighbour", "b"), ("condition", "is_near(0.4)")):
            self.assertIn(wanted, found)

    def test_are_not_what_the_compiler_evaluates_or_what_is_quoted(self):
        found = self.found('enum E { one = 7 }; int f(int x) { int a[8] = {}; const char* t = "9 + 9"; if constexpr (sizeof(x) == 6)'
                           " return a[0]; static_assert(5 > 4); switch (x) { case 3: return *t; } return x; }")
        self.assertEqual({text for _, text in found if any(digit in text for digit in "3456789")}, set())


class Draw(unittest.TestCase):
    SITES = [{"file": "core/one.cpp", "line": 1, "kind": "constant", "edits": [[[k, k + 1, "x"]]]} for k in range(300)] + \
            [{"file": "reference/two.cpp", "line": 1, "kind": "constant", "edits": [[[k, k + 1, "x"]]]} for k in range(100)]
    TEXTS = {"core/one.cpp": b"." * 400, "reference/two.cpp": b"." * 400}

    def test_gives_rooms_their_share_and_small_ones_enough(self):
        self.assertEqual(draw.shares(self.SITES, 400), {"core": 300, "reference": 100})
        self.assertEqual(draw.shares(self.SITES + self.SITES[:300] * 30, 400)["reference"], draw.LEAST_PER_ROOM)

    def test_repeats_with_its_seed_and_no_other(self):
        one = draw.draw(self.SITES, self.TEXTS, 80, 1)
        self.assertEqual(one, draw.draw(self.SITES, self.TEXTS, 80, 1))
        self.assertNotEqual([m["edits"] for m in one], [m["edits"] for m in draw.draw(self.SITES, self.TEXTS, 80, 2)])

    def test_takes_no_place_twice(self):
        places = [(m["file"], tuple(map(tuple, m["edits"]))) for m in draw.draw(self.SITES, self.TEXTS, 300, 1)]
        self.assertEqual(len(places), len(set(places)))


def shell(name, command):
    return judge.Test({"name": name, "command": ["/bin/sh", "-c", command]})


class Changed(unittest.TestCase):
    DIFF = ("diff --git a/core/one.h b/core/one.h\n--- a/core/one.h\n+++ b/core/one.h\n@@ -3 +3,2 @@ f\n-x\n+y\n+z\n"
            "@@ -9,2 +10,0 @@\n-gone\n-too\n"
            "diff --git a/core/gone.cpp b/core/gone.cpp\n--- a/core/gone.cpp\n+++ /dev/null\n@@ -1 +0,0 @@\n-x\n"
            "diff --git a/core/read.md b/core/read.md\n--- a/core/read.md\n+++ b/core/read.md\n@@ -1 +1 @@\n-x\n+y\n")

    def test_lines_are_those_that_the_new_text_has(self):
        self.assertEqual(changed.lines_of_diff(self.DIFF), {"core/one.h": {3, 4}})

    def test_a_tree_is_refreshed_without_touching_what_is_as_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            source, tree = os.path.join(folder, "source"), os.path.join(folder, "tree")
            os.makedirs(source)
            os.makedirs(tree)
            subprocess.run(["git", "init", "-q", source], check=True)
            write = lambda where, name, text: open(os.path.join(where, name), "w").write(text)
            for name in ("same.cpp", "other.cpp", "new.cpp"):
                write(source, name, name)
            for name, text in (("same.cpp", "same.cpp"), ("other.cpp", "mutated"), ("stale.cpp", "x")):
                write(tree, name, text)
                os.utime(os.path.join(tree, name), (1, 1))
            changed.refresh(source, tree)
            self.assertEqual(sorted(os.listdir(tree)), ["new.cpp", "other.cpp", "same.cpp"])
            self.assertEqual(open(os.path.join(tree, "other.cpp")).read(), "other.cpp")
            times = [os.stat(os.path.join(tree, name)).st_mtime for name in ("same.cpp", "other.cpp")]
            self.assertEqual(times[0], 1)
            self.assertGreater(times[1], 1)


class Judge(unittest.TestCase):
    def judged(self, tests, budget=60):
        sound = {test.name: {"seconds": 0.01, "fails": None, "reached_set": {7}} for test in tests}
        return judge.judge({"id": 7, "key": "k", "file": "core/one.cpp"}, tests, sound, budget)

    def test_a_mutant_is_killed_by_the_test_that_fails(self):
        tests = [shell("passes", "true"), shell("sees", 'test "$DARTBOARD_MUTANT" != 7'), shell("sees other", 'test "$DARTBOARD_MUTANT" != 8')]
        self.assertEqual(self.judged(tests)["killer"], "sees")

    def test_a_mutant_that_every_test_passes_survives_them(self):
        result = self.judged([shell("passes", "true"), shell("passes too", "true")])
        self.assertEqual((result["killer"], result["passed"], result["not_run"]), (None, ["passes", "passes too"], []))

    def test_a_mutant_that_no_test_reaches_survives_unrun(self):
        test = shell("fails always", "false")
        sound = {test.name: {"seconds": 0.01, "fails": None, "reached_set": set()}}
        result = judge.judge({"id": 7, "key": "k", "file": "core/one.cpp"}, [test], sound, 60)
        self.assertEqual((result["killer"], result["reached_by"]), (None, 0))

    def test_a_run_that_does_not_end_kills(self):
        how, _, _ = judge.run([shell("hangs", "sleep 60")], 0.2, 7)
        self.assertIn("does not end", how)

    def test_tests_beyond_the_budget_are_named(self):
        tests = [shell("one", "true"), shell("two", "true")]
        sound = {test.name: {"seconds": 10.0, "fails": None, "reached_set": {7}} for test in tests}
        result = judge.judge({"id": 7, "key": "k", "file": "core/other.cpp"}, tests, sound, 15)
        self.assertEqual((len(result["passed"]), len(result["not_run"])), (1, 1))


class Report(unittest.TestCase):
    def test_intervals_are_wilsons(self):
        # from the formula by hand: 0 of 10 gives z^2 / (10 + z^2), and 5 of 10 is symmetric about a half
        self.assertAlmostEqual(report.wilson(0, 10)[1], 1.96 ** 2 / (10 + 1.96 ** 2))
        self.assertEqual(report.wilson(0, 10)[0], 0.0)
        low, high = report.wilson(5, 10)
        self.assertAlmostEqual(low + high, 1.0)
        self.assertAlmostEqual(high, 0.5 + 0.5 * 1.96 / (10 + 1.96 ** 2) ** 0.5)

    def test_counts_what_became_of_each_mutant(self):
        mutants = [change(SOURCE, "b > best", "b < best", k) for k in range(1, 7)]
        result = lambda k, killer, by: {"id": k, "killer": killer, "reached_by": by, "not_run": []}
        results = {1: result(1, "T", 3), 2: result(2, None, 3), 3: result(3, None, 0), 5: result(5, None, 2)}
        rows = report.counts(mutants, results, {4: "no"}, {"k5": "the same"}, lambda file: "core")
        self.assertEqual(rows["core"], {"drawn": 6, "killed": 1, "survived": 1, "not reached": 1, "not compiled": 1,
                                        "equivalent": 1, "not judged yet": 1})
        self.assertEqual(report.row_of("core", rows["core"], 0)[6:8], [4, 1], "counted and killed")

    def test_what_is_set_aside_has_a_reason(self):
        here = os.path.dirname(os.path.abspath(__file__))
        for key, reason in report.read_equivalents(os.path.join(here, "equivalent.txt")).items():
            self.assertRegex(key, "^[0-9a-f]{12}$")
            self.assertGreater(len(reason), 20)
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("0123456789ab core/one.cpp:\n")
            file.flush()
            self.assertRaises(ValueError, report.read_equivalents, file.name)


if __name__ == "__main__":
    unittest.main()
