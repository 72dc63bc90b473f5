#!/usr/bin/env python3
"""Count the instructions of each section of the driver under callgrind, and compare them with the committed counts.

It fails when it is more than 4 %
above the committed count, and also when it is more than 10 % below: then the improvement is to be committed
(--update), or it could be lost again unnoticed. Shared libraries of another version may change a count by a few parts in a
thousand (malloc, memcpy), hence the 4 %; another compiler may change it by far more, so with a compiler other than that
of the counts the test is skipped (exit status 77).
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ABOVE, BELOW = 0.04, 0.10
SKIPPED = 77


def count(options, section):
    """Instructions of a section: the driver collects them from there alone."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        command = [options.valgrind, "--tool=callgrind", "--collect-atstart=no", f"--callgrind-out-file={out}", options.driver,
                   section]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{' '.join(command)} ended with status {run.returncode}:\n{run.stderr}")
        summary = re.search(r"^summary:\s*(\d+)", out.read_text(), re.MULTILINE)
        if summary is None:
            sys.exit(f"callgrind wrote no summary for {section}")
        return int(summary.group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--valgrind", default="valgrind")
    parser.add_argument("--driver", required=True, help="the program kernel_instructions")
    parser.add_argument("--counts", required=True, type=pathlib.Path, help="counts.json")
    parser.add_argument("--compiler", required=True, help="what built the driver: 'GCC 12.2.0'")
    parser.add_argument("--update", action="store_true", help="write the counts instead of comparing with them")
    options = parser.parse_args()

    committed = json.loads(options.counts.read_text()) if options.counts.exists() else None
    if not options.update:
        if committed is None:
            sys.exit(f"{options.counts} is missing: make it with --update")
        if committed["compiler"] != options.compiler:
            print(f"skipped: counted with {committed['compiler']}, this is {options.compiler}")
            return SKIPPED

    sections = subprocess.run([options.driver, "--list"], capture_output=True, text=True, check=True).stdout.split()
    if "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
        print("sections in lanes are left out: this processor has no AVX2")
        sections = [section for section in sections if not section.endswith("-in-lanes")]
    counts = {section: count(options, section) for section in sections}

    if options.update:
        options.counts.write_text(json.dumps({"compiler": options.compiler, "instructions": counts}, indent=2) + "\n")
        print(f"wrote {options.counts}")
        return 0

    expected = {name: number for name, number in committed["instructions"].items()
                if name in sections or not name.endswith("-in-lanes")}
    bad = sorted(set(expected) ^ set(counts))
    for section in bad:
        print(f"{section}: only in {'the counts' if section in expected else 'the driver'}: update the counts")
    for section in sorted(set(expected) & set(counts)):
        change = counts[section] / expected[section] - 1.0
        verdict = "ok"
        if change > ABOVE:
            verdict = f"FAILS: more than {ABOVE:.0%} above"
        elif change < -BELOW:
            verdict = "FAILS: improve the baseline (target update_instruction_counts)"
        if verdict != "ok":
            bad.append(section)
        print(f"{section:28}{counts[section]:12,}  committed {expected[section]:12,}  {change:+7.2%}  {verdict}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
