#include "core/meshes/text/xml_scanner.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool ends_name(char c) { return is_blank(c) || c == '>' || c == '/' || c == '=' || c == '<' || c == '"' || c == '\''; }

}  // namespace

std::optional<std::string_view> XmlTag::attribute(std::string_view key) const {
  for (const auto& [name_, value] : attributes)
    if (name_ == key) return value;
  return std::nullopt;
}

XmlScanner::XmlScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
}

void XmlScanner::fail(std::string_view found, std::string_view expected) const {
  fail_at(file_, line_, found, expected);
}

void XmlScanner::advance(std::size_t to) {
  to = std::min(to, text_.size());
  line_ += static_cast<std::size_t>(std::ranges::count(text_.substr(at_, to - at_), '\n'));
  at_ = to;
}

void XmlScanner::skip_blank() {
  std::size_t to = at_;
  while (to < text_.size() && is_blank(text_[to])) ++to;
  advance(to);
}

void XmlScanner::skip_past(std::string_view end) {
  const std::size_t found = text_.find(end, at_);
  if (found == text_.npos) fail("the text ends inside a comment or declaration", fmt::format("{} to end it", end));
  advance(found + end.size());
}

/// Pass over one comment or declaration, if one is next.
bool XmlScanner::skip_unmarked() {
  const std::string_view rest = text_.substr(at_);
  if (rest.starts_with("<!--"))
    skip_past("-->");
  else if (rest.starts_with("<?"))
    skip_past("?>");
  else if (rest.starts_with("<!"))
    fail(fmt::format("found {}", in_quotes(rest.substr(0, 9))), "a tag: document types and raw data are not read");
  else
    return false;
  return true;
}

std::string_view XmlScanner::take_name() {
  std::size_t to = at_;
  while (to < text_.size() && !ends_name(text_[to])) ++to;
  if (to == at_) fail(fmt::format("found {}", in_quotes(text_.substr(at_, 1))), "a name");
  const std::string_view name = text_.substr(at_, to - at_);
  at_ = to;
  return name;
}

void XmlScanner::take_attributes(XmlTag& tag) {
  for (skip_blank(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_blank()) {
    const std::string_view key = take_name();
    const std::string wanted = fmt::format("the attribute {} of <{}> as name=\"value\"", in_quotes(key), tag.name);
    skip_blank();
    if (at_ == text_.size() || text_[at_] != '=') fail("found no =", wanted);
    advance(at_ + 1);
    skip_blank();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : text_.npos;
    if (end == text_.npos) fail("found no value in quotes", wanted);
    if (tag.attribute(key)) fail(fmt::format("found {} twice", in_quotes(key)), wanted);
    tag.attributes.emplace_back(key, text_.substr(at_ + 1, end - at_ - 1));
    advance(end + 1);
  }
}

void XmlScanner::close(std::string_view name) {
  if (open_.empty()) fail(fmt::format("found the end of {}", in_quotes(name)), "its beginning before it");
  if (open_.back().first != name)
    fail(fmt::format("found the end of {}", in_quotes(name)),
         fmt::format("the end of <{}>, begun in line {}", open_.back().first, open_.back().second));
  open_.pop_back();
}

std::string_view XmlScanner::text() const { return text_.substr(at_, text_.find('<', at_) - at_); }

std::optional<XmlTag> XmlScanner::next() {
  if (pending_close_) {
    open_.pop_back();
    return std::exchange(pending_close_, std::nullopt);
  }
  do {
    const std::size_t tag = std::min(text_.find('<', at_), text_.size());
    advance(tag);
    if (at_ == text_.size()) {
      if (!open_.empty())
        fail("the text ends here",
             fmt::format("the end of <{}>, begun in line {}", open_.back().first, open_.back().second));
      return std::nullopt;
    }
  } while (skip_unmarked());

  ++at_;
  XmlTag tag{.name = {}, .line = line_};
  tag.closes = at_ < text_.size() && text_[at_] == '/';
  if (tag.closes) ++at_;
  tag.name = take_name();
  if (!tag.closes) take_attributes(tag);
  skip_blank();
  const bool is_empty = !tag.closes && at_ < text_.size() && text_[at_] == '/';
  if (is_empty) ++at_;
  if (at_ == text_.size() || text_[at_] != '>')
    fail("found no >", fmt::format("the end of the tag {}", in_quotes(tag.name)));
  ++at_;
  if (tag.closes) {
    close(tag.name);
    return tag;
  }
  open_.emplace_back(tag.name, tag.line);
  if (is_empty) pending_close_ = XmlTag{.name = tag.name, .closes = true, .line = line_};
  return tag;
}

}  // namespace dartboard
