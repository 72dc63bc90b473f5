#pragma once
// A stack that is pressed together while it is cut, torn and eroded at random: its skin, its accounts, its overlaps.

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/mechanics/vertex_columns.h"
#include "validation/contact/judged_overlaps.h"

namespace dartboard {

struct PressedOperationsPlan {
  std::size_t operations = 10'000;
  std::size_t look_every = 100;  // operations from one look at overlaps to the next
  std::uint64_t seed = 1;
  // For tests: alters the vertices unknown to the judge after an operation; the share of their pressure that
  // contacts between bodies have; the operations that the skin does not follow.
  std::function<void(std::size_t operation, VertexColumns& vertices)> meddles{};
  double strength = 1.0;
  std::function<bool(std::size_t operation)> forgets{};
};

/// The operations, and the largest errors. Those of sums are relative to the sum of the sizes that they are made of.
struct PressedOperations {
  std::size_t stacks = 0;
  std::size_t dissociated = 0, torn = 0, removed = 0;  // operations on a face, a fan and a cell, all with an effect
  std::size_t steps = 0, looks = 0;
  std::size_t strangers = 0;  // operations after which a view is not its rebuild
  std::size_t invalid = 0;  // looks at which the map is not valid, or contact not that of every sample with every cell
  bool ended = false;       // no step failed

  // Over an operation: elastic energy, kinetic and gravitational energy and momenta, less those of a cell removed.
  double elastic = 0.0, sums = 0.0;
  // Over an operation that separates cells: change of the energy of contacts that have no vertex that changed; and the
  // energy of contacts across the cut, over that of all contacts.
  double contact = 0.0, across = 0.0;
  double reopened = 0.0;  // the largest change of the energy of all contacts, over the energy of the stack

  // Over steps, in the life of a stack: energy that neither losses nor supply nor operations account for, over the
  // largest energy of the stack; and the momenta on which neither gravity nor obstacles act, over the sizes of what
  // was added to them.
  double energy = 0.0, momentum = 0.0, angular = 0.0;

  std::size_t contacts = 0;      // the most between bodies at a look
  std::size_t out_of_reach = 0;  // samples without a way out, at looks
  // Pairs of cells that overlap, of all looks, in least altitudes of a cell: those that are no neighbours; and those
  // that are and count for no contact, within two rings of a crack's tip or of a bend.
  OverlapTally by_depth{}, of_neighbours{};

  std::size_t operations() const { return dissociated + torn + removed; }
};

/// Three boxes of neo-Hookean tetrahedra, one upon the other, between a floor and a lid that comes down, all in contact
/// with each other and with themselves, with restitution and friction. A random face is dissociated, a fan torn or a
/// cell removed, and some steps are taken, again and again; when a tenth of the cells is gone, with most faces
/// dissociated by then, another stack takes its place. `looked` is called after each look.
///
/// cost  O(operations * cells)
PressedOperations operate_under_pressure(const PressedOperationsPlan& plan,
                                         const std::function<void(std::size_t)>& looked = {});

}  // namespace dartboard
