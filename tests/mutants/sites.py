"""Where a program can be changed: every place in the rooms where one change gives another program that might compile.

Read from the syntax tree with libclang (Debian: python3-clang-14), so that each change is an expression for an
expression, or a statement for a statement, at their exact ends. Left out are places that only the compiler evaluates:
template arguments, array bounds, case labels, enumerators, `if constexpr`, static_assert, sizeof, concepts; and text:
strings and characters.
"""

import json
import multiprocessing
import os
import re
import shlex

import clang.cindex as clang
from clang.cindex import CursorKind as K

NOT_RUN = {K.STATIC_ASSERT, K.ENUM_DECL, K.CXX_UNARY_EXPR, K.TEMPLATE_NON_TYPE_PARAMETER, K.TEMPLATE_TYPE_PARAMETER,
           K.TEMPLATE_TEMPLATE_PARAMETER, K.TYPE_ALIAS_DECL, K.TYPEDEF_DECL, K.USING_DECLARATION, K.USING_DIRECTIVE,
           K.TYPE_REF, K.TEMPLATE_REF, K.NAMESPACE_REF, K.STRING_LITERAL, K.CHARACTER_LITERAL, K.ALIGNED_ATTR,
           K.TYPE_ALIAS_TEMPLATE_DECL, K.FRIEND_DECL}
if hasattr(K, "CONCEPT_DECL"):
    NOT_RUN.add(K.CONCEPT_DECL)
FUNCTIONS = {K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR, K.DESTRUCTOR, K.CONVERSION_FUNCTION, K.FUNCTION_TEMPLATE}
LOOPS = {K.FOR_STMT, K.WHILE_STMT, K.DO_STMT, K.CXX_FOR_RANGE_STMT}
SCOPES = FUNCTIONS | LOOPS | {K.COMPOUND_STMT, K.LAMBDA_EXPR, K.IF_STMT, K.SWITCH_STMT, K.CXX_CATCH_STMT}

OTHER_OPERATOR = {
    "<": ["<=", ">"], "<=": ["<", ">="], ">": [">=", "<"], ">=": [">", "<="], "==": ["!="], "!=": ["=="],
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"],
    "+=": ["-=", "="], "-=": ["+=", "="], "*=": ["/=", "="], "/=": ["*=", "="],
    "&&": ["||"], "||": ["&&"], "&": ["|"], "|": ["&"], "^": ["&"], "<<": [">>"], ">>": ["<<"],
    "&=": ["|="], "|=": ["&="], "^=": ["|="], "<<=": [">>="], ">>=": ["<<="],
}
COMPARISONS = {"<", "<=", ">", ">=", "==", "!="}
OTHER_FUNCTION = {"max": "min", "min": "max", "floor": "ceil", "ceil": "floor", "front": "back", "back": "front",
                  "any_of": "all_of", "all_of": "any_of", "none_of": "any_of", "lower_bound": "upper_bound",
                  "upper_bound": "lower_bound", "sin": "cos", "cos": "sin", "min_element": "max_element",
                  "max_element": "min_element", "minCoeff": "maxCoeff", "maxCoeff": "minCoeff", "norm": "squaredNorm",
                  "squaredNorm": "norm"}
NUMBER = re.compile(r"(0[xX][0-9a-fA-F']+|\d[\d']*\.?[\d']*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)([uUlLzZfF]*)$")


