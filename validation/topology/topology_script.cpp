#include "validation/topology/topology_script.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr std::string_view first_line = "dartboard-topology-script 1";
constexpr std::array all_kinds{CellKind::triangle, CellKind::quadrilateral, CellKind::tetrahedron,
                               CellKind::pyramid,  CellKind::prism,         CellKind::hexahedron};

/// The significant lines of a script, one at a time, and errors that name the present one.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  /// The next line without comment and surrounding blanks; nothing at the end.
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      ++number_;
      const auto end = rest_.find('\n');
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      line = line.substr(0, line.find('#'));
      line = trimmed(line);
      if (!line.empty()) return line;
    }
    ++number_;
    return std::nullopt;
  }
  [[noreturn]] void expected(std::string_view what, std::string_view found) const {
    throw IoError(fmt::format("{}:{}: expected {}, found {}", file_, number_, what,
                              found.empty() ? "nothing" : fmt::format("\"{}\"", found)));
  }
  static std::string_view trimmed(std::string_view s) {
    const auto from = s.find_first_not_of(" \t\r");
    if (from == std::string_view::npos) return {};
    return s.substr(from, s.find_last_not_of(" \t\r") - from + 1);
  }

 private:
  std::string_view rest_;
  const std::string& file_;
  std::size_t number_ = 0;
};

/// The words of one line, from left to right.
class Words {
 public:
  Words(const Lines& lines, std::string_view line) : lines_(lines), rest_(line) {}

  std::string_view next() {
    rest_ = Lines::trimmed(rest_);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t"));
    rest_.remove_prefix(word.size());
    return word;
  }
  Dart dart() {
    const std::string_view word = next();
    Dart d;
    const char* end = word.data() + word.size();
    if (word.size() < 2 || word[0] != 'd') lines_.expected("a dart such as d17", word);
    const auto [stop, error] = std::from_chars(word.data() + 1, end, d.index);
    // names are vector indices in every twin: a typing error must not request gigabytes
    if (error != std::errc() || stop != end || d.index >= (1u << 28)) lines_.expected("a dart d0 .. d268435455", word);
    return d;
  }
  int involution() {
    const std::string_view word = next();
    if (word.size() != 1 || word[0] < '0' || word[0] > '3') lines_.expected("an involution, 0 to 3", word);
    return word[0] - '0';
  }
  CellKind cell() {
    const std::string_view word = next();
    for (const CellKind kind : all_kinds)
      if (name(kind) == word) return kind;
    lines_.expected("a kind of cell: triangle, quadrilateral, tetrahedron, pyramid, prism or hexahedron", word);
  }
  bool at_end() const { return Lines::trimmed(rest_).empty(); }
  void end() {
    if (!at_end()) lines_.expected("the end of the line", Lines::trimmed(rest_));
  }

 private:
  const Lines& lines_;
  std::string_view rest_;
};

/// The text after the word that a header line must begin with.
std::string_view header(Lines& lines, std::string_view word, std::string_view what) {
  const auto line = lines.next();
  const std::string expected = fmt::format("\"{} {}\"", word, what);
  if (!line || !line->starts_with(word)) lines.expected(expected, line.value_or(""));
  const std::string_view after = line->substr(word.size());
  if (after.empty() || (after[0] != ' ' && after[0] != '\t')) lines.expected(expected, *line);
  return Lines::trimmed(after);
}

template <class Value, std::size_t n>
Value one_of(const Lines& lines, std::string_view found, const std::array<Value, n>& values) {
  std::string known;
  for (const Value value : values) {
    if (name(value) == found) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name(value));
  }
  lines.expected("one of " + known, found);
}

Operation parse_operation(const Lines& lines, std::string_view line) {
  Words words(lines, line);
  const std::string_view verb = words.next();
  Operation op;
  if (verb == "sew") {
    op.kind = Operation::Kind::sew;
    op.i = static_cast<std::int8_t>(words.involution());
    op.a = words.dart();
    op.b = words.dart();
  } else if (verb == "unsew") {
    op.kind = Operation::Kind::unsew;
    op.i = static_cast<std::int8_t>(words.involution());
    op.a = words.dart();
  } else if (verb == "dissociate" || verb == "remove") {
    op.kind = verb == "remove" ? Operation::Kind::remove : Operation::Kind::dissociate;
    op.a = words.dart();
  } else if (verb == "add") {
    op.kind = Operation::Kind::add;
    op.cell = words.cell();
    if (!words.at_end()) op.a = words.dart();
  } else {
    lines.expected("sew, unsew, dissociate, remove or add", verb);
  }
  words.end();
  return op;
}

}  // namespace

std::string_view name(ScriptStorage storage) {
  return storage == ScriptStorage::tetrahedral ? "tetrahedral" : "general";
}

std::string_view name(ScriptOracles oracles) {
  return oracles == ScriptOracles::none ? "none" : oracles == ScriptOracles::gmap ? "gmap" : "both";
}

std::string to_string(const Operation& op) {
  switch (op.kind) {
    case Operation::Kind::sew: return fmt::format("sew {} {} {}", op.i, to_string(op.a), to_string(op.b));
    case Operation::Kind::unsew: return fmt::format("unsew {} {}", op.i, to_string(op.a));
    case Operation::Kind::dissociate: return fmt::format("dissociate {}", to_string(op.a));
    case Operation::Kind::remove: return fmt::format("remove {}", to_string(op.a));
    case Operation::Kind::add: break;
  }
  return op.a == no_dart ? fmt::format("add {}", name(op.cell))
                         : fmt::format("add {} {}", name(op.cell), to_string(op.a));
}

std::string to_string(const TopologyScript& script) {
  // a name of several lines would be read as operations
  const bool one_line = script.mesh.find_first_of("\r\n") == std::string::npos;
  std::string text =
      fmt::format("{}\nmesh {}\nstorage {}\noracles {}\n", first_line,
                  one_line ? script.mesh : terminal_text(script.mesh), name(script.storage), name(script.oracles));
  for (const Operation& op : script.operations) text += to_string(op) + "\n";
  return text;
}

TopologyScript parse_topology_script(std::string_view text, const std::string& file) {
  Lines lines(text, file);
  if (const auto line = lines.next(); line != first_line)
    lines.expected(fmt::format("\"{}\"", first_line), line.value_or(""));
  TopologyScript script;
  script.mesh = header(lines, "mesh", "NAME");
  script.storage = one_of(lines, header(lines, "storage", "general|tetrahedral"),
                          std::array{ScriptStorage::general, ScriptStorage::tetrahedral});
  script.oracles = one_of(lines, header(lines, "oracles", "none|gmap|both"),
                          std::array{ScriptOracles::none, ScriptOracles::gmap, ScriptOracles::both});
  while (const auto line = lines.next()) script.operations.push_back(parse_operation(lines, *line));
  return script;
}

TopologyScript read_topology_script(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw IoError(fmt::format("{}: cannot be read as a script", path.string()));
  return parse_topology_script(text.str(), path.string());
}

void write_topology_script(const std::filesystem::path& path, const TopologyScript& script) {
  std::ofstream file(path, std::ios::binary);
  file << to_string(script);
  file.close();
  if (!file) throw IoError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace dartboard
