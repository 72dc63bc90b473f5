#pragma once
// The connected components of a body, by cell; they follow cuts without a walk through the body.

#include <cstdint>
#include <utility>
#include <vector>

#include "core/mechanics/adapt.h"

namespace dartboard {

/// The changes of the components in one call.
struct ComponentChange {
  // The labels of parts that came off, as they are after `moved`. The largest part of a component keeps its label.
  std::vector<std::uint32_t> separated;
  // Components that were removed with their cells: label `to` was given to the last component, label `from`, in this
  // order, after the separated parts had received the next free labels.
  std::vector<Renumbered> moved;

  bool empty() const { return separated.empty() && moved.empty(); }
};

/// The connected component of every cell (volume of a solid, face of a surface).
///
/// "The loss of connectivity is quite simple to verify", says the paper's conclusion: walk through the structure along
/// all alpha-links and see whether all darts are marked. `rebuild` joins cells across facets; `apply` walks only where
/// something may have come apart:
///
/// Connectivity is lost only where a vertex came apart. Let P be a component after the change that is less than the
/// component it was in. Nothing but unsewing takes cells out of a component (a removed cell is isolated first), so some
/// unsewing of a facet was the last to part P from other cells: one side of that facet was in P, the other was not.
/// Both sides shared the vertices of the facet before, and share no vertex after, so each of these vertices came apart,
/// and the operation reported it by darts of the two sides. One of these lies in P, and it is live, because it still is
/// in P. Hence the live darts of `TopologyChange::vertices` lie in all the parts of every component that came apart,
/// and without such darts no component did. A pair whose facets still share a vertex elsewhere is skipped, because its
/// sides are connected; the pair of the proof is not among these. For most cuts this ends the work.
///
/// Searches start from the cells of these darts, taking turns cell by cell. Two that meet become one. One that has
/// no cell left has found a whole component. When one is left, it is the remainder of the old component. Where many
/// cells have been searched, all of the component are looked at instead, one after the other.
///
/// Labels are dense. A component that came off gets the next label; when one is removed, the last takes its label.
class ComponentLabels {
 public:
  template <class Map>
  using Body = MassSpringBody<Map, Held::by_every_dart>;

  /// Labels in the order of the lowest cell number of each component.
  ///
  /// cost    O(darts)
  template <class Map>
  void rebuild(const Body<Map>& body);

  /// Follow an operation or a series of them, and what `adapt` reported of it; gives the components of `rebuild`.
  ///
  /// A cell with a number that did not exist before belongs to the component of its neighbours.
  ///
  /// cost    nothing unless a vertex came apart; then O(cells that the searches visit before they meet each other), or,
  ///         if a part came off, O(cells of all parts but the largest), up to the number of starting places; never more
  ///         than a search of `most_looks` cells, or of an eighth of the component, and a look at all cells
  template <class Map>
  ComponentChange apply(const Body<Map>& body, const TopologyChange& change, const ChangedEmbeddings& changed);

  std::size_t count() const { return size_.size(); }
  std::uint32_t label(std::uint32_t cell) const { return label_of_[name_[cell]]; }
  /// The number of cells of the component.
  std::size_t size(std::uint32_t label) const { return size_[label]; }
  std::size_t cell_count() const { return name_.size(); }
  static constexpr std::size_t most_looks = 20'000;

  /// Equal when the same cells are together; labels do not count.
  friend bool operator==(const ComponentLabels& a, const ComponentLabels& b);

  /// Writes or reads labels and names, because the next of them depend on the cuts so far; searches keep scratch only.
  template <class Archive>
  void state(Archive& archive) {
    archive(name_, label_of_, name_of_, size_, unused_);
  }

  std::size_t bytes() const {
    return sizeof(Visit) * visit_.capacity() +
           sizeof(std::uint32_t) *
               (name_.capacity() + label_of_.capacity() + name_of_.capacity() + unused_.capacity()) +
           sizeof(std::size_t) * size_.capacity();
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  // A cell of a search: `group` searched it, `next` comes after it in its list.
  struct Visit {
    std::uint32_t epoch = 0, group = none, next = none;
  };
  // A list of cells; appending another list takes O(1).
  struct List {
    std::uint32_t first = none, last = none;
  };
  // Searches that have met: the cells whose neighbours they have visited, and those still waiting.
  struct Group {
    std::uint32_t joined;  // the group it has become part of, or itself
    List done, waiting;
    std::size_t size;
  };

  void clear();
  std::uint32_t new_component();
  void set_name(std::uint32_t cell, std::uint32_t name) {
    name_[cell] = name;
    ++size_[label_of_[name]];
  }
  template <class Map>
  void spread(const Body<Map>& body, std::uint32_t cell);
  void follow_numbers(const ChangedEmbeddings& changed);
  template <class Map>
  void name_added(const Body<Map>& body, const ChangedEmbeddings& changed);
  template <class Map>
  void find_seeds(const Body<Map>& body, const TopologyChange& change);
  template <class Map>
  void search(const Body<Map>& body, std::size_t first_seed, std::size_t last_seed, ComponentChange& report);
  template <class Map>
  void search_all(const Body<Map>& body, std::uint32_t name, ComponentChange& report);
  template <class Map>
  std::size_t look_around(const Body<Map>& body, std::uint32_t group);
  void part(std::uint32_t largest, ComponentChange& report);
  void drop_empty(ComponentChange& report);
  std::uint32_t find(std::uint32_t group);
  void append(List& list, std::uint32_t cell);
  void append(List& list, List other);

  // A component has a name besides its label, so that its cells need no change when it takes another label.
  std::vector<std::uint32_t> name_;      // by cell
  std::vector<std::uint32_t> label_of_;  // by name
  std::vector<std::uint32_t> name_of_;   // by label
  std::vector<std::size_t> size_;        // by label
  std::vector<std::uint32_t> unused_;    // names

  // scratch, kept between calls
  std::uint32_t epoch_ = 0;
  std::vector<Visit> visit_;  // by cell
  std::vector<Group> groups_;
  std::vector<std::uint32_t> active_, parts_, emptied_, stack_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> seeds_;  // name, cell
};

extern template void ComponentLabels::rebuild(const Body<Map2>&);
extern template void ComponentLabels::rebuild(const Body<Map3>&);
extern template void ComponentLabels::rebuild(const Body<TetMap>&);
extern template ComponentChange ComponentLabels::apply(const Body<Map2>&, const TopologyChange&,
                                                       const ChangedEmbeddings&);
extern template ComponentChange ComponentLabels::apply(const Body<Map3>&, const TopologyChange&,
                                                       const ChangedEmbeddings&);
extern template ComponentChange ComponentLabels::apply(const Body<TetMap>&, const TopologyChange&,
                                                       const ChangedEmbeddings&);

}  // namespace dartboard
