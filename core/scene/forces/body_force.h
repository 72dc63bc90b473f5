#pragma once
// A force of a body that a key of its scene asks for: rows that follow the body's topology, and a term over them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/archive.h"
#include "core/base/bytes.h"
#include "core/forces/force_term.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/cell_nodes.h"

namespace dartboard {

template <class Map>
using BodyOf = MassSpringBody<Map, Held::by_every_dart>;
/// A body on a map of any type.
using MapBody = std::variant<const BodyOf<Map2>*, const BodyOf<Map3>*, const BodyOf<TetMap>*>;

/// A body that has no map: a chain, or several bodies as one.
struct BodyWithoutMap {
  const VertexColumns& vertices;
  /// The corners of cells of the mesh, whose numbers ascend; none of a cell that is removed.
  std::function<std::vector<std::vector<CellCorner>>(std::span<const std::uint32_t>)> corners_of;
};

/// The body that a force is made for.
struct ForceSite {
  int dimension;                  // of its cells; 1: links; of several bodies as one, the highest
  const VertexColumns& vertices;  // which outlive the force; they may be empty until the first `rebuild`
  std::function<std::uint32_t(std::uint32_t)> mesh_cell;  // the number in the mesh of each cell
};

class BodyForce {
 public:
  BodyForce() = default;
  BodyForce(const BodyForce&) = delete;  // the term refers to the rows in place
  BodyForce& operator=(const BodyForce&) = delete;
  virtual ~BodyForce() = default;

  virtual const ForceTerm& term() const = 0;
  virtual std::size_t bytes() const = 0;

  /// Find the rows anew.
  virtual void rebuild(const MapBody&) = 0;
  virtual void rebuild(const BodyWithoutMap&) {}
  /// Follow what `adapt` reports; gives what `rebuild` would, but for the order of the rows.
  virtual void apply(const MapBody&, const ChangedEmbeddings&) = 0;
  /// From now on the body does not change: keep the rows, and nothing that finds them anew.
  virtual void leave_map() = 0;
  virtual void shrink_to_fit() {}
  /// Writes all that steps and events change, or reads it into a force made of the same scene.
  virtual void state(Archive&) = 0;

  /// The values that a timeline sets, by number of the scene's force; empty of a force without.
  virtual std::span<double> loads() { return {}; }
  /// [m] Of each spring of an attachment, its vertex and the place that this is attached to.
  virtual std::vector<std::array<Eigen::Vector3d, 2>> attachments(std::span<const Eigen::Vector3d>) const { return {}; }
  /// Does it exchange energy that no potential has, so that its work is summed?
  virtual bool does_work() const { return false; }
  virtual void begin_work(std::span<const Eigen::Vector3d>) {}
  /// [J] since `begin_work` h ago, as if every vertex had moved on a straight line at a constant speed.
  /// pre  the rows are those of `begin_work`; h > 0
  virtual double work(std::span<const Eigen::Vector3d>, double) const { return 0.0; }
};

/// A force whose rows are those of a view; `View` has `rows`, `rebuild` and `apply` for some types of map.
template <class View>
class ViewedForce : public BodyForce {
 public:
  explicit ViewedForce(View view = {}) : view_(std::move(view)) {}

  std::size_t bytes() const override {
    if constexpr (requires { view_.bytes(); })
      return on_map_ ? view_.bytes() : bytes_of(view_.rows);
    else
      return bytes_of(view_.rows);
  }
  void rebuild(const MapBody& body) override {
    std::visit([this](const auto* on) { view_.rebuild(*on); }, body);
  }
  using BodyForce::rebuild;
  void apply(const MapBody& body, const ChangedEmbeddings& changed) override {
    std::visit([&](const auto* on) { view_.apply(*on, changed); }, body);
  }
  void leave_map() override {
    auto rows = std::move(view_.rows);
    view_ = View();
    view_.rows = std::move(rows);
    on_map_ = false;
    shrink_to_fit();
  }
  void shrink_to_fit() override {
    view_.rows.shrink_to_fit();
    if constexpr (requires { view_.shrink_to_fit(); })
      if (on_map_) view_.shrink_to_fit();
  }
  void state(Archive& archive) override {
    if (on_map_) archive(view_);
  }

 protected:
  View view_;  // its rows alone where there is no map
  bool on_map_ = true;
};

/// What the scene needs of a kind of force, found on its mesh.
struct ForceNeed {
  std::function<std::unique_ptr<BodyForce>(const ForceSite&)> make;  // gives null for a body that has no such force
  std::string what, why;    // for its row of a plan: "springs without length: ...", "/attachments/0/stiffness: 5"
  bool over_parts = false;  // one for solids, surfaces and chains together, which finds its cells by their numbers
  bool rest = false;        // needs rest positions, also to follow a change of the map
  std::size_t kind = 0;     // its place in force_kinds()
};

}  // namespace dartboard