class Finder:
    """Walks one translation unit and notes the sites in files of the project that no earlier unit has shown."""

    def __init__(self, root, rooms):
        self.root, self.rooms = root, tuple(room + "/" for room in rooms)
        self.done, self.sites, self.names = set(), [], {}

    def walk_unit(self, unit):
        shown = set()
        for cursor in unit.cursor.get_children():
            name = self.name_of(cursor.location.file)
            if not name or name in self.done:
                continue
            shown.add(name)
            self.file = name
            with open(os.path.join(self.root, name), "rb") as source:
                self.text = source.read()
            self.scopes, self.found, self.switch_depth = [], set(), 0
            self.constant, self.constexpr_at = False, None
            self.visit(cursor, None)
        self.done |= shown

    # what is at which place

    def name_of(self, file):
        """A file's name from the root of the project, or the empty name."""
        spelled = file.name if file else ""
        if spelled not in self.names:
            name = os.path.relpath(os.path.realpath(spelled), self.root) if spelled else ""
            self.names[spelled] = name if name.startswith(self.rooms) else ""
        return self.names[spelled]

    def range(self, cursor):
        extent = cursor.extent
        start, stop = extent.start, extent.end
        begin, end = start.offset, stop.offset
        return (begin, end) if begin < end and self.name_of(start.file) == self.file == self.name_of(stop.file) else None

    def snippet(self, begin, end):
        return self.text[begin:end].decode()

    def before(self, offset):
        """The last character before a place that is not a space."""
        k = offset - 1
        while k >= 0 and self.text[k:k + 1].isspace():
            k -= 1
        return self.text[k:k + 1].decode(errors="replace")

    def after(self, offset):
        while offset < len(self.text) and self.text[offset:offset + 1].isspace():
            offset += 1
        return self.text[offset:offset + 1].decode(errors="replace")

    def is_template_argument(self, begin, end):
        """The project's format puts spaces around comparisons and none around template arguments."""
        return self.text[begin - 1:begin] == b"<" or self.text[end:end + 1] == b">"

    # noting

    def note(self, kind, edits, statement=False, value=False):
        """One site. `edits` holds for each alternative the list of (begin, end, new text) that makes it."""
        edits = [alternative for alternative in edits
                 if all(new != self.snippet(begin, end) and "//" not in new and "#" not in new for begin, end, new in alternative)]
        if not edits:
            return
        places = tuple((begin, end) for begin, end, _ in edits[0])
        if (kind, places) in self.found:
            return
        self.found.add((kind, places))
        site = {"file": self.file, "line": self.text.count(b"\n", 0, places[0][0]) + 1, "kind": kind, "edits": edits}
        if statement:
            site["statement"] = True
        if value:
            site["value"] = True
        if self.constexpr_at is not None:
            site["constexpr_at"] = self.constexpr_at
        if self.constant:
            site["constant"] = True
        self.sites.append(site)

    # the walk

    def visit(self, cursor, parent):
        kind = cursor.kind
        if kind in NOT_RUN or kind.is_attribute():
            return
        saved = self.constant, self.constexpr_at
        if kind in FUNCTIONS:
            place = self.range(cursor)
            if place is None:
                return
            head = self.text[place[0]:place[1]].split(b"{")[0]
            if b"consteval" in head:
                return
            self.constant = b"constexpr" in head
            self.constexpr_at = None
        elif kind in (K.FIELD_DECL, K.PARM_DECL):
            self.constant = True
        elif kind == K.VAR_DECL:
            self.enter_variable(cursor)
        if kind in SCOPES:
            self.scopes.append([])
        if kind == K.SWITCH_STMT:
            self.switch_depth += 1
        self.look(cursor, parent)
        for child in self.children_to_visit(cursor):
            self.visit(child, cursor)
        if kind == K.SWITCH_STMT:
            self.switch_depth -= 1
        if kind in SCOPES:
            self.scopes.pop()
        if kind in (K.VAR_DECL, K.PARM_DECL) and self.scopes and cursor.spelling:
            self.scopes[-1].append((cursor.spelling, plain_type(cursor.type), is_const(cursor.type)))
        self.constant, self.constexpr_at = saved

    def enter_variable(self, cursor):
        place = self.range(cursor)
        if place is None:
            return
        head = self.snippet(place[0], max(place[0], cursor.location.offset))
        match = re.search(r"\bconstexpr\b", head)
        if match:
            # no longer constexpr, its value can be switched; where it must be constexpr, that does not compile
            is_member = cursor.semantic_parent.kind in (K.CLASS_DECL, K.STRUCT_DECL, K.CLASS_TEMPLATE)
            begin = place[0] + len(head[:match.start()].encode())
            self.constexpr_at = [begin, begin + len("constexpr"), "inline const" if is_member else "const"]

    def children_to_visit(self, cursor):
        kind, children = cursor.kind, list(cursor.get_children())
        if kind in (K.DECL_REF_EXPR, K.OVERLOADED_DECL_REF):
            return []
        if kind == K.MEMBER_REF_EXPR:  # the object; not the template arguments
            return [c for c in children if c.extent.start.offset == cursor.extent.start.offset]
        if kind == K.CASE_STMT:
            return children[1:]
        if kind in (K.VAR_DECL, K.FIELD_DECL, K.PARM_DECL):
            name_end = cursor.location.offset + len(cursor.spelling.encode())
            return [c for c in children if c.kind.is_expression() and
                    (c.extent.start.offset == cursor.location.offset or
                     c.extent.start.offset >= name_end and self.before(c.extent.start.offset) != "[")]
        if kind == K.IF_STMT and re.match(rb"if\s+constexpr\b", self.text[cursor.extent.start.offset:]):
            condition = self.condition(cursor, children)
            return [c for c in children if c != condition]
        if kind in FUNCTIONS:
            return [c for c in children if c.kind in (K.PARM_DECL, K.COMPOUND_STMT, K.CXX_TRY_STMT, K.UNEXPOSED_STMT) or
                    cursor.kind in (K.CONSTRUCTOR, K.FUNCTION_TEMPLATE) and c.kind.is_expression()]
        return children

    def condition(self, cursor, children):
        """The condition of a statement, if it is an expression."""
        for c in children:
            place = self.range(c)
            if place is None or not c.kind.is_expression():
                continue
            opens, closes = self.before(place[0]), self.after(place[1])
            if cursor.kind == K.FOR_STMT and (opens, closes) == (";", ";"):
                return c
            if cursor.kind != K.FOR_STMT and opens in ("(", ";") and closes == ")":
                return c
        return None

    # what can be changed at a place

    def look(self, cursor, parent):
        place = self.range(cursor)
        if place is None:
            return
        kind = cursor.kind
        if kind in (K.BINARY_OPERATOR, K.COMPOUND_ASSIGNMENT_OPERATOR, K.CALL_EXPR):
            self.look_operator(cursor, place)
        if kind in (K.IF_STMT, K.WHILE_STMT, K.FOR_STMT, K.DO_STMT, K.CONDITIONAL_OPERATOR):
            self.look_condition(cursor)
        if kind == K.UNARY_OPERATOR:
            self.look_unary(place)
        if kind in (K.INTEGER_LITERAL, K.FLOATING_LITERAL):
            self.look_number(place)
        if kind == K.CXX_BOOL_LITERAL_EXPR and self.snippet(*place) in ("true", "false"):
            self.note("constant", [[(*place, "false" if self.snippet(*place) == "true" else "true")]])
        if kind in (K.CALL_EXPR, K.INIT_LIST_EXPR):
            self.look_arguments(cursor, place)
        if kind == K.CALL_EXPR:
            self.look_function(cursor, place)
        if kind == K.DECL_REF_EXPR:
            self.look_variable(cursor, place)
        if kind == K.MEMBER_REF_EXPR:
            self.look_member(cursor, place)
        if kind == K.RETURN_STMT:
            self.look_return(cursor, place)
        self.look_statement(cursor, parent, place)

    def look_operator(self, cursor, place):
        children = [c for c in cursor.get_children() if self.range(c)]
        children.sort(key=lambda c: c.extent.start.offset)
        if cursor.kind == K.CALL_EXPR:
            if len(children) == 2 and cursor.spelling == "operator[]" or len(children) == 3 and self.text[
                    slice(*self.range(children[1]))] == b"[]":
                self.look_index(self.range(children[-1]), children[-1])
                return
            if len(children) != 3:
                return
            lhs, operator, rhs = children
            op = self.snippet(*self.range(operator))
        else:
            if len(children) != 2:
                return
            lhs, rhs = children
            op = self.snippet(self.range(lhs)[1], self.range(rhs)[0]).strip()
        if op not in OTHER_OPERATOR or any("basic_string" in c.type.get_canonical().spelling for c in (lhs, rhs)):
            return
        if cursor.kind == K.CALL_EXPR and op in ("<<", ">>"):
            return  # streams
        left, right = self.snippet(*self.range(lhs)), self.snippet(*self.range(rhs))
        if right.startswith("{"):
            return
        edits = [[(*place, "(%s) %s (%s)" % (left, other, right))] for other in OTHER_OPERATOR[op]]
        if op in ("&&", "||"):
            edits += [[(*place, left)], [(*place, right)]]
        if op in COMPARISONS:
            self.note("comparison", edits)
        elif op.endswith("="):
            self.note("assignment", edits)
        else:
            self.note("logic" if op in ("&&", "||") else "arithmetic", edits, value=op in ("+", "-", "*", "/"))

    def look_index(self, place, index):
        if place and not self.snippet(*place).isdigit() and is_integral(index.type):
            text = self.snippet(*place)
            self.note("index", [[(*place, "(%s) + 1" % text)], [(*place, "(%s) - 1" % text)]])

    def look_condition(self, cursor):
        children = list(cursor.get_children())
        if cursor.kind == K.CONDITIONAL_OPERATOR:
            condition = children[0] if children else None
        else:
            if cursor.kind == K.IF_STMT and re.match(rb"if\s+constexpr\b", self.text[cursor.extent.start.offset:]):
                return
            condition = self.condition(cursor, children)
        place = condition and self.range(condition)
        if not place or self.snippet(*place) in ("true", "false"):
            return
        edits = [[(*place, "!(%s)" % self.snippet(*place))], [(*place, "false")]]
        if cursor.kind in (K.IF_STMT, K.CONDITIONAL_OPERATOR):
            edits.append([(*place, "true")])
        # a condition may convert to bool only as one
        self.note("condition", [[(b, e, new)] for [(b, e, new)] in edits])

    def look_unary(self, place):
        text = self.snippet(*place)
        for sign in ("++", "--"):
            if text.startswith(sign):
                self.note("arithmetic", [[(*place, ("--" if sign == "++" else "++") + text[2:])]])
                return
            if text.endswith(sign):
                self.note("arithmetic", [[(*place, text[:-2] + ("--" if sign == "++" else "++"))]])
                return
        if text.startswith("-"):
            self.note("sign", [[(*place, text[1:])]], value=True)
        elif text.startswith("!"):
            self.note("condition", [[(*place, "static_cast<bool>(%s)" % text[1:])]])

    def look_number(self, place):
        text = self.snippet(*place)
        match = NUMBER.match(text)
        if not match or self.is_template_argument(*place):
            return
        digits, suffix = match[1].replace("'", ""), match[2]
        if re.fullmatch(r"\d+|0[xX][0-9a-fA-F]+", digits) and "f" not in suffix.lower():
            number = int(digits, 0) if not re.fullmatch(r"0\d+", digits) else int(digits, 8)
            others = ["%d%s" % (number + 1, suffix)]
            if number > 0:
                others.append("%d%s" % (number - 1, suffix))
        else:
            number = float(digits)
            others = ["1.0" + suffix] if number == 0 else ["10 * " + text, "0.1 * " + text, "2 * " + text, "0.0" + suffix]
        self.note("constant", [[(*place, other)] for other in others])

    def look_arguments(self, cursor, place):
        arguments = list(cursor.get_arguments()) if cursor.kind == K.CALL_EXPR else list(cursor.get_children())
        if cursor.kind == K.CALL_EXPR and cursor.spelling.startswith("operator") and cursor.spelling != "operator()":
            return
        for a, b in zip(arguments, arguments[1:]):
            first, second = self.range(a), self.range(b)
            if not first or not second or first[1] > second[0] or plain_type(a.type) != plain_type(b.type):
                continue
            if self.text[first[1]:second[0]].strip() != b"," or not place[0] <= first[0] < second[1] <= place[1]:
                continue
            one, two = self.snippet(*first), self.snippet(*second)
            if one == two or one[0] in "{." or two[0] in "{.":  # lists, and members by name
                continue
            self.note("arguments", [[(*first, two), (*second, one)]])

    def look_function(self, cursor, place):
        other = OTHER_FUNCTION.get(cursor.spelling)
        if not other:
            return
        match = re.search(r"\b%s(?=\s*\()" % cursor.spelling, self.snippet(*place))
        if match:
            text = self.snippet(*place)
            self.note("function", [[(*place, text[:match.start()] + other + text[match.end():])]], value=True)

    def look_variable(self, cursor, place):
        target = cursor.referenced
        if target is None or self.snippet(*place) != cursor.spelling and target.kind != K.ENUM_CONSTANT_DECL:
            return
        if target.kind in (K.VAR_DECL, K.PARM_DECL):
            wanted, constant = plain_type(target.type), is_const(target.type)
            names = [name for scope in self.scopes for name, type, is_constant in scope
                     if type == wanted and name != cursor.spelling and (constant or not is_constant)]
            if wanted and cursor.spelling in (name for scope in self.scopes for name, _, _ in scope):
                self.note("neighbour", [[(*place, name)] for name in dict.fromkeys(reversed(names))][:4])
        elif target.kind == K.ENUM_CONSTANT_DECL and not self.is_template_argument(*place):
            text = self.snippet(*place)
            others = [c.spelling for c in target.semantic_parent.get_children()
                      if c.kind == K.ENUM_CONSTANT_DECL and c.spelling != target.spelling]
            self.note("neighbour", [[(*place, text[:len(text) - len(target.spelling)] + name)] for name in others[:4]])

    def look_member(self, cursor, place):
        target = cursor.referenced
        if target is None or target.kind not in (K.FIELD_DECL, K.CXX_METHOD) or not self.is_ours(target):
            return
        text = self.snippet(*place)
        if not text.endswith(target.spelling):
            return
        if target.kind == K.CXX_METHOD:
            if not (target.is_const_method() and not list(target.get_arguments()) and self.after(place[1]) == "("):
                return
            alike = [c for c in target.semantic_parent.get_children()
                     if c.kind == K.CXX_METHOD and c.is_const_method() and not list(c.get_arguments()) and
                     c.access_specifier == target.access_specifier and
                     c.result_type.get_canonical().spelling == target.result_type.get_canonical().spelling]
            close = self.text.index(b")", place[1]) + 1
            if self.text[place[1]:close].strip() != b"()":
                return
            place, call = (place[0], close), "()"
        else:
            alike = [c for c in target.semantic_parent.get_children()
                     if c.kind == K.FIELD_DECL and plain_type(c.type) == plain_type(target.type)]
            call = ""
        stem = text[:len(text) - len(target.spelling)]
        names = [c.spelling for c in alike if c.spelling and c.spelling != target.spelling]
        self.note("neighbour", [[(*place, stem + name + call)] for name in names[:4]])

    def is_ours(self, cursor):
        return bool(self.name_of(cursor.location.file))

    def look_return(self, cursor, place):
        children = list(cursor.get_children())
        if not children or self.text[place[1]:place[1] + 1] != b";":
            return
        value = self.snippet(*place)[len("return"):].strip()
        begin, end = place[0], place[1] + 1
        if value in ("true", "false", "{}", "0", "0.0", "*this", "nullptr"):
            return  # noted as a constant, or the same
        self.note("return", [[(begin, end, "return {};")]], statement=True)

    def look_statement(self, cursor, parent, place):
        if parent is None:
            return
        kind = cursor.kind
        begin, end = place
        if kind in (K.CXX_FOR_RANGE_STMT, K.FOR_STMT) and parent.kind == K.COMPOUND_STMT:
            if self.text[end - 1:end] == b"}" or self.text[end:end + 1] == b";":
                end += self.text[end:end + 1] == b";" and self.text[end - 1:end] != b"}"
                self.note("dropped", [[(begin, end, "")]], statement=True)
            return
        is_jump = kind == K.CONTINUE_STMT or kind == K.BREAK_STMT and self.switch_depth == 0
        is_end = kind == K.RETURN_STMT and not list(cursor.get_children())
        if not (is_jump or is_end or kind.is_expression()):
            return
        if self.text[end:end + 1] != b";":
            return
        body = parent.kind == K.COMPOUND_STMT or \
            parent.kind in LOOPS | {K.IF_STMT} and (self.before(begin) == ")" or self.text[:begin].rstrip().endswith((b"else", b"do")))
        if not body:
            return
        if self.snippet(begin, end).startswith("throw"):
            # without it a function may end without a value, and compilers assume that it never does
            if parent.kind != K.IF_STMT:
                return
        self.note("dropped", [[(begin, end + 1, "")]], statement=True)


