"""The mechanics of core/plain/problem.h written down a second time, over the cells of a frame: masses, springs, energies,
stresses, and one step of the classical Runge-Kutta method."""

import collections
import math

import numpy as np

from bodies import DIMENSION, FACES, measure, polygon_vector

EPS = 2.0 ** -52

# Every sum here and in the program has at most 2^8 terms with at most 2^5 roundings in each, masses included, so both lie
# within 2^13 * 2^-53 of the sum of the terms' sizes, and within twice that of each other.
SUM = 2.0 ** -39


class Groups:
    """Union-find."""

    def __init__(self, items):
        self.up = {item: item for item in items}

    def find(self, item):
        while self.up[item] != item:
            item = self.up[item]
        return item

    def join(self, a, b):
        self.up[self.find(a)] = self.find(b)

    def all(self):
        groups = collections.defaultdict(set)
        for item in self.up:
            groups[self.find(item)].add(item)
        return list(groups.values())


class Network:
    """The cells of a frame as springs and masses. Its vertices are identified by the cells and corners of the body at rest
    that they belong to, and not by the program's numbers: no vertex has moved by as much as a third of the
    shortest edge, so that the nearest point of its own cell is its origin."""

    def __init__(self, body, material, frame):
        self.body, self.frame = body, frame
        self.point = {}   # of each vertex: the point of the body
        self.corner = {}  # (cell of the body, point): the vertex
        self.mistakes = []
        edges = [body.points[b] - body.points[a] for kind, nodes in body.cells
                 for a, b in edges_of(kind, nodes)]
        near = min(np.linalg.norm(e) for e in edges) / 3
        for cell, (kind, nodes) in zip(frame.mesh_cell, frame.cells):
            rest_kind, rest_nodes = body.cells[cell]
            for vertex in nodes:
                far = [(np.linalg.norm(frame.x[vertex] - body.points[p]), p) for p in rest_nodes]
                distance, point = min(far)
                if distance > near:
                    self.mistakes.append("vertex %d of cell %d is %.3g m from its point" % (vertex, cell, distance))
                if self.point.setdefault(vertex, point) != point:
                    self.mistakes.append("vertex %d is both point %d and %d" % (vertex, point, self.point[vertex]))
                self.corner[cell, point] = vertex
            if kind != rest_kind or sorted(self.point[v] for v in nodes) != sorted(rest_nodes):
                self.mistakes.append("cell %d is a %s of %s" % (cell, kind, nodes))
        self.rest = np.array([body.points[self.point[v]] for v in range(len(frame.x)) if v in self.point])
        if len(self.rest) != len(frame.x):
            self.mistakes.append("there are points without a cell")
        if self.mistakes:
            return
        self.weigh(material["density"])
        self.join_springs(material)
        self.glue()

    # ---- contents

    def weigh(self, density):
        self.cell_mass = [density * abs(measure(kind, self.rest[list(nodes)])) for kind, nodes in self.frame.cells]
        self.mass = np.zeros(len(self.frame.x))
        for mass, (_, nodes) in zip(self.cell_mass, self.frame.cells):
            for vertex in nodes:
                self.mass[vertex] += mass / len(nodes)

    def volumes(self):
        """For each vertex its share of the present volume (area) of its cells."""
        volume = np.zeros(len(self.frame.x))
        for kind, nodes in self.frame.cells:
            for vertex in nodes:
                volume[vertex] += abs(measure(kind, self.frame.x[list(nodes)])) / len(nodes)
        return volume

    def join_springs(self, material):
        count = collections.Counter(frozenset(edge) for kind, nodes in self.frame.cells
                                    for edge in edges_of(kind, nodes))
        self.ends = np.array([sorted(edge) for edge in count], dtype=int).reshape(-1, 2)
        cells = np.array([count[edge] for edge in count], dtype=float)
        self.stiffness, self.damping = material["stiffness"] * cells, material["damping"] * cells
        self.rest_length = np.linalg.norm(self.rest[self.ends[:, 1]] - self.rest[self.ends[:, 0]], axis=1)

    def glue(self):
        """Cells are connected where they share a facet: a face of volumes, an edge of polygons, a point of lines. So are
        their corners, edges and faces there, and nowhere else."""
        at = collections.defaultdict(list)
        for c, (kind, nodes) in enumerate(self.frame.cells):
            for facet in facets_of(kind, nodes):
                at[frozenset(facet)].append((c, facet))
        self.facets = at
        cells = Groups(range(len(self.frame.cells)))
        parts = {}
        for c, (kind, nodes) in enumerate(self.frame.cells):
            parts.update({(c, frozenset([v])): 0 for v in nodes})
            parts.update({(c, frozenset(edge)): 1 for edge in edges_of(kind, nodes)})
            if DIMENSION[kind] == 3:
                parts.update({(c, frozenset(face)): 2 for face in facets_of(kind, nodes)})
        orbits = Groups(parts)
        for key, sides in at.items():
            for (a, _), (b, _) in zip(sides, sides[1:]):
                cells.join(a, b)
                for cell, part in list(parts):
                    if cell == a and part <= key:
                        orbits.join((a, part), (b, part))
        self.components = cells.all()
        sizes = collections.Counter(parts[next(iter(orbit))] for orbit in orbits.all())
        if self.body.dimension == 1:
            cells_of_map = faces = 0
        else:
            cells_of_map = len(self.frame.cells)
            faces = sizes[2] if self.body.dimension == 3 else cells_of_map
        self.counts = {"vertices": sizes[0], "edges": sizes[1], "faces": faces, "cells": cells_of_map,
                       "components": len(self.components)}

    # ---- sums, each as (value, bound on its rounding)

    def kinetic(self):
        return total(0.5 * self.mass * (self.frame.v ** 2).sum(axis=1))

    def elastic(self):
        stretch, size = self.stretch(), np.abs(self.frame.x).max()
        # a length is a difference of coordinates: its error is relative to them
        return (math.fsum(0.5 * self.stiffness * stretch ** 2),
                SUM * math.fsum(self.stiffness * np.abs(stretch) * size))

    def gravitational(self, gravity):
        return total(-(self.mass[:, None] * self.frame.x * gravity).ravel())

    def momentum(self, axis):
        return total(self.mass * self.frame.v[:, axis])

    def angular_momentum(self, axis):
        j, k = (axis + 1) % 3, (axis + 2) % 3
        x, v = self.frame.x, self.frame.v
        return total(np.concatenate([self.mass * x[:, j] * v[:, k], -self.mass * x[:, k] * v[:, j]]))

    def boundary(self):
        """Area of the faces with one cell, length of the edges with one face; nothing of a chain."""
        if self.body.dimension == 1:
            return 0.0, 0.0
        single = [sides[0][1] for sides in self.facets.values() if len(sides) == 1]
        if self.body.dimension == 3:
            return total([np.linalg.norm(polygon_vector(self.frame.x, face)) for face in single])
        return total([np.linalg.norm(self.frame.x[a] - self.frame.x[b]) for a, b in single])

    def largest_stress(self):
        """The largest principal stress of a vertex, sum over its springs of T l u u^T / 2 over its volume; of a
        chain the largest tension, 0 where none is stretched."""
        if self.body.dimension == 1:
            tension, bound = self.tensions()
            return max(0.0, tension.max()), bound
        stress, bound = self.stresses()
        # eigenvalues move by no more than the norm of what moves the matrix
        return max(np.linalg.eigvalsh(s)[-1] for s in stress), bound.max()

    def tensions(self):
        """For each spring, and a bound on the rounding of any."""
        return self.stiffness * self.stretch(), SUM * self.stiffness.max() * np.abs(self.frame.x).max()

    def strains(self):
        """{the ends of a spring: its elongation over its rest length}, and a bound on the rounding
        of any."""
        strain = self.stretch() / self.rest_length
        return ({frozenset(ends): s for ends, s in zip(self.ends.tolist(), strain)},
                SUM * np.abs(self.frame.x).max() / self.rest_length.min())

    def stresses(self):
        """For each vertex, a matrix; and a bound on its rounding, in the norm that is its largest eigenvalue."""
        along = self.frame.x[self.ends[:, 1]] - self.frame.x[self.ends[:, 0]]
        length = np.linalg.norm(along, axis=1)
        tension = self.stiffness * (length - self.rest_length)
        size = np.abs(self.frame.x).max()
        stress = np.zeros((len(self.frame.x), 3, 3))
        bound = np.zeros(len(self.frame.x))
        for (a, b), dx, l, t, k in zip(self.ends, along, length, tension, self.stiffness):
            for end in (a, b):
                stress[end] += np.outer(dx, dx) * (0.5 * t / l)
                bound[end] += 0.5 * l * k * size
        volume = self.volumes()
        return stress / volume[:, None, None], SUM * bound / volume

    def stretch(self):
        along = self.frame.x[self.ends[:, 1]] - self.frame.x[self.ends[:, 0]]
        return np.linalg.norm(along, axis=1) - self.rest_length

    # ---- motion

    def acceleration(self, x, v, surroundings, held):
        along = x[self.ends[:, 1]] - x[self.ends[:, 0]]
        length = np.linalg.norm(along, axis=1)
        unit = along / length[:, None]
        faster = ((v[self.ends[:, 1]] - v[self.ends[:, 0]]) * unit).sum(axis=1)
        pull = (self.stiffness * (length - self.rest_length) + self.damping * faster)[:, None] * unit
        force = surroundings["contact"](x)[0] if "contact" in surroundings else np.zeros_like(x)
        np.add.at(force, self.ends[:, 0], pull)
        np.add.at(force, self.ends[:, 1], -pull)
        a = force / self.mass[:, None] - surroundings["viscosity"] * v + surroundings["gravity"]
        a[held] = 0.0
        return a

    def step(self, h, surroundings, held):
        """Positions and velocities a step later, by the classical Runge-Kutta method, and a bound on the rounding of
        each."""
        def slope(x, v):
            return v, self.acceleration(x, v, surroundings, held)

        x, v = self.frame.x, self.frame.v
        k1 = slope(x, v)
        k2 = slope(x + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = slope(x + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = slope(x + h * k3[0], v + h * k3[1])
        x_then = x + h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        v_then = v + h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        # The force of a spring is off by k times the rounding of coordinates and c times that of speeds, twice over,
        # with 16 roundings on the way; all springs of a vertex add up, and masses are known to 2^-42. Later stages see
        # the errors of the first: h omega is below 1, so that they do not grow more than twofold in a step.
        large, fast = np.abs(x).max(), np.abs(v).max()
        at_vertex = np.zeros(len(x))
        for end in (0, 1):
            np.add.at(at_vertex, self.ends[:, end], self.stiffness * large + self.damping * fast)
        if "contact" in surroundings:
            at_vertex += surroundings["contact"](x)[1] * large
        off = (2.0 ** -42 * at_vertex / self.mass).max() + 2.0 ** -46 * (np.abs(k1[1]).max() + fast)
        v_off = 2 * h * off + 8 * EPS * fast
        return x_then, v_then, h * v_off + 8 * EPS * large, v_off


def total(terms):
    terms = [float(t) for t in terms]
    return math.fsum(terms), SUM * math.fsum(abs(t) for t in terms)


def edges_of(kind, nodes):
    if kind == "line":
        return [tuple(nodes)]
    edges = {frozenset((nodes[face[k]], nodes[face[(k + 1) % len(face)]])) for face in FACES[kind]
             for k in range(len(face))}
    return [tuple(edge) for edge in edges]


def facets_of(kind, nodes):
    """What neighbour cells share, as the vertices around it."""
    if DIMENSION[kind] == 3:
        return [tuple(nodes[k] for k in face) for face in FACES[kind]]
    if DIMENSION[kind] == 2:
        return edges_of(kind, nodes)
    return [(v,) for v in nodes]
