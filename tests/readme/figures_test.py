#!/usr/bin/env python3
"""Can every figure of README.md be derived from what a committed study has measured, and is it
the one printed there? The table is figures.py. Standard library only."""

import re
import unittest

import samples
from figures import FIGURES, NO_MEASUREMENT, README

PIECE = "{}"


def page_text(page):
    """A page in one line, without code, targets of links, and heads of sections."""
    text = samples.read(page)
    text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    text = re.sub(r"^    .*$", "", text, flags=re.M)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return " ".join(text.split())


def filled(text, figures):
    figures = list(figures)
    if text.count(PIECE) != len(figures):
        raise ValueError("'%s' has room for %d figures, not for %s" % (text, text.count(PIECE), figures))
    for figure in figures:
        text = text.replace(PIECE, figure, 1)
    return text


def spans(page, piece):
    return [m.span() for m in re.finditer(re.escape(piece), page)]


def numbers_without_a_row(page, pieces):
    """Numbers of a page of which some digit is in no piece."""
    covered = set()
    for piece in pieces:
        for start, end in spans(page, piece):
            covered.update(range(start, end))
    prose = re.sub(r"`[^`]*`", lambda m: " " * len(m[0]), page)
    return [page[max(0, m.start() - 30):m.end() + 20] for m in re.finditer(r"(?<![A-Za-z\d])\d[\d.,]*", prose)
            if not covered.issuperset(range(m.start(), m.start() + len(m[0].rstrip(".,"))))]


class Figures(unittest.TestCase):
    def test_are_those_of_the_samples(self):
        for text, files, derive in FIGURES:
            with self.subTest(text=text):
                samples.used.clear()
                piece = filled(text, derive())
                self.assertEqual(samples.used, set(files))
                self.assertEqual(len(spans(page_text(README), piece)), 1, "it should say: " + piece)

    def test_that_are_not_measured_are_what_the_source_says(self):
        for text, said in NO_MEASUREMENT:
            with self.subTest(text=text):
                self.assertIn(text.replace("`", ""), page_text(README).replace("`", ""))
                if isinstance(said, tuple):
                    self.assertIn(said[1], samples.read(said[0]))

    def test_are_all_in_the_table(self):
        pieces = [filled(text, derive()) for text, _, derive in FIGURES] + [text for text, _ in NO_MEASUREMENT]
        self.assertEqual(numbers_without_a_row(page_text(README), pieces), [])


class Check(unittest.TestCase):
    """The judges of this file, given wrong input."""

    def test_finds_a_number_that_no_row_has(self):
        self.assertEqual(numbers_without_a_row("it takes 5.5 us and 7 more", ["takes 5.5 us"]), ["it takes 5.5 us and 7 more"[:26]])
        self.assertEqual(numbers_without_a_row("it takes 5.5 us, `h = 3`.", ["takes 5.5 us"]), [])
        self.assertEqual(len(numbers_without_a_row("it takes 15.5 us", ["5.5 us"])), 1)
        self.assertEqual(numbers_without_a_row("built without CLI11", []), [])

    def test_has_no_interval_of_five_values(self):
        self.assertEqual(samples.interval([3, 1, 2, 6, 5, 4]), (1, 6))
        self.assertRaises(ValueError, samples.interval, [1, 2, 3, 4, 5])
        self.assertEqual(samples.interval(range(1, 21)), (6, 15))

    def test_goes_by_whole_intervals(self):
        f = samples.Figure
        self.assertEqual(samples.verdict([f(0.9, 0.8, 1.0)], 1.0), "holds")
        self.assertEqual(samples.verdict([f(0.9, 0.8, 1.1)], 1.0), "cannot tell")
        self.assertEqual(samples.verdict([f(0.9, 0.8, 1.1), f(1.2, 1.1, 1.3)], 1.0), "falls short")
        self.assertEqual(samples.verdict([f(1.2, 1.0, 1.3)], 1.0, at_least=True), "holds")
        self.assertEqual(samples.verdict([f(1.2, 0.9, 1.3)], 1.0, at_least=True), "cannot tell")
        self.assertEqual(samples.verdict([f(0.8, 0.7, 0.9)], 1.0, at_least=True), "falls short")

    def test_has_the_ratio_within_a_round_and_the_median_over_processes(self):
        rows = [{"process": p, "round": r, "task": t, "cpu_ns": ns * (1 + r)} for p in range(6) for r in range(3)
                for t, ns in (("a", 10.0 + p), ("b", 5.0))]
        self.assertEqual(samples.ratio(rows, "a", "b"), samples.Figure(2.5, 2.0, 3.0))


if __name__ == "__main__":
    unittest.main()
