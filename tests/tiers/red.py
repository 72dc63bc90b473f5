"""The failures, a line each: the test, the file and line that it names, the first words of its message, and the command that
repeats it. Read from what ctest wrote as JUnit XML, or from the log of a build that failed.

Standard library only, and of it only what Debian's python3-minimal has, with its XML parser.
"""

import os
import re
import xml.etree.ElementTree as xml

WORDS = 160  # of a message, in characters
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

GTEST = re.compile(r"^(?P<file>\S+?):(?P<line>\d+): Failure\n(?P<text>.*)", re.M)
COMPILER = re.compile(r"^(?P<file>[^\s:]+):(?P<line>\d+):(?:\d+:)? (?:fatal )?error: (?P<text>.*)", re.M)
STALE = re.compile(r"^(?P<text>line \d+: fault '.*)", re.M)
LINKER = re.compile(r"^(?P<text>.*(?:undefined reference|multiple definition|cannot find ).*)", re.M)
SANITIZER = re.compile(r"^(?:=+\d+=+)?(?P<text>ERROR: (?:Address|Leak)Sanitizer.*|.*runtime error: .*)", re.M)
PYTHON_FRAME = re.compile(r'^ *File "(?P<file>[^"]+)", line (?P<line>\d+)', re.M)
PYTHON_ERROR = re.compile(r"^(?P<text>(?:\w+\.)*\w*(?:Error|Exception|Failure)\b.*)", re.M)
OWN_FRAME = re.compile(r"#\d+ 0x\w+ in .*?(?P<file>\S*/(?:core|reference|validation|benchmarks|tests)/\S+?):(?P<line>\d+)")


def shown_path(path):
    """Paths of a compiler are relative to its build folder, others absolute: both as seen from the checkout."""
    path = os.path.normpath(path)
    if os.path.isabs(path):
        inside = os.path.relpath(path, ROOT)
        return path if inside.startswith("..") else inside
    return re.sub(r"^(\.\./)+", "", path)


def short(text):
    text = " ".join(text.split())
    return text if len(text) <= WORDS else text[:WORDS - 3] + "..."


def message_of(output):
    """(place, words) of the first complaint in an output; the place may be empty."""
    for pattern in (SANITIZER, GTEST, COMPILER):
        found = pattern.search(output)
        if found and pattern is SANITIZER:
            frame = OWN_FRAME.search(output, found.end())
            return ("%s:%s" % (shown_path(frame["file"]), frame["line"]) if frame else ""), short(found["text"])
        if found:
            rest = output[found.start("text"):].split("\n")
            return "%s:%s" % (shown_path(found["file"]), found["line"]), short(" ".join(rest[:3]))
    error = PYTHON_ERROR.search(output)
    if error:
        frames = list(PYTHON_FRAME.finditer(output, 0, error.start()))
        own = [frame for frame in frames if shown_path(frame["file"]).startswith("tests")] or frames
        return ("%s:%s" % (shown_path(own[-1]["file"]), own[-1]["line"]) if own else ""), short(error["text"])
    for pattern in (STALE, LINKER):
        found = pattern.search(output)
        if found:
            return "", short(found["text"])
    lines = [line for line in output.splitlines() if line.strip()]
    return "", short(lines[-1]) if lines else "it printed nothing"


def line_of(name, place, words, again):
    return "RED %s  %s%s  (again: %s)" % (name, place + ": " if place else "", words, again)


def only(name):
    """The option of ctest that runs one test."""
    escaped = re.sub(r"([.+*?()\[\]$^|\\])", r"\\\1", name)
    return "-R '^%s$'" % escaped.replace("'", r"'\''")


def of_junit(file, again):
    """(lines of the failures, count of the passed tests). A test that did not run is a failure, unless it skipped itself."""
    red, passed = [], 0
    for case in xml.parse(file).getroot().iter("testcase"):
        status, name = case.get("status"), case.get("name")
        failure, skipped = case.find("failure"), case.find("skipped")
        if status == "run":
            passed += 1
            continue
        if status == "disabled" or (skipped is not None and "SKIP_" in skipped.get("message", "")):
            continue
        output = case.findtext("system-out") or ""
        said = (failure if failure is not None else skipped)
        said = said.get("message", "") if said is not None else ""
        place, words = message_of(output)
        if "imeout" in said or not output.strip():
            place, words = place if "imeout" not in said else "", short("%s after %.0f s" % (said or status, float(case.get("time", 0))))
        red.append(line_of(name, place, words, "%s %s" % (again, only(name))))
    return red, passed


def of_build(log, again):
    """Lines of a build that failed: one for each place that the compiler names."""
    red, seen = [], set()
    for found in COMPILER.finditer(log):
        place = "%s:%s" % (shown_path(found["file"]), found["line"])
        if place not in seen:
            seen.add(place)
            red.append(line_of("build", place, short(found["text"]), again))
    if not red:
        place, words = message_of(log)
        red.append(line_of("build", place, words, again))
    return red
