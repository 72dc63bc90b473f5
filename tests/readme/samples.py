"""What committed studies have measured, and figures derived from them again by other code than that which measured: order statistics, paired
ratios and their intervals over processes, as benchmarks/harness/paired.h and statistics.h define them. Standard library only."""

import collections
import functools
import gzip
import json
import math
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

Figure = collections.namedtuple("Figure", "median low high")


used = set()  # files that were read


def read(path):
    used.add(path)
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def measured(path, verb):
    """The samples that processes of that verb have printed."""
    return [sample for sample in outputs(path) if sample["verb"] == verb]


@functools.lru_cache(maxsize=None)
def outputs_of(path):
    with gzip.open(os.path.join(ROOT, path), "rt", encoding="utf-8") as file:
        processes = [json.loads(line) for line in file]
    return [dict(json.loads(line), verb=one["arguments"][0]) for one in processes[1:] for line in one["lines"] if line.startswith("{")]


def outputs(path):
    used.add(path)
    return outputs_of(path)


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
