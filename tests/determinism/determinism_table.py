#!/usr/bin/env python3
"""Do runs end in the same bits whatever compiler and flags the program was built with?

Builds `state_hashes` once for each row of a table, in folders of its own, runs it twice, then with more threads and
one number at a time, and compares its output with the pinned hashes. Writes determinism.md and determinism.json.
Builds are kept in the work folder, so that an interrupted table is continued. Some 25 minutes of one core with two
compilers.
"""

import argparse
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys

NATIVE = "-O3 -DNDEBUG -march=native"
# name, flags, protected, sanitized
ROWS = [
    ("debug", "-g -O0", True, False),
    ("O1", "-O1", True, False),
    ("O2", "-O2", True, False),
    ("release", "-O3 -DNDEBUG", True, False),
    ("bench", NATIVE, True, False),
    ("asan", "-O1 -g", True, True),
    ("unprotected", NATIVE, False, False),
]
# one protective flag left out at a time, by compiler
ORDER = " -DEIGEN_DONT_VECTORIZE -DEIGEN_UNROLLING_LIMIT=0"
ROWS_OF = {
    "clang": [("packets", NATIVE + " -ffp-contract=off", False, False)],
    "g++": [("packets", NATIVE + " -ffp-contract=off -fno-tree-slp-vectorize", False, False),
            ("slp", NATIVE + " -ffp-contract=off" + ORDER, False, False)],
}
# other ways to run what a row has built
MANNERS = {"2 threads": ["--threads", "2"], "4 threads": ["--threads", "4"],
           "one number at a time": ["--one-by-one"],
           "one number at a time, 4 threads": ["--one-by-one", "--threads", "4"]}


