"""Draw mutants: a room's share of the sample by its number of sites, each site alike, each change of a site alike."""

import hashlib
import os
import random

LEAST_PER_ROOM = 40  # fewer would say nothing about a small room


def room_of(file):
    return file.split("/")[0]


def sub_room_of(file):
    """core's rooms one by one, the others whole."""
    parts = file.split("/")
    return "/".join(parts[:2]) if parts[0] == "core" else parts[0]


def shares(sites, count):
    """How many mutants each room gets."""
    of_room = {}
    for site in sites:
        of_room[room_of(site["file"])] = of_room.get(room_of(site["file"]), 0) + 1
    least = min(LEAST_PER_ROOM, count // (2 * len(of_room)))
    return {room: max(least, round(count * n / len(sites))) for room, n in sorted(of_room.items())}


def key_of(file, line_text, edits, text):
    """A name of a mutant that stays as long as its line and its change stay, wherever the line and the file move to."""
    changes = "|".join("%s>%s" % (text[begin:end].decode(), new) for begin, end, new in edits)
    return hashlib.sha256("\n".join([os.path.basename(file), line_text, changes]).encode()).hexdigest()[:12]


def draw(sites, texts, count, seed, spare=0.25):
    """The mutants in the order in which they are drawn, room by room, with some to spare for those that do not compile.

    `texts` holds the bytes of each file. Each mutant is {id, room, file, line, kind, edits, before, after, key, ...}."""
    mutants = []
    for room, wanted in shares(sites, count).items():
        here = [site for site in sites if room_of(site["file"]) == room]
        chance = random.Random("%d %s" % (seed, room))
        for site in chance.sample(here, min(len(here), wanted + max(4, int(spare * wanted)))):
            mutant = {k: v for k, v in site.items() if k != "edits"}
            mutant["edits"] = chance.choice(site["edits"])
            text = texts[site["file"]]
            begin, end = mutant["edits"][0][0], mutant["edits"][-1][1]
            line_begin = text.rfind(b"\n", 0, begin) + 1
            line_end = text.find(b"\n", end)
            line_end = len(text) if line_end < 0 else line_end
            lines = text[line_begin:line_end].decode()
            mutant["room"] = room
            mutant["before"] = " ".join(lines.split())
            changed = text[line_begin:line_end]
            for b, e, new in sorted(mutant["edits"], reverse=True):
                changed = changed[:b - line_begin] + new.encode() + changed[e - line_begin:]
            mutant["after"] = " ".join(changed.decode().split())
            mutant["key"] = key_of(site["file"], mutant["before"], mutant["edits"], text)
            mutants.append(mutant)
    for number, mutant in enumerate(mutants, 1):
        mutant["id"] = number
    return mutants
