#!/usr/bin/env python3
"""Write the files of this folder that VTK writes: a surface, and a solid in two pieces.

    write_with_vtk.py FOLDER        needs the module vtk; those that are committed are of VTK 9.3.1
"""

import os
import sys

import vtk

# the surface() of mesh_variants.py
POINTS = [(0, 0, 0), (.25, 0, .0625), (.25, .25, 0), (0, .25, 0), (.5, 0, 0), (.5, .25, .125)]
POLYGONS = [(0, 1, 2), (0, 2, 3), (1, 4, 5, 2)]
MATERIAL = [7, -3, 8]


def points_of(xyz):
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for x in xyz:
        points.InsertNextPoint(x)
    return points


def numbers(name, values):
    array = vtk.vtkIntArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array


def cells_of(lists):
    cells = vtk.vtkCellArray()
    for points in lists:
        cells.InsertNextCell(len(points))
        for p in points:
            cells.InsertCellPoint(p)
    return cells


def surface(strip=False):
    """With a vertex and a line that are part of no body; as a strip the two triangles are one cell."""
    data = vtk.vtkPolyData()
    data.SetPoints(points_of(POINTS))
    data.SetVerts(cells_of([(3,)]))
    data.SetLines(cells_of([(0, 1, 4)]))
    if strip:
        data.SetStrips(cells_of([(0, 1, 2), (0, 2, 3)]))
        data.SetPolys(cells_of(POLYGONS[2:]))
    else:
        data.SetPolys(cells_of(POLYGONS))
    data.GetCellData().AddArray(numbers("material", [1, 2] + (MATERIAL[2:] + MATERIAL[:2] if strip else MATERIAL)))
    return data


def grid_of(surface):
    """The same cells and numbers as an unstructured grid."""
    grid = vtk.vtkAppendFilter()
    grid.SetInputData(surface)
    grid.Update()
    return grid.GetOutput()


def solid():
    """Three cubes in a row, with pyramids on two faces of the last."""
    xyz = [(x / 4, y / 4, z / 4) for x in range(4) for y in range(2) for z in range(2)]
    grid = vtk.vtkUnstructuredGrid()
    for x in range(3):
        at = 4 * x
        cube = (at, at + 4, at + 6, at + 2, at + 1, at + 5, at + 7, at + 3)
        grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, cube)
    xyz += [(1, .125, .125), (.625, .125, .5)]
    grid.InsertNextCell(vtk.VTK_PYRAMID, 5, (12, 14, 15, 13, 16))
    grid.InsertNextCell(vtk.VTK_PYRAMID, 5, (9, 13, 15, 11, 17))
    grid.SetPoints(points_of(xyz))
    grid.GetCellData().AddArray(numbers("material", [1, 2, 3, 4, 5]))
    return grid


def write_xml(path, writer, data, mode, compressor, wide=False, big=False):
    writer.SetInputData(data)
    writer.SetFileName(path)
    getattr(writer, "SetDataModeTo" + mode)()
    if mode == "Appended":
        writer.SetEncodeAppendedData(0)
    getattr(writer, "SetCompressorTypeTo" + compressor)()
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
    assert writer.Write()


def main(folder):
    at = lambda name: os.path.join(folder, name)
    for name, mode, compressor, wide, big in (("ascii", "Ascii", "None", False, False),
                                              ("base64", "Binary", "None", True, False),
                                              ("base64_zlib", "Binary", "ZLib", False, True),
                                              ("raw", "Appended", "None", True, True),
                                              ("raw_lz4", "Appended", "LZ4", False, False)):
        write_xml(at(name + ".vtu"), vtk.vtkXMLUnstructuredGridWriter(), grid_of(surface()), mode, compressor, wide, big)
    write_xml(at("strips.vtu"), vtk.vtkXMLUnstructuredGridWriter(), grid_of(surface(strip=True)), "Ascii", "None")
    for version in (42, 51):
        for mode in ("ASCII", "Binary"):
            writer = vtk.vtkPolyDataWriter()
            writer.SetInputData(surface())
            writer.SetFileVersion(version)
            writer.SetFileName(at("polygons_%d_%s.vtk" % (version, mode.lower())))
            getattr(writer, "SetFileTypeTo" + mode)()
            assert writer.Write()
    for name, ghosts in (("pieces", 0), ("ghosts", 1)):
        pieces = vtk.vtkExtractUnstructuredGridPiece()
        pieces.SetInputData(solid())
        pieces.SetCreateGhostCells(ghosts)
        for k in (0, 1):
            pieces.UpdatePiece(k, 2, ghosts)
            write_xml(at("%s_%d.vtu" % (name, k)), vtk.vtkXMLUnstructuredGridWriter(), pieces.GetOutput(), "Ascii", "None")


if __name__ == "__main__":
    main(*sys.argv[1:])
