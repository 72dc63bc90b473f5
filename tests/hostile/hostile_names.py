#!/usr/bin/env python3
"""Scenes, meshes and arguments with hostile names, through every verb that prints or draws.

    hostile_names.py PROGRAM

Nothing may run (no file `canary` appears), nothing may be written outside the folder given, nothing that a terminal acts
on may be printed, and written files must parse: JSON, XML, CSV.
"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unicodedata
import xml.etree.ElementTree

NAMES = [
    "`touch canary`",
    "$(touch canary)",
    "'; system('touch canary'); '",
    '"; !touch canary; "\\',
    "|touch canary",
    "<touch canary",
    "../../canary",
    "-e `touch canary`",
    "%n%s%x%1$n {} {0}",
    "{/Symbol a}^{2}_{x} @x &{x}",
    "</script><script>touch()</script> ]]> <!-- &lt;",
    "=cmd|' /C touch canary'!A0",
    "@SUM(A1);+1,\"2\"",
    "[a](javascript:touch) ![x](y) **b** # c | d",
    "two\nlines\r\n\ttab",
    "\x1b]0;owned\x07\x1b[2J\x1b[31mred\x7f",
    "\x9b31m\u202etxt.exe\u2028next",
    "nul\0nul",
    "\u00e9t\u00e9 \u20ac \U0001f600",
    "a" * 100000,
    "`" * 100000,
]
PARTS_OF_A_PLAYER = 9  # scripts: its data, three libraries and five of ours
ALL_IN_ONE = " ".join(name for name in NAMES if len(name) < 1000)
# no part of a path can hold a slash or a NUL, nor more than 255 bytes; but bytes that are no UTF-8
FILE_NAMES = [
    b"`touch canary` $(touch canary) 'x' \"y\"",
    b"<touch canary> |touch canary; =1 %n",
    b"\x1b[31m\xff\xc2\x9b\nnext",
    b"-rf {x}_{y} @z ](a) <script>",
]

TETRAHEDRON_OF_GMSH = (b'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 "%s"\n$EndPhysicalNames\n$Nodes\n4\n'
                       b'1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n')
TETRAHEDRON = """MeshVersionFormatted 1
Dimension 3
Vertices
4
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra
1
1 2 3 4 0
End
"""


class Failure(Exception):
    pass


def check(holds, what):
    if not holds:
        raise Failure(what)


def check_text(data, where):
    """UTF-8, and nothing in it but line breaks that a terminal acts on."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Failure(f"{where}: {error}") from error
    for letter in text:
        acts = unicodedata.category(letter) in ("Cc", "Zl", "Zp") or letter in "\u202a\u202b\u202d\u202e\u2066\u2067\u2068"
        check(letter == "\n" or not acts, f"{where}: holds {letter!r}: {text[:300]!r}")
    return text


class Runner:
    def __init__(self, program, folder):
        self.program, self.folder, self.runs = program, folder, 0
        self.here = os.path.join(folder, "here")
        os.mkdir(self.here)

    def __call__(self, *arguments, statuses=(0, 1), writes=False):
        """Run a verb where only an output folder may appear; its standard output, as text."""
        self.runs += 1
        out = os.path.join(self.folder, f"out{self.runs}")
        arguments = list(arguments) + (["--out", out] if writes else [])
        done = subprocess.run([self.program] + arguments, cwd=self.here, stdin=subprocess.DEVNULL, capture_output=True,
                              check=False, timeout=300)
        which = " ".join(ascii(a)[:120] for a in arguments)
        text = check_text(done.stdout, f"{which}: standard output")
        errors = check_text(done.stderr, f"{which}: standard error")
        check(done.returncode in statuses, f"{which}: status {done.returncode}, expected {statuses}: {errors[-3000:]}")
        check(len(errors) < 20000, f"{which}: {len(errors)} letters on standard error")
        check(os.listdir(self.here) == [], f"{which}: left {os.listdir(self.here)} where it ran")
        if writes:
            self.check_folder(out, which)
        return text

    def check_folder(self, folder, which):
        files = [os.path.join(path, name) for path, _, names in os.walk(folder) for name in names]
        check(files, f"{which}: wrote nothing")
        for path in files:
            name = os.path.basename(path)
            check("canary" != name, f"{which}: {name} was run")
            check(re.fullmatch(r"[\w.\-\u0080-\U0010ffff]+", name), f"{which}: writes a file named {name!r}")
            if name.endswith(".png"):
                continue
            with open(path, "rb") as stream:
                data = stream.read()
            if name.endswith((".vtu", ".pvd", ".svg")):
                xml.etree.ElementTree.fromstring(data)
                continue
            text = check_text(data, f"{which}: {name}")
            if name.endswith(".json"):
                json.loads(text)
            elif name.endswith(".jsonl"):
                for line in text.splitlines():
                    json.loads(line)
            elif name.endswith(".csv"):
                rows = list(csv.reader(text.splitlines(), strict=True))
                check(len(rows) > 1 and len({len(row) for row in rows}) == 1, f"{which}: {name}: {[len(r) for r in rows]}")
                check(not any(cell.startswith(("=", "+", "-", "@")) for cell in rows[0]), f"{which}: {name}: {rows[0]}")
            elif name.endswith(".gnuplot"):
                # only strings of our own are in double quotes, where backquotes are run
                for quoted in re.findall(r"'[^'\n]*'|\"[^\"\n]*\"", text):
                    check(quoted[0] == "'" or "`" not in quoted, f"{which}: {name}: {quoted}")


def chain(name):
    """One link, three steps."""
    return {"name": name, "about": name, "step": 0.001, "duration": 0.003,
            "body": {"generate": {"chain": {"links": 1, "spacing": 1}}},
            "output": {"probes": [{"name": name, "vertex": 0}, {"name": "other", "vertex": 1}]}}