def plain_type(type):
    """The type without references and const; empty where it depends on template parameters."""
    spelled = type.get_canonical().spelling.replace("&", "").strip()
    if "dependent" in spelled or "type-parameter" in spelled or not spelled:
        return ""
    return re.sub(r"^const ", "", spelled)


def is_const(type):
    canonical = type.get_canonical()
    if canonical.kind in (clang.TypeKind.LVALUEREFERENCE, clang.TypeKind.RVALUEREFERENCE):
        canonical = canonical.get_pointee()
    return canonical.is_const_qualified()


def is_integral(type):
    T = clang.TypeKind
    canonical = type.get_canonical()
    if canonical.kind == T.LVALUEREFERENCE:
        canonical = canonical.get_pointee()
    return canonical.kind in (T.INT, T.UINT, T.LONG, T.ULONG, T.SHORT, T.USHORT, T.LONGLONG, T.ULONGLONG, T.CHAR_S,
                              T.UCHAR, T.SCHAR)


def arguments_of(command):
    """What clang understands of a compiler's command line, less inputs, outputs and what is precompiled."""
    words, kept, skip = shlex.split(command), [], False
    compiler = 0 if words[1].startswith("-") else 1  # behind a launcher, such as ccache
    for word in words[compiler + 1:]:
        if skip:
            skip = False
        elif word in ("-o", "-c", "-MF", "-MT", "-include"):
            skip = True
        elif word.startswith(("-I", "-D", "-U", "-std", "-isystem", "-f", "-m")) and word != "-fno-tree-slp-vectorize" or \
                not word.startswith("-"):
            kept.append(word)
    return kept + ["-w", "-ferror-limit=0"]


