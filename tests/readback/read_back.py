#!/usr/bin/env python3
"""Runs scenes with the program and compares every column that it writes with sums made here.

    read_back.py PROGRAM KIND [TEST...]    KIND: solid, mixed, surface, chain; with -still: the same without events

Nothing of the program's own is used to read its output, nor to decide what is right: bodies.py has the body at rest,
mechanics.py the mechanics, results.py the readers.
"""

import json
import math
import os
import shutil
import sys
import tempfile
import unittest

import numpy as np

import bodies
from contact import Contact
from mechanics import SUM, Groups, Network, facets_of
from results import STRESSES, Run, decoded

HERE = os.path.dirname(os.path.abspath(__file__))
LINE_OF_VTK = 3
COUNTS = ["vertices", "edges", "faces", "cells", "components"]


class Story:
    """A scene, its body and its run; for each frame the network that its cells make, and the expected events."""

    def __init__(self, program, kind, folder):
        name = kind.removesuffix("-still")
        with open(os.path.join(HERE, "scenes", name + ".json"), encoding="utf-8") as file:
            self.scene = json.load(file)
        if kind.endswith("-still"):
            self.scene.pop("events", None)
            self.scene.pop("expect", None)
        source = self.scene["body"]
        if "mesh" in source:
            self.body = getattr(bodies, name)()
            self.body.write(os.path.join(folder, source["mesh"]))
        else:
            made = source["generate"]["chain"]
            self.body = bodies.chain(made["links"], made["spacing"], source["scale"], source["translate"])
        path = os.path.join(folder, name + ".json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.scene, file)
        self.path = path
        self.run = Run(program, path, os.path.join(folder, "run"))
        self.h = self.scene["step"]
        self.steps = round(self.scene["duration"] / self.h)
        self.fixed = {p for s in self.scene.get("fixed", []) for p in s["ids"]}
        self.driven = {p: d for d in self.scene.get("driven", []) for p in d["ids"]}
        self.contact = Contact(self.scene["contact"]) if "contact" in self.scene else None
        self.surroundings = {"gravity": np.array(self.scene["gravity"], dtype=float),
                             "viscosity": self.scene["material"]["viscosity"]}
        self.see()

    def see(self):
        """Look at the frames of the run."""
        self.networks = [Network(self.body, self.scene["material"], frame) for frame in self.run.frames]

    def drive(self, point, n):
        """The velocity of a driven point from step boundary n on."""
        drive = self.driven[point]
        begin = round(drive.get("from", 0) / self.h)
        end = round(drive["until"] / self.h) if "until" in drive else self.steps + 1
        if not begin <= n < end:
            return np.zeros(3)
        turns = (n - begin) // round(drive["reverse_every"] / self.h) if "reverse_every" in drive else 0
        return np.array(drive["velocity"], dtype=float) * (-1) ** turns

    def pull(self, network, n):
        """The acceleration of each vertex by forces from outside, from step boundary n on."""
        start = self.networks[0]
        mass = {p: start.mass[v] for v, p in start.point.items()}
        pull = np.zeros((len(network.mass), 3))
        for force in self.scene.get("forces", []):
            begin = round(force.get("from", 0) / self.h)
            end = round(force["until"] / self.h) if "until" in force else self.steps + 1
            if begin <= n < end:
                shared = np.array(force["force"], dtype=float) / sum(mass[p] for p in force["ids"])
                for v, p in network.point.items():
                    if p in force["ids"]:
                        pull[v] += shared
        return pull

    def held(self, network):
        return [v for v, p in network.point.items() if p in self.fixed or p in self.driven]

    def shows(self, field):
        return field in self.scene["output"].get("fields", ["held", "stress"])

    def events_at(self, n):
        return [e for e in self.scene.get("events", []) if round(e["at"] / self.h) == n]


class ReadBack(unittest.TestCase):
    story = None  # set by main

    @classmethod
    def setUpClass(cls):
        cls.run_, cls.networks = cls.story.run, cls.story.networks

    def assert_near(self, actual, value_and_bound, what):
        value, bound = value_and_bound
        self.assertLessEqual(abs(float(actual) - value), bound, "%s: %s, expected %.17g" % (what, actual, value))

    def frame_at(self, time):
        """The number of the frame of a time, which must be exactly that number."""
        return [t for t, _ in self.run_.listed].index(float(time))

    # ---- frames

    def test_frames_are_listed_with_their_times(self):
        self.assertEqual(self.run_.listed, [(n * self.story.h, "frame_%06d.vtu" % n)
                                            for n in range(self.story.steps + 1)])
        self.assertEqual([f.time for f in self.run_.frames], [t for t, _ in self.run_.listed])
        there = sorted(f for f in os.listdir(self.run_.folder) if f.endswith(".vtu"))
        self.assertEqual(there, [name for _, name in self.run_.listed])

    def test_frames_have_the_columns_that_the_scene_asks_for_and_no_others(self):
        is_chain = self.story.body.dimension == 1
        of_points = {"held": {"held"}, "stress": set() if is_chain else set(STRESSES), "displacement": {"displacement"},
                     "springs": set(), "contact": {"contact_force", "contact_depth"}}
        of_cells = {"held": set(), "stress": {"tension"} if is_chain else set(), "displacement": set(),
                    "springs": {"strain"}, "contact": set()}
        shown = [field for field in of_points if self.story.shows(field)]
        for frame in self.run_.frames:
            self.assertEqual(frame.point_names, {"velocity", "mass", "mesh_point"}.union(*(of_points[f] for f in shown)))
            self.assertEqual(frame.cell_names, {"mesh_cell", "component"}.union(*(of_cells[f] for f in shown)))
            if not self.story.shows("springs"):
                self.assertEqual(frame.springs, [])

    def test_frames_keep_every_bit(self):
        path = os.path.join(self.run_.folder, self.run_.listed[-1][1])
        frame = self.run_.frames[-1]
        for name, values in (("Points", frame.x), ("velocity", frame.v), ("mass", frame.mass)):
            array, data = decoded(path, name)
            self.assertEqual(array.get("type"), "Float64")
            self.assertEqual(data, np.ascontiguousarray(values, dtype="<f8").tobytes())

    def test_cells_are_those_of_the_mesh_in_their_places(self):
        for n, network in enumerate(self.networks):
            self.assertEqual(network.mistakes, [], "frame %d" % n)

    def test_volumes_are_listed_as_vtk_documents_them(self):
        if self.story.body.dimension < 3:
            return
        for network, (_, name) in zip(self.networks, self.run_.listed):
            path = os.path.join(self.run_.folder, name)
            nodes, ends = (np.frombuffer(decoded(path, array)[1], "<i8") for array in ("connectivity", "offsets"))
            for kind, begin, end in zip(decoded(path, "types")[1], [0, *ends], ends):
                if kind == LINE_OF_VTK:
                    continue
                volume = bodies.fan_measure(network.rest[nodes[begin:end]], bodies.FACES_OF_VTK[kind])
                self.assertGreater(volume, 0, "type %d" % kind)

    def test_the_first_frame_is_what_the_scene_says(self):
        frame, network = self.run_.frames[0], self.networks[0]
        np.testing.assert_array_equal(frame.x, network.rest)
        initial = self.story.scene["initial_velocity"]
        for vertex, point in network.point.items():
            from_centre = self.story.body.points[point] - initial["centre"]
            velocity = initial["constant"] + np.array(initial["linear"]) @ from_centre
            if point in self.story.fixed:
                velocity = np.zeros(3)
            if point in self.story.driven:
                velocity = self.story.drive(point, 0)
            # four products and sums of numbers below 4
            np.testing.assert_allclose(frame.v[vertex], velocity, rtol=0, atol=16 * 2.0 ** -52)

    def test_masses_are_the_shares_of_the_cells(self):
        for network in self.networks:
            np.testing.assert_allclose(network.frame.mass, network.mass, rtol=2.0 ** -42, atol=0)

    def test_vertices_are_held_as_the_scene_says(self):
        if not self.story.shows("held"):
            return
        for network in self.networks:
            self.assertEqual(network.frame.held.dtype, np.uint8)
            self.assertEqual(list(network.frame.held.ravel()),
                             [2 if network.point[v] in self.story.driven else int(network.point[v] in self.story.fixed)
                              for v in range(len(network.frame.x))])

    def test_stresses_are_measures_of_those_of_the_springs(self):
        if not self.story.shows("stress") or self.story.body.dimension == 1:
            return
        for n, network in enumerate(self.networks):
            columns = [np.ravel(getattr(network.frame, name)) for name in STRESSES]
            self.assertEqual([len(column) for column in columns], 3 * [len(network.frame.x)])
            for v, (stress, off) in enumerate(zip(*network.stresses())):
                values = np.linalg.eigvalsh(stress)
                deviator = stress - np.trace(stress) / 3 * np.eye(3)
                # an entry moves by no more than the largest eigenvalue of its perturbation, so sqrt(3 / 2) times the
                # length of nine of them by less than four times that
                expected = [(values[-1], off), (np.abs(values).max(), off),
                            (math.sqrt(1.5 * (deviator ** 2).sum()), 4 * off)]
                for name, column, value in zip(STRESSES, columns, expected):
                    self.assert_near(column[v], value, "%s of vertex %d in frame %d" % (name, v, n))

    def test_tensions_are_those_of_the_links(self):
        if not self.story.shows("stress") or self.story.body.dimension > 1:
            return
        for network in self.networks:
            tension, off = network.tensions()
            self.assertEqual([frozenset(nodes) for _, nodes in network.frame.cells],
                             [frozenset(ends) for ends in network.ends.tolist()])
            np.testing.assert_allclose(network.frame.tension, tension, rtol=0, atol=off)

    def test_displacements_are_from_where_the_mesh_has_the_vertices(self):
        if not self.story.shows("displacement"):
            return
        for network in self.networks:
            np.testing.assert_array_equal(network.frame.displacement, network.frame.x - network.rest)

    def test_forces_and_depths_of_contact_are_those_of_the_boundary(self):
        if not self.story.shows("contact"):
            return
        most = 0
        for network in self.networks:
            force, stiffness = self.story.contact.forces(network, network.frame.x, network.frame.time)
            large = np.abs(network.frame.x).max()
            np.testing.assert_allclose(network.frame.contact_force, force, rtol=0, atol=SUM * large * stiffness.max())
            np.testing.assert_allclose(np.ravel(network.frame.contact_depth), self.story.contact.depths(network), rtol=0,
                                       atol=SUM * large)
            most = max(most, np.count_nonzero(force[:, 2]))
        self.assertGreater(most, 4)

    def test_pairs_in_contact_are_the_places_in_obstacles(self):
        fields = {"contact_pair_" + name for name in ("sample", "face", "obstacle", "depth")}
        for network in self.networks:
            frame = network.frame
            self.assertEqual(set(frame.fields) - {"TimeValue"}, fields if self.story.shows("contact") else set())
            if not self.story.shows("contact"):
                continue
            expected = self.story.contact.pairs(network)
            columns = [np.reshape(frame.fields["contact_pair_" + name], (-1, width))
                       for name, width in (("sample", 4), ("face", 3), ("obstacle", 1), ("depth", 1))]
            self.assertEqual([len(column) for column in columns], [len(expected)] * 4)
            found = {}
            for sample, face, (obstacle,), (depth,) in zip(*columns):
                self.assertEqual(list(face), [-1, -1, -1])
                found[tuple(sorted(int(v) for v in sample if v != -1)), int(obstacle)] = depth
            self.assertEqual(set(found), set(expected))
            for key, depth in expected.items():
                self.assertLessEqual(abs(found[key] - depth), SUM * np.abs(frame.x).max())

    def test_springs_are_the_edges_of_the_cells_with_their_strains(self):
        if not self.story.shows("springs"):
            return
        for network in self.networks:
            frame, (strain, off) = network.frame, network.strains()
            if self.story.body.dimension == 1:
                lines, values = frame.cells, frame.strain_of_cells
            else:
                lines, values = frame.springs, frame.strain
                self.assertEqual(set(frame.strain_of_cells), {0.0})
                self.assertEqual(frame.labels_of_springs, {-1})
            self.assertEqual({kind for kind, _ in lines}, {"line"})
            self.assertEqual({frozenset(ends) for _, ends in lines}, set(strain))
            self.assertEqual(len(lines), self.edges_of_map(network))
            for (_, ends), value in zip(lines, values):
                self.assert_near(value, (strain[frozenset(ends)], off), "strain of the spring between %s" % (ends,))

    def edges_of_map(self, network):
        return network.counts["edges"] if self.story.body.dimension > 1 else len(network.ends)

    def test_components_are_cells_that_share_facets(self):
        for network in self.networks:
            label = network.frame.component
            self.assertEqual(set(label), set(range(len(network.components))))
            for component in network.components:
                self.assertEqual(len({label[c] for c in component}), 1)

    def test_each_frame_is_a_runge_kutta_step_after_the_last(self):
        for n in range(self.story.steps):
            before, after = self.networks[n], self.networks[n + 1]
            surroundings = dict(self.story.surroundings)
            surroundings["gravity"] = surroundings["gravity"] + self.story.pull(before, n)
            if self.story.contact:
                # obstacles are at their places in the middle of the step
                surroundings["contact"] = lambda x, n=n, at=before: self.story.contact.forces(
                    at, x, (n + 0.5) * self.story.h)
            x, v, x_off, v_off = before.step(self.story.h, surroundings, self.story.held(before))
            for (cell, point), vertex in after.corner.items():
                was = before.corner[cell, point]
                self.assertLessEqual(np.abs(after.frame.x[vertex] - x[was]).max(), x_off, "frame %d" % (n + 1))
                velocity = self.story.drive(point, n + 1) if point in self.story.driven else v[was]
                self.assertLessEqual(np.abs(after.frame.v[vertex] - velocity).max(), v_off, "frame %d" % (n + 1))

    def test_the_body_moves_differently_along_each_axis(self):
        # checks that the test above would see exchanged columns
        for frame in self.run_.frames[1:]:
            for columns in (frame.x - self.run_.frames[0].x.mean(axis=0), frame.v):
                size = np.abs(columns).mean(axis=0)
                self.assertGreater(min(abs(size[a] - size[b]) for a, b in ((0, 1), (1, 2), (2, 0))), 1e-4)

    # ---- events

    def test_events_part_and_remove_the_cells_they_name(self):
        operations, gone = 0, set()
        for n, network in enumerate(self.networks):
            for event in self.story.events_at(n):
                # at the end of a step: cells are at their present places, and connected as before
                was = self.networks[max(0, n - 1)]
                sides = {}
                if "remove" in event:
                    named = set(event["remove"].get("ids", []))
                    operations += len(named - gone)
                    gone |= named
                    continue
                plane = event["dissociate"]["plane"]
                for cell, (_, nodes) in zip(network.frame.mesh_cell, network.frame.cells):
                    centre = np.mean([network.frame.x[v] for v in nodes], axis=0)
                    sides[cell] = np.dot(centre - plane["point"], plane["normal"]) >= 0
                parted = [key for key, cells in self.facets_at_rest(was).items()
                          if len(cells) == 2 and sides[cells[0]] != sides[cells[1]]]
                self.assertTrue(parted)
                operations += len(parted)
                now = self.facets_at_rest(network)
                for key in parted:
                    self.assertEqual(len(now[key]), 2)  # two cells have it still
                hang = Groups(network.frame.mesh_cell)
                for component in network.components:
                    for a in component:
                        hang.join(network.frame.mesh_cell[a], network.frame.mesh_cell[min(component)])
                for key in parted:
                    self.assertNotEqual(*(hang.find(cell) for cell in now[key]))
            self.assertEqual(sorted(network.frame.mesh_cell),
                             [c for c in range(len(self.story.body.cells)) if c not in gone])
            for row in self.run_.diagnostics:
                if float(row["time [s]"]) == network.frame.time:
                    self.assertEqual(int(row["operations"]), operations)
        self.assertEqual(self.run_.printed["last"]["operations"], operations)

    def facets_at_rest(self, network):
        """The cells of the body that meet in each set of its points, parted or not."""
        at = {}
        for cell, (kind, nodes) in zip(network.frame.mesh_cell, network.frame.cells):
            for facet in facets_of(kind, nodes):
                at.setdefault(frozenset(network.point[v] for v in facet), []).append(cell)
        return at

    # ---- diagnostics.csv

    def applied(self, n, before):
        """The account of forces at a step boundary: their potential. Where some begin or end, it is the account at an earlier
        boundary and their work since, by frames of all steps; anything where an event comes between."""
        story = self.story
        if before is None or not any("from" in force or "until" in force for force in story.scene["forces"]):
            return self.networks[n].gravitational(story.pull(self.networks[n], n))
        begin, value = before
        if any(story.events_at(k) for k in range(begin + 1, n + 1)):
            return value, math.inf
        bound = 2.0 ** -50 * abs(value)
        for k in range(begin, n):
            pull = story.pull(self.networks[k], k)
            for network, sign in (self.networks[k + 1], 1), (self.networks[k], -1):
                potential, rounding = network.gravitational(pull)
                value += sign * potential
                bound += rounding
        return value, bound

    def test_diagnostics_are_sums_over_the_frame_of_their_time(self):
        dimension = self.story.body.dimension
        area, stress = {3: ("m^2", "principal stress [Pa]"), 2: ("m", "principal stress [N/m]"),
                        1: ("m", "tension [N]")}[dimension]
        before = None
        for row in self.run_.diagnostics:
            network = self.networks[self.frame_at(row["time [s]"])]
            expected = {"kinetic [J]": network.kinetic(), "elastic [J]": network.elastic(),
                        "gravitational [J]": network.gravitational(self.story.surroundings["gravity"]),
                        "mass [kg]": (sum(network.cell_mass), 2.0 ** -42 * sum(network.cell_mass)),
                        "boundary [%s]" % area: network.boundary(),
                        "largest %s" % stress: network.largest_stress()}
            if "forces" in self.story.scene:
                n = round(float(row["time [s]"]) / self.story.h)
                expected["applied forces [J]"] = self.applied(n, before)
                before = n, float(row["applied forces [J]"])
            if self.story.contact:
                n = round(float(row["time [s]"]) / self.story.h)
                expected.update(self.story.contact.row(self.networks, n, self.story.h))
            for axis, letter in enumerate("xyz"):
                expected["momentum %s [kg m/s]" % letter] = network.momentum(axis)
                expected["angular momentum %s [kg m^2/s]" % letter] = network.angular_momentum(axis)
            for name, value in expected.items():
                self.assert_near(row[name], value, "%s at %s s" % (name, row["time [s]"]))
            for name in COUNTS:
                self.assertEqual(int(row[name]), network.counts[name], "%s at %s s" % (name, row["time [s]"]))
            self.assertEqual(set(row), set(expected) | set(COUNTS) | {"time [s]", "operations"})

    def test_diagnostics_have_the_rows_that_the_scene_asks_for(self):
        self.assertEqual([float(row["time [s]"]) for row in self.run_.diagnostics],
                         self.times(self.story.scene["output"]["diagnostics_every"]["steps"]))

    def test_no_two_columns_of_the_diagnostics_are_alike(self):
        # checks that the test of sums would see exchanged columns; masses and counts of cells are equal in places
        names = [n for n in self.run_.diagnostics[0] if not n.startswith("lost") and "[J]" in n or "momentum" in n or "stress" in n]
        last = [float(self.run_.diagnostics[-1][n]) for n in names]
        for a, value in enumerate(last):
            self.assertGreater(abs(value), 1e-6, names[a])
            for other in last[:a]:
                self.assertGreater(abs(value - other), 1e-6 * abs(value), names[a])

    def times(self, every):
        return [n * self.story.h for n in range(self.story.steps + 1) if n % every == 0 or n == self.story.steps]

    # ---- probes.csv

    def test_probes_are_the_vertices_of_their_points(self):
        self.assertEqual([float(row["time [s]"]) for row in self.run_.probes],
                         self.times(self.story.scene["output"]["probes_every"]["steps"]))
        gone = 0
        for row in self.run_.probes:
            network = self.networks[self.frame_at(row["time [s]"])]
            for probe in self.story.scene["output"]["probes"]:
                point = probe["vertex"] if "vertex" in probe else min(
                    range(len(self.story.body.points)),
                    key=lambda p: np.linalg.norm(self.story.body.points[p] - np.array(probe["near"])))
                fields = [row["%s %s" % (probe["name"], q)]
                          for q in ("x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]")]
                vertices = [v for v, p in network.point.items() if p == point]
                if not vertices:
                    self.assertEqual(fields, [""] * 6)
                    gone += 1
                    continue
                states = [list(network.frame.x[v]) + list(network.frame.v[v]) for v in vertices]
                self.assertIn([float(f) for f in fields], states)
        if self.story.scene["name"] in ("solid", "mixed") and "events" in self.story.scene:
            self.assertGreater(gone, 0)  # there the point of a probe is removed

    # ---- --json and summary.json

    def test_the_summary_is_what_was_printed(self):
        self.assertEqual(self.run_.summary, self.run_.printed)

    def test_the_summary_begins_and_ends_as_the_diagnostics_do(self):
        for which, row in (("first", self.run_.diagnostics[0]), ("last", self.run_.diagnostics[-1])):
            said = dict(self.run_.printed[which])
            for head, text in row.items():
                name = head.split(" [")[0].replace(" ", "_")
                if "momentum" not in name:
                    self.assertEqual(said.pop(name), float(text), "%s %s" % (which, name))
            self.assertEqual(said, {})

    def test_the_summary_says_what_was_run(self):
        said, events = self.run_.printed, self.story.scene.get("events", [])
        kinds = {kind for kind, _ in self.story.body.cells}
        maps = {1: "no map", 2: "2-g-map", 3: "tetrahedral 3-g-map" if kinds == {"tetra"} else "3-g-map"}
        self.assertEqual(said["map"], maps[self.story.body.dimension] if events else "no map")
        self.assertEqual((said["scene"], said["integrator"], said["steps"], said["interrupted"]),
                         (self.story.scene["name"], "rk4", self.story.steps, False))
        self.assertEqual(said["idle_events"], ["/events/%d" % k for k, e in enumerate(events)
                                               if "box" in e.get("remove", {})])
        self.assertIsNone(said["divergence"])
        self.assertNotIn("unjudged", said)

    def test_cuts_jump_by_no_more_than_rounding(self):
        jumps = self.run_.printed["jumps"]
        # events at the start have happened before anything is output
        self.assertEqual(jumps["events"], sum("dissociate" in e and e["at"] > 0
                                              for e in self.story.scene.get("events", [])))
        for name in ("mass", "stiffness", "momentum", "energy"):
            self.assertLessEqual(jumps[name], 2.0 ** -40, name)
        self.assertLessEqual(self.run_.printed["mass_drift"], 2.0 ** -40)

    def test_what_the_scene_expects_is_held_against_the_last_frame(self):
        rows = {row["what"]: row for row in self.run_.printed["expected"]}
        expect = self.story.scene.get("expect", {})
        self.assertEqual(set(rows), set(expect))
        for name, value in expect.items():
            self.assertEqual(rows[name]["expected"], str(value))
            actual = self.run_.diagnostics[-1][name]
            self.assertEqual(rows[name]["actual"], actual)
            self.assertEqual(rows[name]["holds"], str(value) == actual)
        all_hold = all(row["holds"] for row in rows.values())
        self.assertEqual((self.run_.printed.get("holds"), self.run_.status), (all_hold if rows else None, 0 if all_hold else 1))


def main(program, kind, *tests):
    folder = tempfile.mkdtemp(prefix="dartboard-read-back-")
    try:
        ReadBack.story = Story(program, kind, folder)
        return 0 if unittest.main(argv=["read_back.py", *tests], exit=False).result.wasSuccessful() else 1
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
