#!/usr/bin/env python3
"""Copy the files that hold a fault of a list into a folder, with every fault compiled in behind a switch.

    make_faulty_tree.py SOURCE_ROOT FAULT_LIST OUTPUT

The switch is the environment variable DARTBOARD_FAULT: the number of the fault that is on (or of two, with a comma), or
unset. The sources themselves know nothing of this. Files whose text would not change are left alone, so that only changed ones are compiled
again. A snippet that is not found exactly once is an error: whoever changes the line changes the fault with it.

A list is blocks of `key: value` lines, parted by empty lines; lines that begin with # are comments.

    fault:   what is wrong, as a phrase
    file:    where, from the root of the project
    right:   a snippet of the file that occurs once in it, or in `in`; statements end in ; or }
    wrong:   what replaces it with the fault on
    in:      (optional) a longer snippet that occurs once in the file and holds `right`
    claim:   (optional) the claims of claims.json that this fault is about, as patterns: update-*

and how it is noticed, one of

    killer:  the full name of the gtest that fails
    run:     the arguments of a run of the whole program that ends with 0 while nothing is wrong; {scenes} is the folder
             of scenes next to the list, {out} a fresh folder
    says:    with `run`: what that run prints with the fault on, and not without it
    status:  (optional) with `run`: the exit status with the fault on [1]
    hides:   the name of another fault that has a `run`: this one is in the judge, and with both on that run no longer
             ends as its block demands, so that the block notices

Standard library only, and of it only what Debian's python3-minimal has.
"""

import os
import re
import sys

SWITCH = """#pragma once
// Made by tests/faults/make_faulty_tree.py: which seeded fault is on.

#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace dartboard {

struct ChosenFaults {
  int one = 0, other = 0;
  ChosenFaults() {
    if (const char* numbers = std::getenv("DARTBOARD_FAULT")) std::sscanf(numbers, "%d,%d", &one, &other);
  }
};
inline const ChosenFaults chosen_faults;

/// Constant expressions stay right: they cannot be switched when the program runs.
constexpr bool fault(int number) {
  return !std::is_constant_evaluated() && (number == chosen_faults.one || number == chosen_faults.other);
}

}  // namespace dartboard
"""


class Mistake(Exception):
    """The list of faults is malformed or no longer fits the sources."""


class Fault:
    """One block of the list."""

    FIELDS = ("fault", "file", "in", "right", "wrong", "claim", "killer", "run", "says", "status", "hides")
    REQUIRED = ("fault", "file", "right", "wrong")

    def __init__(self, fields, line):
        self.number, self.line = number_of(fields["fault"]), line
        self.name, self.file = fields["fault"], fields["file"]
        self.right, self.wrong = fields["right"], fields["wrong"]
        self.context = fields.get("in", self.right)
        self.claims = fields.get("claim", "").split()
        self.killer, self.run, self.says = fields.get("killer"), fields.get("run"), fields.get("says")
        self.status = int(fields.get("status", "1"))
        self.hides = fields.get("hides")
        self.is_statement = self.right.endswith((";", "}"))

    def mistake(self):
        """What its fields contradict each other in, or None."""
        if bool(self.killer) + bool(self.run) + bool(self.hides) != 1:
            return "has none or more than one of killer, run and hides: choose one"
        if bool(self.run) != bool(self.says):
            return "has a run that says nothing, or says something in no run"
        return None

    def place(self, text):
        """The positions of `right` in the text of the file: begin and end."""
        begin = self._find_once(text, self.context, self.file)
        begin += self._find_once(self.context, self.right, "its 'in' line")
        return begin, begin + len(self.right)

    def _find_once(self, text, snippet, where):
        count = text.count(snippet)
        if count != 1:
            found = "is not there any more" if count == 0 else "occurs %d times" % count
            raise Mistake("line %d: fault '%s' is stale: in %s the snippet\n    %s\n  %s, expected once" %
                          (self.line, self.name, where, snippet, found))
        return text.index(snippet)


def number_of(name):
    """FNV-1a, 31 bits: adding or removing a fault keeps the numbers of the others, and so their copies."""
    number = 2166136261
    for byte in name.encode():
        number = (number ^ byte) * 16777619 & 0xFFFFFFFF
    return number >> 1