WALKED = set()  # files of the project that this process has walked


def parse(file, command, prelude=None):
    """The syntax tree of a source, and clang's errors."""
    ahead = ["-include-pch", prelude] if prelude else []
    try:
        unit = clang.Index.create(excludeDecls=True).parse(file, args=ahead + arguments_of(command))
    except clang.TranslationUnitLoadError:
        unit = None
    errors = [str(d) for d in unit.diagnostics if d.severity >= clang.Diagnostic.Error] if unit else ["no tree"]
    errors = [error for error in errors if "__va_list_tag" not in error]  # a slip of clang 14 with precompiled headers
    return parse(file, command) if errors and prelude else (unit, errors)  # built with other options than the prelude


def sites_of_unit(job):
    root, rooms, file, command, prelude = job
    unit, errors = parse(file, command, prelude)
    finder = Finder(root, rooms)
    finder.done = WALKED
    if unit:
        finder.walk_unit(unit)
    return file, errors, finder.sites


def precompile(root, rooms, command, folder):
    """The headers of libraries that most sources share, read once: they are most of what there is to read."""
    names = set()
    for room in rooms:
        for where, _, files in os.walk(os.path.join(root, room)):
            for file in files:
                if file.endswith((".h", ".cpp")):
                    with open(os.path.join(where, file), encoding="utf-8") as text:
                        names.update(re.findall(r"^#include <((?!CGAL|cvode|arkode|sun|nvector|benchmark)[^>]+)>", text.read(), re.M))
    header = os.path.join(folder, "prelude.h")
    with open(header, "w", encoding="utf-8") as file:
        file.writelines("#include <%s>\n" % name for name in sorted(names))
    try:
        unit = clang.Index.create().parse(header, args=["-x", "c++-header"] + arguments_of(command),
                                          options=clang.TranslationUnit.PARSE_INCOMPLETE)
        unit.save(header + ".pch")
    except (clang.TranslationUnitLoadError, clang.TranslationUnitSaveError):
        return None
    return header + ".pch"


