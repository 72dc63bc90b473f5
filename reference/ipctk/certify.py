#!/usr/bin/env python3
"""What ipctk, the library of incremental potential contact, finds of surfaces that touch.

    certify.py --version               prints "ipctk" and its version
    certify.py QUESTIONS ANSWERS       reads and writes JSON (validation/contact/ipctk_questions.h)

`dartboard validate contact --with ipctk` runs it; it needs `pip install ipctk`, which brings numpy. A question has the
triangles of some bodies, the body of each, and places of all vertices. Its answer says of each place whether surfaces
cross, and how far each sample, the mean of some vertices, is from the surface of a body: the square of the distance to
the nearest of its triangles. Where the places are those of a motion, it also says of each step from one place to the
next whether nothing collides on the straight way.
"""

import json
import sys

import ipctk
import numpy as np


def square_of_distance(place, x, triangles):
    """The square of the distance to the nearest of the triangles."""
    return min(ipctk.point_triangle_distance(place, x[a], x[b], x[c]) for a, b, c in triangles)


def answer_to(question):
    triangles = np.array(question["triangles"], dtype=np.int32)
    bodies = np.array(question["bodies"])
    places = [np.array(place["x"]) for place in question["places"]]
    mesh = ipctk.CollisionMesh(places[0], ipctk.edges(triangles), triangles)
    of_body = {int(body): triangles[bodies == body] for body in np.unique(bodies)}
    squares = [
        [square_of_distance(x[sample["nodes"]].mean(axis=0), x, of_body[sample["body"]]) for sample in place["samples"]]
        for x, place in zip(places, question["places"])
    ]
    steps = zip(places, places[1:]) if question["in_motion"] else []
    return {
        "crossing": [bool(ipctk.has_intersections(mesh, x)) for x in places],
        "squares": squares,
        "free": [bool(ipctk.is_step_collision_free(mesh, before, after)) for before, after in steps],
    }


def main(arguments):
    if arguments == ["--version"]:
        print("ipctk", ipctk.__version__)
        return
    questions, answers = arguments
    ipctk.set_num_threads(1)
    with open(questions, encoding="utf-8") as file:
        asked = json.load(file)["questions"]
    with open(answers, "w", encoding="utf-8") as file:
        json.dump({"answers": [answer_to(question) for question in asked]}, file, allow_nan=False)


if __name__ == "__main__":
    main(sys.argv[1:])
