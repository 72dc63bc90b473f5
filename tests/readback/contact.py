"""Contact with obstacles written down a second time: places of the boundary, their energies and forces."""

import math

import numpy as np

from mechanics import SUM, facets_of


def samples(network):
    """[(vertices whose mean it is, area at rest that it represents)]: for each triangle of the boundary of a solid, a
    twelfth of its area at each corner and the rest in its middle."""
    corner, middles = {}, []
    for sides in network.facets.values():
        if len(sides) != 1:
            continue
        face = sides[0][1]
        a, b, c = (network.rest[v] for v in face)
        area = np.linalg.norm(np.cross(b - a, c - a)) / 2
        middles.append((tuple(face), 0.75 * area))
        for v in face:
            corner[v] = corner.get(v, 0.0) + area / 12
    return [((v,), area) for v, area in corner.items()] + middles


def inside(obstacle, y, time):
    """How deep a place is in an obstacle at a time, and the way out; nothing if it is outside."""
    going = min(max(time - obstacle.get("from", 0.0), 0.0), obstacle.get("until", math.inf) - obstacle.get("from", 0.0))
    y = y - np.array(obstacle.get("velocity", [0, 0, 0]), dtype=float) * going
    if "plane" in obstacle:
        normal = np.array(obstacle["plane"]["normal"], dtype=float)
        normal /= np.linalg.norm(normal)
        depth = -np.dot(y - obstacle["plane"]["point"], normal)
    else:
        out = y - np.array(obstacle["sphere"]["centre"], dtype=float)
        far = np.linalg.norm(out)
        depth, normal = obstacle["sphere"]["radius"] - far, out / far
    return (depth, normal) if depth > 0 else None


class Contact:
    """The contact of a scene with planes and spheres without losses."""

    def __init__(self, scene):
        self.scene, self.obstacles = scene, scene["obstacles"]
        self.power = scene.get("exponent", 3)

    def law(self, obstacle):
        return tuple(obstacle.get(key, self.scene[key]) for key in ("pressure", "depth"))

    def touching(self, network, x, time):
        """(vertices, depth, normal, energy, force, stiffness) of each place in each obstacle."""
        for nodes, area in samples(network):
            y = x[list(nodes)].mean(axis=0)
            for obstacle in self.obstacles:
                found = inside(obstacle, y, time)
                if found:
                    (depth, normal), (pressure, allowed) = found, self.law(obstacle)
                    share, p = depth / allowed, self.power
                    yield (nodes, depth, normal, area * pressure * allowed / p * share ** p,
                           area * pressure * share ** (p - 1), (p - 1) * area * pressure / allowed * share ** (p - 2))

    def energy(self, network, time, x=None):
        """The energy, and a bound on its rounding: depths are differences of coordinates."""
        x = network.frame.x if x is None else x
        found = list(self.touching(network, x, time))
        return (math.fsum(e for *_, e, _, _ in found), SUM * math.fsum(f * np.abs(x).max() for *_, f, _ in found))

    def forces(self, network, x, time):
        """For each vertex the force [N], and the factor of a rounding of places in it [N/m]."""
        force, stiffness = np.zeros_like(x), np.zeros(len(x))
        for nodes, _, normal, _, f, k in self.touching(network, x, time):
            for v in nodes:
                force[v] += f / len(nodes) * normal
                stiffness[v] += k / len(nodes)
        return force, stiffness

    def depths(self, network):
        """The depth of each vertex by itself."""
        depth = np.zeros(len(network.frame.x))
        for nodes, d, *_ in self.touching(network, network.frame.x, network.frame.time):
            if len(nodes) == 1:
                depth[nodes[0]] = max(depth[nodes[0]], d)
        return depth

    def pairs(self, network):
        """{(vertices of a place, number of the obstacle that it is in): depth}."""
        found = {}
        for nodes, _ in samples(network):
            for k, obstacle in enumerate(self.obstacles):
                there = inside(obstacle, network.frame.x[list(nodes)].mean(axis=0), network.frame.time)
                if there:
                    found[tuple(sorted(int(v) for v in nodes)), k] = there[0]
        return found

    def row(self, networks, n, h):
        """The columns of the diagnostics after n steps: {head: (value, bound)}. Obstacles are moved by half a step
        before and after each, which does the work of their contacts."""
        network, supplied, off = networks[n], 0.0, 0.0
        for k in range(n):
            half = (k + 0.5) * h
            # events at the end of a step change no energy but that of removed parts; those of this scene leave the boundary
            for sign, at, time in ((1, k, half), (-1, k, k * h), (1, k + 1, (k + 1) * h), (-1, k + 1, half)):
                value, bound = self.energy(networks[at], time)
                supplied, off = supplied + sign * value, off + bound
        found = list(self.touching(network, network.frame.x, n * h))
        deepest = max((d for _, d, *_ in found), default=0.0)
        return {"contact [J]": self.energy(network, n * h), "lost by restitution [J]": (0.0, 0.0),
                "lost by friction [J]": (0.0, 0.0), "supplied at contacts [J]": (supplied, off),
                "contacts": (len(found), 0), "deepest contact [m]": (deepest, SUM * np.abs(network.frame.x).max())}
