"""The bodies of the read-back scenes: points and cells made here, and written with meshio for the program to read.

Every body is skewed and has other sizes along x, y and z, so that no two axes, points or cells can be mistaken for each
other. Cells are (kind, points), kinds and their order of points as meshio has them.
"""

import math

import meshio
import numpy as np

# The faces of each kind of volume, each seen counter-clockwise from outside, in the order of points of meshio; a polygon is its own
# face.
FACES = {
    "tetra": [(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "hexahedron": [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)],
    "triangle": [(0, 1, 2)],
    "quad": [(0, 1, 2, 3)],
    "line": [],
}
# VTK documents the wedge mirrored ("a triangle whose normal points outward", vtkWedge), all others alike. By its number:
FACES_OF_VTK = {
    10: FACES["tetra"], 12: FACES["hexahedron"], 14: FACES["pyramid"],
    13: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
}
DIMENSION = {"tetra": 3, "pyramid": 3, "wedge": 3, "hexahedron": 3, "triangle": 2, "quad": 2, "line": 1}


class Body:
    """A mesh at rest: points (n x 3) and cells."""

    def __init__(self, points, cells):
        self.points = np.array(points, dtype=float)
        self.cells = [(kind, tuple(nodes)) for kind, nodes in cells]
        self.dimension = DIMENSION[self.cells[0][0]]

    def write(self, path):
        """In the format of the path's ending, cells in their order."""
        blocks = []
        for kind, nodes in self.cells:
            if not blocks or blocks[-1][0] != kind:
                blocks.append((kind, []))
            blocks[-1][1].append(nodes)
        mesh = meshio.Mesh(self.points, [(kind, np.array(nodes)) for kind, nodes in blocks])
        meshio.write(path, mesh, **({"compression": None} if path.endswith(".vtu") else {}))


def fan_measure(points, nodes_of_faces):
    """Volume between faces that look outwards (divergence theorem), by fans of triangles from the corners of each: where
    a face is not plane, that is the mean of all of them."""
    origin = points[nodes_of_faces[0][0]]
    six = [np.linalg.det([points[f[0]] - origin, points[f[k]] - origin, points[f[k + 1]] - origin]) / len(face)
           for face in nodes_of_faces for turn in range(len(face))
           for f in [list(face[turn:]) + list(face[:turn])] for k in range(1, len(f) - 1)]
    return math.fsum(six) / 6


def polygon_vector(points, nodes):
    """The vector area of a polygon: its size is the area if it is plane, and it does not depend on the first corner
    if it is not."""
    return sum(np.cross(points[nodes[k]] - points[nodes[0]], points[nodes[k + 1]] - points[nodes[0]])
               for k in range(1, len(nodes) - 1)) / 2


def measure(kind, points):
    """Volume (negative if inside out), area or length of one cell whose points are given in its order."""
    if DIMENSION[kind] == 3:
        return fan_measure(points, FACES[kind])
    if DIMENSION[kind] == 2:
        return float(np.linalg.norm(polygon_vector(points, range(len(points)))))
    return float(np.linalg.norm(points[1] - points[0]))


def skewed(points):
    return [np.array(p) @ np.array([[1.0, 0.10, 0.05], [0.15, 1.0, -0.1], [-0.05, 0.2, 1.0]]) for p in points]


def solid():
    """3 x 2 x 1 bricks of six tetrahedra each, no corner where a lattice would have it, and one more on top."""
    def number(i, j, k):
        return (k * 3 + j) * 4 + i

    points = []
    for k in range(2):
        for j in range(3):
            for i in range(4):
                n = number(i, j, k)
                shift = [0.012 * math.sin(1 + 5 * n), 0.012 * math.cos(2 + 3 * n), 0.012 * math.sin(3 + 7 * n)]
                points.append([0.12 * i + shift[0], 0.14 * j + shift[1], 0.17 * k + shift[2]])
    cells = []
    for j in range(2):
        for i in range(3):
            # one tetrahedron for each path along three edges from the lowest corner of the brick to its highest
            for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
                at, path = [i, j, 0], [number(i, j, 0)]
                for axis in order:
                    at[axis] += 1
                    path.append(number(*at))
                cells.append(("tetra", path))
    # on a triangle of the top
    points.append([0.33, 0.1, 0.29])
    top = [number(3, 0, 1), number(2, 0, 1), number(3, 1, 1)]
    cells.append(("tetra", top + [len(points) - 1]))
    points = np.array(skewed(points))
    right_handed = [(k, c if measure(k, points[list(c)]) > 0 else c[:2] + [c[3], c[2]]) for k, c in cells]
    return Body(points, right_handed)


def contact():
    return solid()


def mixed():
    """Two hexahedra next to each other, a pyramid on the first, a wedge on the second and a tetrahedron on the wedge."""
    points = [[0.2 * i, 0.25 * j, 0.3 * k] for k in range(2) for j in range(2) for i in range(3)]
    points += [[0.1, 0.12, 0.5], [0.57, 0.0, 0.0], [0.57, 0.25, 0.0], [0.47, -0.2, 0.1]]
    cells = [("hexahedron", [0, 1, 4, 3, 6, 7, 10, 9]), ("hexahedron", [1, 2, 5, 4, 7, 8, 11, 10]),
             ("pyramid", [6, 7, 10, 9, 12]), ("wedge", [2, 13, 8, 5, 14, 11]), ("tetra", [2, 13, 8, 15])]
    points = np.array(skewed(points))
    return Body(points, [(k, c if measure(k, points[c]) > 0 else turned(k, c)) for k, c in cells])


def turned(kind, nodes):
    """The same volume listed the other way round."""
    if kind == "tetra":
        return nodes[:2] + [nodes[3], nodes[2]]
    if kind == "wedge":
        return nodes[3:] + nodes[:3]
    raise ValueError(kind)


def surface():
    """4 x 3 plane quadrilaterals along folds that run in y, three of them as two triangles each."""
    def number(i, j):
        return j * 5 + i

    points = skewed([[0.11 * i + 0.01 * (i % 3), 0.13 * j + 0.01 * (j % 2), 0.05 * (i * i % 5)]
                     for j in range(4) for i in range(5)])
    cells = []
    for j in range(3):
        for i in range(4):
            around = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
            if (i, j) in ((0, 1), (2, 0), (3, 2)):
                cells += [("triangle", around[:3]), ("triangle", [around[0]] + around[2:])]
            else:
                cells.append(("quad", around))
    return Body(points, cells)


def chain(links, spacing, scale, translate):
    """The part of a scene that describes a chain: points along x."""
    points = [[spacing * k * scale, 0, 0] + np.array(translate) for k in range(links + 1)]
    return Body([[p[0], p[1], p[2]] for p in points], [("line", (k, k + 1)) for k in range(links)])
