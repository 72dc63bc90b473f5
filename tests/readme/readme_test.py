#!/usr/bin/env python3
"""Are README.md and the page of the first scene true? Tables against the run they cite, links, scenes with what they print,
and the program.

    readme_test.py PROGRAM BUILD_FOLDER [NAME]

PROGRAM is the built dartboard, BUILD_FOLDER the folder for find_package, NAME that of a test without its "test_". Standard
library only.
"""

import html
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


README = text_of("README.md")


def blocks(language, page=README):
    return re.findall("^```%s\n(.*?)^```$" % language, page, re.M | re.S)


def block(language, page=README):
    """The content of the one block of a language."""
    found = blocks(language, page)
    assert len(found) == 1, "there are %d blocks of %s" % (len(found), language)
    return found[0]


def programs():
    """The programs of the pages, by name: of a problem, of a scene, and over the map."""
    of_problem, of_scene = blocks("cpp")
    begin = of_problem[:of_problem.index("int main() {\n") + len("int main() {\n")]
    of_force = next(text for text in blocks("cpp", re.sub("^  ", "", text_of("HACKING.md"), flags=re.M)) if "int main" in text)
    return {"halves": of_problem, "recorded": begin + of_scene + "}\n", "over_map": block("cpp", text_of("core", "README.md")),
            "tethered": of_force}


def commands_of(page):
    """Each command, and the lines below it."""
    return [(command, [line.strip() for line in printed.splitlines()])
            for command, printed in re.findall(r"^    \$ (.*?)\n((?:    [^$\n].*\n)*)", page, re.M)]


def rows_of(table_text):
    rows = [[cell.strip(" *") for cell in line.strip("|").split("|")]
            for line in table_text.splitlines() if line.startswith("|")]
    return rows[2:]  # below the heading and its rule


def three_digits(number):
    return ("%#.3g" % float(number)).rstrip(".")


def words_of(line):
    """A line whatever the widths of its columns are, which depend on other lines."""
    return " ".join(line.split())


def lines_of(text):
    return [words_of(line) for line in text.splitlines()]


def write_scene(folder):
    """The scene of the first page in a folder that has the meshes where the checkout has them."""
    with open(os.path.join(folder, "liver.json"), "w", encoding="utf-8") as file:
        file.write(block("json"))
    os.symlink(os.path.join(ROOT, "benchmarks"), os.path.join(folder, "benchmarks"))


