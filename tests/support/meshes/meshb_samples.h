#pragma once
// The two tetrahedra of mesh_samples.h as binary Medit files of every version, put together from the description of
// the format: code, place of the next section, number of lines, lines.

#include <string>

#include "tests/support/meshes/binary_mesh_samples.h"

namespace dartboard::samples {

class MeshbWriter {
 public:
  MeshbWriter(int version, bool big_endian) : version_(version), big_endian_(big_endian) {
    out_ = word(1) + word(version);
    section(3, word(3));
  }

  std::string word(std::int32_t value) const { return bytes_of<std::int32_t>({value}, big_endian_); }
  std::string integers(const std::vector<std::int64_t>& values) const {
    if (version_ == 4) return bytes_of(values, big_endian_);
    return bytes_of(std::vector<std::int32_t>(values.begin(), values.end()), big_endian_);
  }
  std::string reals(const std::vector<double>& values) const {
    if (version_ > 1) return bytes_of(values, big_endian_);
    return bytes_of(std::vector<float>(values.begin(), values.end()), big_endian_);
  }
  std::string place(std::size_t at) const {
    if (version_ > 2) return bytes_of<std::int64_t>({static_cast<std::int64_t>(at)}, big_endian_);
    return word(static_cast<std::int32_t>(at));
  }
  void section(std::int32_t code, const std::string& content) {
    const std::size_t place_bytes = version_ > 2 ? 8 : 4;
    out_ += word(code) + place(out_.size() + 4 + place_bytes + content.size()) + content;
  }
  /// Lines of integers, after their number.
  void lines(std::int32_t code, std::int64_t count, const std::vector<std::int64_t>& values) {
    section(code, integers({count}) + integers(values));
  }
  std::string finish() const { return out_ + word(54) + place(0); }

 private:
  int version_;
  bool big_endian_;
  std::string out_;
};

inline std::string meshb(int version, bool big_endian = false) {
  MeshbWriter file(version, big_endian);
  std::string vertices = file.integers({5});
  for (std::size_t k = 0; k < 5; ++k)
    vertices += file.reals({coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]}) + file.integers({1});
  file.section(4, vertices);
  file.lines(13, 2, {1, 5});       // corners
  file.lines(5, 1, {1, 2, 0});     // an edge
  file.lines(6, 1, {1, 2, 3, 9});  // a triangle
  file.lines(8, 2, {1, 2, 3, 4, 7, 2, 3, 4, 5, -3});
  return file.finish();
}

}  // namespace dartboard::samples
