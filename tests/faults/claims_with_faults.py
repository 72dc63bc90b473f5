#!/usr/bin/env python3
"""Demand that every claim on the page of the committed studies has a fault that is about it.

    claims_with_faults.py FAULT_LIST PAGE

A claim without one may be answered by a judge that cannot say no. Standard library only.
"""

import fnmatch
import re
import sys

from make_faulty_tree import Mistake, read_faults


def main(fault_list, page):
    patterns = {pattern for fault in read_faults(fault_list) for pattern in fault.claims}
    with open(page, encoding="utf-8") as file:
        rows = re.findall(r"^<tr data-verdict=.*?^</tr>", file.read(), re.M | re.S)
    claims = {re.search(r"<code>(.*?)</code>", row)[1] for row in rows}
    bare = sorted(claim for claim in claims if not any(fnmatch.fnmatch(claim, pattern) for pattern in patterns))
    for claim in bare:
        print("%s: no fault of %s is about it: no block has it in a 'claim' line" % (claim, fault_list))
    print("%d of %d claims have a fault" % (len(claims) - len(bare), len(claims)))
    return 1 if bare or not claims else 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except Mistake as mistake:
        sys.exit("%s: %s" % (sys.argv[0], mistake))
