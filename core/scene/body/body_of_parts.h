#pragma once
// A simulated body of solids, surfaces and chains: one system over the bodies that each kind of them makes.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/forces/shifted_term.h"
#include "core/mechanics/problem_parts.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// Its columns are those of its parts, one after another: solids, surfaces, chains. They are the state between events;
/// an event operates on the parts, which are given the state before, and the columns are made anew after it.
///
/// Forces of some kinds are over all of them (ForceNeed::over_parts), as attachments, which join the parts; so is
/// contact with obstacles. Contact between bodies is that of the solids, whose vertices come first.
/// cost  O(vertices + springs + pieces of surfaces + attachments) for each event that changes anything, and O(cells) to
///       find attached cells, in addition to that of the parts
class BodyOfParts final : public SimulatedBody {
 public:
  /// Makes a part; its cells have these numbers in the mesh that the needs refer to.
  using MakePart = std::unique_ptr<SimulatedBody> (*)(const Problem&, const BodyNeeds&, std::vector<std::uint32_t>);

  /// throws  InputError as `make` and parts_of
  BodyOfParts(const Problem& problem, const BodyNeeds& needs, MakePart make);

  /// Those of its parts that have a map: "tetrahedral 3-g-map and 2-g-map"
  std::string map_name() const override;
  VertexColumns& vertices() override { return vertices_; }
  using SimulatedBody::vertices;
  SpringSystem system() const override { return system_of(vertices_, ends_, springs_, gravity_, forces_.terms()); }
  bool does_work() const override;
  void begin_work(std::span<const Eigen::Vector3d> x) const override;
  double work(std::span<const Eigen::Vector3d> x, double h) const override;
  void track(std::uint32_t vertex) override;

  /// Cells by place or number, in whichever part they are; what only solids have acts on the solids.
  ///
  /// throws  InputError as the parts, for facets and vertices by number of a point, and for cells drawn at random
  std::unique_ptr<ReadyEvent> make_ready(const SceneEvent& event) override;
  std::vector<std::vector<CellCorner>> corners_of(std::span<const std::uint32_t> mesh_cells) const override;

  double mass() const override;
  double removed_mass() const override;
  CellCounts counts() const override;
  /// Of the solids; without any, of the surfaces. So is the stress.
  double boundary() const override;
  double largest_stress() const override;
  Frame frame(const FrameFields& fields) const override;
  std::string violation() const override;
  void state(Archive& archive) override;
  MemoryReport memory() const override;

 private:
  class Event;
  struct Member {
    int dimension = 0;
    std::vector<std::uint32_t> point, cell;  // of the whole mesh
    std::vector<MaterialNumber> material;    // of the whole body; empty where that has one
    std::unique_ptr<SimulatedBody> body;
    std::uint32_t first = 0;                            // vertex
    std::vector<std::unique_ptr<ShiftedTerm>> terms{};  // of surfaces, where solids come first
  };
  struct Tracked {
    std::size_t part, place;  // in its list
  };

  SimulatedBody& leading() const;
  const Member& part_of(std::uint32_t vertex) const;
  /// Its columns of all columns.
  static std::span<const Eigen::Vector3d> own(const Member& part, std::span<const Eigen::Vector3d> x);
  void give_state() const;
  void take_state();
  void take_vertices();

  std::vector<Member> parts_;
  VertexColumns vertices_;
  Springs springs_;
  std::vector<SpringEnds> ends_;
  Eigen::Vector3d gravity_{0, 0, 0};
  std::vector<SkinSample> samples_;
  std::vector<Tracked> tracked_in_;
};

}  // namespace dartboard
