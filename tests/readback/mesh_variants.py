#!/usr/bin/env python3
"""Meshes in every variant that meshio writes read to the same bits, and their regions with them.

    mesh_variants.py PROGRAM [TEST...]

The expected mesh is the one that was given to meshio: its points, cells and numbers, folded into the hash of `mesh info`
here. A text format has 16 digits or more; STL has 32 bits, enough for the points of its mesh.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import meshio
import numpy as np

from results import fnv1a

PROGRAM = None  # set by main
KINDS = {"triangle": 0, "quad": 1, "tetra": 2, "pyramid": 3, "wedge": 4, "hexahedron": 5}
CORNERS = {"triangle": 3, "quad": 4, "tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}


def words(array):
    data = array.tobytes()
    return np.frombuffer(data + b"\0" * (-len(data) % 8), "<u8")


def hash_of(points, blocks):
    """As core/topology/storage/hash.h has it: points, kinds of cells, nodes of cells."""
    kinds = np.concatenate([np.full(len(cells), KINDS[kind], "u1") for kind, cells in blocks])
    nodes = np.concatenate([np.asarray(cells, "<u4").ravel() for _, cells in blocks])
    columns = [words(np.ascontiguousarray(points, "<f8")), words(kinds), words(nodes)]
    return "%016x" % fnv1a((int(w) for w in np.concatenate(columns)), lambda value: value ^ value >> 32)


def solid(step=1 / 3):
    """A cube, a wedge next to it, a pyramid and two tetrahedra on top: right-handed."""
    x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1],
                  [2, 0, 0], [2, 0, 1], [.5, .5, 2], [.5, -1, 2], [.5, -2, 1]], float)
    points = x * step + np.array([0.125, -0.5, 1e3])
    blocks = [("hexahedron", [[0, 1, 2, 3, 4, 5, 6, 7]]), ("wedge", [[1, 8, 2, 5, 9, 6]]),
              ("pyramid", [[4, 5, 6, 7, 10]]), ("tetra", [[4, 5, 10, 11], [4, 5, 11, 12]])]
    return points, blocks


def surface():
    """Two triangles and a quadrilateral in space; the points are numbers of 32 bits."""
    points = np.array([[0, 0, 0], [1, 0, .25], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, .5]], "f4").astype(float) / 4
    return points, [("triangle", [[0, 1, 2], [0, 2, 3]]), ("quad", [[1, 4, 5, 2]])]


def by_entities(points, blocks, groups=None):
    """The data that meshio needs for version 4.1: each block is a volume, which contains some of the points."""
    cells = {"gmsh:geometrical": [np.full(len(c), k + 1) for k, (_, c) in enumerate(blocks)],
             "gmsh:physical": groups or [np.zeros(len(c), int) for _, c in blocks]}
    volumes = [[3, 1 + k * len(blocks) // len(points)] for k in range(len(points))]
    return {"point_data": {"gmsh:dim_tags": np.array(volumes)}, "cell_data": cells}


class MeshVariants(unittest.TestCase):
    def info(self, path):
        done = subprocess.run([PROGRAM, "mesh", "info", "--json", path], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def written(self, extension, points, blocks, write=None, **options):
        """The program's report on a mesh that was written."""
        with tempfile.TemporaryDirectory(prefix="dartboard-variants-") as folder:
            path = os.path.join(folder, "mesh" + extension)
            mesh = meshio.Mesh(points, [(kind, np.array(cells)) for kind, cells in blocks],
                               **{data: options.pop(data) for data in ("point_data", "cell_data", "field_data")
                                  if data in options})
            (write or meshio.write)(path, mesh, **options)
            return self.info(path)

    def check(self, said, points, blocks, notices=()):
        self.assertEqual(said["points"], len(points))
        self.assertEqual(said["notices"], list(notices))
        self.assertEqual(said["hash"], hash_of(points, blocks))

    # ---- volumes

    def test_vtu_in_every_encoding_and_compression(self):
        for binary in (False, True):
            points, blocks = solid(1 / 3 if binary else 1 / 4)  # meshio writes 12 digits
            for compression in ((None, "zlib") if binary else (None,)):
                for header in ("UInt32", "UInt64"):
                    with self.subTest(binary=binary, compression=compression, header=header):
                        said = self.written(".vtu", points, blocks, meshio.vtu.write, binary=binary,
                                            compression=compression, header_type=header)
                        self.check(said, points, blocks)

    def test_legacy_vtk_of_both_layouts(self):
        points, blocks = solid()
        for version in ("4.2", "5.1"):
            for binary in (False, True):
                with self.subTest(version=version, binary=binary):
                    said = self.written(".vtk", points, blocks, meshio.vtk.write, fmt_version=version, binary=binary)
                    self.check(said, points, blocks)
                    self.assertEqual(said["format"].endswith(" binary"), binary)

    def test_gmsh_of_every_version(self):
        points, blocks = solid()
        for version in ("2.2", "4.0", "4.1"):
            for binary in (False, True):
                with self.subTest(version=version, binary=binary):
                    said = self.written(".msh", points, blocks, meshio.gmsh.write, fmt_version=version, binary=binary,
                                        **(by_entities(points, blocks) if version == "4.1" else {}))
                    self.check(said, points, blocks)
                    self.assertEqual(said["format"].split()[2], version)
                    self.assertEqual(said["format"].endswith(" binary"), binary)

    def test_medit(self):
        points, blocks = solid()
        self.check(self.written(".mesh", points, blocks), points, blocks)
        for integer, version in (("i4", 3), ("i8", 4)):
            with self.subTest(version=version):
                said = self.written(".meshb", points, [(kind, np.array(cells, integer)) for kind, cells in blocks])
                self.check(said, points, blocks)
                self.assertEqual(said["format"], "Medit %d binary" % version)

    # ---- surfaces

    def test_surfaces_of_ply_obj_and_off(self):
        points, blocks = surface()
        for binary in (False, True):
            with self.subTest(binary=binary):
                self.check(self.written(".ply", points, blocks, meshio.ply.write, binary=binary), points, blocks)
        self.check(self.written(".obj", points, blocks), points, blocks)
        self.check(self.written(".off", points, blocks[:1]), points[:4], blocks[:1],
                   ["dropped 2 points that belong to no cell"])

    def test_stl_whose_corners_are_points_again(self):
        points, blocks = surface()
        for binary in (False, True):
            with self.subTest(binary=binary):
                said = self.written(".stl", points[:4], blocks[:1], meshio.stl.write, binary=binary)
                self.check(said, points[:4], blocks[:1])
                self.assertEqual(said["boundary_edges"], 4)

    # ---- cells of second order

    def test_cells_of_second_order_by_their_corners(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
        points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])
        for extension, write in ((".vtu", None), (".vtk", None), (".msh", meshio.gmsh.write)):
            with self.subTest(extension=extension):
                said = self.written(extension, points, [("tetra10", [list(range(10))])], write)
                self.check(said, corners, [("tetra", [[0, 1, 2, 3]])],
                           ["took 1 10-node tetrahedron by their corners: edges of a body are straight",
                            "dropped 6 points that belong to no cell"])

    # ---- regions

    def regions(self, said):
        return {r["name"]: {v["value"]: (v["cells"], v.get("name")) for v in r["values"]} for r in said["regions"]}

    def test_numbers_of_cells(self):
        points, blocks = solid()
        material = [np.array([7], "i4"), np.array([-3], "i4"), np.array([7], "i4"), np.array([7, 8], "i4")]
        right = {7: (3, None), -3: (1, None), 8: (1, None)}
        for extension, options in ((".vtu", {}), (".vtk", {"binary": True}), (".vtk", {"binary": False})):
            with self.subTest(extension=extension, **options):
                said = self.written(extension, points, blocks, cell_data={"material": material}, **options)
                self.assertEqual(self.regions(said), {"material": right})
        said = self.written(".mesh", points, blocks, cell_data={"medit:ref": material})
        self.assertEqual(self.regions(said), {"reference": right})

    def test_physical_groups_and_their_names(self):
        points, blocks = solid()
        group = [np.array([1]), np.array([1]), np.array([2]), np.array([2, 2])]
        names = {"steel": np.array([1, 3]), "soft rubber": np.array([2, 3]), "skin": np.array([1, 2])}
        for version in ("2.2", "4.1"):
            for binary in (False, True):
                with self.subTest(version=version, binary=binary):
                    said = self.written(".msh", points, blocks, meshio.gmsh.write, fmt_version=version, binary=binary,
                                        field_data=names, **by_entities(points, blocks, group))
                    self.assertEqual(self.regions(said), {
                        "physical group": {1: (2, "steel"), 2: (3, "soft rubber")},
                        "entity": {1: (1, None), 2: (1, None), 3: (1, None), 4: (2, None)}})


def main(program, *tests):
    global PROGRAM
    PROGRAM = program
    return 0 if unittest.main(argv=["mesh_variants.py", *tests], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
