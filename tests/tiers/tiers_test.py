#!/usr/bin/env python3
"""The report of failures, and the audit's budget.   Standard library only."""

import contextlib
import io
import os
import sys
import tempfile
import time
import types
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import audit  # noqa: E402
import red  # noqa: E402

JUNIT = """<?xml version="1.0"?>
<testsuite name="x" tests="6" failures="2">
 <testcase name="Map.IsRight" time="0.1" status="run"><system-out>fine</system-out></testcase>
 <testcase name="Map.Sews/a+b" time="0.1" status="fail"><failure message="Failed"/>
  <system-out>[ RUN      ] Map.Sews
../../tests/core/map_test.cpp:41: Failure
Expected equality of these values:
  count
    Which is: 3
</system-out></testcase>
 <testcase name="Map.Hangs" time="120.0" status="fail"><failure message="Timeout"/><system-out>begun</system-out></testcase>
 <testcase name="Map.IsNotBuilt" time="0" status="notrun"><skipped message="Unable to find executable"/></testcase>
 <testcase name="instructions" time="1" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
 <testcase name="Script.Says" time="1" status="fail"><failure message="Failed"/>
  <system-out>Traceback (most recent call last):
  File "%s/tests/readback/read_back.py", line 12, in test_sum
    self.assertEqual(a, b)
  File "/usr/lib/python3.11/unittest/case.py", line 873, in assertEqual
    first(second)
AssertionError: 3 != 4
</system-out></testcase>
</testsuite>
""" % red.ROOT


class Red(unittest.TestCase):
    def lines(self, text=JUNIT):
        with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
            file.write(text)
            file.flush()
            return red.of_junit(file.name, "./dartboard test")

    def test_is_a_line_each_with_place_words_and_the_command_that_repeats_it(self):
        lines, passed = self.lines()
        self.assertEqual(passed, 1)
        self.assertEqual(lines, [
            "RED Map.Sews/a+b  tests/core/map_test.cpp:41: Expected equality of these values: count Which is: 3  "
            "(again: ./dartboard test -R '^Map\\.Sews/a\\+b$')",
            "RED Map.Hangs  Timeout after 120 s  (again: ./dartboard test -R '^Map\\.Hangs$')",
            "RED Map.IsNotBuilt  Unable to find executable after 0 s  (again: ./dartboard test -R '^Map\\.IsNotBuilt$')",
            "RED Script.Says  tests/readback/read_back.py:12: AssertionError: 3 != 4  "
            "(again: ./dartboard test -R '^Script\\.Says$')"])

    def test_of_a_sanitizer_names_the_first_frame_of_ours(self):
        self.assertEqual(red.message_of(
            "==12==ERROR: AddressSanitizer: heap-use-after-free on address 0x1\n"
            "    #0 0x55 in operator new /usr/lib/new.cpp:3\n"
            "    #1 0x56 in dartboard::sew() ../../core/operations/sew.cpp:17:3\n"),
            ("core/operations/sew.cpp:17", "ERROR: AddressSanitizer: heap-use-after-free on address 0x1"))

    def test_of_a_build_is_a_line_for_each_place(self):
        log = ("FAILED: x.o\n../../core/a.cpp:3:7: error: 'y' was not declared\n../../core/a.cpp:3:9: error: again\n"
               "/elsewhere/b.h:5:1: fatal error: c.h: No such file\n")
        self.assertEqual(red.of_build(log, "./dartboard test"),
                         ["RED build  core/a.cpp:3: 'y' was not declared  (again: ./dartboard test)",
                          "RED build  /elsewhere/b.h:5: c.h: No such file  (again: ./dartboard test)"])

    def test_of_a_link_that_failed_says_what_is_missing(self):
        self.assertIn("undefined reference to `sew'", red.of_build("ld: a.o: undefined reference to `sew'\n", "again")[0])


class Audit(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.before = audit.BY_NAME, audit.PARTS, audit.RED
        self.log = os.path.join(self.folder.name, "log")
        audit.RED = os.path.join(self.folder.name, "red")
        audit.PARTS = [self.part("good", "echo good >> %s" % self.log), self.part("bad", "echo bad >> %s; exit 1" % self.log),
                       self.part("slow", "echo slow >> %s; sleep 60; echo ended >> %s" % (self.log, self.log))]
        audit.BY_NAME = {part.name: part for part in audit.PARTS}

    def tearDown(self):
        audit.BY_NAME, audit.PARTS, audit.RED = self.before
        self.folder.cleanup()

    @staticmethod
    def part(name, script):
        return audit.Part(name, 1, ["/bin/sh", "-c", script], "something")

    def answer(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            status = audit.main(list(words))
        done = []
        if os.path.exists(self.log):
            with open(self.log, encoding="utf-8") as file:
                done = file.read().split()
        return status or 0, said.getvalue(), done

    def test_runs_the_parts_in_the_order_that_is_asked_for_and_fails_with_one(self):
        status, said, done = self.answer("bad", "good")
        self.assertEqual((status, done), (1, ["bad", "good"]))
        with open(os.path.join(audit.RED, "bad"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "RED bad  ended with status 1  (again: ./dartboard test --audit bad)\n")

    def test_leaves_out_what_has_not_begun_in_time_and_does_not_fail_for_it(self):
        status, said, done = self.answer("--since", str(time.time() - 120), "--begin-before", "2", "bad", "good")
        self.assertEqual((status, done), (0, []))
        self.assertEqual(said.count("left out: no time"), 2)

    def test_stops_what_does_not_end_in_time_and_does_not_fail_for_it(self):
        begun = time.monotonic()
        status, said, done = self.answer("--since", str(time.time() - 119), "--begin-before", "3", "--end-before", "2", "slow")
        self.assertEqual((status, done), (0, ["slow"]))
        self.assertIn("left out: no time to end", said)
        self.assertLess(time.monotonic() - begun, 30)

    def test_draws_the_scenes_of_the_seed_and_the_count_that_are_given(self):
        drawn = next(part for part in self.before[1] if part.name == "drawn")
        given = audit.with_options(drawn, types.SimpleNamespace(seed="7", count=None)).command
        self.assertEqual([given.count("--seed"), given[given.index("--seed") + 1]], [1, "7"])
        self.assertEqual(given[given.index("--count") + 1], drawn.command[drawn.command.index("--count") + 1])

    def test_lists_parts_with_their_minutes_and_runs_none(self):
        status, said, done = self.answer("--list")
        self.assertEqual((status, done), (0, []))
        self.assertRegex(said, r"good +1  something")

    def test_names_the_parts_when_one_is_asked_for_that_is_not_there(self):
        status, said, done = self.answer("good", "god")
        self.assertEqual((status, done), (2, []))
        self.assertIn("no part 'god'; the parts are good, bad, slow", said)


class Parts(unittest.TestCase):
    def test_each_say_how_long_they_take(self):
        for part in audit.PARTS:
            self.assertGreater(part.minutes, 0, part.name)

    def test_that_ci_names_are_there(self):
        with open(os.path.join(red.ROOT, ".ci", "run"), encoding="utf-8") as file:
            text = file.read()
        parts = text.split("parts=(")[1].split(")")[0].split()
        self.assertTrue(parts)
        self.assertEqual([name for name in parts if name not in audit.BY_NAME], [])
        self.assertEqual(parts[0], "sanitizers-core")


if __name__ == "__main__":
    unittest.main()
