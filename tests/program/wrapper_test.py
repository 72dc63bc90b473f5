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
        self.tool("dpkg-query", 'for package; do :; done; echo "$package" >> "$LOG.packages"; echo installed')
        self.tool("cmake", 'echo begin >> "$LOG"; echo "$*" >> "$LOG.cmake"; sleep 0.3; echo end >> "$LOG"')

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
        out, err = process.communicate(timeout=600)
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
        said = [call.communicate(timeout=600)[1] for call in calls]
        self.assertEqual(sum("waiting for it" in text for text in said), 1, said)
        with open(os.path.join(self.home, "log"), encoding="utf-8") as log:
            self.assertEqual(log.read().split(), ["begin", "end"] * 4)

    def program(self, name, text):
        release = os.path.join(self.home, "build", "release")
        os.makedirs(release, exist_ok=True)
        with open(os.path.join(release, name), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + text + "\n")
        os.chmod(file.name, 0o755)

    def logged(self, name):
        with open(os.path.join(self.home, "log." + name), encoding="utf-8") as log:
            return log.read().split("\n")[:-1]

    def test_a_scene_is_run_without_the_harness_and_its_packages(self):
        self.program("dartboard", 'echo "scenes: $*"')
        self.assertEqual(self.answer("simulate", "beam.json")[:2], (0, "scenes: simulate beam.json\n"))
        configured, built = self.logged("cmake")
        self.assertIn("-DDARTBOARD_HARNESS=OFF -DDARTBOARD_TESTS=OFF", configured)
        self.assertTrue(built.endswith("--target dartboard"), built)
        packages = self.logged("packages")
        self.assertIn("libeigen3-dev", packages)
        for other in ("libcgal-dev", "libsundials-dev", "libgtest-dev", "valgrind"):
            self.assertNotIn(other, packages)

    def test_other_verbs_run_the_program_that_has_them(self):
        self.program("dartboard-harness", 'echo "every verb: $*"')
        self.assertEqual(self.answer("recommend", "beam.json")[:2], (0, "every verb: recommend beam.json\n"))
        configured, built = self.logged("cmake")
        self.assertIn("-DDARTBOARD_HARNESS=ON -DDARTBOARD_TESTS=OFF", configured)
        self.assertTrue(built.endswith("--target dartboard_harness"), built)
        self.assertIn("libcgal-dev", self.logged("packages"))
        self.assertNotIn("valgrind", self.logged("packages"))

    def test_the_suite_builds_all_of_it(self):
        self.answer("build")
        configured, built = self.logged("cmake")
        self.assertIn("-DDARTBOARD_HARNESS=ON -DDARTBOARD_TESTS=ON", configured)
        self.assertTrue(built.endswith("--target all"), built)
        self.assertIn("valgrind", self.logged("packages"))

    def test_what_was_built_before_stays_part_of_the_build(self):
        self.program("dartboard", "exit 0")
        with open(os.path.join(self.home, "build", "release", "CMakeCache.txt"), "w", encoding="utf-8"):
            pass
        self.answer("mesh")
        self.assertNotIn("HARNESS", self.logged("cmake")[0])

    def test_the_program_of_scenes_can_ask_for_the_one_that_has_every_verb(self):
        self.program("dartboard", 'exec "$DARTBOARD_SCRIPT" --harness "$@"')
        self.program("dartboard-harness", 'echo "every verb: $*"')
        self.assertEqual(self.answer("simulate", "a b.json")[:2], (0, "every verb: simulate a b.json\n"))
        self.assertEqual([line.split()[-1] for line in self.logged("cmake")[1::2]], ["dartboard", "dartboard_harness"])

    def test_a_run_does_not_keep_others_waiting(self):
        self.program("dartboard", "echo running\nread answer")
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