def read_faults(path):
    """The faults of a list, in its order."""
    faults, fields, begin = [], {}, 0

    def finish():
        if not fields:
            return
        missing = [key for key in Fault.REQUIRED if key not in fields]
        if missing:
            raise Mistake("%s:%d: this fault has no '%s'" % (path, begin, missing[0]))
        fault = Fault(dict(fields), begin)
        if any(f.number == fault.number for f in faults):
            raise Mistake("%s:%d: a second fault of the name '%s', or of its number" % (path, begin, fault.name))
        if fault.mistake():
            raise Mistake("%s:%d: fault '%s' %s" % (path, begin, fault.name, fault.mistake()))
        faults.append(fault)
        fields.clear()

    with open(path, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            if line.startswith("#"):
                continue
            if not line.strip():
                finish()
                continue
            match = re.match(r"(\w+): *(.*)", line)
            if not match or match[1] not in Fault.FIELDS or match[1] in fields:
                raise Mistake("%s:%d: expected one line each of some of %s" % (path, number, ", ".join(Fault.FIELDS)))
            begin = begin if fields else number
            fields[match[1]] = match[2].rstrip()
    finish()
    runs = {f.name for f in faults if f.run}
    for f in faults:
        if f.hides and f.hides not in runs:
            raise Mistake("%s:%d: fault '%s' hides none that has a run" % (path, f.line, f.name))
    return faults


def switched(faults, right):
    """The snippet that is one of the faults' `wrong`, by what is chosen, or `right`."""
    if faults[0].is_statement:
        choices = ["if (fault(%d)) { %s } else " % (f.number, f.wrong) for f in faults]
        return "{ %s{ %s } }" % ("".join(choices), right)
    choices = ["fault(%d) ? (%s) : " % (f.number, f.wrong) for f in faults]
    return "(%s(%s))" % ("".join(choices), right)


def with_faults(text, faults):
    """The text of a file with its faults compiled in. Several may share a snippet, or lie within a larger one."""
    places, stale = {}, []
    for fault in faults:
        try:
            places.setdefault(fault.place(text), []).append(fault)
        except Mistake as mistake:
            stale.append(str(mistake))
    if stale:
        raise Mistake("\n".join(stale))
    # from the smallest to the largest, so that one that encloses others finds them done
    edits = []  # in the present text: begin, end, replacement
    for (begin, end), group in sorted(places.items(), key=lambda item: item[0][1] - item[0][0]):
        inside = [e for e in edits if begin <= e[0] and e[1] <= end]
        if any(e[0] < end and begin < e[1] and e not in inside for e in edits):
            raise Mistake("line %d: fault '%s' overlaps another: choose the same snippet, or one within it" %
                          (group[0].line, group[0].name))
        right = replaced(text[begin:end], [(b - begin, e - begin, new) for b, e, new in inside])
        edits = [e for e in edits if e not in inside] + [(begin, end, switched(group, right))]
    return '#include "fault.h"\n' + replaced(text, edits)


def replaced(text, edits):
    for begin, end, new in sorted(edits, reverse=True):
        text = text[:begin] + new + text[end:]
    return text


def sources_below(root, folders):
    """Every .h and .cpp, by its path from the root."""
    found = []
    for folder in folders:
        for place, _, names in os.walk(os.path.join(root, folder)):
            found += [os.path.relpath(os.path.join(place, name), root) for name in names if name.endswith((".h", ".cpp"))]
    return sorted(found)


def write_if_changed(path, text):
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main(source_root, fault_list, output):
    of_file = {}
    for fault in read_faults(fault_list):
        of_file.setdefault(fault.file, []).append(fault)
    # all or nothing: a mistake must not leave a tree that is partly new
    texts, mistakes = {"fault.h": SWITCH}, []
    for path, faults in sorted(of_file.items()):
        try:
            with open(os.path.join(source_root, path), encoding="utf-8") as file:
                texts[path] = with_faults(file.read(), faults)
        except FileNotFoundError:
            mistakes.append("line %d: fault '%s' is stale: there is no %s" % (faults[0].line, faults[0].name, path))
        except Mistake as mistake:
            mistakes.append(str(mistake))
    if mistakes:
        raise Mistake("adapt %s to the new sources\n%s" % (fault_list, "\n".join(mistakes)))
    for path, text in texts.items():
        write_if_changed(os.path.join(output, path), text)
    # a copy of a file that holds no fault any more would still be found before the file itself
    for folder, _, names in os.walk(output):
        for name in names:
            if os.path.relpath(os.path.join(folder, name), output) not in texts:
                os.remove(os.path.join(folder, name))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except Mistake as mistake:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), mistake))
