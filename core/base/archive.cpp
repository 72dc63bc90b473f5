#include "core/base/archive.h"

#include <fmt/format.h>

#include <cstring>

#include "core/plain/error.h"

namespace dartboard {

void Archive::fail(std::string_view what) const {
  throw IoError(fmt::format("{}: is damaged{}: {}", file_, part_.empty() ? "" : fmt::format(", in '{}'", part_), what));
}

void Archive::bytes(void* data, std::size_t size) {
  if (size == 0) return;
  if (!reads_) {
    written_.append(static_cast<const char*>(data), size);
    return;
  }
  if (size > left_.size()) fail(fmt::format("{} bytes are left; expected {} or more", left_.size(), size));
  std::memcpy(data, left_.data(), size);
  left_.remove_prefix(size);
}

void Archive::value(bool& flag) {
  std::uint8_t byte = flag ? 1 : 0;
  bytes(&byte, 1);
  if (byte > 1) fail(fmt::format("a yes or no is {}; expected 0 or 1", byte));
  flag = byte == 1;
}

void Archive::require_below(std::uint8_t index, std::size_t count) const {
  if (index >= count) fail(fmt::format("the number of a kind is {}; expected less than {}", index, count));
}

std::size_t Archive::size(std::size_t count, std::size_t element) {
  std::uint64_t stored = count;
  bytes(&stored, sizeof stored);
  if (reads_ && stored > left_.size() / element)
    fail(fmt::format("a column has {} elements; expected no more than the {} bytes left hold", stored, left_.size()));
  return static_cast<std::size_t>(stored);
}

void Archive::value(std::string& text) {
  const std::size_t length = size(text.size(), 1);
  if (reads_) text.resize(length);
  bytes(text.data(), length);
}

void Archive::part(std::string_view name) {
  std::string found(name);
  value(found);
  if (found != name) fail(fmt::format("'{}' should follow", name));
  part_ = name;
}

void Archive::require_end() const {
  if (!left_.empty()) fail(fmt::format("{} bytes are left; expected 0", left_.size()));
}

}  // namespace dartboard
