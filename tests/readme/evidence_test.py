#!/usr/bin/env python3
"""Does all that results/xeon/report.html says still follow from what the committed studies have measured?

    evidence_test.py PROGRAM

Each study that keeps what it measured is derived again by the program as it is now, and its claims, with what they
measured and their verdicts, are compared with those of the page. Standard library only.
"""

import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

RESULTS = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "results", "xeon")
MEASURED = "measured.jsonl.gz"


def studies():
    """Folders of studies, by their names on the page."""
    return {name: os.path.join(RESULTS, name) for name in sorted(os.listdir(RESULTS)) if os.path.exists(os.path.join(RESULTS, name, MEASURED))}


def shown_claims(page, study):
    """(id, verdict, measured) of the claims of a study on the page."""
    article = re.search(r"<h1>[^<]*<small>%s</small></h1>.*?</article>" % re.escape(study), page, re.S)[0]
    claims = []
    for verdict, row in re.findall(r'^<tr data-verdict="(.*?)">(.*?)^</tr>', article, re.M | re.S):
        cells = re.findall(r"<td.*?>(.*?)</td>", row, re.S)
        claims.append((re.search(r"<code>(.*?)</code>", cells[1])[1], verdict, html.unescape(cells[4].split("<br>")[0])))
    return claims


class Evidence(unittest.TestCase):
    def test_follows_from_what_was_measured(self):
        with open(os.path.join(RESULTS, "report.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertGreater(len(studies()), 5)
        for study, folder in studies().items():
            with self.subTest(study=study), tempfile.TemporaryDirectory() as scratch:
                copy = os.path.join(scratch, study)
                os.mkdir(copy)
                for name in ("manifest.json", MEASURED):
                    shutil.copy(os.path.join(folder, name), copy)
                answer = subprocess.run([PROGRAM, "report", copy], capture_output=True, text=True)
                self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
                with open(os.path.join(copy, "findings.json"), encoding="utf-8") as file:
                    parts = json.load(file)["parts"]
                self.assertEqual(shown_claims(page, study),
                                 [(c["id"], c["verdict"], c["measured"]) for part in parts for c in part["claims"]])


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv[1])
    unittest.main(argv=sys.argv[:1])
