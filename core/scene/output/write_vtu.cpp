#include "core/scene/output/write_vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <ostream>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mechanics/fracture/stress.h"
#include "core/meshes/text/base64.h"
#include "core/plain/error.h"
#include "core/scene/output/atomic_file.h"

namespace dartboard {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));

struct VtkCell {
  std::uint8_t type;
  std::array<std::size_t, 8> order;  // for each point in VTK's order, our node
};

VtkCell vtk_cell(CellKind kind) {
  switch (kind) {
    case CellKind::triangle: return {5, {0, 1, 2}};
    case CellKind::quadrilateral: return {9, {0, 1, 2, 3}};
    case CellKind::tetrahedron: return {10, {0, 1, 2, 3}};
    case CellKind::pyramid: return {14, {0, 1, 2, 3, 4}};
    case CellKind::prism: return {13, {0, 2, 1, 3, 5, 4}};  // VTK's are mirrored (vtk_cells.cpp)
    case CellKind::hexahedron: break;
  }
  return {12, {0, 1, 2, 3, 4, 5, 6, 7}};
}

template <class T>
constexpr const char* vtk_type();
template <>
constexpr const char* vtk_type<double>() {
  return "Float64";
}
template <>
constexpr const char* vtk_type<std::int64_t>() {
  return "Int64";
}
template <>
constexpr const char* vtk_type<std::uint8_t>() {
  return "UInt8";
}

/// A text on its way to a stream, in blocks. `compressor` is that of arrays.
class Text {
 public:
  Text(std::ostream& out, std::optional<Compressor> compressor) : out_(out), compressor_(compressor) {
    block_.reserve(2 * most);
  }

  const std::optional<Compressor>& compressor() const { return compressor_; }
  std::back_insert_iterator<std::string> end() { return std::back_inserter(block_); }
  Text& operator+=(std::string_view more) {
    block_ += more;
    return *this;
  }
  void add_base64(std::string_view bytes) {
    constexpr std::size_t piece = most / 4 * 3;
    for (; bytes.size() > piece; bytes.remove_prefix(piece)) add_piece(bytes.substr(0, piece));
    add_piece(bytes);
  }
  /// Returns the number of bytes written.
  std::uint64_t flush() {
    out_.write(block_.data(), static_cast<std::streamsize>(block_.size()));
    written_ += block_.size();
    block_.clear();
    return written_;
  }

 private:
  static constexpr std::size_t most = 32768;

  void add_piece(std::string_view bytes) {
    append_base64(block_, bytes);
    if (block_.size() >= most) flush();
  }

  std::ostream& out_;
  std::optional<Compressor> compressor_;
  std::string block_;
  std::uint64_t written_ = 0;
};

/// The number of blocks, their size, that of a smaller last one, and the compressed size of each; then the blocks.
void append_compressed_blocks(Text& out, std::string_view bytes, Compressor compressor) {
  constexpr std::size_t size = 1 << 17;
  std::vector<std::uint64_t> lengths{(bytes.size() + size - 1) / size, size, bytes.size() % size};
  std::string blocks;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(size, bytes.size())))
    lengths.push_back(append_compressed(compressor, bytes.substr(0, size), blocks));
  out.add_base64({reinterpret_cast<const char*>(lengths.data()), lengths.size() * sizeof lengths[0]});
  out.add_base64(blocks);
}

