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


class ForeignFiles(MeshVariants):
    def read(self, name):
        return self.info(os.path.join(FOLDER, name))

    def test_polygons_that_vtk_wrote(self):
        points, blocks = surface()
        files = sorted(set(glob.glob(FOLDER + "/*.vt[uk]")) - set(glob.glob(FOLDER + "/*_[01].vtu")))
        self.assertEqual(len(files), 10)
        for path in files:
            with self.subTest(path=os.path.basename(path)):
                said = self.read(path)
                # with strips the quadrilateral is the first of the cells
                right = [blocks[1], blocks[0]] if path.endswith("strips.vtu") else blocks
                self.check(said, points, right, SKIPPED)
                self.assertEqual(self.regions(said), {"material": {v: (1, None) for v in (7, -3, 8)}})
                self.assertEqual(said["format"].endswith(" binary"), path.endswith("_binary.vtk"))

    def test_solids_that_libmeshb_wrote(self):
        points, blocks = solid(1 / 4)
        for version in (1, 2, 3, 4):
            with self.subTest(version=version):
                said = self.read("solid_%d.meshb" % version)
                self.check(said, points, blocks, ["skipped the section of code 13: only points and cells are read"])
                self.assertEqual(said["format"], "Medit %d binary" % version)
                self.assertEqual(self.regions(said), {"reference": {7: (3, None), -3: (1, None), 8: (1, None)}})

    def test_the_surface_that_cgal_wrote(self):
        said = self.read("surface.off")
        self.check(said, *surface())
        self.assertEqual(said["format"], "OFF binary")

    def test_pieces_that_vtk_wrote_without_and_with_copies(self):
        left_out = "left out 2 ghost cells: copies of cells of other pieces, or hidden ones"
        for name, notices in {"pieces_0": [], "pieces_1": [], "ghosts_0": [left_out], "ghosts_1": [left_out]}.items():
            with self.subTest(name=name):
                points, cells = piece(os.path.join(FOLDER, name + ".vtu"))
                used = sorted({p for _, nodes in cells for p in nodes})
                if unused := len(points) - len(used):
                    notices = notices + ["dropped %d point%s to no cell" % (unused, " that belongs" if unused == 1 else "s that belong")]
                said = self.read(name + ".vtu")
                said["notices"] = [notice for notice in said["notices"] if not notice.startswith("cells touch")]
                self.check(said, [points[p] for p in used],
                           [(kind, [[used.index(p) for p in nodes]]) for kind, nodes in cells], notices)

    def test_parts_of_a_mesh_that_gmsh_partitioned(self):
        for name in ("40", "41", "41_binary"):
            with self.subTest(name=name):
                said = self.read("partitioned_%s.msh" % name)
                self.assertEqual(said["volumes"], 66)
                self.assertEqual(self.regions(said), {"physical group": {10: (24, "low"), 20: (42, "high")},
                                                      "entity": {1: (24, None), 2: (42, None)}})


def main(program, *tests):
    mesh_variants.PROGRAM = program
    names = tests or ["ForeignFiles." + name for name in vars(ForeignFiles) if name.startswith("test_")]
    done = unittest.main(argv=["foreign_files.py", *names], exit=False)
    return 0 if done.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
