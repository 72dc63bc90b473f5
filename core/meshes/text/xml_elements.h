#pragma once
// The elements of an XML text, with their lines, as Expat reads them.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dartboard {

struct XmlElement {
  static constexpr std::size_t no_parent = std::numeric_limits<std::size_t>::max();

  std::string name;
  std::size_t line = 0;
  std::size_t parent = no_parent;  // its place among the elements
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::string_view text = {};  // the text before its end, or before the first element in it; as written
  std::size_t text_line = 0;

  std::optional<std::string_view> attribute(std::string_view key) const;
};

/// All elements in the order of their tags; texts point into `text`. Reading ends at an element called `last`: its text
/// is all that comes after its tag, XML or not. Document types are refused, and with them user-defined entities.
///
/// throws  IoError if the text is not XML, or ends inside an element
std::vector<XmlElement> read_xml(std::string_view text, const std::string& file, std::string_view last = {});

}  // namespace dartboard