/// Nine bytes, the length and the first of the data, are three groups of base64: the others follow from where they lie.
template <class T>
void append_encoded(Text& out, const T* data, std::size_t size) {
  const std::uint64_t length = size * sizeof(T);
  const std::string_view bytes(reinterpret_cast<const char*>(data), length);
  if (out.compressor()) {
    append_compressed_blocks(out, bytes, *out.compressor());
    out += "</DataArray>\n";
    return;
  }
  std::array<char, sizeof length + 1> begin;
  std::memcpy(begin.data(), &length, sizeof length);
  if (length > 0) begin.back() = bytes[0];
  out.add_base64({begin.data(), length > 0 ? begin.size() : sizeof length});
  if (length > 0) out.add_base64(bytes.substr(1));
  out += "</DataArray>\n";
}
template <class T>
void append_array(Text& out, const char* name, const T* data, std::size_t size, int components = 1) {
  fmt::format_to(out.end(), "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">",
                 vtk_type<T>(), name, components);
  append_encoded(out, data, size);
}
/// A field is an array of tuples of its own.
template <class T>
void append_field(Text& out, const char* name, const T* data, std::size_t tuples, std::size_t components = 1) {
  const std::string shape = components == 1 ? "" : fmt::format("NumberOfComponents=\"{}\" ", components);
  fmt::format_to(out.end(), "        <DataArray type=\"{}\" Name=\"{}\" {}NumberOfTuples=\"{}\" format=\"binary\">",
                 vtk_type<T>(), name, shape, tuples);
  append_encoded(out, data, tuples * components);
}
void append_pairs(Text& out, std::span<const FramePair> pairs) {
  std::vector<std::array<std::int64_t, 4>> samples;
  std::vector<std::array<std::int64_t, 3>> faces;
  std::vector<std::int64_t> obstacles;
  std::vector<double> depths;
  for (const FramePair& pair : pairs) {
    samples.push_back(pair.sample);
    faces.push_back(pair.face);
    obstacles.push_back(pair.obstacle);
    depths.push_back(pair.depth);
  }
  append_field(out, "contact_pair_sample", samples.empty() ? nullptr : samples[0].data(), pairs.size(), 4);
  append_field(out, "contact_pair_face", faces.empty() ? nullptr : faces[0].data(), pairs.size(), 3);
  append_field(out, "contact_pair_obstacle", obstacles.data(), pairs.size());
  append_field(out, "contact_pair_depth", depths.data(), pairs.size());
}
template <class T>
void append_array(Text& out, const char* name, const std::vector<T>& values) {
  append_array(out, name, values.data(), values.size());
}
void append_array(Text& out, const char* name, const std::vector<Eigen::Vector3d>& values) {
  append_array(out, name, values.empty() ? nullptr : values[0].data(), 3 * values.size(), 3);
}

bool has_columns_of_its_size(const Frame& frame) {
  const std::size_t points = frame.mesh.points.size(), cells = frame.mesh.cell_count() + frame.links.size();
  const FrameFields& fields = frame.fields;
  const bool is_chain = cells == frame.links.size() && cells > 0;
  const auto is = [](std::size_t size, bool asked, std::size_t expected) { return size == (asked ? expected : 0); };
  const bool has_stress = fields.stress && !is_chain;
  return frame.velocity.size() == points && (frame.mesh_point.empty() || frame.mesh_point.size() == points) &&
         frame.mass.size() == points && frame.mesh_cell.size() == cells && frame.component.size() == cells &&
         (frame.material.empty() || frame.material.size() == cells) &&
         (frame.body.empty() || frame.body.size() == cells) && is(frame.held.size(), fields.held, points) &&
         is(frame.stress.size(), has_stress, points) && is(frame.tension.size(), fields.stress, frame.links.size()) &&
         is(frame.displacement.size(), fields.displacement, points) &&
         is(frame.contact_force.size(), fields.contact, points) &&
         is(frame.contact_depth.size(), fields.contact, points) && (fields.contact || frame.contact_pairs.empty()) &&
         (frame.springs.empty() || (fields.springs && !is_chain)) &&
         is(frame.strain.size(), fields.springs, frame.links.size() + frame.springs.size());
}

void require_columns_of_its_size(const Frame& frame) {
  if (!has_columns_of_its_size(frame))
    throw InputError(fmt::format("a frame of {} points and {} cells with columns of other lengths",
                                 frame.mesh.points.size(), frame.mesh.cell_count()));
}

