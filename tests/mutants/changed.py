"""The changes of a working tree since a revision, and a build of it that shares the compiler's cache with others."""

import os
import re
import subprocess

import schemata

# warnings are errors, and a change is allowed to cause one
QUIET = "".join('#pragma GCC diagnostic ignored "-W%s"\n' % name for name in (
    "unused", "unused-parameter", "unused-variable", "unused-but-set-variable", "parentheses", "sign-compare", "conversion",
    "sign-conversion", "float-conversion", "type-limits", "extra", "shadow", "div-by-zero", "tautological-compare", "return-type",
    "dangling-else", "duplicated-branches", "bool-operation", "int-in-bool-context", "uninitialized", "maybe-uninitialized"))


def git(source, *words):
    answer = subprocess.run(["git", "-C", source, *words], capture_output=True, text=True)
    if answer.returncode:
        raise SystemExit("mutants: git %s: %s" % (words[0], answer.stderr.strip().splitlines()[-1]))
    return answer.stdout


def lines_of_diff(diff):
    """{file: the numbers of its lines that are new}, of a unified diff without context."""
    found, file = {}, None
    for line in diff.splitlines():
        if line.startswith("+++ "):
            file = line[6:] if line.startswith("+++ b/") else None
        hunk = re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line)
        if hunk and file:
            first, count = int(hunk[1]), int(hunk[2] or 1)
            found.setdefault(file, set()).update(range(first, first + count))
    return {file: lines for file, lines in found.items() if lines and file.endswith((".h", ".cpp"))}


def changed_lines(source, revision, rooms):
    """{file: numbers of lines} of the working tree, files that git does not know yet included."""
    found = lines_of_diff(git(source, "diff", "-U0", "-M", revision, "--", *rooms))
    for file in git(source, "ls-files", "--others", "--exclude-standard", "--", *rooms).splitlines():
        if file.endswith((".h", ".cpp")):
            with open(os.path.join(source, file), encoding="utf-8") as text:
                found[file] = set(range(1, len(text.readlines()) + 1))
    return found


def units_of(root, files):
    """Sources that read them: a source itself; of a header the source of its name, or the first that includes it."""
    units, headers = {file for file in files if file.endswith(".cpp")}, []
    for file in files:
        source = file[:-2] + ".cpp"
        if file.endswith(".h"):
            units.add(source) if os.path.exists(os.path.join(root, source)) else headers.append(file)
    for header in headers:
        answer = subprocess.run(["grep", "-rlF", "--include=*.cpp", '#include "%s"' % header,
                                 *(room for room in ("core", "reference", "validation", "benchmarks", "tests"))],
                                cwd=root, capture_output=True, text=True)
        units.update(answer.stdout.splitlines()[:1])
    return sorted(units)


def refresh(source, tree):
    """Make the tree equal to the source, and leave equal files alone: what has changed is newer than what was built."""
    names = git(source, "ls-files", "-z", "--cached", "--others", "--exclude-standard").split("\0")
    names = {name for name in names if name and os.path.isfile(os.path.join(source, name))}
    for folder, folders, files in os.walk(tree):
        if folder == tree:
            folders[:] = [name for name in folders if name != "build"]
        for file in files:
            if os.path.relpath(os.path.join(folder, file), tree) not in names:
                os.remove(os.path.join(folder, file))
    for name in names:
        here, there = os.path.join(source, name), os.path.join(tree, name)
        with open(here, "rb") as file:
            text = file.read()
        if os.path.exists(there):
            with open(there, "rb") as file:
                if file.read() == text:
                    continue
        os.makedirs(os.path.dirname(there), exist_ok=True)
        with open(there, "wb") as file:
            file.write(text)
        os.chmod(there, os.stat(here).st_mode & 0o777)


def configure(tree):
    """The release preset, so that all but the touched objects come from the compiler's cache. Returns its build folder."""
    build = os.path.join(tree, "build", "release")
    os.makedirs(build, exist_ok=True)
    switch = os.path.join(build, "mutant_switch")
    for end, text in ((".h", schemata.SWITCH_H + QUIET), (".cpp", schemata.SWITCH_CPP)):
        if not os.path.exists(switch + end):
            with open(switch + end, "w", encoding="utf-8") as file:
                file.write(text)
    subprocess.run(["g++", "-std=c++20", "-O2", "-c", switch + ".cpp", "-o", switch + ".o"], check=True)
    subprocess.run(["cmake", "--preset", "release", "-DCMAKE_CXX_STANDARD_LIBRARIES=%s.o" % switch], cwd=tree, check=True,
                   stdout=subprocess.DEVNULL)
    schemata.prefix = b'#include "%s.h"\n#line 1\n' % switch.encode()
    return build
