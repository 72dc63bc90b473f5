#!/usr/bin/env python3
"""Results that are wrong in one way each: read_back.py must see all of them.

    wrong_results.py PROGRAM KIND [WORD...]    only those whose name contains a word
"""

import copy
import io
import shutil
import sys
import tempfile
import unittest

import numpy as np

from read_back import ReadBack, Story

ENERGIES = ("kinetic [J]", "elastic [J]", "gravitational [J]")


def frames(change):
    """Every frame but the first, which has nothing to differ in, is changed."""
    def tamper(run):
        for frame in run.frames[1:]:
            change(frame)
    return tamper


def rows(change):
    def tamper(run):
        for row in run.diagnostics:
            change(row)
    return tamper


def probes(change):
    def tamper(run):
        for row in run.probes:
            change(row)
    return tamper


def said(change):
    """The printed summary and the file are changed alike."""
    def tamper(run):
        change(run.printed)
        run.summary = copy.deepcopy(run.printed)
    return tamper


def exchange(table, a, b):
    table[a], table[b] = table[b], table[a]


def set_to(name, value):
    def change(table):
        table[name] = value(table[name])
    return change


def exchange_attributes(frame, a, b):
    one, other = getattr(frame, a), getattr(frame, b)
    setattr(frame, a, other)
    setattr(frame, b, one)


def lag(run):
    """Each frame has the places of the one before."""
    for frame, before in reversed(list(zip(run.frames[1:], run.frames))):
        if len(frame.x) == len(before.x):
            frame.x = before.x


def move_one(frame):
    frame.x = frame.x.copy()
    frame.x[2, 1] += 1e-9


def rows_lag(run):
    for row, before in reversed(list(zip(run.diagnostics[1:], run.diagnostics))):
        for name in ENERGIES:
            row[name] = before[name]


def keep_probes(run):
    """The last state of a removed vertex is repeated."""
    for row, before in zip(run.probes[1:], run.probes):
        for name in row:
            row[name] = row[name] or before[name]


def column(name, value):
    return frames(lambda frame: setattr(frame, name, value(frame)))


WIDTHS = {"sample": 4, "face": 3, "obstacle": 1, "depth": 1}


def pairs(name, value):
    """Changes a column of the pairs in contact, or all of them, in frames that have some."""
    def change(frame):
        for column_name, width in WIDTHS.items():
            rows_of_pairs = np.reshape(frame.fields["contact_pair_" + column_name], (-1, width))
            if len(rows_of_pairs) and name in (None, column_name):
                frame.fields["contact_pair_" + column_name] = value(rows_of_pairs)
    return frames(change)


