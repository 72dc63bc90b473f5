#!/usr/bin/env python3
"""A program with wrong results for meshes is detected by every_mesh.py.

    wrong_outcomes.py PROGRAM

It is the program itself behind a script that changes its output, or its exit status.
"""

import os
import sys
import tempfile
import unittest

import every_mesh
import own_meshes

PROGRAM = None  # set by main
SCRIPT = """#!%s
import subprocess, sys
done = subprocess.run([%r, *sys.argv[1:]], capture_output=True, text=True)
out, err, status = done.stdout, done.stderr, done.returncode
%s
sys.stdout.write(out), sys.stderr.write(err), sys.exit(status)
"""


class WrongOutcomes(unittest.TestCase):
    def outcomes(self, change, name="one tetrahedron"):
        with tempfile.TemporaryDirectory(prefix="dartboard-wrong-") as folder:
            program, path = os.path.join(folder, "program"), os.path.join(folder, "a.mesh")
            with open(program, "w") as file:
                file.write(SCRIPT % (sys.executable, PROGRAM, change))
            os.chmod(program, 0o755)
            bodies = dict(own_meshes.BODIES, **{n: body for n, (body, _) in own_meshes.refused().items()})
            own_meshes.write_medit(path, *bodies[name])
            return {verb: (kind, said) for verb, said, _, kind in every_mesh.Collection(program, operations=5).verbs_of(path)}

    def kinds(self, *arguments):
        return [kind for kind, _ in self.outcomes(*arguments).values()]

    def test_a_right_program_agrees(self):
        self.assertEqual(self.kinds(""), ["agrees"] * 4)

    def test_a_mesh_that_is_refused_has_one_verb(self):
        self.assertEqual(self.kinds("", "a flat cell"), ["refused"])

    def test_a_disagreement_is_wrong(self):
        self.assertEqual(self.outcomes("status = 1 if 'topology' in sys.argv else status")["topology"][0], "wrong")
        self.assertEqual(self.outcomes("status = 1 if 'conservation' in sys.argv else status")["conservation"][0], "wrong")

    def test_a_crash_is_wrong(self):
        self.assertEqual(self.kinds("status = 139"), ["wrong"])

    def test_a_refusal_without_a_reason_is_wrong(self):
        self.assertEqual(self.kinds("err, status = 'no', 3"), ["wrong"])

    def test_another_number_of_parts_is_wrong(self):
        change = "out = out.replace('\"components\": 1', '\"components\": 2') if 'simulate' in sys.argv else out"
        self.assertEqual(self.outcomes(change)["simulate"], ("wrong", "2 components, and 1 by mesh info"))

    def test_numbers_that_are_not_finite_and_fewer_steps_are_wrong(self):
        change = "import re; out = re.sub('\"mass\": [0-9.e+-]+', '\"mass\": NaN', out) if 'simulate' in sys.argv else out"
        self.assertEqual(self.outcomes(change)["simulate"][0], "wrong")
        change = "out = out.replace('\"steps\": 10', '\"steps\": 9') if 'simulate' in sys.argv else out"
        self.assertEqual(self.outcomes(change)["simulate"][0], "wrong")

    def test_a_map_that_is_not_valid_is_wrong(self):
        change = "out = out.replace('\"valid\": true', '\"valid\": false, \"violation\": \"x\"')"
        self.assertEqual(self.kinds(change), ["wrong"])


def main(program):
    global PROGRAM
    PROGRAM = os.path.abspath(program)
    return 0 if unittest.main(argv=["wrong_outcomes.py"], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
