#include "core/views/component_labels.h"

#include <algorithm>

#include "core/base/disjoint_sets.h"
#include "core/topology/facets.h"

namespace dartboard {
namespace {

/// Calls f(cell) for the cells across the facets of `cell`, as often as the facets are reported.
template <class Map, class F>
void for_each_neighbour(const ComponentLabels::Body<Map>& body, std::uint32_t cell, F&& f) {
  constexpr int n = Map::dimension;
  for_each_facet_dart(body.map, Cell<n>{body.cell_dart[cell]}, [&body, &f](Dart d) {
    const Dart across = body.map.template alpha<n>(d);
    if (across != d) f(body.cell(body.map, across));
  });
}

/// The cells that are wanted, joined across their facets. A wanted cell has no neighbour that is not.
template <class Map, class Wanted>
DisjointSets joined_across_facets(const ComponentLabels::Body<Map>& body, Wanted&& wanted) {
  const auto cells = static_cast<std::uint32_t>(body.cell_dart.size());
  DisjointSets sets(cells);
  for (std::uint32_t cell = 0; cell < cells; ++cell)
    if (wanted(cell))
      for_each_neighbour(body, cell, [&sets, cell](std::uint32_t other) {
        if (other < cell) sets.join(other, cell);
      });
  return sets;
}

/// Whether the facets of two darts still share a vertex at one of the corners that follow a and b, so that their cells
/// are connected.
template <class Map>
bool still_joined(const ComponentLabels::Body<Map>& body, Dart a, Dart b) {
  const Map& map = body.map;
  const auto at_one_vertex = [&body, &map](Dart x, Dart y) { return body.vertex(map, x) == body.vertex(map, y); };
  if constexpr (Map::dimension == 2) {
    return at_one_vertex(a, b) || at_one_vertex(map.template alpha<0>(a), map.template alpha<0>(b));
  } else {
    Dart x = a, y = b;
    do {
      if (at_one_vertex(x, y)) return true;
      x = map.template alpha<0, 1>(x);
      y = map.template alpha<0, 1>(y);
    } while (x != a);
    return false;
  }
}

}  // namespace

// ---- names and labels

void ComponentLabels::clear() {
  for (auto* column : {&name_, &label_of_, &name_of_, &unused_}) column->clear();
  size_.clear();
}

std::uint32_t ComponentLabels::new_component() {
  if (unused_.empty()) {
    unused_.push_back(static_cast<std::uint32_t>(label_of_.size()));
    label_of_.push_back(none);
  }
  const std::uint32_t name = unused_.back();
  unused_.pop_back();
  label_of_[name] = static_cast<std::uint32_t>(name_of_.size());
  name_of_.push_back(name);
  size_.push_back(0);
  return name;
}

void ComponentLabels::drop_empty(ComponentChange& report) {
  std::sort(emptied_.rbegin(), emptied_.rend());  // from the end: the last is never empty itself
  for (const std::uint32_t gap : emptied_) {
    const auto last = static_cast<std::uint32_t>(count() - 1);
    unused_.push_back(name_of_[gap]);
    name_of_[gap] = name_of_[last];
    size_[gap] = size_[last];
    if (gap != last) label_of_[name_of_[gap]] = gap;
    name_of_.pop_back();
    size_.pop_back();
    report.moved.push_back({last, gap});
  }
  emptied_.clear();
}

// ---- cells that were added or removed, or took another number

/// Give the name of `cell` to all connected cells without a name.
template <class Map>
void ComponentLabels::spread(const Body<Map>& body, std::uint32_t cell) {
  stack_.assign(1, cell);
  while (!stack_.empty()) {
    const std::uint32_t at = stack_.back();
    stack_.pop_back();
    for_each_neighbour(body, at, [this, at](std::uint32_t other) {
      if (name_[other] != none) return;
      set_name(other, name_[at]);
      stack_.push_back(other);
    });
  }
}

void ComponentLabels::follow_numbers(const ChangedEmbeddings& changed) {
  name_.resize(changed.cell_count + changed.moved_cells.size(), none);
  for (const auto& [from, to] : changed.moved_cells) {
    if (name_[to] != none) {
      const std::uint32_t label = label_of_[name_[to]];
      if (--size_[label] == 0) emptied_.push_back(label);
    }
    name_[to] = name_[from];
    name_.pop_back();
  }
}

template <class Map>
void ComponentLabels::name_added(const Body<Map>& body, const ChangedEmbeddings& changed) {
  const auto added = [this](std::uint32_t cell) { return name_[cell] == none; };
  for (const std::uint32_t cell : changed.cells) {
    if (!added(cell)) continue;
    for_each_neighbour(body, cell, [this, cell, added](std::uint32_t other) {
      if (added(cell) && !added(other)) set_name(cell, name_[other]);
    });
    if (!added(cell)) spread(body, cell);
  }
  for (const std::uint32_t cell : changed.cells) {
    if (!added(cell)) continue;  // otherwise it is not connected to any old cell
    set_name(cell, new_component());
    spread(body, cell);
  }
}

// ---- searches

std::uint32_t ComponentLabels::find(std::uint32_t group) {
  while (groups_[group].joined != group) {
    const std::uint32_t above = groups_[groups_[group].joined].joined;  // halves the path
    groups_[group].joined = above;
    group = above;
  }
  return group;
}

void ComponentLabels::append(List& list, std::uint32_t cell) { append(list, List{cell, cell}); }

void ComponentLabels::append(List& list, List other) {
  if (other.first == none) return;
  (list.first == none ? list.first : visit_[list.last].next) = other.first;
  list.last = other.last;
}

/// Take the first waiting cell and go on to its neighbours; returns the number of other groups met.
template <class Map>
std::size_t ComponentLabels::look_around(const Body<Map>& body, std::uint32_t group) {
  Group& here = groups_[group];
  const std::uint32_t cell = here.waiting.first;
  here.waiting.first = visit_[cell].next;
  visit_[cell].next = none;
  append(here.done, cell);
  std::size_t met = 0;
  for_each_neighbour(body, cell, [this, group, &here, &met](std::uint32_t other) {
    Visit& visit = visit_[other];
    if (visit.epoch != epoch_) {
      visit = {epoch_, group, none};
      append(here.waiting, other);
      ++here.size;
    } else if (visit.group != group) {
      const std::uint32_t found = find(visit.group);
      if (found == group) return;
      Group& there = groups_[found];
      there.joined = group;
      append(here.done, there.done);
      append(here.waiting, there.waiting);
      here.size += there.size;
      ++met;
    }
  });
  return met;
}

template <class Map>
void ComponentLabels::find_seeds(const Body<Map>& body, const TopologyChange& change) {
  seeds_.clear();
  const auto add = [this, &body](Dart d) {
    const std::uint32_t cell = body.cell(body.map, d);
    seeds_.emplace_back(name_[cell], cell);
  };
  for (const auto& [kept, split] : change.vertices) {
    const bool kept_lives = body.map.is_live(kept), split_lives = body.map.is_live(split);
    if (kept_lives && split_lives && still_joined(body, kept, split)) continue;
    if (kept_lives) add(kept);
    if (split_lives) add(split);
  }
  if (seeds_.empty()) return;
  std::sort(seeds_.begin(), seeds_.end());
  seeds_.erase(std::unique(seeds_.begin(), seeds_.end()), seeds_.end());
  if (visit_.size() < name_.size()) visit_.resize(name_.size());
  if (++epoch_ == 0) {
    std::fill(visit_.begin(), visit_.end(), Visit{});
    epoch_ = 1;
  }
}

/// Search one old component from the seeds in it.
template <class Map>
void ComponentLabels::search(const Body<Map>& body, std::size_t first_seed, std::size_t last_seed,
                             ComponentChange& report) {
  groups_.clear();
  active_.clear();
  parts_.clear();
  for (std::size_t s = first_seed; s < last_seed; ++s) {
    const auto group = static_cast<std::uint32_t>(s - first_seed);
    const std::uint32_t cell = seeds_[s].second;
    visit_[cell] = {epoch_, group, none};
    groups_.push_back({group, {}, {cell, cell}, 1});
    active_.push_back(group);
  }
  const std::size_t cells = size_[label_of_[seeds_[first_seed].first]];
  std::size_t left = groups_.size(), looks = 0;
  while (left > 1) {
    if (looks > std::max(most_looks, cells / 8)) return search_all(body, seeds_[first_seed].first, report);
    looks += active_.size();
    std::size_t kept = 0;
    for (const std::uint32_t group : active_) {
      if (groups_[group].joined != group) continue;
      if (left > 1) {
        if (groups_[group].waiting.first == none) {
          parts_.push_back(group);
          --left;
          continue;
        }
        left -= look_around(body, group);
      }
      active_[kept++] = group;
    }
    active_.resize(kept);
  }
  if (parts_.empty()) return;

  const std::uint32_t remainder = find(active_.front());
  std::size_t remaining = cells;
  for (const std::uint32_t p : parts_) remaining -= groups_[p].size;
  std::uint32_t largest = remainder;
  std::size_t most = remaining;
  for (const std::uint32_t p : parts_)
    if (groups_[p].size > most) {
      largest = p;
      most = groups_[p].size;
    }
  if (largest != remainder) {  // the cells of the remainder get another name, so all of them are needed
    while (groups_[remainder].waiting.first != none) look_around(body, remainder);
    parts_.push_back(remainder);
  }
  size_[label_of_[seeds_[first_seed].first]] = most;
  part(largest, report);
}

/// Finds the parts from all cells of an old component: in the order of their numbers, and so in that of
/// memory, which takes a fraction of the time of a search for each. Parts get labels by their sizes, the least first;
/// of two largest the one with the lowest cell keeps its name.
template <class Map>
void ComponentLabels::search_all(const Body<Map>& body, std::uint32_t name, ComponentChange& report) {
  const auto count = static_cast<std::uint32_t>(name_.size());
  DisjointSets sets = joined_across_facets(body, [&](std::uint32_t cell) { return name_[cell] == name; });
  std::vector<std::uint32_t> size(count, 0);  // by the lowest cell of a part; then its new name
  for (std::uint32_t cell = 0; cell < count; ++cell)
    if (name_[cell] == name) ++size[sets.set_of(cell)];
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts;  // size, lowest cell
  for (std::uint32_t cell = 0; cell < count; ++cell)
    if (size[cell] > 0) parts.emplace_back(size[cell], cell);
  const auto largest = std::ranges::max_element(parts, {}, &std::pair<std::uint32_t, std::uint32_t>::first);
  size_[label_of_[name]] = largest->first;
  size[largest->second] = name;
  parts.erase(largest);
  std::ranges::sort(parts);
  for (const auto& [cells, lowest] : parts) {
    size[lowest] = new_component();
    report.separated.push_back(size[lowest]);  // a name for now, not yet a label
  }
  for (std::uint32_t cell = 0; cell < count; ++cell)
    if (name_[cell] == name)
      if (const std::uint32_t other = size[sets.set_of(cell)]; other != name) set_name(cell, other);
}

/// Give each part but the largest a name and a label of its own.
void ComponentLabels::part(std::uint32_t largest, ComponentChange& report) {
  for (const std::uint32_t p : parts_) {
    if (p == largest) continue;
    const std::uint32_t name = new_component();
    for (std::uint32_t cell = groups_[p].done.first; cell != none; cell = visit_[cell].next) set_name(cell, name);
    report.separated.push_back(name);  // a name for now, not yet a label
  }
}

// ---- the view

template <class Map>
void ComponentLabels::rebuild(const Body<Map>& body) {
  clear();
  name_.assign(body.cell_dart.size(), none);
  DisjointSets sets = joined_across_facets(body, [](std::uint32_t) { return true; });
  for (std::uint32_t cell = 0; cell < name_.size(); ++cell) {
    const std::uint32_t lowest = sets.set_of(cell);
    set_name(cell, lowest == cell ? new_component() : name_[lowest]);
  }
}

template <class Map>
ComponentChange ComponentLabels::apply(const Body<Map>& body, const TopologyChange& change,
                                       const ChangedEmbeddings& changed) {
  ComponentChange report;
  follow_numbers(changed);
  name_added(body, changed);
  if (!change.vertices.empty()) {
    find_seeds(body, change);
    for (std::size_t first = 0, last = 0; first < seeds_.size(); first = last) {
      while (last < seeds_.size() && seeds_[last].first == seeds_[first].first) ++last;
      search(body, first, last, report);
    }
  }
  drop_empty(report);
  for (std::uint32_t& part : report.separated) part = label_of_[part];
  return report;
}

bool operator==(const ComponentLabels& a, const ComponentLabels& b) {
  if (a.cell_count() != b.cell_count() || a.count() != b.count()) return false;
  std::vector<std::uint32_t> same(a.count(), ComponentLabels::none);
  for (std::uint32_t cell = 0; cell < a.cell_count(); ++cell) {
    std::uint32_t& label = same[a.label(cell)];
    if (label == ComponentLabels::none) label = b.label(cell);
    if (label != b.label(cell)) return false;
  }
  // A label of b that stood for two of a would leave another of b without cells.
  for (std::uint32_t label = 0; label < a.count(); ++label)
    if (same[label] == ComponentLabels::none || a.size(label) != b.size(same[label])) return false;
  return true;
}

template void ComponentLabels::rebuild(const Body<Map2>&);
template void ComponentLabels::rebuild(const Body<Map3>&);
template void ComponentLabels::rebuild(const Body<TetMap>&);
template ComponentChange ComponentLabels::apply(const Body<Map2>&, const TopologyChange&, const ChangedEmbeddings&);
template ComponentChange ComponentLabels::apply(const Body<Map3>&, const TopologyChange&, const ChangedEmbeddings&);
template ComponentChange ComponentLabels::apply(const Body<TetMap>&, const TopologyChange&, const ChangedEmbeddings&);

}  // namespace dartboard
