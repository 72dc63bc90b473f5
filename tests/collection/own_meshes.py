"""The meshes that the suite takes through every verb: small ones, each with a feature of meshes that users have."""

import itertools
import math
import os
import shutil

HERE = os.path.dirname(os.path.abspath(__file__))
MEDIT = {"triangle": "Triangles", "quadrilateral": "Quadrilaterals", "tetrahedron": "Tetrahedra", "pyramid": "Pyramids",
         "prism": "Prisms", "hexahedron": "Hexahedra"}


def kuhn_cube(at):
    """Six tetrahedra around a diagonal; `at` numbers the corners (i, j, k)."""
    cells = []
    for order in itertools.permutations(range(3)):
        corner, path = [0, 0, 0], [at(0, 0, 0)]
        for axis in order:
            corner[axis] = 1
            path.append(at(*corner))
        even = order in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        cells.append(("tetrahedron", path if even else [path[0], path[2], path[1], path[3]]))
    return cells


def hexahedron(at):
    return [("hexahedron", [at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                            at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)])]


def box(shape, cube, keep=lambda *place: True):
    """Cubes of a grid, each as the cells that `cube` makes of it."""
    number, cells = {}, []
    for place in itertools.product(*map(range, shape)):
        if keep(*place):
            at = lambda *d: number.setdefault(tuple(p + q for p, q in zip(place, d)), len(number))
            cells += cube(at)
    return [tuple(x / 4 for x in p) for p in number], cells


def grid(columns, rows, place, close=None):
    """Triangles of a sheet; `close` gives the corner that replaces one beyond the last column."""
    number, cells = {}, []
    close = close or (lambda i, j: (i, j))
    at = lambda i, j: number.setdefault(close(i, j), len(number))
    for i, j in itertools.product(range(columns), range(rows)):
        a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
        cells += [("triangle", [a, b, c]), ("triangle", [a, c, d])]
    return [place(*k) for k in number], cells


def band(columns, twisted):
    def place(i, j):
        angle = 2 * math.pi * i / columns
        across, half = (j - 1) / 4, angle / 2 if twisted else 0.0
        r = 1 + across * math.cos(half)
        return (r * math.cos(angle), r * math.sin(angle), across * math.sin(half) if twisted else across)

    return grid(columns, 2, place, lambda i, j: (0, 2 - j if twisted else j) if i == columns else (i, j))


def apart(*bodies):
    """Bodies next to each other in one mesh, with the points of each."""
    points, cells = [], []
    for more, its_cells in bodies:
        first = len(points)
        points += more
        cells += [(kind, [first + n for n in nodes]) for kind, nodes in its_cells]
    return points, cells


def tetrahedra(*cells):
    """Points on the moment curve, where any four are the corners of a tetrahedron."""
    count = 1 + max(map(max, cells))
    return [(t, t * t, t ** 3) for t in (p / count for p in range(count))], [("tetrahedron", list(c)) for c in cells]


