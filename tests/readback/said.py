#!/usr/bin/env python3
"""Messages of `dartboard simulate` on a run, where the expected ones are known.

    said.py PROGRAM [TEST...]
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import bodies
from results import Run, file_hash, table


def box(**more):
    """A scene of a few cells, with other keys as given."""
    scene = {"name": "x", "body": {"generate": {"box": {"cells": [2, 1, 1], "spacing": 0.25}}}, "gravity": [0, 0, 0],
             "step": 0.001, "duration": 0.004}
    scene.update(more)
    return scene


class Said(unittest.TestCase):
    program = None  # set by main

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="dartboard-said-")
        self.addCleanup(shutil.rmtree, self.folder)

    def scene(self, scene):
        path = os.path.join(self.folder, "scene.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        return path

    def run_(self, scene, *options):
        out = os.path.join(self.folder, "run%d" % len(os.listdir(self.folder)))
        return Run(self.program, self.scene(scene), out, *options)

    def print_(self, scene, *options):
        return subprocess.run([self.program, "simulate", self.scene(scene), *options], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)

    # Ten squares of a tenth of a kilogram (1.6 kg/m^2 * 1/16 m^2, and 1.6 is 16 times what 0.1 is as a double). Tenths do
    # not add up: 0.1 ten times is 0.9999999999999999, three times 0.30000000000000004, seven times 0.7 or a little less.

    def tenths(self, at):
        return box(body={"generate": {"sheet": {"cells": [5, 2], "spacing": 0.25, "kind": "quadrilaterals"}}},
                   material={"density": 1.6}, events=[{"at": at, "remove": {"ids": [1, 4, 8]}}])

    def test_mass_that_rounding_loses_in_a_removal_is_accounted_for_to_the_last_bit(self):
        for at in (0.002, 0):  # in the second case before the first row
            ten, three, seven = (sum([0.1] * n) for n in (10, 3, 7))
            run = self.run_(self.tenths(at))
            start = ten if at else seven + three
            self.assertEqual(run.printed["first"]["mass"], ten if at else seven)
            self.assertEqual(run.printed["last"]["mass"], seven)
            self.assertEqual(run.printed["mass_drift"], abs(start - three - seven) / start)
        self.assertNotEqual(ten - three - seven, 0)

    def test_the_mass_unaccounted_for_is_reported_where_something_was_removed(self):
        ten, three, seven = (sum([0.1] * n) for n in (10, 3, 7))
        said = self.print_(self.tenths(0.002)).stdout
        self.assertIn("mass unaccounted for after removals: %.2e of the mass" % abs((ten - three - seven) / ten), said)
        self.assertNotIn("unaccounted", self.print_(box()).stdout)

    # ---- the table for readers

    def test_the_table_has_the_numbers_of_the_diagnostics(self):
        scene = box(initial_velocity={"linear": [[1, 2, 0], [0, 3, 1], [2, 0, 1]]}, gravity=[1, 2, -9.81],
                    events=[{"at": 0.002, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}},
                            {"at": 0.003, "remove": {"ids": [2]}}])
        said = self.print_(scene).stdout
        rows = table(os.path.join(self.run_(scene).folder, "diagnostics.csv"))
        for head, first in rows[0].items():
            if "momentum" in head:
                continue
            name = re.sub(r"^(kinetic|elastic|gravitational)", r"\1 energy", head)
            found = re.search(r"^ *%s +(\S+) +(\S+)$" % re.escape(name), said, re.M)
            self.assertTrue(found, "no row of %s in\n%s" % (name, said))
            self.assertEqual([found[1], found[2]], ["%.6g" % float(first), "%.6g" % float(rows[-1][head])], name)
        self.assertRegex(said, r"(?m)^ *steps +0 +4$")
        self.assertRegex(said, "jump at 1 event that dissociates: mass ")

    def test_the_first_lines_name_the_scene_and_how_it_is_run(self):
        for events, storage in (([], "no map is needed"), ([{"at": 0.001, "remove": {"ids": [0]}}], "tetrahedral 3-g-map")):
            lines = self.print_(box(events=events, integrator="verlet")).stdout.splitlines()
            self.assertEqual(lines[0], "x")
            self.assertRegex(lines[1], r"^%s, verlet, h = 0\.001 s \(0\.\d+ of the longest stable step\)$" % storage)

    def test_the_last_lines_say_what_was_written_and_where(self):
        out = os.path.join(self.folder, "written")
        said = self.print_(box(output={"frames_every": {"steps": 2}, "probes": [{"name": "a", "vertex": 0}]}), "--out", out)
        self.assertIn("\n3 frames, frames.pvd, diagnostics.csv, probes.csv written to %s.\n" % out, said.stdout)
        self.assertEqual(sorted(os.listdir(out)), ["diagnostics.csv", "frame_000000.vtu", "frame_000001.vtu",
                                                   "frame_000002.vtu", "frames.pvd", "manifest.json", "probes.csv",
                                                   "summary.json"])

    def test_the_hash_that_is_printed_is_that_of_the_summary(self):
        scene = box(initial_velocity={"linear": [[1, 2, 0], [0, 3, 1], [2, 0, 1]]})
        self.assertIn("hash of the last state %s\n" % self.run_(scene).printed["hash"], self.print_(scene).stdout)

    # ---- warnings

    def test_a_step_that_is_too_long_and_an_event_that_is_idle_are_warned_of(self):
        scene = box(material={"density": 1, "stiffness": 5e5}, step=0.0005, duration=0.001,
                    events=[{"at": 0.0005, "remove": {"box": {"min": [5, 5, 5], "max": [6, 6, 6]}}}])
        run, said = self.run_(scene).printed, self.print_(scene)
        step = (r"at the start: a step of 0\.0005 s is too long for rk4; (\S+) s is stable; set /step to at most (\S+), "
                r"\"unstable_step\" to \"substep\", or take an implicit integrator")
        idle = "the event at /events/0 never did anything"
        self.assertRegex(run["warnings"][0], "^%s$" % step)
        self.assertEqual(run["warnings"][1:], [idle])
        self.assertRegex(said.stderr, "(?m)^warning: %s$" % step)
        self.assertNotIn("too long", said.stdout)  # once, before the run
        self.assertEqual(run["idle_events"], ["/events/0"])
        self.assertIn("warning: %s\n" % idle, said.stdout)
        sound = self.run_(box()).printed
        self.assertEqual((sound["warnings"], sound["idle_events"]), ([], []))
        self.assertNotIn("warning", self.print_(box()).stderr)
        self.assertNotIn("warning", self.print_(box()).stdout)

    def test_coordinates_that_are_too_large_are_warned_of(self):
        scene = box(body={"generate": {"box": {"cells": [2, 1, 1], "spacing": 0.25}}, "translate": [0, 1e10, 0]})
        self.assertIn("move the body to the origin (/body/translate)", self.run_(scene).printed["warnings"][0])
        self.assertIn("move the body to the origin (/body/translate)", self.print_(scene).stderr)

    # ---- verdicts

    def test_what_the_scene_expects_stands_beside_what_was_found(self):
        scene = box(expect={"cells": 12, "vertices": 13})
        run, said = self.run_(scene), self.print_(scene)
        self.assertEqual(run.printed["expected"],
                         [{"what": "vertices", "expected": "13", "actual": "12", "holds": False},
                          {"what": "cells", "expected": "12", "actual": "12", "holds": True}])
        self.assertEqual((run.printed["holds"], run.status, said.returncode), (False, 1, 1))
        self.assertRegex(said.stdout, r"(?m)^ *vertices +13 +12 +NO *$")
        self.assertRegex(said.stdout, r"(?m)^ *cells +12 +12 +yes *$")

    def test_other_cells_than_the_scenes_own_are_not_judged(self):
        scene = box(events=[{"at": 0.001, "remove": {"random": {"count": 2}}}], expect={"cells": 7})
        own = self.run_(scene)
        self.assertEqual((own.status, [row["holds"] for row in own.printed["expected"]]), (1, [False]))
        drawn = self.run_(scene, "--seed", "5")
        self.assertEqual((drawn.status, drawn.printed["expected"]), (0, []))
        self.assertIn("Other cells were drawn", drawn.printed["unjudged"])
        # 0 draws the scene's own
        self.assertEqual(self.run_(scene, "--seed", "0").printed["expected"], own.printed["expected"])

    def test_a_seed_draws_other_cells(self):
        scene = box(events=[{"at": 0.001, "remove": {"random": {"count": 2}}}])
        cells = {tuple(sorted(self.run_(scene, "--seed", str(seed)).frames[-1].mesh_cell)) for seed in range(6)}
        self.assertGreater(len(cells), 3)  # 66 ways to draw

    def test_a_run_that_is_cut_short_is_not_judged(self):
        for options, steps in ((("--steps", "3"), 3), (("--quick",), 100)):
            run = self.run_(box(duration=0.2, expect={"cells": 7}), *options)
            self.assertEqual((run.status, run.printed["expected"], run.printed["steps"]), (0, [], steps))
            self.assertIn("cut short", run.printed["unjudged"])
            self.assertEqual(run.frames[-1].time, steps * 0.001)

    # ---- inputs of the run

    def test_the_manifest_names_the_files_it_read_and_the_seed(self):
        body = bodies.solid()
        body.write(os.path.join(self.folder, "solid.mesh"))
        run = self.run_(box(body={"mesh": "solid.mesh"}), "--seed", "3")
        with open(os.path.join(run.folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        files = [os.path.join(self.folder, name) for name in ("scene.json", "solid.mesh")]
        self.assertEqual([entry["file"] for entry in manifest["inputs"]], ["scene.json", "solid.mesh"])
        for entry, path in zip(manifest["inputs"], files):
            self.assertEqual(entry["hash"], file_hash(path))
        self.assertEqual(list(manifest["seeds"].values()), [3])
        out = os.path.basename(run.folder)  # folders of the machine are not published
        self.assertEqual(manifest["command_line"],
                         ["dartboard", "simulate", "scene.json", "--json", "--out", out, "--seed", "3"])
        self.assertEqual(manifest["scene"]["body"], {"mesh": "solid.mesh"})

    # ---- output of a run that diverges

    def test_the_state_that_is_kept_of_a_run_that_diverges_is_that_of_the_step_it_names(self):
        # A tetrahedron has 1/384 kg and springs of 5e5 N/m: omega is above sqrt(5e5 * 384) = 1.4e4/s and h omega above
        # 6, where 2.8 is stable.
        scene = box(material={"density": 1, "stiffness": 5e5}, step=0.0005, duration=1.0,
                    initial_velocity={"linear": [[1, 0, 0], [0, 0, 0], [0, 0, 0]]},
                    output={"frames_every": {"steps": 1}, "diagnostics_every": {"steps": 1}})
        run = self.run_(scene)
        end = run.printed["divergence"]
        self.assertEqual((run.status, run.printed["holds"], run.printed["expected"]), (1, False, []))
        self.assertEqual(end["kept_step"], end["step"] - end["taken_back"])
        self.assertEqual(end["kept_time"], end["kept_step"] * 0.0005)
        self.assertEqual(run.printed["last"]["time"], end["kept_time"])
        self.assertEqual(run.listed[-1][0], (end["step"] - 1) * 0.0005)  # earlier output stays
        short = self.run_(scene, "--steps", str(end["kept_step"]))
        self.assertEqual(short.printed["hash"], run.printed["hash"])
        self.assertEqual(short.printed["last"], run.printed["last"])
        said = self.print_(scene).stdout
        self.assertIn("diverged at step %d, " % end["step"], said)
        self.assertIn("The state of step %d, t = %.6g s is kept" % (end["kept_step"], end["kept_time"]), said)


def main(program, *tests):
    Said.program = program
    return 0 if unittest.main(argv=["said.py", *tests], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
