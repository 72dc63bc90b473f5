#!/usr/bin/env python3
"""The page of a study in a headless Chromium: its claims, tables and diagrams.   report_test.py PROGRAM PICTURES"""

import json
import os
import sys
import unittest

import browser
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By


class Report(browser.PageTest):
    @classmethod
    def make_pages(cls):
        pages = {}
        # one has a diagram of every integrator, the other claims, and panels with fields behind their curves
        for name, words in (("tradeoff", ["tradeoff", "chain"]), ("extremes", ["extremes", "--axis", "maps"])):
            folder = os.path.join(cls.folder, name)
            browser.dartboard(*words, "--quick", "--out", folder)
            pages[name] = os.path.join(folder, "report.html")
        pages["both"] = os.path.join(cls.folder, "both.html")
        browser.dartboard("report", *(os.path.join(cls.folder, name) for name in ("tradeoff", "extremes")), "--out", pages["both"])
        return pages

    def findings(self, name):
        with open(os.path.join(self.folder, name, "findings.json"), encoding="utf-8") as file:
            return json.load(file)

    def parts(self, name, what):
        return [one for part in self.findings(name)["parts"] for one in part[what]]

    def test_has_every_cell_of_every_table(self):
        for name in ("tradeoff", "extremes"):
            self.open(name)
            shown = self.ask("[...document.querySelectorAll('.wide table')].map(table => [...table.tBodies[0].rows]"
                             ".map(row => [...row.cells].map(cell => cell.textContent)))")
            self.assertEqual(shown, [table["rows"] for table in self.parts(name, "tables")])
            self.assertGreater(len(shown), 0)

    def test_has_every_claim_and_shows_those_that_are_asked_for(self):
        self.open("extremes")
        claims = self.parts("extremes", "claims")
        verdicts = self.ask("[...document.querySelectorAll('.of-claims tbody tr')].map(row => row.dataset.verdict)")
        self.assertEqual(verdicts, [claim["verdict"] for claim in claims])
        shown = lambda: self.ask("[...document.querySelectorAll('.of-claims tbody tr')].filter(row => row.offsetHeight > 0)"
                                 ".map(row => row.querySelector('code').textContent)")
        self.assertEqual(shown(), [claim["id"] for claim in claims])
        words = self.driver.find_element(By.CSS_SELECTOR, ".words")
        words.send_keys(claims[-1]["id"].upper())
        self.assertEqual(shown(), [claims[-1]["id"]])
        words.clear()
        words.send_keys(" ")
        self.driver.find_element(By.CSS_SELECTOR, "input[data-verdict=holds]").click()
        self.assertEqual(shown(), [claim["id"] for claim in claims if claim["verdict"] != "holds"])

    def test_draws_every_point_that_is_on_the_axes(self):
        self.open("tradeoff")
        plot = self.parts("tradeoff", "diagrams")[0]
        within = lambda axis, value: value is not None and (not axis["log"] or value > 0)
        points = sum(within(plot["x"], x) and within(plot["y"], y) for one in plot["series"] if one["symbol"] > 0
                     for x, y in zip(one["x"], one["y"]))
        self.assertEqual(self.ask("document.querySelectorAll('.diagram svg circle').length"), points)
        self.assertEqual(self.ask("[...document.querySelectorAll('.diagram .keys button')].map(key => key.textContent)"),
                         [one["title"] for one in plot["series"] if one["title"]])

    def test_puts_a_series_forward_and_says_what_is_pointed_at(self):
        self.open("tradeoff")
        pale = lambda: self.ask("document.querySelectorAll('.diagram g.pale').length")
        self.assertEqual(pale(), 0)
        key = self.driver.find_element(By.CSS_SELECTOR, ".diagram .keys button")
        key.click()
        series = len(self.parts("tradeoff", "diagrams")[0]["series"])
        self.assertEqual(pale(), series - 1)
        key.click()
        self.assertEqual(pale(), 0)
        point = self.driver.find_elements(By.CSS_SELECTOR, ".diagram svg circle")[40]
        ActionChains(self.driver).move_to_element(point).perform()
        self.assertRegex(self.driver.find_element(By.CSS_SELECTOR, ".diagram .said").text, r"^[\w-]+ .*\(.*\)$")
        self.assertEqual(pale(), series - 1)
        self.keep("tradeoff-forward")

    def test_draws_a_diagram_when_it_comes_near(self):
        self.open("both")
        drawn = lambda: self.ask("document.querySelectorAll('.diagram[data-drawn]').length")
        before, every = drawn(), self.ask("document.querySelectorAll('.diagram').length")
        self.assertLess(before, every)
        self.do("document.querySelectorAll('.diagram')[arguments[0]].scrollIntoView()", every - 1)
        self.wait(lambda: drawn() == every)
        self.assertEqual(self.ask("document.querySelectorAll('.diagram svg').length"),
                         sum(len(one.get("panels", [0])) for name in ("tradeoff", "extremes") for one in self.parts(name, "diagrams")))

    def test_draws_fields_behind_curves(self):
        self.open("extremes")
        fields = sum(bool(panel["field"]["values"]) for one in self.parts("extremes", "diagrams") if one["kind"] == "panels"
                     for panel in one["panels"])
        self.assertGreater(fields, 0)
        self.do("window.dispatchEvent(new Event('beforeprint'))")  # all are printed
        self.assertEqual(self.ask("document.querySelectorAll('.diagram svg image').length"), fields)

    def test_of_two_runs_has_both_with_links_to_their_samples(self):
        self.open("both")
        self.assertEqual(self.ask("[...document.querySelectorAll('h1')].map(h => h.firstChild.textContent.trim())"),
                         ["tradeoff chain", "extremes"])
        links = self.ask("[...document.querySelectorAll('section a')].map(a => a.href)")
        self.assertTrue(any(link.endswith("/tradeoff/samples.jsonl") for link in links))
        for link in links:
            self.assertTrue(os.path.exists(link.removeprefix("file://")), link)
        places = self.ask("[...document.querySelectorAll('nav a')].map(a => document.getElementById(a.hash.slice(1)) !== null)")
        self.assertGreater(len(places), 3)
        self.assertTrue(all(places))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
