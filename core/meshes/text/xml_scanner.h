#pragma once
// The tags of an XML text one after the other, with their lines.
//
// Boost.PropertyTree would read the same files, but keeps no line numbers, which every error of ours has, and descends
// once per nested element, so that a file could exhaust the stack.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dartboard {

/// An opening or closing tag. An empty one (<a/>) comes as both.
struct XmlTag {
  std::string_view name;
  bool closes = false;
  std::size_t line = 0;
  std::vector<std::pair<std::string_view, std::string_view>> attributes = {};  // as written; entities are not decoded

  std::optional<std::string_view> attribute(std::string_view key) const;
};

/// Checks that tags nest; comments and declarations are passed over. Views point into the text.
///
/// throws  IoError where the text is not XML, or ends inside an element
class XmlScanner {
 public:
  XmlScanner(std::string_view text, std::string file);

  /// The next tag; nothing at the end of the text.
  std::optional<XmlTag> next();
  /// What stands between the tag returned last and the next one, and the line where it starts.
  std::string_view text() const;
  std::size_t line() const { return line_; }
  /// The element around the one opened last; empty for the outermost.
  std::string_view parent() const { return open_.size() < 2 ? std::string_view{} : open_[open_.size() - 2].first; }

 private:
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;
  void advance(std::size_t to);
  void skip_blank();
  void skip_past(std::string_view end);
  bool skip_unmarked();
  std::string_view take_name();
  void take_attributes(XmlTag& tag);
  void close(std::string_view name);

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::vector<std::pair<std::string_view, std::size_t>> open_;  // name and line
  std::optional<XmlTag> pending_close_;
};

}  // namespace dartboard
