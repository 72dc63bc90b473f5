"""Every figure of README.md and results/README.md: its place, its source, its derivation.

A row of FIGURES is a piece of a page with {} in place of each figure, and a function that gives the figures, as they are
printed, from committed samples. A row of NO_MEASUREMENT is a piece of a page whose numbers are not measured: constants
of ours, with the file and the words that say the same, or what others say. figures_test.py puts the figures into the
pieces, looks for them in the page, and finds numbers that are in no row. No figure without a sample: measure it again,
keep the sample and add a row here, or leave it out.
"""

from samples import *

README, RESULTS = "README.md", "results/README.md"
RUN = "results/2026-11-21-epyc-"
REPRODUCED = "results/2026-11-28-epyc-reproduce/"
STEPS = REPRODUCED + "samples.jsonl"
LARGER = REPRODUCED + "larger/samples.jsonl"
TOPOLOGY = RUN + "topology/samples.jsonl"
OPERATIONS = "results/2026-11-28-epyc-operations/samples.jsonl"
STEP = "results/2026-11-28-epyc-step/samples.jsonl"
STEP_MESHES = "results/2026-11-27-xeon-step-meshes/samples.jsonl"
LARGE_BODIES = "results/2026-11-28-epyc-large/samples.jsonl"
CONTACT = "results/2026-11-27-epyc-contact-costs/samples.jsonl"
BOUNCES = "results/2026-11-29-xeon-bounces/samples.jsonl"
ABLATION = "results/2026-11-28-epyc-ablation/samples.jsonl"
SOLVERS = RUN + "solvers/samples.jsonl"
AUDIT = "results/2026-11-29-xeon-audit/samples.jsonl"
AUDIT_CLAIMS = "results/2026-11-29-xeon-audit/claims.json"
FORETOLD = "results/2026-11-23-epyc-foretold/samples.jsonl"
OPERATED = ["results/2026-11-23-epyc-element-operations/samples.jsonl", "results/2026-11-23-epyc-element-operations-real/samples.jsonl"]
MODELS = "results/2026-11-27-xeon-models/"
EXTREMES = REPRODUCED + "extremes/"
VERDICTS = "results/2026-11-26-xeon-verdicts/samples.jsonl"
TRADES = "results/2026-11-26-xeon-tradeoffs/samples.jsonl"
SCENES = "results/2026-11-26-xeon-scene-extremes/extremes.jsonl"
JUDGES = "results/2026-11-23-epyc-judges/judges.json"
ELEMENTS = "results/2026-11-27-xeon-elements/samples.jsonl"
DETERMINISM = "results/2026-11-28-epyc-determinism/determinism.json"
MESH = "benchmarks/meshes/liver564.mesh"


# ---- how figures are printed

def digits(number, count, sign=""):
    """So many significant digits, without an exponent and without a point that nothing follows."""
    number = float("%.*e" % (count - 1, number))
    places = max(0, count - 1 - math.floor(math.log10(abs(number)))) if number else 0
    return "%{}.{}f".format(sign, places) % number


def two(number):
    return digits(number, 2)


def three(number):
    return digits(number, 3)


def ends(f, show=two):
    return show(f.low), show(f.high)


def all_of(f, show=two):
    return show(f.median), show(f.low), show(f.high)


def percent(f):
    return ["%+.2f" % (100 * (x - 1)) for x in f]


def words(number):
    return ("none", "one", "two", "three", "four", "five", "six", "seven")[number]


# ---- what is measured

def stepped(task, baseline, clock="cpu_ns"):
    return ratio([dict(r, cpu_ns=r[clock]) for r in lines(STEP) if r.get("task") in (task, baseline)], task, baseline)


def step_over_graph(body, task=": padded", clock="cpu_ns"):
    """Four springs at a time."""
    return stepped(body + task, body + ": graph", clock)


ORDERS = (" in grid order", " shuffled")


def gain(body, one, all_processors):
    return stepped(body + one, body + all_processors, "wall_ns")


def gains(size, one, all_processors):
    return tuple("%.2f" % gain(size + order, one, all_processors).median for order in ORDERS)


def over_copying(body):
    """A step by one processor over copying what it reads and writes."""
    n = next(r for r in lines(STEP) if r.get("body") == body)
    timed = [r for r in lines(STEP) if "task" in r]
    step, copy = time(timed, body + ": padded").median, time(timed, body + ": copy").median
    return step / (4 * n["steps"]) / (n["bytes"] * copy / n["copied_bytes"])


def larger_over_graph(task, clock):
    body = "10^5 in grid order"
    rows = [dict(r, cpu_ns=r[clock]) for r in lines(LARGER) if r.get("task") in (body + task, body + ": graph")]
    return ratio(rows, body + task, body + ": graph")


def less_than(f):
    return ["%.0f" % (100 * (1 - x)) for x in (f.median, f.high, f.low)]


def with_output(how):
    """By the clock."""
    task, alone = "liver_cut with its output" + how, "liver_cut, its integrator alone"
    return ratio([dict(r, cpu_ns=r["wall_ns"]) for r in lines(ABLATION) if r.get("task") in (task, alone)], task, alone)


def meshes_over_graph(task, clock="cpu_ns"):
    bodies = ("liver2", "truthcylinder1", "raptorTetra_8418")
    rows = [dict(r, cpu_ns=r[clock]) for r in lines(STEP_MESHES) if "task" in r]
    return [two(median(ratios([r for r in rows if r["task"].startswith(body)], body + task, body + ": graph"))) for body in bodies]



def over_fresh(body):
    """The change after which a step takes longest, over one of a fresh body."""
    changed = {r["task"].rsplit(": ", 1)[0] for r in lines(STEP) if r.get("task", "").startswith(body + ", ")}
    return max((stepped(one + ": changed", one + ": fresh") for one in changed), key=lambda f: f.median)


def changing_over(body, task, baseline):
    """With a dissociation in every step."""
    return stepped(body + ": " + task, body + ": " + baseline)


FOLLOWED, ALONE, GRAPH_ALONE = "a dissociation and a step", "the step alone", "the naive graph, the step alone"
ALL_ANEW = "a dissociation, all columns anew, and a step"


def part_of_run(side, part):
    """[s] of a box of so many cubes along each edge."""
    return figure([r["seconds"] for r in lines(LARGE_BODIES) if r.get("part") == part and r["side"] == side])


def once(part):
    """[s] of the largest box, which is run once."""
    return next(r["seconds"] for r in lines(LARGE_BODIES) if r.get("part") == part and r["side"] == 119)


def over_limits(part):
    """Over the time of copying, writing or reading as many bytes, for boxes of a million and two."""
    return [median([r["seconds"] / r["limit_seconds"] for r in lines(LARGE_BODIES) if r.get("part") == part and r["side"] == side])
            for side in (55, 70)]


def counted_once():
    return next(r for r in lines(LARGE_BODIES) if "peak_bytes" in r and r["side"] == 119)


def most_bytes(key):
    """Of a tetrahedron."""
    return max(r[key] / (6 * r["side"] ** 3) for r in lines(LARGE_BODIES) if "peak_bytes" in r)


def timed_contact():
    return [r for r in lines(CONTACT) if "task" in r]


def with_contact(situation, task="step", baseline="step without"):
    pair = situation + ": " + task, situation + ": " + baseline
    return ratio([r for r in timed_contact() if r["task"] in pair], *pair)


