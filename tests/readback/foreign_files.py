#!/usr/bin/env python3
"""Files of the folder foreign, written by other programs, are read to the same bits as the mesh that these were given.

    foreign_files.py PROGRAM [TEST...]

They are committed: VTK, CGAL and libMeshb need not be there. The folder has the sources that wrote them.
"""

import glob
import os
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import mesh_variants
from mesh_variants import MeshVariants, solid, surface

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "foreign")
SKIPPED = ["skipped 1 edge, 1 point element: the body is made of its 3 polygons"]
KIND = {12: "hexahedron", 14: "pyramid"}


def piece(path):
    """Points, cells with their kinds and material, of a piece in ASCII; cells that are marked as copies are not."""
    root = ElementTree.parse(path).getroot().find(".//Piece")
    array = {a.get("Name"): a.text.split() for part in ("Points", "Cells", "CellData")
             for a in root.find(part).iter("DataArray")}
    xyz = [float(x) for x in array["Points"]]
    points = [tuple(xyz[k:k + 3]) for k in range(0, len(xyz), 3)]
    nodes, ends = [int(n) for n in array["connectivity"]], [0] + [int(n) for n in array["offsets"]]
    copies = [int(n) for n in array.get("vtkGhostType", ["0"] * len(array["types"]))]
    cells = [(KIND[int(kind)], nodes[a:b]) for kind, a, b in zip(array["types"], ends, ends[1:])]
    return points, [cell for cell, copy in zip(cells, copies) if not copy & 1]


def joined(paths):
    """The points of all pieces, equal ones once, in the order of their first; and the cells with these numbers."""
    number, blocks = {}, []
    for path in paths:
        points, cells = piece(path)
        of = [number.setdefault(x, len(number)) for x in points]
        blocks += [(kind, [[of[p] for p in nodes]]) for kind, nodes in cells]
    return list(number), blocks


class ForeignFiles(MeshVariants):
    def read(self, name):
        return self.info(os.path.join(FOLDER, name))

    def test_polygons_that_vtk_wrote(self):
        points, blocks = surface()
        files = sorted(glob.glob(FOLDER + "/*.vtp") + glob.glob(FOLDER + "/*.vtk"))
        self.assertEqual(len(files), 11)
        for path in files:
            with self.subTest(path=os.path.basename(path)):
                said = self.read(path)
                # with strips the quadrilateral is the first of the cells
                right = [blocks[1], blocks[0]] if path.endswith("strips.vtp") else blocks
                self.check(said, points, right, SKIPPED)
                self.assertEqual(self.regions(said), {"material": {v: (1, None) for v in (7, -3, 8)}})
                self.assertEqual(said["format"].endswith(" binary"), path.endswith("_binary.vtk"))

    def test_solids_that_libmeshb_wrote(self):
        points, blocks = solid(1 / 4)
        for version in (1, 2, 3, 4):
            with self.subTest(version=version):
                said = self.read("solid_%d.meshb" % version)
                self.check(said, points, blocks, ["skipped the section Corners: no cells are in it"])
                self.assertEqual(said["format"], "Medit %d binary" % version)
                self.assertEqual(self.regions(said), {"reference": {7: (3, None), -3: (1, None), 8: (1, None)}})

    def test_the_surface_that_cgal_wrote(self):
        said = self.read("surface.off")
        self.check(said, *surface())
        self.assertEqual(said["format"], "OFF binary")

    def test_pieces_that_vtk_wrote_without_and_with_copies(self):
        counts = {"pieces": ["joined 12 points with equal points of other pieces, of 2 pieces"],
                  "ghosts": ["left out 4 ghost cells: copies of cells of other pieces, or hidden ones",
                             "joined 16 points with equal points of other pieces, of 2 pieces"]}
        for name, notices in counts.items():
            with self.subTest(name=name):
                points, blocks = joined(os.path.join(FOLDER, "%s_%d.vtu" % (name, k)) for k in (0, 1))
                said = self.read(name + ".pvtu")
                self.check(said, points, blocks, notices)
                self.assertEqual(said["volumes"], 5)
                self.assertEqual(said["components"], 1)
                self.assertEqual(self.regions(said), {"material": {v: (1, None) for v in (1, 2, 3, 4, 5)}})


def main(program, *tests):
    mesh_variants.PROGRAM = program
    names = tests or ["ForeignFiles." + name for name in vars(ForeignFiles) if name.startswith("test_")]
    done = unittest.main(argv=["foreign_files.py", *names], exit=False)
    return 0 if done.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