class Readme(unittest.TestCase):
    def test_is_one_page(self):
        self.assertLessEqual(len(README.splitlines()), 125)

    def test_table_is_that_of_the_committed_run(self):
        heading, table = re.search(r'id="run-\d+-\d+-timing-1">(.*?)</h3>(.*?)</table>', text_of("results", "xeon", "report.html"), re.S).groups()
        self.assertEqual(heading, "Time per RK4 step")
        cells = [[html.unescape(cell) for cell in re.findall(r"<td.*?>(.*?)</td>", row)] for row in table.split("<tbody>")[1].split("<tr>")[1:]]
        measured = {row[0]: row for row in cells}
        order = ["coverage", "coverage-every", "lists", "lists-every", "arrays", "columns", "graph", "cgal-coverage", "cgal-attributes"]
        section = README.split("## The paper\n")[1].split("\n## ")[0]
        shown = rows_of(section)
        self.assertEqual(len(shown), len(order))
        for row, walk in zip(shown, order):
            here, ratio = measured[walk][4], measured[walk][6].split(" ")[0]
            self.assertEqual(row[3], three_digits(here) + " ms", walk)
            self.assertEqual(row[4], three_digits(ratio) if walk != "graph" else "1", walk)
            if row[1]:
                self.assertEqual(row[1], measured[walk][2] + " ms", walk)
                self.assertEqual(row[2], measured[walk][3], walk)

    def test_links_lead_somewhere(self):
        for page in ["README.md", "HACKING.md", "results/README.md", "core/README.md", "reference/README.md",
                     "validation/README.md", "benchmarks/README.md", "tests/README.md", "core/scene/first_scene.md", "core/scene/limits.md"]:
            for link in re.findall(r"\]\(([^)#]+)\)", re.sub(r"```.*?```", "", text_of(page), flags=re.S)):
                if not link.startswith("http"):
                    self.assertTrue(os.path.exists(os.path.join(ROOT, os.path.dirname(page), link)), page + ": " + link)

    def test_scene_prints_what_stands_below_its_command(self):
        command, printed = next((c, p) for c, p in commands_of(README) if c.startswith("./dartboard simulate"))
        with tempfile.TemporaryDirectory() as folder:
            write_scene(folder)
            answer = subprocess.run([PROGRAM] + command.split()[1:], cwd=folder, capture_output=True, text=True, check=True)
            for line in printed:
                self.assertIn(words_of(line), lines_of(answer.stdout))
            self.assertTrue(os.path.exists(os.path.join(folder, "liver", "picture.png")))

    def test_programs_are_built_from_any_folder_and_do_what_they_say(self):
        with tempfile.TemporaryDirectory() as folder:
            lines = block("cmake").replace("path/of/this/folder/build/release", BUILD)
            found, *target = lines.splitlines()
            with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
                file.write("cmake_minimum_required(VERSION 3.25)\nproject(cut CXX)\n" + found + "\n")
                for name, text in programs().items():
                    with open(os.path.join(folder, name + ".cpp"), "w", encoding="utf-8") as source:
                        source.write(text)
                    file.write(re.sub(r"\bcut\b", name, "\n".join(target)) + "\n")
            write_scene(folder)
            for command in (["cmake", "-S", ".", "-B", "build", "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", "build", "-j2"]):
                answer = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
            said = {}
            for name in programs():
                answer = subprocess.run([os.path.join(folder, "build", name)], cwd=folder, capture_output=True, text=True)
                self.assertEqual(answer.returncode, 0, name + answer.stderr)
                said[name] = answer.stdout
            # two triangles for each square of the grid that the plane crosses, and more where it is oblique
            for name, words in (("halves", ""), ("over_map", ", 1 part came loose")):
                self.assertRegex(said[name], r"^\d+ faces dissociated%s\n$" % words)
                self.assertGreater(int(said[name].split()[0]), 2 * 6 * 6)
            self.assertEqual(said["halves"].split()[0], said["over_map"].split()[0])
            # the weight of the beam, 0.864 kg, stretches the tether of 1000 N/m by 8.5 mm, but for what still swings
            hangs = float(re.search(r"hangs (\S+) m below", said["tethered"])[1])
            self.assertTrue(0.004 < hangs < 0.017, hangs)
            for name in ("halves.vtu", os.path.join("liver", "frames.pvd"), os.path.join("liver", "diagnostics.csv")):
                self.assertTrue(os.path.exists(os.path.join(folder, name)), name)

    def test_core_is_added_to_another_project_without_the_rest(self):
        """Configured, and what the program itself needs compiled; all of core would take minutes."""
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "cut.cpp"), "w", encoding="utf-8") as file:
                file.write(programs()["halves"])
            own = block("cmake").splitlines()[1:]
            added = re.search(r"`(add_subdirectory\(path/of/this/folder dartboard\))`", README)[1]
            with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
                file.write("cmake_minimum_required(VERSION 3.25)\nproject(cut CXX)\n"
                           + added.replace("path/of/this/folder", ROOT) + "\n" + "\n".join(own) + "\n")
            build = os.path.join(folder, "build")
            not_wanted = ["-DCMAKE_DISABLE_FIND_PACKAGE_" + name + "=ON" for name in
                          ("CGAL", "CLI11", "GTest", "rapidcheck", "benchmark", "BLAS", "PkgConfig")]
            for command in (["cmake", "-S", folder, "-B", build, "-G", "Ninja", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"] + not_wanted,
                            ["cmake", "--build", build, "--target", "CMakeFiles/cut.dir/cut.cpp.o", "dartboard_core_topology_storage"]):
                answer = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
            with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
                commands = {os.path.relpath(entry["file"], ROOT): entry["command"] for entry in json.load(file)}
            mine = next(command for name, command in commands.items() if name.endswith("cut.cpp"))
            for flag in ("-W", "-ffp-contract", "-fno-tree-slp-vectorize", "CGAL"):
                self.assertNotIn(flag, mine)
            for definition in ("-DEIGEN_DONT_VECTORIZE", "-DEIGEN_UNROLLING_LIMIT=0"):  # of inline functions and types
                self.assertIn(definition, mine)
            rooms = {name.split("/")[0] for name in commands if not name.startswith("..")}
            self.assertEqual(rooms, {"core"})


class FirstScene(unittest.TestCase):
    def test_is_run_from_the_mesh_to_the_picture(self):
        page = text_of("core", "scene", "first_scene.md")
        programs = {"python3": sys.executable, "./dartboard": PROGRAM}
        with tempfile.TemporaryDirectory() as folder:
            for name, language in (("mesh.py", "python"), ("bar.json", "json")):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(block(language, page))
            commands = commands_of(page)
            self.assertEqual(len(commands), 4)
            for command, printed in commands:
                words = command.split()
                answer = subprocess.run([programs[words[0]]] + words[1:], cwd=folder, capture_output=True, text=True)
                self.assertEqual(answer.returncode, 0, answer.stderr)
                for line in printed:
                    self.assertIn(words_of(line), lines_of(answer.stdout), command)
            self.assertTrue(os.path.exists(os.path.join(folder, "bar", "picture.png")))


if __name__ == "__main__":
    PROGRAM, BUILD = [os.path.abspath(path) for path in sys.argv[1:3]]
    unittest.main(argv=sys.argv[:1] + ["-k" + name for name in sys.argv[3:]])