def cube(name):
    """Five or six tetrahedra that stretch."""
    return {"name": name, "about": name, "step": 0.0005, "duration": 0.002,
            "body": {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}},
            "material": {"density": 1000, "stiffness": 100},
            "initial_velocity": {"linear": [[1, 0, 0], [0, -1, 0], [0, 0, 0]]}}


def write(path, scene):
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(scene, stream)
    return path


def scenes(run):
    for k, name in enumerate(NAMES):
        file = write(os.path.join(run.folder, f"scene{k}.json"), chain(name))
        page = os.path.join(run.folder, f"page{k}.html")
        run("simulate", file, "--picture", "--player", page, writes=True)
        with open(page, "rb") as stream:
            text = check_text(stream.read().replace(b"\t", b""), page)  # which libraries have
        check(text.count("<script") == PARTS_OF_A_PLAYER, f"{page}: {ascii(name)[:120]} made an element")
    file = write(os.path.join(run.folder, "all.json"), chain(ALL_IN_ONE))
    for verb in (["simulate"], ["explain"], ["explain-dt"]):
        run(*verb, file)
        check(json.loads(run(*verb, file, "--json"))["scene"] == ALL_IN_ONE, f"{verb}: another name in JSON")
    run("scene", "--check", file)
    long = write(os.path.join(run.folder, "long.json"), chain(NAMES[-1]))
    for verb in (["simulate"], ["explain"], ["explain-dt"]):
        check(len(run(*verb, long)) < 20000, f"{verb}: a name of 100,000 letters is printed whole")


def studies(run):
    """tradeoff and recommend name files and pages after the file of a scene, and print its text."""
    folder = os.path.join(run.folder, "`touch canary` $(x) <b> é")
    os.mkdir(folder)
    file = write(os.path.join(folder, "`touch canary`; <b> ..=1 'x'.json"), cube(ALL_IN_ONE))
    quick = ["--quick", "--most", "0.02", "--only", "verlet"]
    run("tradeoff", file, *quick, writes=True)
    run("recommend", file, "--error", "1e-2", statuses=(0, 1))


def file_names(run):
    for name in FILE_NAMES:
        base = os.path.join(os.fsencode(run.folder), name)
        scene, mesh = base + b".json", base + b".mesh"
        with open(scene, "w", encoding="utf-8") as stream:
            json.dump(chain("x"), stream)
        with open(mesh, "w", encoding="ascii") as stream:
            stream.write(TETRAHEDRON)
        run("simulate", scene, "--picture", writes=True)
        run("scene", "--check", scene)
        run("explain", scene)
        run("mesh", "info", mesh)
        json.loads(run("mesh", "info", mesh, "--json"))
    region_names(run)
    run("validate", "topology", mesh, "--operations", "20")
    run("validate", "conservation", mesh, "--operations", "20", statuses=(0, 1, 2, 3))


def region_names(run):
    """Names of regions come from a file, too."""
    mesh = os.path.join(run.folder, "regions.msh")
    for name in NAMES + [ALL_IN_ONE]:
        name = name.replace("\0", "").replace("\n", " ").replace("\r", " ")
        with open(mesh, "wb") as stream:
            stream.write(TETRAHEDRON_OF_GMSH % name.encode("utf-8", "surrogateescape"))
        run("mesh", "info", mesh)
        json.loads(run("mesh", "info", mesh, "--json"))


def errors(run):
    """Refusals are printed without acting on anything."""
    for name in NAMES[:-2] + [ALL_IN_ONE, NAMES[-1]]:
        plain = name.replace("\0", "")
        if len(plain) > 1000:
            plain = plain[:1000]  # for an argument
        run(plain or "x", statuses=(2,))
        run("simulate", plain, statuses=(2, 3))
    name = ALL_IN_ONE.replace("\0", "")
    run("mesh", "info", name, statuses=(2, 3))
    run("simulate", "liver_cut", "--integrator", name, statuses=(2,))
    run("simulate", "liver_cut", "--steps", name, statuses=(2,))
    run("tradeoff", "smooth", "--only", name, statuses=(2,))
    run("list", name, statuses=(2,))
    run("scene", "--check", name, statuses=(2, 3))
    for key, value in [(ALL_IN_ONE, 1), (NAMES[-1], 1), ("integrator", ALL_IN_ONE), ("integrator", NAMES[-1])]:
        scene = chain("x")
        scene[key] = value
        file = write(os.path.join(run.folder, "bad.json"), scene)
        run("scene", "--check", file, statuses=(2,))
    for text in (b'{"name": "\xff\x1b[31m"}', b"\xff\xfe\x00", b'{"name": "x\n"}', b'{"a": \x1b]0;x\x07}'):
        with open(file, "wb") as stream:
            stream.write(text)
        run("simulate", file, statuses=(2,))
    mesh = os.path.join(run.folder, "bad.mesh")
    for line in (b"\x1b[31m`touch canary`", b"\xff" * 20000):
        with open(mesh, "wb") as stream:
            stream.write(b"MeshVersionFormatted 1\nDimension 3\n" + line + b"\n")
        run("mesh", "info", mesh, statuses=(2, 3))


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="dartboard-hostile-") as folder:
        run = Runner(program, folder)
        for part in (scenes, studies, file_names, errors):
            part(run)
        left = [name for _, _, names in os.walk(os.fsencode(folder)) for name in names]
        check(b"canary" not in left, "a file `canary` appeared: something was run")
        print(f"{run.runs} runs with hostile names: nothing ran, everything parses")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"hostile_names.py: {failure}")
