"""Every figure of README.md: its place, its source, its derivation.

A row of FIGURES is a piece of the page with {} in place of each figure, and a function that gives the figures, as they are
printed, from what a committed study has measured. A row of NO_MEASUREMENT is a piece whose numbers are not
measured: constants of ours, with the file and the words that say the same, or what others say. figures_test.py puts the
figures into the pieces, looks for them in the page, and finds numbers that are in no row. All other figures are on the
page of the studies, results/xeon/report.html, with their claims.
"""

from samples import *

README = "README.md"
REPRODUCED = "results/xeon/reproduce/measured.jsonl.gz"
MESH = "benchmarks/meshes/liver564.mesh"


def three(number):
    """Three significant digits, without an exponent and without a point that nothing follows."""
    number = float("%.2e" % number)
    return "%.*f" % (max(0, 2 - math.floor(math.log10(abs(number)))), number)


def steps():
    return measured(REPRODUCED, "measure")


def ms(task):
    return 1e-6 * time(steps(), task).median


def over_graph(task):
    return ratio(steps(), task, "graph").median


def larger_over_graph(task, clock):
    body = "10^5 in grid order"
    rows = [dict(r, cpu_ns=r[clock]) for r in measured(REPRODUCED, "measure-step") if r.get("task") in (body + task, body + ": graph")]
    return ratio(rows, body + task, body + ": graph")


def cells_of_liver():
    """Vertices, edges and tetrahedra, counted in the file."""
    text = read(MESH).split()
    at = text.index("Tetrahedra")
    count = int(text[at + 1])
    numbers = [int(n) for n in text[at + 2:at + 2 + 5 * count]]
    cells = [numbers[k:k + 4] for k in range(0, 5 * count, 5)]
    edges = {tuple(sorted((a, b))) for c in cells for a in c for b in c if a != b}
    return len({v for c in cells for v in c}), len(edges), count


def judged(figures, bound, expected, at_least=False):
    """A figure that is only there to keep the words next to it."""
    found = verdict(figures, bound, at_least)
    assert found == expected, "the samples say '%s', the page '%s'" % (found, expected)
    return ()


FIGURES = [
    ("| one step: {} vertices, {} springs, {} tetrahedra |", [MESH], lambda: ["{:,}".format(n) for n in cells_of_liver()]),
    ("| map, dart to dart, one dart of a cell holds its data | 12 ms | 6 | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("coverage")), three(over_graph("coverage")))),
    ("| map, lists of embeddings, one dart holds | 8 ms | 4 | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("lists")), three(over_graph("lists")))),
    ("| the same, every dart holds it | | | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("lists-every")), three(over_graph("lists-every")))),
    ("| the same, every dart holds it | | | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("coverage-every")), three(over_graph("coverage-every")))),
    ("| **map, cell arrays (section 5.2)** | 2 ms | <= 1.10 | **{} ms** | **{}** |", [REPRODUCED],
     lambda: (three(ms("arrays")), three(over_graph("arrays")))),
    ("| map, the columns of a scene, four springs at a time | | | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("columns")), three(over_graph("columns")))),
    ("| plain arrays: an indexed graph | 2 ms | 1 | {} ms | 1 |", [REPRODUCED], lambda: (three(ms("graph")),)),
    ("| CGAL linear cell complex, dart to dart | | | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("cgal-coverage")), three(over_graph("cgal-coverage")))),
    ("| the same, over its attributes | | | {} ms | {} |", [REPRODUCED],
     lambda: (three(ms("cgal-attributes")), three(over_graph("cgal-attributes")))),
    ("a map that can be cut costs {} % more than arrays that cannot", [REPRODUCED],
     lambda: ("%.0f" % (100 * (over_graph("arrays") - 1)), *judged([ratio(steps(), "arrays", "graph")], 1.10, "holds"))),
    ("takes {} % less where a processor with", [REPRODUCED],
     lambda: ("%.0f" % (100 * (1 - over_graph("columns"))), *judged([ratio(steps(), "columns", "graph")], 1.0, "holds"))),
    ("of 100,000 tetrahedra {} % less, and {} % by both cores", [REPRODUCED],
     lambda: ["%.0f" % (100 * (1 - larger_over_graph(task, clock).median)) for task, clock in ((": padded", "cpu_ns"), (": threads", "wall_ns"))]),
    ("arrays have become {} times as fast since", [REPRODUCED], lambda: ("%.0f" % (2.0 / ms("arrays")),)),
]

PAPER = "what the paper says"
NAME = "a name or a place"

# piece and source: PAPER, NAME, or a file of ours and words of it
NO_MEASUREMENT = [
    ("*3-dimensional generalized map*", NAME),
    ("(Meseure, Darles, Skapin, VRIPHYS 2010)", PAPER),
    ("VRIPHYS 2010, pp. 1-10, hal-00563396", PAPER),
    ("On Debian 12, with nothing installed", NAME),
    ("GPL-3.0-or-later", NAME),
    ("| 2010 | ratio | here | ratio |", PAPER),
    ("one dart of a cell holds its data | 12 ms | 6 |", PAPER),
    ("one dart holds | 8 ms | 4 |", PAPER),
    ("| **map, cell arrays (section 5.2)** | 2 ms | <= 1.10 |", PAPER),
    ("| plain arrays: an indexed graph | 2 ms | 1 |", PAPER),
]
