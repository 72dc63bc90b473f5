"""Committed samples, and figures derived from them again by other code than that which measured: order statistics, paired
ratios and their intervals over processes, as benchmarks/harness/paired.h and statistics.h define them. Standard library only."""

import collections
import json
import math
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

Figure = collections.namedtuple("Figure", "median low high")


used = set()  # files that were read


def read(path):
    used.add(path)
    return content(path, str)


def lines(path):
    """One sample each."""
    used.add(path)
    return content(path, lambda text: [json.loads(line) for line in text.splitlines()])


def document(path):
    used.add(path)
    return content(path, json.loads)


kept = {}  # parsed files


def content(path, parse):
    key = path, getattr(parse, "__code__", parse)
    if key not in kept:
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            kept[key] = parse(file.read())
    return kept[key]


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def interval(values, confidence=0.95):
    """Interval of the population's median, by order statistics. Too few values have none."""
    values = sorted(values)
    n = len(values)
    coverage = lambda k: 1 - 2 * sum(math.comb(n, j) for j in range(k)) / 2 ** n
    k = 1
    while 2 * (k + 1) <= n and coverage(k + 1) >= confidence:
        k += 1
    if coverage(k) < confidence:
        raise ValueError("%d values have no interval at %g" % (n, confidence))
    return values[k - 1], values[n - k]


def figure(values):
    return Figure(median(values), *interval(values))


def share_at_least(good, drawn):
    """The lower end of the interval of Clopper and Pearson at 95 %, by halving."""
    if good == 0:
        return 0.0
    tail = lambda p: sum(math.comb(drawn, k) * p ** k * (1 - p) ** (drawn - k) for k in range(good, drawn + 1))
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if tail(middle) < 0.025 else (low, middle)
    return low


def by_process(rows):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[row["process"]].append(row)
    return [groups[process] for process in sorted(groups)]


def cost(row):
    """Processor time of a unit of work [ns]."""
    return row["cpu_ns"] / row.get("units", row.get("steps", 1))


def time(rows, task):
    """Time of a unit [ns]: the median over processes of the median over rounds."""
    return figure([median([cost(r) for r in rows if r["task"] == task]) for rows in by_process(rows)])


def ratios(rows, task, baseline):
    """For each process the median over rounds of the ratio within a round."""
    values = []
    for process in by_process(rows):
        rounds = collections.defaultdict(dict)
        for row in process:
            rounds[row["round"]][row["task"]] = cost(row)
        values.append(median([r[task] / r[baseline] for r in rounds.values()]))
    return values


def ratio(rows, task, baseline):
    """Median over processes."""
    return figure(ratios(rows, task, baseline))


def verdict(figures, bound, at_least=False):
    """Of a target that all figures have to keep: by the whole of their intervals."""
    kept = [(f.low >= bound if at_least else f.high <= bound) for f in figures]
    missed = [(f.high < bound if at_least else f.low > bound) for f in figures]
    return "falls short" if any(missed) else "holds" if all(kept) else "cannot tell"
