#pragma once
// Numbers of a file that are words in its text variant and bytes in its binary one.

#include <cstdint>
#include <string_view>

#include "core/meshes/bytes/scalar.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// Takes numbers from the present place of a scanner.
///
/// throws  IoError, which names the line of a word, or the byte at which a number begins
class FileNumbers {
 public:
  explicit FileNumbers(TextScanner& scan) : scan_(scan) {}

  void set_binary(bool big_endian);
  bool is_binary() const { return is_binary_; }
  /// To be called after a line of words, where bytes begin in a binary file.
  void begin();

  /// A finite number.
  double real(Scalar type, Wanted wanted);
  /// pre  !is_real(type)
  std::int64_t integer(Scalar type, Wanted wanted);
  /// An integer that is not negative.
  std::uint64_t count(Scalar type, Wanted wanted);
  /// Skip so many numbers, whatever their values.
  void skip(Scalar type, std::uint64_t many, Wanted wanted);

  /// The line of the number taken last; 0 among bytes.
  std::size_t line() const { return is_binary_ ? 0 : scan_.line(); }
  /// The number of elements to reserve, each of at least so many bytes, or characters: at most what the file can hold.
  std::size_t plausible(std::uint64_t declared, std::size_t bytes, std::size_t characters) const;
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;

 private:
  std::string_view take(std::uint64_t size, Wanted wanted);

  TextScanner& scan_;
  bool is_binary_ = false, big_endian_ = false;
  std::size_t place_ = 0;
};

}  // namespace dartboard
