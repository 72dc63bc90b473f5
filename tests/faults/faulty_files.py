#!/usr/bin/env python3
"""The files that a list of faults makes to be compiled again, for CMake: two lists in its own notation, one a line.

    faulty_files.py SOURCE_ROOT FAULT_LIST FOLDER...

The files that hold a fault; then the sources among the folders that hold one, or include a file that does. All other
sources are the same with and without the faults, so that their objects can be taken as they are.

Standard library only.
"""

import os
import re
import sys

from make_faulty_tree import Mistake, read_faults, sources_below


def main(root, fault_list, *folders):
    faulty = sorted({fault.file for fault in read_faults(fault_list)})
    includes = {}
    for path in sources_below(root, folders):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            includes[path] = set(re.findall(r'^#include "(.+)"', file.read(), re.M))
    touched, before = set(faulty), 0
    while len(touched) != before:
        before = len(touched)
        touched |= {path for path, included in includes.items() if included & touched}
    print(";".join(faulty))
    print(";".join(sorted(path for path in touched if path.endswith(".cpp"))))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except Mistake as mistake:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), mistake))
