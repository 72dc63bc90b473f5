#pragma once
// Bytes written as text (RFC 4648), as XML VTK files hold them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dartboard {

/// Bytes as base64 text, padded.
std::string encode_base64(std::string_view bytes);
/// Add that to a text.
void append_base64(std::string& text, std::string_view bytes);

/// The bytes of a base64 text, ignoring white space; no value when it is malformed. Padding may also stand inside: some
/// writers encode the length of a block and the block itself one after the other.
std::optional<std::string> decode_base64(std::string_view text);

/// Takes bytes from a base64 text, from its beginning on, without reading further than necessary: its first bytes may
/// define where it ends. White space and padding are as for decode_base64.
class Base64Reader {
 public:
  explicit Base64Reader(std::string_view text) : text_(text) {}

  /// Append the next `count` bytes; false when the text is malformed before them, or ends.
  bool take(std::size_t count, std::string& out);
  /// Nothing is left but white space.
  bool at_end();
  /// An upper bound of the bytes left.
  std::size_t most_left() const { return (text_.size() - at_) / 4 * 3 + 3; }

 private:
  void skip_blank();
  bool decode_group();
  /// Decode groups of four letters, without white space or padding, up to the first that is not one; their number.
  std::size_t decode_plain_groups(std::size_t most, char* to);

  std::string_view text_;
  std::size_t at_ = 0;
  char group_[3] = {};  // decoded bytes of which those from first_ to end_ are not yet taken
  std::size_t first_ = 0, end_ = 0;
};

}  // namespace dartboard
