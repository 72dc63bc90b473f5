"""A headless Chromium, and what tests ask of a page in it."""

import os
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:  # it is a package of Debian's python3
    if os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3"):
        sys.exit("there is no selenium: ./dartboard test --only browser installs python3-selenium")
    os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B"] + sys.argv)

import subprocess
import tempfile
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOFTWARE_GL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PROGRAM, PICTURES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def dartboard(*arguments, statuses=(0,)):
    done = subprocess.run([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in statuses:
        raise RuntimeError("dartboard %s ended with %d:\n%s" % (" ".join(arguments), done.returncode, done.stdout))


def browser(*options):
    all_options = Options()
    for option in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1300,1000", *options):
        all_options.add_argument(option)
    all_options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    all_options.binary_location = "/usr/bin/chromium"
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=all_options)


class PageTest(unittest.TestCase):
    """Tests of pages by name, which `make_pages` makes in a folder."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="dartboard-browser-")
        cls.folder = cls.scratch.name
        os.makedirs(PICTURES, exist_ok=True)
        cls.pages = cls.make_pages()
        cls.driver = browser(*SOFTWARE_GL)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.scratch.cleanup()

    def tearDown(self):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        self.assertEqual(self.driver.get_log("browser"), [], "no error, no warning")

    def open(self, name):
        self.driver.set_window_size(1300, 1000)
        self.driver.get("file://" + self.pages[name])
        # the page has its last width once it has been laid out with its curves
        self.driver.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));")

    def ask(self, expression, *arguments):
        return self.driver.execute_script("return " + expression, *arguments)

    def do(self, statements, *arguments):
        self.driver.execute_script(statements, *arguments)

    def wait(self, condition):
        for _ in range(100):
            if condition():
                return
            time.sleep(0.05)
        self.fail("the page has not answered within five seconds")

    def keep(self, name):
        self.driver.save_screenshot(os.path.join(PICTURES, name + ".png"))

    # every page

    def test_is_one_file_below_three_megabytes_that_loads_nothing(self):
        for name, page in self.pages.items():
            self.assertLess(os.path.getsize(page), 3e6)
            self.open(name)
            self.assertEqual(self.ask("performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length"), 0)

    def test_fits_a_phone_and_the_dark(self):
        for name in self.pages:
            self.open(name)
            paper = self.ask("getComputedStyle(document.body).backgroundColor")
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                        {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
            self.assertNotEqual(self.ask("getComputedStyle(document.body).backgroundColor"), paper)
            self.keep(name + "-dark")
            self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                        {"width": 390, "height": 1400, "deviceScaleFactor": 1, "mobile": True})
            self.assertLessEqual(self.ask("document.documentElement.scrollWidth"), 390)
            self.keep(name + "-phone")
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
