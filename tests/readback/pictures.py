#!/usr/bin/env python3
"""The pictures that `dartboard simulate --picture` draws, as SVG and PNG, of bodies whose appearance is known.

    pictures.py PROGRAM [TEST...]

The specification of a picture (benchmarks/figures/body_picture.h): the boundary seen from the front, a little from the right and above,
z upwards; each component in a colour of its own, and facets from inside in another; panels side by side with times.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

from bodies import FACES, Body

SVG = "{http://www.w3.org/2000/svg}"


def cube(place, size):
    return [np.array(place) + size * np.array(corner) for corner in
            ([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1])]


class Picture:
    """The polygons of an SVG in the order they are drawn, as (colour, corners [pixels, y upwards]); its texts with their
    places; its size."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        self.width, self.height = int(root.get("width")), int(root.get("height"))
        self.polygons = []
        for polygon in root.iter(SVG + "polygon"):
            colour = tuple(int(c) for c in re.findall(r"\d+", polygon.get("fill")))
            corners = np.array([[float(c) for c in pair.split(",")] for pair in polygon.get("points").split()])
            self.polygons.append((colour, corners * [1, -1] + [0, self.height]))
        self.texts = []
        for group in root.iter(SVG + "g"):
            place = re.match(r"translate\(([-\d.]+),([-\d.]+)\)", group.get("transform", ""))
            texts = ["".join(text.itertext()).strip() for text in group.findall(SVG + "text")]
            self.texts += [(text, float(place[1]), self.height - float(place[2])) for text in texts if place]

    def facets(self):
        """Each facet is two polygons, its rim in a darker colour and then its inner part: (colour, corners half-way)."""
        pairs = zip(self.polygons[0::2], self.polygons[1::2])
        return [(inner[0], (rim[1] + inner[1]) / 2) for rim, inner in pairs]


