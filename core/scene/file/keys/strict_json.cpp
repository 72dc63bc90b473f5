#include "core/scene/file/keys/strict_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

/// Builds the value and keeps the path of the present place, which the library's own builder does not report.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, std::string_view name) : text_(text), name_(name) {}
  Json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // JSON has no binary values
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    if (stack_.back()->contains(name))
      throw InputError(
          fmt::format("{}: {}/{}: the key is given twice; expected it once", name_, path_of_top(), pointer_step(name)));
    key_ = name;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    // `position` counts the characters read, the last of which is the wrong one
    const std::size_t at = std::min(position == 0 ? 0 : position - 1, text_.size());
    const std::string_view before = text_.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t last = before.rfind('\n');
    const std::size_t column = at - (last == before.npos ? 0 : last + 1) + 1;
    // 406: a number beyond the range of a double
    const std::string found =
        error.id == 406 ? fmt::format("'{}' is too large for a number", token) : explanation(error.what());
    throw InputError(fmt::format("{}:{}:{}: {}", name_, line, column, found));
  }

 private:
  // Without the library's own prefix, "[json.exception.parse_error.101] parse error at line 1, column 2: ".
  static std::string explanation(std::string_view what) {
    const std::size_t syntax = what.find("syntax error");
    return std::string(syntax == what.npos ? what : what.substr(syntax));
  }

  template <class Value>
  bool put(Value&& value) {
    place(std::forward<Value>(value));
    return true;
  }
  Json* place(Json value) {
    if (stack_.empty()) return &(root_ = std::move(value));
    Json& parent = *stack_.back();
    if (parent.is_array()) return &parent.emplace_back(std::move(value));
    return &(parent[key_] = std::move(value));
  }
  // A parent grows only while none of its children is open, so the addresses on the stack stay.
  bool open(Json value) {
    const bool in_object = !stack_.empty() && stack_.back()->is_object();
    if (!stack_.empty()) steps_.push_back(in_object ? pointer_step(key_) : std::to_string(stack_.back()->size()));
    stack_.push_back(place(std::move(value)));
    return true;
  }
  bool close() {
    stack_.pop_back();
    if (!steps_.empty()) steps_.pop_back();
    return true;
  }
  std::string path_of_top() const {
    std::string path;
    for (const std::string& step : steps_) path += "/" + step;
    return path;
  }

  std::string_view text_, name_;
  Json root_;
  std::vector<Json*> stack_;        // the values that are open, outermost first
  std::vector<std::string> steps_;  // the path from each open value to the next
  std::string key_;
};

}  // namespace

std::string pointer_step(std::string_view key) {
  std::string step;
  for (const char c : key) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return step;
}

Json parse_strict_json(std::string_view text, std::string_view name) {
  Builder builder(text, name);
  Json::sax_parse(text, &builder);
  return builder.take();
}

}  // namespace dartboard
