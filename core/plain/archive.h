#pragma once
// The state of objects on its way into a file, or out of one: one function of each class serves both, so they agree.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dartboard {

/// Numbers, and fixed-size arrays and matrices of them: they are stored as they lie in memory.
template <class T>
inline constexpr bool is_flat = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;
template <class T, std::size_t n>
inline constexpr bool is_flat<std::array<T, n>> = is_flat<T> && sizeof(std::array<T, n>) == n * sizeof(T);
template <class T, int rows, int columns, int options>
inline constexpr bool is_flat<Eigen::Matrix<T, rows, columns, options, rows, columns>> =
    rows > 0 && columns > 0 &&
    sizeof(Eigen::Matrix<T, rows, columns, options>) ==
        sizeof(T) * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);

/// Writes values one after the other, or reads them back in the same order.
///
/// A class says once what it consists of, in `template <class Archive> void state(Archive& archive)` or, where it is
/// virtual, `void state(Archive& archive)`: archive(mass_, velocity_, ...). A length that was read is held against what
/// is left before memory is asked for.
/// throws  IoError naming the file, where what is read cannot have been written
class Archive {
 public:
  /// One to write to.
  Archive() = default;
  /// One to read from; the bytes have to outlive it. `file` is what errors name.
  Archive(std::string_view bytes, std::string file) : reads_(true), left_(bytes), file_(std::move(file)) {}

  bool reads() const { return reads_; }
  template <class... T>
  void operator()(T&... values) {
    (value(values), ...);
  }
  /// What follows: a word that has to be there again when it is read.
  void part(std::string_view name);
  /// So many bytes at a place.
  void bytes(void* data, std::size_t size);

  const std::string& written() const { return written_; }
  /// Bytes not yet read.
  std::size_t left() const { return left_.size(); }
  /// throws  IoError where something is left
  void require_end() const;
  /// "FILE: is damaged, in 'PART': WHAT"
  [[noreturn]] void fail(std::string_view what) const;

 private:
  void value(bool& flag);
  void value(std::string& text);
  template <class T>
  void value(std::optional<T>& maybe) {
    bool is_there = maybe.has_value();
    value(is_there);
    if (reads_) {
      maybe.reset();
      if (is_there) maybe.emplace();
    }
    if (is_there) value(*maybe);
  }
  template <class T>
  void value(std::vector<T>& column) {
    static_assert(!std::is_same_v<T, bool>, "a column of bits has no address");
    // what is not flat takes at least a byte each
    const std::size_t count = size(column.size(), is_flat<T> ? sizeof(T) : 1);
    if constexpr (is_flat<T>) {
      if (reads_) column.resize(count);
      bytes(column.data(), count * sizeof(T));
    } else {
      if (reads_) column.clear();
      for (std::size_t k = 0; k < count; ++k) {
        if (reads_) column.emplace_back();
        value(column[k]);
      }
    }
  }
  template <class T>
  void value(T& one) {
    if constexpr (is_flat<T>)
      bytes(&one, sizeof one);
    else
      one.state(*this);
  }
  /// Of a column: how many elements, each of so many bytes at least.
  std::size_t size(std::size_t count, std::size_t element);

  bool reads_ = false;
  std::string written_;
  std::string_view left_;
  std::string file_, part_;
};

}  // namespace dartboard
