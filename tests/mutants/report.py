"""The killed mutants, by room, with an interval."""

import math

from draw import sub_room_of


def wilson(killed, judged, z=1.96):
    """The 95 % interval of a share, after Wilson (1927): right for few and for shares near 1, too."""
    if judged == 0:
        return 0.0, 1.0
    p, zz = killed / judged, z * z
    middle = (p + zz / (2 * judged)) / (1 + zz / judged)
    half = z / (1 + zz / judged) * math.sqrt(p * (1 - p) / judged + zz / (4 * judged * judged))
    return max(0.0, middle - half), min(1.0, middle + half)


def read_equivalents(path):
    """Mutants that no test can kill, as {key: reason}: lines `KEY FILE: REASON`."""
    found = {}
    with open(path, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            if not line.strip() or line.startswith("#"):
                continue
            key, _, rest = line.strip().partition(" ")
            file, colon, reason = rest.partition(": ")
            if len(key) != 12 or not colon or not reason.strip():
                raise ValueError("%s:%d: expected KEY FILE: REASON" % (path, number))
            found[key] = reason.strip()
    return found


COLUMNS = ["room", "sites", "drawn", "not compiled", "compile time only", "equivalent", "counted", "killed", "not reached",
           "survived", "share killed", "95 % interval"]


def outcome(mutant, results, dropped, equivalents):
    if mutant["id"] in dropped:
        return "not compiled"
    if mutant["key"] in equivalents:
        return "equivalent"
    result = results.get(mutant["id"])
    if result is None:
        return "not judged yet"
    if result["killer"]:
        return "killed"
    if result["reached_by"]:
        return "survived"
    return "compile time only" if mutant.get("constant") or "constexpr_at" in mutant else "not reached"


def counts(mutants, results, dropped, equivalents, room_of):
    rooms = {}
    for mutant in mutants:
        row = rooms.setdefault(room_of(mutant["file"]), {})
        kind = outcome(mutant, results, dropped, equivalents)
        row[kind] = row.get(kind, 0) + 1
        row["drawn"] = row.get("drawn", 0) + 1
    return rooms


def counted(row):
    """The base of the share: all drawn mutants, including those that do not compile or are not reached, except equivalents."""
    return row.get("drawn", 0) - row.get("equivalent", 0) - row.get("not judged yet", 0)


def row_of(name, row, sites):
    killed, judged = row.get("killed", 0), counted(row)
    low, high = wilson(killed, judged)
    return [name, sites, row["drawn"], row.get("not compiled", 0), row.get("compile time only", 0), row.get("equivalent", 0),
            judged, killed, row.get("not reached", 0), row.get("survived", 0),
            "%.1f %%" % (100 * killed / judged) if judged else "-", "%.0f to %.0f %%" % (100 * low, 100 * high)]


def weighted(rows, sites):
    """The share over all rooms, weighted by their sites: small rooms are drawn from more often than their share."""
    judged = {room: counted(row) for room, row in rows.items()}
    total = sum(sites[room] for room, n in judged.items() if n)
    if not total:
        return "nothing drawn" if not rows else "nothing judged yet"
    share = variance = 0.0
    for room, n in judged.items():
        if n:
            p, w = rows[room].get("killed", 0) / n, sites[room] / total
            share += w * p
            variance += w * w * p * (1 - p) / n
    half = 1.96 * math.sqrt(variance)
    return "%.1f %% of all (%.1f to %.1f %%)" % (100 * share, 100 * (share - half), 100 * min(1, share + half))


def table(mutants, results, dropped, equivalents, sites_of_room):
    """Markdown: the rooms, and core's one by one."""
    lines = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    whole = counts(mutants, results, dropped, equivalents, lambda file: file.split("/")[0])
    parts = counts(mutants, results, dropped, equivalents, sub_room_of)
    for room in sorted(whole):
        lines.append("| " + " | ".join(map(str, row_of(room, whole[room], sites_of_room.get(room, 0)))) + " |")
        for part in sorted(p for p in parts if p.startswith(room + "/")):
            lines.append("| " + " | ".join(map(str, row_of(part, parts[part], sites_of_room.get(part, 0)))) + " |")
    return "\n".join(lines) + "\n\nKilled: " + weighted(whole, sites_of_room) + "\n"


def survivors(mutants, results, dropped, equivalents, tests_of=None):
    """Markdown by room: the changes that passed, and how much of the suite ran over each unnoticed."""
    by_room = {}
    for mutant in mutants:
        kind = outcome(mutant, results, dropped, equivalents)
        if kind not in ("survived", "not reached"):
            continue
        result = results[mutant["id"]]
        text = "- `%s:%d` %s, key %s, %s\n  - before: `%s`\n  - after:  `%s`\n" % (
            mutant["file"], mutant["line"], mutant["kind"], mutant["key"],
            "reached by no test" if kind == "not reached" else "reached by %d tests" % result["reached_by"] +
            (", %d of them too slow to be run" % len(result["not_run"]) if result["not_run"] else ""),
            mutant["before"], mutant["after"])
        if tests_of:
            text += "".join("  - reached by %s\n" % name for name in tests_of(mutant))
        by_room.setdefault(sub_room_of(mutant["file"]), []).append(text)
    return by_room