def scattered(box_of, part):
    """Some cells of a box, which touch at points and edges more than at faces."""
    points, cells = box_of
    kept = [cells[k * 61 % len(cells)] for k in range(len(cells) // part)]
    return points, kept


CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
MIXED = (CUBE + [(2, 0, 0), (2, 0, 1), (.5, .5, 2), (.5, -1, 2), (.5, -2, 1)],
         [("hexahedron", [0, 1, 2, 3, 4, 5, 6, 7]), ("prism", [1, 8, 2, 5, 9, 6]), ("pyramid", [4, 5, 6, 7, 10]),
          ("tetrahedron", [4, 5, 10, 11]), ("tetrahedron", [4, 5, 11, 12])])
OCTAHEDRON = ([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
              [("triangle", [k, (k + 1) % 4, 4]) for k in range(4)] + [("triangle", [(k + 1) % 4, k, 5]) for k in range(4)])
SHEET = ([(x / 2, y / 2, x * y / 8) for y in range(3) for x in range(3)],
         [("quadrilateral", [0, 1, 4, 3]), ("triangle", [1, 2, 5]), ("triangle", [1, 5, 4]), ("quadrilateral", [3, 4, 7, 6]),
          ("quadrilateral", [4, 5, 8, 7])])

BODIES = {
    "one tetrahedron": tetrahedra((0, 1, 2, 3)),
    "one pyramid": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (.5, .5, 1)], [("pyramid", [0, 1, 2, 3, 4])]),
    "one triangle": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [("triangle", [0, 1, 2])]),
    "tetrahedra that touch at a point": tetrahedra((0, 1, 2, 3), (3, 4, 5, 6)),
    "tetrahedra that touch at an edge": tetrahedra((0, 1, 2, 3), (2, 3, 4, 5)),
    "an edge between chains of cells": tetrahedra((0, 1, 2, 3), (0, 1, 4, 5), (0, 2, 3, 4), (0, 3, 4, 5), (1, 2, 3, 5),
                                                  (1, 2, 4, 5)),
    "cubes that touch at an edge": box((2, 2, 1), hexahedron, lambda x, y, z: x == y),
    "cubes that touch at a point": box((2, 2, 2), hexahedron, lambda x, y, z: x == y == z),
    "triangles that touch at a point": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 1), (0, -1, 0)],
                                        [("triangle", [0, 1, 2]), ("triangle", [0, 3, 4])]),
    "scattered tetrahedra": scattered(box((2, 2, 2), kuhn_cube), 3),
    "cells of all kinds": MIXED,
    "a ring of cubes": box((3, 3, 1), hexahedron, lambda x, y, z: (x, y) != (1, 1)),
    "a hollow": box((3, 3, 3), hexahedron, lambda *place: place != (1, 1, 1)),
    "two bodies": apart(box((1, 1, 1), kuhn_cube), ([(x + 5, y, z) for x, y, z in MIXED[0]], MIXED[1])),
    "a torn body": apart(box((1, 1, 1), kuhn_cube), box((1, 1, 1), kuhn_cube)),
    "inverted cells": (MIXED[0], [(kind, nodes[:1] + nodes[1:][::-1] if kind == "tetrahedron" else nodes)
                                  for kind, nodes in MIXED[1]]),
    "a closed surface": OCTAHEDRON,
    "a sheet of both polygons": SHEET,
    "a band": band(8, False),
    "a band with a twist": band(8, True),
}


