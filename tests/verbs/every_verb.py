#!/usr/bin/env python3
"""Run a verb of the program once, as quickly as it goes, and check all that it prints and writes.

    every_verb.py PROGRAM VERB...      run these ("validate topology" is one): in CI under the sanitizers, too
    every_verb.py PROGRAM --listed VERB...
                                       these are the verbs that the program's own --help names, and all of them

A run must end with an exit status that its verb promises, without a report of a sanitizer, without NaN or infinity,
and its output with --json must parse.

Standard library only, and of it only what Debian's python3-minimal has.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time


def imports(module):
    """Can `python3` of the PATH import it?"""
    python = shutil.which("python3")
    silence = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return python is not None and subprocess.run([python, "-c", "import " + module], check=False, **silence).returncode == 0


# The arguments that keep a verb short, and the exit statuses that are right. 1 is right if a claim is about seconds: a
# machine that is busy, or a sanitizer, may make it fall short.
AGREES, MAY_BE_SLOW = (0,), (0, 1)
RUNS = {
    "reproduce": [(["--part", "paper", "--quick", "--json", "--out", "OUT"], AGREES)],
    "validate topology": [([mesh, "--quick", "--operations", "50", "--json"], AGREES) for mesh in ("mixed_box", "pinched_drum")],
    "validate conservation": [(["LIVER", "--quick", "--operations", "50", "--json"], AGREES)],
    # an optional package
    "validate contact": [(["--quick", "--json", "--out", "OUT"] + ["--with", "ipctk"] * imports("ipctk"), AGREES)],
    "validate drawn": [(["--count", "10", "--json", "--out", "OUT"], AGREES),
                       (["sheet_cut", "--steps", "20", "--json", "--out", "OUT"], AGREES)],
    "validate order": [(["--quick", "--integrator", "rk4", "sdirk2", "--json", "--out", "OUT"], AGREES),
                       (["vertex_tear", "chain", "--quick", "--integrator", "verlet", "sdirk2", "--json", "--out", "OUT"], AGREES)],
    "validate solvers": [(["--quick", "--json", "--only", "accuracy", "edits", "updates", "--out", "OUT"], MAY_BE_SLOW)],
    "validate judges": [(["--quick", "--json", "--out", "OUT"], AGREES)],
    "validate elements": [(["--quick", "--json", "--out", "OUT"], AGREES),
                          (["mixed_box", "--operations", "50", "--json", "--out", "OUT"], AGREES)] +
                         # an optional package
                         [(["--quick", "--with", "calculix", "--json", "--out", "OUT"], AGREES)] * bool(shutil.which("ccx")),
    "bench ablation": [(["--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "bench topology": [(["--quick", "--json", "--only", "liver564", "--out", "OUT"], MAY_BE_SLOW)],
    "bench operations": [(["--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "bench contact": [(["--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "bench large": [(["--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "bench step": [(["--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "simulate": [(["sheet_cut", "--quick", "--picture", "--out", "OUT"], AGREES),
                 (["liver_cut", "--quick", "--json", "--player", "PAGE"], AGREES)],
    "scene": [(["--schema"], AGREES), (["--keys"], AGREES), (["--check", "liver_cut"], AGREES)],
    "tradeoff": [(["chain", "--quick", "--json", "--out", "OUT"], AGREES),
                 (["--models", "cantilever", "--quick", "--json", "--out", "OUT"], AGREES)],
    "recommend": [(["chain", "--error", "1e-3", "--verify"], AGREES),
                  (["cantilever", "--error", "0.5", "--against", "truth"], AGREES),
                  (["--audit", "--quick", "--json", "--out", "OUT"], MAY_BE_SLOW),
                  (["--audit", "--long", "--quick", "--json", "--out", "OUT"], MAY_BE_SLOW)],
    "extremes": [(["--axis", axis, "--quick", "--json", "--out", "OUT"], AGREES) for axis in ("absolute", "detection", "events")]
    + [(["chain_hanging", "bar_of_elements", "--quick", "--json", "--out", "OUT"], AGREES)],
    "explain": [(["sheet_cut"], AGREES), (["sheet_cut", "--measure", "--json"], AGREES)],
    "explain-dt": [(["sheet_cut"], AGREES), (["sheet_cut", "--json"], AGREES)],
    "gallery": [(["--json", "--out", "OUT"], AGREES)],
    "report": [(["STUDY"], AGREES), (["STUDY", "--json"], AGREES), (["STUDY", "--check"], AGREES)],
    "compare": [(["STUDY", "STUDY"], AGREES), (["STUDY", "STUDY", "--json"], AGREES)],
    "mesh info": [(["LIVER"], AGREES), (["LIVER", "--out", "OUT"], AGREES), (["LIVER", "--json"], AGREES)],
    "list": [([], AGREES), (["--json"], AGREES)],
}

REPORT = re.compile(r"AddressSanitizer|LeakSanitizer|UndefinedBehaviorSanitizer|runtime error:")
NO_NUMBER = re.compile(r"(?<![\w-])-?(nan|inf)(?![\w-])")  # as numbers are printed; in sentences it is "NaN"
# pages have libraries in them; their data are those of findings.json
TEXTS = (".csv", ".json", ".jsonl", ".txt", ".vtu", ".pvd", ".svg")


def verbs_of(program, above=()):
    """The verbs without verbs below them, as --help names them."""
    text = subprocess.run([program, *above, "--help"], check=True, capture_output=True, text=True).stdout
    _, _, below = text.partition("\nSubcommands:\n")
    names = re.findall(r"^  (\S+)", below.partition("\n\n")[0], re.M)
    return [verb for name in names for verb in verbs_of(program, (*above, name))] if names else [" ".join(above)]


def lines_with(pattern, text):
    return [line.strip() for line in text.splitlines() if pattern.search(line)]


def complaints(program, verb, arguments, right):
    """The faults of one run."""
    folder = tempfile.mkdtemp(prefix="verb-")
    out = os.path.join(folder, "out")
    liver = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../benchmarks/meshes/liver564.mesh")
    study, page = os.path.join(folder, "study"), os.path.join(folder, "page.html")
    words = [{"OUT": out, "LIVER": liver, "STUDY": study, "PAGE": page}.get(word, word) for word in arguments]
    if "STUDY" in arguments:
        subprocess.run([program, "bench", "operations", "--quick", "--out", study], capture_output=True)  # 0 or 1, by its times
    environment = dict(os.environ, ASAN_OPTIONS="exitcode=99", UBSAN_OPTIONS="exitcode=99:print_stacktrace=1")
    start = time.monotonic()
    run = subprocess.run([program, *verb.split(), *words], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                         capture_output=True)
    printed, aside = run.stdout.decode(), run.stderr.decode()  # the output is UTF-8
    print("%s %s: exit status %d in %.1f s" % (verb, " ".join(arguments), run.returncode, time.monotonic() - start))
    wrong = []
    if run.returncode not in right:
        wrong.append("exit status %d, not %s:\n%s" % (run.returncode, " or ".join(map(str, right)), (printed + aside)[-4000:]))
    wrong += ["a sanitizer reports: " + line for line in lines_with(REPORT, printed + aside)]
    wrong += ["prints no number: " + line for line in lines_with(NO_NUMBER, printed + aside)]
    if "--json" in arguments or "--schema" in arguments:
        try:
            json.loads(printed)
        except ValueError as error:
            wrong.append("prints JSON that does not parse: %s\n%s" % (error, printed[:2000]))
    elif not printed.strip():
        wrong.append("prints nothing")
    if "OUT" in arguments and not (os.path.isdir(out) and os.listdir(out)):
        wrong.append("leaves nothing in the folder of --out")
    for where, _, names in os.walk(folder):
        for name in names:
            if name.endswith(TEXTS):
                with open(os.path.join(where, name), encoding="utf-8") as file:
                    wrong += ["writes no number into %s: %s" % (name, line[:200]) for line in lines_with(NO_NUMBER, file.read())]
    beside = [name for name in os.listdir(folder) if name != "out"]
    if "OUT" in arguments and beside:
        wrong.append("leaves %s beside the folder of --out" % ", ".join(beside))
    shutil.rmtree(folder)
    return wrong


def main(program, *words):
    if words[:1] == ("--listed",):
        there, known = sorted(verbs_of(program)), sorted(words[1:])
        if there != known or known != sorted(RUNS):
            print("verbs of the program: %s\nverbs of the tests:   %s\nverbs with a run:     %s" %
                  (", ".join(there), ", ".join(known), ", ".join(sorted(RUNS))))
            return 1
        return 0
    failed = 0
    for verb in words:
        for arguments, right in RUNS[verb]:
            for wrong in complaints(program, verb, arguments, right):
                print("%s %s: %s" % (verb, " ".join(arguments), wrong))
                failed = 1
    return failed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
