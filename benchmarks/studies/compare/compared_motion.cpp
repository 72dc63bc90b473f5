#include "benchmarks/studies/compare/compared_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <string_view>
#include <utility>

#include "core/meshes/mesh_facts.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

/// Times of steps of different lengths differ by their rounding.
bool is_same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

struct TimedFrame {
  double time;
  fs::path file;
};

std::vector<TimedFrame> frames_of(const fs::path& folder) {
  const fs::path list = folder / "frames.pvd";
  std::ifstream in(list);
  if (!in) throw IoError(fmt::format("{}: is missing; expected the folder of a run with frames", list.string()));
  static const std::regex entry("timestep=\"([^\"]+)\".*file=\"([^\"]+)\"");
  std::vector<TimedFrame> frames;
  std::string line;
  for (std::smatch found; std::getline(in, line);)
    if (std::regex_search(line, found, entry)) frames.push_back({std::stod(found[1]), folder / found[2].str()});
  return frames;
}

/// The cells and links by their corners, whatever the order in which these and they are named: a map may name them
/// otherwise.
std::vector<std::vector<std::uint32_t>> corners_of(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> all;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) all.emplace_back(mesh.cell(c).begin(), mesh.cell(c).end());
  for (const auto& link : mesh.links) all.emplace_back(link.begin(), link.end());
  for (auto& corners : all) std::ranges::sort(corners);
  std::ranges::sort(all);
  return all;
}

FrameDistance distance_of(const Mesh& a, const Mesh& b, double time, double edge) {
  FrameDistance distance{.time = time};
  double sum = 0.0;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const double squared = (a.points[k] - b.points[k]).squaredNorm() / (edge * edge);
    sum += squared;
    if (squared > distance.largest * distance.largest) distance = {time, std::sqrt(squared), 0.0, k};
  }
  distance.root_mean_square = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, a.points.size())));
  return distance;
}

/// The fields of a line as csv_field writes them: one with a comma or a quote is in quotes, and its quotes are doubled.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char letter : line) {
    if (letter == '"') quoted = !quoted;
    if (letter == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += letter;
  }
  return fields;
}

/// A file of numbers under a header, by rows.
struct Numbers {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
};

Numbers read_numbers(const fs::path& file) {
  Numbers numbers;
  std::ifstream in(file);
  std::string line;
  if (std::getline(in, line)) numbers.header = fields_of(line);
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    std::vector<double> row;
    for (const std::string& cell : fields_of(line)) {
      std::size_t read = 0;
      double value = 0.0;
      try {
        value = std::stod(cell, &read);
      } catch (const std::exception&) {
        read = 0;
      }
      if (read == 0 || read != cell.size())
        throw IoError(fmt::format("{}:{}: '{}' is no number", file.string(), number, cell));
      row.push_back(value);
    }
    if (row.size() != numbers.header.size())
      throw IoError(fmt::format("{}:{}: has {} numbers; expected {}, or it is cut off", file.string(), number,
                                row.size(), numbers.header.size()));
    numbers.rows.push_back(std::move(row));
  }
  return numbers;
}

}  // namespace

const FrameDistance* ComparedMotion::furthest() const {
  const auto found = std::ranges::max_element(distances, {}, &FrameDistance::largest);
  return found == distances.end() ? nullptr : &*found;
}

std::optional<double> ComparedMotion::further_than(double edges) const {
  for (const FrameDistance& d : distances)
    if (d.largest > edges) return d.time;
  return std::nullopt;
}

ComparedMotion compare_motion(const fs::path& first, const fs::path& second) {
  const std::vector<TimedFrame> a = frames_of(first), b = frames_of(second);
  ComparedMotion motion;
  motion.frames[0] = a.size();
  motion.frames[1] = b.size();
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size() && !motion.cells_part;) {
    if (!is_same_time(a[i].time, b[j].time)) {
      ++(a[i].time < b[j].time ? i : j);
      continue;
    }
    const Mesh of_first = read_mesh(a[i].file), of_second = read_mesh(b[j].file);
    if (motion.edge == 0.0) motion.edge = facts_of(of_first).median_edge;
    if (of_first.points.size() != of_second.points.size() || corners_of(of_first) != corners_of(of_second))
      motion.cells_part = a[i].time;
    else
      motion.distances.push_back(distance_of(of_first, of_second, a[i].time, motion.edge));
    ++i;
    ++j;
  }
  return motion;
}

std::vector<ComparedColumn> compare_columns(const fs::path& first, const fs::path& second) {
  std::vector<ComparedColumn> differing;
  for (const char* file : {"diagnostics.csv", "probes.csv"}) {
    const Numbers a = read_numbers(first / file), b = read_numbers(second / file);
    for (std::size_t of_a = 1; of_a < a.header.size(); ++of_a) {
      const auto found = std::ranges::find(b.header, a.header[of_a]);
      if (found == b.header.end()) continue;
      const auto of_b = static_cast<std::size_t>(found - b.header.begin());
      ComparedColumn column{.file = file, .name = a.header[of_a]};
      for (std::size_t i = 0, j = 0; i < a.rows.size() && j < b.rows.size();) {
        const double time = a.rows[i][0], other = b.rows[j][0];
        if (!is_same_time(time, other)) {
          ++(time < other ? i : j);
          continue;
        }
        const double apart = std::abs(a.rows[i][of_a] - b.rows[j][of_b]);
        column.scale = std::max(column.scale, std::abs(a.rows[i][of_a]));
        if (apart > column.largest) {
          column.largest = apart;
          column.at = time;
        }
        ++i;
        ++j;
      }
      if (column.largest > 0.0) differing.push_back(std::move(column));
    }
  }
  return differing;
}

}  // namespace dartboard
