#!/usr/bin/env python3
"""Does each source keep its types to itself?   own_types_test.py [FOLDER]

Two sources that never see each other compile and link with two types of one name, which then share constructors and
whatever else the linker takes for the same. That headers define a name once is checked by the compiler, in one source
that includes them all (tests/CMakeLists.txt). A type that a source defines must be in its unnamed namespace, or be a
part of a class of a header (struct CgalBody::Complex). The formatter sets both at the beginning of a line.
"""

import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ("core", "reference", "validation", "benchmarks", "tests")
DEFINED = re.compile(r"(?:template <.*> )?(?:inline|concept|(?:struct|class|union|enum(?: class)?) [\w<>, ]+(?: :(?!:).*| final.*)? \{)")


def shared_definitions(lines):
    """The lines that define a name for other sources, with their numbers."""
    own = False
    for number, line in enumerate(lines, 1):
        if re.match(r"namespace( dartboard(::\w+)*::\w+_test)? \{", line):
            own = True  # of the source; each test has a namespace named after its file
        elif line.startswith("}  // namespace"):
            own = False
        elif not own and DEFINED.match(line):
            yield number, line.rstrip()


def main(folder):
    found, sources = [], 0
    for place in (os.path.join(folder, room) for room in ROOMS):
        for path, _, names in os.walk(place):
            for name in (name for name in sorted(names) if name.endswith(".cpp")):
                sources += 1
                file = os.path.join(path, name)
                with open(file, encoding="utf-8") as text:
                    found += [f"{os.path.relpath(file, folder)}:{number}: {line}" for number, line in shared_definitions(text)]
    assert sources > 400, "where are the sources?"
    for line in found:
        print(f"{line}\n  is a name for all sources; expected one in an unnamed namespace, or in a header")
    return 1 if found else 0


def fails_as_it_should():
    """One of each kind that must be found, and what must not be."""
    found = ["struct T {", "template <class U> class T final : public B {", "enum class E : int {", "inline int f() { return 1; }"]
    not_found = ["struct T;", "struct A::T {", "template <class U>", "int f(struct T* t) {", "template class T<int>;"]
    assert [line for _, line in shared_definitions(found)] == found
    assert not list(shared_definitions(not_found))
    assert not list(shared_definitions(["namespace {", "struct T {", "}  // namespace"]))
    assert list(shared_definitions(["namespace {", "}  // namespace", "struct T {"]))


if __name__ == "__main__":
    fails_as_it_should()
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else ROOT))
