"""Output of a run of `dartboard simulate`, read by other software: meshio, xml.etree, csv and json."""

import base64
import csv
import json
import os
import subprocess
import xml.etree.ElementTree as ElementTree
import zlib

import meshio
import numpy as np


STRESSES = ("largest_principal_stress", "largest_stress_magnitude", "von_mises_stress")


class Frame:
    """One .vtu file: vertices x, v, mass; cells with mesh_cell and component; time; the springs, which are lines without a
    number in the mesh; and the fields that the scene requested, None if absent."""

    def __init__(self, path):
        mesh = meshio.read(path)
        self.x, self.v, self.mass = mesh.points, mesh.point_data["velocity"], mesh.point_data["mass"].ravel()
        if self.v.shape != self.x.shape:
            self.v = self.v.reshape(self.x.shape)
        listed = [(block.type, tuple(int(v) for v in nodes)) for block in mesh.cells for nodes in block.data]
        joined = lambda name: [n for block in mesh.cell_data[name] for n in np.ravel(block)]
        number, label = ([int(n) for n in joined(name)] for name in ("mesh_cell", "component"))
        strain = joined("strain") if "strain" in mesh.cell_data else [None] * len(listed)
        cells = [c for c in range(len(listed)) if number[c] != -1]
        lines = [c for c in range(len(listed)) if number[c] == -1]
        self.cells, self.mesh_cell, self.component, self.strain_of_cells = (
            [column[c] for c in cells] for column in (listed, number, label, strain))
        self.springs, self.strain = ([column[c] for c in lines] for column in (listed, strain))
        self.labels_of_springs = {label[c] for c in lines}
        self.tension = joined("tension") if "tension" in mesh.cell_data else None
        for name in ("held", "displacement", "contact_force", "contact_depth", *STRESSES):
            setattr(self, name, mesh.point_data.get(name))
        self.point_names, self.cell_names = set(mesh.point_data), set(mesh.cell_data)
        self.fields = mesh.field_data
        (self.time,) = (float(t) for t in mesh.field_data["TimeValue"].ravel())


class Run:
    """Runs the program on a scene in `folder`; everything that it wrote and printed."""

    def __init__(self, program, scene, folder, *options):
        self.folder = folder
        done = subprocess.run([program, "simulate", scene, "--json", "--out", folder, *options],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        self.status, self.errors = done.returncode, done.stderr
        if self.status not in (0, 1):
            raise RuntimeError("dartboard simulate ends with %d: %s" % (self.status, self.errors))
        self.printed = json.loads(done.stdout)
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        self.listed = [(float(entry.get("timestep")), entry.get("file")) for entry in
                       ElementTree.parse(os.path.join(folder, "frames.pvd")).getroot().iter("DataSet")]
        self.frames = [Frame(os.path.join(folder, name)) for _, name in self.listed]
        self.diagnostics = table(os.path.join(folder, "diagnostics.csv"))
        probes = os.path.join(folder, "probes.csv")
        self.probes = table(probes) if os.path.exists(probes) else []


def table(path):
    """A list of rows, each {head of the column: text}."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    for row in rows:
        if len(row) != len(rows[0]):
            raise RuntimeError("%s: a row of %d fields under %d heads" % (path, len(row), len(rows[0])))
    if len(set(rows[0])) != len(rows[0]):
        raise RuntimeError("%s: two columns have one head" % path)
    return [dict(zip(rows[0], row)) for row in rows[1:]]


def decoded(path, name):
    """An array of a .vtu file by its name, decoded by hand: meshio interprets a file, this reads its content."""
    root = ElementTree.parse(path).getroot()
    for array in root.iter("DataArray"):
        if array.get("Name") == name:
            if root.get("compressor"):
                assert root.get("compressor") == "vtkZLibDataCompressor"
                return array, inflated(array.text)
            data = base64.b64decode(array.text)
            assert len(data) == 8 + int.from_bytes(data[:8], "little")
            return array, data[8:]
    raise KeyError(name)


def inflated(text):
    """The number of blocks, their size, that of the last one, and how long each is; then the blocks, in base64 of their own."""
    count = int.from_bytes(base64.b64decode(text[:12])[:8], "little")
    head = (8 * (3 + count) + 2) // 3 * 4
    _, size, last, *lengths = np.frombuffer(base64.b64decode(text[:head]), "<u8")
    blocks, data = base64.b64decode(text[head:]), b""
    for length in lengths:
        data += zlib.decompress(blocks[:length])
        blocks = blocks[length:]
    assert not blocks and len(lengths) == count and len(data) % size == last
    return data


def fnv1a(words, fold):
    """FNV-1a of 64 bits over numbers; what `fold` does to the value after each is an addition of the program's own."""
    value = 0xcbf29ce484222325
    for word in words:
        value = fold(((value ^ word) * 0x100000001b3) & 0xffffffffffffffff)
    return value


def file_hash(path):
    """FNV-1a of a file's bytes, as it is defined."""
    with open(path, "rb") as file:
        return "fnv1a64:%016x" % fnv1a(file.read(), lambda value: value)
