#include "core/time/system/system_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/bytes.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

/// The rows of these vertices; none of a column that is left out.
template <class T>
std::vector<T> rows_of(std::span<const T> column, std::span<const std::uint32_t> vertices) {
  std::vector<T> rows;
  if (column.empty()) return rows;
  rows.reserve(vertices.size());
  for (const std::uint32_t i : vertices) rows.push_back(column[i]);
  return rows;
}

}  // namespace

SystemPart::SystemPart(const SpringSystem& whole, ForceTerms terms, std::vector<std::uint32_t> vertices)
    : vertices_(std::move(vertices)),
      number_(whole.vertex_count(), VertexSubset::none),
      mass_(rows_of(whole.mass, vertices_)),
      inverse_mass_(rows_of(whole.inverse_mass, vertices_)),
      viscosity_(rows_of(whole.viscosity.span(), vertices_)),
      fixed_(rows_of(whole.fixed.span(), vertices_)),
      held_axes_(rows_of(whole.held_axes.span(), vertices_)),
      pull_(rows_of(whole.pull, vertices_)),
      x_(vertices_.size()),
      v_(vertices_.size()),
      gravity_(whole.gravity) {
  for (std::uint32_t k = 0; k < vertices_.size(); ++k) {
    number_[vertices_[k]] = k;
    if (runs_.empty() || vertices_[k] != runs_.back().whole + runs_.back().count)
      runs_.push_back({k, vertices_[k], 1});
    else
      ++runs_.back().count;
  }
  for (std::size_t s = 0; s < whole.ends.size(); ++s) {
    const auto [i, j] = whole.ends[s];
    if (number_[i] == VertexSubset::none) continue;
    ends_.push_back({number_[i], number_[j]});
    if (whole.springs.damped().empty())
      undamped_.push_back(whole.springs.undamped()[s]);
    else
      springs_.push_back(whole.springs.damped()[s]);
  }
  for (const ForceTerm* term : terms) {
    own_.push_back(term->of_part(subset()));
    if (own_.back().term == nullptr)
      throw InputError(fmt::format("forces of {} cannot be taken in parts", term->pieces_name()));
    terms_.push_back(own_.back().term.get());
  }
}

SpringSystem SystemPart::system() const {
  return {.ends = ends_,
          .springs = springs_.empty() ? SpringSpan(undamped_) : SpringSpan(springs_),
          .mass = mass_,
          .inverse_mass = inverse_mass_,
          .viscosity = viscosity_,
          .fixed = fixed_,
          .gravity = gravity_,
          .pull = pull_,
          .terms = terms_,
          .held_axes = held_axes_};
}

void SystemPart::take(Motion whole, std::span<const Eigen::Vector3d> pull) {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    x_[k] = whole.x[vertices_[k]];
    v_[k] = whole.v[vertices_[k]];
  }
  for (std::size_t k = 0; k < pull_.size(); ++k) pull_[k] = pull[vertices_[k]];
}

void SystemPart::give(Motion whole) const {
  for (const Run& run : runs_) {
    std::copy_n(x_.begin() + run.first, run.count, whole.x.begin() + run.whole);
    std::copy_n(v_.begin() + run.first, run.count, whole.v.begin() + run.whole);
  }
}

std::size_t SystemPart::bytes() const {
  return bytes_of(vertices_, number_, runs_, ends_, springs_, undamped_, mass_, inverse_mass_, viscosity_) +
         bytes_of(fixed_, held_axes_, pull_, x_, v_);
}

}  // namespace dartboard
