"""Build the copy with all mutants in it; those that do not compile are taken out, and the rest built again."""

import os
import re
import subprocess

import schemata

ERROR = re.compile(r"^(\S+?):(\d+)(?::\d+)?: (?:fatal )?error: (.*)$", re.M)
PLACE = re.compile(r"(\S+?\.(?:h|cpp)):(\d+)(?::\d+)?[:,]")


class BuildFails(Exception):
    pass


def copy_of_repository(source, tree):
    """What git knows or would add, as it lies there."""
    names = subprocess.run(["git", "-C", source, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                           check=True, capture_output=True).stdout
    names = b"\0".join(name for name in names.split(b"\0") if name and os.path.lexists(os.path.join(source.encode(), name)))
    os.makedirs(tree, exist_ok=True)
    packed = subprocess.Popen(["tar", "-C", source, "--null", "-T", "-", "-c"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    unpacked = subprocess.Popen(["tar", "-C", tree, "-x"], stdin=packed.stdout)
    packed.stdin.write(names)
    packed.stdin.close()
    if packed.wait() or unpacked.wait():
        raise BuildFails("copying %s failed" % source)


def configure(tree, build):
    """-O1: compiling takes most of the time. Like the release preset it has no assertions."""
    os.makedirs(build, exist_ok=True)
    switch = os.path.join(build, "mutant_switch")
    with open(switch + ".h", "w", encoding="utf-8") as file:
        file.write(schemata.SWITCH_H)
    with open(switch + ".cpp", "w", encoding="utf-8") as file:
        file.write(schemata.SWITCH_CPP)
    subprocess.run(["g++", "-std=c++20", "-O2", "-c", switch + ".cpp", "-o", switch + ".o"], check=True)
    subprocess.run(["cmake", "-S", tree, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -w -fno-diagnostics-color -include %s.h" % switch,
                    "-DCMAKE_CXX_STANDARD_LIBRARIES=%s.o" % switch, "-DDARTBOARD_TOGETHER=ON",
                    "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"], check=True, stdout=subprocess.DEVNULL)


def lines_of(mutant, text):
    first = text.count(b"\n", 0, mutant["edits"][0][0]) + 1
    return range(first, text.count(b"\n", 0, mutant["edits"][-1][1]) + 2)


def guilty(output, tree, texts, mutants, ran_in="."):
    """The mutants at the lines that errors name, from where the compiler ran; or, for an error elsewhere, at the lines that
    it came from.

    Returns {mutant id: message} and the errors that name no mutant."""
    at = {}
    for mutant in mutants:
        for line in lines_of(mutant, texts[mutant["file"]]):
            at.setdefault((mutant["file"], line), []).append(mutant["id"])
    name = lambda path: os.path.relpath(os.path.join(ran_in, path), tree)
    found, unexplained = {}, []
    blocks = re.split(r"^(?=FAILED: )", output, flags=re.M)
    for block in blocks:
        errors = list(ERROR.finditer(block))
        for k, error in enumerate(errors):
            ids = at.get((name(error[1]), int(error[2])), [])
            if not ids:
                # the context of the error: the lines before it back to the last error, and the notes after it
                begin = errors[k - 1].end() if k else 0
                end = errors[k + 1].start() if k + 1 < len(errors) else len(block)
                for file, line in PLACE.findall(block[begin:end]):
                    ids = ids + at.get((name(file), int(line)), [])
            if not ids:
                unexplained.append(error[0])
            for number in ids:
                found.setdefault(number, error[3])
    return found, unexplained


def check_headers(build, tree, texts, mutants, say):
    """Most sources include most headers: an error in one of these is found in one unit instead of in all."""
    out = {}
    while True:
        headers = sorted({m["file"] for m in mutants if m["file"].endswith(".h") and m["id"] not in out})
        unit = os.path.join(build, "all_headers.cpp")
        with open(unit, "w", encoding="utf-8") as file:
            file.writelines('#include "%s"\n' % header for header in headers)
        schemata.write_tree(tree, texts, [m for m in mutants if m["id"] not in out])
        result = subprocess.run(["g++", "-std=c++20", "-fsyntax-only", "-w", "-fmax-errors=0", "-DNDEBUG",
                                 "-DDARTBOARD_FLAGS=\"\"", "-DDARTBOARD_VERSION=\"\"", "-DDARTBOARD_BUILD_TYPE=\"\"",
                                 "-include", os.path.join(build, "mutant_switch.h"), "-I", tree,
                                 "-I", "/usr/include/eigen3", "-I", "/usr/include/suitesparse", unit],
                                capture_output=True, text=True)
        if result.returncode == 0:
            return out
        found, unexplained = guilty(result.stderr, tree, texts, [m for m in mutants if m["id"] not in out])
        say("headers: %d mutants do not compile%s" % (len(found), "; " + unexplained[0] if unexplained and not found else ""))
        if not found:
            return out
        out.update(found)


def build_all(build, tree, texts, mutants, say, targets=("all",)):
    """Builds the mutants that compile. Returns {id of a mutant that does not: the compiler's message}."""
    out = check_headers(build, tree, texts, mutants, say)
    while True:
        left = [m for m in mutants if m["id"] not in out]
        schemata.write_tree(tree, texts, left)
        say("building with %d mutants" % len(left))
        result = subprocess.run(["ninja", "-C", build, "-k", "0", *targets], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        output = result.stdout.decode(errors="replace")
        with open(os.path.join(build, "build.log"), "w", encoding="utf-8") as file:
            file.write(output)
        if result.returncode == 0:
            return out
        found, unexplained = guilty(output, tree, texts, left, build)
        if not found:
            raise BuildFails("the copy does not build, and no mutant is to blame (build.log):\n" +
                             "\n".join(unexplained[:5] or output.splitlines()[-20:]))
        out.update(found)
        say("%d mutants do not compile" % len(found))
