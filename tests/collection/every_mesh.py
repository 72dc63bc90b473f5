#!/usr/bin/env python3
"""Take every mesh of a collection through `mesh info`, `simulate`, `validate topology` and `validate conservation`.

    every_mesh.py PROGRAM               the meshes of own_meshes.py, with a known outcome for each; and all
                                        in the folders that DARTBOARD_MESHES names, as PATH names its own
    every_mesh.py PROGRAM FOLDER...     all the meshes in these folders

Every verb has to agree, or give a reason in words why it cannot; all must report the same bodies. Meshes with the
same bits are validated once. Prints a table of meshes, verbs, outcomes and seconds. Ends with 1 when an outcome is wrong.

Standard library only.
"""

import concurrent.futures
import json
import math
import os
import subprocess
import sys
import tempfile
import threading
import time

import own_meshes

STEPS = 10
LONGEST = 300  # seconds for one verb; a user's mesh may be large


class Refused(Exception):
    """A reason in words."""


class Wrong(Exception):
    """A disagreement, or neither of the two."""


def run(program, folder, arguments):
    """The JSON that the program prints."""
    try:
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=LONGEST,
                              stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        raise Wrong("not finished after %d s" % LONGEST) from None
    said = done.stderr.strip().splitlines() or ["nothing"]
    if done.returncode in (2, 3) and "expected" in said[-1]:
        raise Refused(said[-1])
    if done.returncode != 0:
        raise Wrong("ends with %d and says: %s" % (done.returncode, said[-1]))
    return json.loads(done.stdout)


def info(program, folder, path):
    said = run(program, folder, ["mesh", "info", "--json", path])
    if not said["valid"]:
        raise Wrong("a map that is not valid: " + said["violation"])
    return said


def all_finite(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return all(map(all_finite, value))
    return not isinstance(value, float) or math.isfinite(value)


def simulate(program, folder, path, facts):
    """A few steps of springs under gravity; a vertex weighs 1 kg in the mean."""
    scene = {"name": "a few steps", "body": {"mesh": path}, "step": 1e-4, "duration": 1,
             "material": {"density": facts["vertices"] / facts["volume" if facts["dimension"] == 3 else "area"],
                          "stiffness": 50}}
    with open(os.path.join(folder, "scene.json"), "w") as file:
        json.dump(scene, file)
    said = run(program, folder, ["simulate", "scene.json", "--steps", str(STEPS), "--json"])
    if said["steps"] != STEPS or not all_finite(said):
        raise Wrong("%s steps, with numbers that are not finite" % said["steps"])
    cells = "volumes" if facts["dimension"] == 3 else "faces"
    for count, of_info in (("vertices", "vertices"), ("edges", "edges"), ("cells", cells), ("components", "components")):
        if said["first"][count] != facts[of_info]:
            raise Wrong("%s %s, and %s by mesh info" % (said["first"][count], count, facts[of_info]))


class Collection:
    def __init__(self, program, operations=None):
        self.program = program
        self.how = ["--quick", "--json"] + (["--operations", str(operations)] if operations else [])
        self.lock = threading.Lock()
        self.by_hash = {}

    def verbs_of(self, path):
        """(verb, outcome, seconds, "agrees", "refused" or "wrong") of each; a mesh that cannot be read has one."""
        facts, rows = {}, []

        def first_of_hash():
            with self.lock:
                return self.by_hash.setdefault(facts["hash"], path) == path

        def validate(verb):
            if not first_of_hash():
                return "same bits as " + os.path.basename(self.by_hash[facts["hash"]])
            run(self.program, folder, ["validate", verb, path, *self.how])
            return "agrees"

        def read():
            facts.update(info(self.program, folder, path))
            return "agrees"

        def move():
            simulate(self.program, folder, path, facts)
            return "agrees"

        with tempfile.TemporaryDirectory(prefix="dartboard-mesh-") as folder:
            for verb, action in (("mesh info", read), ("simulate", move), ("topology", lambda: validate("topology")),
                                 ("conservation", lambda: validate("conservation"))):
                start = time.monotonic()
                try:
                    outcome, kind = action(), "agrees"
                except Refused as reason:
                    outcome, kind = str(reason), "refused"
                except (Wrong, OSError, ValueError, KeyError) as reason:
                    outcome, kind = str(reason) or repr(reason), "wrong"
                rows.append((verb, outcome, time.monotonic() - start, kind))
                if verb == "mesh info" and kind != "agrees":
                    break
        return rows


def meshes_in(folder, extensions):
    """A .ele file is read with its .node file."""
    paths = [os.path.join(where, name) for where, _, names in os.walk(folder) for name in names]
    known = [p for p in paths if os.path.splitext(p)[1].lower() in extensions and not p.lower().endswith(".ele")]
    return sorted(map(os.path.abspath, known))


def known_extensions(program):
    said = subprocess.run([program, "mesh", "--formats", "--json"], capture_output=True, text=True, check=True).stdout
    return {extension for known in json.loads(said) for extension in known["extensions"]}


def print_table(collection, paths, is_right):
    """Prints a line for each verb; returns how many outcomes are wrong."""
    wrong = 0
    width = max((len(os.path.basename(p)) for p in paths), default=0)
    with concurrent.futures.ThreadPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        for path, rows in zip(paths, pool.map(collection.verbs_of, paths)):
            name = os.path.basename(path)
            for verb, outcome, seconds, kind in rows:
                right = is_right(name, outcome, kind)
                wrong += not right
                print("%-*s  %-12s  %6.2f s  %s%s" % (width, name, verb, seconds, "" if right else "WRONG: ", outcome),
                      flush=True)
    print("%d meshes, %d outcomes that are wrong" % (len(paths), wrong))
    return wrong


def own(program, extensions):
    with tempfile.TemporaryDirectory(prefix="dartboard-collection-") as folder:
        reasons = own_meshes.write_all(folder)
        paths = meshes_in(folder, extensions)
        missing = extensions - {".ele"} - {os.path.splitext(p)[1] for p in paths}
        if missing:
            print("no mesh of", sorted(missing))

        def is_right(name, outcome, kind):
            part = reasons.get(name)
            return kind == "agrees" if part is None else kind == "refused" and part in outcome

        return print_table(Collection(program, operations=10), paths, is_right) + len(missing)


def of_folder(program, extensions, folder):
    paths = meshes_in(folder, extensions)
    if not paths:
        print("no mesh in", folder)
    return print_table(Collection(program), paths, lambda name, outcome, kind: kind != "wrong") + (not paths)


def main(program, *folders):
    program = os.path.abspath(program)
    extensions = known_extensions(program)
    wrong = 0
    if not folders:
        wrong += own(program, extensions)
        folders = [f for f in os.environ.get("DARTBOARD_MESHES", "").split(os.pathsep) if f]
    wrong += sum(of_folder(program, extensions, folder) for folder in folders)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
