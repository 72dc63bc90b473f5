"""The picture at the top of HACKING.md: which room may include which, from the lists of the rooms' CMakeLists.txt.

    architecture.py build/release/folders.txt            compare, as the ctest does
    architecture.py build/release/folders.txt --write    put the picture of today into HACKING.md

Folders of one room are one box, and an arrow that follows from others is not drawn. Dotted arrows are the ways of a
scene, a cut and a claim, which the lists do not know; each of them has to be a way that includes may go, or its reverse.
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "HACKING.md")
BEGIN, END = "```mermaid\n", "```\n"
PURPOSE = {
    "core/plain": "mesh, material, problem", "core/base": "archives, escapes, limits", "core/places": "sides of borders, nearest points", "core/meshes": "files and generators",
    "core/topology": "darts, orbits, cells", "core/operations": "dissociate, remove, subdivide", "core/forces": "springs, interface of forces",
    "core/elements": "elastic solids, membranes", "core/contact": "obstacles, bodies", "core/mechanics": "embeddings, stress, tearing",
    "core/walks": "the paper's loops", "core/views": "arrays that follow changes", "core/time": "integrators, solvers, stable steps",
    "core/scene": "read, assemble, run, write", "reference": "independent witnesses", "validation": "agreement, orders, errors",
    "benchmarks": "studies, reports, the program",
}
WAYS = [
    ("core/scene", "core/mechanics", "scene: body"), ("core/scene", "core/time", "scene: steps"),
    ("core/operations", "core/mechanics", "cut: TopologyChange"), ("core/mechanics", "core/views", "cut: ChangedEmbeddings"),
    ("core/views", "core/scene", "cut: system anew"), ("validation", "benchmarks", "claim: value, verdict"),
]


def box_of(folder):
    parts = folder.split("/")
    return "/".join(parts[:2]) if parts[0] == "core" else parts[0]


def arrows_of(lines):
    """{box: the boxes that it may include}"""
    sees = {}
    for line in lines:
        folder, _, seen = line.partition(":")
        if folder.strip() in ("", "core"):  # core/dartboard.h includes what programs of others need
            continue
        boxes = sees.setdefault(box_of(folder.strip()), set())
        boxes.update(box_of(other) for other in seen.split() if other != "core")
    for box, seen in sees.items():
        seen.discard(box)
        if box != "core/plain":
            seen.add("core/plain")
        if box not in ("core/plain", "core/base", "reference"):
            seen.add("core/base")
    for box in sorted({other for seen in sees.values() for other in seen} - set(sees)):
        sees[box] = set()
    return sees


def reached(sees, box):
    found, todo = set(), list(sees[box])
    while todo:
        other = todo.pop()
        if other not in found:
            found.add(other)
            todo += sees[other]
    return found


def picture(lines):
    sees = arrows_of(lines)
    far = {box: reached(sees, box) for box in sees}
    circles = sorted(box for box in sees if box in far[box])
    if circles:
        sys.exit("architecture: rooms that include each other: " + ", ".join(circles))
    if set(sees) != set(PURPOSE):
        sys.exit("architecture: PURPOSE has no line, or one too many, for: " + ", ".join(sorted(set(sees) ^ set(PURPOSE))))
    for start, end, way in WAYS:
        if end not in far[start] and start not in far[end]:
            sys.exit("architecture: '%s' goes from %s to %s, which do not know each other" % (way, start, end))
    name = lambda box: box.replace("/", "_")
    text = ["flowchart BT"]
    text += ['  %s["%s<br/><small>%s</small>"]' % (name(box), box, PURPOSE[box]) for box in sorted(sees)]
    for box in sorted(sees):
        near = [other for other in sees[box] if not any(other in far[between] for between in sees[box])]
        text += ["  %s --> %s" % (name(box), name(other)) for other in sorted(near)]
    text += ['  %s -. "%s" .-> %s' % (name(start), way, name(end)) for start, end, way in WAYS]
    return "\n".join(text) + "\n"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        should = picture(file.read().splitlines())
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    begin = page.index(BEGIN) + len(BEGIN)
    end = page.index(END, begin)
    if page[begin:end] == should:
        return 0
    if "--write" in sys.argv[2:]:
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(page[:begin] + should + page[end:])
        return 0
    print("HACKING.md: its picture is not that of the rooms' CMakeLists.txt; expected")
    print(should)
    print("python3 tests/readme/architecture.py %s --write puts it there." % sys.argv[1])
    return 1


if __name__ == "__main__":
    sys.exit(main())
