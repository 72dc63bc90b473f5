#pragma once
// The memory that data take, which plans predict and objects report.

#include <cstddef>
#include <vector>

namespace dartboard {

/// Bytes of the elements of a column: its size times that of an element, whatever has been set aside beyond that.
template <class T>
std::size_t bytes_of(const std::vector<T>& column) {
  return column.size() * sizeof(T);
}
template <class First, class Second, class... More>
std::size_t bytes_of(const First& first, const Second& second, const More&... more) {
  return bytes_of(first) + bytes_of(second, more...);
}

}  // namespace dartboard
