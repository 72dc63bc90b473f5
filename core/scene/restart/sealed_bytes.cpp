#include "core/scene/restart/sealed_bytes.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "core/plain/error.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

constexpr std::string_view word = "dartboard checkpoint\n";
constexpr std::uint32_t byte_order = 0x01020304;
// to be increased with every change of what is stored, or of the order in which it is stored
constexpr std::uint32_t format = 22;

struct Head {
  std::uint32_t order = byte_order, number = format;
  std::uint64_t length = 0;
};
constexpr std::size_t head_size = word.size() + sizeof(Head), seal_size = head_size + sizeof(std::uint64_t);

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.value();
}

}  // namespace

std::string sealed(std::string_view bytes) {
  const Head head{.length = bytes.size()};
  std::string whole;
  whole.reserve(seal_size + bytes.size());
  whole += word;
  whole.append(reinterpret_cast<const char*>(&head), sizeof head);
  whole += bytes;
  const std::uint64_t hash = hash_of(whole);
  whole.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  return whole;
}

std::string_view unsealed(std::string_view whole, const std::string& file) {
  const auto fail = [&file](const std::string& what) { throw IoError(fmt::format("{}: {}", file, what)); };
  if (!whole.starts_with(word)) fail("is no checkpoint; expected a file that a run of dartboard left");
  Head head;
  if (whole.size() < seal_size) fail(fmt::format("is cut short: has {} bytes, less than the seal", whole.size()));
  std::memcpy(&head, whole.data() + word.size(), sizeof head);
  if (head.order != byte_order) fail("was written by a processor with another order of bytes; expected one of ours");
  if (head.number != format)
    fail(fmt::format("is of format {}; expected {}, which this program reads", head.number, format));
  if (whole.size() - seal_size != head.length)
    fail(fmt::format("is {}: has {} bytes; expected {}",
                     whole.size() - seal_size < head.length ? "cut short" : "too long", whole.size(),
                     head.length + seal_size));
  std::uint64_t hash = 0;
  std::memcpy(&hash, whole.data() + whole.size() - sizeof hash, sizeof hash);
  if (hash != hash_of(whole.substr(0, whole.size() - sizeof hash)))
    fail("has been changed: its checksum is another; expected the file as the run left it");
  return whole.substr(head_size, head.length);
}

}  // namespace dartboard