def pixels(path):
    """A PNG of 8 bits without interlacing as rows x columns x channels."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        (length,), name = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + length]
        if name == b"IHDR":
            width, height, depth, colours, _, _, interlaced = struct.unpack(">IIBBBBB", body)
        if name == b"IDAT":
            packed += body
        at += 12 + length
    channels = {2: 3, 6: 4}[colours]
    assert (depth, interlaced) == (8, 0)
    raw, stride = zlib.decompress(packed), width * channels
    rows, above = [], [0] * stride
    for y in range(height):
        kind, line = raw[y * (stride + 1)], list(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for k in range(stride):
            left = line[k - channels] if k >= channels else 0
            corner = above[k - channels] if k >= channels else 0
            if kind == 1:
                line[k] += left
            elif kind == 2:
                line[k] += above[k]
            elif kind == 3:
                line[k] += (left + above[k]) // 2
            elif kind == 4:
                guess = left + above[k] - corner
                line[k] += min((abs(guess - left), 0, left), (abs(guess - above[k]), 1, above[k]),
                               (abs(guess - corner), 2, corner))[2]
            line[k] &= 255
        rows.append(line)
        above = line
    return np.array(rows).reshape(height, width, channels)


def hue(colour):
    """A colour without its lightness: rims are darker, and sides of a body differ in light."""
    colour = np.array(colour, dtype=float)
    return colour / np.linalg.norm(colour)


def alike(a, b):
    return float(hue(a) @ hue(b)) > 0.9995


class Pictures(unittest.TestCase):
    program = None  # set by main

    def draw(self, body, **more):
        folder = tempfile.mkdtemp(prefix="dartboard-pictures-")
        self.addCleanup(shutil.rmtree, folder)
        body.write(os.path.join(folder, "body.vtu"))
        scene = {"name": "drawn", "body": {"mesh": "body.vtu"}, "gravity": [0, 0, 0], "step": 0.001, "duration": 0.003}
        scene.update(more)
        path, out = os.path.join(folder, "scene.json"), os.path.join(folder, "out")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        subprocess.run([self.program, "simulate", path, "--out", out, "--picture"], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return Picture(os.path.join(out, "picture.svg")), os.path.join(out, "picture.png")

    # Four cubes that do not touch, each another component: at the origin and away from it along x, y and z, each
    # farther than the one before.
    PLACES = np.array([[0, 0, 0], [2.0, 0, 0], [0, 2.5, 0], [0, 0, 3.0]])
    SIZE = 0.5

    # When two pictures are compared, equal colours mean equal components: blue, ochre, green, violet for 0 to
    # 3, in the order of their cells; and red for facets from inside.
    COMPONENT_COLOURS = [(0x7b, 0xa7, 0xd9), (0xe0, 0xb1, 0x5a), (0x86, 0xbf, 0x7c), (0xb1, 0x8c, 0xc8)]
    INSIDE_COLOUR = (0xc8, 0x50, 0x3c)

    def four_cubes(self):
        points, cells = [], []
        for place in self.PLACES:
            cells.append(("hexahedron", range(len(points), len(points) + 8)))
            points += cube(place, self.SIZE)
        return Body(points, cells)

    def by_colour(self, facets):
        """(colour, its facets) of one panel in which each of four cubes shows three sides."""
        groups = []
        for colour, corners in facets:
            group = next((g for g in groups if alike(g[0], colour)), None)
            if group is None:
                groups.append(group := (colour, []))
            group[1].append(corners)
        self.assertEqual(sorted(len(g[1]) for g in groups), [3, 3, 3, 3])
        return groups

    def cubes_by_colour(self, facets):
        groups = self.by_colour(facets)
        return [next(g[1] for g in groups if alike(g[0], colour)) for colour in self.COMPONENT_COLOURS]

    def test_places_are_seen_from_the_front_right_and_above_and_not_mirrored(self):
        picture, _ = self.draw(self.four_cubes())
        facets = picture.facets()
        self.assertEqual(len(facets), 4 * 12)
        cubes = self.cubes_by_colour(facets[:12])
        # the same three sides of each, so that their middles differ as the cubes' places do
        middles = [np.mean([c for face in faces for c in face], axis=0) for faces in cubes]
        to_pixels = np.linalg.solve(self.PLACES[1:] - self.PLACES[0], np.array(middles[1:]) - middles[0]).T
        right, up = to_pixels
        scale = np.linalg.norm(right)
        # a view along parallels, the same scale everywhere: rows of one length at right angles. Places are off by the
        # hundredth of a pixel that the file rounds them to.
        self.assertAlmostEqual(np.linalg.norm(up) / scale, 1, delta=0.01)
        self.assertAlmostEqual(right @ up / scale ** 2, 0, delta=0.01)
        # z is upwards, x to the right; what is farther back (y) is seen to the right of and above what is in front
        self.assertAlmostEqual(right[2] / scale, 0, delta=0.01)
        self.assertGreater(up[2] / scale, 0.7)
        self.assertGreater(right[0] / scale, 0.7)
        self.assertGreater(right[1] / scale, 0.1)
        self.assertGreater(up[1] / scale, 0.1)
        # towards the viewer: the front most of all, then right and above. In a mirrored view it would be behind.
        viewer = np.cross(right, up) / scale ** 2
        self.assertLess(viewer[1], -0.7)
        self.assertGreater(viewer[0], 0.1)
        self.assertGreater(viewer[2], 0.1)
        # and each face that looks there, and no other, is where the map puts its corners, but for half the difference
        # of a rim of 0.4 pixels outwards and an inner part of 0.9 inwards; at corners that is more
        for place, faces in zip(self.PLACES, cubes):
            corners = np.array(cube(place, self.SIZE))
            expected = []
            for face in FACES["hexahedron"]:
                normal = np.cross(corners[face[1]] - corners[face[0]], corners[face[2]] - corners[face[0]])
                if normal @ viewer > 0:
                    expected.append(corners[list(face)] @ to_pixels.T)
            shift = np.mean([c for f in faces for c in f], axis=0) - np.mean([c for f in expected for c in f], axis=0)
            # the whole picture is shifted as one
            if place @ place == 0:
                first_shift = shift
            self.assertLess(np.abs(shift - first_shift).max(), 0.05)
            for face in faces:
                self.assertLess(min(self.distance(face, e + shift) for e in expected), 1.0)

    @staticmethod
    def distance(a, b):
        """Between polygons, whichever corner comes first and whichever way round."""
        return min(np.abs(np.roll(np.array(a)[::way], k, axis=0) - b).max() for way in (1, -1) for k in range(len(a)))

    def test_sides_differ_in_light_and_rims_are_darker(self):
        picture, _ = self.draw(self.four_cubes())
        light = lambda colour: sum(colour)
        for (rim, _), (inner, _) in zip(picture.polygons[0::2], picture.polygons[1::2]):
            self.assertTrue(alike(rim, inner))
            self.assertLess(light(rim), light(inner))
        for faces in self.by_colour([(c, (c, p)) for c, p in picture.facets()[:12]]):
            colours = {colour: corners for colour, corners in faces[1]}
            self.assertEqual(len(colours), 3)
            # lit from above: the lightest face is the one whose middle is highest
            highest = max(colours, key=lambda c: np.mean(colours[c], axis=0)[1])
            self.assertEqual(highest, max(colours, key=light))

    # ---- facets from inside

    def two_cubes(self):
        lattice = [[i * 1.0, j * 0.8, k * 0.6] for k in range(2) for j in range(2) for i in range(3)]
        return Body(lattice, [("hexahedron", [0, 1, 4, 3, 6, 7, 10, 9]), ("hexahedron", [1, 2, 5, 4, 7, 8, 11, 10])])

    def test_only_what_had_been_inside_is_red_and_it_is_where_the_cut_was(self):
        cut = {"at": 0.001, "dissociate": {"plane": {"point": [1, 0, 0], "normal": [1, 0, 0]}}}
        picture, _ = self.draw(self.two_cubes(), events=[cut])
        red = [(colour, corners) for colour, corners in picture.facets() if alike(colour, self.INSIDE_COLOUR)]
        # one side of the cut looks towards the viewer (+x): in each of the three panels after it
        self.assertEqual(len(red), 3)
        panel = picture.width / 4
        self.assertEqual([int(np.mean(corners, axis=0)[0] // panel) for _, corners in red], [1, 2, 3])
        # the part at the left has the red face and two others; that at the right is another component and shows three
        for k in (1, 2, 3):
            here = [(colour, c) for colour, c in picture.facets() if int(np.mean(c, axis=0)[0] // panel) == k]
            parts = [[c for colour, c in here if alike(colour, known)] for known in self.COMPONENT_COLOURS[:2]]
            left, right = sorted(parts, key=lambda part: np.mean(np.concatenate(part), axis=0)[0])
            self.assertEqual((len(left), len(right)), (2, 3))
            self.assertEqual(len(here), 6)

    def test_a_cell_that_is_removed_is_gone_and_its_neighbour_shows_red(self):
        picture, _ = self.draw(self.two_cubes(), events=[{"at": 0.001, "remove": {"ids": [1]}}])
        panel = picture.width / 4
        last = [colour for colour, c in picture.facets() if int(np.mean(c, axis=0)[0] // panel) == 3]
        self.assertEqual(len(last), 3)
        self.assertEqual(sum(alike(c, self.INSIDE_COLOUR) for c in last), 1)

    # ---- panels

    def test_panels_follow_each_other_in_time_from_left_to_right(self):
        picture, _ = self.draw(self.two_cubes(), duration=0.009, initial_velocity=[0, 0, 30])
        times = [(text, x, y) for text, x, y in picture.texts if text.startswith("t = ")]
        self.assertEqual([text for text, _, _ in times], ["t = 0 s", "t = 0.003 s", "t = 0.006 s", "t = 0.009 s"])
        panel, facets = picture.width / 4, picture.facets()
        height = []
        for k, (_, x, y) in enumerate(times):
            self.assertAlmostEqual(x, (k + 0.5) * panel, delta=1)
            here = np.concatenate([c for _, c in facets if int(np.mean(c, axis=0)[0] // panel) == k])
            height.append(here.mean(axis=0)[1])
            self.assertLess(y, here.min(axis=0)[1])
        # a body that flies upwards is higher in each, by as much
        self.assertGreater(height[1] - height[0], 1)
        self.assertAlmostEqual(height[2] - height[1], height[1] - height[0], delta=0.1)
        self.assertAlmostEqual(height[3] - height[2], height[1] - height[0], delta=0.1)
        self.assertEqual([text for text, _, y in picture.texts if y > max(y for _, _, y in times)], ["drawn"])

    def test_both_pictures_show_the_same(self):
        picture, png = self.draw(self.four_cubes())
        shown = pixels(png)
        self.assertEqual(shown.shape[:2], (picture.height, picture.width))
        facets = picture.facets()
        for k, (colour, corners) in enumerate(facets):
            x, y = np.mean(corners, axis=0)
            if any(self.inside((x, y), other) for _, other in facets[k + 1:]):
                continue  # hidden by one that is drawn later
            there = shown[int(round(picture.height - y)), int(round(x)), :3]
            self.assertLessEqual(np.abs(there.astype(int) - colour).max(), 2)

    @staticmethod
    def inside(place, corners):
        sides = [np.cross(b - a, place - a) for a, b in zip(corners, np.roll(corners, -1, axis=0))]
        return min(sides) > 0 or max(sides) < 0


def main(program, *tests):
    Pictures.program = program
    return 0 if unittest.main(argv=["pictures.py", *tests], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