def output(command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def folder_of(options, compiler, row):
    return options.work / f"{pathlib.Path(compiler).name}-{row[0]}"


def program_of(options, compiler, row):
    return folder_of(options, compiler, row) / "tests" / "determinism" / "state_hashes"


def build(options, compiler, row):
    """Build state_hashes; returns the program."""
    name, flags, protected, sanitized = row
    folder = folder_of(options, compiler, row)
    cmake = ["cmake", "-S", str(options.source), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
             f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_CXX_FLAGS={flags}", "-DDARTBOARD_PRECOMPILE=ON",
             f"-DDARTBOARD_EQUAL_BITS={'ON' if protected else 'OFF'}",
             f"-DDARTBOARD_SANITIZE={'ON' if sanitized else 'OFF'}"]
    for command in (cmake, ["cmake", "--build", str(folder), "--target", "state_hashes", "-j", str(options.jobs)]):
        result = output(command)
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{result.stdout[-4000:]}{result.stderr[-4000:]}")
    return program_of(options, compiler, row)


def hashes(program, *arguments, **environment):
    """The hashes that the program prints, by name of the run. Status 1 means that some hash differs from the pinned one."""
    result = output([str(program), *arguments], env={**os.environ, **environment})
    if result.returncode not in (0, 1) or result.stderr:
        sys.exit(f"{program} ended with status {result.returncode}:\n{result.stderr}")
    found = dict(reversed(line.split(" ", 1)) for line in result.stdout.splitlines())
    return found, result.returncode == 0


def facts(options):
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    commit = output(["git", "-C", str(options.source), "rev-parse", "HEAD"]).stdout.strip()
    changed = output(["git", "-C", str(options.source), "status", "--porcelain", "--untracked-files=no"]).stdout != ""
    return {"commit": commit + (" with changes" if changed else ""), "cpu": cpu.group(1) if cpu else platform.machine(),
            "libc": " ".join(platform.libc_ver())}


def blas_of(program):
    """The library that BLAS calls go to."""
    found = re.search(r"libblas\S* => (\S+)", output(["ldd", str(program)]).stdout)
    return pathlib.Path(found.group(1)).resolve().parent.name if found else "unknown"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--work", type=pathlib.Path, required=True, help="folder for the builds")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder to write to, new or empty")
    parser.add_argument("--compilers", nargs="+", default=["g++", "clang++", "clang++-14"], help="those there are")
    parser.add_argument("--rows", nargs="+", help="names of the rows [all]")
    parser.add_argument("--built", action="store_true", help="only rows that are built: an interrupted table so far")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    if options.out.exists() and any(options.out.iterdir()):
        sys.exit(f"{options.out} is not empty: nothing is overwritten")

    rows, right, blas = [], True, None
    for compiler in options.compilers:
        if not shutil.which(compiler):
            continue
        version = output([compiler, "--version"]).stdout.splitlines()[0]
        for row in ROWS + ROWS_OF["clang" if "clang" in version else "g++"]:
            name, flags, protected, sanitized = row
            if options.rows and name not in options.rows:
                continue
            if options.built and not program_of(options, compiler, row).exists():
                continue
            program = build(options, compiler, row)
            first, pinned = hashes(program)
            again, _ = hashes(program)
            others = {manner: hashes(program, *arguments)[0] for manner, arguments in MANNERS.items()}
            differing = sorted(manner for manner, other in others.items() if other != first)
            rows.append({"compiler": version, "name": name, "flags": flags, "protected": protected,
                         "sanitized": sanitized, "equals_pinned": pinned, "repeats": first == again,
                         "manners_that_differ": differing, "hashes": first})
            right = right and first == again and (pinned and not differing or not protected)
            print(f"{version}, {name}: {'equal' if pinned else 'DIFFERS'}", flush=True)
            if blas is None and protected:
                # Runs without a supernodal factor must not depend on the kernels that the BLAS has chosen.
                other = {"OPENBLAS_CORETYPE": "Nehalem"}
                blas = {"library": blas_of(program), "simplicial_sees_kernels": hashes(program, **other)[0] != first,
                        "supernodal_sees_kernels":
                            hashes(program, "--supernodal")[0] != hashes(program, "--supernodal", **other)[0]}
                right = right and not blas["simplicial_sees_kernels"]
    if not rows:
        sys.exit("no compiler, or no row of that name")

    about = facts(options)
    reference = next((row["hashes"] for row in rows if row["equals_pinned"]), rows[0]["hashes"])
    lines = ["# Equal bits, by compiler and flags", "",
             f"{len(reference)} runs in each row, all of them twice; {about['cpu']}, {about['libc']}.", "",
             "| compiler | flags | protective flags | runs that end in the pinned bits | repeats "
             f"| {' | '.join(MANNERS)} |", "|---|---|---|---:|---|" + len(MANNERS) * "---|"]
    for row in rows:
        equal = sum(row["hashes"].get(run) == value for run, value in reference.items())
        guard = "yes" if row["protected"] else "no"
        flags = row["flags"] + (" -fsanitize=address,undefined" if row["sanitized"] else "")
        same = ["other bits" if manner in row["manners_that_differ"] else "same bits" for manner in MANNERS]
        lines.append(f"| {row['compiler']} | `{flags}` | {guard} | {equal} of {len(reference)} | "
                     f"{'yes' if row['repeats'] else 'NO'} | {' | '.join(same)} |")
    lines += ["", "The first columns are of one thread, which takes four numbers at a time where the processor has AVX2. Several "
              "threads share bodies that are large enough, here one of 48,000 tetrahedra.", "",
              f"Protective flags: `-ffp-contract=off`, `{ORDER.strip()}`, and with GCC where the target has FMA "
              "`-fno-tree-slp-vectorize` (`core/cmake/DartboardOptions.cmake` says why). Rows without them, or with some of "
              "them only, show what they are for.", ""]
    if blas:
        says = {True: "other bits", False: "the same bits"}
        lines += [f"BLAS: {blas['library']}. With `OPENBLAS_CORETYPE=Nehalem` the runs above end in "
                  f"{says[blas['simplicial_sees_kernels']]}, a run with a supernodal factor in "
                  f"{says[blas['supernodal_sees_kernels']]}.", ""]
    lines += ["Not covered: other processors than this one, other C libraries (step-size control and `stable_step` call "
              "`pow` and `log`), supernodal factors, whose bits are those of the BLAS and its kernels.",
              "", "| run | hash |", "|---|---|"]
    lines += [f"| {run} | `{value}` |" for run, value in reference.items()]
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "determinism.md").write_text("\n".join(lines) + "\n")
    (options.out / "determinism.json").write_text(json.dumps({**about, "blas": blas, "rows": rows}, indent=1) + "\n")
    print(f"{'Equal wherever promised.' if right else 'NOT equal everywhere.'} Written to {options.out}.")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
