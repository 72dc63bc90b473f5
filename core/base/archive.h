#pragma once
// The state of objects written into a file, or read from one: one function of each class does both, so they agree.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace dartboard {

/// Numbers, and fixed-size arrays and matrices of numbers: they are stored as in memory.
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
/// A class lists its state once, in `template <class Archive> void state(Archive& archive)` or, if it is virtual,
/// `void state(Archive& archive)`: archive(mass_, velocity_, ...). A length that was read is compared with the bytes
/// left before memory is allocated.
/// throws  IoError naming the file, if the bytes read cannot have been written
class Archive {
 public:
  /// An archive to write to.
  Archive() = default;
  /// An archive to read from; the bytes have to outlive it. Errors name `file`.
  Archive(std::string_view bytes, std::string file) : reads_(true), left_(bytes), file_(std::move(file)) {}

  bool reads() const { return reads_; }
  template <class... T>
  void operator()(T&... values) {
    (value(values), ...);
  }
  /// Begins a part: writes its name, which must be found again when it is read.
  void part(std::string_view name);
  /// Writes or reads `size` bytes at `data`.
  void bytes(void* data, std::size_t size);

  const std::string& written() const { return written_; }
  /// Bytes not yet read.
  std::size_t left() const { return left_.size(); }
  /// throws  IoError if bytes are left
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
  template <class... T>
  void value(std::variant<T...>& one_of) {
    auto index = static_cast<std::uint8_t>(one_of.index());
    value(index);
    if (reads_) {
      require_below(index, sizeof...(T));
      std::uint8_t k = 0;
      ((k++ == index ? (void)one_of.template emplace<T>() : (void)0), ...);
    }
    std::visit([this](auto& alternative) { this->value(alternative); }, one_of);
  }
  void value(std::monostate&) {}
  template <class T>
  void value(std::vector<T>& column) {
    static_assert(!std::is_same_v<T, bool>, "a column of bits has no address");
    // elements that are not flat take at least a byte each
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
  void require_below(std::uint8_t index, std::size_t count) const;
  /// The number of elements of a column, each of at least so many bytes.
  std::size_t size(std::size_t count, std::size_t element);

  bool reads_ = false;
  std::string written_;
  std::string_view left_;
  std::string file_, part_;
};

}  // namespace dartboard
