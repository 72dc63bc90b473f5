#include "core/meshes/text/xml_elements.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

struct Reader {
  XML_Parser parser;
  std::string_view text;
  const std::string& file;
  std::string_view last;
  std::vector<XmlElement> elements = {};
  std::vector<std::size_t> open = {};
  bool awaits_text_end = false;  // of the element opened last
  bool stopped = false;
  std::exception_ptr error = nullptr;

  std::size_t line() const { return static_cast<std::size_t>(XML_GetCurrentLineNumber(parser)); }
  std::size_t place() const {
    return std::min(static_cast<std::size_t>(std::max<XML_Index>(0, XML_GetCurrentByteIndex(parser))), text.size());
  }
  std::size_t end_of_tag() const {
    return std::min(place() + static_cast<std::size_t>(XML_GetCurrentByteCount(parser)), text.size());
  }

  void end_text() {
    if (!awaits_text_end) return;
    XmlElement& element = elements[open.back()];
    const auto begin = static_cast<std::size_t>(element.text.data() - text.data());
    element.text = text.substr(begin, std::max(begin, place()) - begin);
    awaits_text_end = false;
  }

  void start(const char* name, const char** attributes) {
    end_text();
    XmlElement element{.name = name, .line = line(), .parent = open.empty() ? XmlElement::no_parent : open.back()};
    for (; *attributes != nullptr; attributes += 2) element.attributes.emplace_back(attributes[0], attributes[1]);
    const std::size_t begin = end_of_tag();
    element.text = text.substr(begin);
    element.text_line =
        line() + static_cast<std::size_t>(std::ranges::count(text.substr(place(), begin - place()), '\n'));
    stopped = !last.empty() && element.name == last;
    open.push_back(elements.size());
    elements.push_back(std::move(element));
    awaits_text_end = true;
    if (stopped) XML_StopParser(parser, XML_FALSE);
  }

  void end() {
    end_text();
    open.pop_back();
  }

  void refuse_document_type() {
    fail_at(file, line(), "found a document type", "no document type: user-defined entities are not read");
  }

  // no exception may pass through the functions of a C library
  void guarded(const std::function<void()>& action) {
    if (error || stopped) return;
    try {
      action();
    } catch (...) {
      error = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  [[noreturn]] void fail() const {
    const XML_Error code = XML_GetErrorCode(parser);
    const bool inside = !open.empty();
    const std::string expected = inside ? fmt::format("the end of <{}>, begun in line {}", elements[open.back()].name,
                                                      elements[open.back()].line)
                                        : std::string("XML, with one element around all others");
    fail_at(file, line(), fmt::format("this is not XML: {}", XML_ErrorString(code)), expected);
  }
};

void on_start(void* data, const char* name, const char** attributes) {
  auto* reader = static_cast<Reader*>(data);
  reader->guarded([&] { reader->start(name, attributes); });
}

void on_end(void* data, const char*) {
  auto* reader = static_cast<Reader*>(data);
  reader->guarded([&] { reader->end(); });
}

void on_document_type(void* data, const char*, const char*, const char*, int) {
  auto* reader = static_cast<Reader*>(data);
  reader->guarded([&] { reader->refuse_document_type(); });
}

}  // namespace

std::optional<std::string_view> XmlElement::attribute(std::string_view key) const {
  for (const auto& [name_, value] : attributes)
    if (name_ == key) return value;
  return std::nullopt;
}

std::vector<XmlElement> read_xml(std::string_view text, const std::string& file, std::string_view last) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Reader reader{parser.get(), text, file, last};
  XML_SetUserData(parser.get(), &reader);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_document_type);

  // Expat copies what it is given and counts in int, so a large text comes in parts, the last of which says that it is
  // the last
  constexpr std::size_t part = std::size_t{1} << 20;
  for (std::size_t at = 0;; at += part) {
    const std::string_view now = text.substr(at, part);
    const bool is_final = text.size() - at <= part;
    const XML_Status status = XML_Parse(parser.get(), now.data(), static_cast<int>(now.size()), is_final ? 1 : 0);
    if (reader.error) std::rethrow_exception(reader.error);
    if (reader.stopped) break;
    if (status != XML_STATUS_OK) reader.fail();
    if (is_final) break;
  }
  return std::move(reader.elements);
}

}  // namespace dartboard