def write_medit(path, points, cells):
    with open(path, "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points))
        file.writelines("%r %r %r 0\n" % tuple(map(float, x)) for x in points)
        for kind, keyword in MEDIT.items():
            of_kind = [nodes for k, nodes in cells if k == kind]
            if of_kind:
                file.write("%s\n%d\n" % (keyword, len(of_kind)))
                file.writelines(" ".join(str(n + 1) for n in nodes) + " 0\n" for nodes in of_kind)
        file.write("End\n")


# ---- every format: a box of tetrahedra, a square of triangles

def rows(lists):
    return "".join(" ".join(map(str, row)) + "\n" for row in lists)


def write_volume_formats(folder):
    points, cells = box((2, 1, 1), kuhn_cube)
    nodes = [n for _, n in cells]
    of_one = [[k + 1 for k in n] for n in nodes]
    p, c = len(points), len(cells)
    texts = {
        "box.node": "%d 3 0 0\n" % p + rows([k, *x] for k, x in enumerate(points)),
        "box.ele": "%d 4 0\n" % c + rows([k, *n] for k, n in enumerate(nodes)),
        "box_1.msh": "$NOD\n%d\n" % p + rows([k + 1, *x] for k, x in enumerate(points)) + "$ENDNOD\n$ELM\n%d\n" % c +
                     rows([k + 1, 4, 1, 1, 4, *n] for k, n in enumerate(of_one)) + "$ENDELM\n",
        "box_2.msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % p +
                     rows([k + 1, *x] for k, x in enumerate(points)) + "$EndNodes\n$Elements\n%d\n" % c +
                     rows([k + 1, 4, 0, *n] for k, n in enumerate(of_one)) + "$EndElements\n",
        "box_4.msh": "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 %d 1 %d\n3 1 0 %d\n" % (p, p, p) +
                     rows([k + 1] for k in range(p)) + rows(points) + "$EndNodes\n$Elements\n1 %d 1 %d\n3 1 4 %d\n" %
                     (c, c, c) + rows([k + 1, *n] for k, n in enumerate(of_one)) + "$EndElements\n",
        "box.vtk": "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n" % p +
                   rows(points) + "CELLS %d %d\n" % (c, 5 * c) + rows([4, *n] for n in nodes) + "CELL_TYPES %d\n" % c +
                   rows([[10] * c]),
        "box.vtu": vtu(points, nodes, 10),
    }
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
    write_medit(os.path.join(folder, "box.mesh"), points, cells)


def vtu(points, nodes, kind):
    array = lambda name, values, more="": "<DataArray type='%s' %s format='ascii'>%s</DataArray>" % (
        "Float64" if name == "Points" else "Int64", "Name='%s' %s" % (name, more), " ".join(map(str, values)))
    return ("<VTKFile type='UnstructuredGrid' version='1.0'><UnstructuredGrid><Piece NumberOfPoints='%d' NumberOfCells='%d'>"
            "<Points>%s</Points><Cells>%s%s%s</Cells></Piece></UnstructuredGrid></VTKFile>\n" % (
                len(points), len(nodes), array("Points", itertools.chain(*points), "NumberOfComponents='3'"),
                array("connectivity", itertools.chain(*nodes)), array("offsets", itertools.accumulate(map(len, nodes))),
                array("types", [kind] * len(nodes))))


def write_surface_formats(folder):
    points, cells = grid(3, 2, lambda i, j: (i / 4, j / 4, i * j / 16))
    nodes = [n for _, n in cells]
    p, c = len(points), len(cells)
    facet = lambda n: "facet normal 0 0 1\nouter loop\n%sendloop\nendfacet\n" % rows(["vertex", *points[k]] for k in n)
    texts = {
        "sheet.obj": rows(["v", *x] for x in points) + rows(["f", *(k + 1 for k in n)] for n in nodes),
        "sheet.off": "OFF\n%d %d 0\n" % (p, c) + rows(points) + rows([3, *n] for n in nodes),
        "sheet.ply": "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
                     "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (p, c) + rows(points) +
                     rows([3, *n] for n in nodes),
        "sheet.stl": "solid sheet\n" + "".join(map(facet, nodes)) + "endsolid sheet\n",
        "sheet.vtk": "# vtk DataFile Version 3.0\nsheet\nASCII\nDATASET POLYDATA\nPOINTS %d double\n" % p + rows(points) +
                     "POLYGONS %d %d\n" % (c, 4 * c) + rows([3, *n] for n in nodes),
    }
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)


# ---- meshes that are refused, with a part of the message

def refused():
    points, cells = tetrahedra((0, 1, 2, 3), (0, 1, 2, 4))
    return {
        "three cells at a face": (tetrahedra((0, 1, 2, 3), (0, 1, 2, 4), (0, 1, 2, 5)), "expected at most two volumes"),
        "a cell twice": ((points, cells + cells[:1]), "expected every cell once"),
        "a flat cell": (([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], cells[:1]), "expected a volume that is not zero"),
        "three triangles at an edge": (([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, -1, 0)],
                                        [("triangle", [0, 1, k]) for k in (2, 3, 4)]), "expected at most two polygons"),
        "a point that is not there": ((points[:3], cells[:1]), "has the point 4"),
        "a coordinate that is no number": ((points[:3] + [(float("nan"), 0, 0)], cells[:1]), "not finite"),
    }


def write_all(folder):
    """Write the meshes; returns for each file a part of the reason why it is refused, or nothing."""
    right = {}
    for name, (points, cells) in BODIES.items():
        right[name + ".mesh"] = None
        write_medit(os.path.join(folder, name + ".mesh"), points, cells)
    for name, ((points, cells), reason) in refused().items():
        right[name + ".mesh"] = reason
        write_medit(os.path.join(folder, name + ".mesh"), points, cells)
    write_volume_formats(folder)
    write_surface_formats(folder)
    foreign = os.path.join(HERE, "..", "readback", "foreign")
    for name in ("solid_4.meshb", "surface.off", "raw_lz4.vtu", "polygons_51_binary.vtk", "ghosts_0.vtu"):
        shutil.copy(os.path.join(foreign, name), folder)
    return right