def bounce(body, asked):
    return next(r["found"] for r in lines(BOUNCES) if r.get("bounces") == body and r["asked"] == asked and r["integrator"] == "verlet")


def worst_bounce():
    """Of loose vertices and of bodies ten times as stiff as their contact."""
    bodies = {r["bounces"] for r in lines(BOUNCES) if "bounces" in r and ("loose" in r["bounces"] or r["bounces"].endswith("0 MPa") or
                                                                          r["bounces"].endswith(" 2 MPa"))}
    return max(abs(bounce(body, asked) - asked) for body in bodies for asked in (0.9, 0.5, 0.2))


def growth_of_contact(task):
    """The exponents of a task, fitted in each process, and that of n log n."""
    counts = {r["situation"]: r for r in lines(CONTACT) if r.get("situation", "").startswith("plates of ")}
    logs = [math.log(n["tetrahedra"]) for n in counts.values()]
    names = list(counts)

    def slope(values):
        x, y = sum(logs) / len(logs), sum(values) / len(values)
        return sum((a - x) * (b - y) for a, b in zip(logs, values)) / sum((a - x) ** 2 for a in logs)

    slopes = []
    for process in by_process(timed_contact()):
        rounds = collections.defaultdict(dict)
        for row in process:
            rounds[row["round"]][row["task"]] = row["cpu_ns"]
        first = names[0] + ": " + task
        slopes.append(slope([math.log(median([r[name + ": " + task] / r[first] for r in rounds.values() if first in r])
                                      * counts[names[0]]["evaluations"] / counts[name]["evaluations"]) for name in names]))
    return figure(slopes), slope([x + math.log(x) for x in logs])


def pair_of_contact(plates):
    """ns for a candidate pair."""
    n = next(r for r in lines(CONTACT) if r.get("situation") == plates)
    return time(timed_contact(), plates + ": contact").median / n["evaluations"] / n["candidates"]


def iterations_with_changes(scene):
    n = next(r for r in lines(CONTACT) if r.get("factor_scene") == scene)
    return n["iterations_of_changing"] / n["changing"] * (n["steps"] - n["changing"]) / (n["iterations"] - n["iterations_of_changing"])


def ms(task):
    return 1e-6 * time(lines(STEPS), task).median


def over_graph(task):
    return ratio(lines(STEPS), task, "graph").median


def cells_of_liver():
    """Vertices, edges and tetrahedra, counted in the file."""
    text = read(MESH).split()
    at = text.index("Tetrahedra")
    count = int(text[at + 1])
    numbers = [int(n) for n in text[at + 2:at + 2 + 5 * count]]
    cells = [numbers[k:k + 4] for k in range(0, 5 * count, 5)]
    edges = {tuple(sorted((a, b))) for c in cells for a in c for b in c if a != b}
    return len({v for c in cells for v in c}), len(edges), count


def topology(body, what):
    return [r for r in lines(TOPOLOGY) if r["body"] == body and r["figure"] == what]


def faster_than(contender, body, what):
    return ratio(topology(body, what), contender, "tetrahedral")


SMALL, LARGE = ("liver564", "kuhn-2058"), ("kuhn-48000", "kuhn-105456", "kuhn-998250")


def operation(body, name, phases=None):
    """For each process the median over times [us]; all phases, or some: 0 is the map, 1 embeddings, from 2 on views."""
    rows = sorted((r for r in lines(OPERATIONS) if r["body"] == body and r.get("operation") == name),
                  key=lambda r: r["process"])
    return [median([sum(ns) / 1e3 for ns in zip(*(r["ns"] if phases is None else [r["ns"][k] for k in phases]))]) for r in rows]


def medians(bodies, name):
    values = [median(operation(body, name)) for body in bodies]
    return min(values), max(values)


def growth(name):
    return figure([a / b for a, b in zip(operation("kuhn-998250", name), operation("kuhn-2058", name))])


def rebuild_over_removal():
    rebuild = [median(r["rebuild_ns"][0]) / 1e3 for r in
               sorted((r for r in lines(OPERATIONS) if r["body"] == "liver564" and "rebuild_ns" in r), key=lambda r: r["process"])]
    removal = [a + b for a, b in zip(operation("liver564", "remove", [0]), operation("liver564", "remove", [1]))]
    return figure([a / b for a, b in zip(rebuild, removal)])


def cut_ends():
    found = [figure(operation(body, "dissociate, cut")) for body in SMALL + LARGE]
    return two(min(f.low for f in found)), two(max(f.high for f in found))


def crossover(vertices):
    """The deviation of the law: by a straight line in logarithms between the last runs on both sides, and with either of
    the nearest runs in its place. The first runs are where the law predicts the crossover."""
    costs = [r for r in lines(SOLVERS) if r["study"] == "crossover" and r["vertices"] == vertices]
    rate = lambda r: r["explicit_s"] / r["implicit_s"]
    below, above = [r for r in costs if rate(r) < 1][-1], [r for r in costs if rate(r) >= 1][-1]
    part = math.log(1 / rate(below)) / math.log(rate(above) / rate(below))
    measured = below["phase"] * (above["phase"] / below["phase"]) ** part
    nearest = max(r["phase"] for r in costs if rate(r) < 1), min(r["phase"] for r in costs if rate(r) >= 1)
    return [costs[0]["phase"] / phase - 1 for phase in (measured, *nearest)]


def solver_step(h_omega, task):
    return figure([1e-6 * r["cpu_ns"] for r in lines(SOLVERS)
                   if r["study"] == "steps" and r["body"].endswith("= " + h_omega) and r["task"] == task])


def following(vertices):
    """Analysing and factoring again over following, by AMD: rounds of one process, at rest and stretched."""
    found = []
    for state in ("at rest", "stretched"):
        rounds = collections.defaultdict(dict)
        for r in lines(SOLVERS):
            if r["study"] == "updates" and r["body"] == "%d vertices, %s" % (vertices, state):
                rounds[r["round"]][r["task"]] = r["cpu_ns"]
        found.append(figure([r["again, AMD"] / r["follows, AMD"] for r in rounds.values()]))
    return found


def beam(model, nodes, what):
    """The error of a model on the clamped beam [%], at a Poisson's ratio of 1/4."""
    found, = (r[what] for r in lines(ELEMENTS) if r.get("model") == model and r["nodes"] == nodes and r["poisson"] == 0.25)
    return "%.1f" % (100 * found)


def slower_than_springs(model):
    cost = lambda name: next(r["ns"] * r["frequency"] for r in lines(ELEMENTS) if r.get("cost_of") == name)
    return two(cost(model) / cost("springs"))


def followings():
    return [f for vertices in (512, 1728, 4096) for f in following(vertices)]


def picked():
    return [a for a in lines(AUDIT) if a["pick"]]


def resolved():
    return [a for a in picked() if a["resolved"]]


def met():
    return [a for a in resolved() if a["actual_error"] <= a["error"]]


def missed(scene):
    return [a["actual_error"] / a["error"] for a in resolved() if a["actual_error"] > a["error"] and a["scene"].endswith(scene)]


def in_time():
    return [a for a in picked() if abs(a["predicted_s"] / a["actual_s"] - 1) <= 0.15]