std::uint64_t put_vtu(const Frame& frame, std::optional<Compressor> compressor, std::ostream& stream) {
  const Mesh& mesh = frame.mesh;
  const std::size_t points = mesh.points.size(), cells = mesh.cell_count();
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  const std::size_t lines = frame.links.size() + frame.springs.size();
  connectivity.reserve(mesh.nodes.size() + 2 * lines);
  offsets.reserve(cells + lines);
  types.reserve(cells + lines);
  for (std::size_t c = 0; c < cells; ++c) {
    const VtkCell cell = vtk_cell(mesh.kinds[c]);
    const auto nodes = mesh.cell(c);
    for (std::size_t k = 0; k < nodes.size(); ++k) connectivity.push_back(nodes[cell.order[k]]);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(cell.type);
  }
  std::vector<std::int64_t> mesh_cell(frame.mesh_cell.begin(), frame.mesh_cell.end());
  std::vector<std::int64_t> component(frame.component.begin(), frame.component.end());
  std::vector<std::int64_t> material(frame.material.begin(), frame.material.end());
  std::vector<std::int64_t> body(frame.body.begin(), frame.body.end());
  const auto add_line = [&](const std::array<std::uint32_t, 2>& ends) {
    connectivity.insert(connectivity.end(), ends.begin(), ends.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(3);
  };
  for (const auto& link : frame.links) add_line(link);
  for (const auto& spring : frame.springs) add_line(spring);
  for (auto* numbers : {&mesh_cell, &component, &material, &body})  // springs are no cells
    if (!numbers->empty()) numbers->resize(types.size(), -1);
  std::vector<double> tension(cells, 0.0), strain(cells, 0.0);
  tension.insert(tension.end(), frame.tension.begin(), frame.tension.end());
  tension.resize(types.size(), 0.0);
  strain.insert(strain.end(), frame.strain.begin(), frame.strain.end());

  Text out(stream, compressor);
  fmt::format_to(
      out.end(),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n"
      "  <UnstructuredGrid>\n"
      "    <FieldData>\n",
      compressor ? fmt::format(" compressor=\"{}\"", vtk_name(*compressor)) : "");
  append_field(out, "TimeValue", &frame.time, 1);
  if (frame.fields.contact) append_pairs(out, frame.contact_pairs);
  fmt::format_to(out.end(),
                 "    </FieldData>\n    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <Points>\n", points,
                 types.size());
  append_array(out, "Points", mesh.points);
  out += "      </Points>\n      <Cells>\n";
  append_array(out, "connectivity", connectivity);
  append_array(out, "offsets", offsets);
  append_array(out, "types", types);
  out += "      </Cells>\n      <PointData Vectors=\"velocity\" Scalars=\"mass\">\n";
  append_array(out, "velocity", frame.velocity);
  append_array(out, "mass", frame.mass);
  if (!frame.mesh_point.empty()) append_array(out, "mesh_point", frame.mesh_point);
  const FrameFields& fields = frame.fields;
  const bool is_chain = cells == 0 && !frame.links.empty();
  if (fields.held) append_array(out, "held", frame.held);
  if (fields.stress && !is_chain) {
    std::vector<double> principal, magnitude, von_mises;
    for (const Eigen::Matrix3d& stress : frame.stress) {
      const StressMeasures measures = measures_of(stress);
      principal.push_back(measures.largest_principal);
      magnitude.push_back(measures.largest_magnitude);
      von_mises.push_back(measures.von_mises);
    }
    append_array(out, "largest_principal_stress", principal);
    append_array(out, "largest_stress_magnitude", magnitude);
    append_array(out, "von_mises_stress", von_mises);
  }
  if (fields.displacement) append_array(out, "displacement", frame.displacement);
  if (fields.contact) {
    append_array(out, "contact_force", frame.contact_force);
    append_array(out, "contact_depth", frame.contact_depth);
  }
  out += "      </PointData>\n      <CellData Scalars=\"component\">\n";
  append_array(out, "mesh_cell", mesh_cell);
  append_array(out, "component", component);
  if (!material.empty()) append_array(out, "material", material);
  if (!body.empty()) append_array(out, "body", body);
  if (fields.stress && !frame.links.empty()) append_array(out, "tension", tension);
  if (fields.springs) append_array(out, "strain", strain);
  out += "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  return out.flush();
}

}  // namespace

std::string to_vtu(const Frame& frame, std::optional<Compressor> compressor) {
  require_columns_of_its_size(frame);
  std::ostringstream text;
  put_vtu(frame, compressor, text);
  return std::move(text).str();
}

std::uint64_t write_vtu(const std::filesystem::path& path, const Frame& frame, std::optional<Compressor> compressor) {
  require_columns_of_its_size(frame);
  std::uint64_t bytes = 0;
  write_whole(path, [&](std::ostream& out) { bytes = put_vtu(frame, compressor, out); });
  return bytes;
}

}  // namespace dartboard
