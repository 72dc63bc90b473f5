"""Makes a page that needs no network: make_page.py TEMPLATE DATA.json PAGE.html

The template stands in this folder; its text, its style, its scripts, the libraries that it names and the data become one
file. What goes wrong is one line of standard error, and exit status 1.
"""

import json
import pathlib
import sys
import unicodedata

HERE = pathlib.Path(__file__).resolve().parent
LIBRARIES = {  # where Debian's packages put them
    "three": ("libjs-three", "/usr/share/javascript/three/build/three.min.js"),
    "orbit": ("libjs-three", "/usr/share/javascript/three/examples/js/controls/OrbitControls.js"),
    "d3": ("node-d3", "/usr/share/nodejs/d3/dist/d3.min.js"),
}


def fail(text):
    sys.exit(text)


def text_of(file, package):
    try:
        return pathlib.Path(file).read_text(encoding="utf-8")
    except OSError as error:
        fail("%s: %s; it is in Debian's package %s, which ./dartboard installs" % (file, error.strerror, package))


def script(text):
    """Inside of a <script>, which a parser ends at the first "</script"."""
    if "</script" in text or "<!--" in text:
        fail("a library holds the end of a script, so that no page can hold it")
    return text


def visible(value):
    """Data without characters by which a name could act on a terminal or turn the text around it."""
    if isinstance(value, str) and not value.isprintable():
        acts = lambda letter: unicodedata.category(letter) in ("Cc", "Zl", "Zp") or letter in "\u202a\u202b\u202d\u202e\u2066\u2067\u2068"
        return "".join("\ufffd" if acts(letter) and letter != "\n" else letter for letter in value)
    if isinstance(value, list):
        return [visible(one) for one in value]
    if isinstance(value, dict):
        return {visible(key): visible(one) for key, one in value.items()}
    return value


def main(template, data, page):
    try:
        import jinja2
        from markupsafe import Markup
    except ImportError:
        fail("%s has no jinja2; it is in Debian's package python3-jinja2, which ./dartboard installs" % sys.executable)
    with open(data, encoding="utf-8") as file:
        content = visible(json.load(file))
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True)
    environment.globals.update(
        library=lambda name: Markup(script(text_of(LIBRARIES[name][1], LIBRARIES[name][0]))),
        own=lambda name: Markup(script((HERE / name).read_text(encoding="utf-8"))),
        # in ASCII, and a string of JSON may hold "</script>"; it is the same string with this escape
        data=lambda value: Markup(json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")))
    try:
        text = environment.get_template(template).render(content, page=content, kind=pathlib.Path(template).stem)
    except (jinja2.exceptions.UndefinedError, TypeError) as error:
        fail("its data are damaged, or those of another version: %s" % error)
    pathlib.Path(page).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