WRONG = {
    "velocities are positions": column("v", lambda f: f.x),
    "each vertex has the velocity of the next": column("v", lambda f: np.roll(f.v, -1, axis=0)),
    "nothing moves": column("v", lambda f: 0 * f.v),
    "two axes of the velocities are exchanged": column("v", lambda f: f.v[:, [1, 0, 2]]),
    "velocities are off by a millionth": column("v", lambda f: f.v * (1 + 1e-6)),
    "every vertex weighs a kilogram": column("mass", lambda f: np.ones(len(f.mass))),
    "masses are inverse": column("mass", lambda f: 1 / f.mass),
    "masses are of single precision": column("mass", lambda f: f.mass.astype("f4").astype("f8")),
    "frames are mirrored": column("x", lambda f: f.x * [-1, 1, 1]),
    "two axes of the places are exchanged": column("x", lambda f: f.x[:, [0, 2, 1]]),
    "places are of single precision": column("x", lambda f: f.x.astype("f4").astype("f8")),
    "one vertex is a nanometre off": frames(move_one),
    "places are those of the frame before": lag,
    "frames are all of time 0": column("time", lambda f: 0.0),
    "cells are numbered anew": column("mesh_cell", lambda f: list(range(len(f.mesh_cell)))),
    "cells are numbered by components": frames(lambda f: exchange_attributes(f, "mesh_cell", "component")),
    "everything hangs together": column("component", lambda f: [0] * len(f.component)),
    "cells have two corners exchanged with others'": column(
        "cells", lambda f: [(k, n[:1] + f.cells[c - 1][1][1:2] + n[2:]) for c, (k, n) in enumerate(f.cells)]),
    "nothing is held": column("held", lambda f: 0 * f.held),
    "everything is held": column("held", lambda f: 0 * f.held + 1),
    "what is held is driven": column("held", lambda f: 2 * f.held),
    "stresses are those of the next vertex": column(
        "largest_principal_stress", lambda f: np.roll(f.largest_principal_stress, 1)),
    "no stress is pressure": column(
        "largest_principal_stress", lambda f: np.abs(f.largest_principal_stress)),
    "the magnitude of a stress is the largest stress": column(
        "largest_stress_magnitude", lambda f: f.largest_principal_stress),
    "the von Mises stress is the magnitude": column("von_mises_stress", lambda f: f.largest_stress_magnitude),
    "the von Mises stress is a hundred-millionth off": column("von_mises_stress", lambda f: f.von_mises_stress * (1 + 1e-8)),
    "displacements are from the middle": column("displacement", lambda f: f.x - f.x.mean(axis=0)),
    "displacements have the wrong sign": column("displacement", lambda f: -f.displacement),
    "displacements are of single precision": column("displacement", lambda f: f.displacement.astype("f4").astype("f8")),
    "a spring is missing": frames(lambda f: (f.springs.pop(), f.strain.pop())),
    "strains are those of the next spring": column("strain", lambda f: f.strain[1:] + f.strain[:1]),
    "strains are over the length now": column("strain", lambda f: [s / (1 + s) for s in f.strain]),
    "cells have strains": column("strain_of_cells", lambda f: [0.1] * len(f.cells)),
    "springs belong to a component": column("labels_of_springs", lambda f: {0}),
    "the list has all frames at time 0": lambda run: setattr(run, "listed", [(0.0, f) for _, f in run.listed]),
    "the list runs backwards": lambda run: run.listed.reverse(),
    "kinetic and gravitational energy are exchanged": rows(lambda r: exchange(r, ENERGIES[0], ENERGIES[2])),
    "forces do no work": rows(lambda r: [r.update({k: "0"}) for k in r if k.startswith("applied")]),
    "elastic energy is left out": rows(set_to(ENERGIES[1], lambda _: "0")),
    "energies are those of the row before": rows_lag,
    "momentum is angular": rows(lambda r: [exchange(r, "momentum %s [kg m/s]" % a,
                                                    "angular momentum %s [kg m^2/s]" % a) for a in "xyz"]),
    "two axes of momentum are exchanged": rows(lambda r: exchange(r, "momentum x [kg m/s]", "momentum z [kg m/s]")),
    "angular momentum has the wrong sign": rows(set_to("angular momentum y [kg m^2/s]", lambda t: str(-float(t)))),
    "mass is what it was": rows(set_to("mass [kg]", lambda _: "14.9")),
    "vertices are edges": rows(lambda r: exchange(r, "vertices", "edges")),
    "faces are one too many": rows(set_to("faces", lambda t: str(int(t) + 1))),
    "nothing ever comes apart": rows(set_to("components", lambda _: "1")),
    "the boundary is twice as large": rows(set_to("boundary [m^2]", lambda t: str(2 * float(t)))),
    "stress is a hundred-millionth off": rows(
        set_to("largest principal stress [Pa]", lambda t: repr(float(t) * (1 + 1e-8)))),
    "no operations are counted": rows(set_to("operations", lambda _: "0")),
    "six digits are kept": rows(set_to(ENERGIES[0], lambda t: "%.6g" % float(t))),
    "a row is missing": lambda run: run.diagnostics.pop(3),
    "two axes of a probe are exchanged": probes(lambda r: exchange(r, "corner x [m]", "corner y [m]")),
    "a probe is another": probes(lambda r: [exchange(r, "corner %s" % q, "near %s" % q) for q in ("x [m]", "y [m]",
                                                                                                "z [m]")]),
    "a probe does not move": probes(set_to("near vz [m/s]", lambda _: "0")),
    "a probe goes on without its vertex": keep_probes,
    "the summary has one energy for the other": said(lambda s: set_to("kinetic", lambda _: s["last"]["elastic"])(s["last"])),
    "the summary ends as it began": said(lambda s: s.update(last=s["first"])),
    "no cut is watched": said(lambda s: set_to("events", lambda _: 0)(s["jumps"])),
    "momentum jumps": said(lambda s: set_to("momentum", lambda _: 1e-9)(s["jumps"])),
    "mass is lost": said(set_to("mass_drift", lambda _: 1e-9)),
    "no event is idle": said(set_to("idle_events", lambda _: [])),
    "nothing holds": said(set_to("holds", lambda h: not h)),
    "the map is another": said(set_to("map", lambda _: "3-g-map")),
    "the summary is not what was printed": lambda run: set_to("steps", lambda n: n + 1)(run.summary),
}