def too_long():
    return [float(a["confidence"].split(" for ")[1].split()[0]) for a in lines(AUDIT) if "too long" in a["confidence"]]


def claim_of_audit(name):
    return next(c for c in document(AUDIT_CLAIMS) if c["id"] == name)


def share_in(claim):
    """The share and its interval in percent, as the table of claims has them."""
    assert claim["verdict"] == "undecided", claim
    return claim["measured"].split(", ")[1].split(" %")[0], *claim["bound_or_interval"].split("]")[0][1:].split(", ")


def regrets():
    return [a["actual_cost"] / a["best_cost"] for a in met() if a["swept"] and a["best_cost"]]


def drawn():
    return [r for r in lines(BOUNCES) if "drawn" in r]


def small(number):
    return ("%.1e" % number).replace("e-0", "e-")


def operated():
    return [o for path in OPERATED for o in lines(path)]


def claim_of_models(name):
    return next(c for c in document(MODELS + "claims.json") if c["id"] == name)


def foretold():
    return [a for a in lines(FORETOLD) if a["pick"] and a["foretold"]]


def times_the_best(a):
    return a["actual_cost"] / a["best_cost"]


def frequencies():
    return rows_of(EXTREMES + "frequencies.md")


def rows_of(path):
    table = [[cell.strip() for cell in line.strip("|").split("|")] for line in read(path).splitlines() if line.startswith("|")]
    return [dict(zip(table[0], row)) for row in table[2:]]


def detected(factor):
    return max(d["detected"] for d in document(EXTREMES + "measurements.json")["detection"]
               if d["integrator"] == "verlet" and d["factor"] == factor)


IMPLICIT = ("backward-euler", "baraff-witkin", "local-global", "ros2", "sdirk2", "implicit-midpoint", "energy-momentum", "bdf2")


def offset(implicit):
    return max((r["offset_error"], r["integrator"]) for r in lines(EXTREMES + "extremes.jsonl")
               if "offset_error" in r and r["integrator"] != "explicit-euler" and (r["integrator"] in IMPLICIT) == implicit)


def trials(judge):
    return [t for t in document(JUDGES)["trials"] if t["judge"] == judge]


def seen():
    count = lambda key: sum(t[key] for t in trials("extremes"))
    return count("seen") / (count("called_right") - count("no_difference"))


def cheapest(error):
    return [w["integrator"] for a in lines(TRADES) for w in a["winners"] if w["error"] == error and w["integrator"]]


def equal_runs():
    """Those of each row with all protective flags, all of which end in the pinned bits in all manners."""
    rows = [r for r in document(DETERMINISM)["rows"] if r["protected"]]
    assert all(r["equals_pinned"] and r["repeats"] and not r["manners_that_differ"] for r in rows)
    return len(rows[0]["hashes"])


def judged_by(evidence):
    return sum(a["judged_by"] == evidence for a in lines(SCENES))


def judged(figures, bound, expected, at_least=False):
    """A figure that is only there to keep the words next to it."""
    found = verdict(figures, bound, at_least)
    assert found == expected, "the samples say '%s', the page '%s'" % (found, expected)
    return ()



