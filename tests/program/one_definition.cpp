#include "tests/program/one_definition.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace dartboard {

namespace {

using Words = std::vector<std::string>;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// The words and signs of a source, without comments, directives and quoted text.
Words words_of(std::string_view text) {
  Words words;
  bool line_begins = true;
  const auto past = [&](std::size_t from, std::string_view end) {
    const auto at = text.find(end, from);
    return at == std::string_view::npos ? text.size() : at + end.size();
  };
  for (std::size_t k = 0; k < text.size();) {
    const char c = text[k];
    const auto rest = text.substr(k);
    if (c == '\n') line_begins = true;
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++k;
    } else if (rest.starts_with("//")) {
      k = std::min(text.find('\n', k), text.size());
    } else if (rest.starts_with("/*")) {
      k = past(k, "*/");
    } else if (c == '#' && line_begins) {
      do k = past(k, "\n");
      while (k >= 2 && k < text.size() && text[k - 2] == '\\');
      continue;  // at the beginning of a line
    } else if (c == '"' && !words.empty() && words.back().ends_with('R') && k > 0 && text[k - 1] == 'R') {
      const auto open = text.find('(', k);
      words.back() = "\"\"";
      k = past(open, ")" + std::string(text.substr(k + 1, open - k - 1)) + "\"");
    } else if (c == '"' || c == '\'') {
      for (++k; k < text.size() && text[k] != c; ++k)
        if (text[k] == '\\') ++k;
      ++k;
      words.push_back("\"\"");
    } else if (is_word(c)) {
      const auto begin = k;
      // 1'000'000 is one number
      while (k < text.size() && (is_word(text[k]) || (text[k] == '\'' && std::isdigit(static_cast<unsigned char>(c)) &&
                                                      k + 1 < text.size() && is_word(text[k + 1]))))
        ++k;
      words.emplace_back(text.substr(begin, k - begin));
    } else {
      // "::", and comparisons and assignments that are not "="
      const bool two =
          rest.starts_with("::") || (rest.size() > 1 && rest[1] == '=' && c != '{' && c != '(' && c != ',');
      words.emplace_back(rest.substr(0, two ? 2 : 1));
      k += words.back().size();
    }
    if (c != '\n' && !std::isspace(static_cast<unsigned char>(c))) line_begins = false;
  }
  return words;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string joined(Words::const_iterator begin, Words::const_iterator end) {
  std::string text;
  for (; begin != end; ++begin) {
    if (!text.empty() && is_word(text.back()) && is_word(begin->front())) text += ' ';
    text += *begin;
  }
  return text;
}

// The position after the bracket that closes the one at `open`.
template <class Iterator>
Iterator past_brackets(Iterator open, Iterator end, const char* opening, const char* closing) {
  int depth = 0;
  for (; open != end; ++open) {
    if (*open == opening) ++depth;
    if (*open == closing && --depth == 0) return ++open;
  }
  return end;
}

// A declaration without its template parameters and attributes.
Words bare(const Words& head) {
  Words words;
  for (auto k = head.begin(); k != head.end();) {
    if (*k == "template" && k + 1 != head.end() && k[1] == "<")
      k = past_brackets(k + 1, head.end(), "<", ">");
    else if (*k == "[" && k + 1 != head.end() && k[1] == "[")
      k = past_brackets(k, head.end(), "[", "]");
    else if (is_one_of(*k, {"alignas", "noexcept", "decltype", "requires"}) && k + 1 != head.end() && k[1] == "(")
      k = past_brackets(k + 1, head.end(), "(", ")");
    else
      words.push_back(*k++);
  }
  return words;
}

// The name defined by the declaration before a brace or semicolon; empty if no other source could define it.
std::string name_of(const Words& declaration, bool has_body) {
  const Words head = bare(declaration);
  const auto begin = head.begin(), end = head.end();
  if (head.empty() || std::find(begin, end, "static") != end) return {};
  if (has_body) {
    const auto paren = std::find(begin, end, "(");
    auto equals = std::find(begin, end, "=");
    if (equals != end && equals != begin && equals[-1] == "operator") equals = end;
    const auto kind = std::find_if(begin, end, [](const auto& w) {
      return is_one_of(w, {"struct", "class", "union", "enum"});
    });
    if (kind != end && kind < paren && kind < equals) {
      auto name = kind + 1;
      if (name != end && is_one_of(*name, {"class", "struct"})) ++name;
      const auto stop = std::find_if(name, end, [](const auto& w) { return is_one_of(w, {":", "final"}); });
      return joined(name, stop);
    }
    if (paren != end && paren != begin && paren < equals) {  // a function: its name up to the end of its parameters
      auto open = paren;
      if (open[-1] == "operator" && open + 2 < end) open += 2;  // operator()
      auto name = std::find(begin, open, "operator");
      if (name == open) name = open - 1;
      while (name - begin >= 2 && name[-1] == "::") {  // the class that it is a member of
        name -= 2;
        for (int depth = *name == ">"; depth > 0 && name != begin; depth += (*name == ">") - (*name == "<")) --name;
        if (*name == "<" && name != begin) --name;
      }
      auto close = past_brackets(open, end, "(", ")");
      if (close != end && *close == "const") ++close;
      return joined(name, close);
    }
  }
  const auto stop = std::find_if(begin, end, [](const auto& w) { return is_one_of(w, {"=", "[", "{"}); });
  if (*begin == "using" && stop - begin == 2 && stop != end && *stop == "=") return begin[1];
  if (*begin == "concept") return begin[1];
  if (std::find(begin, stop, "inline") != stop && (stop != end || has_body) && std::find(begin, stop, "(") == stop)
    return stop[-1];
  return {};
}

}  // namespace

void add_definitions(std::string_view text, const std::string& file, Definitions& found) {
  const Words words = words_of(text);
  std::vector<std::string> scopes;  // of the namespaces around: "dartboard::", or "" that is the file's own
  int own = 0;                      // how many of them are unnamed
  Words head;
  const auto note = [&](bool has_body) {
    const std::string name = name_of(head, has_body);
    if (name.empty() || own > 0) return;
    std::string whole;
    for (const auto& scope : scopes) whole += scope;
    found[whole + name].insert(file);
  };
  for (auto k = words.begin(); k != words.end(); ++k) {
    if (*k == ";") {
      note(false);
      head.clear();
    } else if (*k == "}") {
      if (!scopes.empty()) {
        if (scopes.back().empty()) --own;
        scopes.pop_back();
      }
      head.clear();
    } else if (*k == "(") {
      const auto close = past_brackets(k, words.end(), "(", ")");
      head.insert(head.end(), k, close);
      k = close - 1;
    } else if (*k == "{") {
      if (head.size() > 1 && head[0] == "inline" && head[1] == "namespace") head.erase(head.begin());
      if (!head.empty() && head[0] == "namespace") {
        scopes.push_back(head.size() == 1 ? "" : joined(head.begin() + 1, head.end()) + "::");
        if (head.size() == 1) ++own;
        head.clear();
        continue;
      }
      note(true);
      k = past_brackets(k, words.end(), "{", "}") - 1;
      // a list goes on until its semicolon; members and initialisers of constructors too
      if (k + 1 == words.end() || !is_one_of(k[1], {",", "{", ";", "."})) head.clear();
      if (k + 1 != words.end() && k[1] == ";") {
        head.clear();
        ++k;
      }
    } else {
      head.push_back(*k);
    }
  }
}

}  // namespace dartboard