# for a scene with contact only
WRONG_CONTACTS = {
    "forces of contact have the wrong sign": column("contact_force", lambda f: -f.contact_force),
    "forces of contact are those of the next vertex": column("contact_force", lambda f: np.roll(f.contact_force, 1, axis=0)),
    "forces of contact are of single precision": column(
        "contact_force", lambda f: f.contact_force.astype("f4").astype("f8")),
    "vertices are as deep as the deepest": column("contact_depth", lambda f: 0 * f.contact_depth + f.contact_depth.max()),
    "depths are a hundred-millionth off": column("contact_depth", lambda f: f.contact_depth * (1 + 1e-8)),
    "pairs are deeper by a hundred-millionth": pairs("depth", lambda d: d * (1 + 1e-8)),
    "pairs are of the next sample": pairs("sample", lambda s: np.roll(s, 1, axis=0)),
    "a pair is missing": pairs(None, lambda column: column[:-1]),
    "the energy of contacts is elastic": rows(lambda r: exchange(r, "contact [J]", ENERGIES[1])),
    "contacts have no energy": rows(set_to("contact [J]", lambda _: "0")),
    "obstacles that move do no work": rows(set_to("supplied at contacts [J]", lambda _: "0")),
    "their work has the wrong sign": rows(set_to("supplied at contacts [J]", lambda t: str(-float(t)))),
    "friction takes something": rows(set_to("lost by friction [J]", lambda _: "1e-9")),
    "restitution takes something": rows(set_to("lost by restitution [J]", lambda _: "1e-9")),
    "there is a contact more": rows(set_to("contacts", lambda t: str(int(t) + 1))),
    "the deepest contact is a hundred-millionth off": rows(
        set_to("deepest contact [m]", lambda t: repr(float(t) * (1 + 1e-8)))),
}


def seen(story, tamper):
    """The test that fails with these results, or None. Those that read the files themselves see the originals."""
    tampered = copy.copy(story)
    tampered.run = copy.deepcopy(story.run)
    tamper(tampered.run)
    tampered.see()
    ReadBack.story = tampered
    names = [n for n in unittest.defaultTestLoader.getTestCaseNames(ReadBack)
             if n not in ("test_frames_keep_every_bit", "test_volumes_are_listed_as_vtk_documents_them")]
    result = unittest.TextTestRunner(stream=io.StringIO(), failfast=True).run(
        unittest.TestSuite(ReadBack(n) for n in names))
    bad = result.failures + result.errors
    return bad[0][0].id().split(".")[-1] if bad else None


def main(program, kind, *words):
    folder = tempfile.mkdtemp(prefix="dartboard-wrong-results-")
    try:
        story = Story(program, kind, folder)
        first = seen(story, lambda run: None)
        if first:
            sys.exit("%s fails with results that nobody tampered with" % first)
        missed = []
        wrong = WRONG_CONTACTS if kind == "contact" else WRONG
        for name, tamper in wrong.items():
            if words and not any(word in name for word in words):
                continue
            test = seen(story, tamper)
            print("%-50s %s" % (name, test or "NOT SEEN"))
            if not test:
                missed.append(name)
        print("%d of %d wrong results seen" % (len(wrong) - len(missed), len(wrong)))
        return 1 if missed else 0
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