FIGURES = [
    # ---- README.md
    (README, "| one step: {} vertices, {} springs, {} tetrahedra |", [MESH], lambda: ["{:,}".format(n) for n in cells_of_liver()]),
    (README, "| map, dart to dart, one dart of a cell holds its data | 12 ms | 6 | {} ms | {} |", [STEPS],
     lambda: (three(ms("coverage")), three(over_graph("coverage")))),
    (README, "| map, lists of embeddings, one dart holds | 8 ms | 4 | {} ms | {} |", [STEPS],
     lambda: (three(ms("lists")), three(over_graph("lists")))),
    (README, "lists of embeddings, one dart holds | 8 ms | 4 | 23.1 ms | 186 | | the same, every dart holds it | | | {} ms | {} |", [STEPS],
     lambda: (three(ms("lists-every")), three(over_graph("lists-every")))),
    (README, "one dart of a cell holds its data | 12 ms | 6 | 30.6 ms | 244 | | the same, every dart holds it | | | {} ms | {} |", [STEPS],
     lambda: (three(ms("coverage-every")), three(over_graph("coverage-every")))),
    (README, "| **map, cell arrays (section 5.2)** | 2 ms | <= 1.10 | **{} ms** | **{}** |", [STEPS],
     lambda: (three(ms("arrays")), three(over_graph("arrays")))),
    (README, "| map, the columns of a scene, four springs at a time | | | {} ms | {} |", [STEPS],
     lambda: (three(ms("columns")), three(over_graph("columns")))),
    (README, "| plain arrays: an indexed graph | 2 ms | 1 | {} ms | 1 |", [STEPS], lambda: (three(ms("graph")),)),
    (README, "| CGAL linear cell complex, dart to dart | | | {} ms | {} |", [STEPS],
     lambda: (three(ms("cgal-coverage")), three(over_graph("cgal-coverage")))),
    (README, "| the same, over its attributes | | | {} ms | {} |", [STEPS],
     lambda: (three(ms("cgal-attributes")), three(over_graph("cgal-attributes")))),
    (README, "a map that can be cut costs {} % more than arrays that cannot", [STEPS],
     lambda: ("%.0f" % (100 * (over_graph("arrays") - 1)), *judged([ratio(lines(STEPS), "arrays", "graph")], 1.10, "holds"))),
    (README, "takes {} % less where a processor with", [STEPS],
     lambda: ("%.0f" % (100 * (1 - over_graph("columns"))), *judged([ratio(lines(STEPS), "columns", "graph")], 1.0, "holds"))),
    (README, "[of 100,000 tetrahedra] {} % less, and {} % by both cores", [LARGER],
     lambda: ["%.0f" % (100 * (1 - larger_over_graph(task, clock).median)) for task, clock in ((": padded", "cpu_ns"), (": threads", "wall_ns"))]),
    (README, "arrays have become {} times as fast since", [STEPS], lambda: ("%.0f" % (2.0 / ms("arrays")),)),

    # ---- results/README.md
    (RESULTS, "| {} runs whose last bits are the same under {} compilers, by 1, 2 and 4 threads, and one", [DETERMINISM],
     lambda: (str(equal_runs()), words(len({r["compiler"] for r in document(DETERMINISM)["rows"]})))),
    (RESULTS, "it takes the time of {} [{}, {}] removals.", [OPERATIONS],
     lambda: all_of(rebuild_over_removal())),
    (RESULTS, "The incremental arrays take {} [{}, {}] us.", [OPERATIONS],
     lambda: ["%.2f" % x for x in figure(operation("liver564", "remove", [2]))]),

    (RESULTS, "a step takes {} [{}, {}] of the naive graph's on the paper's body with damping", [STEP],
     lambda: all_of(step_over_graph("liver564, damped")) + judged([step_over_graph("liver564, damped")], 0.58, "cannot tell")),
    (RESULTS, "(target 0.58: cannot tell) and {} [{}, {}] without (target 0.50: cannot tell)", [STEP],
     lambda: all_of(step_over_graph("liver564, undamped")) + judged([step_over_graph("liver564, undamped")], 0.50, "cannot tell")),
    (RESULTS, "in rows of three {} [{}, {}] and {} [{}, {}].", [STEP],
     lambda: all_of(step_over_graph("liver564, damped", ": lanes")) + all_of(step_over_graph("liver564, undamped", ": lanes"))),
    (RESULTS, "shuffled order take {} [{}, {}] of the graph's step (target 0.25: holds)", [STEP],
     lambda: all_of(step_over_graph("10^6 shuffled")) + judged([step_over_graph("10^6 shuffled")], 0.25, "holds")),
    (RESULTS, "in grid order {} [{}, {}] (target 0.50: cannot tell)", [STEP],
     lambda: all_of(step_over_graph("10^6 in grid order")) + judged([step_over_graph("10^6 in grid order")], 0.50, "cannot tell")),
    (RESULTS, "processors {} [{}, {}] (target 0.30: cannot tell)", [STEP],
     lambda: all_of(step_over_graph("10^6 in grid order", ": threads", "wall_ns"))
     + judged([step_over_graph("10^6 in grid order", ": threads", "wall_ns")], 0.30, "cannot tell")),
    (RESULTS, "of a million tetrahedra at most {} times. A million in", [STEP], lambda: ("%.2f" % max(over_copying("10^6" + order) for order in ORDERS),)),
    (RESULTS, "in grid order and shuffled {} and {} times as fast as one (target 1.5: falls short)", [STEP],
     lambda: gains("10^5", ": padded", ": threads") + judged([gain("10^5" + order, ": padded", ": threads") for order in ORDERS], 1.5, "falls short", True)),
    (RESULTS, "a million {} and {} times (target 1.8: falls short)", [STEP],
     lambda: gains("10^6", ": padded", ": threads") + judged([gain("10^6" + order, ": padded", ": threads") for order in ORDERS], 1.8, "falls short", True)),
    (RESULTS, "copy columns as large only {} and {}, {} and {} times as fast as one", [STEP],
     lambda: gains("10^5", ": copy", ": copy by threads") + gains("10^6", ": copy", ": copy by threads")),
    (RESULTS, "step takes at most {} [{}, {}] of a fresh body's,", [STEP],
     lambda: all_of(over_fresh("10^5 in grid order"), three) + judged([over_fresh("10^5 in grid order")], 1.15, "holds")),
    (RESULTS, "and of a million at most {} [{}, {}] (target 1.15: cannot tell)", [STEP],
     lambda: all_of(over_fresh("10^6 in grid order"), three) + judged([over_fresh("10^6 in grid order")], 1.15, "cannot tell")),
    (RESULTS, "a step takes {} [{}, {}] of the step alone on the paper's body,", [STEP],
     lambda: all_of(changing_over("liver564, damped", FOLLOWED, ALONE), three)),
    (RESULTS, "which is {} [{}, {}] of the graph's that cannot change (target 0.58: falls short)", [STEP],
     lambda: all_of(changing_over("liver564, damped", FOLLOWED, GRAPH_ALONE))
     + judged([changing_over("liver564, damped", FOLLOWED, GRAPH_ALONE)], 0.58, "falls short")),
    (RESULTS, "on a million tetrahedra {} [{}, {}] of it (target 0.50: cannot tell)", [STEP],
     lambda: all_of(changing_over("10^6 in grid order", FOLLOWED, GRAPH_ALONE))
     + judged([changing_over("10^6 in grid order", FOLLOWED, GRAPH_ALONE)], 0.50, "cannot tell")),
    (RESULTS, "it takes {}, {}, {} and {} times as long;", [STEP],
     lambda: [two(changing_over(body, ALL_ANEW, FOLLOWED).median)
              for body in ("liver564, damped", "10^4 in grid order", "10^5 in grid order", "10^6 in grid order")]),

    (RESULTS, "cut finer, a thread took {}, {} and {} of the graph's time in rows of three and both processors {}, {} and {}.", [STEP_MESHES],
     lambda: meshes_over_graph(": lanes") + meshes_over_graph(": threads", "wall_ns")),

    (RESULTS, "take {} [{}, {}] s from the start of a run to its first step (target 5: cannot tell)", [LARGE_BODIES],
     lambda: all_of(part_of_run(70, "from the start to the first step"))
     + judged([part_of_run(70, "from the start to the first step")], 5, "cannot tell")),
    (RESULTS, "`mesh info` of a frame of them {} [{}, {}] s (target 4: falls short)", [LARGE_BODIES],
     lambda: all_of(part_of_run(70, "mesh info of the frame")) + judged([part_of_run(70, "mesh info of the frame")], 4, "falls short")),
    (RESULTS, "a map is built in {} and {} times the time of copying as many bytes and the whole of a run made in {} and {}", [LARGE_BODIES],
     lambda: ["%.0f" % x for x in over_limits("map built") + over_limits("simulation made, mesh and map included")]),
    (RESULTS, "A frame is made in {} and {} times that time, and read in {} and {} times that of its file, but written in {} and {}.", [LARGE_BODIES],
     lambda: ["%.0f" % x for x in over_limits("frame made") + over_limits("frame read")] + [two(x) for x in over_limits("frame written")]),
    (RESULTS, "a run is made in {} s, takes {} s a step and {} us for each of the {} faces of a cut, and {} GB at most.", [LARGE_BODIES],
     lambda: ("%.0f" % once("simulation made, mesh and map included"), two(once("a step")),
              "%.0f" % (1e6 * once("the cut, without the step") / counted_once()["operations"]),
              "{:,}".format(counted_once()["operations"]), two(1e-9 * counted_once()["peak_bytes"]))),
    (RESULTS, "on a map takes at most {} bytes a tetrahedron, without events {} (targets 300 and 190: hold).", [LARGE_BODIES],
     lambda: ("%.0f" % most_bytes("bytes"), "%.0f" % most_bytes("bytes_without_events"))),

    (RESULTS, "are left the restitution to within {} by Verlet", [BOUNCES], lambda: (two(worst_bounce()),)),
    (RESULTS, "by Verlet a box of {} kPa is left {} where half is asked for, and one of {} kPa {};", [BOUNCES],
     lambda: ("500", three(bounce("box, 500 kPa", 0.5)), "100", three(bounce("box, 100 kPa", 0.5)))),
    (RESULTS, "in [{} scenes drawn at random]", [BOUNCES], lambda: ("{:,}".format(len(drawn())),)),
    (RESULTS, "Of {} [scenes of contact drawn at random], by all integrators, {} ended regularly", [BOUNCES],
     lambda: ("{:,}".format(len(drawn())), str(len([r for r in drawn() if r["ended"]])))),
    (RESULTS, "all but {} of these by explicit Euler", [BOUNCES],
     lambda: (str(len([r for r in drawn() if not r["ended"] and r["integrator"] != "explicit-euler"])),)),
    (RESULTS, "pulled it, to {} of its speed, and no body another one by more than {}", [BOUNCES],
     lambda: (small(max(r["pulled"] for r in drawn() if not r["bodies"])), two(max(r["pulled"] for r in drawn() if r["bodies"])))),
    (RESULTS, "pushed upwards alone, to {} of the depth", [BOUNCES], lambda: (small(max(r["caught"] for r in drawn())),)),
    (RESULTS, "{} times something came through a plate", [BOUNCES],
     lambda: (str(len([r for r in drawn() if r["lost"]])) if all(r["warned"] for r in drawn() if r["lost"]) else "not all of them",)),
    (RESULTS, "Far from a plane a step over elements takes {} [{}, {}] of one without contact and far from the body itself {} [{}, {}]", [CONTACT],
     lambda: all_of(with_contact("elements far from a plane"), three) + all_of(with_contact("elements far from themselves"), three)
     + judged([with_contact("elements far from themselves")], 1.02, "falls short")),
    (RESULTS, "springs {} [{}, {}] and {} [{}, {}] (both fall short)", [CONTACT],
     lambda: all_of(with_contact("springs far from a plane"), three) + all_of(with_contact("springs far from themselves"), three)
     + judged([with_contact("springs far from a plane")], 1.02, "falls short")),
    (RESULTS, "After a full cut, contact takes {} [{}, {}] of the time", [CONTACT],
     lambda: all_of(with_contact("the liver, cut through", "contact", "elements"))
     + judged([with_contact("the liver, cut through", "contact", "elements")], 1.0, "falls short")),
    (RESULTS, "lists grow with the exponent {} and forces with {}, where n log n has {}: forces fall short", [CONTACT],
     lambda: tuple(three(x) for x in (growth_of_contact("list")[0].median, growth_of_contact("contact")[0].median,
                                      growth_of_contact("list")[1]))
     + judged([growth_of_contact("contact")[0]], growth_of_contact("list")[1], "falls short")),
    (RESULTS, "as a pair takes {} times longer", [CONTACT],
     lambda: (two(pair_of_contact("plates of 998784") / pair_of_contact("plates of 9600")),)),
    (RESULTS, "a solution needs {}, {} and {} times the", [CONTACT],
     lambda: [three(iterations_with_changes(scene)) for scene in ("boxes_stacked", "liver_pressed", "balls_roll")]),

    (RESULTS, "the vertex orbit falls short: it is {} [{}, {}] times as fast as CGAL's (target 20)", [TOPOLOGY],
     lambda: all_of(faster_than("CGAL", "liver564", "vertex-orbit"))
     + judged([faster_than("CGAL", "liver564", "vertex-orbit")], 20, "falls short", at_least=True)),
    (RESULTS, "and takes {} [{}, {}] ns a dart (target 3: cannot tell)", [TOPOLOGY],
     lambda: all_of(time(topology("liver564", "vertex-orbit"), "tetrahedral"))
     + judged([time(topology("liver564", "vertex-orbit"), "tetrahedral")], 3, "cannot tell")),
    (RESULTS, "on 48,000 tetrahedra it is {} [{}, {}] times as fast", [TOPOLOGY],
     lambda: all_of(faster_than("CGAL", "kuhn-48000", "vertex-orbit"))
     + judged([faster_than("CGAL", "kuhn-48000", "vertex-orbit")], 20, "holds", at_least=True)),
    (RESULTS, "The full check is {} and {} times as fast as CGAL's `is_valid` with attributes, which checks those too, and {} and {} "
     "times without.", [TOPOLOGY],
     lambda: (*("%.0f" % faster_than("CGAL", b, "full-check").median for b in ("liver564", "kuhn-48000")),
              *(two(faster_than("bare CGAL", b, "full-check").median) for b in ("liver564", "kuhn-48000")))),
    (RESULTS, "the general one takes {} and {} ns for the orbit", [TOPOLOGY],
     lambda: [two(time(topology(b, "vertex-orbit"), "general").median) for b in ("liver564", "kuhn-48000")]),

    (RESULTS, "a removal takes {} to {} us up to 2,058 tetrahedra and {} to {} from 48,000 on (target 10)", [OPERATIONS],
     lambda: tuple(map(two, medians(SMALL, "remove") + medians(LARGE, "remove")))
     + judged([figure(operation(b, "remove")) for b in LARGE], 10, "falls short")),
    (RESULTS, "a torn fan {} to {} and {} to {} (20)", [OPERATIONS],
     lambda: tuple(map(two, medians(SMALL, "tear fan") + medians(LARGE, "tear fan")))
     + judged([figure(operation(b, "tear fan")) for b in LARGE], 20, "falls short")),
    (RESULTS, "Of a dissociation along a cut, {} to {} with intervals from {} to {}, the run cannot tell (5);", [OPERATIONS],
     lambda: tuple(map(two, medians(SMALL + LARGE, "dissociate, cut"))) + cut_ends()
     + judged([figure(operation(b, "dissociate, cut")) for b in SMALL + LARGE], 5, "cannot tell")),
    (RESULTS, "a random one of a million tetrahedra, {} [{}, {}], falls short.", [OPERATIONS],
     lambda: all_of(figure(operation("kuhn-998250", "dissociate, random"))) + judged([figure(operation("kuhn-998250", "dissociate, random"))], 5, "falls short")),
    (RESULTS, "the one grows {} [{}, {}] times (1.5: cannot tell), the other {} [{}, {}] times (2.5: cannot tell)", [OPERATIONS],
     lambda: (two(growth("dissociate, cut").median), "%.2f" % growth("dissociate, cut").low, two(growth("dissociate, cut").high))
     + all_of(growth("dissociate, random")) + judged([growth("dissociate, cut")], 1.5, "cannot tell")
     + judged([growth("dissociate, random")], 2.5, "cannot tell")),

    (RESULTS, "Events, map and output cost {} [{}, {}] % of a step (target 0.5)", [ABLATION],
     lambda: (*percent(ratio(lines(ABLATION), "simulation", "watched loop")),
              *judged([ratio(lines(ABLATION), "simulation", "watched loop")], 1.005, "cannot tell"))),
    (RESULTS, "watch on speeds {} [{}, {}]: of neither can this run tell", [ABLATION],
     lambda: (*percent(ratio(lines(ABLATION), "watched loop", "loop and detector")),
              *judged([ratio(lines(ABLATION), "watched loop", "loop and detector")], 1.005, "cannot tell"))),
    (RESULTS, "the detector of divergence costs {} [{}, {}] (holds)", [ABLATION],
     lambda: (*percent(ratio(lines(ABLATION), "loop and detector", "loop")),
              *judged([ratio(lines(ABLATION), "loop and detector", "loop")], 1.005, "holds"))),
    (RESULTS, "one spring at a time the integrator takes {} [{}, {}] % less.", [ABLATION],
     lambda: less_than(ratio(lines(ABLATION), "loop", "plain loop"))),
    (RESULTS, "`liver_cut` takes {} [{}, {}] times its integrator's own time where another thread writes the files (target 1.5: holds)", [ABLATION],
     lambda: all_of(with_output(", written by another thread"), three) + judged([with_output(", written by another thread")], 1.5, "holds")),
    (RESULTS, "and {} [{}, {}] by one thread:", [ABLATION], lambda: all_of(with_output(""), three)),

    (RESULTS, "methods {}, {} and {} % too low for 512, 1,728 and 4,096 vertices (target 25)", [SOLVERS],
     lambda: ["%.0f" % (-100 * crossover(n)[0]) for n in (512, 1728, 4096)]),
    (RESULTS, "the last is {} to {} % too low, so the run cannot tell", [SOLVERS],
     lambda: ["%.0f" % (-100 * x) for x in crossover(4096)[1:]]
     + list(judged([Figure(0, min(crossover(n)), max(crossover(n))) for n in (512, 1728, 4096)], -0.25, "cannot tell", at_least=True))),
    (RESULTS, "A step by conjugate gradients takes {} [{}, {}] ms on the paper's body at h omega_max = 2.83 (target 0.9), {} at 10 and {} "
     "at 100; with a kept factor {} to {}.", [SOLVERS],
     lambda: (*all_of(solver_step("2.83", "conjugate gradients")), *(two(solver_step(h, "conjugate gradients").median) for h in ("10", "100")),
              *(two(end([solver_step(h, "kept factor").median for h in ("2.83", "10", "100")])) for end in (min, max)),
              *judged([solver_step("2.83", "conjugate gradients")], 0.9, "holds"))),
    (RESULTS, "To follow a dissociation is {} to {} times as fast as to factor again (targets 2, and 4 for 4,096 vertices, of which "
     "[{}, {}] cannot tell)", [SOLVERS],
     lambda: (*(two(end([f.median for f in followings()])) for end in (min, max)), *ends(following(4096)[0]),
              *judged(following(512) + following(1728), 2, "holds", at_least=True),
              *judged(following(4096), 4, "cannot tell", at_least=True))),

    (RESULTS, "springs miss the work at the tip by {} %, tetrahedra by {} % and hexahedra by {} %; of 3,321 nodes by {}, {} and {} %.",
     [ELEMENTS], lambda: [beam(model, nodes, "tip") for nodes in (525, 3321)
                          for model in ("springs", "neo-hookean tetrahedra", "neo-hookean hexahedra")]),
    (RESULTS, "In torsion springs are {} % too slow", [ELEMENTS], lambda: ("%.0f" % -float(beam("springs", 3321, "torsion")),)),
    (RESULTS, "four at a time, neo-Hookean tetrahedra take {} times as long as springs, corotational ones {} times and neo-Hookean hexahedra {} times",
     [ELEMENTS], lambda: [slower_than_springs(m) for m in ("neo-hookean tetrahedra", "corotational tetrahedra", "neo-hookean hexahedra")]),
    (RESULTS, "Of {} errors that a reference could judge {} were met ({} %, [{}, {}], target 95: cannot tell).", [AUDIT, AUDIT_CLAIMS],
     lambda: (str(len(resolved())), str(len(met())), *share_in(claim_of_audit("recommend-error")))),
    (RESULTS, "One was missed by {} %, and two of `sheet_cut` by factors of {} and {}:", [AUDIT],
     lambda: ("%.1f" % (100 * (missed("scene 16")[0] - 1)), *("%.0f" % m for m in missed("sheet_cut")))),
    (RESULTS, "{} of {} times were within 15 % ({} %, [{}, {}], target 95: cannot tell).", [AUDIT, AUDIT_CLAIMS],
     lambda: (str(len(in_time())), str(len(picked())), *share_in(claim_of_audit("recommend-time")))),
    (RESULTS, "The median regret of the {} pairs with a sweep was {} [{}, {}] (target 1.2: cannot tell), the largest {}.", [AUDIT],
     lambda: (str(len(regrets())), *all_of(figure(regrets()), three), three(max(regrets())), *judged([figure(regrets())], 1.2, "cannot tell"))),
    (RESULTS, "{} errors could not be judged: {} are below what their reference is sure of, {} are of scenes that are followed for their costs.", [AUDIT],
     lambda: (words(len([a for a in picked() if not a["resolved"]])).capitalize(),
              words(len([a for a in picked() if not a["resolved"] and a["floor"] is not None])),
              words(len([a for a in picked() if not a["resolved"] and a["floor"] is None])))),
    (RESULTS, "{} picks were not followed, predicted to take {} to {} s, and for {} errors nothing was found within the 40 s", [AUDIT],
     lambda: (words(len(too_long())).capitalize(), "%.0f" % min(too_long()), "{:,.0f}".format(max(too_long())),
              words(len([a for a in lines(AUDIT) if "no pilots" in a["confidence"]])))),
    (RESULTS, "those of `balls_roll` took {} times its run of {} s (target 20 % of runs longer than 5 s: falls short)", [AUDIT],
     lambda: next((digits(a["pilot_s"] / a["actual_s"], 2), digits(a["actual_s"], 2)) for a in picked() if a["actual_s"] > 5)),

    (RESULTS, "on {} bodies of one material, at most {} % below", [EXTREMES + "frequencies.md"],
     lambda: (words(len(frequencies())), "%.1f" % max(float(r["upper"].split()[0]) for r in frequencies()))),
    (RESULTS, "In {} unstable runs the energy", [EXTREMES + "measurements.json"],
     lambda: (str(len(document(EXTREMES + "measurements.json")["detection"])),)),
    (RESULTS, "hexahedra are the cheapest for frequencies nearer than {} %", [MODELS + "cheapest.md"],
     lambda: (next(r["errors"].split(" %")[0] for r in rows_of(MODELS + "cheapest.md")
                   if r["question"] == "frequencies" and r["Poisson's ratio"] == "0.25" and r["the cheapest"] == "springs"),)),
    (RESULTS, "Springs have the tip within 10 % in {} {} of the time of hexahedra", [MODELS + "claims.json"],
     lambda: (claim_of_models("models-springs-coarse")["measured"], claim_of_models("models-springs-coarse")["bound_or_interval"].split(" at")[0])),
    (RESULTS, "that cannot expand sideways: {} at a ratio of 0.45.", [MODELS + "claims.json"], lambda: (claim_of_models("models-springs-confined")["measured"],)),
    (RESULTS, "sure of tip and frequencies to {}, of the motion to {}.", [MODELS + "claims.json", MODELS + "references.md"],
     lambda: (claim_of_models("models-reference")["measured"], max((r["motion by"] for r in rows_of(MODELS + "references.md")), key=lambda m: float(m.split()[0])))),
    (RESULTS, "Cell arrays cost {} [{}, {}] times the graph (the paper: at most 1.10: holds)", [STEPS],
     lambda: (*all_of(ratio(lines(STEPS), "arrays", "graph"), lambda x: "%.2f" % x), *judged([ratio(lines(STEPS), "arrays", "graph")], 1.10, "holds"))),
    (RESULTS, "was slower, {} [{}, {}] times the graph: the paper's 1.10 is on the border", ["results/2026-11-23-epyc-paper/samples.jsonl"],
     lambda: all_of(ratio(lines("results/2026-11-23-epyc-paper/samples.jsonl"), "arrays", "graph"), lambda x: "%.2f" % x)),
    (RESULTS, "Through {} random operations on {} bodies, two of them meshes of SOFA, by {} laws, no separation changed an energy by a bit, "
              "a removal took that of its cell to {} of the whole, and bodies built anew differed by at most {} of what was summed", OPERATED,
     lambda: ("{:,}".format(sum(o["dissociated"] + o["removed"] for o in operated())), words(len({o["body"] for o in operated()})),
              words(len({o["model"] for o in operated()})), "%.1e" % max(o["removal"] for o in operated()) if not any(o["dissociation"] for o in operated()) else "",
              "%.1e" % max(o[what] for o in operated() for what in ("energy", "force", "mass")))),
    (RESULTS, "Of {} pairs of a motion and an error, {} were runs that cost {} to {} times their pilots, which had seen {} to {} % of the motion.",
     [FORETOLD], lambda: (str(len(lines(FORETOLD))), str(len(foretold())),
                          *("%.0f" % f(a["actual_s"] / a["pilot_s"] for a in foretold()) for f in (min, max)),
                          *("%.2f" % (100 * f(a["seen_part"] for a in foretold())) for f in (min, max)))),
    (RESULTS, "Of {} scenes without contact {} met the error that was asked for, and no cost was predicted more than {} % wrong", [VERDICTS],
     lambda: (str(len(lines(VERDICTS))), str(sum(a["met"] for a in lines(VERDICTS))),
              "%.1f" % (100 * max(abs(a["predicted_cost"] / a["actual_cost"] - 1) for a in lines(VERDICTS)) + 0.05))),
    (RESULTS, "to 10^6: of {} runs none is wrong without a word. {} are judged by the motion, {} by the steps of their", [SCENES],
     lambda: (("{:,}".format(len(lines(SCENES))) if all(a["outcome"] not in ("SILENT", "CRASH") for a in lines(SCENES)) else "no"),
              "{:,}".format(judged_by("motion")), str(judged_by("scheme")))),
    (RESULTS, "scheme, {} are stopped or refused with a diagnosis. {} are judged by no more", [SCENES],
     lambda: (str(judged_by("diagnosis")), str(judged_by("survival")))),
    (RESULTS, "{} of the 25 scenes of the gallery", [SCENES], lambda: (str(len({a["scene"] for a in lines(SCENES)})),)),
    (RESULTS, "Of {} scenes {} have a cheapest method for an error of 1e-3, by {} different integrators", [TRADES],
     lambda: (str(len(lines(TRADES))), str(len(cheapest(1e-3))), str(len(set(cheapest(1e-3)))))),
    (RESULTS, "that comes to rest cost {} times what the cheapest method takes.", [VERDICTS],
     lambda: ("%.0f" % max(a["actual_cost"] / a["best_cost"] for a in lines(VERDICTS)),)),
    (RESULTS, "All {} errors were met, and all {} times as printed were within 15 % ({} without a miss show {} %;", [FORETOLD],
     lambda: (str(len([a for a in foretold() if a["told"] and a["actual_error"] <= a["error"]])),
              str(len([a for a in foretold() if abs(a["printed_s"] / a["actual_s"] - 1) <= 0.15])), str(len(foretold())),
              "%.0f" % (100 * share_at_least(len(foretold()), len(foretold()))))),
    (RESULTS, "The rest: {} cost less, {} would have taken longer than 15 s", [FORETOLD],
     lambda: (str(len([a for a in lines(FORETOLD) if a["pick"] and not a["foretold"]])),
              str(len([a for a in lines(FORETOLD) if not a["pick"] and "too long to follow" in a["confidence"]])))),
    (RESULTS, "its median is {} [{}, {}] times that of the cheapest setting", [FORETOLD],
     lambda: ("%.0f" % median([times_the_best(a) for a in foretold()]),
              *(digits(e, 2) if e < 10 else "%.0f" % e for e in interval([times_the_best(a) for a in foretold()])[:2]))),
    (RESULTS, "is without damping, the cost was {} to {} times", [FORETOLD],
     lambda: ["%.2f" % f(times_the_best(a) for a in foretold() if a["scene"].endswith(" 9")) for f in (min, max)]),
    (RESULTS, "for at most {} steps before it was reported (target 64)", [EXTREMES + "detection.md"],
     lambda: (str(max(int(r["most steps above"]) for r in rows_of(EXTREMES + "detection.md"))),)),
    (RESULTS, "at 1.01 times its limit is found at step {} of the run, at 1.003 at step {}, at 1.001 at step {}.",
     [EXTREMES + "measurements.json"], lambda: ["{:,}".format(detected(f)) for f in (1.01, 1.003, 1.001)]),

    (RESULTS, "{} wrong integrators in all {} methods", [JUDGES],
     lambda: (words(len({t["wrong"] for t in document(JUDGES)["trials"]})).capitalize(), str(len(document(JUDGES)["slack"])))),
    (RESULTS, "in {} % of the runs called right in which being wrong makes a difference", [JUDGES], lambda: ("%.1f" % (100 * seen()),)),
    (RESULTS, "off by up to {} eps D after 100 steps ({}; implicit methods by up to {})", [EXTREMES + "extremes.jsonl"],
     lambda: ("%.0f" % offset(False)[0], {"blanes-moan-4": "Blanes-Moan"}[offset(False)[1]], "%.0f" % offset(True)[0])),
]

