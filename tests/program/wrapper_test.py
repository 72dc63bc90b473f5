#!/usr/bin/env python3
"""The script ./dartboard before any program is built.

    wrapper_test.py PROGRAM

PROGRAM is the built dartboard, whose verbs the script must know. Standard library only.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Wrapper(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.home = self.folder.name
        shutil.copy(os.path.join(ROOT, "dartboard"), self.home)
        shutil.copy(os.path.join(ROOT, "CMakeLists.txt"), self.home)
        self.tools = os.path.join(self.home, "tools")
        os.mkdir(self.tools)
        # every package is there, and cmake says when it ran
        self.tool("dpkg-query", "echo installed")
        self.tool("cmake", 'echo begin >> "$LOG"; sleep 0.3; echo end >> "$LOG"')

    def tearDown(self):
        self.folder.cleanup()

    def tool(self, name, text):
        path = os.path.join(self.tools, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + text + "\n")
        os.chmod(path, 0o755)

    def start(self, *arguments):
        environment = dict(os.environ, PATH=self.tools + ":" + os.environ["PATH"], LOG=os.path.join(self.home, "log"))
        return subprocess.Popen([os.path.join(self.home, "dartboard"), *arguments], env=environment, text=True,
                                stdin=subprocess.PIPE,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def answer(self, *arguments):
        process = self.start(*arguments)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def nothing_was_set_up(self):
        return not os.path.exists(os.path.join(self.home, "build")) and not os.path.exists(os.path.join(self.home, "log"))

    def test_knows_the_verbs_of_the_program(self):
        program = subprocess.run([PROGRAM, "no-verb"], capture_output=True, text=True)
        verbs = (program.stdout + program.stderr).split("the verbs are ")[1].strip()
        status, _, err = self.answer("no-verb")
        self.assertEqual(status, 2)
        self.assertIn("the verbs are " + verbs + ";", err)

    def test_answers_without_set_up_what_needs_none(self):
        for arguments, status in [([], 2), (["--help"], 0), (["--version"], 0), (["simulat"], 2)]:
            self.assertEqual(self.answer(*arguments)[0], status, arguments)
            self.assertTrue(self.nothing_was_set_up(), arguments)

    def test_tells_the_version_of_the_project(self):
        program = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True)
        self.assertEqual(self.answer("--version")[1], program.stdout)

    def test_says_before_the_first_build_how_long_it_takes(self):
        self.assertIn("minutes", self.answer("build")[2])

    def test_of_two_at_once_one_waits(self):
        calls = [self.start("build"), self.start("build")]
        said = [call.communicate(timeout=60)[1] for call in calls]
        self.assertEqual(sum("waiting for it" in text for text in said), 1, said)
        with open(os.path.join(self.home, "log"), encoding="utf-8") as log:
            self.assertEqual(log.read().split(), ["begin", "end"] * 4)

    def test_a_run_does_not_keep_others_waiting(self):
        release = os.path.join(self.home, "build", "release")
        os.makedirs(release)
        with open(os.path.join(release, "dartboard"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho running\nread answer\n")
        os.chmod(file.name, 0o755)
        first = self.start("mesh")
        self.assertEqual(first.stdout.readline(), "running\n")
        second = self.start("mesh")
        self.assertEqual(second.stdout.readline(), "running\n")
        for process in (first, second):
            process.kill()
            process.communicate()


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv[1])
    unittest.main(argv=sys.argv[:1])