def find_sites(root, rooms, compile_commands, workers, say, units=None):
    """All sites in the rooms below `root`: sources by their own units, headers by the first unit that includes them. Or
    those in what some units read."""
    root = os.path.realpath(root)
    with open(compile_commands, encoding="utf-8") as file:
        commands = {entry["file"]: entry["command"] for entry in json.load(file)}
    commands = {file: command for file, command in sorted(commands.items())
                if os.path.relpath(file, root).startswith(tuple(room + "/" for room in rooms))}
    general = next(command for file, command in commands.items() if file.endswith("benchmarks/harness_main.cpp"))
    prelude = precompile(root, rooms, general, os.path.dirname(compile_commands))
    if units is not None:
        commands = {os.path.join(root, unit): general for unit in units}
    jobs = [(root, rooms, file, command, prelude) for file, command in commands.items()]
    by_place = {}
    with multiprocessing.Pool(workers) as pool:
        for done, (file, errors, sites) in enumerate(pool.imap_unordered(sites_of_unit, jobs), 1):
            if errors:
                say("clang reads %s with errors: %s" % (os.path.relpath(file, root), errors[0]))
            for site in sites:
                key = (site["file"], site["kind"], tuple(map(tuple, (edit[:2] for edit in site["edits"][0]))))
                by_place.setdefault(key, site)
            if done % 20 == 0:
                say("read %d of %d sources" % (done, len(jobs)))
    if not by_place and units is None:
        raise SystemExit("mutants: no place to change was found in " + ", ".join(rooms))
    # the same whichever process walked a header first
    return sorted(by_place.values(), key=lambda s: (s["file"], s["edits"][0][0][0], s["edits"][0][0][1], s["kind"]))