PAPER = "what the paper says"
NAME = "a name or a place"

# page, piece, and source: PAPER, NAME, or a file of ours and words of it
NO_MEASUREMENT = [
    (README, "*3-dimensional generalized map*", NAME),
    (README, "(Meseure, Darles, Skapin, VRIPHYS 2010)", PAPER),
    (README, "VRIPHYS 2010, pp. 1-10, hal-00563396", PAPER),
    (README, "On Debian 12, with nothing installed", NAME),
    (README, "GPL-3.0-or-later", NAME),
    (README, "| 2010 | ratio | here | ratio |", PAPER),
    (README, "one dart of a cell holds its data | 12 ms | 6 |", PAPER),
    (README, "one dart holds | 8 ms | 4 |", PAPER),
    (README, "| **map, cell arrays (section 5.2)** | 2 ms | <= 1.10 |", PAPER),
    (README, "| plain arrays: an indexed graph | 2 ms | 1 |", PAPER),

    (RESULTS, "from 2,000 to 1,000,000 tetrahedra", NAME),
    (RESULTS, "(the paper: at most 1.10: holds)", PAPER),
    (RESULTS, "(target 0.58: cannot tell) and", ("benchmarks/studies/step/bench_step_report.cpp", "most_damped = 0.58")),
    (RESULTS, "without (target 0.50: cannot tell)", ("benchmarks/studies/step/bench_step_report.cpp", "most_undamped = 0.50")),
    (RESULTS, "(target 0.25: holds)", ("benchmarks/studies/step/bench_step_report.cpp", "most_shuffled = 0.25")),
    (RESULTS, "(target 0.50: cannot tell) and by both", ("benchmarks/studies/step/bench_step_report.cpp", "most_in_order = 0.50")),
    (RESULTS, "(target 0.30: cannot tell). Both", ("benchmarks/studies/step/bench_step_report.cpp", "most_by_threads = 0.30")),
    (RESULTS, "Both processors step 100,000 tetrahedra", NAME),
    (RESULTS, "as fast as one (target 1.5: falls", ("benchmarks/studies/step/bench_step_report.cpp", "least_gain_medium = 1.5")),
    (RESULTS, "times (target 1.8: falls short)", ("benchmarks/studies/step/bench_step_report.cpp", "least_gain_large = 1.8")),
    (RESULTS, "[After 1, 10 and 50 %] of 100,000 tetrahedra", ("benchmarks/studies/step/changed_bodies.cpp", "{0.01, 0.10, 0.50}")),
    (RESULTS, "(target 1.15: cannot tell)", ("benchmarks/studies/step/changed_report.cpp", "most_after_changes = 1.15")),
    (RESULTS, "that cannot change (target 0.58: falls short)", ("benchmarks/studies/step/changing_report.cpp", "most_changing_liver = 0.58")),
    (RESULTS, "of it (target 0.50: cannot tell).", ("benchmarks/studies/step/changing_report.cpp", "most_changing_large = 0.50")),
    (RESULTS, "edits known beforehand is 1.37 to 1.61", ("benchmarks/studies/step/changing_report.cpp", '"1.37 to 1.61"')),
    (RESULTS, "(target 1.02: both fall short)", ("benchmarks/studies/contact/bench_contact_report.cpp", "most_idle = 1.02")),
    (RESULTS, "of neo-Hookean forces (target 1)", ("benchmarks/studies/contact/bench_contact_report.cpp", "most_after_cut = 1.0")),
    (RESULTS, "times as fast as CGAL's (target 20)", ("benchmarks/studies/topology/bench_topology_report.cpp", '"ns per dart", 1.0, 3.0, 20.0}')),
    (RESULTS, "ns a dart (target 3: cannot tell)", ("benchmarks/studies/topology/bench_topology_report.cpp", '"ns per dart", 1.0, 3.0, 20.0}')),
    (RESULTS, "on 48,000 tetrahedra", NAME),
    (RESULTS, "up to 2,058 tetrahedra", NAME),
    (RESULTS, "from 48,000 on (target 10)", ("benchmarks/studies/operations/bench_operations_report.cpp", '"remove", {"remove"}, 10.0')),
    (RESULTS, "to 30 (20).", ("benchmarks/studies/operations/bench_operations_report.cpp", '"tear-fan", {"tear fan"}, 20.0')),
    (RESULTS, "the run cannot tell (5); a", ("benchmarks/studies/operations/bench_operations_report.cpp", '"dissociate, random"}, 5.0')),
    (RESULTS, "From 2,058 to 998,250 tetrahedra", NAME),
    (RESULTS, "times (1.5: cannot tell)", ("benchmarks/studies/operations/bench_operations_report.cpp", 'std::pair("dissociate, cut", 1.5)')),
    (RESULTS, "times (2.5: cannot tell)", ("benchmarks/studies/operations/bench_operations_report.cpp", 'std::pair("dissociate, random", 2.5)')),
    (RESULTS, "% of a step (target 0.5)", ("benchmarks/studies/scenes/ablation_study.cpp", "at_most(figure, 1.005)")),
    (RESULTS, "for 512, 1,728 and 4,096 vertices (target 25)", ("benchmarks/studies/solvers/solver_report.cpp", "crossover_gate = 0.25")),
    (RESULTS, "at h omega_max = 2.83 (target 0.9)", ("benchmarks/studies/solvers/solver_report.cpp", "step_gate_ms = 0.9")),
    (RESULTS, "at 10 and 2.0 at 100;", ("benchmarks/studies/solvers/solver_study.cpp", "{2.83, 10.0, 100.0}")),
    (RESULTS, "(targets 2, and 4 for 4,096 vertices,", ("benchmarks/studies/solvers/solver_report.cpp", "large ? 4.0 : 2.0")),
    (RESULTS, "On a clamped beam of 525 nodes", NAME),
    (RESULTS, "of 3,321 nodes by", NAME),
    (RESULTS, "times were within 15 %", ("benchmarks/studies/tradeoff/audit_report.cpp", "cost_margin = 0.15")),
    (RESULTS, "target 95: cannot tell). One", ("benchmarks/studies/tradeoff/audit_report.cpp", "part_asked = 0.95")),
    (RESULTS, "target 95: cannot tell). The median", ("benchmarks/studies/tradeoff/audit_report.cpp", "part_asked = 0.95")),
    (RESULTS, "(target 1.2: cannot tell), the", ("benchmarks/studies/tradeoff/audit_report.cpp", "most_regret = 1.2")),
    (RESULTS, "within the 40 s", ("benchmarks/studies/tradeoff/audit_plan.cpp", "whole_runs_s = 40.0")),
    (RESULTS, "(target 20 % of", ("benchmarks/studies/tradeoff/audit_report.cpp", "most_pilots = 0.2")),
    (RESULTS, "of runs longer than 5 s", ("benchmarks/studies/tradeoff/audit_report.cpp", "long_run_s = 5.0")),
    (RESULTS, "`dartboard recommend --audit --seed 20261129`", NAME),
    (RESULTS, "promised: 40 drawn, 4 long ones and", ("benchmarks/studies/tradeoff/audit_plan.cpp", "{40, 2, 2, 2, 2}")),
    (RESULTS, "runs them: 40 that are drawn,", ("benchmarks/studies/tradeoff/audit_plan.cpp", "{40, 2, 2, 2, 2}")),
    (RESULTS, "with errors from 0.01 to 0.00001 edges.", ("benchmarks/studies/tradeoff/audit_plan.cpp", "1e-2, 1e-5")),
    (RESULTS, "at a Poisson's ratio of 1/4, and springs", NAME),
    (RESULTS, "within 5 % the two cannot be told apart", ("benchmarks/studies/models/models_report.cpp", "fine = 0.05")),
    (RESULTS, "`dartboard validate elements --operations 100000`", NAME),
    (RESULTS, "`dartboard recommend --audit --long --seed 616779`", NAME),
    (RESULTS, "as printed were within 15 % (", ("benchmarks/studies/tradeoff/audit_report.cpp", "cost_margin = 0.15")),
    (RESULTS, "target 95: cannot tell). The rest", ("benchmarks/studies/tradeoff/audit_report.cpp", "part_asked = 0.95")),
    (RESULTS, "taken longer than 15 s and", ("benchmarks/studies/tradeoff/audit_study.cpp", "longest_run_s = 15.0")),
    (RESULTS, "of a sweep (target 1.2).", ("benchmarks/studies/tradeoff/audit_report.cpp", "most_regret = 1.2")),
    (RESULTS, "before it was reported (target 64)", ("benchmarks/studies/extremes/extremes_report.cpp", '"all; <= 64"')),
    (RESULTS, "Verlet at 1.01 times its limit", NAME),
    (RESULTS, "at 1.003 at step", NAME),
    (RESULTS, "at 1.001 at step", NAME),
    (RESULTS, "at most 1,200 steps of the eighth order", ("validation/extremes/motion_truth.h", "most_truth_steps = 1200")),
    (RESULTS, "runs of 40 bodies drawn", ("tests/validation/extremes/step_evidence_test.cpp", "k < 40")),
    (RESULTS, "eps D after 100 steps", NAME),
    (RESULTS, "for an accuracy), each in 100 steps by all", ("validation/extremes/scene_extremes.cpp", "steps_in_all = 100")),
    (RESULTS, "others, from h omega = 0.1 to 10^6", ("validation/extremes/scene_extremes.cpp", "{0.1, 0.5, 1.0, 1.9, 2.5, 30.0, 1e3, 1e6}")),
    (RESULTS, "compilers, by 1, 2 and 4 threads, and one number", ("tests/determinism/determinism_table.py", '"2 threads": ["--threads", "2"], "4 threads": ["--threads", "4"]')),
    (RESULTS, "witnesses with dense factors stop at 200 vertices", ("validation/extremes/scene_extremes.cpp", "largest_dense = 200")),
    (RESULTS, "that of local-global in steps of 10^6", NAME),
    (RESULTS, "at most 134,217,728 tetrahedra, or 2^30 darts", NAME),
    (RESULTS, "promised on x86-64", NAME),
]
