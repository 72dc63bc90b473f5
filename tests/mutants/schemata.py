"""All mutants in one program: each change behind a switch that is read when the program starts.

An expression becomes `(on(n) ? (wrong) : (right))`, a statement `{ if (on(n)) { wrong } else { right } }`. Lines keep
numbers, so that the compiler's messages on the copy hold for the source.
"""

import os

SWITCH_H = """#pragma once
// Made by tests/mutants: which mutant is on, and which were reached.
#include <type_traits>

namespace dartboard_mutants {

extern int chosen;
extern unsigned char* reached;

inline bool on(int number) {
  reached[number] = 1;
  return number == chosen;
}

/// For code that the compiler may evaluate: there it stays right.
constexpr bool on_at_run_time(int number) { return !std::is_constant_evaluated() && on(number); }

template <class T>
concept Lazy = requires(const T& x) {
  typename T::PlainObject;
  x.eval();
};

/// The value of an expression of Eigen's, whose types differ with the operator; anything else as it is.
template <class T>
  requires(!Lazy<std::remove_cvref_t<T>>)
constexpr T plain(T&& x) {
  return static_cast<T&&>(x);
}
template <class T>
  requires(Lazy<std::remove_cvref_t<T>>)
constexpr auto plain(T&& x) {
  return typename std::remove_cvref_t<T>::PlainObject(x);
}

}  // namespace dartboard_mutants
"""

# Linked into every program. A table in shared memory keeps the record of reached mutants when a program crashes or has children.
SWITCH_CPP = """#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace dartboard_mutants {

constexpr int size = 1 << 16;
unsigned char own_table[size];
int chosen = 0;
unsigned char* reached = own_table;

// before any object of static storage is made
__attribute__((constructor(101))) void read_switches() {
  if (const char* number = getenv("DARTBOARD_MUTANT")) chosen = atoi(number);
  const char* path = getenv("DARTBOARD_REACHED");
  if (!path) return;
  const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0 || ftruncate(file, size) != 0) return;
  void* table = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (table != MAP_FAILED) reached = static_cast<unsigned char*>(table);
  close(file);
}

}  // namespace dartboard_mutants
"""


def one_line(text):
    return " ".join(text.split("\n"))


def switched(changes, right):
    """`right`, or the change that is on. `changes` holds (mutant, new text) of one place."""
    statement = any("statement" in mutant for mutant, _ in changes)
    on = ["dartboard_mutants::%s(%d)" % ("on_at_run_time" if mutant.get("constant") else "on", mutant["id"])
          for mutant, _ in changes]
    if statement:
        choices = ["if (%s) { %s } else " % (test, one_line(new)) for test, (_, new) in zip(on, changes)]
        return "{ %s{ %s } }" % ("".join(choices), right)
    wrap = "(%s)"
    if any(mutant["kind"] == "condition" for mutant, _ in changes):
        wrap = "static_cast<bool>(%s)"
    elif any(mutant.get("value") for mutant, _ in changes):
        wrap = "dartboard_mutants::plain(%s)"
    choices = ["%s ? %s : " % (test, wrap % one_line(new)) for test, (_, new) in zip(on, changes)]
    return "(%s%s)" % ("".join(choices), wrap % right)


def with_mutants(text, mutants):
    """The bytes of a file with these mutants compiled in. Places lie apart, or one within the other."""
    places, constants = {}, {}
    for mutant in mutants:
        for begin, end, new in mutant["edits"]:
            places.setdefault((begin, end), []).append((mutant, new))
        if "constexpr_at" in mutant:
            begin, end, new = mutant["constexpr_at"]
            constants[begin, end] = new
    edits = [(begin, end, new.encode()) for (begin, end), new in constants.items()]
    for (begin, end), changes in sorted(places.items(), key=lambda item: item[0][1] - item[0][0]):
        inside = [e for e in edits if begin <= e[0] and e[1] <= end]
        right = replaced(text[begin:end], [(b - begin, e - begin, new) for b, e, new in inside]).decode()
        edits = [e for e in edits if e not in inside] + [(begin, end, switched(changes, right).encode())]
    return replaced(text, edits)


def replaced(text, edits):
    for begin, end, new in sorted(edits, reverse=True):
        text = text[:begin] + new + text[end:]
    return text


prefix = b""  # for every file with mutants, if the command line does not include the switch


def write_tree(tree, texts, mutants):
    """Writes the files that differ from those there. `texts` holds the sources without mutants."""
    of_file = {}
    for mutant in mutants:
        of_file.setdefault(mutant["file"], []).append(mutant)
    for file, text in texts.items():
        new = prefix + with_mutants(text, of_file[file]) if file in of_file else text
        path = os.path.join(tree, file)
        with open(path, "rb") as old:
            if old.read() == new:
                continue
        with open(path, "wb") as out:
            out.write(new)
