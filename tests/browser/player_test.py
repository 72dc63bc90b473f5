#!/usr/bin/env python3
"""The page of `simulate --player` in a headless Chromium, as a user has it.   player_test.py PROGRAM PICTURES

Pictures of the page are left in the folder PICTURES, to be looked at; the frames that it draws in a second are printed.
"""

import csv
import json
import os
import sys
import unittest

import browser
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

HOSTILE = "</script><script>document.title = 'run'</script> \u202e<b>&amp;"


def rows_of(file):
    with open(file, encoding="utf-8", newline="") as text:
        return list(csv.DictReader(text))


class Player(browser.PageTest):
    @classmethod
    def make_pages(cls):
        pages = {}
        # the same run again, with rows and probes as often as the page has pictures
        with open(os.path.join(browser.ROOT, "benchmarks", "scenes", "liver_cut.json"), encoding="utf-8") as file:
            scene = json.load(file)
        del scene["expect"]
        scene["body"]["mesh"] = os.path.join(browser.ROOT, "benchmarks", "meshes", "liver564.mesh")
        scene["output"] = {"diagnostics_every": {"steps": 5}, "probes": scene["output"]["probes"]}
        for name, changes in (("liver", {}), ("other", {"integrator": "backward-euler"}), ("hostile", {"name": HOSTILE})):
            file = os.path.join(cls.folder, name + ".json")
            with open(file, "w", encoding="utf-8") as out:
                json.dump({**scene, **changes}, out)
            pages[name] = os.path.join(cls.folder, name + ".html")
            browser.dartboard("simulate", file, "--player", pages[name], "--out", os.path.join(cls.folder, name))
        pages["contact"] = os.path.join(cls.folder, "contact.html")
        browser.dartboard("simulate", "liver_lands", "--player", pages["contact"])
        return pages

    def picture(self):
        return self.ask("player.views[0].picture()")

    def said(self, name="said"):
        return self.driver.find_element(By.ID, name).text

    def set_box(self, name, value):
        self.do("const e = document.getElementById(arguments[0]); e.type === 'checkbox' ? e.checked = arguments[1] : e.value = arguments[1];"
                "e.dispatchEvent(new Event('change'));", name, value)

    def test_is_ready_soon_and_plays(self):
        self.open("liver")
        ready = self.ask("performance.getEntriesByType('navigation')[0].loadEventEnd")
        before, shown = self.picture(), self.said("now")
        self.driver.find_element(By.ID, "play").click()
        self.driver.set_script_timeout(30)
        frames = self.driver.execute_async_script(
            "const done = arguments[0], start = performance.now(); let n = 0;"
            "(function count() { ++n; performance.now() - start < 3000 ? requestAnimationFrame(count) : done(n / 3); })();")
        self.assertGreater(self.ask("player.drawn"), 5)
        self.driver.find_element(By.ID, "play").click()
        self.assertNotEqual(self.said("now"), shown)
        self.assertNotEqual(self.picture(), before)
        print("ready after %.0f ms; %.0f frames in a second while it plays, drawn in software" % (ready, frames), flush=True)

    def test_shows_the_same_picture_at_the_same_time_and_another_after_a_cut(self):
        self.open("liver")
        first = self.picture()
        self.do("player.go_to(player.times.length - 1)")
        last = self.picture()
        self.keep("liver_cut")
        self.assertIn("was inside", self.driver.find_element(By.CLASS_NAME, "legend").text)
        self.do("player.go_to(0)")
        self.assertEqual(self.picture(), first)
        self.assertNotEqual(last, first)
        self.assertNotIn("was inside", self.driver.find_element(By.CLASS_NAME, "legend").text)

    def test_colours_by_a_quantity_and_says_its_scale(self):
        self.open("liver")
        self.do("player.go_to(50)")
        plain = self.picture()
        for name in ("speed", "stress"):
            self.set_box("colour", name)
            quantity = self.ask("player.recordings[0].quantity(arguments[0])", name)
            self.assertIn("%s %s" % (self.ask("BodyView.in_words(arguments[0])", quantity["largest"]), quantity["unit"]),
                          self.driver.find_element(By.CLASS_NAME, "legend").text)
            self.assertNotEqual(self.picture(), plain)

    def test_draws_what_is_asked_for(self):
        self.open("contact")
        for name in ("edges", "marks", "obstacles"):
            before = self.picture()
            self.set_box(name, False)
            self.assertNotEqual(self.picture(), before, name)
            self.set_box(name, True)
            self.assertEqual(self.picture(), before, name)

    def test_turns_and_comes_back(self):
        self.open("liver")
        before = self.picture()
        canvas = self.driver.find_element(By.CSS_SELECTOR, ".view canvas")
        ActionChains(self.driver).click_and_hold(canvas).move_by_offset(120, 40).release().perform()
        self.assertNotEqual(self.picture(), before)
        self.assertEqual(self.said(), "", "the end of a turn is no click")
        self.driver.find_element(By.ID, "reset").click()
        self.assertEqual(self.picture(), before)

    def test_follows_a_vertex_that_is_clicked_as_the_table_of_probes_has_it(self):
        probes = rows_of(os.path.join(self.folder, "liver", "probes.csv"))
        place = lambda row: [float(row["right %s [m]" % axis]) for axis in "xyz"]
        self.open("liver")
        # where the probe's vertex is in the window
        point, x, y = self.ask(
            "(() => { const view = player.views[0], at = arguments[0], shape = view.recording.shape(0); let best = -1, far = 1e9;"
            "for (let k = 0; k < shape.points; ++k) { const d = Math.hypot(...[0, 1, 2].map(a => view.places_shown[3 * k + a] - at[a]));"
            "  if (d < far) [best, far] = [k, d]; }"
            "const p = new THREE.Vector3().fromArray(view.places_shown, 3 * best).project(view.camera), box = view.canvas.getBoundingClientRect();"
            "return [shape.number[best], (p.x + 1) / 2 * box.width - box.width / 2, (1 - p.y) / 2 * box.height - box.height / 2]; })()",
            place(probes[0]))
        canvas = self.driver.find_element(By.CSS_SELECTOR, ".view canvas")
        ActionChains(self.driver).move_to_element_with_offset(canvas, round(x) - 1, round(y)).click().perform()
        self.assertIn("Vertex %d of the mesh" % point, self.said())
        self.keep("liver_vertex")
        lines = self.ask("player.ways[0].lines.map(line => [line.name, line.times, line.values])")
        self.assertEqual([line[0] for line in lines], ["x", "y", "z"])
        exact = 2 * max(self.ask("player.recordings[0].run.size")) / 65535
        self.assertEqual(len(lines[0][1]), len(probes))
        for axis, (_, times, values) in enumerate(lines):
            for row, at, value in zip(probes, times, values):
                self.assertAlmostEqual(at, float(row["time [s]"]), delta=1e-12)
                self.assertAlmostEqual(value, place(row)[axis] - place(probes[0])[axis], delta=exact)

    def test_curves_have_the_numbers_of_the_table_of_diagnostics(self):
        rows = rows_of(os.path.join(self.folder, "liver", "diagnostics.csv"))
        self.open("liver")
        lines = self.ask("player.diagrams[0].lines.map(line => [line.name, line.own])")
        names = [line[0] for line in lines]
        for name, column in (("kinetic", "kinetic [J]"), ("elastic", "elastic [J]")):
            self.assertEqual(lines[names.index(name)][1], [float(row[column]) for row in rows])
        self.do("player.go_to(player.times.length - 1)")
        keys = self.driver.find_element(By.CSS_SELECTOR, "#curves figure .keys").text
        self.assertIn("kinetic %.3g" % float(rows[-1]["kinetic [J]"]), keys)
        # pointing at a curve goes to its time
        area = self.driver.find_element(By.CSS_SELECTOR, "#curves figure svg")
        self.do("arguments[0].scrollIntoView({block: 'center'})", area)
        ActionChains(self.driver).move_to_element(area).click().perform()
        self.assertTrue(40 < self.ask("player.now") < 75)
        # and it can be saved
        saved = self.driver.execute_async_script(
            "const done = arguments[0]; URL.createObjectURL = blob => { blob.text().then(done); return 'blob:none'; };"
            "HTMLAnchorElement.prototype.click = () => {}; save_svg(player.diagrams[0].svg.node(), 'Energy');")
        self.assertTrue(saved.startswith("<svg") and saved.count("<path") > 3)

    def test_puts_another_run_beside_it_and_refuses_what_is_none(self):
        self.open("liver")
        chosen = self.driver.find_element(By.ID, "beside")
        chosen.send_keys(os.path.abspath(__file__))
        self.wait(lambda: "is no page" in self.said())
        self.assertEqual(self.ask("player.views.length"), 1)
        chosen.send_keys(self.pages["other"])
        self.wait(lambda: self.ask("player.views.length") == 2)
        self.do("player.go_to(60)")
        self.keep("beside")
        pictures = self.ask("player.views.map(view => view.picture())")
        self.assertNotEqual(pictures[0], pictures[1], "the implicit run lags behind")
        names = [one.text for one in self.driver.find_elements(By.CSS_SELECTOR, ".view .name")]
        self.assertIn("verlet", names[0])
        self.assertIn("backward-euler", names[1])
        self.assertIn("right: sum", self.driver.find_element(By.CSS_SELECTOR, "#curves figure .keys").text)

    def test_is_played_by_keys(self):
        self.open("liver")
        body = self.driver.find_element(By.TAG_NAME, "body")
        for key, picture in ((Keys.END, 120), (Keys.ARROW_LEFT, 119), (Keys.HOME, 0), (Keys.ARROW_RIGHT, 1)):
            body.send_keys(key)
            self.assertEqual(self.ask("player.now"), picture)
        body.send_keys(Keys.SPACE)
        self.assertTrue(self.ask("player.playing"))
        body.send_keys(Keys.SPACE)
        self.assertFalse(self.ask("player.playing"))
        # on a control, they are the control's
        box = self.driver.find_element(By.ID, "edges")
        box.send_keys(Keys.SPACE)
        self.assertFalse(box.is_selected())
        self.assertFalse(self.ask("player.playing"))

    def test_prints_its_picture(self):
        self.open("liver")
        size = lambda: len(self.driver.execute_cdp_cmd("Page.printToPDF", {})["data"])
        with_picture = size()
        self.do("player.views[0].faces.visible = player.views[0].edges.visible = player.views[0].held.visible = false")
        self.assertGreater(with_picture, size() + 5000)

    def test_shows_a_hostile_name_as_it_is(self):
        self.open("hostile")
        self.assertEqual(self.ask("document.querySelector('h1').textContent"), self.ask("player.recordings[0].title"))
        self.assertIn("</script><script>", self.ask("player.recordings[0].title"))
        self.assertNotEqual(self.ask("document.title"), "run")

    def test_has_its_curves_where_no_bodies_can_be_drawn(self):
        plain = browser.browser("--disable-gpu", "--disable-3d-apis")
        try:
            plain.get("file://" + self.pages["liver"])
            self.assertIn("WebGL", plain.find_element(By.ID, "views").text)
            self.assertGreater(plain.execute_script("return player.diagrams.length"), 3)
            plain.execute_script("player.go_to(50)")
            self.assertEqual([line for line in plain.get_log("browser") if "player" in line["message"]], [])
        finally:
            plain.quit()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
